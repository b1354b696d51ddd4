#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""scripts/diagnoses.py FOLDER...: a table of what catena diagnose wrote into these folders.

A line for each: the verdict, what is left before and after, and the shares of the effects, with their
intervals. Folders without a finished diagnosis are said at the end; the exit status is then 1.
"""

import argparse
import json
import pathlib
import sys


def read(folder):
    """The diagnosis in a folder; None if there is none."""
    file = pathlib.Path(folder) / "diagnosis.json"
    return json.loads(file.read_text()) if file.exists() else None


def in_percent(share, part):
    """"84 (81 to 87) %"."""
    low, high = share[f"{part}_interval"]
    return f"{100 * share[part]:.0f} ({100 * low:.0f} to {100 * high:.0f}) %"


def doubt(name, found):
    """" (or joint_dry_friction)" where the data do not decide, " (not certain)", or nothing."""
    rivals = sorted({other["id"] for other in found["undecided"] if other["instead_of"] == name})
    if rivals:
        return f' (or {", ".join(rivals)})'
    return "" if name in [*found.get("certain", []), "left"] else " (not certain)"


def row(name, found, seconds):
    """One line of the table: what `found`, a diagnosis.json, says."""
    unit = "mrad" if found["unit"] == "rad" else "mm"
    gaps = [found["rounds"][k]["gap"] for k in (0, -1)]
    gap = [", ".join(f"{1e3 * each[part]:.3g}" if part in each else "-"
                     for part in ["fit", "validate", "sealed"]) + f" {unit}" for each in gaps]
    shares = [f'{share["name"]}{doubt(share["name"], found)} {in_percent(share, "fit")}, '
              f'{in_percent(share, "validate")}' for share in found.get("shares", [])]
    noise = "{:.2g} {}".format(1e3 * found["noise_level"], unit)
    cells = [name, found["verdict"], *gap, noise, "; ".join(shares) or "-", f"{seconds:.0f} s"]
    return "| " + " | ".join(cells) + " |"


def table(rows, time):
    """Rows under their heads; `time`: what the last column is."""
    head = f"| recording | verdict | before: fitted, held out, sealed | after | noise | shares: fitted, held out | {time} |"
    return "\n".join([head, "|---|---|---|---|---|---|---|", *rows])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("folder", type=pathlib.Path, nargs="+")
    found = {folder: read(folder) for folder in parser.parse_args().folder}
    print(table([row(folder.name, each, each["seconds"]) for folder, each in found.items() if each], "time"))
    missing = [str(folder) for folder, each in found.items() if not each]
    if missing:
        sys.exit(f"diagnoses.py: no diagnosis in {', '.join(missing)}")


if __name__ == "__main__":
    main()
