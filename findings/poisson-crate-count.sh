#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: Builder::with_samples(1000, relative, ...) of the crate poisson, "approximate amount of samples", gives about 1,000
# points, whatever the relative radius, and radius() of it is the least distance of two points.
# Seen: with a relative radius of 1 it gives some 540 and with .5 some 2,150: the radius is set so that the densest packing
# has the number, and a random set that fills the square has .55 / relative^2 of it; .74 would give what was asked. The
# least distance is twice radius(), as disks of that radius do not overlap.
# Packages: poisson 0.10.1, rand 0.6.5, nalgebra 0.17.3 (crates.io)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cargo init -q --vcs none --name samples
cargo add -q poisson@=0.10.1 rand@=0.6.5 nalgebra@=0.17.3
cat >src/main.rs <<'END'
use nalgebra::Vector2;
use poisson::{algorithm::Ebeida, Builder, Type};
use rand::{rngs::SmallRng, SeedableRng};

fn main() {
    let mut seen = true;
    for (relative, least, most) in [(0.5, 2000, 2300), (0.75, 900, 1020), (1.0, 500, 580)] {
        let builder = Builder::<f64, Vector2<f64>>::with_samples(1000, relative, Type::Normal);
        let radius = builder.radius();
        let points = builder.build(SmallRng::seed_from_u64(1), Ebeida).generate();
        let distances = (0..points.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
        let nearest = distances.map(|(i, j)| (points[i] - points[j]).norm()).fold(2.0, f64::min);
        println!("relative {relative}: {} points, the least distance is {:.3} radii", points.len(), nearest / radius);
        seen &= (least..most).contains(&points.len()) && (nearest / radius - 2.0).abs() < 0.02;
    }
    std::process::exit(if seen { 0 } else { 1 });
}
END
cargo run -q --release
