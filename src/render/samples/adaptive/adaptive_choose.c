/* SPDX-License-Identifier: Apache-2.0 */
/* Selects the pixels that get samples in the next round: all that demand some, or under a budget those where samples
   reduce the error most. */
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
    /* equals in an order without pattern: pixels times an odd number modulo 2^32 */
    return p->pixel * 2654435761u < q->pixel * 2654435761u ? -1 : 1;
}

/* Under a budget a round serves a quarter of those who ask, the highest scores first, so that later rounds know more;
   those for whom too little is left wait. */
static void serve_best(koksma__adaptive *run, candidate *list, size_t n, size_t *served)
{
    qsort(list, n, sizeof *list, by_score);
    const size_t most = (n + GREEDY - 1) / GREEDY;
    for (size_t i = 0; i < n && *served < most; i++) {
        koksma__ask *ask = &run->asks[list[i].pixel];
        const uint64_t cost = (uint64_t)ask->now + ask->later;
        if (cost <= run->budget - run->spent) {
            run->spent += cost;
            ask->served = true;
            ++*served;
        }
    }
}

koksma_status koksma__adaptive_choose(koksma__adaptive *run, size_t *served)
{
    size_t n = 0;
    *served = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        n += run->asks[p].now > 0;
        run->asks[p].served = run->asks[p].now > 0 && run->budget == UINT64_MAX;
    }
    if (run->budget == UINT64_MAX || !n) {
        *served = n;
        return KOKSMA_OK;
    }
    candidate *list = malloc(n * sizeof *list);
    KOKSMA__REQUIRE_MEMORY(list, n * sizeof *list);
    n = 0;
    for (size_t p = 0; p < run->pixels; p++) {
        if (run->asks[p].now) {
            list[n++] = (candidate){run->asks[p].score, (uint32_t)p};
        }
    }
    serve_best(run, list, n, served);
    free(list);
    return KOKSMA_OK;
}
