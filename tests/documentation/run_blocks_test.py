# SPDX-License-Identifier: BSD-3-Clause
"""run_blocks.py tried on pages that it must accept and on pages that it must refuse."""
import pathlib
import subprocess
import sys
import tempfile

RUNNER = pathlib.Path(__file__).with_name("run_blocks.py")
ROWS = [  # (what, the page, whether it passes)
    ("output as shown", "```console\n$ echo one 2\none 2\n```\n", True),
    ("other text", "```console\n$ echo one\ntwo\n```\n", False),
    ("a number within 2 %", "```console\n$ echo 1.01 m\n1.00 m\n```\n", True),
    ("a number too far", "```console\n$ echo 1.05 m\n1.00 m\n```\n", False),
    ("a sign", "```console\n$ echo -1.00\n1.00\n```\n", False),
    ("any lines", "```console\n$ seq 9\n1\n...\n9\n```\n", True),
    ("any text", "```console\n$ echo took 3 s\ntook ... s\n```\n", True),
    ("a line missing", "```console\n$ seq 2\n1\n```\n", False),
    ("a line too many", "```console\n$ seq 1\n1\n2\n```\n", False),
    ("a failure unannounced", "```console\n$ false\n```\n", False),
    ("a failure announced", "```console\n$ exit 2\n[exit status 2]\n```\n", True),
    ("a file", "```toml a.toml\nx = 1\n```\n```console\n$ cat a.toml\nx = 1\n```\n", True),
    ("a block of nothing", "```toml\nx = 1\n```\n", False),
    ("a drawing", "```text\n/\\\n```\n", True),
    ("elsewhere", "```console elsewhere\n$ scripts/test\n```\n", True),
    ("elsewhere, but nowhere", "```console elsewhere\n$ scripts/no_such\n```\n", False),
]

wrong = 0
for what, text, passes in ROWS:
    with tempfile.TemporaryDirectory() as folder:
        page = pathlib.Path(folder) / "page.md"
        page.write_text(text)
        run = subprocess.run(
            [sys.executable, RUNNER, page, sys.argv[1]], capture_output=True, text=True
        )
    if (run.returncode == 0) != passes:
        wrong += 1
        print(f"{what}: {'refused' if passes else 'accepted'}\n{run.stdout}{run.stderr}")
print(f"{len(ROWS) - wrong} passed, {wrong} failed")
sys.exit(1 if wrong else 0)
