// SPDX-License-Identifier: Apache-2.0
// The time that programs of other authors take, as bench-row prints it: processor seconds, the median, least and largest
// of some repeats, no value. bench/speed.py compiles this file once for each program that it finds, with one of
//
//   WITH_QUADS         samplerGF3.cpp of github.com/liris-origami/Quad-Optimized-LDS, the program of Ostromoukhov,
//                      Bonneel, Coeurjolly & Iehl 2024: N points of DIM dimensions, without and with scrambling. Their
//                      matrices are made before the clock starts; AUTHORS_DATA is their file of polynomials
//   WITH_VOID_CLUSTER  generatebn_void_cluster.cpp of github.com/Atrix256/BlueNoiseDitherPatternGeneration: a mask of
//                      SIDE x SIDE pixels
//   WITH_GAUSSIAN      gbn0.h, cut from gbn-toroidal.cu of github.com/Atrix256/GaussianBlueNoise, the program of Ahmed, Ren
//                      & Wonka 2022: N points after 1,000 iterations, as in their example, in float. Their kernel runs for
//                      one point after the other, on one core
//   WITH_CASCADE       SamplerCascadedSobol.hpp of github.com/utk-team/utk, the program of Paulin et al. 2021: N points of
//                      DIM dimensions, scrambled, with the reading of its direction numbers, which it does for each set
//
//     row-authors 1 quads|owen-quads|cascade N DIM
//     row-authors 1 void-cluster SIDE
//     row-authors 1 gaussian N
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <random>
#include <string>
#include <unistd.h>
#include <vector>

static volatile double sink; // what is computed is used

#ifdef WITH_QUADS
#define main main_of_authors
#include "samplerGF3.cpp"
#undef main

static double once(const std::string &mode, int n, int dim)
{
    static std::vector<sobol3_matrix> matrices;
    const bool scrambled = mode == "owen-quads";
    unsigned digits = 1;
    for (int most = 3; most < n; most *= 3) {
        digits++;
    }
    if (matrices.empty()) {
        if (load_mk(AUTHORS_DATA, false) < dim) {
            exit(2);
        }
        for (int d = 1; d <= dim; d++) {
            generate_mkGF3(sobol_aj[d], sobol_sj[d], sobol_mk[d], 3);
            sobol3_matrix c(MATRIX_SZ, std::vector<int>(MATRIX_SZ));
            fill_mx(d, c);
            matrices.push_back(c);
        }
    }
    std::vector<double> points((size_t)n * dim);
    std::vector<integer3> last(dim), index(dim);
    const clock_t start = clock();
    for (int i = 0; i < n; i++) {
        const integer3 here = i;
        for (int d = 0; d < dim; d++) {
            const integer3 x = i ? point3_digits(matrices[d], digits, here, index[d], last[d]) : last[d];
            points[(size_t)i * dim + d] = (scrambled ? scramble_base3(x, 77 + d, digits) : x).value_double(digits);
        }
    }
    const double seconds = double(clock() - start) / CLOCKS_PER_SEC;
    sink = points[points.size() / 2];
    return seconds;
}
#endif

#ifdef WITH_VOID_CLUSTER
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include "generatebn_void_cluster.cpp"

static double once(const std::string &, int side, int)
{
    std::vector<uint8_t> mask;
    const clock_t start = clock();
    GenerateBN_Void_Cluster(mask, (size_t)side, false, "");
    sink = mask[0];
    return double(clock() - start) / CLOCKS_PER_SEC;
}
#endif

#ifdef WITH_GAUSSIAN
typedef float Float;
#define ZERO 0.f
#define HALF 0.5f
#define ONE 1.f
#define expF expf
#define __global__ static inline
struct Vector {
    Float x, y;
};
typedef Vector Point;
static struct {
    int x;
} blockIdx, blockDim, threadIdx;
#include "gbn0.h"

static double once(const std::string &, int n, int)
{
    std::vector<Point> from(n), to(n);
    std::mt19937 random(1);
    std::uniform_real_distribution<float> uniform;
    const clock_t start = clock();
    for (Point &p : from) {
        p = {uniform(random), uniform(random)};
    }
    for (int iteration = 0; iteration < 1000; iteration++) {
        for (int i = 0; i < n; i++) {
            threadIdx.x = i;
            gbn0(n, from.data(), to.data(), -(float)n / 2, 0.25f);
        }
        std::swap(from, to);
    }
    sink = from[0].x;
    return double(clock() - start) / CLOCKS_PER_SEC;
}
#endif

#ifdef WITH_CASCADE
#include <utk/samplers/SamplerCascadedSobol.hpp>

static double once(const std::string &, int n, int dim)
{
    utk::Pointset<double> points;
    utk::SamplerCascadedSobol<uint32_t> sampler(dim);
    sampler.setRandomSeed(1);
    const clock_t start = clock();
    if (!sampler.generateSamples(points, n)) {
        exit(2);
    }
    sink = points[n / 2][0];
    return double(clock() - start) / CLOCKS_PER_SEC;
}
#endif

int main(int argc, char **argv)
{
    const int n = argc > 3 ? atoi(argv[3]) : 0, dim = argc > 4 ? atoi(argv[4]) : 2;
    if (n < 1 || dim < 1) {
        fprintf(stderr, "usage: row-authors 1 quads|owen-quads|cascade|void-cluster|gaussian N [DIM]\n");
        return 2;
    }
    FILE *out = fdopen(dup(1), "w"); // some of the programs print to standard output
    if (!out || !freopen("/dev/null", "w", stdout)) {
        return 2;
    }
    std::vector<double> times;
    for (double sum = 0; times.size() < 5 && (times.empty() || sum < 3); sum += times.back()) {
        times.push_back(once(argv[2], n, dim));
    }
    std::sort(times.begin(), times.end());
    fprintf(out, "%g %g %g nan\n", times[times.size() / 2], times.front(), times.back());
    return fclose(out);
}
