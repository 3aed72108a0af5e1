/* SPDX-License-Identifier: Apache-2.0 */
/*
 * faure: the (0,dim)-sequence of Faure in the smallest prime base b >= dim.
 *
 *     x_k = sum_r y_r b^(-r-1),   y = P^k a mod b: y_r = sum_(c >= r) C(c,r) k^(c-r) a_c
 *
 * with a the digits of i and P the upper triangular Pascal matrix. The first b^m points are a (0,m,dim)-net in base
 * b. Every unscrambled coordinate is the double nearest to its exact fraction. Source: Faure 1982.
 *
 *     scramble=owen  Owen's nested uniform scrambling (1995) in base b, drawn exactly, by stochastic generation
 * (Helmer, Christensen & Kensler 2021); coordinates are multiples of b^-M, where b^M is the largest power up to 2^53
 */
#include <stdlib.h>

#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/shared/columns.h"
#include "patterns/shared/owen_sequence.h"
#include "patterns/shared/radical.h"

enum { MAX_DIGITS = 53, FEW = 4096 };
enum { NONE, OWEN };

typedef struct job {
    uint32_t base;
    int digits;
    double whole;
    uint32_t *matrices; /* digits^2 for each coordinate: entry [r][c] */
} job;

static void fill_matrix(const job *j, uint32_t k, uint32_t *matrix)
{
    const uint32_t b = j->base;
    for (int c = 0; c < j->digits; c++) {
        for (int r = 0; r < j->digits; r++) {
            /* C(c,r) k^(c-r) = C(c-1,r-1) k^(c-r) + k C(c-1,r) k^(c-1-r) */
            uint32_t value = r == 0 && c == 0;
            if (c > 0 && r <= c) {
                value = r > 0 ? matrix[(r - 1) * j->digits + c - 1] : 0;
                value += k * matrix[r * j->digits + c - 1] % b;
            }
            matrix[r * j->digits + c] = value % b;
        }
    }
}

/* The digits a of an index, their product y with the matrix, and x = y_0 b^(digits-1) + y_1 b^(digits-2) + ... */
typedef struct walk {
    uint32_t a[MAX_DIGITS], y[MAX_DIGITS];
    double weight[MAX_DIGITS], x; /* whole numbers below 2^53 */
} walk;

/* Adds column c of the matrix to y, modulo b. */
static void add_column(const job *j, const uint32_t *matrix, int c, walk *w)
{
    for (int r = 0; r <= c; r++) {
        const uint32_t sum = w->y[r] + matrix[r * j->digits + c], y = sum < j->base ? sum : sum - j->base;
        w->x += ((double)y - w->y[r]) * w->weight[r];
        w->y[r] = y;
    }
}

static void begin(const job *j, const uint32_t *matrix, uint64_t index, walk *w)
{
    *w = (walk){.x = 0};
    double weight = j->whole;
    for (int r = 0; r < j->digits; r++) {
        w->weight[r] = weight /= j->base;
    }
    for (int c = 0; index; c++, index /= j->base) {
        for (w->a[c] = 0; w->a[c] < index % j->base; w->a[c]++) {
            add_column(j, matrix, c, w);
        }
    }
}

/* Goes on to the next index. A digit that wraps from b - 1 to 0 has also grown by 1 modulo b, so that its column is
   added, too. */
static void step(const job *j, const uint32_t *matrix, walk *w)
{
    for (int c = 0; c < j->digits; c++) {
        add_column(j, matrix, c, w);
        if (++w->a[c] < j->base) {
            return;
        }
        w->a[c] = 0;
    }
}

static void column(const void *context, int k, uint64_t first, size_t count, double *xs)
{
    const job *j = context;
    const uint32_t *matrix = j->matrices + (size_t)k * (size_t)(j->digits * j->digits);
    walk w;
    begin(j, matrix, first, &w);
    for (size_t i = 0; i < count; i++) {
        xs[i] = w.x / j->whole;
        step(j, matrix, &w);
    }
}

/* In y = P^k a the digit a_l appears at position l, and column l of P^k times a_l is added to the positions before l.
   The inverse P^-k, which is P^(b-k) modulo b, recovers the digits of a; this function returns column l = `level` of
   it, the coefficients of (x + b - k)^l. */
static void relatives(const void *context, int k, int level, uint32_t *digits)
{
    const uint32_t b = *(const uint32_t *)context, t = (b - (uint32_t)k) % b;
    uint32_t power[KOKSMA__OWEN_DIGITS + 1] = {1};
    for (int l = 1; l <= level; l++) {
        for (int c = l; c >= 0; c--) {
            power[c] = ((c > 0 ? power[c - 1] : 0) + t * power[c]) % b;
        }
    }
    for (int c = 0; c < level; c++) {
        digits[c] = power[c];
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    job j = {.base = 2, .digits = 1};
    for (int k = 1; j.base < (uint32_t)out->dim; k++) {
        j.base = koksma__prime(k);
    }
    if (args->params[0] == OWEN) {
        return koksma__owen_sequence(seed, j.base, relatives, &j.base, args->run, out);
    }
    const double end = (double)(args->first + out->n);
    for (j.whole = j.base; j.whole < end; j.whole *= j.base) {
        j.digits++;
    }
    KOKSMA__FAIL_IF(j.whole > 0x1p53, KOKSMA_N,
                    "faure: point %.0f: in base %u there are only points below number %.0f", end - 1, j.base,
                    j.whole / j.base);
    uint32_t few[FEW];
    const size_t entries = (size_t)out->dim * (size_t)(j.digits * j.digits);
    j.matrices = entries <= FEW ? few : malloc(entries * sizeof *j.matrices);
    KOKSMA__REQUIRE_MEMORY(j.matrices, entries * sizeof *j.matrices);
    for (int k = 0; k < out->dim; k++) {
        fill_matrix(&j, (uint32_t)k, j.matrices + (size_t)k * (size_t)(j.digits * j.digits));
    }
    const koksma_status status = koksma__range_columns(args, out, column, &j);
    if (j.matrices != few) {
        free(j.matrices);
    }
    return status;
}

static bool ranges(const double *params)
{
    return params[0] != OWEN;
}

static const char *const scrambles[] = {"none", "owen", NULL};

static const koksma_param params[] = {
    {"scramble", "none or owen (nested, in base b, exact)", NONE, NONE, OWEN, scrambles, true},
    {0},
};

const koksma_pattern koksma__pattern_faure = {
    .name = "faure",
    .title = "the (0,dim)-sequence in the smallest prime base",
    .cite = "faure1982 owen1995 helmer2021",
    .min_dim = 1,
    .max_dim = 1000,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET_PREFIXES,
    .params = params,
    .generate = generate,
    .ranges = ranges,
};
