# SPDX-License-Identifier: BSD-3-Clause
"""The Python module: diagnosis of a case."""
import json
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import catena
import numpy as np

CASE = """
format = 1
kind = "case"
title = "Four links that lack nothing"
[model]
links = 4
[cable]
length = 1.0
density = 0.1
load_mass = 0.2
[[parameter]]
name = "EI"
sets = "bending_stiffness"
value = 0.02
unit = "N m^2"
free = true
lower = 1e-4
upper = 1.0
[[parameter]]
name = "damping"
sets = "damping_length"
value = 0.004
unit = "N m^2 s/rad"
free = true
lower = 1e-5
upper = 1.0
[initial]
shape = "smooth"
terms = 4
free = true
[[experiment]]
name = "recording"
data = "markers.csv"
kind = "markers"
fit_until = 1.4
[error]
measure = "least_squares"
[optimiser]
method = "least_squares"
"""


def record(folder):
    """The case's own model moves, and every joint is seen with 1 mm of noise."""
    (folder / "case.toml").write_text(CASE)
    times = np.arange(121) / 60
    hanging = [0, 0.25, 0, 0.5, 0, 0.75, 0, 1.0]  # a case refuses what no cable can do
    write(folder, times, np.tile(hanging, (121, 1)))
    case = catena.Case(folder / "case.toml")
    model, parameters = case.model, case.model_parameters()
    start = catena.from_angles(model, [0.3, 0.4, 0.5, 0.6])
    run = catena.simulate(model, parameters, start, times)
    places = np.stack(catena.positions(model, parameters, run.trajectory), 2)[:, 1:5].reshape(121, 8)
    places += np.random.default_rng(1).normal(0, 1e-3, places.shape)
    write(folder, times, places)
    return folder / "case.toml"


def write(folder, times, places):
    np.savetxt(
        folder / "markers.csv",
        np.column_stack([times, places]),
        delimiter=",",
        comments="",
        header="time_s," + ",".join(f"side_{i}_m,down_{i}_m" for i in range(1, 5)),
    )


def written(diagnosis, folder):
    """The files that it writes, by name."""
    diagnosis.write(folder)
    return {
        file.relative_to(folder): file.read_text() for file in folder.rglob("*") if file.is_file()
    }


class Diagnoses(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.case = record(pathlib.Path(cls.folder.name))
        cls.lines, cls.ticks = [], 0
        done = threading.Event()

        def tick():
            while not done.wait(0.01):
                cls.ticks += 1

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        cls.found = catena.diagnose(cls.case, progress=cls.lines.append)
        cls.seconds = time.monotonic() - begin
        done.set()
        thread.join()

    def test_nothing_is_missing(self):
        found = self.found
        self.assertEqual(found.verdict, "none")
        self.assertEqual(found.effects, [])
        self.assertEqual(found.undecided, [])
        self.assertIn(found.sentence, str(found))
        self.assertLess(found.gap.fit, 1.2 * found.gap.noise_level)
        self.assertLess(found.gap.held_out, 1.35 * found.gap.noise_level)
        self.assertLess(found.gap.sealed, 1.35 * found.gap.noise_level)
        stiffness = next(p for p in found.parameters if p.name == "EI")
        self.assertEqual(stiffness.unit, "N m^2")
        self.assertLess(stiffness.standard_error, 0.1 * stiffness.value)

    def test_a_law_is_sought_where_the_gap_closes_if_asked_for(self):
        self.assertNotIn("missing_force", self.found.document())
        sought = catena.diagnose(self.case, discover=True)
        self.assertEqual(sought.verdict, "none")
        self.assertIn("missing_force", sought.document())

    def test_other_threads_run_meanwhile_and_progress_is_told(self):
        self.assertGreater(self.ticks, self.seconds / 0.2)
        self.assertIn("fitting the baseline", self.lines)

    def test_the_document_is_what_is_written(self):
        document = self.found.document()
        self.assertEqual(document["verdict"], "none")
        with tempfile.TemporaryDirectory() as folder:
            self.found.write(folder)
            written = json.loads((pathlib.Path(folder) / "diagnosis.json").read_text())
            self.assertEqual(written, document)
            diagnosed = catena.Case(pathlib.Path(folder) / "diagnosed.toml")
            self.assertAlmostEqual(
                diagnosed.error(), self.found.gap.fit, delta=0.2 * self.found.gap.fit
            )

    def test_what_progress_raises_comes_back(self):
        def stop(_):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "^enough$"):
            catena.diagnose(self.case, progress=stop)

    def test_errors(self):
        with self.assertRaisesRegex(catena.InputError, "no_such.toml"):
            catena.diagnose("no_such.toml")
        with self.assertRaisesRegex(ValueError, "max_links"):
            catena.diagnose(self.case, max_links=0)
        with self.assertRaisesRegex(catena.InputError, "no_effect.toml"):
            catena.diagnose(self.case, effects=["no_effect.toml"])

    def test_control_c(self):
        program = (
            "import catena\n"
            f"catena.diagnose({str(self.case)!r}, progress=lambda line: print(line, flush=True))\n"
        )
        process = subprocess.Popen(
            [sys.executable, "-c", program], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
        )
        self.assertEqual(process.stdout.readline(), "fitting the baseline\n")
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=120)
        self.assertIn("KeyboardInterrupt", errors)


class FindsWhatIsMissing(unittest.TestCase):
    def test_drag_hidden_in_36_links_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(
                [os.environ["CATENA_BINARIES"] + "/bin/make_recording", "--output", folder]
                + "--links 36 --case-links 12 --duration 3 --rate 60 --length 1.2".split()
                + "--bending-stiffness 0.1 --bending-damping 0.01 --load 0.2 --held 0.6 0.9".split()
                + ["--effect", "air_drag_quadratic.normal=0.05"],
                check=True,
                stdout=subprocess.DEVNULL,
            )
            found = catena.diagnose(pathlib.Path(folder, "case.toml"))
            again = pickle.loads(pickle.dumps(found))
            files = written(found, pathlib.Path(folder, "found"))
            self.assertIn(pathlib.Path("model.toml"), files)
            self.assertEqual(written(again, pathlib.Path(folder, "again")), files)
            again.report(folder + "/report.html")
            self.assertIn("air_drag_quadratic", pathlib.Path(folder, "report.html").read_text())
        self.assertEqual(str(again), str(found))
        self.assertEqual(again.parameters, found.parameters)
        self.assertEqual(found.verdict, "named")
        self.assertEqual(found.effects, ["air_drag_quadratic"])
        self.assertLess(found.gap.held_out, 1.2 * found.gap.noise_level)
        drag = next(p for p in found.parameters if p.name == "air_drag_quadratic.normal")
        self.assertAlmostEqual(drag.value, 0.05, delta=3 * drag.standard_error)


if __name__ == "__main__":
    unittest.main()
