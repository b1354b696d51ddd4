# SPDX-License-Identifier: BSD-3-Clause
"""Common to the studies: cases, runs of catena and tables."""
import concurrent.futures
import csv
import json
import os
import re
import shutil
import subprocess
import sys

import command_line
import numpy as np
from command_line import ROOT


def folders(study):
    said = command_line.of_study(study)
    return said.output, said.binaries


class Failed(Exception):
    """Runs a command and returns its output; a failure ends the study."""


def read(path):
    with open(path) as file:
        return file.read()


def write(path, text):
    with open(path, "w") as file:
        file.write(text)


def sections(text):
    """A file of TOML in pieces, each from one [table] or [[table]] to the next."""
    return re.split(r"(?m)^(?=\[)", text)


def copy_cases_of_recordings(output):
    """scripts/recordings into OUTPUT/recordings, with the recordings of $CATENA_DATA, or of ../shared/data beside the checkout."""
    data = os.environ.get("CATENA_DATA", os.path.join(os.path.dirname(ROOT), "shared", "data"))
    if not os.path.isdir(data):
        print(f"{sys.argv[0]}: no recordings in {data}; CATENA_DATA names their folder", file=sys.stderr)
        sys.exit(2)
    shutil.copytree(f"{ROOT}/scripts/recordings", f"{output}/recordings", dirs_exist_ok=True)
    for case in os.listdir(f"{output}/recordings"):
        path = f"{output}/recordings/{case}"
        write(path, read(path).replace('"../../../shared/data/', f'"{data}/'))


def run(*command):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise Failed(f"{' '.join(command)}\n{done.stdout}")
    return done.stdout


def simulate(binaries, case, output):
    run(f"{binaries}/bin/catena", "simulate", case, "--output", output, "-q")


class Fit:
    """A run of catena identify: its result.json and the processor time of the fit."""

    def __init__(self, binaries, case, output):
        self.binaries, self.case, self.output = binaries, case, output
        self.cpu_seconds = self.run()
        with open(f"{output}/result.json") as file:
            self.result = json.load(file)
        self.optimiser = self.result["optimiser"]
        self.evaluations = self.optimiser["evaluations"]
        self.error = self.optimiser["error"]
        self.errors = self.optimiser["history"]["error"]
        self.unknowns = {p["name"]: p for p in self.result["parameters"] if p["free"]}

    def run(self):
        """Processor time of the fit, s."""
        printed = run(f"{self.binaries}/bin/catena", "identify", self.case, "--output", self.output,
                      "--threads", "1")  # fmt: skip
        return float(re.search(r"([\d.]+) s of a core", printed)[1])

    def measure(self):
        """Measures a short fit seven times; its time becomes the median."""
        if self.cpu_seconds < 0.2:
            self.cpu_seconds = sorted(self.run() for _ in range(7))[3]

    def to_reach(self, error):
        """The run of fewest evaluations (the limit holds for every beginning) that bisection finds to
        end at no more than this error; None if the whole run does not."""
        if self.error > error:
            return None
        with open(self.case) as file:
            text = file.read()
        case = f"{self.case.removesuffix('.toml')}_to_reach.toml"
        reached, short, long = self, 0, self.evaluations
        while long - short > 1:
            limit = (short + long) // 2
            with open(case, "w") as file:
                file.write(text.replace('"least_squares"\n', f'"least_squares"\nmax_evaluations = {limit}\n'))
            try:
                shorter = Fit(self.binaries, case, f"{self.output}_to_reach")
            except Failed:  # stopped so soon, a fit may not leave its start
                shorter = None
            if shorter and shorter.error <= error:
                reached, long = shorter, limit
            else:
                short = limit
        return reached


def columns(path):
    """Columns of a CSV file by name."""
    with open(path, newline="") as file:
        rows = list(csv.reader(file))
    values = np.array([[float(field) for field in row] for row in rows[1:]])
    return dict(zip(rows[0], values.T))


def table(title, head, rows):
    """Prints columns aligned, the first to the left."""
    cells = [head] + [[f"{c:.4g}" if isinstance(c, float) else str(c) for c in r] for r in rows]
    widths = [max(len(row[k]) for row in cells) for k in range(len(head))]
    print(f"\n{title}")
    for row in cells:
        print("  ".join(c.ljust(w) if k == 0 else c.rjust(w)
                        for k, (c, w) in enumerate(zip(row, widths))).rstrip())  # fmt: skip


def compare_methods(title, runs):
    """Nelder-Mead beside least squares; `runs`: what was fitted -> (simplex, least squares)."""
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        shorter = list(pool.map(lambda run: run[1].to_reach(run[0].error), runs.values()))
    rows = []
    for (name, (simplex, squares)), reached in zip(runs.items(), shorter):
        for fit in (simplex, squares, *([reached] if reached else [])):
            fit.measure()
        rows.append([name, simplex.evaluations, simplex.cpu_seconds, simplex.error,
                     *([reached.evaluations, reached.cpu_seconds] if reached else ["-", "-"]),
                     simplex.cpu_seconds / reached.cpu_seconds if reached else "-",
                     squares.evaluations, squares.cpu_seconds, squares.error])  # fmt: skip
    table(title, ["", "Nelder-Mead", "s", "error", "to that error", "s", "time ratio",
                  "to its end", "s", "error"], rows)  # fmt: skip
    print("Evaluations, processor time and error of Nelder-Mead, then of least squares on the same\n"
          "measure, stopped where it has that error or less, and to its end.")  # fmt: skip
