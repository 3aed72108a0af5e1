#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Draws of koksma/sampler.h beside OpenQMC's samplers, in one run, for each compiler and architecture: nanoseconds a draw,
# and OpenQMC's over ours. OPENQMC is the folder of its sources (https://github.com/AcademySoftwareFoundation/openqmc);
# without it our own times stand alone. OpenQMC runs once with vector instructions and once without, and the faster counts.
set -eu
cd "$(dirname "$0")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
peer=
if [ -n "${OPENQMC:-}" ]; then
  [ -f "$OPENQMC/include/oqmc/oqmc.h" ] || { echo "OPENQMC=$OPENQMC: no include/oqmc/oqmc.h there; name the folder of OpenQMC's sources" >&2
    exit 2
  }
  peer="-DWITH_OPENQMC -I$OPENQMC/include"
else
  echo "OPENQMC names no folder of OpenQMC's sources: koksma/sampler.h alone"
fi
for compiler in g++ clang++; do
  command -v $compiler >/dev/null || { echo "$compiler is not installed: left out"; continue; }
  for flags in "-O3 -march=native" "-O3 -mavx2" "-O2"; do
    # shellcheck disable=SC2086 # words of options
    $compiler -std=c++17 $flags $peer -Iinclude bench/bench_sampler.cpp -o "$folder/vector" 2>/dev/null || { echo "$compiler $flags: not for this processor"; continue; }
    # shellcheck disable=SC2086
    [ -z "$peer" ] || $compiler -std=c++17 $flags $peer -DOQMC_FORCE_SCALAR -Iinclude bench/bench_sampler.cpp -o "$folder/scalar"
    {
      "$folder/vector"
      [ -z "$peer" ] || "$folder/scalar"
    } | awk -v title="$compiler $flags" '
      !($1 in best) { names[++count] = $1; best[$1] = $2 }
      $1 ~ /^openqmc/ && $2 < best[$1] { best[$1] = $2 }
      END {
        print title
        peer["koksma_sobol_2d"] = "openqmc-sobol-2d"
        peer["koksma_sobol_4d"] = "openqmc-sobol-4d"
        peer["koksma_pmj02_2d"] = "openqmc-pmj-2d"
        peer["koksma_keys_2f"] = "openqmc-sobol-bn-2d" # blue noise beside blue noise
        for (k = 1; k <= count; k++) {
          printf "  %-22s %7.2f ns", names[k], best[names[k]]
          if (names[k] in peer && peer[names[k]] in best) {
            printf "   %.2f times as fast as OpenQMC", best[peer[names[k]]] / best[names[k]]
          }
          print ""
        }
      }'
  done
done
