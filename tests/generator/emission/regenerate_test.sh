#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# regenerate_test.sh CATENA_DERIVE CHECKOUT: what is in generated/ is what the generator writes, on
# every one of several runs (address randomisation makes each run's hashes differ).
set -euo pipefail
derive=$1
checkout=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
for run in 1 2 3 4 5; do
  "$derive" derive --description "$checkout/generator/models.toml" --library \
    --output "$scratch/$run" >/dev/null
  if ! diff -ruN --exclude="*.certificate.json" "$checkout/generated" "$scratch/$run"; then
    echo "generated/ differs from what catena-derive writes. To update it: scripts/regenerate"
    exit 1
  fi
done
echo "the same files, byte for byte, on 5 runs"
