#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: sample(i, dimension, seed) with a 32-bit i gives new points far beyond 2^16.
# Seen: it repeats after 65,536 points: of 131,072 points in two dimensions 65,536 are different, each twice, and not
# in the same order.
# Packages: sobol_burley 0.5 (crates.io)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cargo init -q --vcs none --name period
cargo add -q sobol_burley@=0.5.0
cat >src/main.rs <<'END'
use std::collections::HashSet;
fn main() {
    let point = |i: u32| (sobol_burley::sample(i, 0, 1).to_bits(), sobol_burley::sample(i, 1, 1).to_bits());
    let count = |n: u32| (0..n).map(point).collect::<HashSet<_>>().len();
    println!("65536 points: {} different; 131072: {}", count(1 << 16), count(1 << 17));
    std::process::exit(if count(1 << 16) == 65536 && count(1 << 17) == 65536 { 0 } else { 1 });
}
END
cargo run -q --release
