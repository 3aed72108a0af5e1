/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/parts/warped.h"

#include <stdlib.h>

#include "core/status.h"

const char *const koksma__warps_to_disk[] = {"concentric-disk", "polar-disk", NULL};
const char *const koksma__warps_to_triangle[] = {"triangle", "triangle-heitz", NULL};
const char *const koksma__warps_to_hemisphere[] = {"hemisphere", "hemisphere-polar", "hemisphere-cosine",
                                                   "hemisphere-cosine-polar", NULL};

koksma_status koksma__warped_init(koksma__warped *w, const koksma_points *points, const char *const *choices,
                                  double choice)
{
    *w = (koksma__warped){.n = points->n, .warp = koksma_warp_find(choices[(int)choice])};
    w->dim = w->warp->dim;
    w->xs = malloc(points->n * (size_t)w->dim * sizeof(double));
    if (!w->xs) {
        return koksma__fail_memory(points->n * (size_t)w->dim * sizeof(double));
    }
    for (size_t i = 0; i < w->n; i++) {
        double x[3];
        w->warp->map(points->xs + 2 * i, x);
        for (int k = 0; k < w->dim; k++) {
            w->xs[(size_t)k * w->n + i] = x[k];
        }
    }
    return KOKSMA_OK;
}

void koksma__warped_fini(koksma__warped *w)
{
    free(w->xs);
    w->xs = NULL;
}
