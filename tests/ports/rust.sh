#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# rust.sh SOURCE: the Rust port gives ports/vectors.txt, and its example ports/example.txt. Exit code 77: no Rust compiler.
PATH=$PATH:$HOME/.cargo/bin
command -v rustc >/dev/null || { echo "no rustc"; exit 77; }
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
rustc --edition 2021 -O -D warnings -o "$folder/vectors" "$1/tests/ports/vectors.rs" || exit 1
"$folder/vectors" | cmp - "$1/ports/vectors.txt" || exit 1
rustc --edition 2021 -O -D warnings -o "$folder/example" "$1/ports/rust/example.rs" || exit 1
"$folder/example" | cmp - "$1/ports/example.txt"
