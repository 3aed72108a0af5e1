// SPDX-License-Identifier: Apache-2.0
// koksma/sampler.h for WGSL. A domain is a 64-bit key: a vec2u of its lower and its upper word. Every result has the bits of
// the header, whose comments say what the functions promise. Words are 32-bit fractions: koksma_to_float makes floats in [0,1)
// of them.
//
//     let pixel = koksma_domain_of_pixel(vec2u(seed, 0u), id.x, id.y);
//     let lens = koksma_to_float(koksma_sobol(koksma_domain_of_use(pixel, LENS), i));

// Column b of the two dimensions of PMJ02: the digits of point 2^b, bits reversed.
const KOKSMA_PMJ02 = array<vec2u, 32>(
    vec2u(0x1u, 0x1u), vec2u(0x2u, 0x3u), vec2u(0x6u, 0x6u),
    vec2u(0xcu, 0xau), vec2u(0x14u, 0x14u), vec2u(0x28u, 0x3cu),
    vec2u(0x78u, 0x78u), vec2u(0xf0u, 0x88u), vec2u(0x110u, 0x110u),
    vec2u(0x220u, 0x330u), vec2u(0x660u, 0x660u), vec2u(0xcc0u, 0xaa0u),
    vec2u(0x1540u, 0x1540u), vec2u(0x2a80u, 0x3fc0u), vec2u(0x7f80u, 0x7f80u),
    vec2u(0xff00u, 0x8080u), vec2u(0x10100u, 0x10100u), vec2u(0x20200u, 0x30300u),
    vec2u(0x60600u, 0x60600u), vec2u(0xc0c00u, 0xa0a00u), vec2u(0x141400u, 0x141400u),
    vec2u(0x282800u, 0x3c3c00u), vec2u(0x787800u, 0x787800u), vec2u(0xf0f000u, 0x888800u),
    vec2u(0x1111000u, 0x1111000u), vec2u(0x2222000u, 0x3333000u), vec2u(0x6666000u, 0x6666000u),
    vec2u(0xcccc000u, 0xaaaa000u), vec2u(0x15554000u, 0x15554000u), vec2u(0x2aaa8000u, 0x3fffc000u),
    vec2u(0x7fff8000u, 0x7fff8000u), vec2u(0xffff0000u, 0x80008000u));

// The upper 32 bits of a product, by halves.
fn koksma_upper(a: u32, b: u32) -> u32 {
    let low = (a & 0xffffu) * (b & 0xffffu);
    let middle = (a >> 16u) * (b & 0xffffu) + (low >> 16u);
    let other = (a & 0xffffu) * (b >> 16u) + (middle & 0xffffu);
    return (a >> 16u) * (b >> 16u) + (middle >> 16u) + (other >> 16u);
}

fn koksma_product(a: vec2u, b: vec2u) -> vec2u {
    return vec2u(a.x * b.x, koksma_upper(a.x, b.x) + a.x * b.y + a.y * b.x);
}

fn koksma_mix(key: vec2u) -> vec2u {
    let p = koksma_product(key, vec2u(0x6659fd93u, 0xd6e8feb8u));
    return vec2u(p.x ^ p.y, p.y);
}

fn koksma_derived(key: vec2u, purpose: u32, number: u32) -> vec2u {
    let product = koksma_product(vec2u(number, 0u), vec2u(0x7f4a7c15u, 0x9e3779b9u));
    return koksma_mix(key ^ vec2u(0x85a308d3u, purpose) ^ product);
}

fn koksma_domain_of_use(domain: vec2u, use_number: u32) -> vec2u {
    return koksma_derived(domain, 0x243f6a88u, use_number);
}

fn koksma_domain_of_sample(domain: vec2u, i: u32) -> vec2u {
    return koksma_derived(domain, 0xa4093822u, i);
}

fn koksma_seed_of_frame(seed: vec2u, frame: u32) -> vec2u {
    return koksma_mix(koksma_derived(seed, 0x082efa98u, frame));
}

fn koksma_domain_of_pixel(seed: vec2u, x: u32, y: u32) -> vec2u {
    let image = koksma_mix(seed ^ vec2u(0x03707344u, 0x13198a2eu));
    return koksma_mix(koksma_mix(image ^ vec2u(x, y)));
}

fn koksma_owen_hash(value: vec4u, seed: vec4u) -> vec4u {
    var x = value ^ (value * 0x3d20adeau);
    x = (x + seed) * ((seed >> vec4u(16u)) | vec4u(1u));
    x = x ^ (x * 0x05526c56u);
    return x ^ (x * 0x53a22864u);
}

fn koksma_seeds(mixed: vec2u) -> vec4u {
    var x = mixed.x + vec4u(0x9e3779b9u, 0x3c6ef372u, 0xdaa66d2bu, 0x78dde6e4u);
    x = (x ^ (x >> vec4u(16u))) * 0x7feb352du;
    x = ((x ^ (x >> vec4u(15u))) + mixed.y) * 0x846ca68bu;
    return x ^ (x >> vec4u(16u));
}

// The index at position i of a domain's order, bits reversed.
fn koksma_shuffled(mixed: vec2u, i: u32) -> u32 {
    let order = vec4u(koksma_mix(mixed).y);
    let hashes = koksma_owen_hash(vec4u(reverseBits(i), 0u, 0u, 0u), order);
    return hashes.x ^ (hashes.y & 0xffffu);
}

// The product of an index and the Pascal matrix: coordinate 2, bits reversed.
fn koksma_pascal(index: u32) -> u32 {
    var i = index;
    i ^= (i & 0xaaaaaaaau) >> 1u;
    i ^= (i & 0xccccccccu) >> 2u;
    i ^= (i & 0xf0f0f0f0u) >> 4u;
    i ^= (i & 0xff00ff00u) >> 8u;
    return i ^ (i >> 16u);
}

// Coordinates 3 and 4, bits reversed. The columns of a coordinate's matrix obey the recurrence of its polynomial p: with E the
// step to the next column and z the shift by deg p bits, p(E) = z. So an index, as a polynomial in E, is written in powers of p:
// each step divides all parts by p^(2^k) = p(E^(2^k)) and leaves the quotients above the remainders. Its first line completes
// the quotients, its second takes their products from the remainders. The last line has the first deg p columns.
fn koksma_third(index: u32) -> u32 { // p = E^2 + E + 1
    var i = index;
    i ^= (i & 0xff000000u) >> 8u;
    i ^= (i >> 16u) ^ ((i >> 8u) & 0x0000ff00u);
    i ^= (i & 0xf000f000u) >> 4u;
    i ^= ((i >> 8u) & 0x00ff00ffu) ^ ((i >> 4u) & 0x00f000f0u);
    i ^= (i & 0xc0c0c0c0u) >> 2u;
    i ^= ((i >> 4u) & 0x0f0f0f0fu) ^ ((i >> 2u) & 0x0c0c0c0cu);
    i ^= (i & 0x88888888u) >> 1u;
    i ^= ((i >> 2u) & 0x33333333u) ^ ((i >> 1u) & 0x22222222u);
    return i ^ ((i >> 1u) & 0x55555555u);
}

fn koksma_fourth(index: u32) -> u32 { // p = E^3 + E + 1; the quotient by p^8 is complete
    var i = index;
    i ^= (i >> 24u) ^ ((i >> 16u) & 0x0000ff00u);
    i ^= (i & 0x00f00000u) >> 8u;
    i ^= ((i >> 12u) & 0x00000fffu) ^ ((i >> 8u) & 0x00000ff0u);
    i ^= (i & 0x00c00c00u) >> 4u;
    i ^= ((i >> 6u) & 0x0303f03fu) ^ ((i >> 4u) & 0x0c03c03cu);
    i ^= (i & 0x20820820u) >> 2u;
    i ^= ((i >> 3u) & 0x071c71c7u) ^ ((i >> 2u) & 0x06186186u);
    return i ^ ((i >> 1u) & 0x49249249u);
}

// Sample i: the words of koksma_sobol_4d.
fn koksma_sobol(domain: vec2u, i: u32) -> vec4u {
    let mixed = koksma_mix(domain);
    let index = reverseBits(koksma_shuffled(mixed, i));
    let x = vec4u(index, koksma_pascal(index), koksma_third(index), koksma_fourth(index));
    return reverseBits(koksma_owen_hash(x, koksma_seeds(mixed)));
}

// Sample i: the words of koksma_pmj02_2d.
fn koksma_pmj02(domain: vec2u, i: u32) -> vec2u {
    let mixed = koksma_mix(domain);
    let j = koksma_shuffled(mixed, i);
    var columns = KOKSMA_PMJ02;
    var x = vec2u(0u);
    for (var b = 0u; b < 32u; b++) {
        x = x ^ (columns[b] * ((j >> (31u - b)) & 1u));
    }
    return reverseBits(koksma_owen_hash(vec4u(x, 0u, 0u), koksma_seeds(mixed))).xy;
}

// Four random words: those of koksma_white_4d.
fn koksma_white(domain: vec2u, i: u32) -> vec4u {
    return koksma_seeds(koksma_mix(koksma_derived(domain, 0x452821e6u, i)));
}

// The floats of koksma_sobol_4f.
fn koksma_to_float(words: vec4u) -> vec4f {
    return vec4f(words >> vec4u(8u)) * (1.0 / 16777216.0);
}
