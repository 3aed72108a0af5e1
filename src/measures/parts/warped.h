/* SPDX-License-Identifier: Apache-2.0 */
/* Points of the square carried to a domain. A measure of a domain has a parameter `warp`, whose choices are the names
   of the warps to that domain; `koksma measure --warp` finds the measures of a warp by it. */
#ifndef KOKSMA_MEASURES_PARTS_WARPED_H
#define KOKSMA_MEASURES_PARTS_WARPED_H

#include <koksma/warp.h>

extern const char *const koksma__warps_to_disk[], *const koksma__warps_to_triangle[],
                                                      *const koksma__warps_to_hemisphere[];

#define KOKSMA__WARP_PARAM(choices, last)                                                                            \
    {                                                                                                                \
        "warp", "how the square becomes the domain", 0, 0, last, choices, false                                      \
    }

typedef struct koksma__warped {
    size_t n;
    int dim;
    const koksma_warp *warp;
    double *xs; /* coordinate k of point i: xs[k * n + i] */
} koksma__warped;

/* choice is the value of the parameter. Errors: MEMORY. */
koksma_status koksma__warped_init(koksma__warped *w, const koksma_points *points, const char *const *choices,
                                  double choice);
void koksma__warped_fini(koksma__warped *w);

#endif
