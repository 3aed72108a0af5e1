/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Samples per second on a CUDA device: functions of sampler.h and keys.h beside OpenQMC's samplers and cuRAND's device
 * functions, in one run.
 *
 *     nvcc -std=c++17 -O3 -Iinclude bench/bench_cuda.cu -lcurand -o bench_cuda && ./bench_cuda
 *
 * With -DWITH_OPENQMC -I$OPENQMC/include there are OpenQMC's rows, too. Each thread is one pixel: it draws SAMPLES samples for
 * each of USES uses and keeps the sum of their coordinates, so that nothing is optimised away and memory plays no part. Keys
 * of domains, and the initialisation of cuRAND's generators, are in the time, as a renderer pays them. The time is the least
 * of TURNS turns by the device's events.
 */
#include <koksma/keys.h>
#include <koksma/sampler.h>

#include <cstdio>
#include <cstdlib>
#include <curand_kernel.h>
#ifdef WITH_OPENQMC
#include <oqmc/oqmc.h>
#endif

enum { WIDTH = 2048, PIXELS = WIDTH * WIDTH, SAMPLES = 16, USES = 4, DIMENSIONS = 2 * USES, TURNS = 9 };

__device__ static curandDirectionVectors32_t directions[DIMENSIONS];
__device__ static unsigned constants[DIMENSIONS];

template <class Number, int dim, void draw(koksma_domain, uint32_t, Number *)> struct ours {
    __device__ static float sum_of_pixel(uint32_t x, uint32_t y)
    {
        const koksma_domain pixel = koksma_domain_of_pixel(0, x, y);
        float sum = 0;
        for (uint32_t i = 0; i < SAMPLES; i++) {
            for (uint32_t use = 0; use < USES; use++) {
                Number xs[dim];
                draw(koksma_domain_of_use(pixel, use), i, xs);
                for (int k = 0; k < dim; k++) {
                    sum += (float)xs[k];
                }
            }
        }
        return sum;
    }
};

/* Keys are computed once for all samples of a pixel, as keys.h advises. */
struct by_keys {
    __device__ static float sum_of_pixel(uint32_t x, uint32_t y)
    {
        float sum = 0;
        for (uint32_t use = 0; use < USES; use++) {
            const koksma_keys keys = koksma_keys_of(0, x, y, use, SAMPLES);
            for (uint32_t i = 0; i < SAMPLES; i++) {
                float xy[2];
                koksma_keys_2f(&keys, i, xy);
                sum += xy[0] + xy[1];
            }
        }
        return sum;
    }
};

#ifdef WITH_OPENQMC
template <class Sampler, int dim> struct theirs {
    __device__ static float sum_of_pixel(uint32_t x, uint32_t y)
    {
        float sum = 0;
        for (int i = 0; i < SAMPLES; i++) {
            const Sampler pixel((int)x, (int)y, 0, i, nullptr);
            for (int use = 0; use < USES; use++) {
                float xs[dim];
                pixel.newDomain(use).template drawSample<dim>(xs);
                for (int k = 0; k < dim; k++) {
                    sum += xs[k];
                }
            }
        }
        return sum;
    }
};
#endif

struct philox {
    __device__ static float sum_of_pixel(uint32_t x, uint32_t y)
    {
        curandStatePhilox4_32_10_t state;
        float sum = 0;
        curand_init(0, (unsigned long long)y * WIDTH + x, 0, &state);
        for (int i = 0; i < SAMPLES * USES; i++) {
            sum += curand_uniform(&state) + curand_uniform(&state);
        }
        return sum;
    }
};

/* One scrambled sequence for the image: pixel p has its samples SAMPLES p to SAMPLES p + SAMPLES - 1. */
struct scrambled_sobol {
    __device__ static float sum_of_pixel(uint32_t x, uint32_t y)
    {
        float sum = 0;
        for (int k = 0; k < DIMENSIONS; k++) {
            curandStateScrambledSobol32_t state;
            curand_init(directions[k], constants[k], (y * WIDTH + x) * SAMPLES, &state);
            for (int i = 0; i < SAMPLES; i++) {
                sum += curand_uniform(&state);
            }
        }
        return sum;
    }
};

template <class Sampler> __global__ static void sum_all(float *sums)
{
    const uint32_t p = blockIdx.x * blockDim.x + threadIdx.x;
    sums[p] = Sampler::sum_of_pixel(p % WIDTH, p / WIDTH);
}

static void check(cudaError_t error)
{
    if (error != cudaSuccess) {
        std::fprintf(stderr, "bench_cuda: %s\n", cudaGetErrorString(error));
        std::exit(1);
    }
}

template <class Sampler> static void print_speed(const char *name, float *sums)
{
    cudaEvent_t begin, end;
    float least = 0;
    check(cudaEventCreate(&begin));
    check(cudaEventCreate(&end));
    for (int turn = 0; turn < TURNS; turn++) {
        float ms;
        check(cudaEventRecord(begin));
        sum_all<Sampler><<<PIXELS / 256, 256>>>(sums);
        check(cudaEventRecord(end));
        check(cudaEventSynchronize(end));
        check(cudaEventElapsedTime(&ms, begin, end));
        least = turn == 0 || ms < least ? ms : least;
    }
    std::printf("%-30s %7.3f ms  %7.1f 10^9 samples/s\n", name, least, 1e-6 * PIXELS * USES * SAMPLES / least);
}

static void load_tables_of_curand()
{
    curandDirectionVectors32_t *vectors;
    unsigned *offsets;
    if (curandGetDirectionVectors32(&vectors, CURAND_SCRAMBLED_DIRECTION_VECTORS_32_JOEKUO6) !=
            CURAND_STATUS_SUCCESS ||
        curandGetScrambleConstants32(&offsets) != CURAND_STATUS_SUCCESS) {
        std::fprintf(stderr, "bench_cuda: cuRAND has no tables of Sobol' numbers\n");
        std::exit(1);
    }
    check(cudaMemcpyToSymbol(directions, vectors, sizeof directions));
    check(cudaMemcpyToSymbol(constants, offsets, sizeof constants));
}

int main()
{
    cudaDeviceProp device;
    float *sums;
    check(cudaGetDeviceProperties(&device, 0));
    check(cudaMalloc(&sums, PIXELS * sizeof *sums));
    load_tables_of_curand();
    std::printf("%s, %d x %d pixels, %d uses, %d samples\n", device.name, (int)WIDTH, (int)WIDTH, (int)USES,
                (int)SAMPLES);
    print_speed<ours<float, 2, koksma_sobol_2f>>("koksma_sobol_2f", sums);
    print_speed<ours<float, 4, koksma_sobol_4f>>("koksma_sobol_4f", sums);
    print_speed<ours<double, 2, koksma_pmj02_2d>>("koksma_pmj02_2d", sums);
    print_speed<by_keys>("koksma_keys_2f", sums);
    print_speed<ours<float, 4, koksma_white_4f>>("koksma_white_4f", sums);
#ifdef WITH_OPENQMC
    print_speed<theirs<oqmc::SobolSampler, 2>>("OpenQMC SobolSampler, 2D", sums);
    print_speed<theirs<oqmc::SobolSampler, 4>>("OpenQMC SobolSampler, 4D", sums);
#endif
    print_speed<scrambled_sobol>("cuRAND scrambled Sobol', 2D", sums);
    print_speed<philox>("cuRAND Philox4x32-10, 2D", sums);
    check(cudaFree(sums));
    return 0;
}
