# SPDX-License-Identifier: BSD-3-Clause
"""The Python module: models and simulation."""
import signal
import subprocess
import sys
import threading
import time
import unittest

import catena
import numpy as np

LENGTH, MASS = 3.39 / 12, 0.1424 * 3.39 / 12


def cable(links=12, **more):
    model = catena.Model(links)
    length = 3.39 / links
    mass = 0.1424 * length
    values = dict(
        length=length,
        mass=mass,
        inertia=mass * length**2 / 12,
        stiffness=47.448,
        damping=1e-3,
        load_mass=1.47,
    )
    return model, model.parameters(**(values | more))


class Parameters(unittest.TestCase):
    def test_a_family_sets_all_its_members(self):
        model, parameters = cable()
        for i in range(1, 13):
            self.assertEqual(parameters[model.parameter_index(f"stiffness_{i}")], 47.448)
        self.assertEqual(parameters[model.parameter_index("gravity")], 9.81)

    def test_one_value_each(self):
        model, parameters = cable(stiffness=np.arange(12.0))
        self.assertEqual(parameters[model.parameter_index("stiffness_3")], 2.0)

    def test_a_wrong_count_names_both(self):
        with self.assertRaisesRegex(ValueError, "stiffness: 3 values.*12"):
            cable(stiffness=[1, 2, 3])

    def test_an_unknown_name_tells_the_nearest(self):
        with self.assertRaisesRegex(catena.InputError, "stiffness"):
            catena.Model(12).parameter_index("stifness_1")
        with self.assertRaisesRegex(catena.InputError, "gravity"):
            catena.Model(12).parameters(gravty=9.81)

    def test_a_count_without_model_names_those_there_are(self):
        with self.assertRaisesRegex(catena.InputError, "12"):
            catena.Model(13)
        self.assertTrue(issubclass(catena.InputError, ValueError))


class Motion(unittest.TestCase):
    def test_energy_and_shape_of_the_arrays(self):
        model, parameters = cable()
        times = np.linspace(0, 1, 101)
        run = catena.simulate(model, parameters, catena.straight(model, 0.5), times)
        np.testing.assert_array_equal(run.trajectory.time, times)
        self.assertEqual(run.trajectory.q.shape, (101, 12))
        self.assertEqual(run.trajectory.energy.shape, (101, len(model.energy_names)))
        np.testing.assert_array_equal(run.trajectory.q[0], np.full(12, 0.5))
        self.assertLess(abs(run.energy_imbalance), 1e-4)
        self.assertGreater(run.statistics.steps, 10)

    def test_arrays_are_views_that_outlive_their_owner(self):
        model, parameters = cable()
        run = catena.simulate(model, parameters, catena.straight(model, 0.5), [0.0, 0.1, 0.2])
        q = run.trajectory.q
        self.assertTrue(np.shares_memory(q, run.trajectory.q))
        self.assertTrue(q.flags.c_contiguous)
        with self.assertRaises(ValueError):
            q[0, 0] = 1.0
        before = q.copy()
        del run
        np.testing.assert_array_equal(q, before)

    def test_positions_are_sums_of_sines_and_cosines(self):
        model, parameters = cable()
        run = catena.simulate(model, parameters, catena.straight(model, 0.5), [0.0, 0.3])
        side, down = catena.positions(model, parameters, run.trajectory)
        angles = run.trajectory.q
        np.testing.assert_allclose(side[:, 1:13], LENGTH * np.cumsum(np.sin(angles), 1), rtol=1e-14)
        np.testing.assert_allclose(down[:, 1:13], LENGTH * np.cumsum(np.cos(angles), 1), rtol=1e-14)
        np.testing.assert_array_equal(side[:, 0], 0)

    def test_the_catenary_ends_where_it_is_held(self):
        model, parameters = cable()
        start = catena.catenary(model, parameters, 1.5, 2.5)
        self.assertAlmostEqual(LENGTH * np.sin(start.q).sum(), 1.5, places=9)
        self.assertAlmostEqual(LENGTH * np.cos(start.q).sum(), 2.5, places=9)
        with self.assertRaises(ValueError):
            catena.catenary(model, parameters, 3.0, 3.0)

    def test_sensitivities_are_derivatives(self):
        model, parameters = cable()
        index = model.parameter_index("load_mass")
        start, times = catena.straight(model, 0.5), [0.0, 0.2, 0.4]
        direction = catena.SensitivityDirection.parameter(model, index)
        run = catena.simulate_with_sensitivities(model, parameters, start, [direction], times)
        step = 1e-4
        ends = []
        for sign in (1, -1):
            moved = parameters.copy()
            moved[index] += sign * step
            tight = dict(relative_tolerance=1e-11, absolute_tolerance_position=1e-13)
            ends.append(catena.simulate(model, moved, start, times, **tight).trajectory.q)
        difference = (ends[0] - ends[1]) / (2 * step)
        scale = np.abs(difference).max()
        np.testing.assert_allclose(run.sensitivity[0].q, difference, atol=2e-3 * scale)

    def test_bad_arguments(self):
        model, parameters = cable()
        start = catena.straight(model, 0.5)
        for arguments in (
            (parameters[:-1], start, [0, 1]),
            (np.full_like(parameters, np.nan), start, [0, 1]),
            (parameters, start, [1, 0]),
            (parameters, catena.straight(catena.Model(2), 0.5), [0, 1]),
        ):
            with self.assertRaises(ValueError):
                catena.simulate(model, *arguments)

    def test_a_failure_names_state_and_time(self):
        model, parameters = cable()
        with self.assertRaisesRegex(catena.ComputationError, "t = "):
            catena.simulate(model, parameters, catena.straight(model, 0.5), [0, 10], max_steps=20)


class LongCalls(unittest.TestCase):
    def test_other_threads_run_meanwhile(self):
        model, parameters = cable(60)
        ticks = []
        done = threading.Event()

        def tick():
            while not done.wait(0.002):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        catena.simulate(model, parameters, catena.straight(model, 0.5), np.linspace(0, 3, 30))
        end = time.monotonic()
        done.set()
        thread.join()
        inside = sum(begin < tick < end for tick in ticks)
        self.assertGreater(inside, (end - begin) / 0.1)

    def test_control_c(self):
        program = (
            "import catena, numpy as np\n"
            "model = catena.Model(60)\n"
            "p = model.parameters(length=.05, mass=.01, inertia=2e-6, stiffness=9., damping=1e-4,"
            " load_mass=1.)\n"
            "print('begin', flush=True)\n"
            "catena.simulate(model, p, catena.straight(model, 1.5), [0, 1e4], max_steps=10**9)\n"
        )
        process = subprocess.Popen(
            [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.assertEqual(process.stdout.readline(), "begin\n")
        time.sleep(0.3)
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=20)
        self.assertIn("KeyboardInterrupt", errors)


if __name__ == "__main__":
    unittest.main()
