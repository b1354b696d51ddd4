#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# certify_test.sh CATENA_DERIVE: a certificate holds for what it was written for, run after run, and
# for nothing else: not for a changed byte, a changed certificate or another model.
set -euo pipefail
derive=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
  echo "$*"
  exit 1
}

# certify STATUS TEXT: it ends with this status and says this
certify() {
  local wanted=$1 text=$2 status=0
  "$derive" certify --links 3 --effect load_drag --folder model >said 2>&1 || status=$?
  [[ $status == "$wanted" ]] || { cat said; fail "status $status instead of $wanted"; }
  grep -qF -- "$text" said || { cat said; fail "it does not say: $text"; }
}

name=chain_load_drag_3
"$derive" derive --links 3 --effect load_drag --output model >/dev/null
certify 2 "there is no such file; write it with certify --write"
"$derive" certify --links 3 --effect load_drag --folder model --write >/dev/null
cp -r model certified
for run in 1 2 3; do certify 0 "as certified"; done

# a byte of the code, one of a header it includes, a missing file
sed -i '0,/theta\[2\] - theta\[1\]/s//theta[1] - theta[2]/' "model/$name.hpp"
cmp -s "model/$name.hpp" "certified/$name.hpp" && fail "the test changed nothing"
certify 1 "$name.hpp is not what is derived, from line"
cp "certified/$name.hpp" model/
printf ' ' >>model/quasiseparable.hpp
certify 1 "quasiseparable.hpp is not what is derived, from line"
cp certified/quasiseparable.hpp model/
rm "model/$name.cpp"
certify 1 "$name.cpp is not there"
cp "certified/$name.cpp" model/

# one byte in the middle of every file, all kinds
for file in model/*; do
  [[ $file == *.certificate.json ]] && continue
  at=$(($(stat -c %s "$file") / 2))
  [[ $(dd if="$file" bs=1 skip=$at count=1 status=none) == x ]] && byte=y || byte=x
  printf %s $byte | dd of="$file" bs=1 seek=$at conv=notrunc status=none
done
certify 1 FAILED
for file in model/*; do
  [[ $file == *.certificate.json ]] && continue
  grep -q "^  ${file#model/} is not what is derived" said || fail "$file: not noticed"
done
cp certified/* model/

# the certificate itself
sed -i 's/"proved": true/"proved": false/' "model/$name.certificate.json"
certify 1 "/proofs/0/proved: on file false, now true"
grep -q 'residual at neutral values = the plain chain' certified/$name.certificate.json ||
  fail "not compared with the plain chain"
cp "certified/$name.certificate.json" model/
sed -i 's/"tolerance_roundings": [0-9.]*/"tolerance_roundings": 1e9/' "model/$name.certificate.json"
certify 1 "numerical.tolerance_roundings: on file 1000000000.0, now"
sed -i 's/"lowest_rad_per_s": /"lowest_rad_per_s": 1/' "certified/$name.certificate.json"
cp "certified/$name.certificate.json" model/
certify 1 "numerical.natural_frequencies.lowest_rad_per_s: on file"
echo "{" >"model/$name.certificate.json"
certify 2 "not valid JSON"

# nothing is written where the code is not what is derived
"$derive" derive --links 3 --effect load_drag --output model >/dev/null
rm "model/$name.certificate.json"
printf ' ' >>"model/$name.hpp"
"$derive" certify --links 3 --effect load_drag --folder model --write >/dev/null && fail "certified"
[[ ! -e model/$name.certificate.json ]] || fail "a certificate was written"
# what models have in common
common="models.hpp models.cpp CMakeLists.txt any_links.hpp chain_any.hpp chain_any.cpp"
"$derive" derive --links 2 --output library --library >/dev/null
"$derive" certify --links 2 --folder library --library --write >/dev/null
"$derive" certify --links 2 --folder library --library >/dev/null
for file in $common; do printf ' ' >>library/$file; done
"$derive" certify --links 2 --folder library --library >said && fail "changed, and certified"
for file in $common; do
  grep -q "^$file is not what is derived" said || fail "$file: not noticed"
done

# C99, beside the C++: its own certificate, and the same changes noticed
"$derive" derive --links 3 --effect steady_wind --format c --output model >/dev/null
c99() { "$derive" certify --links 3 --effect steady_wind --format c --folder model "$@" >said 2>&1; }
c99 --write || fail "C99: not certified"
c99 || fail "C99: not as certified"
name=chain_steady_wind_3
grep -q '"language": "C99"' model/$name.c99.certificate.json || fail "C99: another language"
cp -r model certified_c
for file in $name.c $name.h catena_model.h $name.c99.json; do
  printf ' ' >>model/$file
  c99 && fail "C99: changed, and certified"
  grep -q "^  $file is not what is derived" said || fail "C99: $file: not noticed"
  cp certified_c/$file model/
done

"$derive" derive --links 3 --format c --library --output c_library 2>said && fail "a look-up in C"
[[ $(<said) == *"the look-up of the models is C++"* && ! -e c_library ]] || fail "a look-up in C"

# small motions in the wind: not those in still air
value() { sed -n "/\"$1\"/,/}/s/.*\"lowest_rad_per_s\": \([0-9.]*\).*/\1/p" model/$name.c99.certificate.json; }
[[ -n $(value natural_frequencies_with_effects) ]] || fail "no frequencies with effects"
[[ $(value natural_frequencies) != "$(value natural_frequencies_with_effects)" ]] ||
  fail "the wind does nothing"
sed -i '/natural_frequencies_with_effects/,/}/s/"lowest_rad_per_s": /"lowest_rad_per_s": 1/' \
  model/$name.c99.certificate.json
c99 && fail "another frequency, and certified"
grep -q "natural_frequencies_with_effects.lowest_rad_per_s: on file" said || fail "not said which"
echo "every change was noticed"
