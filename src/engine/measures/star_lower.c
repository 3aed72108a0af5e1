/* SPDX-License-Identifier: Apache-2.0 */
/*
 * star-lower: a lower bound of the star discrepancy by a random search for a box with a large difference. The measure
 * is meant for many dimensions, where finding the worst box is NP-hard.
 *
 * Formula: the largest |#{x_i in box}/n - volume| that threshold accepting finds among anchored boxes (see star.c).
 * Source: Gnewuch, Wahlstrom and Winzen 2012; measures/star/star_search.c describes how this search differs from
 * theirs. Known exactly: the value never exceeds the value of the measure star, except in the last bit by rounding.
 * In measurements (docs/findings/records.md) the default search reached star in all of 360 sets of 12 patterns,
 * with 64 to 2000 points in 2 to 5 dimensions and 50 to 200 points in 6 to 8. Limits: the witness, which is given up
 * to 16 dimensions, proves the bound. The distance to the supremum is unknown, so the upper bound is 1.
 */
#include "measures/measures.h"
#include "measures/shared/shared.h"
#include "measures/star/star.h"

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    const koksma_status status =
        koksma__star_search(points, args->run, (uint64_t)args->params[2], (size_t)args->params[0],
                            (size_t)args->params[1], koksma__deadline_s(args->run, 0.95), out);
    out->exact = false;
    out->lower = out->value;
    out->upper = 1;
    return status;
}

static const koksma_param params[] = {
    {"steps", "number of steps of each walk", 1000, 1, 1e9, NULL, true},
    {"restarts", "number of walks for the excess, and also for the deficit", 10, 1, 1e6, NULL, true},
    {"seed", "seed of the search", 1, 0, 9007199254740992.0, NULL, true},
    {0},
};

const koksma_measure koksma__measure_star_lower = {
    .name = "star-lower",
    .title = "lower bound of the star discrepancy by threshold accepting",
    .cite = "gnewuch2012",
    .cost = "steps n d",
    .family = KOKSMA_FAMILY_BOXES,
    .min_dim = 1,
    .max_dim = KOKSMA__STAR_MAX_DIM,
    .params = params,
    .eval = eval,
    .answer = KOKSMA_ANSWER_BOUND,
};
