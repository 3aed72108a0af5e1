#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a random Quat of glam, as generator.random() gives it, is uniform over all rotations, as one needs it to turn
# sets of directions at random: the square of each component is 1/4 on average, and a turned axis is uniform on the sphere.
# Seen: the axis is uniform and so is the angle, which is another measure, with too many small turns: the square of w is
# 1/2 on average, and a turned z axis has a squared z of 7/15, not 1/3. Means over sets turned by it are biased towards
# the set as it was.
# Packages: glam 0.33.12, rand 0.10.4 (crates.io)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cargo init -q --vcs none --name rotations
cargo add -q glam@=0.33.12 --features rand-010
cargo add -q rand@=0.10.4
cat >src/main.rs <<'END'
use glam::{Quat, Vec3};
use rand::{rngs::StdRng, RngExt, SeedableRng};

fn main() {
    let mut generator = StdRng::seed_from_u64(1);
    let count = 1_000_000;
    let (mut w, mut z) = (0.0, 0.0);
    for _ in 0..count {
        let turn: Quat = generator.random();
        w += f64::from(turn.w).powi(2) / f64::from(count);
        z += f64::from((turn * Vec3::Z).z).powi(2) / f64::from(count);
    }
    println!("square of w {w:.4}, uniform .25; square of the turned axis's z {z:.4}, uniform .3333");
    std::process::exit(if (w - 0.5).abs() < 0.002 && (z - 7.0 / 15.0).abs() < 0.002 { 0 } else { 1 });
}
END
cargo run -q --release
