#!/bin/sh
# readme.sh PROGRAM: the commands that README.md, docs/commands.md and the examples of every --help show are run, in their
# order and in one folder; rankings and studies of papers, which take minutes, with their --help, searches with fewer points
# and one step. Files that they speak of are there before. Every command has an example, in its manual page as well;
# README and the change log say how many patterns there are.
set -u
program=$(readlink -f "$1")
root=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/bin"
ln -s "$program" "$work/bin/koksma"
PATH="$work/bin:$PATH"
cd "$work" || exit 1
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n' >model.obj
koksma render checker --size 16x12 -n 1 -q -o photo.png >/dev/null
meshes=$(koksma version | grep -c '^meshes: Embree')
koksma generate n-rooks -n 16 -q -o points.txt &&
  koksma render ball -n 1 --size 16x16 -q -o ball.exr >/dev/null &&
  koksma render ball -n 4 --size 16x16 -q -o reference.exr >/dev/null && cp reference.exr truth.exr &&
  cp ball.exr mine_regular_1_0.exr && printf '12.5 40\n320 240\n' >pixels.txt &&
  koksma mask --filter gaussian:sigma=1 --swaps 1 -q -o other.png >/dev/null || exit 1
for seed in $(seq 0 31); do koksma generate random -n 4 -s "$seed" -q -o "my_4_$seed.npy" >/dev/null; done
echo '{"questions": [{"id": "a", "title": "?", "answer": "{m|value}", "runs": [{"id": "m", "command": "koksma measure sobol@4 -m star --json"}]}]}' >one.json
count=0 failed=0 sheets=0
sed -n 's/^    \(koksma .*\)/\1/p' "$root/README.md" "$root/docs/commands.md" | sed 's/  *# .*//' | sed 's/-o DIR/-o dir/' >commands
for command in $(koksma --help | sed -n 's/^  \([a-z]*\)  .*/\1/p'); do
  koksma "$command" --help | sed -n '/^examples:/,$s/^  //p' >examples
  cat examples >>commands
  grep -q "^koksma $command" examples && koksma manual "$command" | grep -q '^.SH EXAMPLES' || {
    echo "koksma $command --help, or its manual page, has no examples"
    failed=$((failed + 1))
  }
done
koksma --help | sed -n '/^examples:/,$s/^  //p' >overview # the five of README, which are run above
[ "$(wc -l <overview)" -eq 5 ] && ! grep -Fv -e "$(sed -n 's/^    \(koksma .*\)/\1/p' "$root/README.md" | sed 's/  *# .*//')" overview || {
  echo "the examples of koksma --help are not those of README.md"
  failed=$((failed + 1))
}
while read -r command; do
  case $command in
    'koksma study new '*) rm -f plan.json ;;
    'koksma reproduce '* | 'koksma rank '*) command="$command --help" ;;
    'koksma generate '*.obj*) [ "$meshes" -eq 1 ] || command=true ;;
    *.obj*) [ "$meshes" -eq 1 ] && command="$command --size 32x32 -q" || command=true ;;
    'koksma verify '*) command="$command || [ \$? -eq 1 ]" ;; # "no" is an answer
    # The first with its three scenes, the others, which are of other points, with one, as a scene takes three seconds.
    'koksma datasheet '*)
      case "$sheets $command" in 1*--scenes* | 0*) ;; *) command="$command --scenes ball" ;; esac
      sheets=1 ;;
    'koksma atlas build '*) command="koksma atlas build one.json -o atlas" ;;
    'koksma atlas submit best'*) command=$(echo "$command" | sed 's/best.txt/points.txt/; s/ e.json/ entry.json/') ;;
    'koksma atlas check '*) command="$command || [ \$? -eq 1 ]" ;;
    'koksma manual '*) command -v man >/dev/null || command=true ;;
    'koksma optimise '*) command=$(echo "$command" | sed 's/--time-limit [0-9]*/--steps 1/; s/--steps [0-9]*/--steps 1/; s/ -n [0-9]*/ -n 16/') ;;
    'koksma render '*) command="$command --size 32x32 -q" ;;
  esac
  if ! timeout 3000 sh -c "$command" >out 2>&1 </dev/null; then
    echo "$command: $(tail -1 out)"
    failed=$((failed + 1))
  fi
  count=$((count + 1))
done <commands
# The numbers of patterns in README and the change log: patterns of the library, each counted once, and patterns that read a
# file, program or numbers of the user.
koksma list patterns --json >patterns
own=$(grep '"reads":"-"' patterns | grep -vc '"what":"another name for ')
reading=$(grep -vc '"reads":"-"' patterns)
grep -q "^| patterns | $own, and $reading that read yours |" "$root/README.md" || {
  echo "README.md: the row 'patterns' does not say $own and $reading"
  failed=$((failed + 1))
}
tr -s '\n ' '  ' <"$root/CHANGELOG.md" |
  grep -q "[*]Patterns[*][*]: $own, in .* and $reading that read points.* has $(grep -c . patterns) lines" || {
  echo "CHANGELOG.md: the item 'Patterns' does not say $own, $reading and $(grep -c . patterns)"
  failed=$((failed + 1))
}
echo "$count commands, $failed failed"
[ "$failed" -eq 0 ] && [ "$count" -ge 60 ]
