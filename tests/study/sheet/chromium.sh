#!/bin/sh
# chromium.sh PROGRAM NODE_MODULES: a datasheet of files in Chromium. Exit code 77: skipped.
set -u
here=$(readlink -f "$(dirname "$0")")
program=$(readlink -f "$1")
KOKSMA_NODE=$2
export KOKSMA_NODE
command -v node >/dev/null || { echo "skipped: node is not installed (scripts/setup browser)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
for n in 16 64; do
    for seed in 0 1 2 3; do "$program" generate jittered -n $n -s $seed -q -o "a_name_that_is_long_${n}_$seed.npy" || exit 1; done
done
"$program" datasheet 'a_name_that_is_long_{n}_{seed}.npy' --scenes checker --quick -q -o sheet.html && node "$here/chromium.js" sheet.html
