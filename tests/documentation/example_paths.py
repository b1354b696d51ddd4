#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""example_paths.py CHECKOUT: each file that a case or description under examples/ names is there, below the folder of
the one that names it, so that a copied folder runs anywhere. MADE lists what a page makes before.
"""
import pathlib
import sys
import tomllib

EXAMPLES = pathlib.Path(sys.argv[1]) / "examples"
MADE = {"twin_study/sixty_links/positions.csv"}  # by the first step of docs/studies.md


def texts(value):
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        for each in value:
            yield from texts(each)
    elif isinstance(value, str):
        yield value


wrong, named = [], 0
for file in sorted(EXAMPLES.rglob("*.toml")):
    for text in texts(tomllib.loads(file.read_text())):
        if not text.endswith((".csv", ".toml")):
            continue
        named += 1
        path = file.parent / text
        if ".." in path.parts or pathlib.Path(text).is_absolute():
            wrong.append(f"{file}: {text} is not below the folder of this file")
        elif not path.exists() and str(path.relative_to(EXAMPLES)) not in MADE:
            wrong.append(f"{file}: there is no {text}")
print("\n".join(wrong) or f"{named} files")
sys.exit(bool(wrong) or named == 0)
