#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# cuda.sh INCLUDE_FOLDER SAMPLER_CU: compiles and runs the CUDA test of sampler.h. Exit code 77: no compiler or no device.
PATH=$PATH:/usr/local/cuda/bin
command -v nvcc >/dev/null || { echo "no CUDA compiler"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
nvcc -std=c++14 -fmad=false -I"$1" "$2" -o "$folder/sampler" || exit 1
"$folder/sampler"
