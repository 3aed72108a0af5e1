/* SPDX-License-Identifier: Apache-2.0 */
/*
 * record: the best known sets of n points for a measure, found by `koksma optimise`. `koksma list records` prints
 * their values, the best published values, and the seed and steps that reproduce them. Numbers n without a stored set
 * are an error.
 *     x_ik = t_ik / 10^12, t_ik a whole number from records.csv
 *
 * Source: this project's searches (docs/findings/records.md). Known exactly: the least star discrepancies of 1 to 14
 * points in the plane, which tools/prove_star.c proves, and to four digits up to 21 (Clement, Doerr, Klamroth &
 * Paquete 2023).
 */
#include <koksma/optimise.h>

#include <string.h>

#include "core/status.h"
#include "patterns/patterns.h"

static const char *const names[] = {"star", "l2-star", "l2-periodic", "l2-centered", NULL};

static const koksma_record records[] = {
#define RECORD(measure, dim, n, value, published, source, seed, steps)                                               \
    {(measure), (n), (dim), (value), (published), (source), (seed), (steps)},
#include "patterns/data/records.inc"
#undef RECORD
};

#include "patterns/data/records.inc" /* made from records.csv */

const koksma_record *koksma_record_at(size_t i)
{
    return i < sizeof records / sizeof *records ? &records[i] : NULL;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const char *measure = names[(int)args->params[0]];
    const uint64_t *xs = points;
    size_t below = 0, above = 0;
    for (size_t i = 0; i < sizeof records / sizeof *records; i++) {
        const koksma_record *r = &records[i];
        const bool alike = !strcmp(r->measure, measure) && r->dim == out->dim;
        if (alike && r->n == out->n) {
            for (size_t c = 0; c < out->n * (size_t)out->dim; c++) {
                out->xs[c] = (double)xs[c] / 1e12;
            }
            return KOKSMA_OK;
        }
        below = alike && r->n < out->n ? r->n : below;
        above = alike && r->n > out->n && !above ? r->n : above;
        xs += r->n * (size_t)r->dim;
    }
    if (!above && !below) {
        return koksma__fail(KOKSMA_DIM, "record: there are no sets of dim = %d for %s; dim = 2 would do", out->dim,
                            measure);
    }
    return above && below
               ? koksma__fail(KOKSMA_N, "record: there is no set of n = %zu points for %s; n = %zu or %zu would do",
                              out->n, measure, below, above)
               : koksma__fail(KOKSMA_N, "record: there is no set of n = %zu points for %s; n = %zu would do", out->n,
                              measure, above ? above : below);
}

static const koksma_param params[] = {
    {"measure", "the measure whose value is small for the sets", 0, 0, 3, names, true},
    {0},
};

const koksma_pattern koksma__pattern_record = {
    .name = "record",
    .title = "the best known sets for a measure, for some n (koksma list records)",
    .cite = "clement2023",
    .min_dim = 2,
    .max_dim = 3,
    .claims = KOKSMA_CLAIM_DETERMINISTIC,
    .revision = 8,
    .params = params,
    .generate = generate,
};
