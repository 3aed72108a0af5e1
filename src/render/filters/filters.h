/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_FILTERS_FILTERS_H
#define KOKSMA_RENDER_FILTERS_FILTERS_H

#include <koksma/render.h>

/* A filter's densities, tabulated: cells of equal width over [-radius, radius], in each the mean of |f|, or of the
   positive part of f. */
typedef struct koksma__filter_table koksma__filter_table;

/* Errors: MEMORY. */
koksma_status koksma__filter_open(const koksma_filter *filter, koksma__filter_table **out);
void koksma__filter_close(koksma__filter_table *table);

/* Whether f is negative anywhere. */
bool koksma__filter_is_signed(const koksma__filter_table *table);

/* u in [0,1) to a position x in [-radius, radius] with density in proportion to the cell's mean of |f|; the weight is
   the cell's mean of f over that of |f|, scaled so that it is 1 everywhere where f has one sign and that its mean is
   1. What is filtered with is f in 1024 steps, each the mean over a cell. */
float koksma__filter_sample(const koksma__filter_table *table, float u, float *weight);

/* u in [0,1) to a position with density in proportion to the positive part of f; every weight is 1. */
float koksma__filter_sample_positive(const koksma__filter_table *table, float u);

/* Draws that a pixel has all together, so that weights of both signs keep a constant: w[i] becomes
   1 + (w[i] - mean) n / (n - 1), of mean 1. Weights that are all 1 stay so. */
void koksma__filter_balance(float *w, size_t n);

/* f(x), scaled to integrate to 1, for -radius <= x < radius: a position on the edge between two pixels is in one of
 * them. */
float koksma__filter_value(const koksma__filter_table *table, float x);

#define FILTER(name) extern const koksma_filter koksma__filter_##name;
#include "render/filters/filters.def"
#undef FILTER

#endif
