# SPDX-License-Identifier: BSD-3-Clause
"""The Python module: recordings as arrays, other optimisers, errors, simulation of cases, pickles, reports."""
import contextlib
import io
import pathlib
import pickle
import tempfile
import unittest
import warnings

import catena
import numpy as np

CASE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "first_cable" / "case.toml"
CSV = CASE.parent / "markers.csv"


def columns():
    """The recording as a dict of columns."""
    table = np.genfromtxt(CSV, delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names}


class Frame:
    """What a pandas.DataFrame is to the module, where pandas is not installed."""

    def __init__(self, data):
        self.data, self.columns = data, list(data)

    def __getitem__(self, name):
        return self.data[name]


class Recordings(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.file = catena.Case(CASE)
        cls.name = cls.file.experiments[0].name
        cls.columns = columns()
        cls.array = np.column_stack(list(cls.columns.values()))

    def case(self, recording):
        return catena.Case(CASE, {self.name: recording})

    def test_arrays_are_read_as_the_file_is(self):
        structured = np.genfromtxt(CSV, delimiter=",", names=True)
        for recording in (self.columns, Frame(self.columns), structured, self.array):
            experiment = self.case(recording).experiments[0]
            np.testing.assert_array_equal(experiment.measured, self.file.experiments[0].measured)
            np.testing.assert_array_equal(experiment.time, self.file.experiments[0].time)
            self.assertEqual(experiment.fit_frames, self.file.experiments[0].fit_frames)

    def test_a_case_needs_no_file(self):
        with tempfile.TemporaryDirectory() as folder:
            case = pathlib.Path(folder) / "case.toml"
            case.write_text(CASE.read_text())
            with self.assertRaisesRegex(catena.InputError, "there is no such file"):
                catena.Case(case)
            found = catena.Case(case, {self.name: self.columns})
            self.assertEqual(found.error(), self.file.error())

    def test_they_are_checked_as_files_are(self):
        millimetres = self.array.copy()
        millimetres[:, 1:] *= 1000
        with self.assertRaisesRegex(catena.InputError, 'length_unit = "mm" would fit'):
            self.case(millimetres)
        with self.assertWarnsRegex(UserWarning, "vertical: on average the cable points upwards"):
            self.case(self.array * np.array([1] + [1, -1] * 4))
        wild = self.array.copy()
        wild[40, 5] += 0.4
        with self.assertWarnsRegex(UserWarning, r"1 outlier is left out of recordings.*\(row 40, off by"):
            case = self.case(wild)
        self.assertTrue(np.isnan(case.experiments[0].measured[40, 4]))
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.case(self.array)

    def test_mistakes(self):
        for recording, text in (
            (self.array[:, :4], "a row for each frame"),
            ({"time_s": [0, 1], "side_1_m": [1]}, '"side_1_m" has 1 values, "time_s" 2'),
            ({"time_s": ["a"]}, '"time_s" is not an array of numbers'),
            ({"t": [0.0, 1.0], "x": [0.0, 0.0]}, "it has t and x"),
        ):
            with self.assertRaisesRegex(ValueError, text):
                self.case(recording)
        with self.assertRaisesRegex(catena.InputError, '"flim" is no'):
            catena.Case(CASE, {"flim": self.array})

    def test_a_diagnosis_takes_them_too(self):
        found = catena.diagnose(CASE, {self.name: self.columns}, max_effects=0, max_links=12)
        self.assertEqual(found.verdict, "none")
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder) / "report.html"
            found.report(report)
            self.assertIn("No missing effect", report.read_text())


class Fits(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = catena.Case(CASE)
        cls.said = io.StringIO()
        with contextlib.redirect_stdout(cls.said):
            cls.found = cls.case.identify(catena.show_progress)

    def test_progress_is_shown_in_one_line(self):
        self.assertRegex(self.said.getvalue(), r"^\revaluation \d+ of at most \d+, error")
        self.assertNotIn("\n", self.said.getvalue())

    def test_the_jacobian_is_the_derivative_of_the_residuals(self):
        x = self.case.start
        jacobian = self.case.jacobian(x)
        self.assertEqual(jacobian.shape, (len(self.case.residuals(x)), len(x)))
        for j in range(len(x)):
            step = np.zeros(len(x))
            step[j] = 4e-3 * max(abs(x[j]), 1e-2)  # well above the noise of a simulation
            near, far = (self.case.residuals(x + k * step) - self.case.residuals(x - k * step) for k in (1, 2))
            slope = (8 * near - far) / (12 * step[j])  # of fourth order
            size = np.abs(jacobian[:, j]).max()
            np.testing.assert_allclose(jacobian[:, j], slope, atol=1e-2 * size)

    def test_errors_are_those_of_least_squares(self):
        found = self.found
        errors, covariance = found.standard_errors, found.covariance
        np.testing.assert_allclose(np.sqrt(np.diag(covariance)), errors)
        np.testing.assert_allclose(covariance, covariance.T)
        low, high = found.intervals.T
        self.assertTrue(((low < found.x) & (found.x < high)).all())
        jacobian, residuals = self.case.jacobian(found.x), self.case.residuals(found.x)
        white = np.linalg.inv(jacobian.T @ jacobian) * (residuals @ residuals) / (
            len(residuals) - len(found.x)
        )
        # The residuals are not white, which widens the errors.
        ratio = errors / np.sqrt(np.diag(white))
        self.assertTrue(((ratio > 0.5) & (ratio < 10)).all(), ratio)

    def test_scipy_finds_the_same(self):
        try:
            from scipy.optimize import least_squares
        except ImportError:
            self.skipTest("SciPy is not installed")
        case = self.case
        found = least_squares(
            case.residuals, case.start, jac=case.jacobian, bounds=case.bounds, x_scale="jac"
        )
        self.assertTrue(found.success)
        self.assertAlmostEqual(case.error(found.x) / self.found.error, 1, places=4)
        np.testing.assert_allclose(found.x[:2], self.found.x[:2], rtol=1e-3)

    def test_pickles(self):
        again = pickle.loads(pickle.dumps(self.found))
        np.testing.assert_array_equal(again.x, self.found.x)
        self.assertEqual(again.unknowns, self.found.unknowns)
        self.assertEqual(again.status, self.found.status)
        np.testing.assert_array_equal(again.standard_errors, self.found.standard_errors)
        self.assertEqual([g.rms for g in again.gaps], [g.rms for g in self.found.gaps])
        name = self.case.experiments[0].name
        case = pickle.loads(pickle.dumps(catena.Case(CASE, {name: columns()})))
        self.assertEqual(case.error(), self.case.error())
        model = catena.Model(7)
        self.assertEqual(pickle.loads(pickle.dumps(model)).links, 7)
        state = catena.straight(model, 0.3)
        np.testing.assert_array_equal(pickle.loads(pickle.dumps(state)).q, state.q)
        run = self.case.simulate()
        copy = pickle.loads(pickle.dumps(run))
        np.testing.assert_array_equal(copy.trajectory.q, run.trajectory.q)
        self.assertEqual((copy.status, copy.statistics.steps), (run.status, run.statistics.steps))

    def test_events(self):
        effect = '''format = 1
kind = "effect"
id = "watch"
title = "Watch"
description = "Tells when the load is plumb"
[[event]]
name = "plumb"
unit = "m"
at = "load"
value = "side"
'''
        model = 'format = 1\nkind = "model"\nid = "watched"\neffects = ["watch.toml"]\n'
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "watch.toml").write_text(effect)
            (folder / "watched.toml").write_text(model)
            file = folder / "case.toml"
            file.write_text(CASE.read_text().replace("[model]", '[model]\ndescription = "watched.toml"'))
            run = catena.Case(file, {self.case.experiments[0].name: columns()}).simulate()
        self.assertTrue(run.events)
        times = [time for time, _, _ in run.events]
        self.assertEqual(times, sorted(times))
        self.assertEqual({name for _, name, _ in run.events}, {"watch.plumb"})
        rises = [rises for _, _, rises in run.events]
        self.assertEqual(rises, [rises[0] == (k % 2 == 0) for k in range(len(rises))])
        self.assertEqual(pickle.loads(pickle.dumps(run)).events, run.events)

    def test_estimated_noise(self):
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "case.toml"
            squares = 'measure = "least_squares"'
            file.write_text(CASE.read_text().replace(squares, f'{squares}\nnoise = "estimated"'))
            found = catena.Case(file, {self.case.experiments[0].name: columns()}).identify()
        self.assertAlmostEqual(found.error, 1, delta=0.1)  # in units of the noise, no more in metres
        self.assertGreater(found.evaluations, self.found.evaluations)
        np.testing.assert_allclose(found.x[:2], self.found.x[:2], rtol=0.05)
        again = pickle.loads(pickle.dumps(found))
        np.testing.assert_array_equal(again.standard_errors, found.standard_errors)

    def test_report(self):
        with tempfile.TemporaryDirectory() as folder:
            report = pathlib.Path(folder) / "report.html"
            pickle.loads(pickle.dumps(self.found)).report(report)
            self.assertIn("Fitted parameters", report.read_text())


class Simulations(unittest.TestCase):
    def test_a_case_with_an_effect_and_without_a_recording(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "model.toml").write_text(
                'format = 1\nkind = "model"\nid = "dragged"\neffects = ["air_drag_quadratic"]\n'
            )
            text = (
                'format = 1\nkind = "case"\n[model]\nlinks = 4\ndescription = "model.toml"\n'
                "[cable]\nlength = 1.0\ndensity = 0.3\nload_mass = 0.2\n"
                '[[parameter]]\nname = "k"\nsets = "stiffness"\nvalue = 0.1\n'
                '[[parameter]]\nname = "c"\nsets = "damping"\nvalue = 0.005\n'
                '[[parameter]]\nname = "drag"\nsets = "air_drag_quadratic.normal"\nvalue = DRAG\n'
                '[initial]\nshape = "straight"\nangle = 0.6\n'
                "[simulation]\nduration = 2.0\nstep = 0.05\n"
            )
            swings = []
            for drag in ("0.0", "0.5"):
                (folder / "case.toml").write_text(text.replace("DRAG", drag))
                case = catena.Case(folder / "case.toml")
                run = case.simulate()
                self.assertEqual(run.status, "success")
                np.testing.assert_allclose(run.trajectory.time, np.arange(41) * 0.05)
                side, _ = catena.positions(case.model, case.model_parameters(), run.trajectory)
                swings.append(np.abs(side[20:, -1]).max())
            self.assertLess(swings[1], 0.9 * swings[0])
            (folder / "case.toml").write_text(text.replace("DRAG", "0.1").replace("duration = 2.0\n", ""))
            with self.assertRaisesRegex(catena.InputError, "simulation.duration"):
                catena.Case(folder / "case.toml").simulate()

    def test_positions_in_space_have_three_components(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "model.toml").write_text('format = 1\nkind = "model"\nid = "chain"\nspace = "3d"\n')
            (folder / "case.toml").write_text(
                'format = 1\nkind = "case"\n[model]\nlinks = 2\ndescription = "model.toml"\n'
                "[cable]\nlength = 1.0\ndensity = 0.3\nload_mass = 0.2\n"
                '[[parameter]]\nname = "k"\nsets = "stiffness"\nvalue = 0.1\n'
                '[[parameter]]\nname = "c"\nsets = "damping"\nvalue = 0.005\n'
                '[initial]\nshape = "straight"\nangle = 0.6\nazimuth = 0.4\n'
                "[simulation]\nduration = 1.0\nstep = 0.1\n"
            )
            case = catena.Case(folder / "case.toml")
            run = case.simulate()
            side, down, across = catena.positions(case.model, case.model_parameters(), run.trajectory)
            self.assertEqual(across.shape, (11, 4))
            np.testing.assert_allclose(across, side * np.tan(0.4), atol=1e-7)
            distance = np.sqrt(side[:, 1] ** 2 + down[:, 1] ** 2 + across[:, 1] ** 2)
            np.testing.assert_allclose(distance, 0.5, rtol=1e-12)

    def test_any_number_of_links(self):
        model = catena.Model(17)
        parameters = model.parameters(
            length=0.1, mass=0.01, inertia=1e-5, stiffness=0.1, damping=1e-3, load_mass=0.2
        )
        run = catena.simulate(model, parameters, catena.straight(model, 0.2), [0, 0.5])
        self.assertEqual(run.trajectory.q.shape, (2, 17))


if __name__ == "__main__":
    unittest.main()
