#!/bin/sh
# installed.sh BUILD C-COMPILER FLAGS: installs a build under DESTDIR, moves the tree, and builds the two examples that
# live outside the tree against it, with shared and with static libraries. What they compute is what the program says.
set -eu
build=$1 compiler=$2 flags=$3
source=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "installed.sh: $1"; exit 1; }

DESTDIR=$work/staged cmake --install "$build" --prefix /opt/koksma >"$work/log" || { cat "$work/log"; exit 1; }
[ "$(ls "$work/staged")" = opt ] || fail "files outside the prefix: $(ls "$work/staged")"
mv "$work/staged/opt/koksma" "$work/moved"
libraries=$(dirname "$(find "$work/moved" -name libkoksma.so)")
PKG_CONFIG_PATH=$libraries/pkgconfig
LD_LIBRARY_PATH=$libraries
export PKG_CONFIG_PATH LD_LIBRARY_PATH
program=$work/moved/bin/koksma

cp -r "$source/examples/pkg-config" "$source/examples/cmake" "$work"
make -s -C "$work/pkg-config" CC="$compiler" CFLAGS="-Wall -Wextra -Werror $flags" >/dev/null
shared=$("$work/pkg-config/worst_box" jittered)
"$program" generate jittered -n 16 --seed 7 -o "$work/points.txt" -q
value=$("$program" measure "$work/points.txt" -m star --json | sed 's/.*"value": *\([0-9.]*\).*/\1/')
[ "$(printf '%.9g' "$value")" = "${shared%% *}" ] || fail "the example says $shared, the program $value"
"$work/pkg-config/worst_box" no-such-pattern 2>&1 | grep -q "no-such-pattern" || fail "no error text"

# shellcheck disable=SC2046,SC2086
$compiler $flags $(pkg-config --cflags koksma) -o "$work/static" "$work/pkg-config/worst_box.c" \
  "$libraries/libkoksma.a" -lm -pthread
[ "$("$work/static" jittered)" = "$shared" ] || fail "static and shared differ"

cmake -S "$work/cmake" -B "$work/cmake/build" -DCMAKE_C_COMPILER="$compiler" -DCMAKE_C_FLAGS="$flags" \
  -DCMAKE_PREFIX_PATH="$work/moved" >"$work/log" || { cat "$work/log"; exit 1; }
cmake --build "$work/cmake/build" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
"$work/cmake/build/ball" multi-jittered "$work/ball.pfm"
"$program" render ball -p multi-jittered --spp 16 --size 64x64 -o "$work/program.pfm" -q >/dev/null
cmp "$work/ball.pfm" "$work/program.pfm" || fail "the example's image is not the program's"
[ "$(pkg-config --modversion koksma-lab)" = "$("$program" version | sed -n '1s/koksma //p')" ] || fail "versions differ"
python=$(dirname "$(find "$work/moved" -path '*/koksma/__init__.py' | head -1)")
case $flags in *-fsanitize*) ;; *) # a sanitized library can't be loaded into a plain Python
  if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
    unset LD_LIBRARY_PATH # the package finds the libraries beside it
    said=$(PYTHONPATH=$(dirname "$python") /usr/bin/python3 -c "
import koksma
print('%.9g' % koksma.measure(koksma.generate('jittered', 16, seed=7), 'star').value, koksma.render('ball', spp=1, size=(2, 2)).shape)")
    [ "$said" = "${shared%% *} (2, 2, 1)" ] || fail "Python says $said"
    # What docs/install.md tells a stranger to type, letter by letter.
    PATH=/usr/bin:$PATH CC=$compiler LD_LIBRARY_PATH=$libraries CMAKE_PREFIX_PATH=$work/moved PYTHONPATH=$(dirname "$python") \
      /usr/bin/python3 "$source/tests/docs/fences.py" "$program" "$source/docs/install.md" || fail "docs/install.md"
  fi ;;
esac
case $flags in *-fsanitize*) ;; *) "$source/tests/lint/elf.py" "$compiler" "$work/moved" || fail "not hardened" ;; esac
echo "installed, moved, found, equal"
