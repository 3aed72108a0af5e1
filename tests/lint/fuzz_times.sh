#!/bin/sh
# fuzz_times.sh: `scripts/fuzz spent` counts the seconds of a target while its code and that of its readers are the same,
# comments aside, and `scripts/fuzz record` moves them to fuzz/spent.csv once the readers are committed; tried in a repository
# of its own.
# Exit code 77: git is not installed.
set -u
command -v git >/dev/null || { echo "git is not installed"; exit 77; }
script=$(cd "$(dirname "$0")/../.." && pwd)/scripts/fuzz
folder=$(mktemp -d) || exit 4
trap 'rm -rf "$folder"' EXIT INT TERM
cd "$folder" || exit 4
failed=0
expect() { # WHAT TARGET TEXT
  found=$(scripts/fuzz spent "$2")
  [ "$found" = "$2: $3" ] || { echo "$1: \"$found\" instead of \"$2: $3\""; failed=1; }
}
save() { git add -A && git -c user.name=test -c user.email=test@example.org commit -q -m "$1" || exit 4; }
head() { git rev-parse --short=12 HEAD; }

mkdir -p scripts fuzz src/other build/fuzz/spent && cp "$script" scripts/ && git init -q . || exit 4
echo 'commit,target,seconds' >fuzz/spent.csv
echo '/* Readers: src/one.c src/other */' >fuzz/fuzz_one.c
echo '/* Readers: src/two.c */' >fuzz/fuzz_two.c
echo build >.gitignore
printf '/* Says one. */\nint one(void) { return 1; }\n' >src/one.c
echo 'int two(void) { return 2; }' >src/two.c
echo 'int other;' >src/other/other.c
save first
first=$(head)
echo "$first,one,100" >>fuzz/spent.csv
echo "$first,two,7" >>fuzz/spent.csv
echo "$first,one,20" >build/fuzz/spent/one
expect 'as they were' one '120 s on the present readers, 0 s on others'
printf '/* Says the number one,\n   always. */\n\nint one(void) {\n  return 1; /* one */\n}\n' >src/one.c
expect 'another comment' one '120 s on the present readers, 0 s on others'
save 'another comment'
expect 'another comment, committed' one '120 s on the present readers, 0 s on others'
expect 'another target' two '7 s on the present readers, 0 s on others'

printf 'int one(void) { return 3; }\n' >src/one.c
expect 'other code' one '0 s on the present readers, 120 s on others'
expect 'other code of another target' two '7 s on the present readers, 0 s on others'
echo "changed,one,50" >>build/fuzz/spent/one
scripts/fuzz record one >/dev/null 2>&1
[ -f build/fuzz/spent/one ] || { echo 'times on readers that no commit has were recorded'; failed=1; }
save 'other code'
echo "$(head),one,30" >build/fuzz/spent/one
echo "$(head),one,5" >>build/fuzz/spent/one
expect 'after the change' one '35 s on the present readers, 100 s on others'
scripts/fuzz record one
[ "$(tail -n 1 fuzz/spent.csv)" = "$(head),one,35" ] || { echo "recorded: $(tail -n 1 fuzz/spent.csv)"; failed=1; }
expect 'once recorded' one '35 s on the present readers, 100 s on others'

printf 'int other;\nint further;\n' >src/other/other.c
expect 'code of a folder' one '0 s on the present readers, 135 s on others'
printf 'int other;\n' >src/other/other.c
echo 'int added;' >src/other/added.c
save 'a file more'
expect 'a file more' one '0 s on the present readers, 135 s on others'
git rm -q src/other/added.c && save 'a file less'
expect 'a file less' one '35 s on the present readers, 100 s on others'

printf '/* Readers: src/one.c src/other */\nint target;\n' >fuzz/fuzz_one.c
expect 'other code of the target' one '0 s on the present readers, 135 s on others'
save 'other code of the target'
echo "$(head),one,5" >>fuzz/spent.csv
expect 'on the new target' one '5 s on the present readers, 135 s on others'
rm src/two.c
expect 'a file that is gone' two '0 s on the present readers, 7 s on others'
exit $failed
