# SPDX-License-Identifier: BSD-3-Clause
"""What make_recording is called with."""

import random
import subprocess

from power import design


def cable(setup):
    """Options of the cable and the camera of a set-up ("": the cable of most trials), by their names."""
    return design.CABLE | (design.SETUPS[setup].cable if setup else {})


def of_effect(name, amplitude):
    """Options that hide one effect."""
    scaled, fixed, _ = {**design.EFFECTS, **design.OUTSIDE}[name]
    values = dict(fixed)
    for parameter, factor in scaled.items():
        if name == "axial_stretch":
            values[parameter] = 1000 / amplitude
        elif name == "scale":
            values[parameter] = 1 + amplitude
        else:
            values[parameter] = factor * amplitude
    return [word for parameter, value in values.items() for word in ("--effect", f"{name}.{parameter}={value:.6g}")]


def _knowns(trial):
    """Options that make the case wrong, up or down as the seed has it."""
    wrong = dict(design.WRONG_KNOWNS) if trial.dirt in ("rod_knowns", "rod_all") else {}
    if trial.kind == "known":
        (name,) = trial.hidden
        if name == "marks":
            return ["--misplaced", str(trial.off)]
        wrong[name] = trial.off
    drawn = random.Random(trial.seed)
    return [word for name, share in wrong.items() for word in ("--stated", f"{name}={drawn.choice([-1, 1]) * share}")]


def make(trial, effects, folder, binaries, films=None, case_links=None):
    """Films a trial with the options of its effects into a folder. `films`: where motions are kept, to be
    filmed again with other noise; `case_links`: instead of the set-up's. Returns whether it could be filmed."""
    setup = design.SETUPS.get(trial.setup)
    command = [binaries / "bin" / "make_recording", "--output", folder]
    command += [word for option, values in cable(trial.setup).items() for word in (option, *values.split())]
    if "--links" not in command:
        command += ["--links", str(trial.links)]
    command += ["--case-links", str(case_links or (setup.links if setup else 12)), "--noise", str(trial.noise),
                "--rate", str(trial.rate), "--seed", str(trial.seed), "--lost", str(trial.lost),
                "--pixel", str(trial.pixel), *(["--rod"] if trial.is_rod() else []),
                *(design.DIRT | design.ROD).get(trial.dirt, []), *_knowns(trial), *effects,
                *(["--films", films] if films else [])]
    return subprocess.run(command, capture_output=True, check=False).returncode == 0
