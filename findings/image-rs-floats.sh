#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Guess: a picture of floats (Rgb32FImage, what the crate image reads from HDR and EXR) keeps its radiances when it is
# made smaller, as it keeps them in blur(): a constant 10 stays 10.
# Seen: resize() cuts values off at 0 and 1 with each of its five filters, nearest too, and so does
# DynamicImage::fast_blur; blur() does not. thumbnail() rounds as if pixels were whole numbers: 10 becomes 10.5 and .5
# becomes 1.
# Packages: image 0.25.10 (crates.io)
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cat >Cargo.toml <<'END_OF_MANIFEST'
[package]
name = "floats"
version = "0.1.0"
edition = "2021"

[dependencies]
image = { version = "=0.25.10", default-features = false }
END_OF_MANIFEST
mkdir src
cat >src/main.rs <<'END_OF_SOURCE'
use image::imageops::{blur, resize, thumbnail, FilterType::*};
use image::{DynamicImage, Rgb, Rgb32FImage};

fn near(a: Rgb<f32>, b: [f32; 3]) -> bool {
    a.0.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-3)
}

fn main() {
    let picture = Rgb32FImage::from_pixel(8, 8, Rgb([10.0, 0.5, -2.0]));
    let mut seen = true;
    for filter in [Nearest, Triangle, CatmullRom, Gaussian, Lanczos3] {
        let pixel = *resize(&picture, 4, 4, filter).get_pixel(2, 2);
        println!("resize, {filter:?}: {:?}", pixel.0);
        seen &= near(pixel, [1.0, 0.5, 0.0]);
    }
    let fast = *DynamicImage::from(picture.clone()).fast_blur(1.0).to_rgb32f().get_pixel(4, 4);
    let slow = *blur(&picture, 1.0).get_pixel(4, 4);
    let small = *thumbnail(&picture, 4, 4).get_pixel(2, 2);
    println!("fast_blur: {:?}, blur: {:?}, thumbnail: {:?}", fast.0, slow.0, small.0);
    seen &= near(fast, [1.0, 0.5, 0.0]) && near(slow, [10.0, 0.5, -2.0]) && near(small, [10.5, 1.0, -1.5]);
    std::process::exit(!seen as i32);
}
END_OF_SOURCE
cargo run -q
