#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# pbrt.sh SOURCE: pbrt-v4 with ports/pbrt/pbrt-v4.patch: the file that defines its samplers compiles, with floats and with
# doubles, and through pbrt's own Sampler ours has the numbers of koksma/sampler.h (pbrt.cpp). KOKSMA_PBRT names pbrt's
# sources; submodules need not be there. Exit code 77: it is not set.
[ -n "${KOKSMA_PBRT:-}" ] || { echo "skipped: KOKSMA_PBRT names no sources of pbrt-v4"; exit 77; }
[ -e "$KOKSMA_PBRT/src/pbrt/samplers.cpp" ] || { echo "no pbrt-v4 in $KOKSMA_PBRT"; exit 1; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
mkdir -p "$folder/src" "$folder/without/pbrt" || exit 1
cp -r "$KOKSMA_PBRT/CMakeLists.txt" "$folder" && cp -r "$KOKSMA_PBRT/src/pbrt" "$folder/src" || exit 1
patch -s -p1 -d "$folder" <"$1/ports/pbrt/pbrt-v4.patch" || exit 1
cp "$1/ports/pbrt/koksma_sampler.h" "$folder/src/pbrt" || exit 1
mkdir "$folder/src/koksma" && cp "$1/include/koksma/sampler.h" "$folder/src/koksma" || exit 1
# samplers.cpp includes the cameras, which need submodules, and uses nothing of them.
: >"$folder/without/pbrt/cameras.h"
for floats in '' -DPBRT_FLOAT_AS_DOUBLE; do
  for file in "$folder/src/pbrt/samplers.cpp" "$folder/src/pbrt/util/pstd.cpp" "$1/tests/ports/pbrt.cpp"; do
    ${CXX:-c++} -std=c++17 -O1 -DPBRT_HAVE_POSIX_MEMALIGN $floats -I"$folder/without" -I"$folder/src" -c "$file" -o "$folder/$(basename "$file").o" || exit 1
  done
  # Of pbrt's other files, and of the tables of its other samplers, nothing is reached.
  ${CXX:-c++} -no-pie -Wl,--unresolved-symbols=ignore-all "$folder"/*.o -o "$folder/test" || exit 1
  "$folder/test" || exit 1
done
