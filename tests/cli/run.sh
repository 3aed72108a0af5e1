#!/bin/sh
# run.sh PROGRAM FILE.test: runs the commands of a CLI test in an empty folder and compares what they print.
# FILE.test holds blocks of a command and what it is to give, as a terminal would show it:
#
#   $ koksma list patterns | head -1
#   pattern  dim  ...
#
# Both streams are shown, stderr in its place; a non-zero exit code is shown as a last line "[exit N]".
# A line of the expected output that begins with "~ " is an extended regular expression for the whole line.
# A command after "$long " instead of "$ " is left out where KOKSMA_SANITIZED is 1 (tests/CMakeLists.txt): it repeats, for longer,
# what shorter ones do. `few A B` prints A there and B elsewhere: how often, how large.
set -u
program=$(readlink -f "$1")
test=$(readlink -f "$2")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin" "$work/run"
ln -s "$program" "$work/bin/koksma"
ln -s "$(dirname "$test")/../study/report/text.py" "$work/bin/report-text" # the report of a study as lines of text
printf '#!/bin/sh\n[ "${KOKSMA_SANITIZED:-0}" = 1 ] && echo "$1" || echo "$2"\n' >"$work/bin/few"
chmod +x "$work/bin/few"
PATH="$work/bin:$PATH"
KOKSMA_TESTS=$(dirname "$(dirname "$test")")
export PATH KOKSMA_TESTS
cd "$work/run" || exit 1
awk -v work="$work" '
  /^\$(long)? / {
    taken = /^\$ / || ENVIRON["KOKSMA_SANITIZED"] != 1
    if (taken) { n++; sub(/^[^ ]* /, ""); print > (work "/command." n); printf "" > (work "/expected." n) }
    next
  }
  !taken { next }
  /^  \.\.\. / { print substr($0, 7) >> (work "/command." n); next }
  !/^#/ && !/^$/ { print > (work "/expected." n) }
  END { print n + 0 > (work "/count") }' "$test"
failed=0 passed=0
count=$(cat "$work/count")
for i in $(seq 1 "$count"); do
  sh "$work/command.$i" >"$work/actual" 2>&1 </dev/null
  code=$?
  [ $code -eq 0 ] || echo "[exit $code]" >>"$work/actual"
  if awk -v actual="$work/actual" '
      BEGIN { bad = 0 }
      { more = (getline line < actual)
        if (more <= 0) { bad = 1 }
        else if (/^~ /) { pattern = "^(" substr($0, 3) ")$"; if (line !~ pattern) bad = 1 }
        else if (line "" != $0 "") bad = 1 } # as texts: 1e+05 is not 100000
      END { if ((getline line < actual) > 0) bad = 1; exit bad }' "$work/expected.$i"; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "--- $(basename "$test"): \$ $(cat "$work/command.$i")"
    echo "expected:"; sed 's/^/  /' "$work/expected.$i"
    echo "got:"; sed 's/^/  /' "$work/actual"
  fi
done
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$count" -gt 0 ]
