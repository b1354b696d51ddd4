#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
#
# effect_program_test.sh CATENA_DERIVE CHECKOUT: the effect of docs/effects.md derives; what is wrong
# with one is said with its line, status 2, and nothing is written.
set -euo pipefail
derive=$1
checkout=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

awk '/^```toml/ { inside = 1; next } /^```/ { inside = 0 } inside' "$checkout/docs/effects.md" \
  >hinge_rub.toml
"$derive" derive --links 5 --effect hinge_rub.toml --output good >/dev/null
[[ -s good/chain_hinge_rub_5.cpp ]]
grep -q '"hinge_rub.moment", "N m"' good/chain_hinge_rub_5.cpp

# refused EDIT TEXT: with this edit (sed) it is refused, saying this
refused() {
  local status=0
  sed "$1" hinge_rub.toml >wrong.toml
  cmp -s hinge_rub.toml wrong.toml && { echo "the edit $1 changes nothing"; exit 1; }
  "$derive" derive --links 5 --effect wrong.toml --output wrong >said 2>&1 || status=$?
  if [[ $status != 2 || -e wrong ]] || ! grep -qF -- "$2" said; then
    echo "the edit $1: status $status"
    cat said
    exit 1
  fi
}
refused 's/rate_scale)"/1)"/' 'is in 1/s, but "1" is in 1; terms of a sum need one unit'
refused 's/unit = "N m"/unit = "N"/' 'it is in W/m where W is wanted'
refused 's/unit = "N m"/unit = "N mm"/' '"mm" is not a coherent SI unit; give the value in m'
refused 's/joint_rate/joint_rat/g' '"joint_rat" has no meaning here; did you mean "joint_rate"?'
refused 's/at = "pivot"/at = "load"/' '"joint_rate" has no meaning here'
refused 's/sqrt(joint/abs(joint/' 'abs has no derivative everywhere'
refused 's/lower = 0.0/lwer = 0.0/' 'unknown key "parameters.moment.lwer"; did you mean "lower"?'
refused 's/^value = 0.01/value = "a"/' 'constants.rate_scale.value: "a" is a text where a number'
refused 's/dissipation/disipation/' 'unknown key "disipation"; did you mean "dissipation"?'
refused 's/^kind = .*/kind = "case"/' 'kind: "case" where a file of kind "effect" is wanted'
echo "every mistake was named"
