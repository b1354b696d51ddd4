# SPDX-License-Identifier: BSD-3-Clause
"""Common to the studies of cables whose two ends are moved by hands: recordings, cases and errors."""

import csv
import os
import sys

import numpy as np
from command_line import ROOT

CABLES = ["1", "2", "3", "4"]
FOLDS = 3  # every run is left out once, with the third one after it
MARK = 0.02  # kg
HELD = ["first", "second", "last_but_one", "last"]
GRIPS = ["askew_first", "askew_last", "tilt_first", "tilt_last"]
THIRDS = ["bend_begin", "bend_middle", "bend_end"]
STARTING = slice(4, 7)  # of the first frames, which catena finds a start from, the last three
ON_ERROR = """[error]
measure = "mean_absolute"

[optimiser]
method = "nelder_mead"
tolerance = 1e-3  # of the error
"""
BY_SQUARES = """[error]
measure = "least_squares"

[optimiser]
method = "least_squares"
"""

DATA = os.environ.get("CATENA_DATA", os.path.join(os.path.dirname(ROOT), "shared", "data"))
if not os.path.isdir(f"{DATA}/deform_dlo1"):
    sys.exit(f"{sys.argv[0]}: no folder deform_dlo1 in {DATA}; CATENA_DATA names the folder of the recordings")


def runs_of(cable):
    """Of every run of a cable: its file and the positions in it, frames x marks x 3."""
    folder = f"{DATA}/deform_dlo{cable}"
    found = {}
    for name in sorted(os.listdir(folder), key=lambda name: int("".join(filter(str.isdigit, name)))):
        table = np.genfromtxt(f"{folder}/{name}", delimiter=",", skip_header=1)
        found[f"{folder}/{name}"] = table[:, 1:].reshape(len(table), -1, 3)
    return found


def experiment(path, marks, use, until):
    """A run: the marks between the ends and the held one, and the hands as signals."""
    held = dict(zip(HELD, (1, 2, marks - 1, marks)))
    seen = ",\n  ".join(f'{{name = "mark {k}", side = "x_{k}_m", down = "z_{k}_m", across = "y_{k}_m", joint = {k - 2}}}'
                        for k in range(3, marks))
    text = f"""
[[experiment]]
name = "{os.path.basename(path)}"
data = "{path}"
kind = "markers"
markers = [{seen}]
vertical = "up"
use = "{use}"
{f"to = {until}" if until else ""}
"""
    for mark, number in held.items():
        for axis in "xyz":
            text += f"""
[[experiment.signal]]
name = "hands.{mark}_{axis}"
data = "{path}"
time = "time_s"
column = "{axis}_{number}_m"
"""
    return text


def settings(links):
    """Of every number of a cable of so many links: what it sets, its unit and bounds. Joint 1 is the clamp."""
    sets = {"EI": ("bending_stiffness", "N m^2", 1e-5, 1), "damping": ("damping_length", "N m^2 s/rad", 1e-7, 1),
            "firmness": ("hands.firmness", "1", 0.1, 10), "twisting": ("hands.twisting", "N m^2", 1e-6, 1),
            "roll": ("hands.roll", "rad", -6, 6)}  # fmt: skip
    sets |= {name: (f"hands.{name}", "1", -1.5, 1.5) for name in GRIPS}
    ends = [1, *(1 + round(k * (links - 1) / 3) for k in (1, 2, 3))]
    for name, first, last in zip(THIRDS, ends, ends[1:]):
        sets[name] = (f"hands.bend_{first + 1}..{last}", "rad", -1.5, 1.5)
    return sets


def parameters(runs, values, free=()):
    """The tables of a case that give the cable these values, of which `free` are fitted."""
    sets = settings(next(iter(runs.values())).shape[1] - 3)
    text = ""
    for name, value in values.items():
        parameter, unit, lower, upper = sets[name]
        text += f'\n[[parameter]]\nname = "{name}"\nsets = "{parameter}"\nvalue = {value}\nunit = "{unit}"\n'
        if name in free:
            text += f"free = true\nlower = {lower}\nupper = {upper}\n"
    return text


def case(runs, fitted, of_cable, model, how=ON_ERROR, until=None):
    """The case of one cable with these tables of parameters. `model`: the path of its description; `how` it is fitted
    to the runs `fitted`; all runs end at `until`, s, if it is given."""
    lengths = np.mean([np.linalg.norm(np.diff(runs[path], axis=1), axis=2).mean(0) for path in fitted], axis=0)[1:-1]
    marks = len(lengths) + 3
    density = MARK * marks / lengths.sum()
    text = f"""format = 1
kind = "case"

[model]
description = "{model}"
links = {len(lengths)}

[cable]
link_lengths = [{", ".join(f"{length:.5f}" for length in lengths)}]
link_masses = [{", ".join(f"{density * length:.6f}" for length in lengths)}]

[initial]
shape = "angles"
velocity = {{shape = "angles"}}

{how}
[simulation]  # errors of 0.01 mm
relative_tolerance = 1e-4
absolute_tolerance_position = 1e-5
absolute_tolerance_velocity = 1e-4
{of_cable}"""
    for path in runs:
        text += experiment(path, marks, "fit" if path in fitted else "validate", until)
    return text


def residuals(folder, runs):
    """Of every run: simulated minus measured, m, coordinates x frames; the four marks that are held have none."""
    series = {}
    with open(f"{folder}/residuals.csv") as file:
        for row in csv.DictReader(file):
            of_run = series.setdefault(row["experiment"], {})
            of_run.setdefault((row["point"], row["component"]), []).append(float(row["residual"]))
    return {path: np.array(list(series[os.path.basename(path)].values())) for path in runs}


def carried(misfit):
    """The misfit without what of it was there in the first frames."""
    corrected = misfit.copy()
    corrected[:, STARTING.stop:] -= misfit[:, STARTING].mean(1, keepdims=True)
    return corrected


def error(misfit, run):
    """Mean absolute error of a coordinate, mm."""
    return 1e3 * np.abs(misfit).sum() / run.size


def parted(runs, fold):
    """The runs that this fold, from 0 on, leaves out, and those that it is fitted to."""
    left_out = list(runs)[fold::FOLDS]
    return left_out, [path for path in runs if path not in left_out]
