// SPDX-License-Identifier: Apache-2.0
// koksma/sampler.h for GLSL ES 3.00 and later. A domain is a 64-bit key: a uvec2 of its lower and its upper word. Every result has the bits of
// the header, whose comments say what the functions promise. Words are 32-bit fractions: koksma_to_float makes floats in [0,1)
// of them.
//
//     uvec2 pixel = koksma_domain_of_pixel(uvec2(seed, 0u), uint(gl_FragCoord.x), uint(gl_FragCoord.y));
//     vec4 lens = koksma_to_float(koksma_sobol(koksma_domain_of_use(pixel, LENS), i));

const uvec4 KOKSMA_SOBOL[32] = uvec4[32](
    uvec4(0x1u, 0x1u, 0x1u, 0x1u), uvec4(0x2u, 0x3u, 0x3u, 0x3u), uvec4(0x4u, 0x5u, 0x6u, 0x4u),
    uvec4(0x8u, 0xfu, 0x9u, 0xau), uvec4(0x10u, 0x11u, 0x17u, 0x1fu), uvec4(0x20u, 0x33u, 0x3au, 0x2eu),
    uvec4(0x40u, 0x55u, 0x71u, 0x45u), uvec4(0x80u, 0xffu, 0xa3u, 0xc9u), uvec4(0x100u, 0x101u, 0x116u, 0x11bu),
    uvec4(0x200u, 0x303u, 0x339u, 0x2a4u), uvec4(0x400u, 0x505u, 0x677u, 0x79au), uvec4(0x800u, 0xf0fu, 0x9aau, 0xb67u),
    uvec4(0x1000u, 0x1111u, 0x1601u, 0x101eu), uvec4(0x2000u, 0x3333u, 0x3903u, 0x302du), uvec4(0x4000u, 0x5555u, 0x7706u, 0x4041u),
    uvec4(0x8000u, 0xffffu, 0xaa09u, 0xa0c3u), uvec4(0x10000u, 0x10001u, 0x10117u, 0x1f104u), uvec4(0x20000u, 0x30003u, 0x3033au, 0x2e28au),
    uvec4(0x40000u, 0x50005u, 0x60671u, 0x457dfu), uvec4(0x80000u, 0xf000fu, 0x909a3u, 0xc9baeu), uvec4(0x100000u, 0x110011u, 0x171616u, 0x11a105u),
    uvec4(0x200000u, 0x330033u, 0x3a3939u, 0x2a7289u), uvec4(0x400000u, 0x550055u, 0x717777u, 0x79e7dbu), uvec4(0x800000u, 0xff00ffu, 0xa3aaaau, 0xb6dba4u),
    uvec4(0x1000000u, 0x1010101u, 0x1170001u, 0x100011au), uvec4(0x2000000u, 0x3030303u, 0x33a0003u, 0x30002a7u), uvec4(0x4000000u, 0x5050505u, 0x6710006u, 0x400079eu),
    uvec4(0x8000000u, 0xf0f0f0fu, 0x9a30009u, 0xa000b6du), uvec4(0x10000000u, 0x11111111u, 0x16160017u, 0x1f001001u), uvec4(0x20000000u, 0x33333333u, 0x3939003au, 0x2e003003u),
    uvec4(0x40000000u, 0x55555555u, 0x77770071u, 0x45004004u), uvec4(0x80000000u, 0xffffffffu, 0xaaaa00a3u, 0xc900a00au));
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

// Sample i: the words of koksma_sobol_4d.
uvec4 koksma_sobol(uvec2 domain, uint i)
{
    uvec2 mixed = koksma_mix(domain);
    uint j = koksma_shuffled(mixed, i);
    uvec4 x = uvec4(0u);
    for (int b = 0; b < 32; b++) {
        x ^= KOKSMA_SOBOL[b] * (j >> (31 - b) & 1u);
    }
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
