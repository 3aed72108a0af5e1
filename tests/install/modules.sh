#!/bin/sh
# modules.sh PROGRAM MODULES...: commands that make, measure and list points map no library of a module, those that need
# one map it, and a program without its modules says what to install.
set -eu
program=$(readlink -f "$1")
shift
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "modules.sh: $1"; exit 1; }
cd "$work"
# The libraries that the dynamic linker loads for a command.
loaded() { LD_DEBUG=files "$@" 2>&1 >/dev/null | sed -n 's/.*calling init: //p' | grep -iE 'embree|cairo|openexr|mpi|tbb|koksma-' || :; }

"$program" generate sobol -n 64 -o points.npy -q
for command in --help version\ --help "generate jittered -n 64 -o jittered.txt -q" "measure points.npy -m all" "verify points.npy" \
  "list patterns" "plot points.npy -o points.svg" "render ball --size 16x16 -n 4 -o ball.png -q"; do
  # shellcheck disable=SC2086
  found=$(loaded "$program" $command)
  [ -z "$found" ] || fail "koksma $command loads $found"
done

# The programs that need each module, with it and without.
mkdir bin
cp "$program" bin/koksma
alone=$work/bin/koksma
for module in "$@"; do
  case $module in
    cairo) set -- plot points.npy -o points.png ;;
    exr) set -- render ball --size 16x16 -n 4 -o ball.exr -q ;;
    embree)
      printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >mesh.obj
      set -- render mesh.obj --size 16x16 -n 4 -o mesh.png -q ;;
    *) fail "no command for the module $module" ;;
  esac
  loaded "$program" "$@" | grep -q "koksma-$module.so" || fail "koksma $* does not load koksma-$module.so"
  code=0
  "$alone" "$@" 2>error >/dev/null || code=$?
  if [ $code -ne 0 ]; then
    [ "$(wc -l <error)" -eq 1 ] && grep -q "koksma-$module.so is missing: install the package koksma-modules" error ||
      fail "without koksma-$module.so: $(cat error)"
  else # the build's module is installed on this machine
    loaded "$alone" "$@" | grep -q "koksma-$module.so" || fail "koksma $* works without koksma-$module.so"
  fi
done
echo "none where none is needed, named where missing"
