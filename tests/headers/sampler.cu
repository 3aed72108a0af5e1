/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sampler.h, keys.h and mask.h in CUDA: the device gives the host's bits for every function, and the vectors of
 * ports/vectors.txt.
 *
 *     sampler VECTORS
 *
 * Each sample i calls every public function with arguments that depend on i and folds the results into words; the device's
 * words are compared with the host's. tests/headers/cuda.sh checks that no function of the headers is missing here. The
 * vectors are those of tests/ports/vectors.c: one thread computes one block of 2^14 draws.
 *
 * Exit code 77: it compiles, and there is no device to run it on.
 */
#include <koksma/keys.h>
#include <koksma/mask.h>
#include <koksma/sampler.h>

#include <cstdio>
#include <cstring>

enum { N = 1 << 18, NUMBERS = 72, BLOCK = 1 << 14, BLOCKS = 64, FAMILIES = 5 };

struct sink {
    uint64_t *words;
    int count;
};

__host__ __device__ static void put(sink &out, uint64_t word)
{
    out.words[out.count++] = word;
}

/* The bits of an exact number: every coordinate is a multiple of 2^-63, or of a double's last bit, below 1. */
__host__ __device__ static void put(sink &out, double x)
{
    union {
        double x;
        uint64_t bits;
    } both;
    both.x = x;
    put(out, both.bits);
}

__host__ __device__ static void put_all(sink &out, const double *xs, int count)
{
    for (int k = 0; k < count; k++) {
        put(out, xs[k]);
    }
}

__host__ __device__ static void put_floats(sink &out, const float *xs, int count)
{
    for (int k = 0; k < count; k++) {
        put(out, (double)xs[k]);
    }
}

__host__ __device__ static void put_sobol(sink &out, koksma_domain use, uint32_t i)
{
    const koksma_sobol sequence = koksma_sobol_of(use);
    const koksma_domain domains[2] = {use, koksma_domain_of_use(use, 9)};
    const uint32_t indices[2] = {i, i / 3};
    double xs[8];
    float fs[8];
    put(out, koksma_sobol_1d(use, i));
    koksma_sobol_2d(use, i, xs);
    put_all(out, xs, 2);
    koksma_sobol_3d(use, i, xs);
    put_all(out, xs, 3);
    koksma_sobol_4d(use, i, xs);
    put_all(out, xs, 4);
    fs[0] = koksma_sobol_1f(use, i);
    koksma_sobol_2f(use, i, fs + 1);
    put_floats(out, fs, 3);
    koksma_sobol_3f(use, i, fs);
    put_floats(out, fs, 3);
    koksma_sobol_4f(use, i, fs);
    put_floats(out, fs, 4);
    koksma_sobol_at_2d(&sequence, i, xs);
    koksma_sobol_at_4d(&sequence, i, xs + 2);
    put_all(out, xs, 6);
    koksma_sobol_range(use, i, 2, 2, xs);
    koksma_sobol_range_float(use, i, 2, 2, fs);
    put(out, xs[3]);
    put(out, (double)fs[3]);
    koksma_sobol_lanes(2, domains, indices, 2, xs);
    koksma_sobol_lanes_float(2, domains, indices, 2, fs);
    put(out, xs[3]);
    put(out, (double)fs[3]);
}

__host__ __device__ static void put_others(sink &out, koksma_domain use, uint32_t i)
{
    double xs[4];
    float fs[4];
    uint32_t words[4];
    put(out, koksma_white_1d(use, i));
    koksma_white_4d(use, i, xs);
    put_all(out, xs, 4);
    fs[0] = koksma_white_1f(use, i);
    put(out, (double)fs[0]);
    koksma_white_4f(use, i, fs);
    put(out, (double)fs[3]);
    koksma_pmj02_2d(use, i, xs);
    put_all(out, xs, 2);
    koksma_cmj_2d(use, i % 60, 5, 12, xs);
    put_all(out, xs, 2);
    koksma_r_2d(use, (uint64_t)i << 20 | i, xs);
    put_all(out, xs, 2);
    put(out, (uint64_t)koksma_z_rank(use, i % 256, i / 256 % 256, 8));
    koksma_words(use.key, KOKSMA_FOR_POINT, i, 3, words);
    put(out, (uint64_t)words[0] << 32 | words[3]);
    put(out, koksma_to_unit(words[1], words[2]));
    put(out, (double)koksma_to_float(koksma_fraction(words[1])));
    put(out, koksma_place(i % 7, koksma_fraction(words[2]), 7));
    put(out, (uint64_t)koksma_permute(i % 1000, 1000, use.key) << 32 | koksma_permute4(i & 3, words[0]));
    put(out, (uint64_t)koksma_mirror(i) << 32 | koksma_owen_hash(i, words[0]));
    put(out, (uint64_t)koksma_pascal(i) << 32 | koksma_part_of_sample(i, 4, 3));
    put(out, (uint64_t)koksma_seed_of(use.key, i % 4) << 32 | koksma_seed_of_order(use.key));
    put(out, (uint64_t)koksma_shuffled(i, koksma_order(use.key, i % 3)) ^ koksma_mix(use.key));
}

__host__ __device__ static void put_pixels(sink &out, uint64_t seed, koksma_domain use, uint32_t i)
{
    const koksma_sobol sequence = koksma_sobol_of(use);
    const koksma_keys keys = koksma_keys_of(seed, i % 256, i / 256 % 256, i % 3, 1u + i % 200);
    const uint32_t values[3] = {koksma_mask_value(i % 4096, 4096, i * 2654435761u),
                                koksma_mask_value(i / 5 % 4096, 4096, i), koksma_mask_value(i / 7 % 4096, 4096, ~i)};
    double xs[2];
    float fs[2];
    koksma_keys_2d(&keys, i % 200, xs);
    put_all(out, xs, 2);
    koksma_keys_2f(&keys, i % 200, fs);
    put_floats(out, fs, 2);
    const koksma_keys quadruple = koksma_keys_of_4d(seed, i % 256, i / 256 % 256, i % 3, 1u + i % 200);
    double four[4];
    float rounded[4];
    koksma_keys_4d(&quadruple, i % 200, four);
    put_all(out, four, 4);
    koksma_keys_4f(&quadruple, i % 200, rounded);
    put_floats(out, rounded, 4);
    koksma_mask_2d(&sequence, values, i % 24, 24, xs);
    put_all(out, xs, 2);
}

__host__ __device__ static int draw(uint32_t i, uint64_t *words)
{
    const uint64_t seed = koksma_seed_of_frame(1, i % 3);
    const koksma_domain pixel = koksma_domain_of_pixel(seed, i % 256, i / 256);
    const koksma_domain use = koksma_domain_of_sample(koksma_domain_of_use(pixel, i % 5), i % 2);
    sink out = {words, 0};
    put_sobol(out, use, i);
    put_others(out, use, i);
    put_pixels(out, seed, use, i);
    return out.count;
}

__global__ static void draw_all(uint64_t *words)
{
    const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < N) {
        draw(i, words + (size_t)NUMBERS * i);
    }
}

__device__ static uint32_t hashed(uint32_t h, const double *xs, int count)
{
    for (int k = 0; k < count; k++) {
        h = (h ^ (uint32_t)(xs[k] * 4294967296.0)) * 16777619u;
    }
    return h;
}

/* The hashes of one block of draws, as tests/ports/vectors.c defines them. */
__global__ static void hash_blocks(uint32_t *hashes)
{
    const uint32_t block = blockIdx.x * blockDim.x + threadIdx.x;
    uint32_t h[FAMILIES] = {2166136261u, 2166136261u, 2166136261u, 2166136261u, 2166136261u};
    for (uint32_t k = block * BLOCK; k < (block + 1) * BLOCK; k++) {
        const uint64_t seed = koksma_seed_of_frame(0x0123456789abcdefu ^ k >> 18, k >> 16 & 3);
        const koksma_domain use = koksma_domain_of_use(koksma_domain_of_pixel(seed, k & 255, k >> 8 & 255), k % 5);
        const koksma_domain domain = koksma_domain_of_sample(use, k % 3);
        const uint32_t index = k * 2654435761u >> k % 25;
        const uint32_t spp = 1 + k % 130;
        const koksma_keys pixel = koksma_keys_of_4d(seed, k & 255, k >> 8 & 255, k % 5, spp);
        double sobol[4], pmj02[2], white[4], keys[4];
        koksma_sobol_4d(domain, index, sobol);
        koksma_pmj02_2d(domain, index, pmj02);
        koksma_white_4d(domain, index, white);
        koksma_keys_4d(&pixel, index % spp, keys);
        h[0] = (h[0] ^ (uint32_t)domain.key) * 16777619u;
        h[0] = (h[0] ^ (uint32_t)(domain.key >> 32)) * 16777619u;
        h[1] = hashed(h[1], sobol, 4);
        h[2] = hashed(h[2], pmj02, 2);
        h[3] = hashed(h[3], white, 4);
        h[4] = hashed(h[4], keys, 4);
    }
    for (int f = 0; f < FAMILIES; f++) {
        hashes[FAMILIES * block + f] = h[f];
    }
}

static bool failed(cudaError_t error)
{
    if (error != cudaSuccess) {
        std::puts(cudaGetErrorString(error));
    }
    return error != cudaSuccess;
}

static int compare_with_host()
{
    static uint64_t device[(size_t)N * NUMBERS];
    uint64_t *words, host[NUMBERS];
    int different = 0;
    if (failed(cudaMalloc(&words, sizeof device))) {
        return 1;
    }
    draw_all<<<N / 256, 256>>>(words);
    if (failed(cudaGetLastError()) || failed(cudaMemcpy(device, words, sizeof device, cudaMemcpyDeviceToHost))) {
        return 1;
    }
    const int count = draw(0, host);
    for (uint32_t i = 0; i < N; i++) {
        draw(i, host);
        different += std::memcmp(host, device + (size_t)NUMBERS * i, sizeof *host * (size_t)count) != 0;
    }
    std::printf("%d of %d samples of %d words differ from the host's\n", different, (int)N, count);
    return different != 0;
}

static int compare_with_vectors(const char *path)
{
    uint32_t *hashes, ours[BLOCKS * FAMILIES];
    char line[256];
    int rows = 0, different = 0;
    FILE *file = std::fopen(path, "r");
    if (!file) {
        std::perror(path);
        return 1;
    }
    if (failed(cudaMalloc(&hashes, sizeof ours))) {
        return 1;
    }
    hash_blocks<<<BLOCKS, 1>>>(hashes);
    if (failed(cudaGetLastError()) || failed(cudaMemcpy(ours, hashes, sizeof ours, cudaMemcpyDeviceToHost))) {
        return 1;
    }
    while (std::fgets(line, sizeof line, file)) {
        unsigned block, h[FAMILIES];
        if (std::sscanf(line, "%u %x %x %x %x %x", &block, h, h + 1, h + 2, h + 3, h + 4) == 6 && block < BLOCKS) {
            different += std::memcmp(h, ours + FAMILIES * block, sizeof h) != 0;
            rows++;
        }
    }
    std::fclose(file);
    std::printf("%d of %d blocks of vectors differ\n", different, rows);
    return different != 0 || rows != BLOCKS;
}

int main(int count, char **arguments)
{
    int devices = 0;
    if (count != 2) {
        std::puts("usage: sampler VECTORS");
        return 2;
    }
    if (cudaGetDeviceCount(&devices) != cudaSuccess || devices == 0) {
        std::puts("no device");
        return 77;
    }
    const int host = compare_with_host(), vectors = compare_with_vectors(arguments[1]);
    return host | vectors;
}
