// SPDX-License-Identifier: Apache-2.0
// koksma_keys_4d of koksma/keys.h for WGSL, beside koksma_sampler.wgsl: four coordinates of a sample, whose errors are blue
// noise over the screen. You define fn koksma_key_at(i: u32) -> u32: number i of include/koksma/keys_4d.def,
// keys_4d_four.def and keys_4d_single.def, one after the other (13,312 numbers of 16 bits), from a buffer or a texture.
//
//     let pixel = koksma_keys_of_4d(vec2u(seed, 0u), id.x, id.y, quadruple, spp);
//     let xs = koksma_to_float(koksma_keys_4d(pixel, i));

struct koksma_keys {
    seeds: vec4u,
    key: u32,
    order: u32,
    ordered: u32,
    tile: u32,
}

fn koksma_seed_of(key: vec2u, dimension: u32) -> u32 {
    let mixed = koksma_mix(key);
    var x = mixed.x + (dimension + 1u) * 0x9e3779b9u;
    x = (x ^ (x >> 16u)) * 0x7feb352du;
    x = ((x ^ (x >> 15u)) + mixed.y) * 0x846ca68bu;
    return x ^ (x >> 16u);
}

fn koksma_keys_of_4d(seed: vec2u, x: u32, y: u32, quadruple: u32, spp: u32) -> koksma_keys {
    let image = koksma_derived(seed, 0x34e90c6cu, quadruple);
    let offset = koksma_mix(image);
    let tile = select(select(4u, 1u, spp == 1u), 0u, spp == 2u || spp > 4u);
    let size = select(32u, 64u, tile == 1u);
    let last = size - 1u;
    let column = x + (offset.x & last);
    let row = y + (offset.y & last);
    let cell = koksma_domain_of_pixel(image, column / size, row / size);
    let pixel = koksma_derived(koksma_domain_of_pixel(image, column, row), 0x38d01377u, 0u);
    let symmetry = koksma_seed_of(select(cell, image, tile > 0u), 2u);
    let u = (column & last) ^ (last * (symmetry & 1u));
    let v = (row & last) ^ (last * ((symmetry >> 1u) & 1u));
    let place = select(v * size + u, u * size + v, (symmetry & 4u) != 0u);
    let first = vec2u(koksma_seed_of(cell, 0u), koksma_seed_of(cell, 1u));
    let seeds = vec4u(first, koksma_seed_of(cell, 4u), koksma_seed_of(cell, 5u));
    let order = koksma_mix(koksma_mix(pixel)).y;
    if (tile > 0u) {
        let mirrors = (vec4u(symmetry) >> vec4u(3u, 4u, 5u, 6u)) & vec4u(1u);
        let digits = (seeds >> vec4u(3u)) | ((vec4u(0u) - mirrors) << vec4u(29u));
        return koksma_keys(digits, place * tile + ((symmetry >> 7u) & (tile - 1u)), order, min(quadruple, 1u), tile);
    }
    var m = 1u;
    while (m < 22u && (1u << m) < spp) {
        m++;
    }
    let lower = max(m, 6u) - 6u;
    let table = max(m - lower, 2u) - 2u;
    let own = koksma_seed_of(pixel, 0u) & ((1u << lower) - 1u);
    let key = ((koksma_key_at(1024u * table + place) << lower) | own) ^ koksma_seed_of(cell, 3u);
    return koksma_keys(seeds, key, order, min(quadruple, 1u), tile);
}

// Sample i: the words of koksma_keys_4d.
fn koksma_keys_4d(keys: koksma_keys, i: u32) -> vec4u {
    var index = i;
    if (keys.ordered > 0u && i > 1u) {
        let m = firstLeadingBit(i);
        let mirrored = vec4u(reverseBits(i << (32u - m)), 0u, 0u, 0u);
        let hash = koksma_owen_hash(mirrored, vec4u(keys.order + m * 0x9e3779b9u, 0u, 0u, 0u)).x;
        index = (1u << m) | (reverseBits(hash) >> (32u - m));
    }
    index ^= keys.key;
    if (keys.tile > 0u) {
        index = koksma_key_at(select(9216u, 5120u, keys.tile > 1u) + (index & 4095u));
    }
    let words = vec4u(index, koksma_pascal(index), koksma_third(index), koksma_fourth(index));
    return select(reverseBits(koksma_owen_hash(words, keys.seeds)), reverseBits(words) ^ keys.seeds, keys.tile > 0u);
}
