/* SPDX-License-Identifier: Apache-2.0 */
/* sampler.h as CUDA: the bits on the device are those on the host (with -fmad=false: no product is fused with a sum).
   Exit code 77: it compiles, and there is no device to run it on. */
#include <koksma/sampler.h>

#include <cstdio>
#include <cstring>

enum { N = 1 << 16, NUMBERS = 13 };

__host__ __device__ static void draw(uint32_t i, double *xs)
{
    const koksma_domain pixel = koksma_domain_of_pixel(1, i % 256, i / 256), use = koksma_domain_of_use(pixel, i % 5);
    koksma_sobol_2d(use, i, xs);
    koksma_sobol_4d(use, i, xs + 2);
    koksma_pmj02_2d(use, i, xs + 6);
    koksma_cmj_2d(use, i % 60, 5, 12, xs + 8);
    koksma_r_2d(use, i, xs + 10);
    xs[12] = koksma_z_rank(use, i % 256, i / 256, 8);
}

__global__ static void draw_all(double *xs)
{
    const uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
    if (i < N) {
        draw(i, xs + (size_t)NUMBERS * i);
    }
}

int main()
{
    static double device[N * NUMBERS];
    double *xs;
    if (cudaMalloc(&xs, sizeof device) != cudaSuccess) {
        std::puts("no device");
        return 77;
    }
    draw_all<<<N / 256, 256>>>(xs);
    if (cudaMemcpy(device, xs, sizeof device, cudaMemcpyDeviceToHost) != cudaSuccess) {
        std::puts(cudaGetErrorString(cudaGetLastError()));
        return 1;
    }
    size_t different = 0;
    for (uint32_t i = 0; i < N; i++) {
        double host[NUMBERS];
        draw(i, host);
        different += std::memcmp(host, device + (size_t)NUMBERS * i, sizeof host) != 0;
    }
    std::printf("%zu of %d samples differ\n", different, (int)N);
    return different != 0;
}
