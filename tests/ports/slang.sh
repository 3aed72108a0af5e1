#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# slang.sh SOURCE: the Slang port, as C++, gives ports/vectors.txt and its example ports/example.txt; the example becomes HLSL,
# Metal, GLSL and CUDA. KOKSMA_SLANGC names the compiler (default: slangc; pip's slangtorch holds one). Exit code 77: there is none.
slangc=${KOKSMA_SLANGC:-slangc}
command -v "$slangc" >/dev/null || { echo "no slangc"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
"$slangc" "$1/tests/ports/vectors.slang" -I "$1/ports/slang" -I "$1/include/koksma" -warnings-as-errors all -target cpp -o "$folder/slang_vectors.cpp" || exit 1
mv "$folder/slang_vectors.cpp" "$folder/slang_vectors.h"
${CXX:-c++} -std=c++17 -O1 -w -I"$folder" -o "$folder/vectors" "$1/tests/ports/slang.cpp" -lpthread || exit 1
"$folder/vectors" | cmp - "$1/ports/vectors.txt" || exit 1
"$folder/vectors" example | cmp - "$1/ports/example.txt" || exit 1
for target in hlsl metal glsl cuda; do
  "$slangc" "$1/ports/slang/example.slang" -warnings-as-errors all -entry quarter_disk -stage compute -target $target \
    -o "$folder/example.$target" || exit 1
  grep -q quarter_disk "$folder/example.$target" || [ $target = glsl ] || exit 1
done
