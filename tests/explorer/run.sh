#!/bin/sh
# run.sh PROGRAM NODE_MODULES [SCREENSHOTS]: builds the explorer and the npm package, compares their numbers with the
# program's, in Node and then in the page in Chromium. Exit code 77: skipped.
set -u
here=$(readlink -f "$(dirname "$0")")
program=$(readlink -f "$1")
KOKSMA_NODE=$2
export KOKSMA_NODE
for tool in emcc node; do
  command -v $tool >/dev/null || { echo "skipped: $tool is not installed (scripts/setup explorer)"; exit 77; }
done
"$here/../../scripts/npm" >/dev/null || exit 1
build=$here/../../build/explorer
node "$here/numbers.mjs" "$program" "$build/koksma.wasm" || exit 1
node "$here/pictures.mjs" || exit 1
node "$here/package.cjs" "$program" "$here"/../../build/npm/*.tgz || exit 1
node "$here/page.cjs" "$program" "$build/koksma-explorer.html" ${3:+"$3"}
