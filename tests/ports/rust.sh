#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# rust.sh SOURCE: the Rust port gives ports/vectors.txt. Exit code 77: no Rust compiler.
PATH=$PATH:$HOME/.cargo/bin
command -v rustc >/dev/null || { echo "no rustc"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
rustc --edition 2021 -O -D warnings -o "$folder/vectors" "$1/tests/ports/vectors.rs" || exit 1
"$folder/vectors" | cmp - "$1/ports/vectors.txt"
