/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The sums over i of product[i] B_2({i z / n}) for all z that are units modulo n, in O(n log n) steps, for any n:
 * the fast component-by-component construction of Nuyens & Cools 2006 (primes) and 2006a (other n).
 *
 * The i with gcd(i, n) = n/m are r n/m, where r is a unit modulo m: they form one block for each divisor m > 1 of n.
 * In a block the sum depends only on z modulo m, and is a correlation over the group of units modulo m, where u and
 * -u are identified because B_2(x) = B_2(1 - x). Fourier transforms are done along all axes of the group except the
 * first. Each line along the first axis is then correlated with a precomputed kernel. A line whose length is a power
 * of two is correlated cyclically; others are padded with zeros. If the first axis is cut (unit_group.h), the kernel is
 * not periodic along it: beyond the length of the axis it repeats with a sign that depends on the line (see sign_of).
 * For small blocks the sums are computed as a product with a matrix.
 *
 * Then value[i] with i = r n/m holds the sum of block m for all z that are r modulo m; the sum of block m/p for the same
 * z is at p i mod n. value[i] += value[p i mod n], for one prime p of n after the other, therefore adds the blocks of all
 * divisors, and value[z] becomes the whole sum for z (i and n - i are the same).
 *
 * The numbers product[i] of a block are called its weights; their mean is subtracted from them. This changes the sums
 * of all z equally and removes most of the rounding error. The rounding error is assumed to be below 256 (1 + log2 m) u
 * |weights| |kernel| / sqrt(count) in 2-norms, u = 2^-53, plus 64 u times the product of the norms before the
 * subtraction / sqrt(count): 20 to 1,200 times the errors measured (65 <= n <= 2^21). The bound is divided by
 * sqrt(count) because errors of a transform spread evenly over its numbers; the bound that Brent, Percival & Zimmermann
 * 2007 prove, without this division, is 10,000 times the errors measured at 2^20 and would leave thousands of z
 * undecided at 2^24. For the few z that this bound leaves undecided, sums in a fixed order decide, so that no bit of a
 * lattice depends on a transform.
 */
#include "patterns/lattices/lattices.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/dft.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"

enum { MATRIX = 32 };

typedef struct block {
    uint64_t m;
    size_t count;   /* number of units modulo m, up to the sign */
    uint32_t *at;   /* the index i of each unit, at most n/2; the exponent of the first axis changes fastest */
    double norm;    /* 2-norm of the kernel */
    double *matrix; /* for small blocks the matrix of count x count numbers; NULL for other blocks, which use the
                       members below */
    koksma__unit_axis axes[KOKSMA__MAX_PRIMES];
    koksma__dft chirps[KOKSMA__MAX_PRIMES]; /* transforms along all axes except axis 0 */
    int n_axes;
    bool cut;
    size_t lines, padded;          /* number of lines, count / length of the first axis; length of the lines'
                                      transforms */
    double *kernel_re, *kernel_im; /* lines x padded */
} block;

struct koksma__unit_sums {
    size_t n;
    uint64_t primes[KOKSMA__MAX_PRIMES];
    int n_primes;
    block *blocks;
    size_t n_blocks;
    koksma__fourier fourier;
    double *re, *im;           /* scratch for the largest block of several lines */
    double *line_re, *line_im; /* scratch for the longest padded line */
};

static double bernoulli(double x)
{
    return x * (x - 1) + 1.0 / 6;
}

/* Returns the number of units modulo m up to the sign: phi(m)/2, at least 1. */
static size_t count_units(const koksma__unit_sums *s, uint64_t m)
{
    uint64_t count = m;
    for (int i = 0; i < s->n_primes; i++) {
        count = m % s->primes[i] ? count : count / s->primes[i] * (s->primes[i] - 1);
    }
    return count < 2 ? 1 : (size_t)count / 2;
}

static koksma_status add_block(koksma__unit_sums *s, uint64_t m)
{
    block *b = koksma__add_one(&s->blocks, &s->n_blocks, sizeof *b);
    KOKSMA__TRY(b ? KOKSMA_OK : KOKSMA_MEMORY);
    *b = (block){.m = m, .count = count_units(s, m)};
    if (b->count > MATRIX) {
        b->n_axes = koksma__unit_axes(m, b->axes, &b->cut);
        const size_t length = b->axes[0].length;
        b->lines = b->count / length;
        b->padded = 1;
        while (b->padded < length) {
            b->padded *= 2;
        }
        b->padded *= b->padded == length && (!b->cut || b->lines == 1) ? 1 : b->padded < 2 * length - 1 ? 2 : 1;
    }
    return KOKSMA_OK;
}

/* Adds a block for each divisor of n above 1, by recursion over the primes of n. */
static koksma_status add_blocks(koksma__unit_sums *s, uint64_t m, int prime)
{
    koksma_status status = KOKSMA_OK;
    if (prime == s->n_primes) {
        return m > 1 ? add_block(s, m) : KOKSMA_OK;
    }
    for (uint64_t power = 1; !status && s->n % (m * power) == 0; power *= s->primes[prime]) {
        status = add_blocks(s, m * power, prime + 1);
    }
    return status;
}

static koksma_status make_room(koksma__unit_sums *s)
{
    size_t longest = 1, padded = 1, several = 0;
    for (size_t i = 0; i < s->n_blocks; i++) {
        const block *b = &s->blocks[i];
        padded = b->padded > padded ? b->padded : padded;
        several = b->lines > 1 && b->count > several ? b->count : several;
        for (int k = 1; k < b->n_axes; k++) {
            const size_t room = koksma__dft_padded(b->axes[k].length);
            longest = room > longest ? room : longest;
        }
    }
    longest = padded > longest ? padded : longest;
    const size_t line = longest > 64 ? longest : 64; /* direct transforms, which sum the definition, use up to 64
                                                        numbers */
    const size_t bytes = 2 * (line + several) * sizeof *s->line_re;
    s->line_re = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(s->line_re, bytes);
    s->line_im = s->line_re + line;
    s->re = s->line_im + line;
    s->im = s->re + several;
    return koksma__fourier_init(&s->fourier, longest);
}

static void list_units(const koksma__unit_sums *s, block *b)
{
    const uint64_t m = b->m, step = s->n / m;
    size_t count = 1;
    b->at[0] = 1;
    if (b->matrix) {
        for (uint64_t r = 2; 2 * r < m; r++) {
            bool unit = true;
            for (int i = 0; i < s->n_primes; i++) {
                unit = unit && (m % s->primes[i] || r % s->primes[i]);
            }
            if (unit) {
                b->at[count++] = (uint32_t)r;
            }
        }
    }
    for (int k = 0; k < b->n_axes; k++) {
        const size_t before = count;
        for (size_t x = 1; x < b->axes[k].length; x++) {
            for (size_t t = 0; t < before; t++, count++) {
                const uint64_t r = b->at[count - before] * b->axes[k].generator % m;
                b->at[count] = (uint32_t)(r < m - r ? r : m - r);
            }
        }
    }
    for (size_t t = 0; t < count; t++) {
        b->at[t] = (uint32_t)(b->at[t] * step);
    }
}

/* Does the forward transforms along all axes except the first. If re and im are exchanged, it computes the inverse
   transform up to a factor. */
static void transform_axes(koksma__unit_sums *s, const block *b, double *re, double *im)
{
    size_t stride = b->axes[0].length;
    for (int k = 1; k < b->n_axes; k++) {
        const size_t length = b->axes[k].length;
        for (size_t high = 0; high < b->count; high += stride * length) {
            for (size_t low = 0; low < stride; low++) {
                koksma__dft_transform(&b->chirps[k], &s->fourier, stride, re + high + low, im + high + low,
                                      s->line_re, s->line_im);
            }
        }
        stride *= length;
    }
}

/* Returns the sign with which the kernel of a line repeats beyond the length of the first axis if this axis is cut.
   There g_0^length_0 is, up to its sign, the product of g_k^(order_k / 2) over the other axes k that have `turns` set
   (unit_group.h), and the sign is the value of the line's character at this product. */
static double sign_of(const block *b, size_t line)
{
    size_t turns = 0;
    for (int k = 1; k < b->n_axes; k++) {
        turns += b->axes[k].turns ? line % b->axes[k].length : 0;
        line /= b->axes[k].length;
    }
    return b->cut && turns % 2 ? -1 : 1;
}

static koksma_status make_kernel(koksma__unit_sums *s, block *b)
{
    const size_t length = b->axes[0].length, room = b->lines * b->padded;
    koksma_status status = KOKSMA_OK;
    for (int k = 1; !status && k < b->n_axes; k++) {
        status = koksma__dft_init(&b->chirps[k], &s->fourier, b->axes[k].length);
    }
    b->kernel_re = status ? NULL : calloc(2 * room, sizeof *b->kernel_re);
    if (!b->kernel_re) {
        return status ? status : koksma__fail_memory(2 * room * sizeof *b->kernel_re);
    }
    b->kernel_im = b->kernel_re + room;
    double *re = b->lines > 1 ? s->re : s->line_re, *im = b->lines > 1 ? s->im : s->line_im;
    for (size_t t = 0; t < b->count; t++) {
        re[t] = bernoulli((double)b->at[t] / (double)s->n);
        im[t] = 0;
    }
    transform_axes(s, b, re, im);
    const double scale = 1 / ((double)b->lines * (double)b->padded);
    for (size_t line = 0; line < b->lines; line++) {
        double *to_re = b->kernel_re + line * b->padded, *to_im = b->kernel_im + line * b->padded;
        double factor = scale;
        for (size_t t = 0; t < b->padded && t < 2 * length - 1; t++) {
            factor = t == length ? factor * sign_of(b, line) : factor;
            to_re[t] = factor * re[line * length + t % length];
            to_im[t] = factor * im[line * length + t % length];
        }
        koksma__fourier_forward(&s->fourier, b->padded, to_re, to_im);
    }
    return KOKSMA_OK;
}

static koksma_status make_block(koksma__unit_sums *s, block *b)
{
    const uint64_t step = s->n / b->m;
    b->at = malloc(b->count * sizeof *b->at);
    b->matrix = b->at && !b->n_axes ? malloc(b->count * b->count * sizeof *b->matrix) : NULL;
    if (!b->at || (!b->n_axes && !b->matrix)) {
        return koksma__fail_memory(b->count * (b->at ? b->count * sizeof *b->matrix : sizeof *b->at));
    }
    list_units(s, b);
    double square = 0;
    for (size_t t = 0; t < b->count; t++) {
        const double x = bernoulli((double)b->at[t] / (double)s->n);
        square += x * x;
    }
    b->norm = sqrt(square);
    for (size_t t = 0; b->matrix && t < b->count * b->count; t++) {
        const uint64_t r = b->at[t / b->count] / step * (b->at[t % b->count] / step) % b->m;
        b->matrix[t] = bernoulli((double)r / (double)b->m);
    }
    return b->matrix ? KOKSMA_OK : make_kernel(s, b);
}

koksma_status koksma__unit_sums_open(size_t n, const koksma_run *run, koksma__unit_sums **sums)
{
    koksma__unit_sums *s = *sums = calloc(1, sizeof *s);
    KOKSMA__REQUIRE_MEMORY(s, sizeof *s);
    s->n = n;
    s->n_primes = koksma__primes_of(n, s->primes);
    koksma_status status = add_blocks(s, 1, 0);
    status = status ? status : make_room(s);
    for (size_t i = 0; !status && i < s->n_blocks; i++) {
        status = koksma__ask(run);
        status = status ? status : make_block(s, &s->blocks[i]);
    }
    return status;
}

void koksma__unit_sums_close(koksma__unit_sums *s)
{
    for (size_t i = 0; s && i < s->n_blocks; i++) {
        block *b = &s->blocks[i];
        KOKSMA__FREE(b->at, b->matrix, b->kernel_re);
        for (int k = 1; k < b->n_axes; k++) {
            koksma__dft_fini(&b->chirps[k]);
        }
    }
    if (s) {
        free(s->blocks);
        free(s->line_re);
        koksma__fourier_fini(&s->fourier);
        free(s);
    }
}

static void correlate_lines(koksma__unit_sums *s, const block *b, double *re, double *im)
{
    const size_t length = b->axes[0].length, padded = b->padded, bytes = length * sizeof *re;
    double *line_re = s->line_re, *line_im = s->line_im;
    transform_axes(s, b, re, im);
    for (size_t line = 0; line < b->lines; line++) {
        const double *kernel_re = b->kernel_re + line * padded, *kernel_im = b->kernel_im + line * padded;
        if (b->lines > 1) {
            memcpy(line_re, re + line * length, bytes);
            memcpy(line_im, im + line * length, bytes);
        }
        memset(line_re + length, 0, (padded - length) * sizeof *re);
        memset(line_im + length, 0, (padded - length) * sizeof *re);
        koksma__fourier_forward(&s->fourier, padded, line_re, line_im);
        for (size_t j = 0; j < padded; j++) { /* multiply the kernel by the conjugate of the line, which gives a
                                                 correlation */
            const double x = line_re[j] * kernel_re[j] + line_im[j] * kernel_im[j];
            line_im[j] = line_re[j] * kernel_im[j] - line_im[j] * kernel_re[j];
            line_re[j] = x;
        }
        koksma__fourier_back(&s->fourier, padded, line_re, line_im);
        if (b->lines > 1) {
            memcpy(re + line * length, line_re, bytes);
            memcpy(im + line * length, line_im, bytes);
        }
    }
    transform_axes(s, b, im, re);
}

/* Computes the part of the sums that comes from one block (see the top): values[i] for each i of the block. Returns
   a bound on the rounding error of these values. */
static double find_block(koksma__unit_sums *s, const block *b, const double *product, double *values)
{
    double weights[MATRIX];
    double *re = b->matrix ? weights : b->lines > 1 ? s->re : s->line_re, *im = b->lines > 1 ? s->im : s->line_im;
    double mean = 0, square = 0, whole = 0;
    for (size_t t = 0; t < b->count; t++) {
        re[t] = product[b->at[t]];
        mean += re[t];
        whole += re[t] * re[t];
    }
    mean /= (double)b->count;
    for (size_t t = 0; t < b->count; t++) {
        re[t] -= mean;
        square += re[t] * re[t];
    }
    if (b->matrix) {
        for (size_t t = 0; t < b->count; t++) {
            double sum = 0;
            for (size_t u = 0; u < b->count; u++) {
                sum += b->matrix[t * b->count + u] * weights[u];
            }
            values[b->at[t]] = sum;
        }
    } else {
        memset(im, 0, b->count * sizeof *im);
        correlate_lines(s, b, re, im);
        for (size_t t = 0; t < b->count; t++) {
            values[b->at[t]] = re[t];
        }
    }
    return DBL_EPSILON / 2 * b->norm / sqrt((double)b->count) *
           (256 * (1 + koksma__log2((double)b->m)) * sqrt(square) + 64 * sqrt(whole));
}

/* Adds the sums of the blocks over the divisors of n, one prime after the other. For each prime, the i that are
   divisible by its highest power come first. */
static void add_up(const koksma__unit_sums *s, double *values)
{
    const size_t n = s->n;
    values[0] = 0;
    for (int k = 0; k < s->n_primes; k++) {
        const size_t p = (size_t)s->primes[k];
        size_t step = 1;
        while (n % (step * p) == 0) {
            step *= p;
        }
        for (step /= p; step; step /= p) {
            for (size_t i = step, from = step * p % n, rank = 1; i <= n / 2; i += step, rank++) {
                if (rank % p) {
                    values[i] += values[from < n - from ? from : n - from];
                }
                from += step * p;
                from -= from >= n ? n : 0;
            }
        }
    }
    for (int k = 0; k < s->n_primes; k++) {
        for (size_t i = 0; i <= n / 2; i += (size_t)s->primes[k]) {
            values[i] = INFINITY;
        }
    }
}

koksma_status koksma__unit_sums_find(koksma__unit_sums *s, const koksma_run *run, const double *product,
                                     double *values, double *error)
{
    *error = 0;
    for (size_t i = 0; i < s->n_blocks; i++) {
        KOKSMA__TRY(koksma__ask(run));
        *error += find_block(s, &s->blocks[i], product, values);
    }
    add_up(s, values);
    return KOKSMA_OK;
}
