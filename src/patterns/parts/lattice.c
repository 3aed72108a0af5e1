/* SPDX-License-Identifier: Apache-2.0 */
#include "patterns/parts/lattice.h"

#include <math.h>

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

static double kernel(uint64_t numerator, size_t n)
{
    const double x = (double)numerator / (double)n;
    return 1 + 2 * M_PI * M_PI * (x * (x - 1) + 1.0 / 6);
}

double koksma__lattice_error(size_t n, uint64_t z, const double *product)
{
    double sum = 0;
    uint64_t numerator = 0;
    for (size_t i = 0; i < n; i++) {
        sum += product[i] * kernel(numerator, n);
        numerator += z;
        numerator -= numerator >= n ? n : 0;
    }
    return sum / (double)n - 1;
}

void koksma__lattice_extend(size_t n, uint64_t z, double *product)
{
    uint64_t numerator = 0;
    for (size_t i = 0; i < n; i++) {
        product[i] *= kernel(numerator, n);
        numerator += z;
        numerator -= numerator >= n ? n : 0;
    }
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

uint64_t koksma__lattice_candidate(size_t n, size_t c)
{
    const size_t half = n / 2 ? n / 2 : 1; /* z and n - z give mirrored sets */
    const size_t most = n <= ALL ? half : WORK / n < 16 ? 16 : WORK / n;
    if (c >= most || c >= half) {
        return 0;
    }
    uint64_t z = n <= ALL ? c + 1 : 1 + (uint64_t)((double)half * fmod((double)(c + 1) * 0.6180339887498949, 1));
    while (common_divisor(z, n) != 1) {
        z++;
    }
    return z;
}
