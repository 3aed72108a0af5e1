#!/bin/sh
# Msamples/s of POV-Ray and of koksma on `ball`, 512 x 384, 64 samples a pixel, one thread, a shadow ray to each of the two
# luminaires. Throughput only: POV-Ray's shadows are those of points, and it shades in colour with all its generality.
set -eu
cd "$(dirname "$0")/.."
if ! command -v povray >/dev/null; then
  echo "POV-Ray is not installed (apt-get install povray): left out"
  exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
best=1000000
for round in 1 2 3; do
  povray bench/ball.pov +W512 +H384 +A0.0 +AM1 +R8 +WT1 -D -V "+O$folder/ball.png" >"$folder/log" 2>&1
  best=$(tr '\r' '\n' <"$folder/log" | sed -n 's/.*Trace Time:.*(\([0-9.]*\) seconds).*/\1/p' |
    awk -v best="$best" '{ print $1 < best ? $1 : best }')
done
ours=1000000
for round in 1 2 3; do
  ours=$(build/release/koksma render ball -p jittered -n 64 --size 512x384 --threads 1 --json -o "$folder/ball.pfm" |
    sed 's/.*"seconds":\([0-9.e-]*\).*/\1/' | awk -v best="$ours" '{ print $1 < best ? $1 : best }')
done
awk -v theirs="$best" -v ours="$ours" 'BEGIN {
  samples = 512 * 384 * 64 / 1e6
  printf "POV-Ray %.2f   koksma %.2f (jittered)   ratio %.1f\n", samples / theirs, samples / ours, theirs / ours
}'
