#!/bin/sh
# upgrade.sh KOKSMA: stores of every schema that there was (stores/schema_3.sqlite to _5, of two trials of plan.json, made
# with the text of that schema) are read without a byte being changed; a run upgrades them, and keeps their rows. Those
# of images are the first renderer's: they stay, and the next run renders these again. Then all others are those of a new
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
now() { "$koksma" study export "$1" | grep -v 'renderer 0'; }
grep -v '^coherence,\|^image,' new.csv > points.csv
test "$(grep -c '^coherence,' new.csv)" -eq 4
for schema in 3 4 5; do
    mkdir $schema
    cp "$here/stores/schema_$schema.sqlite" $schema/results.sqlite
    "$koksma" study export $schema > $schema.csv
    "$koksma" study report $schema
    "$koksma" study audit $schema --rows all -q > audit.txt
    cmp $schema/results.sqlite "$here/stores/schema_$schema.sqlite"
    test "$(ls $schema | tr '\n' ' ')" = "report.html report.json results.sqlite "
    grep -v 'renderer 0' $schema.csv | cmp - points.csv
    test "$(grep -c '^image,.*renderer 0' $schema.csv)" -eq 8
    "$koksma" study run "$here/plan.json" --trials 2 -o $schema 2> run.txt
    grep -q ' 10 of them done before, 4 now' run.txt
    now $schema | cmp - new.csv
    "$koksma" study run "$here/plan.json" -o $schema -q
    now $schema | cmp - whole.csv
    test "$("$koksma" study export $schema | grep -c '^image,.*renderer 0')" -eq 8
done
# The view has them, too.
python3 -c 'import sqlite3; a = [[r for r in sqlite3.connect(d + "/results.sqlite").execute("SELECT * FROM rows ORDER BY \
1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11").fetchall() if "renderer 0" not in str(r)] for d in ("3", "4", "5", "whole")]; assert a[0] == a[1] == a[2] == a[3] and len(a[0]) > 50, len(a[0])
values = sqlite3.connect("whole/results.sqlite").execute("SELECT sd, p, frequency_x FROM rows WHERE kind = \"coherence\" \
").fetchall(); assert len(values) == 6 and all(v[0] is None and 0 <= v[1] <= 1 and 0 <= v[2] <= .5 for v in values), values'
test "$(wc -l < whole.csv)" -eq "$(python3 -c 'import sqlite3
print(1 + sqlite3.connect("whole/results.sqlite").execute("SELECT count(*) FROM rows").fetchone()[0])')"
