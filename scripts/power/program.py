# SPDX-License-Identifier: BSD-3-Clause
"""Which sources a study is of: trials of different ones must not be counted together."""

import hashlib
import pathlib
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
MAKE_NO_TRIALS = {ROOT / "scripts" / "power" / name for name in ("page.py", "program.py")}  # count and label them


def hash_of_sources():
    """SHA-256 over names and contents, the same on every machine."""
    rooms = tomllib.loads((ROOT / "docs" / "rooms.toml").read_text())
    folders = {room.split("/")[0] for room in rooms} | {"generated", "scripts/power"}
    total = hashlib.sha256()
    for folder in sorted(folders):
        for file in sorted((ROOT / folder).rglob("*")):
            if file.suffix in (".cpp", ".hpp", ".h", ".toml", ".py") and file not in MAKE_NO_TRIALS:
                total.update(str(file.relative_to(ROOT)).encode() + b"\0" + file.read_bytes() + b"\0")
    return total.hexdigest()


def text_of(folder):
    """The folder's program.txt: the hash, then what is to be said of trials of other sources. Empty if there is none."""
    file = folder / "program.txt"
    return file.read_text().strip() if file.exists() else ""


def of(folder):
    """The hash of what the trials in a folder were made by; empty where the folder does not say."""
    return text_of(folder).partition("\n")[0]


def claim(folder):
    """Before trials are added to a folder. Returns what is wrong, or nothing."""
    now, before = hash_of_sources(), of(folder)
    if before == now:
        return ""
    if not before and not (folder / "trials.csv").exists():
        (folder / "program.txt").write_text(now + "\n")
        return ""
    return f"{folder}: its trials are of other sources; choose another --output, or delete the folder"
