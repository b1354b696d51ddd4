# SPDX-License-Identifier: BSD-3-Clause
"""Cases that take a moment, for the tests of faults."""
from pathlib import Path

SUPPORT = Path(__file__).resolve().parents[1] / "support"
ALONE = (SUPPORT / "swing.toml").read_text()
SWING = ALONE.split("[simulation]")[0]
DATA = '[[experiment]]\nname = "swing"\ndata = "swing.csv"\nkind = "markers"\n'
FIT = (SUPPORT / "fit.toml").read_text().split("[[experiment]]")[0] + DATA
STARTS = '[optimiser]\nmethod = "nelder_mead"\nstarts = {}\n'
AIR = 'format = 1\nkind = "model"\nid = "air"\neffects = ["pivot_damping"]\n'


def files_in(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}
