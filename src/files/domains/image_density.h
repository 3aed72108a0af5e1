/* SPDX-License-Identifier: Apache-2.0 */
/* A density on a rectangle, in coordinates of [0,1)^2, that an image gives: it is constant in each pixel, in
   proportion to the luminance of the pixel. Pixels are numbered row by row, the top row first. */
#ifndef KOKSMA_DOMAINS_IMAGE_DENSITY_H
#define KOKSMA_DOMAINS_IMAGE_DENSITY_H

#include "domains/domain.h"
#include "patterns/grids/grids.h"

typedef struct koksma__image_density {
    size_t width, height;
    double *sums; /* sums[i]: the summed luminance of pixels 0 to i */
} koksma__image_density;

/* Returns the luminance of a pixel. */
static inline double koksma__image_share(const koksma__image_density *m, size_t pixel)
{
    return m->sums[pixel] - (pixel ? m->sums[pixel - 1] : 0);
}

static inline void koksma__image_place(const koksma__image_density *m, const koksma__domain_point *point, double *x)
{
    x[0] = koksma__in_cell((double)(point->part % m->width), point->at[0], (double)m->width);
    x[1] = koksma__in_cell((double)(m->height - 1 - point->part / m->width), point->at[1], (double)m->height);
}

#endif
