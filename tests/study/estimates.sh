#!/bin/sh
# estimates.sh KOKSMA OPTION PLAN...: what `koksma study estimate` says of a plan is within a factor of 2 of the
# processor time that a run of it records, with the option (--quick, --trials=3) on both. The tests take one
# plan and few trials; by hand, in about four minutes on two cores:
#   tests/study/estimates.sh build/release/koksma --quick mitchell1992 shirley1991 open-questions
set -eu
koksma=$1 option=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
wrong=0
# Three attempts: processor time, too, is longer beside others that share a core's caches.
agrees() {
    rm -rf "$folder/$plan"
    said=$("$koksma" study estimate "$plan" "$option" --json | sed 's/.*"cpu_seconds":\([^,]*\),.*/\1/')
    "$koksma" study run "$plan" "$option" -o "$folder/$plan" -q
    took=$(python3 -c 'import sqlite3, sys; print(sqlite3.connect(sys.argv[1]).execute(
        "SELECT sum(processor_seconds) FROM run").fetchone()[0])' "$folder/$plan/results.sqlite")
    echo "$plan: $said s estimated, $took s taken"
    awk -v said="$said" -v took="$took" 'BEGIN { exit !(said > took / 2 && said < 2 * took) }'
}
for plan; do
    agrees || agrees || agrees || wrong=1
done
exit $wrong
