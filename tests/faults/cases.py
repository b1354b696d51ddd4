# SPDX-License-Identifier: BSD-3-Clause
"""Cases that take a moment, for the tests of faults."""
SWING = """format = 1
kind = "case"
[model]
links = 2
[cable]
length = 1.0
density = 0.3
load_mass = 0.2
[[parameter]]
name = "k"
sets = "stiffness"
value = 0.1
unit = "N m/rad"
[[parameter]]
name = "c"
sets = "damping"
value = 0.005
unit = "N m s/rad"
[initial]
shape = "straight"
angle = 0.6
"""
ALONE = SWING + "[simulation]\nduration = 1.0\nstep = 0.02\n"
DATA = '[[experiment]]\nname = "swing"\ndata = "swing.csv"\nkind = "markers"\n'
FIT = SWING.replace("value = 0.1\n", "value = 0.05\nfree = true\nlower = 0.001\nupper = 1.0\n").replace(
    "value = 0.005\n", "value = 0.002\nfree = true\nlower = 0.0001\nupper = 1.0\n"
) + DATA  # fmt: skip
STARTS = '[optimiser]\nmethod = "nelder_mead"\nstarts = {}\n'
AIR = 'format = 1\nkind = "model"\nid = "air"\neffects = ["pivot_damping"]\n'


def files_in(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}
