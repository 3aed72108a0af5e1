// SPDX-License-Identifier: Apache-2.0
// Helmer's stochastic generation as bench_row.c calls it; of the sources that HELMER names
// (https://github.com/Andrew-Helmer/stochastic-generation).
#include <cstring>

#include "sampling/ssobol.h"

extern "C" void helmer_points(const char *name, int n, int dim, double *xs)
{
    if (strcmp(name, "owen") == 0) {
        sampling::GetStochasticSobolSamples(n, dim, false, 1, false, xs);
    } else {
        sampling::GetPMJ02Samples(n, dim, false, 1, false, xs);
    }
}
