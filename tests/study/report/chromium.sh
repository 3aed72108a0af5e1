#!/bin/sh
# chromium.sh PROGRAM NODE_MODULES: the reports of a small study, of a wide one and of a reproduction, and a datasheet of files, in Chromium. Exit code 77: skipped.
set -u
here=$(readlink -f "$(dirname "$0")")
program=$(readlink -f "$1")
KOKSMA_NODE=$2
export KOKSMA_NODE
command -v node >/dev/null || { echo "skipped: node is not installed (scripts/setup browser)"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
"$program" study new plan.json && sed -i 's/1024/64/' plan.json && "$program" study run ./plan.json -o study --trials 4 -q &&
  echo '{"name": "wide", "title": "Wide", "questions": [{"id": "k", "kind": "table", "title": "K", "discrepancies": "d"}],
    "discrepancies": [{"id": "d", "patterns": ["random", "jittered", "n-rooks", "regular", "halton", "sobol", "sobol:scramble=owen",
    "hammersley", "hammersley:shift=1", "zaremba", "multi-jittered", "pmj02", "faure", "sz", "cascaded-sobol",
    "larcher-pillichshammer"], "measures": ["star", "min-distance"], "n": [8, 16, 32, 64, 128, 256, 512, 1024],
    "trials": 5, "skip": true}]}' > wide.json && "$program" study run ./wide.json -o wide -q &&
  "$program" reproduce "$here/../../cli/plans/small.json" -o paper -q --table none || exit 1
for n in 16 64; do
    for seed in 0 1 2 3; do "$program" generate jittered -n $n -s $seed -q -o "a_name_that_is_long_${n}_$seed.npy" || exit 1; done
done
"$program" datasheet 'a_name_that_is_long_{n}_{seed}.npy' --scenes checker --quick -q -o sheet.html || exit 1
for page in study/report wide/report paper/report sheet; do node "$here/chromium.js" $page.html || exit $?; done
