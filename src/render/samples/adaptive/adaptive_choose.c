/* SPDX-License-Identifier: Apache-2.0 */
/* Selects the pixels that receive samples in the next round: all that demand samples or, under a budget, those
   where samples reduce the error most. */
#include "render/samples/adaptive/adaptive_choose.h"

#include <stdlib.h>

#include "core/status.h"
#include "render/samples/adaptive/adaptive.h"

enum { GREEDY = 4 };

typedef struct candidate {
    float score;
    uint32_t pixel;
} candidate;

static int by_score(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->score != q->score) {
        return p->score > q->score ? -1 : 1;
    }
    /* pixels with equal scores are ordered by the pixel's number times an odd number modulo 2^32, so that no pattern
       is visible */
    return p->pixel * 2654435761u < q->pixel * 2654435761u ? -1 : 1;
}

/* Under a budget a round selects a quarter of the pixels that demand samples, in descending order of score, so
   that later rounds choose with more information. A pixel that demands more than the rest of the budget is
   skipped. */
static void select_best(koksma__adaptive *run, candidate *list, size_t n, size_t *selected)
{
    qsort(list, n, sizeof *list, by_score);
    const size_t most = (n + GREEDY - 1) / GREEDY;
    for (size_t i = 0; i < n && *selected < most; i++) {
        koksma__sample_demand *demand = &run->demands[list[i].pixel];
        const uint64_t cost = (uint64_t)demand->now + demand->later;
        if (cost <= run->budget - run->spent) {
            run->spent += cost;
            demand->selected = true;
            ++*selected;
        }
    }
}

koksma_status koksma__adaptive_choose(koksma__adaptive *run, size_t *selected)
{
    size_t n = 0;
    *selected = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        n += run->demands[p].now > 0;
        run->demands[p].selected = run->demands[p].now > 0 && run->budget == UINT64_MAX;
    }
    if (run->budget == UINT64_MAX || !n) {
        *selected = n;
        return KOKSMA_OK;
    }
    candidate *list = malloc(n * sizeof *list);
    KOKSMA__REQUIRE_MEMORY(list, n * sizeof *list);
    n = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        if (run->demands[p].now) {
            list[n++] = (candidate){run->demands[p].score, (uint32_t)p};
        }
    }
    select_best(run, list, n, selected);
    free(list);
    return KOKSMA_OK;
}
