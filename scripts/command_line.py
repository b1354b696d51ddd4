# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts' command lines share. Usage errors end with status 2."""
import argparse
import os
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def parser():
    """With the script's own text as help."""
    return argparse.ArgumentParser(description=sys.modules["__main__"].__doc__,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)


def of_study(name, more={}):
    """`output`, which is made, `binaries`, and `more`: name of an argument -> how argparse is to take it."""
    said = parser()
    said.add_argument("output", nargs="?", type=os.path.abspath, default=f"{ROOT}/build/{name}")
    said.add_argument("binaries", nargs="?", type=os.path.abspath, default=f"{ROOT}/build/release")
    for argument, how in more.items():
        said.add_argument(argument, **how)
    values = said.parse_args()
    if not os.path.exists(f"{values.binaries}/bin/catena"):
        said.error(f"no catena in {values.binaries}/bin; build it, or name the folder")
    if os.path.exists(values.output) and not os.path.isdir(values.output):
        said.error(f"{values.output} is no folder; name another one for the output")
    os.makedirs(values.output, exist_ok=True)
    return values


def part_of_order(text):
    """A slice of a study's fixed order of trials."""
    first, _, last = text.partition(":")
    if not (first.isdigit() and last.isdigit() and int(first) < int(last)):
        raise argparse.ArgumentTypeError(f"{text} is no range A:B of whole numbers, the first below the second")
    return slice(int(first), int(last))
