/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Owen's nested uniform scrambling of radical inverses, exact, by stochastic generation (Helmer, Christensen &
 * Kensler 2021). Point r < b^j and its relatives r + d b^j, 0 < d < b, agree in the first j output digits. Digit j of
 * point r is known from its random fraction; the digits j of its relatives are drawn without replacement from the
 * other b - 1 digits, and the digits below are uniform. Coordinates are multiples of b^-M, where b^M is the largest
 * power of b up to 2^53; in base 2 multiples of 2^-32.
 *
 * All columns except the first are stored in the memory of the output points: each block of points contains its
 * coordinates column by column, until the columns are transposed into rows. Before a number is computed, its memory
 * contains two random words.
 */
#include "patterns/nets/nets.h"

#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/platform/system.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"

enum { FEW = 256, MANY = 4096, MAX_BASE = 38880, SMALL_BASE = 13, BLOCK_NUMBERS = 1 << 14 };

typedef struct job {
    uint64_t seed;
    koksma_points *out;
    size_t block; /* number of points in a block (the last block may be smaller): a power of two, at least 2, because
                     the words of two numbers are drawn at once */
    uint32_t *binary; /* the coordinates in base 2, times 2^32 */
} job;

typedef struct column {
    const job *job;
    int k;
    uint32_t base;
    uint16_t *order, *picked;
} column;

/* Returns the number of points in the block that begins at point `start`. */
static size_t block_of(const job *j, size_t start)
{
    return j->out->n - start < j->block ? j->out->n - start : j->block;
}

/* Returns the address of number i of column k. *left receives the number of contiguous numbers from this address on.
   */
static double *find(const job *j, int k, size_t i, size_t *left)
{
    const size_t within = i & (j->block - 1), start = i - within, count = block_of(j, start);
    *left = count - within;
    return j->out->xs + start * (size_t)j->out->dim + (size_t)k * count + within;
}

static double *number(const column *c, size_t i)
{
    size_t left;
    return find(c->job, c->k, i, &left);
}

/* Returns floor(x) for x >= 0. Without SSE 4.1 the library function floor would be a function call. */
static inline double whole_part(double x)
{
    return (double)(int64_t)x;
}

static inline double below(double width, uint32_t word)
{
    return whole_part(width * (word * 0x1p-32));
}

/* Computes the relatives r + step, r + 2 step, … of point r, which differ from it first in the digit of value `width`.
   The floor of a quotient of whole numbers below 2^53 is exact. */
static void place_relatives(const column *c, size_t r, size_t step, double width)
{
    const double upper = whole_part(*number(c, r) / width), prefix = whole_part(upper / c->base) * c->base;
    const uint32_t own = (uint32_t)(upper - prefix);
    uint32_t d = 1;
    c->order[own] = 0;
    c->order[0] = (uint16_t)own;
    for (size_t i = r + step; d < c->base && i < c->job->out->n; i += step, d++) {
        double *v = number(c, i);
        uint32_t word[2];
        memcpy(word, v, sizeof word);
        const uint32_t pick = d + koksma__below(word[0], c->base - d);
        const uint16_t digit = c->order[pick];
        c->order[pick] = c->order[d];
        c->order[d] = digit;
        c->picked[d] = (uint16_t)pick;
        *v = (prefix + digit) * width + below(width, word[1]);
    }
    while (--d) {
        const uint16_t digit = c->order[d];
        c->order[d] = c->order[c->picked[d]];
        c->order[c->picked[d]] = digit;
    }
    c->order[0] = 0;
    c->order[own] = (uint16_t)own;
}

/* Computes, in small bases, the relatives of points first .. end - 1, which all have the same number of relatives;
   handles at a time as many points as are contiguous and have contiguous relatives. Base 3 is drawn differently: the
   other two digits come in cyclic order or in the opposite order. */
static void place_alike(const column *c, uint32_t relatives, size_t first, size_t end, size_t step, double width)
{
    while (first < end) {
        size_t count;
        double *v[SMALL_BASE];
        const double *own = find(c->job, c->k, first, &count);
        count = count < end - first ? count : end - first;
        for (uint32_t d = 0; d < relatives; d++) {
            size_t left;
            v[d] = find(c->job, c->k, first + (d + 1) * step, &left);
            count = left < count ? left : count;
        }
        koksma__kernels()->nested_digits(c->base, relatives, count, width, own, v);
        first += count;
    }
}

static void place_level(const column *c, size_t step, double width)
{
    const size_t n = c->job->out->n;
    size_t first = 0;
    for (uint32_t relatives = c->base - 1; relatives && c->base <= SMALL_BASE; relatives--) {
        const size_t left = n > relatives * step ? n - relatives * step : 0, end = left < step ? left : step;
        place_alike(c, relatives, first, end, step, width);
        first = end > first ? end : first;
    }
    for (size_t r = 0; r < (n - step < step ? n - step : step) && c->base > SMALL_BASE; r++) {
        place_relatives(c, r, step, width);
    }
}

/* Returns the largest power of the base that is at most 2^53. */
static double whole_of(uint32_t base)
{
    double whole = base;
    while (whole * base <= 0x1p53) {
        whole *= base;
    }
    return whole;
}

static void place_all(const column *c)
{
    const double whole = whole_of(c->base);
    double *v = number(c, 0);
    uint32_t word[2];
    memcpy(word, v, sizeof word);
    for (uint32_t a = 0; a < c->base; a++) {
        c->order[a] = (uint16_t)a;
    }
    *v = below(whole, word[0]) + word[1] % c->base;
    *v -= *v >= whole ? whole : 0;
    double width = whole;
    for (size_t step = 1; step < c->job->out->n; step *= c->base) {
        width /= c->base;
        place_level(c, step, width);
    }
}

/* Draws two random words for each number of column k. Words are drawn four at a time, for two numbers; a last single
   number uses only two of them. */
static void draw(const job *j, int k)
{
    const koksma__kernel_table *kernels = koksma__kernels();
    for (size_t start = 0; start < j->out->n; start += j->block) {
        size_t count;
        double *v = find(j, k, start, &count);
        kernels->words(j->seed, KOKSMA__PURPOSE_SCRAMBLE, start / 2, (uint32_t)k, count / 2, (uint32_t *)v);
        if (count % 2) {
            uint32_t word[4];
            kernels->words(j->seed, KOKSMA__PURPOSE_SCRAMBLE, (start + count) / 2, (uint32_t)k, 1, word);
            memcpy(v + count - 1, word, sizeof *v);
        }
    }
}

/* Fills column k. Base 2 uses koksma__grow_column, because the van der Corput sequence is the digital sequence whose
   matrix is the identity. */
static koksma_status fill(void *context, size_t k)
{
    const job *j = context;
    if (k == 0) {
        const uint32_t partners[32] = {0};
        const koksma_run one = {.threads = 1};
        return koksma__grow_column(j->seed, KOKSMA__PURPOSE_SCRAMBLE, partners, &one, j->out->n, j->binary);
    }
    uint16_t order[MAX_BASE], picked[MAX_BASE];
    draw(j, (int)k);
    place_all(&(column){j, (int)k, koksma__prime((int)k), order, picked});
    return KOKSMA_OK;
}

/* Transposes the columns of a block into rows. */
static koksma_status turn(void *context, size_t block)
{
    const job *j = context;
    const int dim = j->out->dim;
    const size_t start = block * j->block, count = block_of(j, start);
    double columns[BLOCK_NUMBERS], *xs = j->out->xs + start * (size_t)dim;
    koksma__kernels()->fractions(count, j->binary + start, columns);
    for (int k = 1; k < dim; k++) {
        const size_t at = (size_t)k * count;
        koksma__kernels()->quotients(count, xs + at, 0, whole_of(koksma__prime(k)), columns + at);
    }
    if (dim == 2 || dim == 4) {
        koksma__kernels()->rows_of_columns(count, dim, columns, count, false, xs);
        return KOKSMA_OK;
    }
    for (int k = 0; k < dim; k++) {
        koksma__store_column(count, columns + (size_t)k * count, dim, k, xs);
    }
    return KOKSMA_OK;
}

static koksma_status fill_all(job *j, const koksma_run *run)
{
    const size_t n = j->out->n, dim = (size_t)j->out->dim, blocks = (n + j->block - 1) / j->block;
    koksma_status status = KOKSMA_OK;
    if (n >= MANY) {
        status = koksma__parallel(run, dim, fill, j);
        return status ? status : koksma__parallel(run, blocks, turn, j);
    }
    for (size_t k = 0; k < dim && !status; k++) {
        status = fill(j, k);
    }
    for (size_t b = 0; b < blocks && !status; b++) {
        status = turn(j, b);
    }
    return status;
}

koksma_status koksma__owen_digits(uint64_t seed, const koksma_run *run, koksma_points *out)
{
    uint32_t few[FEW];
    job j = {seed, out, BLOCK_NUMBERS, few};
    while (j.block * (size_t)out->dim > BLOCK_NUMBERS) {
        j.block /= 2;
    }
    if (out->n > FEW) {
        const size_t bytes = out->n * sizeof *j.binary;
        j.binary = malloc(bytes);
        KOKSMA__REQUIRE_MEMORY(j.binary, bytes);
        koksma__large_pages(j.binary, bytes);
    }
    const koksma_status status = fill_all(&j, run);
    if (j.binary != few) {
        free(j.binary);
    }
    return status;
}
