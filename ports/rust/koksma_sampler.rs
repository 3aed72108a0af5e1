// SPDX-License-Identifier: Apache-2.0
//! koksma/sampler.h for Rust: samples are functions of a domain and an index. No dependency, no allocation, `no_std`.
//!
//! ```ignore
//! mod koksma_sampler;
//! use koksma_sampler::Domain;
//! let pixel = Domain::of_pixel(seed, x, y);
//! for i in 0..spp {
//!     let film = pixel.of_use(FILM).sobol::<2>(i);
//!     let lens = pixel.of_use(LENS).sobol::<2>(i);
//! }
//! ```
//!
//! Every result has the bits of the header, whose comments say what the functions promise.

// Column b of each dimension: the digits of point 2^b, bits reversed.
pub(crate) const SOBOL: [[u32; 4]; 32] = [
    [0x00000001, 0x00000001, 0x00000001, 0x00000001], [0x00000002, 0x00000003, 0x00000003, 0x00000003],
    [0x00000004, 0x00000005, 0x00000006, 0x00000004], [0x00000008, 0x0000000f, 0x00000009, 0x0000000a],
    [0x00000010, 0x00000011, 0x00000017, 0x0000001f], [0x00000020, 0x00000033, 0x0000003a, 0x0000002e],
    [0x00000040, 0x00000055, 0x00000071, 0x00000045], [0x00000080, 0x000000ff, 0x000000a3, 0x000000c9],
    [0x00000100, 0x00000101, 0x00000116, 0x0000011b], [0x00000200, 0x00000303, 0x00000339, 0x000002a4],
    [0x00000400, 0x00000505, 0x00000677, 0x0000079a], [0x00000800, 0x00000f0f, 0x000009aa, 0x00000b67],
    [0x00001000, 0x00001111, 0x00001601, 0x0000101e], [0x00002000, 0x00003333, 0x00003903, 0x0000302d],
    [0x00004000, 0x00005555, 0x00007706, 0x00004041], [0x00008000, 0x0000ffff, 0x0000aa09, 0x0000a0c3],
    [0x00010000, 0x00010001, 0x00010117, 0x0001f104], [0x00020000, 0x00030003, 0x0003033a, 0x0002e28a],
    [0x00040000, 0x00050005, 0x00060671, 0x000457df], [0x00080000, 0x000f000f, 0x000909a3, 0x000c9bae],
    [0x00100000, 0x00110011, 0x00171616, 0x0011a105], [0x00200000, 0x00330033, 0x003a3939, 0x002a7289],
    [0x00400000, 0x00550055, 0x00717777, 0x0079e7db], [0x00800000, 0x00ff00ff, 0x00a3aaaa, 0x00b6dba4],
    [0x01000000, 0x01010101, 0x01170001, 0x0100011a], [0x02000000, 0x03030303, 0x033a0003, 0x030002a7],
    [0x04000000, 0x05050505, 0x06710006, 0x0400079e], [0x08000000, 0x0f0f0f0f, 0x09a30009, 0x0a000b6d],
    [0x10000000, 0x11111111, 0x16160017, 0x1f001001], [0x20000000, 0x33333333, 0x3939003a, 0x2e003003],
    [0x40000000, 0x55555555, 0x77770071, 0x45004004], [0x80000000, 0xffffffff, 0xaaaa00a3, 0xc900a00a],
];
const PMJ02: [[u32; 2]; 32] = [
    [0x00000001, 0x00000001], [0x00000002, 0x00000003], [0x00000006, 0x00000006], [0x0000000c, 0x0000000a],
    [0x00000014, 0x00000014], [0x00000028, 0x0000003c], [0x00000078, 0x00000078], [0x000000f0, 0x00000088],
    [0x00000110, 0x00000110], [0x00000220, 0x00000330], [0x00000660, 0x00000660], [0x00000cc0, 0x00000aa0],
    [0x00001540, 0x00001540], [0x00002a80, 0x00003fc0], [0x00007f80, 0x00007f80], [0x0000ff00, 0x00008080],
    [0x00010100, 0x00010100], [0x00020200, 0x00030300], [0x00060600, 0x00060600], [0x000c0c00, 0x000a0a00],
    [0x00141400, 0x00141400], [0x00282800, 0x003c3c00], [0x00787800, 0x00787800], [0x00f0f000, 0x00888800],
    [0x01111000, 0x01111000], [0x02222000, 0x03333000], [0x06666000, 0x06666000], [0x0cccc000, 0x0aaaa000],
    [0x15554000, 0x15554000], [0x2aaa8000, 0x3fffc000], [0x7fff8000, 0x7fff8000], [0xffff0000, 0x80008000],
];

/// A stream of samples; equal keys give equal samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Domain {
    pub key: u64,
}

pub(crate) fn mix(key: u64) -> u64 {
    let key = key.wrapping_mul(0xd6e8_feb8_6659_fd93);
    key ^ key >> 32
}

pub(crate) fn derived(key: u64, purpose: u32, number: u32) -> u64 {
    let constant = (purpose as u64) << 32 | 0x85a3_08d3;
    mix(key ^ constant ^ (number as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15))
}

/// The seed of one frame of an animation.
pub fn seed_of_frame(seed: u64, frame: u32) -> u64 {
    mix(derived(seed, 0x082e_fa98, frame))
}

pub(crate) fn owen_hash(x: u32, seed: u32) -> u32 {
    let x = x ^ x.wrapping_mul(0x3d20_adea);
    let x = x.wrapping_add(seed).wrapping_mul(seed >> 16 | 1);
    let x = x ^ x.wrapping_mul(0x0552_6c56);
    x ^ x.wrapping_mul(0x53a2_2864)
}

pub(crate) fn seed_of(mixed: u64, dimension: u32) -> u32 {
    let x = (mixed as u32).wrapping_add((dimension + 1).wrapping_mul(0x9e37_79b9));
    let x = (x ^ x >> 16).wrapping_mul(0x7feb_352d);
    let x = (x ^ x >> 15).wrapping_add((mixed >> 32) as u32).wrapping_mul(0x846c_a68b);
    x ^ x >> 16
}

/// A 32-bit fraction as a number in [0, 1).
pub(crate) fn fraction(word: u32) -> f64 {
    word as f64 * (1.0 / 4294967296.0)
}

/// A double in [0, 1) rounded down to a float in [0, 1).
pub fn to_float(x: f64) -> f32 {
    (x * 16777216.0) as u32 as f32 * (1.0 / 16777216.0)
}

impl Domain {
    /// The domain of pixel (x, y) of the image with this seed.
    pub fn of_pixel(seed: u64, x: u32, y: u32) -> Domain {
        let image = mix(seed ^ 0x1319_8a2e_0370_7344);
        Domain { key: mix(mix(image ^ ((y as u64) << 32 | x as u64))) }
    }

    /// The domain for one purpose of this domain's samples.
    pub fn of_use(self, number: u32) -> Domain {
        Domain { key: derived(self.key, 0x243f_6a88, number) }
    }

    /// The domain for one sample of this domain.
    pub fn of_sample(self, i: u32) -> Domain {
        Domain { key: derived(self.key, 0xa409_3822, i) }
    }

    fn digital<const DIM: usize, const WIDTH: usize>(self, columns: &[[u32; WIDTH]; 32], i: u32) -> [f64; DIM] {
        assert!(DIM >= 1 && DIM <= WIDTH, "a draw has 1 to {WIDTH} dimensions; draw more from other domains");
        let mixed = mix(self.key);
        let order = (mix(mixed) >> 32) as u32;
        let mut j = owen_hash(i.reverse_bits(), order) ^ owen_hash(0, order) & 0xffff;
        let mut words = [0; WIDTH];
        while j != 0 {
            let b = j.leading_zeros();
            j ^= 0x8000_0000 >> b;
            for (word, column) in words.iter_mut().zip(columns[b as usize]) {
                *word ^= column;
            }
        }
        core::array::from_fn(|k| fraction(owen_hash(words[k], seed_of(mixed, k as u32)).reverse_bits()))
    }

    /// Sample i in DIM = 1 to 4 dimensions: koksma_sobol_1d to koksma_sobol_4d.
    pub fn sobol<const DIM: usize>(self, i: u32) -> [f64; DIM] {
        self.digital(&SOBOL, i)
    }

    /// Sample i in two dimensions: koksma_pmj02_2d.
    pub fn pmj02(self, i: u32) -> [f64; 2] {
        self.digital(&PMJ02, i)
    }

    /// Independent random numbers of sample i: koksma_white_4d.
    pub fn white(self, i: u32) -> [f64; 4] {
        let mixed = mix(derived(self.key, 0x4528_21e6, i));
        core::array::from_fn(|k| fraction(seed_of(mixed, k as u32)))
    }
}
