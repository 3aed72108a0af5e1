#!/bin/sh
# library_path.sh LIBKOKSMA-LAB COMPILER: in a folder with libraries of the names that libkoksma-lab needs, it is loaded with
# the system's: a stranger's folder gives no code to a program that happens to run there.
set -eu
library=$1 compiler=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
printf '#include <stdlib.h>\n__attribute__((constructor)) static void planted(void) { _Exit(42); }\n' >planted.c
$compiler -shared -fPIC -o planted.so planted.c
needed=$(readelf -d "$library" | sed -n 's/.*(NEEDED).*\[\(.*\)\]/\1/p')
[ -n "$needed" ] || { echo "library_path.sh: $library needs no library"; exit 1; }
for name in $needed; do
  case $name in libc.so* | libm.so* | ld-*) ;; *) cp planted.so "$name" ;; esac
done
/usr/bin/python3 -c 'import ctypes, sys; print(ctypes.CDLL(sys.argv[1])._name)' "$library" ||
  { echo "library_path.sh: code from the current folder ran"; exit 1; }
