/* SPDX-License-Identifier: Apache-2.0 */
/*
 * faure: the (0,dim)-sequence of Faure in the smallest prime base b >= dim.
 *
 *     x_k = sum_r y_r b^(-r-1),   y = P^k a mod b: y_r = sum_(c >= r) C(c,r) k^(c-r) a_c
 *
 * with a the digits of i and P the upper triangular Pascal matrix. The first b^m points are a (0,m,dim)-net in base
 * b. Every value is the double nearest to its fraction. Source: Faure 1982.
 */
#include <stdlib.h>

#include "core/status.h"
#include "patterns/parts/columns.h"
#include "patterns/parts/radical.h"
#include "patterns/patterns.h"

enum { MAX_DIGITS = 32, FEW = 4096 };

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

static void column(const void *context, int k, size_t first, size_t count, double *xs)
{
    const job *j = context;
    const uint32_t *matrix = j->matrices + (size_t)k * (size_t)(j->digits * j->digits);
    for (size_t i = 0; i < count; i++) {
        uint32_t a[MAX_DIGITS], used = 0;
        for (size_t rest = first + i; rest; rest /= j->base) {
            a[used++] = (uint32_t)(rest % j->base);
        }
        double value = 0;
        for (uint32_t r = 0; r < (uint32_t)j->digits; r++) {
            uint32_t y = 0;
            for (uint32_t c = r; c < used; c++) {
                y += matrix[r * (uint32_t)j->digits + c] * a[c];
            }
            value = value * j->base + y % j->base;
        }
        xs[i] = value / j->whole;
    }
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    job j = {.base = 2, .digits = 1};
    for (int k = 1; j.base < (uint32_t)out->dim; k++) {
        j.base = koksma__prime(k);
    }
    for (j.whole = j.base; j.whole < (double)out->n; j.whole *= j.base) {
        j.digits++;
    }
    uint32_t few[FEW];
    const size_t entries = (size_t)out->dim * (size_t)(j.digits * j.digits);
    j.matrices = entries <= FEW ? few : malloc(entries * sizeof *j.matrices);
    if (!j.matrices) {
        return koksma__fail_memory(entries * sizeof *j.matrices);
    }
    for (int k = 0; k < out->dim; k++) {
        fill_matrix(&j, (uint32_t)k, j.matrices + (size_t)k * (size_t)(j.digits * j.digits));
    }
    const koksma_status status = koksma__fill_columns(args->run, out, column, &j);
    if (j.matrices != few) {
        free(j.matrices);
    }
    return status;
}

const koksma_pattern koksma__pattern_faure = {
    .name = "faure",
    .title = "the (0,dim)-sequence in the smallest prime base",
    .cite = "faure1982",
    .min_dim = 1,
    .max_dim = 1000,
    .claims = KOKSMA_CLAIM_DETERMINISTIC | KOKSMA_CLAIM_SEQUENCE | KOKSMA_CLAIM_ANY_N | KOKSMA_CLAIM_NET_PREFIXES,
    .generate = generate,
};
