#!/bin/sh
# chromium.sh PROGRAM NODE_MODULES: the report of a small study, and of a reproduction, in Chromium. Exit code 77: skipped.
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
  "$program" reproduce "$here/../../cli/plans/small.json" -o paper -q --table none || exit 1
node "$here/chromium.js" study/report/report.html && node "$here/chromium.js" paper/report.html
