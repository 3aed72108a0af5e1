// SPDX-License-Identifier: Apache-2.0
// The time of weighted sample elimination on the torus by Yuksel's own program, beside the pattern sample-elimination:
// processor seconds for N points of 5 N candidates in DIM dimensions, candidates included, as bench-row prints them
// (median, least and largest of five, no value). bench/speed.py compiles it where CYCODEBASE names the folder of
// cySampleElim.h (github.com/cemyuksel/cyCodeBase).
//
//     row-elimination 1 elimination N DIM
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <random>
#include <vector>

#include "cySampleElim.h"
#include "cyVector.h"

template <int DIM> static double seconds(size_t n)
{
    typedef cy::Vec<double, DIM> point;
    std::vector<point> candidates(5 * n), kept(n);
    std::mt19937_64 generator(1);
    std::uniform_real_distribution<double> uniform;
    const clock_t start = clock();
    for (point &p : candidates) {
        for (int k = 0; k < DIM; k++) {
            p[k] = uniform(generator);
        }
    }
    cy::WeightedSampleElimination<point, double, DIM> elimination;
    elimination.SetTiling(true);
    elimination.Eliminate(candidates.data(), candidates.size(), kept.data(), n);
    return double(clock() - start) / CLOCKS_PER_SEC;
}

int main(int argc, char **argv)
{
    const size_t n = argc == 5 ? strtoul(argv[3], nullptr, 10) : 0;
    const int dim = argc == 5 ? atoi(argv[4]) : 0;
    if (n == 0 || dim < 2 || dim > 4) {
        fprintf(stderr, "usage: row-elimination 1 elimination N DIM, DIM 2 to 4\n");
        return 2;
    }
    std::vector<double> times;
    for (int i = 0; i < 5; i++) {
        times.push_back(dim == 2 ? seconds<2>(n) : dim == 3 ? seconds<3>(n) : seconds<4>(n));
    }
    std::sort(times.begin(), times.end());
    printf("%g %g %g nan\n", times[2], times[0], times[4]);
    return 0;
}
