/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_FILTERS_FILTERS_H
#define KOKSMA_RENDER_FILTERS_FILTERS_H

#include <koksma/render.h>

/* A filter's density, tabulated: cells of equal width over [-radius, radius], in each the mean of |f|. */
typedef struct koksma__filter_table koksma__filter_table;

/* Errors: MEMORY. */
koksma_status koksma__filter_open(const koksma_filter *filter, koksma__filter_table **out);
void koksma__filter_close(koksma__filter_table *table);

/* u in [0,1) to a place x in [-radius, radius] with density in proportion to the cell's mean of |f|; the weight is
   the cell's mean of f over that of |f|, scaled so that it is 1 everywhere where f has one sign and that a constant
   keeps its value in the mean. What is filtered with is f in 1024 steps, each the mean over a cell. */
float koksma__filter_sample(const koksma__filter_table *table, float u, float *weight);

/* f(x), scaled to integrate to 1, for -radius <= x < radius: a place on the edge between two pixels is in one of
 * them. */
float koksma__filter_value(const koksma__filter_table *table, float x);

#define FILTER(name) extern const koksma_filter koksma__filter_##name;
#include "render/filters/filters.def"
#undef FILTER

#endif
