// SPDX-License-Identifier: Apache-2.0
// koksma_keys_4d of koksma/keys.h for GLSL ES 3.00 and later, after koksma_sampler.glsl: four coordinates of a sample,
// whose errors are blue noise over the screen. You define koksma_key_at: number i of include/koksma/keys_4d.def,
// keys_4d_four.def and keys_4d_single.def, one after the other (13,312 numbers of 16 bits), from a texture or a buffer.
//
//     koksma_keys pixel = koksma_keys_of_4d(uvec2(seed, 0u), uint(gl_FragCoord.x), uint(gl_FragCoord.y), quadruple, spp);
//     vec4 xs = koksma_to_float(koksma_keys_4d(pixel, i));

uint koksma_key_at(uint i);

struct koksma_keys {
    uvec4 seeds;
    uint key, order, ordered, tile;
};

uint koksma_seed_of(uvec2 key, uint dimension)
{
    uvec2 mixed = koksma_mix(key);
    uint x = mixed.x + (dimension + 1u) * 0x9e3779b9u;
    x = (x ^ x >> 16) * 0x7feb352du;
    x = ((x ^ x >> 15) + mixed.y) * 0x846ca68bu;
    return x ^ x >> 16;
}

koksma_keys koksma_keys_of_4d(uvec2 seed, uint x, uint y, uint quadruple, uint spp)
{
    uvec2 image = koksma_derived(seed, 0x34e90c6cu, quadruple), offset = koksma_mix(image);
    uint tile = spp == 2u || spp > 4u ? 0u : spp == 1u ? 1u : 4u;
    uint size = tile == 1u ? 64u : 32u, last = size - 1u;
    uint column = x + (offset.x & last), row = y + (offset.y & last);
    uvec2 cell = koksma_domain_of_pixel(image, column / size, row / size);
    uvec2 pixel = koksma_derived(koksma_domain_of_pixel(image, column, row), 0x38d01377u, 0u);
    uint symmetry = koksma_seed_of(tile > 0u ? image : cell, 2u);
    uint u = (column & last) ^ last * (symmetry & 1u), v = (row & last) ^ last * (symmetry >> 1 & 1u);
    uint place = (symmetry & 4u) != 0u ? u * size + v : v * size + u;
    koksma_keys keys;
    keys.seeds = uvec4(koksma_seed_of(cell, 0u), koksma_seed_of(cell, 1u), koksma_seed_of(cell, 4u), koksma_seed_of(cell, 5u));
    keys.order = koksma_mix(koksma_mix(pixel)).y;
    keys.ordered = min(quadruple, 1u);
    keys.tile = tile;
    if (tile > 0u) {
        keys.key = place * tile + (symmetry >> 7 & (tile - 1u));
        keys.seeds = keys.seeds >> 3 | (0u - (uvec4(symmetry) >> uvec4(3u, 4u, 5u, 6u) & 1u)) << 29;
    } else {
        uint m = 1u;
        while (m < 22u && 1u << m < spp) {
            m++;
        }
        uint lower = max(m, 6u) - 6u, table = max(m - lower, 2u) - 2u;
        keys.key = (koksma_key_at(1024u * table + place) << lower | (koksma_seed_of(pixel, 0u) & ((1u << lower) - 1u))) ^
            koksma_seed_of(cell, 3u);
    }
    return keys;
}

// Sample i: the words of koksma_keys_4d.
uvec4 koksma_keys_4d(koksma_keys keys, uint i)
{
    uint index = i;
    if (keys.ordered > 0u && i > 1u) {
        uint m = 31u;
        while ((i >> m) == 0u) {
            m--;
        }
        uint mirrored = koksma_mirror(uvec4(i << (32u - m))).x;
        uint hash = koksma_owen_hash(uvec4(mirrored), uvec4(keys.order + m * 0x9e3779b9u)).x;
        index = 1u << m | koksma_mirror(uvec4(hash)).x >> (32u - m);
    }
    index ^= keys.key;
    if (keys.tile > 0u) {
        index = koksma_key_at((keys.tile > 1u ? 5120u : 9216u) + (index & 4095u));
    }
    uvec4 words = uvec4(index, koksma_pascal(index), koksma_third(index), koksma_fourth(index));
    return keys.tile > 0u ? koksma_mirror(words) ^ keys.seeds : koksma_mirror(koksma_owen_hash(words, keys.seeds));
}
