#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""run_blocks.py PAGE.md BINARY_FOLDER: run the code blocks of a page, in order, and compare.

A fence names its language and, where the block is a file, the file:

    ```console             lines "$ command", each followed by the output it shows
    ```console elsewhere   as above, but run by a test of its own (too long, or needs root): only
                           that the program exists is checked
    ```toml my_case.toml   the block is that file for the commands after it (any language); where
                           the checkout has a file of that name, it must say the same
    ```text                a drawing or an excerpt: nothing to run

Commands run in a scratch copy of the checkout's examples/, with the built programs on PATH and the
rest of the checkout linked. Of the output shown, a line "..." stands for any lines, "..." within a
line for any text, and a number agrees with one that differs from it by at most 2 %. A command is to
succeed unless the last line shown is "[exit status N]". A language without a file is an error, so
that no block goes untried.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
FENCE = re.compile(r"^( *)```(\w*) *([^\n]*)\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)
NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")
STATUS = re.compile(r"^\[exit status (\d+)\]$")


def same_number(shown, got):
    shown, got = float(shown), float(got)
    return abs(shown - got) <= 0.02 * max(abs(shown), abs(got))


def line_agrees(shown, got):
    """Numbers within 2 %, "..." any text, runs of blanks one blank."""
    pattern, numbers, end = "", [], 0
    shown, got = " ".join(shown.split()), " ".join(got.split())
    for piece in re.finditer(rf"\.\.\.|{NUMBER.pattern}", shown):
        pattern += re.escape(shown[end : piece.start()])
        if piece[0] == "...":
            pattern += ".*?"
        else:
            pattern += f"({NUMBER.pattern})"
            numbers.append(piece[0])
        end = piece.end()
    match = re.fullmatch(pattern + re.escape(shown[end:]), got)
    return bool(match) and all(map(same_number, numbers, match.groups()))


def output_agrees(shown, got):
    if not shown:
        return not got
    if shown[0].strip() == "...":
        return any(output_agrees(shown[1:], got[skip:]) for skip in range(len(got) + 1))
    return bool(got) and line_agrees(shown[0], got[0]) and output_agrees(shown[1:], got[1:])


def commands_of(block):
    """(command, lines shown, exit status) of a console block; a trailing \\ continues a command."""
    commands = []
    for line in block.splitlines():
        if line.startswith("$ "):
            commands.append([line[2:], [], 0])
        elif not commands:
            sys.exit(f"a console block does not start with '$ ': {line}")
        elif commands[-1][0].endswith("\\") and not commands[-1][1]:
            commands[-1][0] += "\n" + line
        elif status := STATUS.match(line):
            commands[-1][2] = int(status[1])
        else:
            commands[-1][1].append(line)
    return commands


def scratch_checkout(folder, binaries):
    shutil.copytree(ROOT / "examples", folder / "examples")
    for entry in ROOT.iterdir():
        if entry.name not in ("examples", "build", ".git"):
            (folder / entry.name).symlink_to(entry)
    (folder / "build").mkdir()
    (folder / "build" / "release").symlink_to(binaries)


def main():
    page, binaries = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]).resolve()
    text = page.read_text()
    environment = dict(
        os.environ,
        PATH=f"{binaries / 'bin'}:{pathlib.Path(sys.executable).parent}:{os.environ['PATH']}",
        PYTHONPATH=str(binaries / "python"),
        CATENA_CACHE=str(binaries / "model_cache"),
        CATENA_DATA=os.environ.get("CATENA_DATA", str(ROOT.parent / "shared" / "data")),
    )
    have_data = pathlib.Path(environment["CATENA_DATA"]).is_dir()
    tried = failed = skipped = 0
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary) / "catena"
        folder.mkdir()
        scratch_checkout(folder, binaries)
        for indent, language, name, block in FENCE.findall(text):
            block = re.sub(f"^{indent}", "", block, flags=re.MULTILINE)
            if language == "text":
                continue
            if language != "console":
                if not name:
                    sys.exit(f"{page}: a block of {language or 'no language'} names no file:\n{block}")
                if (ROOT / name).exists() and (ROOT / name).read_text() != block:
                    sys.exit(f"{page}: the block {name} is not what the file of that name says")
                target = folder / name
                target.parent.mkdir(parents=True, exist_ok=True)
                target.write_text(block)
                continue
            for command, shown, status in commands_of(block):
                if name == "elsewhere":
                    program = command.split()[0]
                    if not shutil.which(program, path=environment["PATH"]) and not (
                        ROOT / program
                    ).exists():
                        sys.exit(f"{page}: no program {program}")
                    continue
                if "CATENA_DATA" in command and not have_data:
                    print(f"skipped, the recordings are absent: {command}")
                    skipped += 1
                    continue
                tried += 1
                run = subprocess.run(
                    ["bash", "-c", command],
                    cwd=folder,
                    env=environment,
                    stdin=subprocess.DEVNULL,
                    stdout=subprocess.PIPE,
                    stderr=subprocess.STDOUT,
                    text=True,
                )
                got = run.stdout.splitlines()
                if run.returncode == status and output_agrees(shown, got):
                    continue
                failed += 1
                print(f"{page}: $ {command}\n--- shown, exit status {status}")
                print("\n".join(shown))
                print(f"--- got, exit status {run.returncode}\n{run.stdout}")
    print(f"{page.name}: {tried - failed} passed, {failed} failed, {skipped} skipped")
    sys.exit(1 if failed else 0)


main()
