#!/bin/sh
# switches.sh C-COMPILER: what the build system does with what it is told: a project of somebody else that takes this one
# in, switches in any spelling and turned over in one build folder, and what `make install` runs.
set -eu
compiler=$1
source=$(cd "$(dirname "$0")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "switches.sh: $1"; [ ! -s "$work/log" ] || tail -5 "$work/log"; exit 1; }
configure() { cmake -DCMAKE_C_COMPILER="$compiler" -DBUILD_TESTING=OFF "$@" >"$work/log" 2>&1; }

# A parent project links the library by the name that an installed one has, and its own tests stay its own.
mkdir "$work/parent"
cat >"$work/parent/CMakeLists.txt" <<END
cmake_minimum_required(VERSION 3.25)
project(parent C)
set(BUILD_TESTING ON)
set(KOKSMA_LAB OFF)
add_subdirectory("$source" koksma)
add_executable(parent parent.c)
target_link_libraries(parent PRIVATE koksma::koksma)
get_property(tests DIRECTORY "$source" PROPERTY SUBDIRECTORIES)
message(STATUS "folders: \${tests}")
END
echo 'int main(void) { return 0; }' >"$work/parent/parent.c"
configure -S "$work/parent" -B "$work/parent/build" || fail "add_subdirectory"
grep -q "folders: .*/src" "$work/log" || fail "the parent project saw no folders"
! grep -q "folders: .*/tests" "$work/log" || fail "the parent project got our tests"

# KOKSMA_EMBREE as AUTO, then turned off and on in every spelling.
build=$work/build
configure -S "$source" -B "$build" || fail "configure"
module() { cmake --build "$build" --target help | grep -q koksma-embree; }
if module; then
  for word in off 0 NO false; do
    configure "-DKOKSMA_EMBREE=$word" "$build" || fail "KOKSMA_EMBREE=$word"
    ! module || fail "KOKSMA_EMBREE=$word: there is a module"
  done
  configure -DKOKSMA_EMBREE=on "$build" && module || fail "KOKSMA_EMBREE=on"
fi
! configure -DKOKSMA_EMBREE=perhaps "$build" || fail "KOKSMA_EMBREE=perhaps was taken"
grep -q "KOKSMA_EMBREE=PERHAPS: it takes AUTO, ON or OFF" "$work/log" || fail "KOKSMA_EMBREE=perhaps"

# `make install` runs ldconfig where it installs for this machine, and does not mind when that fails.
mkdir "$work/bin"
printf '#!/bin/sh\n:\n' >"$work/bin/cmake"
printf '#!/bin/sh\necho ldconfig ran\nexit "${LDCONFIG_EXIT:-0}"\n' >"$work/bin/ldconfig"
chmod +x "$work/bin/cmake" "$work/bin/ldconfig"
install() { env -u MAKEFLAGS -u DESTDIR PATH="$work/bin:$PATH" "$@" make -s -C "$source" -o release install $destdir >"$work/log" 2>&1; }
destdir=
install && grep -q 'ldconfig ran' "$work/log" || fail "make install"
install LDCONFIG_EXIT=1 && grep -q 'LD_LIBRARY_PATH must name' "$work/log" || fail "make install, ldconfig fails"
destdir=DESTDIR=$work/staged
install && ! grep -q 'ldconfig ran' "$work/log" || fail "make install DESTDIR= ran ldconfig"
echo "taken in, switched, installed"
