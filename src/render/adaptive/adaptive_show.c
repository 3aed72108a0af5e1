/* SPDX-License-Identifier: Apache-2.0 */
/* The strata of a pixel as its base use has them, for figures such as 5.35 and 5.36 of Shirley 1991. */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/adaptive/adaptive_strata.h"
#include "render/vector3.h"

koksma_status koksma__strata_show(const koksma__adaptive *run, size_t pixel, koksma_strata *out)
{
    const koksma__strata *s = run->state;
    const koksma__tree *tree = &s->trees[pixel];
    koksma__use_cells base;
    uint32_t *permutation = malloc((size_t)s->m * s->m * sizeof *permutation);
    out->list = malloc(tree->n * sizeof *out->list);
    if (!permutation || !out->list) {
        free(permutation);
        free(out->list);
        out->list = NULL;
        return koksma__fail_memory(tree->n * sizeof *out->list);
    }
    koksma__use_cells_init(run, pixel, tree->base, permutation, &base);
    out->n = tree->n;
    out->use = koksma_use_at((size_t)koksma__use_index(tree->base))->name;
    for (uint32_t i = 0; i < tree->n; i++) {
        const koksma__stratum *from = &tree->strata[i];
        const double side = ldexp(1.0 / s->m, -from->level);
        const double width = base.line ? ldexp(1.0 / ((double)s->m * s->m), -2 * from->level) : side;
        uint32_t cell[2];
        float place[2];
        koksma__stratum_cell(s, &base, from, cell);
        koksma__stratum_place(s, &base, &base, from, tree->stage, place);
        out->list[i] = (koksma_stratum){
            .x = cell[0] * width,
            .y = base.line ? 0 : cell[1] * side,
            .width = width,
            .height = base.line ? 1 : side,
            .at = {(double)place[0], base.line ? 0.5 : (double)place[1]},
            .value = (double)(run->frame->channels == 1 ? from->value[0] : koksma__luminance3(from->value)),
            .level = from->level};
    }
    free(permutation);
    return KOKSMA_OK;
}
