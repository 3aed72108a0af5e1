#!/bin/sh
# upgrade.sh KOKSMA: a folder whose store has schema 3 (schema_3.sql, of two trials of plan.json) has the rows of a new
# run, also after more trials in it.
set -eu
koksma=$1
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir old
python3 -c 'import sqlite3, sys; sqlite3.connect("old/results.sqlite").executescript(open(sys.argv[1]).read())' \
    "$here/schema_3.sql"
"$koksma" study export old > old.csv
"$koksma" study run "$here/plan.json" --trials 2 -o new -q
"$koksma" study export new | cmp - old.csv
"$koksma" study run "$here/plan.json" -o old -q
"$koksma" study run "$here/plan.json" -o whole -q
"$koksma" study export old > old.csv
"$koksma" study export whole | cmp - old.csv
# The view has them, too.
python3 -c 'import sqlite3; a = [sqlite3.connect(d + "/results.sqlite").execute("SELECT * FROM rows ORDER BY 1, 2, 3, 4, 5, 6, \
7, 8, 9, 10, 11").fetchall() for d in ("old", "whole")]; assert a[0] == a[1] and len(a[0]) > 50, len(a[0])'
test "$(wc -l < old.csv)" -eq "$(python3 -c 'import sqlite3
print(1 + sqlite3.connect("old/results.sqlite").execute("SELECT count(*) FROM rows").fetchone()[0])')"
