# SPDX-License-Identifier: BSD-3-Clause
"""How right is a law that catena discovered: its curve, and what its model predicts of other motions."""
import csv
import json
import math
import pathlib
import re
import subprocess
import tomllib

# Where an effect acts, as the truth's forces.csv calls it (make_recording --forces).
PLACES = {"link_centre": "middle_", "load": "load_"}
# What a law may go with that is no point: its position and its rate.
NUMBERS = {"joint": ("joint_angle", "joint_rate", "steady_tension"), "chord": ("distance", "distance_rate")}
STEP = 1e-5  # of differences, m, m/s, rad, rad/s
GRAVITY = 9.81  # m/s^2, of make_recording
SLIDES = 0.02  # rad/s: slower than this the truth rounds the sign of a rate (by 1 % there)


def columns(file):
    """Columns of a CSV file by name."""
    with open(file, newline="") as lines:
        rows = list(csv.DictReader(lines))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def rms(values):
    return math.sqrt(sum(value * value for value in values) / len(values))


class Law:
    """A discovered effect with the values that were fitted; it acts at one place or joint or between two places, or `at` is
    None."""

    def __init__(self, found):
        law = tomllib.loads((found / "discovered_law.toml").read_text())
        case = tomllib.loads((found / "diagnosed.toml").read_text())
        self.constants = {name: of["value"] for name, of in law.get("constants", {}).items()}
        self.constants |= {name: of.get("default", of.get("neutral")) for name, of in law["parameters"].items()}
        self.constants |= {name.removeprefix("discovered_law."): value for parameter in case["parameter"]
                           for name, value in [(parameter["sets"], parameter["value"])]
                           if name.startswith("discovered_law.")}  # fmt: skip
        self.constants |= {"here": 1.0, "offset": 0.0, "gravity": GRAVITY}  # at its place
        self.mass = self.constants["point_mass"] if "kinetic" in law else 0.0
        self.potential, self.torque = "potential" in law, "torque" in law
        self.cable = case["cable"]
        self.remembers = law["state"][0]["name"] if "state" in law else None
        kind = next(kind for kind in ("force", "torque", "potential", "dissipation") if kind in law)
        energy = law[kind][0]
        # A force of what remembers, of the time, or of a curve against a velocity: `value` along each of these.
        self.along = [(force["along"], self._compiled(force["value"])) for force in law.get("force", [])]
        self.over_time = self.remembers or kind == "force" and "time" in energy["value"]
        self.definitions = [(of["name"], self._compiled(of["value"])) for of in law.get("definition", [])
                            if of["name"] not in ("here", "offset")]
        one_place = energy["at"] in ("load", "chord") or any(of["name"] == "here" for of in law.get("definition", []))
        self.at = energy["at"] if one_place else None
        self.joints = None if one_place else {"joint": slice(None), "pivot": slice(1)}.get(energy["at"])
        self.energy = self._compiled(energy["value"])

    @staticmethod
    def _compiled(text):
        return compile(text.replace("^", "**"), "effect", "eval")

    def _value(self, expression, state):
        functions = {name: getattr(math, name) for name in ("sqrt", "log", "exp", "sin", "cos", "cosh", "tanh")}
        names = functions | self.constants | state
        for name, value in self.definitions:
            names[name] = eval(value, {"__builtins__": {}}, names)  # noqa: S307
        return eval(expression, {"__builtins__": {}}, names)  # noqa: S307

    def _energy(self, state):
        return self._value(self.energy, state)

    def _pushes(self, state):
        """Forces along velocities."""
        if self.at in NUMBERS:
            return [self._value(value, state) for _, value in self.along]
        s, c = math.sin(state["angle"]), math.cos(state["angle"])
        state = self._with_directions(state)
        axes = {"velocity_side": (1.0, 0.0), "velocity_down": (0.0, 1.0),
                "velocity_normal": (c, -s), "velocity_tangential": (s, c)}
        parts = [0.0, 0.0]
        for along, value in self.along:
            size = self._value(value, state)
            parts = [part + size * axis for part, axis in zip(parts, axes[along.split()[0]])]
        return parts

    @staticmethod
    def _with_directions(state):
        s, c = math.sin(state["angle"]), math.cos(state["angle"])
        return state | {"velocity_normal": c * state["velocity_side"] - s * state["velocity_down"],
                        "velocity_tangential": s * state["velocity_side"] + c * state["velocity_down"],
                        "rate": 0.0}  # its place has no offset

    def force(self, state):
        """Its parts: side and down, N, of a place; the moment, N m, of a joint; what parts two places, N."""
        if self.along:
            return self._pushes(state)
        if self.torque:
            return [self._energy(state)]
        if self.at in NUMBERS:
            names = NUMBERS[self.at][not self.potential :][:1]
        else:
            names = ("side", "down") if self.potential else ("velocity_side", "velocity_down")

        def energy(name, change):
            moved = state | {name: state[name] + change}
            if self.at not in NUMBERS:
                moved = self._with_directions(moved)
            return self._energy(moved)

        return [(energy(name, -STEP) - energy(name, STEP)) / (2 * STEP) - self.mass * state.get(f"acceleration_{name}", 0.0)
                for name in names]  # fmt: skip

    def joint_moments(self, rates, tensions, spacings):
        """Of friction in joints, N m: of all, 0 where it does not act."""
        moments = [0.0] * len(rates)
        for i in range(len(rates))[self.joints]:
            state = {"joint_rate": rates[i], "steady_tension": tensions[i], "spacing": spacings[i]}
            moments[i] = self._energy(state) if self.torque else (
                self._energy(state | {"joint_rate": rates[i] - STEP}) - self._energy(state | {"joint_rate": rates[i] + STEP})) / (2 * STEP)
        return moments

    def histories(self, true, where):
        """Its parts over time, where it remembers or depends on the time: of `true`, by frames."""
        time, forces = true["time_s"], [0.0] * len(true["time_s"])
        if self.remembers:
            axis = "joint_angle" if self.at == "joint" else where + ("down" if "down" in self.along[0][0] else "side")
            followed = true[axis]
            stretch, lag = 0.0, self.constants["lag"]
            for k in range(1, len(time)):
                step = (time[k] - time[k - 1]) / lag
                stretch = math.exp(-step) * stretch + (1 - math.exp(-step)) / step * (followed[k] - followed[k - 1])
                forces[k] = self._value(self.along[0][1], {self.remembers: stretch})
        else:
            forces = [self._energy({"time": t}) for t in time]
        nothing = [0.0] * len(time)
        if self.at == "joint":
            return [forces]
        return [nothing, forces] if "down" in self.along[0][0] else [forces, nothing]


def steady_tensions(angles, rates, cable):
    """Of every joint, N: docs/effects.md. `angles`, `rates`: of the joints."""
    count = len(angles)
    link = cable["length"] / count
    mass, fall, falls = cable["density"] * link, (0.0, GRAVITY), []
    directions, angle, rate = [], 0.0, 0.0
    for i in range(count):
        angle, rate = angle + angles[i], rate + rates[i]
        along = (math.sin(angle), math.cos(angle))
        directions.append(along)
        falls.append([f + rate * rate * link / 2 * a for f, a in zip(fall, along)])  # of the middle of a link
        fall = [f + rate * rate * link * a for f, a in zip(fall, along)]
    pull, tensions = [cable["load_mass"] * f for f in fall], []
    for along, at_middle in zip(reversed(directions), reversed(falls)):
        pull = [p + mass * f for p, f in zip(pull, at_middle)]
        tensions.insert(0, sum(p * a for p, a in zip(pull, along)))
    return tensions


def joints_of(true):
    """How many there are."""
    return sum(1 for name in true if re.fullmatch(r"joint_\d+_rate", name))


def middle_tensions(true, cable):
    """The steady tension in mid-joint, N, by frames."""
    count = joints_of(true)
    motions = ([[true[f"joint_{i + 1}_{of}"][k] for i in range(count)] for of in ("angle", "rate")] for k in range(len(true["time_s"])))
    return [steady_tensions(angles, rates, cable)[count // 2] for angles, rates in motions]


def friction_error(law, true):
    """Of dry friction in joints, where they slide: what sticks has no curve."""
    count = joints_of(true)
    link = law.cable["length"] / count
    spacings = [link / 2] + [link] * (count - 1)
    errors, truths = [], []
    for k in range(len(true["time_s"])):
        angles, rates, sizes = ([true[f"joint_{i + 1}_{of}"][k] for i in range(count)] for of in ("angle", "rate", "friction"))
        said = law.joint_moments(rates, steady_tensions(angles, rates, law.cable), spacings)
        for moment, rate, size in zip(said, rates, sizes):
            if abs(rate) > SLIDES:
                truths.append(-math.copysign(size, rate))
                errors.append(moment - truths[-1])
    return rms(errors) / rms(truths) if any(truths) else None


def curve_error(found, forces):
    """Root mean square, over the true motion, of the law's force less the true one at the same state, over that of the
    true one. None where the law acts where no force is."""
    law, true = Law(found), columns(forces)
    true["steady_tension"] = middle_tensions(true, law.cable)
    if law.joints:
        return friction_error(law, true)
    if law.at in NUMBERS:
        where = {"joint": "", "chord": "tie_"}[law.at]
        there, states = [true[{"joint": "joint_moment", "chord": "tie_force"}[law.at]]], NUMBERS[law.at]
    elif law.at in PLACES:
        where = PLACES[law.at]
        there = [true[f"{where}force_side"], true[f"{where}force_down"]]
        states = ("side", "down", "velocity_side", "velocity_down", "acceleration_side", "acceleration_down", "angle")
    else:
        return None
    size = math.hypot(*map(rms, there))
    if size == 0:
        return None
    frames = range(len(true["time_s"]))
    if law.over_time:
        says = zip(*law.histories(true, where))
    else:
        says = (law.force({name: true[name if name == "steady_tension" else where + name][k] for name in states})
                for k in frames)  # fmt: skip
    errors = [math.hypot(*(a - b for a, b in zip(said, truth))) for said, truth in zip(says, zip(*there))]
    return rms(errors) / size


def prediction_error(found, with_law, without_law, load, catena):
    """Root mean square of the found model's motion less the true one, over that of the truth without its law less the
    true one. `with_law`, `without_law`: folders of films without noise, from rest, with a marker at the end of every link."""
    truth = columns(with_law / "markers.csv")
    case = (found / "diagnosed.toml").read_text()
    links, markers = tomllib.loads(case)["model"]["links"], sum(name.startswith("side_") for name in truth)
    ends = range(0, markers + 1, markers // links)
    first = {(axis, n): truth[f"{axis}_{n}_m"][0] if n else 0.0 for axis in ("side", "down") for n in ends}
    angles = [math.atan2(first["side", b] - first["side", a], first["down", b] - first["down", a])
              for a, b in zip(ends, ends[1:])]  # fmt: skip
    case = re.sub(r"(?ms)^\[experiment.initial\]\n.*?(?=^\[)", "", case)
    case = re.sub(r"(?ms)^\[initial\]\n.*?(?=^\[)", f'[initial]\nshape = "angles"\nangles = {angles}\n\n', case)
    case = re.sub(r"(?m)^load_mass = .*", f"load_mass = {load!r}", case, count=1)
    case = re.sub(r"(?m)^data = .*", f'data = "{with_law / "markers.csv"}"', case)
    case = re.sub(r'(?m)^(fit_until|noise) = .*\n', "", case)
    (found / "other.toml").write_text(case)
    run = subprocess.run([catena, "simulate", found / "other.toml", "--quiet", "--output", found / "other"],
                         capture_output=True, check=False)  # fmt: skip
    if run.returncode != 0:
        return math.inf
    gap = json.loads((found / "other" / "result.json").read_text())["experiments"][0]["gap"]["fit"]
    other = columns(without_law / "markers.csv")
    return gap / rms([a - b for name in truth if name != "time_s" for a, b in zip(truth[name], other[name])])
