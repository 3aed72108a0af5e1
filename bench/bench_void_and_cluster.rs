// SPDX-License-Identifier: Apache-2.0
// The void-and-cluster mask of the crate blue-noise, with the Gaussian of Ulichney and of ours, for bench/speed.py:
// void-and-cluster SIZE FILE writes its levels, a byte a pixel.
use blue_noise::{BlueNoiseConfig, BlueNoiseGenerator};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().collect();
    let size: usize = words[1].parse()?;
    let config = BlueNoiseConfig { width: size, height: size, sigma: 1.5, seed: Some(1), verbose: false, ..Default::default() };
    let mask = BlueNoiseGenerator::new(config)?.generate()?;
    std::fs::write(&words[2], &mask.data)?;
    Ok(())
}
