# SPDX-License-Identifier: BSD-3-Clause
"""How large an effect must be to leave so much in the residual of a refitted baseline."""

import csv
import json
import math
import pathlib
import re
import subprocess
import tempfile
import threading

from power import design, film

RESOLVED, LARGEST = 1e-4, 0.03  # m, of the cable of 1.2 m: below the first a curve tells nothing, more is not asked for
STEPS = 12  # of the amplitude, half a decade each
LINKS = 24  # of the recordings measured, and of their baselines: what is left is the effect alone


def _size(setup):
    """Of the cable, over that of most trials."""
    return design.SETUPS[setup].length() / float(design.CABLE["--length"]) if setup else 1.0


def _start_at_truth(case, cable):
    """Far from it, a fit to a short and stiff cable ends in another minimum."""
    text = case.read_text()
    for sets, option in (("bending_stiffness", "--bending-stiffness"), ("damping_length", "--bending-damping")):
        text = re.sub(rf'(sets = "{sets}"\n(?:unit = .*\n)?)value = .*', rf"\g<1>value = {float(cable[option])}", text)
    case.write_text(text)


class Strengths:
    """Amplitudes by effect and residual; measured once, kept in a file. Without binaries they are only read."""

    def __init__(self, file, binaries=None):
        self.binaries, self.file, self.lock = binaries, pathlib.Path(file), threading.Lock()
        self.curves, self.locks = {}, {}
        self.add(self.file)

    def add(self, file):
        """What another part of the study measured; the same effect has the same curve there."""
        if not file.exists():
            return
        curves = {}
        with file.open() as lines:
            for row in csv.DictReader(lines):
                curves.setdefault(row["effect"], []).append(
                    (float(row["amplitude"]), float(row["residual_m"])))
        self.curves |= curves

    def amplitude(self, name, residual, links, setup=""):
        """The amplitude whose recording with so many links leaves so much (m, rms); None if none
        within bounds does."""
        own = setup if setup and design.SETUPS[setup].own_strengths else ""
        amplitude = self.amplitude_at_links_measured(name, residual, own)
        if amplitude is None:
            return None
        return amplitude * (links / LINKS) ** design.JOINT_POWERS.get(name, 0)

    def amplitude_at_links_measured(self, name, residual, setup):
        label = f"{setup}: {name}" if setup else name
        with self.lock:
            own = self.locks.setdefault(label, threading.Lock())
        with own:
            if label not in self.curves:
                curve = self.measure(name, setup)
                with self.lock:
                    self.curves[label] = curve
                    self.write()
        previous = None
        for amplitude, left in self.curves[label]:
            if left >= residual and previous is not None:
                a0, r0 = previous
                share = math.log(residual / r0) / math.log(left / r0)
                return a0 * (amplitude / a0) ** share
            if RESOLVED * _size(setup) < left < residual:
                previous = (amplitude, left)
        return None

    def measure(self, name, setup):
        """Residuals of the baseline from small amplitudes upwards, as far as they grow."""
        most = {**design.EFFECTS, **design.OUTSIDE}[name][2]
        # A rod leaves something without any effect: its residual counts beyond that.
        nothing = self.residual([], setup) if setup else 0.0
        if nothing is None:
            return []
        curve = []
        for step in range(-STEPS, 1):
            amplitude = most * 10 ** (step / 2)
            left = self.residual(film.of_effect(name, amplitude), setup)
            if left is None:
                break
            left = math.sqrt(max(0.0, left**2 - nothing**2))
            if curve and left < curve[-1][1]:
                break
            if left > RESOLVED * _size(setup):
                curve.append((amplitude, left))
            if left > LARGEST * _size(setup):
                break
        return curve

    def residual(self, effects, setup):
        """What a baseline leaves of a recording without noise, m; None if there is none."""
        of_setup = design.SETUPS.get(setup)
        rod = of_setup is not None and of_setup.truth == "rod"
        trial = design.Trial("measured", (), 0, 0.0, 30, design.ROD_ELEMENTS if rod else LINKS, 0.0, 0.0, 1, setup=setup)
        with tempfile.TemporaryDirectory() as folder:
            case_links = of_setup.links if of_setup and of_setup.links == 1 else LINKS
            if not film.make(trial, effects, folder, self.binaries, case_links=case_links):
                return None
            _start_at_truth(pathlib.Path(folder, "case.toml"), film.cable(setup))
            fit = subprocess.run(
                [self.binaries / "bin" / "catena", "identify", f"{folder}/case.toml", "--quiet",
                 "--output", f"{folder}/fit"], capture_output=True, check=False)
            if fit.returncode != 0:
                return None
            result = json.loads(pathlib.Path(folder, "fit", "result.json").read_text())
            return result["optimiser"]["error"]

    def write(self):
        lines = ["effect,amplitude,residual_m"]
        for name in sorted(self.curves):
            lines += [f"{name},{a:.6g},{r:.6g}" for a, r in self.curves[name]]
        temporary = self.file.with_suffix(".tmp")
        temporary.write_text("\n".join(lines) + "\n")
        temporary.replace(self.file)
