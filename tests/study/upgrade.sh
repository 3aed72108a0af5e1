#!/bin/sh
# upgrade.sh KOKSMA: stores of every schema that there was (stores/schema_3.sqlite to _5, of two trials of plan.json, made
# with the text of that schema) are read without a byte being changed; a run upgrades them, and keeps their rows. Those
# of schemas 3 and 4 lack the coherence of images: the next run renders these again. Then all rows are those of a new
# folder, also after more trials.
set -eu
koksma=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
"$koksma" study run "$here/plan.json" --trials 2 -o new -q
"$koksma" study run "$here/plan.json" -o whole -q
"$koksma" study export new > new.csv
"$koksma" study export whole > whole.csv
grep -v '^coherence,' new.csv > without.csv
test "$(grep -c '^coherence,' new.csv)" -eq 4
for schema in 3 4 5; do
    mkdir $schema
    cp "$here/stores/schema_$schema.sqlite" $schema/results.sqlite
    "$koksma" study export $schema > $schema.csv
    "$koksma" study report $schema
    "$koksma" study audit $schema --rows all -q > audit.txt
    cmp $schema/results.sqlite "$here/stores/schema_$schema.sqlite"
    test "$(ls $schema | tr '\n' ' ')" = "report.html report.json results.sqlite "
    if [ $schema = 5 ]; then cmp $schema.csv new.csv; done=14; else cmp $schema.csv without.csv; done=10; fi
    "$koksma" study run "$here/plan.json" --trials 2 -o $schema 2> run.txt
    grep -q " $done of them done before, $((14 - done)) now" run.txt
    "$koksma" study export $schema | cmp - new.csv
    "$koksma" study run "$here/plan.json" -o $schema -q
    "$koksma" study export $schema | cmp - whole.csv
done
# The view has them, too.
python3 -c 'import sqlite3; a = [sqlite3.connect(d + "/results.sqlite").execute("SELECT * FROM rows ORDER BY 1, 2, 3, 4, 5, 6, \
7, 8, 9, 10, 11").fetchall() for d in ("3", "4", "5", "whole")]; assert a[0] == a[1] == a[2] == a[3] and len(a[0]) > 50, len(a[0])
values = sqlite3.connect("whole/results.sqlite").execute("SELECT sd, p, frequency_x FROM rows WHERE kind = \"coherence\" \
").fetchall(); assert len(values) == 6 and all(v[0] is None and 0 <= v[1] <= 1 and 0 <= v[2] <= .5 for v in values), values'
test "$(wc -l < whole.csv)" -eq "$(python3 -c 'import sqlite3
print(1 + sqlite3.connect("3/results.sqlite").execute("SELECT count(*) FROM rows").fetchone()[0])')"
