// SPDX-License-Identifier: Apache-2.0
//! koksma_keys_4d of koksma/keys.h for Rust, beside koksma_sampler.rs: four coordinates of a sample, whose errors are blue
//! noise over the screen. It reads the header's three tables when it is compiled.
//!
//! ```ignore
//! mod koksma_keys;
//! mod koksma_sampler;
//! let pixel = koksma_keys::Keys::of_4d(seed, x, y, quadruple, spp);
//! for i in 0..spp {
//!     let xs = pixel.sample_4d(i);
//! }
//! ```
//!
//! Every result has the bits of the header, whose comments say what the functions promise.
use super::koksma_sampler::{derived, fraction, mix, owen_hash, seed_of, Domain, SOBOL};

// The numbers of a table: of its text without the lines of comments.
const fn numbers<const N: usize>(text: &str) -> [u16; N] {
    let bytes = text.as_bytes();
    let (mut found, mut n, mut at, mut inside) = ([0; N], 0, 0, false);
    while at < bytes.len() {
        while bytes[at] == b'/' {
            while bytes[at] != b'\n' {
                at += 1;
            }
            at += 1;
        }
        let digit = bytes[at].is_ascii_digit();
        if digit {
            found[n] = found[n] * 10 + (bytes[at] - b'0') as u16;
        }
        n += (inside && !digit) as usize;
        inside = digit;
        at += 1;
    }
    assert!(n == N);
    found
}

static KEYS: [u16; 5120] = numbers(include_str!("../../include/koksma/keys_4d.def"));
static FOUR: [u16; 4096] = numbers(include_str!("../../include/koksma/keys_4d_four.def"));
static SINGLE: [u16; 4096] = numbers(include_str!("../../include/koksma/keys_4d_single.def"));

/// The key and the scrambling of one pixel and quadruple of dimensions. Compute them once for all samples.
#[derive(Clone, Copy, Debug)]
pub struct Keys {
    seeds: [u32; 4],
    key: u32,
    order: u32,
    ordered: bool,
    tile: u32,
}

impl Keys {
    /// The key of pixel (x, y) of the image with this seed, with spp = 1 to 2^22 samples: koksma_keys_of_4d.
    pub fn of_4d(seed: u64, x: u32, y: u32, quadruple: u32, spp: u32) -> Keys {
        assert!((1..=1 << 22).contains(&spp), "{spp} samples a pixel: 1 to 2^22");
        let image = derived(seed, 0x34e9_0c6c, quadruple);
        let offset = mix(image);
        let tile = [1, 0, 4, 4].get(spp as usize - 1).copied().unwrap_or(0);
        let size = if tile == 1 { 64 } else { 32 };
        let last = size - 1;
        let column = x.wrapping_add(offset as u32 & last);
        let row = y.wrapping_add((offset >> 32) as u32 & last);
        let cell = mix(Domain::of_pixel(image, column / size, row / size).key);
        let pixel = derived(Domain::of_pixel(image, column, row).key, 0x38d0_1377, 0);
        let symmetry = seed_of(if tile > 0 { mix(image) } else { cell }, 2);
        let u = (column & last) ^ last * (symmetry & 1);
        let v = (row & last) ^ last * (symmetry >> 1 & 1);
        let place = if symmetry & 4 > 0 { u * size + v } else { v * size + u };
        let mut seeds = [0, 1, 4, 5].map(|dimension| seed_of(cell, dimension));
        let key = if tile > 0 {
            for (k, seed) in seeds.iter_mut().enumerate() {
                *seed = *seed >> 3 | 0xe000_0000 * (symmetry >> (3 + k) & 1);
            }
            place * tile + (symmetry >> 7 & (tile - 1))
        } else {
            let m = spp.next_power_of_two().trailing_zeros();
            let lower = m.saturating_sub(6);
            let own = seed_of(mix(pixel), 0) & ((1 << lower) - 1);
            let key = KEYS[(1024 * (m - lower).saturating_sub(2) + place) as usize];
            ((key as u32) << lower | own) ^ seed_of(cell, 3)
        };
        Keys { seeds, key, order: (mix(mix(pixel)) >> 32) as u32, ordered: quadruple > 0, tile }
    }

    /// Sample i: koksma_keys_4d.
    pub fn sample_4d(&self, i: u32) -> [f64; 4] {
        let mut index = i;
        if self.ordered && i > 1 {
            let m = i.ilog2();
            let hash = owen_hash((i << (32 - m)).reverse_bits(), self.order.wrapping_add(m.wrapping_mul(0x9e37_79b9)));
            index = 1 << m | hash.reverse_bits() >> (32 - m);
        }
        index ^= self.key;
        if self.tile > 0 {
            let table = if self.tile > 1 { &FOUR } else { &SINGLE };
            index = table[index as usize & 4095] as u32;
        }
        let mut words = [0; 4];
        for column in (0..32).filter(|b| index >> b & 1 > 0).map(|b| SOBOL[b]) {
            for (word, digits) in words.iter_mut().zip(column) {
                *word ^= digits;
            }
        }
        core::array::from_fn(|k| {
            let tiled = words[k].reverse_bits() ^ self.seeds[k];
            fraction(if self.tile > 0 { tiled } else { owen_hash(words[k], self.seeds[k]).reverse_bits() })
        })
    }
}
