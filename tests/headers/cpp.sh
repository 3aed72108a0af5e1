#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# cpp.sh ROOT: koksma.hpp compiles without a warning by g++ and clang++ as C++11 to C++20, gives what sampler.h gives, and
# refuses wrong numbers of coordinates. Exit code 77: there is neither compiler.
set -eu
root=$1 folder=$(mktemp -d) ran=0
trap 'rm -rf "$folder"' EXIT
for compiler in g++ clang++; do
    command -v "$compiler" >/dev/null || continue
    for standard in 11 14 17 20; do
        set -- "$compiler" -std=c++$standard -O1 -Wall -Wextra -Wshadow -Wconversion -Wold-style-cast -pedantic -Werror -Wno-unused-function \
            -I"$root/include" "$root/tests/headers/sampler.cpp" -o "$folder/test"
        "$@"
        "$folder/test"
    done
    for wrong in 1 2; do
        if "$@" -DWRONG=$wrong 2>/dev/null; then
            echo "$compiler compiles WRONG=$wrong" >&2
            exit 1
        fi
    done
    ran=1
done
[ $ran = 1 ] || exit 77
