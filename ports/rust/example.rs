// SPDX-License-Identifier: Apache-2.0
//! The area of a quarter disk in 1,024 pixels of 64 samples each: RMS errors of random and of Sobol' samples.
//!
//! ```text
//! rustc -O example.rs && ./example
//! ```
#[allow(dead_code)]
mod koksma_sampler;
use koksma_sampler::Domain;

const DISK: u32 = 0; // the use of these samples
const SPP: u32 = 64;

fn rms(draw: fn(Domain, u32) -> [f64; 2]) -> f64 {
    let mut square = 0.0;
    for p in 0..1024 {
        let domain = Domain::of_pixel(7, p % 32, p / 32).of_use(DISK);
        let inside = (0..SPP).map(|i| draw(domain, i)).filter(|xy| xy[0] * xy[0] + xy[1] * xy[1] < 1.0);
        square += (inside.count() as f64 / SPP as f64 - std::f64::consts::FRAC_PI_4).powi(2) / 1024.0;
    }
    square.sqrt()
}

fn main() {
    println!("white {:.4}", rms(|domain, i| [domain.white(i)[0], domain.white(i)[1]]));
    println!("sobol {:.4}", rms(|domain, i| domain.sobol(i)));
}
