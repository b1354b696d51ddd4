# SPDX-License-Identifier: BSD-3-Clause
"""The Python module: a case with its data, and its identification."""
import pathlib
import tempfile
import unittest

import catena
import numpy as np

# Errors agree to some multiples of the integrator's relative tolerance, 1e-8: other frames, other
# steps.
CASE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "first_cable" / "case.toml"


class Cases(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.case = catena.Case(CASE)

    def test_what_is_to_be_found(self):
        self.assertEqual(self.case.unknowns[:2], ["EI", "damping"])
        self.assertEqual(len(self.case.start), len(self.case.unknowns))
        experiment = self.case.experiments[0]
        self.assertEqual(experiment.measured.shape, (len(experiment.time), 8))
        self.assertTrue(np.shares_memory(experiment.measured, self.case.experiments[0].measured))

    def test_the_error_is_that_of_the_prediction(self):
        experiment = self.case.experiments[0]
        residual = (self.case.predict() - experiment.measured)[: experiment.fit_frames]
        self.assertAlmostEqual(self.case.error(), np.sqrt(np.mean(residual**2)), places=7)

    def test_identify(self):
        calls = []
        found = self.case.identify(lambda *made: calls.append(made))
        self.assertEqual(found.status, "converged")
        self.assertLess(found.error, 0.1 * found.start_error)
        self.assertAlmostEqual(found.error, self.case.error(found.x), places=7)
        self.assertEqual([gap.part for gap in found.gaps], ["fit", "validate"])
        self.assertLess(found.gaps[1].rms, 0.003)
        self.assertGreater(len(calls), 5)
        with tempfile.TemporaryDirectory() as folder:
            again = pathlib.Path(folder) / "again.toml"
            again.write_text(found.case_text(folder))
            self.assertAlmostEqual(catena.Case(again).error(), found.error, places=7)

    def test_what_progress_raises_comes_back(self):
        def stop(*_):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            self.case.identify(stop)

    def test_errors(self):
        with self.assertRaisesRegex(catena.InputError, "no_such.toml"):
            catena.Case("no_such.toml")
        with self.assertRaisesRegex(ValueError, "x: 1 values"):
            self.case.error([1.0])
        with self.assertRaisesRegex(ValueError, "experiment: 1"):
            self.case.predict(experiment=1)


if __name__ == "__main__":
    unittest.main()
