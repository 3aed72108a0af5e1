#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# first_hour.sh PROGRAM NODE_MODULES [OUT [SITE [EXPLORER]]]: the path of somebody new, from README to a first answer: points of
# one's own verified and measured beside others, a scene of one's own ranked, a report. Each command, what it says and how
# long it takes go to standard output; then the report, and with SITE (of make docs) and EXPLORER (a file) these, are opened
# in Chromium by the keyboard alone, at 400 and 1280 px, light and dark, with pictures in OUT. Exit code 77: no browser.
set -u
here=$(readlink -f "$(dirname "$0")")
program=$(readlink -f "$1")
KOKSMA_NODE=$(readlink -f "$2")
export KOKSMA_NODE
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=${3:-$work/pictures}
mkdir -p "$work/bin" "$out" || exit 1
out=$(readlink -f "$out")
ln -s "$program" "$work/bin/koksma"
PATH="$work/bin:$PATH"
site=${4:+$(readlink -f "$4")}
explorer=${5:+$(readlink -f "$5")}
cd "$work" || exit 1
failed=0 begun=$(date +%s)

# step CODES COMMAND: runs a command, which must end with one of the codes.
step() {
  codes=$1 from=$(date +%s)
  shift
  printf '$ %s\n' "$*"
  sh -c "$*" </dev/null
  code=$?
  printf '[exit %d, %d s]\n\n' $code $(($(date +%s) - from))
  case " $codes " in *" $code "*) ;; *)
    echo "wrong exit code"
    failed=$((failed + 1))
    ;;
  esac
}

# The commands of README that this path follows are in README.
for command in 'koksma rank' 'koksma measure' 'koksma datasheet' 'koksma study'; do
  grep -q "$command" "$here/../../README.md" || { echo "README.md does not show $command"; failed=$((failed + 1)); }
done

# A sampler of one's own: the additive recurrence of the golden ratio, (i / n, i phi mod 1).
awk 'BEGIN { for (i = 0; i < 64; i++) { y = i * 0.618033988749895; printf "%.17g %.17g\n", i / 64, y - int(y) } }' >mine.txt
step '0 1' koksma verify mine.txt
step 0 koksma measure mine.txt -m star,l2-star
step 0 koksma measure pattern:jittered@64 --trials 20 -m star,l2-star

# A scene of one's own.
cat >mine.json <<'END'
{"title": "Mine", "image": {"width": 48, "height": 36}, "camera": {"eye": [0, 2, 7], "target": [0, 1, 0], "fov_deg": 40},
 "ambient": 0.1, "background": [0.2, 0.3, 0.4],
 "materials": [{"name": "red", "kind": "lambert", "albedo": [0.8, 0.2, 0.1]}],
 "shapes": [{"kind": "sphere", "center": [0, 1, 0], "radius": 1, "material": "red"}],
 "lights": [{"kind": "rectangle", "center": [2, 5, 3], "facing": [0, 0, 0], "half": [0.7, 0.7], "strength": 1}]}
END
step 0 koksma scene check mine.json
step '0 1' koksma rank mine.json --spp 4 -p random,jittered,sobol:scramble=owen --time-limit 20 -q
step 0 koksma study quick -p random,jittered,n-rooks,sobol:scramble=owen,file:mine.txt -n 16,64 --scene mine.json --spp 4,16 --quick -o results -q
echo "to here: $(($(date +%s) - begun)) s"

[ $failed -eq 0 ] || exit 1
command -v node >/dev/null || { echo "skipped: node is not installed (scripts/setup browser)"; exit 77; }
# shellcheck disable=SC2086
node "$here/first_hour.cjs" "$out" results/report.html ${site:+"$site/index.html" "$site/patterns/n-rooks.html" "$site/commands/study.html"} ${explorer:+"$explorer"}
