/* SPDX-License-Identifier: Apache-2.0 */
#include "patterns/parts/lattice.h"

#include <math.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/parts/columns.h"

enum { ALL = 2048, WORK = 1 << 22 };

typedef struct job {
    uint64_t n;
    const uint64_t *z;
} job;

static void column(const void *context, int k, size_t first, size_t count, double *xs)
{
    const job *j = context;
    const uint64_t z = j->z[k];
    uint64_t numerator = first * z % j->n; /* below 2^56 */
    for (size_t i = 0; i < count; i++) {
        xs[i] = (double)(int64_t)numerator / (double)j->n;
        numerator += z;
        numerator -= numerator >= j->n ? j->n : 0;
    }
}

koksma_status koksma__fill_lattice(const koksma_run *run, const uint64_t *z, koksma_points *out)
{
    const job j = {out->n, z};
    return koksma__fill_columns(run, out, column, &j);
}

static double bernoulli(uint64_t numerator, size_t n)
{
    const double x = (double)numerator / (double)n;
    return x * (x - 1) + 1.0 / 6;
}

/* (numerator + z) mod n, both below n */
static uint64_t next(uint64_t numerator, uint64_t z, size_t n)
{
    return numerator + z - (numerator + z >= n ? n : 0);
}

static double planar_kernel(uint64_t numerator, size_t n)
{
    return 1 + 2 * M_PI * M_PI * bernoulli(numerator, n);
}

/* A multiplier ties with its inverse, which swaps the axes, and now and then with others: which of them is taken
   hangs on the last bit, so the order of these sums is part of the points. */
koksma_status koksma__lattice_second(size_t n, const koksma_run *run, double *scratch, uint64_t *best)
{
    uint64_t z;
    double least = 0;
    for (size_t i = 0; i < n; i++) {
        scratch[i] = planar_kernel(i, n);
    }
    for (size_t c = 0; c < koksma__lattice_tries(n) && (z = koksma__lattice_candidate(n, c)); c++) {
        if (n > 4096 && !koksma__keep_going(run, 0)) {
            return koksma__fail_interrupted();
        }
        double sum = 0;
        uint64_t numerator = 0;
        for (size_t i = 0; i < n; i++) {
            sum += scratch[i] * planar_kernel(numerator, n);
            numerator = next(numerator, z, n);
        }
        sum = sum / (double)n - 1;
        if (c == 0 || sum < least) {
            least = sum;
            *best = z;
        }
    }
    return KOKSMA_OK;
}

void koksma__lattice_start(size_t n, double *product)
{
    for (size_t i = 1; i <= n / 2; i++) {
        product[i] = 2 * i == n ? 0.5 : 1; /* i and n - i have the same terms; n/2 is its own partner */
    }
}

double koksma__lattice_added(size_t n, uint64_t z, const double *product)
{
    double sum = 0;
    uint64_t numerator = 0;
    for (size_t i = 1; i <= n / 2; i++) {
        numerator = next(numerator, z, n);
        sum += product[i] * bernoulli(numerator, n);
    }
    return sum;
}

double koksma__lattice_extend(size_t n, uint64_t z, double *product)
{
    double sum = 0;
    uint64_t numerator = 0;
    for (size_t i = 1; i <= n / 2; i++) {
        numerator = next(numerator, z, n);
        const double term = bernoulli(numerator, n);
        sum += product[i] * term;
        product[i] *= 1 + 0.75 * term;
    }
    return sum;
}

static uint64_t common_divisor(uint64_t a, uint64_t b)
{
    while (b) {
        const uint64_t rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

size_t koksma__lattice_tries(size_t n)
{
    return n <= ALL ? n : WORK / n < 16 ? 16 : WORK / n;
}

uint64_t koksma__lattice_candidate(size_t n, size_t c)
{
    const size_t half = n / 2 ? n / 2 : 1; /* z and n - z give mirrored sets */
    if (c >= half) {
        return 0;
    }
    uint64_t z = n <= ALL ? c + 1 : 1 + (uint64_t)((double)half * fmod((double)(c + 1) * 0.6180339887498949, 1));
    while (common_divisor(z, n) != 1) {
        z++;
    }
    return z;
}
