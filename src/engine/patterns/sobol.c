/* SPDX-License-Identifier: Apache-2.0 */
/*
 * sobol: the digital sequence of Sobol', in natural order. Dimensions 1 and 2 are a (0,2)-sequence in base 2.
 *
 *     x_k = 2^-53 (the sum modulo 2 of the columns V_b of dimension k over the set bits b of i)
 *
 * The generator matrices are upper triangular, so that points below 2^32 are multiples of 2^-32.
 * Source: Sobol' 1967; direction numbers of Joe & Kuo 2008; with numbers=bratley-fox those of Bratley & Fox 1988,
 * which GSL uses; with numbers=groups our own, found by a search (tools/make_sobol_groups.c) in which the first 2^4 ..
 * 2^12 points should have even projections on dimensions 2 k and 2 k + 1, and on dimensions 4 k .. 4 k + 3. Options for
 * scrambling:
 *     scramble=digital-shift  exclusive or with one random word for each dimension
 *     scramble=lms            a random lower triangular matrix for each dimension, and a digital shift (Matousek
 *                             1998); unlike with owen, pairs of points that share a bit prefix stay correlated
 *     scramble=owen           Owen's nested uniform scrambling (1995), exact, by stochastic generation (Helmer et al.
 *                             2021); bits below those that distinguish n points are independent random bits
 *     scramble=hash-owen      nested scrambling by a hash (Laine & Karras 2011, Burley 2020, constants of Vegdahl
 *                             2021), with random access; each flip of a bit, and each pair of flips, has the
 *                             distribution of exact Owen scrambling, so that variances are equal; but of the 128
 *                             combinations of flips in the tree of three bits the hash produces only 32
 *     shuffle=1               with hash-owen: the hash scrambles the order of the points, too; the first 2^m points
 *                             are still an aligned block of the sequence
 *
 * The first 2^32 points are scrambled in 32 digits. Every map of digits 33 to 53 maps 21 zeros to 21 zeros, so that
 * all points together are a scrambled sequence: digital-shift leaves these digits alone, lms multiplies them by a
 * random lower triangular matrix, owen and hash-owen permute them at every node of the tree of digits that has no
 * point below 2^32. With shuffle=1 the points of each aligned block of 2^32 have a random order; the blocks are in
 * order.
 *
 * Known exactly, 2D, n = 16: D* = 0.171875, L2 star = 0.047766231 (no scrambling).
 */
#include <koksma/sampler.h>

#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/nets/nets.h"
#include "patterns/patterns.h"

enum { NONE, DIGITAL_SHIFT, LMS, OWEN, HASH_OWEN };

static const char *const scrambles[] = {"none", "digital-shift", "lms", "owen", "hash-owen", NULL};
static const char *const numbers[] = {"joe-kuo", "bratley-fox", "groups", NULL};

typedef struct job {
    uint64_t seed;
    int scramble, numbers;
    bool shuffle;
    const uint32_t (*matrices)[32]; /* only with lms: the scrambled direction numbers of all dimensions */
    uint64_t part;                  /* the points are 2^32 part + args->first, ... (patterns/nets/nets.h) */
    const uint64_t *sums;           /* NULL in part 0: the digits that `part` adds to each dimension */
} job;

/* Returns the first 32 digits that all points of the part have in common. */
static uint32_t early_of(const job *j, int k)
{
    return j->sums ? koksma__early_digits(j->sums[k]) : 0;
}

static const uint32_t *directions_of(const job *j, int k)
{
    return j->matrices ? j->matrices[k] : koksma__sobol_directions(k, j->numbers);
}

/* Returns the random word of the digital shift of dimension k. Word 3 of the random stream is not used. */
static uint32_t seed_of(const job *j, int k)
{
    const uint64_t at = (uint64_t)(k < 3 ? k : k + 1);
    return koksma__random(j->seed, KOKSMA__PURPOSE_SCRAMBLE, at / 4, 0).w[at % 4];
}

static void digital(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs)
{
    const job *j = context;
    uint32_t v[KOKSMA__COLUMN_BLOCK];
    for (int c = 0; c < some; c++) {
        const uint32_t *directions = directions_of(j, k + c);
        uint32_t start = koksma__digital_start(directions, first) ^ early_of(j, k + c);
        if (j->scramble) {
            start ^= seed_of(j, k + c);
        }
        koksma__kernels()->digital(count, directions, start, v);
        koksma__kernels()->fractions(count, v, xs[c]);
    }
}

static koksma_status fill_digital(const job *j, const koksma_args *args, koksma_points *out)
{
    const uint32_t *directions[KOKSMA__DIGITAL_DIM];
    uint32_t starts[KOKSMA__DIGITAL_DIM];
    koksma_status status;
    if (out->dim > KOKSMA__DIGITAL_DIM) {
        status = koksma__range_blocks(args, out, digital, j);
    } else {
        for (int k = 0; k < out->dim; k++) {
            directions[k] = directions_of(j, k);
            starts[k] = early_of(j, k) ^ (j->scramble ? seed_of(j, k) : 0);
        }
        status = koksma__range_digital(args, directions, starts, out);
    }
    return status || !j->sums ? status : koksma__add_late_digits(args->run, j->sums, out);
}

static void hash_owen(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs)
{
    const job *j = context;
    const koksma__kernel_table *kernels = koksma__kernels();
    uint32_t index[KOKSMA__COLUMN_BLOCK], v[KOKSMA__COLUMN_BLOCK], directions[32];
    if (j->shuffle) {
        koksma__hash_owen_order(j->seed, j->part, first, count, index);
    } else {
        for (size_t i = 0; i < count; i++) {
            index[i] = (uint32_t)(first + i);
        }
    }
    for (int c = 0; c < some; c++) {
        if (k + c == 0) {
            memcpy(v, index, count * sizeof *v);
        } else if (k + c == 1) {
            kernels->pascal(count, index, v);
        } else {
            koksma__mirror_directions(directions_of(j, k + c), directions);
            if (j->shuffle) {
                kernels->digital_at(count, index, directions, v);
            } else {
                kernels->digital(count, directions, koksma__digital_start(directions, first), v);
            }
        }
        koksma__hash_owen_scramble(j->seed, k + c, j->sums ? j->sums[k + c] : 0, count, v, xs[c]);
    }
}

/* Computes the partners of levels 32 to 52, 21 for each dimension, for points beyond 2^32. */
static koksma_status late_partners(const job *j, int dim, uint64_t **out)
{
    uint64_t columns[KOKSMA__DIGITS];
    const size_t bytes = (size_t)dim * KOKSMA__LATE_DIGITS * sizeof **out;
    *out = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(*out, bytes);
    for (int k = 0; k < dim; k++) {
        koksma__sobol_columns(k, j->numbers, columns);
        koksma__late_partners(columns, *out + (size_t)k * KOKSMA__LATE_DIGITS);
    }
    return KOKSMA_OK;
}

static koksma_status generate_owen(const job *j, const koksma_args *args, koksma_points *out)
{
    uint32_t few[8 * 32], *partners = few;
    uint64_t *late = NULL;
    if (out->dim > 8) {
        partners = malloc((size_t)out->dim * 32 * sizeof *partners);
        KOKSMA__REQUIRE_MEMORY(partners, (size_t)out->dim * 32 * sizeof *partners);
    }
    const int levels = args->first || j->part ? 32 : out->n > 2 ? koksma__levels_of(out->n) : 1;
    for (int k = 0; k < out->dim; k++) {
        koksma__partners(directions_of(j, k), levels, partners + 32 * k);
    }
    koksma_status status = j->part ? late_partners(j, out->dim, &late) : KOKSMA_OK;
    if (!status) {
        const koksma__grow_part part = {j->part, late};
        status = koksma__grow_range(j->seed, KOKSMA__PURPOSE_SCRAMBLE, partners, late ? &part : NULL, args, out);
    }
    free(late);
    if (partners != few) {
        free(partners);
    }
    return status;
}

/* Returns row r of the random lower triangular matrix of dimension k, from its highest bit on. Rows 32 to 52 are rows 0
   to 20 of a second matrix. */
static uint32_t random_row(const job *j, int k, int r)
{
    const uint32_t own = 0x80000000u >> r % 32;
    const uint32_t word =
        koksma__random(j->seed, KOKSMA__PURPOSE_SCRAMBLE, (uint64_t)r / 4, 1 + (uint32_t)k).w[r % 4];
    return (word & ~(own | (own - 1))) | own;
}

/* Multiplies each column by a random lower triangular matrix: output bit r is the sum modulo 2 of input bit r and of
   those higher input bits that a random row of the matrix selects. */
static void scramble_matrix(const job *j, int k, uint32_t *matrix)
{
    const uint32_t *directions = koksma__sobol_directions(k, j->numbers);
    for (int b = 0; b < 32; b++) {
        matrix[b] = 0;
    }
    for (int r = 0; r < 32; r++) {
        const uint32_t own = 0x80000000u >> r, row = random_row(j, k, r);
        for (int b = 0; b < 32; b++) {
            matrix[b] |= __builtin_parity(directions[b] & row) ? own : 0;
        }
    }
}

/* Multiplies the digits that the part adds to dimension k by the same matrix of 32 rows, and digits 33 to 53 by a
   matrix of 21 rows. */
static uint64_t scramble_sum(const job *j, int k, uint64_t sum)
{
    uint64_t product = 0;
    for (int r = 0; r < KOKSMA__DIGITS; r++) {
        const uint32_t digits = r < 32 ? koksma__early_digits(sum) : (uint32_t)(sum << (32 - KOKSMA__LATE_DIGITS));
        product = product << 1 | (unsigned)__builtin_parity(digits & random_row(j, k, r));
    }
    return product;
}

static koksma_status generate_lms(job *j, const koksma_args *args, koksma_points *out)
{
    uint32_t few[8][32], (*matrices)[32] = few;
    if (out->dim > 8) {
        matrices = malloc((size_t)out->dim * sizeof *matrices);
        KOKSMA__REQUIRE_MEMORY(matrices, (size_t)out->dim * sizeof *matrices);
    }
    for (int k = 0; k < out->dim; k++) {
        scramble_matrix(j, k, matrices[k]);
    }
    j->matrices = (const uint32_t(*)[32])matrices;
    const koksma_status status = fill_digital(j, args, out);
    if (matrices != few) {
        free(matrices);
    }
    return status;
}

static koksma_status generate_with(job *j, const koksma_args *args, koksma_points *out)
{
    if (j->scramble == OWEN) {
        return generate_owen(j, args, out);
    }
    if (j->scramble == LMS) {
        return generate_lms(j, args, out);
    }
    return j->scramble == HASH_OWEN ? koksma__range_blocks(args, out, hash_owen, j) : fill_digital(j, args, out);
}

static koksma_status generate_part(const void *context, uint64_t part, const koksma_args *args, koksma_points *out)
{
    job j = *(const job *)context;
    uint64_t columns[KOKSMA__DIGITS], sums[KOKSMA__SOBOL_DIM];
    j.part = part;
    for (int k = 0; part && k < out->dim; k++) {
        koksma__sobol_columns(k, j.numbers, columns);
        sums[k] = koksma__part_sum(columns, part);
        sums[k] = j.scramble == LMS ? scramble_sum(&j, k, sums[k]) : sums[k];
        j.sums = sums;
    }
    return generate_with(&j, args, out);
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    job j = {.seed = seed,
             .scramble = (int)args->params[0],
             .numbers = (int)args->params[1],
             .shuffle = args->params[2] != 0};
    KOKSMA__FAIL_IF(out->dim > koksma__sobol_dim(j.numbers), KOKSMA_DIM,
                    "sobol: numbers=%s has %d dimensions, not %d; numbers=joe-kuo has %d", numbers[j.numbers],
                    koksma__sobol_dim(j.numbers), out->dim, KOKSMA__SOBOL_DIM);
    KOKSMA__FAIL_IF(j.shuffle && j.scramble != HASH_OWEN, KOKSMA_ARGUMENT,
                    "sobol: shuffle=1 needs scramble=hash-owen");
    return koksma__in_first_part(args, out) ? generate_with(&j, args, out)
                                            : koksma__range_parts(args, out, generate_part, &j);
}

static const koksma_param params[] = {
    {"scramble", "scrambling: none, digital-shift, lms (random matrix and shift), owen (exact) or hash-owen", NONE,
     NONE, HASH_OWEN, scrambles, true},
    {"numbers",
     "direction numbers: joe-kuo (1,111 dimensions), bratley-fox (40, as in GSL) or groups (128, with even pairs of "
     "dimensions)",
     KOKSMA__JOE_KUO, KOKSMA__JOE_KUO, KOKSMA__GROUPS, numbers, true},
    {"shuffle", "1: also scramble the order of the points; only with hash-owen", 0, 0, 1, NULL, true},
    {0},
};

const koksma_pattern koksma__pattern_sobol = {
    .name = "sobol",
    .title = "the digital sequence of Sobol', plain or scrambled",
    .cite = "sobol1967 joe2008 bratley1988 owen1995 matousek1998 laine2011 burley2020 helmer2021",
    .min_dim = 1,
    .max_dim = KOKSMA__SOBOL_DIM,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_DIMENSION_PREFIXES | KOKSMA_CLAIM_SEQUENCE |
              KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET2 | KOKSMA_CLAIM_NET2_PREFIXES,
    .params = params,
    .revision = 2, /* since revision 2 a study makes one trial, not several, of the unscrambled points
                      (docs/decisions.md, 58) */
    .generate = generate,
    .ranges = koksma__ranges_always,
};
