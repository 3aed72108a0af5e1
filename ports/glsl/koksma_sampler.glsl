// SPDX-License-Identifier: Apache-2.0
// koksma/sampler.h for GLSL ES 3.00 and later. A domain is a 64-bit key: a uvec2 of its lower and its upper word. Every result has the bits of
// the header, whose comments say what the functions promise. Words are 32-bit fractions: koksma_to_float makes floats in [0,1)
// of them.
//
//     uvec2 pixel = koksma_domain_of_pixel(uvec2(seed, 0u), uint(gl_FragCoord.x), uint(gl_FragCoord.y));
//     vec4 lens = koksma_to_float(koksma_sobol(koksma_domain_of_use(pixel, LENS), i));

// Column b of the two dimensions of PMJ02: the digits of point 2^b, bits reversed.
const uvec2 KOKSMA_PMJ02[32] = uvec2[32](
    uvec2(0x1u, 0x1u), uvec2(0x2u, 0x3u), uvec2(0x6u, 0x6u),
    uvec2(0xcu, 0xau), uvec2(0x14u, 0x14u), uvec2(0x28u, 0x3cu),
    uvec2(0x78u, 0x78u), uvec2(0xf0u, 0x88u), uvec2(0x110u, 0x110u),
    uvec2(0x220u, 0x330u), uvec2(0x660u, 0x660u), uvec2(0xcc0u, 0xaa0u),
    uvec2(0x1540u, 0x1540u), uvec2(0x2a80u, 0x3fc0u), uvec2(0x7f80u, 0x7f80u),
    uvec2(0xff00u, 0x8080u), uvec2(0x10100u, 0x10100u), uvec2(0x20200u, 0x30300u),
    uvec2(0x60600u, 0x60600u), uvec2(0xc0c00u, 0xa0a00u), uvec2(0x141400u, 0x141400u),
    uvec2(0x282800u, 0x3c3c00u), uvec2(0x787800u, 0x787800u), uvec2(0xf0f000u, 0x888800u),
    uvec2(0x1111000u, 0x1111000u), uvec2(0x2222000u, 0x3333000u), uvec2(0x6666000u, 0x6666000u),
    uvec2(0xcccc000u, 0xaaaa000u), uvec2(0x15554000u, 0x15554000u), uvec2(0x2aaa8000u, 0x3fffc000u),
    uvec2(0x7fff8000u, 0x7fff8000u), uvec2(0xffff0000u, 0x80008000u));

// The upper 32 bits of a product, by halves.
uint koksma_upper(uint a, uint b)
{
    uint low = (a & 0xffffu) * (b & 0xffffu);
    uint middle = (a >> 16) * (b & 0xffffu) + (low >> 16);
    uint other = (a & 0xffffu) * (b >> 16) + (middle & 0xffffu);
    return (a >> 16) * (b >> 16) + (middle >> 16) + (other >> 16);
}

uvec2 koksma_product(uvec2 a, uvec2 b)
{
    return uvec2(a.x * b.x, koksma_upper(a.x, b.x) + a.x * b.y + a.y * b.x);
}

uvec2 koksma_mix(uvec2 key)
{
    uvec2 p = koksma_product(key, uvec2(0x6659fd93u, 0xd6e8feb8u));
    return uvec2(p.x ^ p.y, p.y);
}

uvec2 koksma_derived(uvec2 key, uint purpose, uint number)
{
    return koksma_mix(key ^ uvec2(0x85a308d3u, purpose) ^ koksma_product(uvec2(number, 0u), uvec2(0x7f4a7c15u, 0x9e3779b9u)));
}

uvec2 koksma_domain_of_use(uvec2 domain, uint use)
{
    return koksma_derived(domain, 0x243f6a88u, use);
}

uvec2 koksma_domain_of_sample(uvec2 domain, uint i)
{
    return koksma_derived(domain, 0xa4093822u, i);
}

uvec2 koksma_seed_of_frame(uvec2 seed, uint frame)
{
    return koksma_mix(koksma_derived(seed, 0x082efa98u, frame));
}

uvec2 koksma_domain_of_pixel(uvec2 seed, uint x, uint y)
{
    uvec2 image = koksma_mix(seed ^ uvec2(0x03707344u, 0x13198a2eu));
    return koksma_mix(koksma_mix(image ^ uvec2(x, y)));
}

uvec4 koksma_mirror(uvec4 x)
{
    x = (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x00ff00ffu) << 8 | (x >> 8 & 0x00ff00ffu);
    return x << 16 | x >> 16;
}

uvec4 koksma_owen_hash(uvec4 x, uvec4 seed)
{
    x ^= x * 0x3d20adeau;
    x = (x + seed) * (seed >> 16 | 1u);
    x ^= x * 0x05526c56u;
    return x ^ x * 0x53a22864u;
}

uvec4 koksma_seeds(uvec2 mixed)
{
    uvec4 x = mixed.x + uvec4(0x9e3779b9u, 0x3c6ef372u, 0xdaa66d2bu, 0x78dde6e4u);
    x = (x ^ x >> 16) * 0x7feb352du;
    x = ((x ^ x >> 15) + mixed.y) * 0x846ca68bu;
    return x ^ x >> 16;
}

// The index at position i of a domain's order, bits reversed.
uint koksma_shuffled(uvec2 mixed, uint i)
{
    uvec4 order = uvec4(koksma_mix(mixed).y);
    uvec4 hashes = koksma_owen_hash(uvec4(koksma_mirror(uvec4(i)).x, 0u, 0u, 0u), order);
    return hashes.x ^ (hashes.y & 0xffffu);
}

// The product of an index and the Pascal matrix: coordinate 2, bits reversed.
uint koksma_pascal(uint i)
{
    i ^= (i & 0xaaaaaaaau) >> 1;
    i ^= (i & 0xccccccccu) >> 2;
    i ^= (i & 0xf0f0f0f0u) >> 4;
    i ^= (i & 0xff00ff00u) >> 8;
    return i ^ i >> 16;
}

// Coordinates 3 and 4, bits reversed. The columns of a coordinate's matrix obey the recurrence of its polynomial p: with E the
// step to the next column and z the shift by deg p bits, p(E) = z. So an index, as a polynomial in E, is written in powers of p:
// each step divides all parts by p^(2^k) = p(E^(2^k)) and leaves the quotients above the remainders. Its first line completes
// the quotients, its second takes their products from the remainders. The last line has the first deg p columns.
uint koksma_third(uint i) // p = E^2 + E + 1
{
    i ^= (i & 0xff000000u) >> 8;
    i ^= i >> 16 ^ (i >> 8 & 0x0000ff00u);
    i ^= (i & 0xf000f000u) >> 4;
    i ^= (i >> 8 & 0x00ff00ffu) ^ (i >> 4 & 0x00f000f0u);
    i ^= (i & 0xc0c0c0c0u) >> 2;
    i ^= (i >> 4 & 0x0f0f0f0fu) ^ (i >> 2 & 0x0c0c0c0cu);
    i ^= (i & 0x88888888u) >> 1;
    i ^= (i >> 2 & 0x33333333u) ^ (i >> 1 & 0x22222222u);
    return i ^ (i >> 1 & 0x55555555u);
}

uint koksma_fourth(uint i) // p = E^3 + E + 1; the quotient by p^8 is complete
{
    i ^= i >> 24 ^ (i >> 16 & 0x0000ff00u);
    i ^= (i & 0x00f00000u) >> 8;
    i ^= (i >> 12 & 0x00000fffu) ^ (i >> 8 & 0x00000ff0u);
    i ^= (i & 0x00c00c00u) >> 4;
    i ^= (i >> 6 & 0x0303f03fu) ^ (i >> 4 & 0x0c03c03cu);
    i ^= (i & 0x20820820u) >> 2;
    i ^= (i >> 3 & 0x071c71c7u) ^ (i >> 2 & 0x06186186u);
    return i ^ (i >> 1 & 0x49249249u);
}

// Sample i: the words of koksma_sobol_4d.
uvec4 koksma_sobol(uvec2 domain, uint i)
{
    uvec2 mixed = koksma_mix(domain);
    uint index = koksma_mirror(uvec4(koksma_shuffled(mixed, i))).x;
    uvec4 x = uvec4(index, koksma_pascal(index), koksma_third(index), koksma_fourth(index));
    return koksma_mirror(koksma_owen_hash(x, koksma_seeds(mixed)));
}

// Sample i: the words of koksma_pmj02_2d.
uvec2 koksma_pmj02(uvec2 domain, uint i)
{
    uvec2 mixed = koksma_mix(domain);
    uint j = koksma_shuffled(mixed, i);
    uvec2 x = uvec2(0u);
    for (int b = 0; b < 32; b++) {
        x ^= KOKSMA_PMJ02[b] * (j >> (31 - b) & 1u);
    }
    return koksma_mirror(koksma_owen_hash(uvec4(x, 0u, 0u), koksma_seeds(mixed))).xy;
}

// Four random words: those of koksma_white_4d.
uvec4 koksma_white(uvec2 domain, uint i)
{
    return koksma_seeds(koksma_mix(koksma_derived(domain, 0x452821e6u, i)));
}

// The floats of koksma_sobol_4f.
vec4 koksma_to_float(uvec4 words)
{
    return vec4(words >> 8) * (1.0 / 16777216.0);
}
