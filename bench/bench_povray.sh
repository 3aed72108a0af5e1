#!/bin/sh
# Msamples/s of POV-Ray and of koksma on `ball`, 512 x 384, 64 samples a pixel, one thread, a shadow ray to each of the two
# lights, by processor time with starting and writing the picture, best of three rounds. Throughput only: POV-Ray's
# shadows are those of points, and it shades in colour with all its generality.
set -eu
cd "$(dirname "$0")/.."
if ! command -v povray >/dev/null; then
  echo "POV-Ray is not installed (apt-get install povray): left out"
  exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
. bench/processor_seconds.sh

theirs=1000000 jittered=1000000 regular=1000000
for round in 1 2 3; do
  theirs=$(smaller "$theirs" "$(processor_seconds povray bench/ball.pov +W512 +H384 +A0.0 +AM1 +R8 +WT1 -D -V \
    "+O$folder/ball.png")")
  time_koksma
done
say POV-Ray "$theirs"
