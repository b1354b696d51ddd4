# SPDX-License-Identifier: BSD-3-Clause
"""One trial: film, diagnose, open the truth."""

import csv
import json
import os
import pathlib
import resource
import signal
import subprocess
import tempfile

from power import design, film, shares

FIELDS = ["kind", "hidden", "strength", "noise_m", "seed", "dirt", "setup", "off", "rate", "links", "amplitudes", "verdict",
          "effects", "members", "right", "certain", "farthest_member", "links_used", "fit_ratio",
          "held_out_ratio", "shares_held"]
SECONDS = ["kind", "hidden", "strength", "noise_m", "seed", "cpu_seconds"]  # no machine repeats them
INDISTINGUISHABLE = 0.5  # times the noise, between refitted predictions
TIME_LIMIT = 300  # s of CPU


def of(trial, strengths, binaries, films):
    """The line of a trial, and the CPU seconds of its diagnosis (None where there was none). `films`: folder
    that keeps motions."""
    row = {"kind": trial.kind, "hidden": "+".join(trial.hidden), "strength": trial.strength,
           "noise_m": trial.noise, "seed": trial.seed, "dirt": trial.dirt, "setup": trial.setup,
           "off": trial.off or "", "rate": trial.rate, "links": trial.links}
    effects, amplitudes = [], []
    for name in trial.hidden if trial.kind != "known" else ():
        amplitude = strengths.amplitude(name, trial.strength * trial.noise, trial.links, trial.setup)
        if amplitude is None:
            return row | {"verdict": "not reached"}, None
        amplitudes.append(f"{amplitude:.6g}")
        effects += film.of_effect(name, amplitude)
    row["amplitudes"] = "+".join(amplitudes)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        if not film.make(trial, effects, folder, binaries, films):
            return row | {"verdict": "not filmed"}, None
        (folder / "truth.toml").unlink()  # the trial itself is the truth
        status, seconds = run(
            [binaries / "bin" / "catena", "diagnose", f"{folder}/case.toml", "--quiet",
             "--yes", "--threads", "1", "--output", f"{folder}/found"])
        if status != 0:
            out_of_time = status in (-signal.SIGXCPU, -signal.SIGKILL)
            return row | {"verdict": "out of time" if out_of_time else "failed", "right": "no"}, seconds
        found = json.loads((folder / "found" / "diagnosis.json").read_text())
        if trial.kind in ("double", "beside"):  # with one effect the share is near 1 by itself
            row["shares_held"] = shares.held(trial, effects, found, folder, binaries)
    return row | judged(trial, found), seconds


def run(command):
    """Exit status (negative: the signal that ended it) and CPU time, compilers' included, s."""
    limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (TIME_LIMIT, TIME_LIMIT))
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                               preexec_fn=limit)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return process.returncode, usage.ru_utime + usage.ru_stime


def judged(trial, found):
    all_named = {effect["id"] for effect in found["effects"]}
    truth = {name for name in trial.hidden if name in design.EFFECTS}
    if trial.kind == "known":  # right where nothing but knowns is named, what it is called among them
        called = design.CALLED[trial.hidden[0]]
        among = all_named <= design.KNOWNS_AND_SENSORS and all_named & called
        truth = all_named if among else called if len(called) == 1 else set()
    # Of a rod's recording, what is said of knowns and sensors may be so.
    named = all_named - (design.KNOWNS_AND_SENSORS - truth) if trial.is_rod() else all_named
    forms = {(f["instead_of"], f["id"]) for f in found["forms"]}
    if trial.is_rod():
        forms |= {(form, effect) for effect, form in design.ROD_FORMS.items() if form in named}
    others = [u for u in found["undecided"]]
    farthest = max((u["difference"] for u in others), default=0.0)
    as_named = named == truth or any(named - {a} | {b} == truth for a, b in forms)
    beyond = any(name in design.OUTSIDE for name in trial.hidden)
    if found["verdict"] == "named":
        right = as_named and not beyond
    elif found["verdict"] == "ambiguous":
        swapped = any(named - {u["instead_of"]} | {u["id"]} == truth for u in others)
        right = (as_named or swapped) and farthest < INDISTINGUISHABLE and not beyond
    elif found["verdict"] == "partly":  # what is called certain, if anything
        right = all(a in truth or any(a == of and b in truth for of, b in forms)
                    for a in set(found.get("certain") or named) & named)
    elif found["verdict"] == "discovered":  # the library's effects beside the law are wrong
        right = beyond and len(named - truth) == 1
    else:
        right = beyond if found["verdict"] == "unexplained" else not trial.hidden
    gap = found["rounds"][-1]["gap"]
    held = gap["validate"]
    return {"verdict": found["verdict"], "effects": "+".join(sorted(all_named)),
            "members": "+".join(sorted(set(found["members"]))), "right": "yes" if right else "no",
            "certain": "+".join(sorted(found.get("certain", []))),
            "farthest_member": f"{farthest:.3g}", "links_used": found["links"]["used"],
            "fit_ratio": f"{gap['fit'] / gap['noise_level']:.4g}",
            "held_out_ratio": "" if held is None else f"{held / gap['noise_level']:.4g}"}


def key(row):
    return (row["kind"], row["hidden"], str(row["strength"]), str(row["noise_m"]), str(row["seed"]))


def read(file, key_of=key):
    if not file.exists():
        return {}
    with file.open() as lines:
        return {key_of(row): row for row in csv.DictReader(lines)}


def append(file, fields, row):
    """One line; a study that is stopped keeps it."""
    new = not file.exists()
    with file.open("a", newline="") as lines:
        writer = csv.DictWriter(lines, fields, restval="", extrasaction="ignore", lineterminator="\n")
        if new:
            writer.writeheader()
        writer.writerow(row)


def write(file, fields, rows):
    """All lines anew, whole or not at all."""
    temporary = file.with_suffix(".tmp")
    temporary.unlink(missing_ok=True)
    for row in rows:
        append(temporary, fields, row)
    if rows:
        temporary.replace(file)
