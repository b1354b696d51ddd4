# SPDX-License-Identifier: BSD-3-Clause
"""Which sources a study is of: trials of different ones must not be counted together."""

import hashlib
import pathlib
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]


def hash_of_sources():
    """SHA-256 over names and contents, the same on every machine."""
    rooms = tomllib.loads((ROOT / "docs" / "rooms.toml").read_text())
    folders = {room.split("/")[0] for room in rooms} | {"generated", "scripts/power"}
    total = hashlib.sha256()
    for folder in sorted(folders):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in (".cpp", ".hpp", ".h", ".toml", ".py"):
                total.update(str(file.relative_to(ROOT)).encode() + b"\0" + file.read_bytes() + b"\0")
    return total.hexdigest()


def of(folder):
    """What the trials in a folder were made by; None where the folder does not say."""
    file = folder / "program.txt"
    return file.read_text().strip() if file.exists() else None


def claim(folder):
    """Before trials are added to a folder. Returns what is wrong, or nothing."""
    now, before = hash_of_sources(), of(folder)
    if before == now:
        return ""
    if before is None and not (folder / "trials.csv").exists():
        (folder / "program.txt").write_text(now + "\n")
        return ""
    return f"{folder}: its trials are of other sources; choose another --output, or delete the folder"
