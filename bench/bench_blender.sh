#!/bin/sh
# Msamples/s of Blender's Cycles and of koksma on `ball`, 512 x 384, 64 samples a pixel, one thread, direct light, by
# processor time, best of three pictures. Throughput only: Cycles shades in colour with all its generality, has a mesh for the
# ball, and sends one shadow ray a camera ray to one of the two lights, where koksma sends one to each.
set -eu
cd "$(dirname "$0")/.."
if ! command -v blender >/dev/null; then
  echo "Blender is not installed (apt-get install blender): left out"
  exit 0
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
. bench/processor_seconds.sh

# Blender takes seconds to start, so that the pictures are timed within.
blender --background --factory-startup --python-exit-code 1 --python bench/ball_blender.py >"$folder/said" 2>&1 || {
  cat "$folder/said" >&2
  exit 1
}
jittered=1000000 regular=1000000
for round in 1 2 3; do
  time_koksma
done
say Cycles "$(sed -n 's/^seconds //p' "$folder/said" | sort -g | head -1)"
