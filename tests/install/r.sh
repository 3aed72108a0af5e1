#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# r.sh PROGRAM LIBRARIES: the example in R over the C library gives the program's value, and its errors. The commands are those
# of examples/r/koksma.R. Exit code 77: R is not installed.
set -eu
program=$1 libraries=$2
here=$(cd "$(dirname "$0")/../.." && pwd)
command -v R >/dev/null && command -v Rscript >/dev/null || { echo "skipped: no R"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cp "$here"/examples/r/* "$folder"
cd "$folder"
PKG_CPPFLAGS=-I$here/include PKG_LIBS="-L$libraries -lkoksma" R CMD SHLIB koksma_r.c >log 2>&1 || { cat log; exit 1; }
LD_LIBRARY_PATH=$libraries${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export LD_LIBRARY_PATH
said=$(Rscript koksma.R)
"$program" generate sobol:scramble=owen -n 64 --seed 7 -o points.txt -q
value=$("$program" measure points.txt -m star --json | sed 's/.*"value": *\([0-9.e-]*\).*/\1/')
echo "R: $said, koksma: $value"
[ "$(printf '%.12g' "$said")" = "$(printf '%.12g' "$value")" ] || exit 1
sed 's/sobol:scramble=owen/sobl/' koksma.R >wrong.R
if Rscript wrong.R >log 2>&1; then echo "a wrong name passes"; exit 1; fi
grep -q "did you mean 'sobol'" log || { cat log; exit 1; }
