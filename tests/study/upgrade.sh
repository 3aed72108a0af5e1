#!/bin/sh
# upgrade.sh KOKSMA: stores of every schema that there was (stores/schema_3.sqlite to _5, and plan_6.sqlite, of two trials
# of plan.json, made with the text of that schema) are read without a byte being changed; a run upgrades them, and keeps
# their rows. Those of images of schemas 3 to 5 are the first renderer's: they stay, and the next run renders these again.
# Then all others are those of a new folder, also after more trials. Rows of schema 6 have no metrics: the report says so,
# and the next run adds them. Plans that this version refuses are read. A damaged store of schema 6 is refused, and stays as
# it is.
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
grep -v '^coherence,\|^image,\|^metric,' new.csv > points.csv
grep -v '^metric,' new.csv > six.csv
test "$(grep -c '^coherence,' new.csv)" -eq 4
test "$(grep -c '^metric,' new.csv)" -eq 16
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
# Schema 6: a report by a metric that no row has says so, and changes nothing.
file=$here/stores/plan_6.sqlite
mkdir 6 asked damaged
cp "$file" 6/results.sqlite
"$koksma" study export 6 | cmp - six.csv
"$koksma" study report 6
"$koksma" study audit 6 --rows all -q > audit.txt
cmp 6/results.sqlite "$file"
said() { python3 -c 'import json, sys
def words(block):
    for run in block.get("text", []):
        yield run if isinstance(run, str) else run["text"]
    for inner in block.get("content", []):
        yield from words(inner)
print("".join(word for block in json.load(open(sys.argv[1] + "/report.json"))["content"] for word in words(block)))' "$1"; }
said 6 | grep -q 'by each metric: mae [a-z-]*, rmse not measured, relmse not measured, smape not measured'
cp "$file" asked/results.sqlite
python3 - "$here" << 'END'
import sqlite3, sys
sys.path.insert(0, sys.argv[1])
from reseal import reseal
database = sqlite3.connect("asked/results.sqlite")
database.execute("UPDATE meta SET value = replace(value, '{\n  \"name\"', '{\n  \"metric\": \"relmse\", \"name\"') WHERE key = 'plan-text-0'")
database.commit()
database.close()
reseal("asked")
END
"$koksma" study report asked
said asked | grep -q 'patterns ranked, by relmse: .* It is not measured in 4 of 4 images'
# A plan that only an older version ran, whose patterns or measures refuse numbers of points, is read from its store; a
# new run is refused.
cat > refused.json << 'END'
{"name": "r", "title": "r", "discrepancies": [{"patterns": ["random", "jittered"], "measures": ["t-value", "l2-star"],
 "n": [16, 24], "trials": 2, "skip": true}], "images": [{"scenes": ["ball"], "patterns": ["random", "jittered"],
 "spp": [2, 4], "size": [8, 6], "trials": 2, "skip": true, "references": [{"name": "c", "pattern": "random", "spp": 8}]}]}
END
"$koksma" study run ./refused.json -o refused -q
"$koksma" study export refused -q > refused.csv
python3 - "$here" << 'END'
import sqlite3, sys
sys.path.insert(0, sys.argv[1])
from reseal import reseal
database = sqlite3.connect("refused/results.sqlite")
database.execute("""UPDATE meta SET value = replace(value, '"skip": true', '"skip": false') WHERE key = 'plan-text-0'""")
database.commit()
database.close()
reseal("refused")
END
"$koksma" study report refused
"$koksma" study export refused -q | cmp - refused.csv
"$koksma" study audit refused --rows all -q > audit.txt
sed -i 's/"skip": true/"skip": false/' refused.json
if "$koksma" study run ./refused.json -o new_refused -q 2> error.txt; then exit 1; fi
grep -q 'n = 24 is not ' error.txt
test ! -e new_refused
# So is a plan whose folder's name makes its file a family; an older version read the files of that family.
mkdir 16
"$koksma" generate random@16 -q -o 16/a.txt
cat > family.json << 'END'
{"name": "f", "title": "f", "discrepancies": [{"patterns": ["file:./{n}/a.txt"], "measures": ["star"], "n": [16], "trials": 1}]}
END
"$koksma" study run ./family.json -o family -q
python3 - "$here" << 'END'
import sqlite3, sys
sys.path.insert(0, sys.argv[1])
from reseal import reseal
database = sqlite3.connect("family/results.sqlite")
database.execute("UPDATE meta SET value = replace(value, './{n}/a.txt', 'a.txt') WHERE key = 'plan-text-0'")
database.execute("UPDATE meta SET value = './{n}/family.json' WHERE key = 'plan-name-0'")
database.commit()
database.close()
reseal("family")
END
"$koksma" study report family
"$koksma" study audit family --rows all -q > audit.txt
grep -q '^1 rows drawn' audit.txt
# Damage to a store of schema 6 is found by a reader, by an audit, and by a run, which leaves the file as it is.
cp "$file" damaged/results.sqlite
python3 -c 'import sqlite3; d = sqlite3.connect("damaged/results.sqlite"); d.execute("PRAGMA journal_mode=DELETE"); d.execute("UPDATE result SET v0 = 0.5 WHERE id = (SELECT max(id) FROM result)"); d.commit()'
cp damaged/results.sqlite before
for verb in export report; do
    if "$koksma" study $verb damaged 2> error.txt; then exit 1; fi
    grep -q '^koksma study: damaged/results.sqlite: damaged or changed by hand' error.txt
done
if "$koksma" study run "$here/plan.json" -o damaged -q 2> error.txt; then exit 1; fi
grep -q '^koksma study: damaged/results.sqlite: damaged or changed by hand' error.txt
cmp damaged/results.sqlite before
if "$koksma" study audit damaged --rows all -q > audit.txt; then exit 1; fi
grep -q 'the stored value is 0.5' audit.txt
cmp damaged/results.sqlite before
# A run renders the images again and adds their metrics.
"$koksma" study run "$here/plan.json" --trials 2 -o 6 2> run.txt
grep -q ' 10 of them done before, 4 now' run.txt
"$koksma" study export 6 | cmp - new.csv
"$koksma" study run "$here/plan.json" -o 6 -q
"$koksma" study export 6 | cmp - whole.csv
"$koksma" study audit 6 --rows all -q > audit.txt
# The view has them, too.
python3 -c 'import sqlite3; a = [[r for r in sqlite3.connect(d + "/results.sqlite").execute("SELECT * FROM rows ORDER BY \
1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, metric").fetchall() if "renderer 0" not in str(r)] for d in ("3", "4", "5", "6", "whole")]; assert all(b == a[0] for b in a) and len(a[0]) > 50, len(a[0])
values = sqlite3.connect("whole/results.sqlite").execute("SELECT sd, p, frequency_x FROM rows WHERE kind = \"coherence\" \
").fetchall(); assert len(values) == 6 and all(v[0] is None and 0 <= v[1] <= 1 and 0 <= v[2] <= .5 for v in values), values'
test "$(wc -l < whole.csv)" -eq "$(python3 -c 'import sqlite3
print(1 + sqlite3.connect("whole/results.sqlite").execute("SELECT count(*) FROM rows").fetchone()[0])')"
