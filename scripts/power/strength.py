# SPDX-License-Identifier: BSD-3-Clause
"""How large an effect must be to leave so much in the residual of a refitted baseline."""

import csv
import json
import math
import pathlib
import subprocess
import tempfile
import threading

from power import design

# The cable of the study: 1.2 m, half a pound at its end, stiff enough for few links.
CABLE = ["--length", "1.2", "--bending-stiffness", "0.1", "--bending-damping", "0.01", "--load", "0.2",
         "--held", "0.6", "0.9", "--duration", "4"]
RESOLVED, LARGEST = 1e-4, 0.03  # m: below the first a curve tells nothing, more is not asked for
STEPS = 12  # of the amplitude, half a decade each
LINKS = 24  # of the recordings measured, and of their baselines: what is left is the effect alone


def arguments(name, amplitude):
    """make_recording's for one hidden effect."""
    scaled, fixed, _ = {**design.EFFECTS, **design.OUTSIDE}[name]
    values = dict(fixed)
    for parameter, factor in scaled.items():
        if name == "axial_stretch":
            values[parameter] = 1000 / amplitude
        elif name == "scale":
            values[parameter] = 1 + amplitude
        else:
            values[parameter] = factor * amplitude
    result = []
    for parameter, value in values.items():
        result += ["--effect", f"{name}.{parameter}={value:.6g}"]
    return result


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

    def amplitude(self, name, residual, links):
        """The amplitude whose recording with so many links leaves so much (m, rms); None if none
        within bounds does."""
        amplitude = self.amplitude_at_links_measured(name, residual)
        if amplitude is None:
            return None
        return amplitude * (links / LINKS) ** design.JOINT_POWERS.get(name, 0)

    def amplitude_at_links_measured(self, name, residual):
        with self.lock:
            own = self.locks.setdefault(name, threading.Lock())
        with own:
            if name not in self.curves:
                curve = self.measure(name)
                with self.lock:
                    self.curves[name] = curve
                    self.write()
        previous = None
        for amplitude, left in self.curves[name]:
            if left >= residual and previous is not None:
                a0, r0 = previous
                share = math.log(residual / r0) / math.log(left / r0)
                return a0 * (amplitude / a0) ** share
            if RESOLVED < left < residual:
                previous = (amplitude, left)
        return None

    def measure(self, name):
        """Residuals of the baseline from small amplitudes upwards, as far as they grow."""
        most = {**design.EFFECTS, **design.OUTSIDE}[name][2]
        curve = []
        for step in range(-STEPS, 1):
            amplitude = most * 10 ** (step / 2)
            left = self.residual(name, amplitude)
            if left is None or (curve and left < curve[-1][1]):
                break
            if left > RESOLVED:
                curve.append((amplitude, left))
            if left > LARGEST:
                break
        return curve

    def residual(self, name, amplitude):
        with tempfile.TemporaryDirectory() as folder:
            made = subprocess.run(
                [self.binaries / "bin" / "make_recording", "--output", folder, *CABLE,
                 "--links", str(LINKS), "--case-links", str(LINKS), "--noise", "0", "--rate", "30",
                 *arguments(name, amplitude)], capture_output=True, check=False)
            if made.returncode != 0:
                return None
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
