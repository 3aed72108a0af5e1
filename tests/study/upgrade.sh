#!/bin/sh
# upgrade.sh KOKSMA: a folder whose store has schema 3 (schema_3.sql, of two trials of plan.json) has the rows of a new
# run but the coherence of its images, which neither schema 3 nor 4 had; the next run renders those images again, and
# then all rows are those of a new folder, also after more trials.
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
"$koksma" study export new > new.csv
grep -v '^coherence,' new.csv | cmp - old.csv
test "$(grep -c '^coherence,' new.csv)" -eq 4
# Schema 4: the same without the coherence and its columns in the view.
cp -r new four
python3 -c 'import sqlite3; c = sqlite3.connect("four/results.sqlite")
c.execute("DELETE FROM result WHERE id & 4294967295 IN (SELECT id FROM series WHERE kind = \"coherence\")")
c.execute("DELETE FROM series WHERE kind = \"coherence\"")
c.execute("UPDATE meta SET value = 4 WHERE key = \"schema\"")
c.execute("DROP VIEW rows"); c.execute("CREATE VIEW rows AS SELECT 1"); c.commit()'
"$koksma" study export four | cmp - old.csv
"$koksma" study run "$here/plan.json" --trials 2 -o four 2> four.txt
grep -q ' 10 of them done before, 4 now' four.txt
"$koksma" study export four | cmp - new.csv
"$koksma" study run "$here/plan.json" -o old -q
"$koksma" study run "$here/plan.json" -o whole -q
"$koksma" study export old > old.csv
"$koksma" study export whole | cmp - old.csv
# The view has them, too.
python3 -c 'import sqlite3; a = [sqlite3.connect(d + "/results.sqlite").execute("SELECT * FROM rows ORDER BY 1, 2, 3, 4, 5, 6, \
7, 8, 9, 10, 11").fetchall() for d in ("old", "whole")]; assert a[0] == a[1] and len(a[0]) > 50, len(a[0])
values = sqlite3.connect("whole/results.sqlite").execute("SELECT sd, p, frequency_x FROM rows WHERE kind = \"coherence\" \
").fetchall(); assert len(values) == 6 and all(v[0] is None and 0 <= v[1] <= 1 and 0 <= v[2] <= .5 for v in values), values'
test "$(wc -l < old.csv)" -eq "$(python3 -c 'import sqlite3
print(1 + sqlite3.connect("old/results.sqlite").execute("SELECT count(*) FROM rows").fetchone()[0])')"
