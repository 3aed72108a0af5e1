#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: the crate sobol's iterator of f32 goes on as that of f64 does, with coordinates rounded to 24 bits, or fails
# where it has no new points.
# Seen: it ends in silence after 2^24 - 1 points, and that of u8 after 255: take(1 << 25) gives half of what it was asked
# for, and a sum over it that is divided by 2^25 is half the integral. The last of the first 2^24 points is not there, so
# the full net of 24 bits is never had.
# Packages: sobol 1.0.2 (crates.io)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cargo init -q --vcs none --name end
cargo add -q sobol@=1.0.2
cat >src/main.rs <<'END'
use sobol::{params::JoeKuoD6, Sobol};
fn main() {
    let table = JoeKuoD6::minimal();
    let asked = 1 << 25;
    let singles = Sobol::<f32>::new(2, &table).take(asked).count();
    let doubles = Sobol::<f64>::new(2, &table).take(asked).count();
    let bytes = Sobol::<u8>::new(2, &table).take(asked).count();
    println!("asked for {asked}: {singles} points of f32, {doubles} of f64, {bytes} of u8");
    std::process::exit(if singles == (1 << 24) - 1 && doubles == asked && bytes == 255 { 0 } else { 1 });
}
END
cargo run -q --release
