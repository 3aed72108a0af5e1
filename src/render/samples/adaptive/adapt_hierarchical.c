/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The method `hierarchical`: strata are split where neighbours differ (Kajiya 1986), in all uses of sample dimensions
 * (pixel, lens, light, ...) together (Shirley 1991, section 5.6). With pairing=aligned, neighbours in the pixel are
 * neighbours in every use. With pairing=shuffled they are not: strata that are neighbours in one use can be far apart
 * in another, and are then split although no neighbours differ there (Shirley's figure 5.36). Where the values are
 * constant, no stratum is split. The estimate is biased, because the values that decide about splits are also
 * averaged. It is unbiased with reuse=fresh; aligned strata also need phase=shifted or phase=folded.
 */
#include "render/samples/adaptive/adaptive_place.h"
#include "render/samples/adaptive/adaptive_show.h"
#include "render/samples/adaptive/adaptive_strata.h"

enum { PAIRING = KOKSMA__STRATA_REUSE + 1, PHASE };

static const char *const pairings[] = {"aligned", "shuffled", NULL};
static const char *const phases[] = {
    [KOKSMA__PHASE_FIXED] = "fixed", [KOKSMA__PHASE_SHIFTED] = "shifted", [KOKSMA__PHASE_FOLDED] = "folded", NULL};

static const koksma_param params[] = {
    KOKSMA__STRATA_PARAMS,
    {"pairing", "how the strata of different uses are paired", 0, 0, 1, pairings, true},
    {"phase", "how the strata of all uses but the pixel are moved with aligned pairing", KOKSMA__PHASE_FIXED, 0, 2,
     phases, true},
    {0},
};

static koksma_status open(koksma__adaptive *run)
{
    const koksma_status status = koksma__strata_open(run);
    koksma__strata *s = run->state;
    if (s) {
        s->shuffled = run->options->params[PAIRING] > 0;
        s->phase = (int)run->options->params[PHASE];
    }
    return status;
}

static const koksma__adaptive_method method = {KOKSMA__STRATA_METHOD, .open = open, .decide = koksma__strata_decide};

const koksma_adaptive koksma__adaptive_hierarchical = {
    .name = "hierarchical",
    .title = "splits strata where the values of neighbours differ, in all uses together",
    .cite = "kajiya1986 shirley1991",
    .params = params,
    .own_samples = true,
    .functions = &method,
};
