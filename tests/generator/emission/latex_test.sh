#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# latex_test.sh CATENA_DERIVE: the LaTeX is the same on every run, and pdflatex, where there is one,
# makes a document of it without an error or a line too wide.
set -euo pipefail
derive=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

effects=()
for effect in steady_wind added_mass axial_stretch joint_hysteresis support_motion load_inertia; do
  effects+=(--effect "$effect")
done
for run in 1 2 3 4 5; do
  "$derive" derive --links 2 3 4 --latex --output "$run" >/dev/null
  "$derive" derive --links 2 "${effects[@]}" --latex --output "$run" >/dev/null
  diff -r 1 "$run" || { echo "run $run differs from the first"; exit 1; }
done

"$derive" derive --links 21 --latex --output many 2>message && status=0 || status=$?
[[ $status == 2 && ! -e many ]] || { echo "21 links: status $status"; exit 1; }
grep -q "nobody reads more than 20" message
"$derive" derive --links 2 --latex --format c --output many 2>message && status=0 || status=$?
[[ $status == 2 && ! -e many ]] || { echo "LaTeX and C at once: status $status"; exit 1; }

if ! command -v pdflatex >/dev/null; then
  echo "no pdflatex here: not compiled (scripts/setup latex installs it)"
  exit 0
fi
cd 1
for file in *.tex; do
  pdflatex -halt-on-error -interaction=nonstopmode "$file" >log || { cat log; exit 1; }
  # the equations of single effects may be wider than a page, the chain's never
  if [[ $file == chain.tex ]] && grep "^Overfull" log; then exit 1; fi
done
