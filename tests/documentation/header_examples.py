#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""header_examples.py CHECKOUT CXX [FLAGS ...]: compile the examples in the comments of our headers.

An example is a run of comment lines that are indented by four blanks or more and of which one ends a
statement:

    ///     const Model model = Model::built_in(12);

Each example is compiled (without code generation) as the body of a function in namespace catena, after
an include of its header and of what the example itself includes. Every header that docs/library.md lists
under runtime/ and identify/ must have one.
"""
import pathlib
import re
import subprocess
import sys
import tempfile

CHECKOUT, COMPILER = pathlib.Path(sys.argv[1]), sys.argv[2:]
INSTALLED = ("common", "description", "generated", "linear_algebra", "runtime", "identify")
INDENTED = re.compile(r"^ *///? {4,}(.*)$|^ *///?$")
STATEMENT = re.compile(r"[;{] *(//.*)?$")


def examples_of(header):
    """The examples of a header, in order."""
    examples, block = [], []
    for line in header.read_text().splitlines() + [""]:
        match = INDENTED.match(line)
        if match and (match[1] or block):
            block.append(match[1] or "")
            continue
        if any(STATEMENT.search(text) for text in block):
            examples.append("\n".join(block))
        block = []
    return examples


def compiles(name, examples, flags):
    includes, functions = f'#include "{name}"\n', ""
    for number, example in enumerate(examples):
        lines = example.splitlines()
        includes += "".join(f"{line}\n" for line in lines if line.startswith("#include"))
        body = "\n".join(line for line in lines if not line.startswith("#include"))
        functions += f"namespace catena {{\nvoid example_{number}() {{\n{body}\n}}\n}}\n"
    source = includes + functions
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as file:
        file.write(source)
        file.flush()
        run = subprocess.run(
            [*COMPILER, *flags, "-fsyntax-only", f"-I{CHECKOUT}", file.name],
            capture_output=True,
            text=True,
        )
    if run.returncode != 0:
        print(f"{name}: an example does not compile\n{source}\n{run.stderr}")
    return run.returncode == 0


def precompiled(folder):
    """The flags that include Eigen, which nearly every header reads, from a precompiled file; then it is read once."""
    header = folder / "eigen.hpp"
    header.write_text("#include <Eigen/Core>\n")
    flags = ["-std=c++20", "-w"]
    subprocess.run([*COMPILER, *flags, "-x", "c++-header", header, "-o", f"{header}.gch"], check=True)
    return [*flags, "-include", str(header)]


def main():
    with tempfile.TemporaryDirectory() as folder:
        sys.exit(failures(precompiled(pathlib.Path(folder))))


def failures(flags):
    listed = re.findall(
        r"^\| `((?:runtime|identify)/[^`]+)`", (CHECKOUT / "docs/library.md").read_text(), re.MULTILINE
    )
    compiled = failed = 0
    for folder in INSTALLED:
        for header in sorted((CHECKOUT / folder).rglob("*.hpp")):
            name = header.relative_to(CHECKOUT).as_posix()
            if examples := examples_of(header):
                compiled += len(examples)
                failed += not compiles(name, examples, flags)
            elif name in listed:
                failed += 1
                print(f"{name}: has no example; docs/library.md lists it as a header to start with")
    for name in listed:
        if not (CHECKOUT / name).is_file():
            failed += 1
            print(f"docs/library.md lists {name}, which does not exist")
    print(f"{compiled} examples, {failed} headers fail")
    return 1 if failed or not compiled else 0


main()
