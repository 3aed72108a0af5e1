#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: lowdisc's Sobol' points, whose table names Joe & Kuo, are those of the crate sobol, which has the file of Joe &
# Kuo (2008), without the origin.
# Seen: coordinates 3, 4 and 5 have other initial numbers and equal those of no published table that we know: the first
# 256 points (the origin with them) leave half of the 16 x 16 cells of coordinates 1 and 4 empty, where those of Joe &
# Kuo fill all.
# Packages: lowdisc 0.1.1, sobol 1.0.2 (crates.io)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cargo init -q --vcs none --name numbers
cargo add -q lowdisc@=0.1.1 sobol@=1.0.2
cat >src/main.rs <<'END'
use std::collections::HashSet;
fn cells(points: &[Vec<f64>], j: usize, k: usize) -> usize {
    points.iter().map(|p| ((p[j] * 16.) as usize, (p[k] * 16.) as usize)).collect::<HashSet<_>>().len()
}
fn main() {
    let ours: Vec<Vec<f64>> = std::iter::once(vec![0.; 8]).chain(lowdisc::sobol_sequence(255, 8)).collect();
    let joe_kuo: Vec<Vec<f64>> = sobol::Sobol::<f64>::new(8, &sobol::params::JoeKuoD6::standard()).take(256).collect();
    let other: Vec<usize> = (0..8).filter(|&k| ours.iter().zip(&joe_kuo).any(|(a, b)| a[k] != b[k])).map(|k| k + 1).collect();
    let full = (cells(&ours, 0, 3), cells(&joe_kuo, 0, 3));
    println!("coordinates that differ: {other:?}; cells of 256 that coordinates 1 and 4 meet: {} and {}", full.0, full.1);
    std::process::exit(if other == [3, 4, 5] && full == (128, 256) { 0 } else { 1 });
}
END
cargo run -q --release
