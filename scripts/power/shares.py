# SPDX-License-Identifier: BSD-3-Clause
"""Whether the intervals of a diagnosis' shares hold what the shares are of the same film without noise."""

import dataclasses
import itertools
import json
import math
import re
import subprocess

from power import design, film

MOST_EFFECTS = 3  # more need more than eight fits
SEALED = 1 / 3  # of what is held out: the shares do not see it


def of_misfits(effects, misfit):
    """What each effect removes of the misfit, the mean over all orders in which they may be added, over the
    whole. `misfit`: of every subset of the effects, by frozenset."""
    taken = dict.fromkeys(effects, 0.0)
    orders = list(itertools.permutations(effects))
    for order in orders:
        for i, effect in enumerate(order):
            taken[effect] += misfit[frozenset(order[:i])] - misfit[frozenset(order[: i + 1])]
    whole = misfit[frozenset()]
    return {effect: value / len(orders) / whole for effect, value in taken.items()}


def held(trial, effects_of_film, found, folder, binaries):
    """How many of the intervals in a diagnosis, FOLDER/found, hold, and how many there are: "3/4". Empty
    where shares cannot be said. `effects_of_film`: make_recording's options."""
    effects = [share["name"] for share in found.get("shares", []) if share["name"] != "left"]
    if not 0 < len(effects) <= MOST_EFFECTS or any(e not in design.EFFECTS or e == "axial_stretch" for e in effects):
        return ""
    clean = dataclasses.replace(trial, noise=0.0, pixel=0.0, dirt="")  # the same marks are lost: shares are of those seen
    if not film.make(clean, effects_of_film, f"{folder}/exact", binaries):
        return ""
    case = (folder / "found" / "diagnosed.toml").read_text()
    case = case.replace('"../markers.csv"', '"exact/markers.csv"').replace('"model.toml"', '"found/model.toml"')
    until = float(re.search(r"(?m)^fit_until = ([\d.]+)", case)[1])
    end = until + (1 - SEALED) * (float(film.cable(trial.setup)["--duration"]) - until)
    case = re.sub(r"(?m)^fit_until = .*", f"fit_until = {until}\nto = {end}", case)
    misfits = {"fit": {}, "validate": {}}
    for count in range(len(effects) + 1):
        for some in itertools.combinations(effects, count):
            gap = _gap(case, set(effects) - set(some), folder, binaries)
            if gap is None:
                return ""
            for part, of_part in misfits.items():
                of_part[frozenset(some)] = gap[part] ** 2
    hits = count = 0
    for part, of_part in misfits.items():
        exact = of_misfits(effects, of_part)
        for share in found["shares"]:
            low, high = share.get(f"{part}_interval", (math.nan, math.nan))
            if share["name"] in exact and not math.isnan(low):
                hits += low <= exact[share["name"]] <= high
                count += 1
    return f"{hits}/{count}"


def _gap(case, absent, folder, binaries):
    """What the case leaves of the film without the absent effects, which the model then has at their neutral
    values, m; None if it cannot be fitted."""
    for effect in absent:
        case = re.sub(rf'\[\[parameter\]\]\nname = .*\nsets = "{effect}\.\w+"\n(?:\w.*\n)*\n?', "", case)
    (folder / "subset.toml").write_text(case)
    fit = subprocess.run([binaries / "bin" / "catena", "identify", folder / "subset.toml", "--quiet", "--output",
                          folder / "subset"], capture_output=True, check=False)
    if fit.returncode != 0:
        return None
    return json.loads((folder / "subset" / "result.json").read_text())["experiments"][0]["gap"]
