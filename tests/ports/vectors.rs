// SPDX-License-Identifier: Apache-2.0
// The table of tests/ports/vectors.c by the Rust port, which rust.sh compares with ports/vectors.txt, after a check that
// uses, pixels and frames are independent.
#[path = "../../ports/rust/koksma_keys.rs"]
mod koksma_keys;
#[path = "../../ports/rust/koksma_sampler.rs"]
#[allow(dead_code)]
mod koksma_sampler;
use koksma_keys::Keys;
use koksma_sampler::{seed_of_frame, to_float, Domain};

fn hashed(h: u32, words: &[u32]) -> u32 {
    words.iter().fold(h, |h, word| (h ^ word).wrapping_mul(16777619))
}

fn words(xs: &[f64]) -> Vec<u32> {
    xs.iter().map(|x| (x * 4294967296.0) as u32).collect()
}

// Of each function that draws, in two domains, the cells of 16 x 16 of each coordinate here and each there are
// uniform, by chi-square over 4,096 pixels with sample 3 each: 255 degrees of freedom, 6 deviations of sqrt(510).
fn check_domains() {
    let draw = |frame: u32, dx: u32, usage: u32| -> Vec<[Vec<f64>; 3]> {
        (0..4096u32)
            .map(|k| {
                let seed = seed_of_frame(1, frame);
                let domain = Domain::of_pixel(seed, k % 64 + dx, k / 64).of_use(usage);
                [domain.sobol::<4>(3).to_vec(), domain.pmj02(3).to_vec(), domain.white(3).to_vec()]
            })
            .collect()
    };
    let here = draw(0, 0, 0);
    for (relation, there) in [("uses", draw(0, 0, 1)), ("pixels", draw(0, 1, 0)), ("frames", draw(1, 0, 0))] {
        for f in 0..3 {
            for (a, b) in (0..here[0][f].len()).flat_map(|a| (0..here[0][f].len()).map(move |b| (a, b))) {
                let mut counts = [0f64; 256];
                for (h, t) in here.iter().zip(&there) {
                    counts[(h[f][a] * 16.0) as usize * 16 + (t[f][b] * 16.0) as usize] += 1.0;
                }
                let chi: f64 = counts.iter().map(|c| (c - 16.0) * (c - 16.0) / 16.0).sum();
                assert!((chi - 255.0).abs() < 6.0 * 510f64.sqrt(), "function {f}, {relation}, {a} and {b}: chi-square {chi}");
            }
        }
    }
}

fn main() {
    check_domains();
    assert!(to_float(1.0 - 1e-12) < 1.0);
    println!("# Made by tests/ports/vectors.c, which says of what. block domain sobol pmj02 white keys");
    for block in 0..64u32 {
        let mut h = [2166136261u32; 5];
        for k in block << 14..(block + 1) << 14 {
            let seed = seed_of_frame(0x0123456789abcdef ^ (k >> 18) as u64, k >> 16 & 3);
            let domain = Domain::of_pixel(seed, k & 255, k >> 8 & 255).of_use(k % 5).of_sample(k % 3);
            let index = k.wrapping_mul(2654435761) >> (k % 25);
            let sobol = domain.sobol::<4>(index);
            assert_eq!(sobol[..2], domain.sobol::<2>(index));
            h[0] = hashed(h[0], &[domain.key as u32, (domain.key >> 32) as u32]);
            h[1] = hashed(h[1], &words(&sobol));
            h[2] = hashed(h[2], &words(&domain.pmj02(index)));
            h[3] = hashed(h[3], &words(&domain.white(index)));
            let spp = 1 + k % 130;
            let keys = Keys::of_4d(seed, k & 255, k >> 8 & 255, k % 5, spp);
            h[4] = hashed(h[4], &words(&keys.sample_4d(index % spp)));
        }
        println!("{} {:08x} {:08x} {:08x} {:08x} {:08x}", block, h[0], h[1], h[2], h[3], h[4]);
    }
}
