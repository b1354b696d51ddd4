# SPDX-License-Identifier: BSD-3-Clause
"""The Python module: a case with its data, and its identification."""
import pathlib
import sys
import tempfile
import unittest

import catena
import numpy as np

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "faults"))
from cases import DATA, SWING  # noqa: E402

# Errors agree to some multiples of the integrator's relative tolerance, 1e-8: other frames, other
# steps.
CASE = pathlib.Path(__file__).resolve().parents[2] / "examples" / "first_cable" / "case.toml"
# Two links that swing for ever.
ENDLESS = SWING.replace("value = 0.005", "value = 0.0")
# The same with four unknowns: the more simulations a fit takes, the sooner it is known to be long.
UNKNOWN = '[[parameter]]\nname = "{0}"\nsets = "{0}"\nvalue = {1}\nunit = "{2}"\nfree = true\nlower = 0.0\nupper = 1.0\n'
FREE = (
    ENDLESS[: ENDLESS.index("[[parameter]]")]
    + "".join(UNKNOWN.format(f"stiffness_{i}", 0.1, "N m/rad") + UNKNOWN.format(f"damping_{i}", 0.0, "N m s/rad") for i in (1, 2))
    + ENDLESS[ENDLESS.index("[initial]") :]
    + '[optimiser]\nmethod = "nelder_mead"\n'
)
DATA = DATA.replace("swing.csv", "data.csv") + "[simulation]\nmax_steps = 1000000000\n"


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
        with self.assertRaisesRegex(catena.InputError, "is not UTF-8"):
            catena.Case("latin_\udce9.toml")
        with self.assertRaisesRegex(ValueError, "x: 1 values"):
            self.case.error([1.0])
        with self.assertRaisesRegex(ValueError, "experiment: 1"):
            self.case.predict(experiment=1)

    def test_large_work_is_to_be_asked_for(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "alone.toml").write_text(ENDLESS + "[simulation]\nduration = 1e8\nstep = 1e5\nmax_steps = 1000000000\n")
            with self.assertRaisesRegex(catena.InputError, "the simulation needs about .*large_work=True"):
                catena.Case(folder / "alone.toml").simulate()
            (folder / "many.toml").write_text(ENDLESS + "[simulation]\nduration = 1e3\nstep = 1e-4\n")
            many = catena.Case(folder / "many.toml")
            with self.assertRaisesRegex(catena.InputError, "keeping the motion needs about .* GB.*large_work=True"):
                many.simulate()
            rows = [f"{1e8 * k},0.28,0.41,0.56,0.83" for k in range(3)]
            (folder / "data.csv").write_text("\n".join(["time_s,side_1_m,down_1_m,side_2_m,down_2_m"] + rows))
            (folder / "fit.toml").write_text(FREE + DATA)
            slow = catena.Case(folder / "fit.toml")
            with self.assertRaisesRegex(catena.InputError, "the simulation needs about .*large_work=True"):
                slow.simulate()
            with self.assertRaisesRegex(catena.InputError, "the identification needs more than .*large_work=True"):
                slow.identify()
            with self.assertRaisesRegex(catena.InputError, "the diagnosis needs more than .*large_work=True"):
                catena.diagnose(folder / "fit.toml")
            (folder / "model.toml").write_text('format = 1\nkind = "model"\nid = "m"\neffects = ["pivot_damping", "joint_hysteresis"]\n')
            (folder / "long.toml").write_text(
                ENDLESS.replace("links = 2", 'links = 10000\ndescription = "model.toml"')
            )
            with self.assertRaisesRegex(catena.InputError, "deriving needs about .*large_work=True"):
                catena.Case(folder / "long.toml")
            alone = ENDLESS + "[simulation]\nduration = 1e8\nstep = 1e5\nmax_steps = 100000\n"
            (folder / "alone.toml").write_text(alone)
            with self.assertRaisesRegex(catena.ComputationError, "max_steps"):
                catena.Case(folder / "alone.toml").simulate(large_work=True)


if __name__ == "__main__":
    unittest.main()
