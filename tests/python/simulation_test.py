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


class LargeWork(unittest.TestCase):
    def test_it_is_to_be_asked_for(self):
        model, parameters = cable(2, damping=0)
        start = catena.straight(model, 0.6)
        with self.assertRaisesRegex(catena.InputError, "the simulation needs about .*large_work=True"):
            catena.simulate(model, parameters, start, [0, 1e8], max_steps=10**9)
        with self.assertRaisesRegex(catena.InputError, "keeping the motion needs about .* GB"):
            long, of_long = cable(1000)
            catena.simulate(long, of_long, catena.straight(long, 0.6), np.arange(400_000) * 1e-3)
        with self.assertRaisesRegex(catena.ComputationError, "max_steps"):
            catena.simulate(model, parameters, start, [0, 1e8], max_steps=10**5, large_work=True)


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

    def test_any_number_of_links_works(self):
        for links in (2, 3, 4, 5, 12, 13, 60, 1000):
            model = catena.Model(links)
            self.assertEqual(model.links, links)
            self.assertEqual(len(model.parameter_names), 6 * links + 2)
        few, many = cable(5), cable(33)  # both at once
        for (model, parameters), links in ((few, 5), (many, 33)):
            run = catena.simulate(model, parameters, catena.straight(model, 0.5), [0.0, 0.1])
            self.assertEqual(run.trajectory.q.shape, (2, links))
            self.assertLess(abs(run.energy_imbalance), 1e-4)

    def test_impossible_numbers_of_links(self):
        for links in (-3, 0, 1, 10_001):
            with self.assertRaisesRegex(catena.InputError, f"{links} links"):
                catena.Model(links)
        self.assertTrue(issubclass(catena.InputError, ValueError))

    def test_the_version(self):
        self.assertRegex(catena.__version__, r"^\d+\.\d+\.\d+$")


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

    def test_the_gradient_is_that_of_the_sensitivities(self):
        model, parameters = cable(5)
        start, times = catena.straight(model, 0.5), [0.0, 0.2, 0.4]

        def slope(motion):  # of J = |q|^2 / 2 + |v|^2 / 200 at the last time
            dq, dv = np.zeros_like(motion.q), np.zeros_like(motion.v)
            dq[-1], dv[-1] = motion.q[-1], motion.v[-1] / 100
            return dq, dv

        run = catena.simulate_with_gradient(model, parameters, start, times, slope)
        for name in ("load_mass", "stiffness_2", "length_5"):
            index = model.parameter_index(name)
            direction = catena.SensitivityDirection.parameter(model, index)
            along = catena.simulate_with_sensitivities(model, parameters, start, [direction], times)
            motion, change = along.trajectory, along.sensitivity[0]
            expected = motion.q[-1] @ change.q[-1] + motion.v[-1] @ change.v[-1] / 100
            scale = np.abs(motion.q[-1] * change.q[-1]).sum()
            self.assertAlmostEqual(run.gradient.parameters[index], expected, delta=5e-3 * scale)
        self.assertEqual(run.gradient.q.shape, (5,))
        with self.assertRaisesRegex(ValueError, "slope: array 1 has 1 x 5 entries; 3 times x 5"):
            catena.simulate_with_gradient(
                model, parameters, start, times, lambda motion: motion.q[:1]
            )
        with self.assertRaises(ZeroDivisionError):
            catena.simulate_with_gradient(model, parameters, start, times, lambda motion: 1 / 0)

    def test_a_batch_gives_what_each_alone_gives(self):
        model, parameters = cable(5)
        batch = [parameters * factor for factor in (1.0, 1.1, 1.2, 1.3, 1.4)]
        starts = [catena.straight(model, 0.1 * k) for k in range(5)]
        times = np.linspace(0, 0.3, 4)
        runs = catena.simulate_batch(model, batch, starts, times, threads=3)
        self.assertEqual(len(runs), 5)
        for run, p, start in zip(runs, batch, starts):
            alone = catena.simulate(model, p, start, times)
            self.assertEqual(run.status, "success")
            np.testing.assert_array_equal(run.trajectory.q, alone.trajectory.q)
        few = catena.simulate_batch(model, batch, starts, times, max_steps=3)
        self.assertEqual({run.status for run in few[1:]}, {"too many steps"})
        self.assertRegex(few[1].message, "t = ")
        with self.assertRaisesRegex(ValueError, "2.*5"):
            catena.simulate_batch(model, batch[:2], starts, times)

    def test_accelerations_row_by_row(self):
        model, parameters = cable(5)
        random = np.random.default_rng(1)
        q, v = random.uniform(-1, 1, (2, 11, 5))
        many = parameters * random.uniform(0.9, 1.1, (11, 1))
        a = catena.accelerations(model, many, q, v)
        self.assertEqual(a.shape, (11, 5))
        for k in range(11):  # a row alone, and the start of its motion
            alone = catena.accelerations(model, many[k : k + 1], q[k : k + 1], v[k : k + 1])
            np.testing.assert_array_equal(a[k], alone[0])
        start = catena.from_angles(model, q[3])
        start.v = v[3]
        tight = dict(relative_tolerance=1e-10, absolute_tolerance_velocity=1e-12)
        run = catena.simulate(model, many[3], start, [0.0, 1e-7], **tight)
        rate = (run.trajectory.v[1] - run.trajectory.v[0]) / 1e-7
        np.testing.assert_allclose(rate, a[3], rtol=2e-3, atol=2e-3 * np.abs(a[3]).max())
        with self.assertRaisesRegex(ValueError, "v: 10 x 5 entries; 11 x 5 are expected"):
            catena.accelerations(model, many, q, v[:10])
        many[9, model.parameter_index("mass_5")] = -1.0
        with self.assertRaisesRegex(ValueError, "mass_5 = -1 kg is below"):
            catena.accelerations(model, many, q, v)

    def test_internal_forces_hold_the_cable_at_rest(self):
        model, parameters = cable(7)
        weight = 9.81 * 0.1424 * 3.39 / 7
        run = catena.simulate(model, parameters, catena.straight(model, 0.0), [0.0, 0.1])
        moment, tension, curvature = catena.internal_forces(model, parameters, run.trajectory)
        hanging = 9.81 * 1.47 + weight * np.arange(7, 0, -1)
        np.testing.assert_allclose(tension, np.broadcast_to(hanging, (2, 7)), rtol=1e-12)
        np.testing.assert_array_equal(moment, np.zeros((2, 7)))
        np.testing.assert_array_equal(curvature, np.zeros((2, 7)))

    def test_internal_forces_are_springs_and_dampers_in_motion(self):
        model, parameters = cable(7)
        # a small swing: nothing pushes along the cable
        run = catena.simulate(model, parameters, catena.straight(model, 0.01), [0.0, 0.1, 0.2])
        moment, tension, curvature = catena.internal_forces(model, parameters, run.trajectory)
        bend = np.diff(run.trajectory.q, prepend=0.0)
        rate = np.diff(run.trajectory.v, prepend=0.0)
        np.testing.assert_allclose(moment, -47.448 * bend - 1e-3 * rate, atol=1e-12)
        spacing = 3.39 / 7 * np.where(np.arange(7) == 0, 0.5, 1.0)
        np.testing.assert_allclose(curvature, bend / spacing, atol=1e-12)
        self.assertTrue((tension > 0).all())

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

    def test_parameters_and_motions_are_of_the_model(self):
        model, parameters = cable()
        motion = catena.simulate(model, parameters, catena.straight(model, 0.5), [0, 0.1]).trajectory
        other = catena.Model(2)
        for call in (catena.positions, catena.internal_forces):
            with self.assertRaisesRegex(ValueError, "parameters: 1 values given"):
                call(model, np.zeros(1), motion)
            with self.assertRaisesRegex(ValueError, "coordinates and 0 states; the model has 2"):
                call(other, np.ones(len(other.parameter_names)), motion)
        for index in (-1, len(model.parameter_names)):
            with self.assertRaisesRegex(ValueError, "counted from 0"):
                catena.SensitivityDirection.parameter(model, index)

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
