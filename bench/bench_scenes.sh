#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Path tracing of scenes by an older program and by this one, in turn: bench_scenes.sh OLD SCENE... prints for each scene the
# least of three times of the processor of each, in seconds, and the ratio.
set -e
new=$(dirname "$0")/../build/release/koksma
old=$1
shift
picture=$(mktemp --suffix .pfm)
trap 'rm "$picture"' EXIT
TIMEFORMAT=%U
for scene in "$@"; do
  for _ in 1 2 3; do
    for program in "$old" "$new"; do
      { time "$program" render "$scene" --integrator path -p jittered -n 64 --size 96x72 --threads 1 -o "$picture" >/dev/null 2>&1; } 2>&1
    done
  done | awk -v scene="$scene" '{ i = NR % 2; least[i] = NR < 3 || $1 < least[i] ? $1 : least[i] }
    END { printf "%s %s %s %.2f\n", scene, least[1], least[0], least[1] / least[0] }'
done
