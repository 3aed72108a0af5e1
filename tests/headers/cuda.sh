#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# cuda.sh ROOT: every public inline function of sampler.h, keys.h and mask.h is called in sampler.cu; then that file is compiled by
# nvcc, with products and sums fused and not, and run. Exit code 77: the calls are there, but no compiler or no device.
root=$1
missing=
for name in $(sed -n 's/^KOKSMA_INLINE .*[ *]\(koksma_[a-z0-9][a-z0-9_]*\)(.*/\1/p' "$root/include/koksma/sampler.h" \
  "$root/include/koksma/keys.h" "$root/include/koksma/mask.h"); do
  grep -q "\<$name(" "$root/tests/headers/sampler.cu" || missing="$missing $name"
done
[ -z "$missing" ] || { echo "tests/headers/sampler.cu does not call:$missing"; exit 1; }

PATH=$PATH:/usr/local/cuda/bin
command -v nvcc >/dev/null || { echo "no CUDA compiler"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
for fused in true false; do
  nvcc -std=c++14 -O3 -fmad=$fused -I"$root/include" "$root/tests/headers/sampler.cu" -o "$folder/sampler" || exit 1
  "$folder/sampler" "$root/ports/vectors.txt" || exit
done
