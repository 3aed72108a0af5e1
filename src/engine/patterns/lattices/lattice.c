/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rank-1 lattices and the search for their multipliers, component by component (Sloan & Reztsov 2002). The sums for
 * all candidates at once are a convolution over the group of units (unit_sums.c, after Nuyens & Cools 2006), O(n log
 * n). These sums have rounding errors; candidates whose sums are within the error bound of the least are summed again
 * in a fixed order, and among equal candidates the smallest is chosen.
 */
#include "patterns/lattices/lattices.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "patterns/nets/nets.h"

typedef double candidate_sum(const koksma__lattice_search *s, uint64_t z);

typedef struct job {
    uint64_t n;
    const uint64_t *z;
} job;

/* a b modulo n < 2^52, a and b below n. */
static uint64_t product_modulo(uint64_t a, uint64_t b, uint64_t n)
{
    uint64_t sum = 0;
    for (; a; a >>= 1, b = 2 * b % n) {
        sum = a & 1 ? (sum + b) % n : sum;
    }
    return sum;
}

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const job *j = context;
    const uint64_t z = j->z[k];
    uint64_t numerator = product_modulo(first, z, j->n);
    for (size_t i = 0; i < count; i++) {
        xs[i] = (double)(int64_t)numerator / (double)j->n;
        numerator += z;
        numerator -= numerator >= j->n ? j->n : 0;
    }
}

koksma_status koksma__range_lattice(const koksma_args *args, const uint64_t *z, koksma_points *out)
{
    const job j = {args->n, z};
    return koksma__range_columns(args, out, column, &j);
}

koksma_status koksma__fill_lattice(const koksma_run *run, const uint64_t *z, koksma_points *out)
{
    return koksma__range_lattice(&(koksma_args){.run = run, .n = out->n}, z, out);
}

static double bernoulli(uint64_t numerator, size_t n)
{
    const double x = (double)numerator / (double)n;
    return x * (x - 1) + 1.0 / 6;
}

void koksma__lattice_units(koksma__lattice_search *s)
{
    uint64_t primes[KOKSMA__MAX_PRIMES];
    const int count = koksma__primes_of(s->n, primes);
    for (size_t z = 0; z <= s->n / 2; z++) {
        s->values[z] = 0;
    }
    for (int k = 0; k < count; k++) {
        for (size_t z = 0; z <= s->n / 2; z += (size_t)primes[k]) {
            s->values[z] = INFINITY;
        }
    }
}

koksma_status koksma__lattice_open(koksma__lattice_search *s, size_t n, const koksma_run *run)
{
    s->n = n;
    s->run = run;
    s->sums = NULL;
    s->product = s->few;
    if (n > KOKSMA__LATTICE_FEW) {
        const size_t bytes = (n + n / 2 + 1) * sizeof *s->product;
        s->product = malloc(bytes);
        KOKSMA__REQUIRE_MEMORY(s->product, bytes);
    }
    s->values = s->product + n;
    if (n <= KOKSMA__LATTICE_FEW) {
        koksma__lattice_units(s);
        for (size_t i = 0; i < n; i++) {
            s->kernel[i] = bernoulli(i, n);
        }
    }
    return KOKSMA_OK;
}

void koksma__lattice_close(koksma__lattice_search *s)
{
    if (s->product != s->few) {
        free(s->product);
    }
    koksma__unit_sums_close(s->sums);
}

/* (numerator + z) mod n, both below n */
static uint64_t next(uint64_t numerator, uint64_t z, size_t n)
{
    return numerator + z - (numerator + z >= n ? n : 0);
}

/* Returns the amount that another coordinate with the multiplier z would add to the minimised sum, up to a constant
   factor. */
static double added_sum(const koksma__lattice_search *s, uint64_t z)
{
    double sum = 0;
    uint64_t numerator = 0;
    for (size_t i = 1; i <= s->n / 2; i++) {
        numerator = next(numerator, z, s->n);
        sum += s->product[i] * bernoulli(numerator, s->n);
    }
    return sum;
}

static double added_sum_of_few(const koksma__lattice_search *s, uint64_t z)
{
    double sum = 0;
    uint64_t numerator = 0;
    for (size_t i = 1; i <= s->n / 2; i++) {
        numerator = next(numerator, z, s->n);
        sum += s->product[i] * s->kernel[numerator];
    }
    return sum;
}

void koksma__lattice_start(koksma__lattice_search *s)
{
    for (size_t i = 1; i <= s->n / 2; i++) {
        s->product[i] = 2 * i == s->n ? 0.5 : 1; /* i and n - i have the same terms; n/2 is its own partner */
    }
}

double koksma__lattice_extend(koksma__lattice_search *s, uint64_t z)
{
    double sum = 0;
    uint64_t numerator = 0;
    for (size_t i = 1; i <= s->n / 2; i++) {
        numerator = next(numerator, z, s->n);
        const double term = bernoulli(numerator, s->n);
        sum += s->product[i] * term;
        s->product[i] *= 1 + 0.75 * term;
    }
    return sum;
}

/* Appends a coordinate in a search with finite-order weights. `sums` are (n/2 + 1) * order numbers; those of point i,
   the symmetric polynomials of its terms by degree, begin at i * order. */
static void extend_orders(koksma__lattice_search *s, uint64_t z, int order, const double *factors, double *sums)
{
    uint64_t numerator = 0;
    for (size_t i = 1; i <= s->n / 2; i++) {
        double *of = sums + i * (size_t)order, all = 0;
        numerator = next(numerator, z, s->n);
        const double term = 0.75 * bernoulli(numerator, s->n);
        for (int l = order - 1; l > 0; l--) {
            of[l] += term * of[l - 1];
            all += factors[l] * of[l];
        }
        s->product[i] = all + of[0];
    }
}

koksma_status koksma__lattice_value(koksma__lattice_search *s, double *window)
{
    *window = 0;
    if (s->n <= KOKSMA__LATTICE_FEW) {
        return KOKSMA_OK;
    }
    koksma_status status = s->sums ? KOKSMA_OK : koksma__unit_sums_open(s->n, s->run, &s->sums);
    status = status ? status : koksma__unit_sums_find(s->sums, s->run, s->product, s->values, window);
    *window *= 2;
    return status;
}

static koksma_status choose(const koksma__lattice_search *s, double window, candidate_sum sum, uint64_t *best)
{
    double lowest = s->values[1], least = 0;
    *best = 0;
    for (size_t z = 2; z <= s->n / 2; z++) {
        lowest = s->values[z] < lowest ? s->values[z] : lowest;
    }
    for (size_t z = 1; z <= koksma__lattice_last(s->n); z++) {
        if (!(s->values[z < s->n - z ? z : s->n - z] <= lowest + window)) {
            continue;
        }
        KOKSMA__TRY(koksma__ask(s->run));
        const double value = sum(s, z);
        if (*best == 0 || value < least) {
            least = value;
            *best = z;
        }
    }
    return KOKSMA_OK;
}

/* Finds the z that adds least to the sum: candidates within the window above the least value are compared by sums in
   order of i; among equal sums the smallest z is taken. */
static koksma_status find_best(koksma__lattice_search *s, uint64_t *best)
{
    double window;
    const koksma_status status = koksma__lattice_value(s, &window);
    return status ? status : choose(s, window, s->n > KOKSMA__LATTICE_FEW ? added_sum : added_sum_of_few, best);
}

/* Finds all multipliers. `sums` are those of extend_orders, all 0; NULL if all projections count. */
static koksma_status find_all(koksma__lattice_search *s, int dim, int order, const double *factors, double *sums,
                              double share, uint64_t *z)
{
    z[0] = 1;
    koksma_status status = dim > 1 ? koksma__lattice_second(s->run, s->n, &z[1]) : KOKSMA_OK;
    if (status || dim <= 2) {
        return status;
    }
    koksma__lattice_start(s);
    for (size_t i = 1; sums && i <= s->n / 2; i++) {
        sums[i * (size_t)order] = s->product[i];
    }
    for (int k = 0; !status && k < dim; k++) {
        if (!koksma__keep_going(s->run, share * k / dim)) {
            return koksma__fail_interrupted();
        }
        if (k > 1) {
            status = find_best(s, &z[k]);
        }
        if (!status && k < dim - 1) {
            if (sums) {
                extend_orders(s, z[k], order, factors, sums);
            } else {
                koksma__lattice_extend(s, z[k]);
            }
        }
    }
    return status;
}

koksma_status koksma__lattice_find(const koksma_run *run, size_t n, int dim, int order, const double *factors,
                                   double share, uint64_t *z)
{
    koksma__lattice_search search;
    const size_t count = (n / 2 + 1) * (size_t)order;
    double *sums = order ? calloc(count, sizeof *sums) : NULL;
    koksma_status status = order && !sums ? koksma__fail_memory(count * sizeof *sums) : KOKSMA_OK;
    if (!status) {
        status = koksma__lattice_open(&search, n, run);
        status = status ? status : find_all(&search, dim, order, factors, sums, share, z);
        koksma__lattice_close(&search);
    }
    free(sums);
    return status;
}
