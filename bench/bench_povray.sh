#!/bin/sh
# Msamples/s of POV-Ray and of koksma on `ball`, 512 x 384, 64 samples a pixel, one thread, a shadow ray to each of the two
# luminaires, by processor time with starting and writing the picture, best of three rounds. Throughput only: POV-Ray's
# shadows are those of points, and it shades in colour with all its generality.
set -eu
cd "$(dirname "$0")/.."
if ! command -v povray >/dev/null; then
  echo "POV-Ray is not installed (apt-get install povray): left out"
  exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# Processor seconds of a command, user's and system's: the second line of `times` has the children's.
seconds_of() {
  sh -c '"$@" >"$0" 2>&1; times' "$folder/log" "$@" | sed -n '2s/[ms]/ /gp' | awk '{ print 60 * $1 + $2 + 60 * $3 + $4 }'
}
smaller() {
  printf '%s\n' "$1" "$2" | sort -g | head -1
}

theirs=1000000 jittered=1000000 regular=1000000
for round in 1 2 3; do
  theirs=$(smaller "$theirs" "$(seconds_of povray bench/ball.pov +W512 +H384 +A0.0 +AM1 +R8 +WT1 -D -V \
    "+O$folder/ball.png")")
  for pattern in jittered regular; do
    seconds=$(seconds_of build/release/koksma render ball -p "$pattern" -n 64 --size 512x384 --threads 1 -o "$folder/ball.pfm")
    eval "$pattern=\$(smaller \"\$$pattern\" \"$seconds\")"
  done
done
awk -v theirs="$theirs" -v jittered="$jittered" -v regular="$regular" 'BEGIN {
  samples = 512 * 384 * 64 / 1e6
  printf "POV-Ray %.2f   koksma, jittered %.1f (%.0f times), regular %.1f (%.0f times)\n", samples / theirs,
         samples / jittered, theirs / jittered, samples / regular, theirs / regular
}'
