/* SPDX-License-Identifier: Apache-2.0 */
/* Pixel filters f(x) f(y): checks them, evaluates them and samples positions from them. */
#ifndef KOKSMA_RENDER_FILTERS_FILTERS_H
#define KOKSMA_RENDER_FILTERS_FILTERS_H

#include <koksma/render.h>

/* Fails unless a filter, which may be the caller's own, has a name, a function and a radius above 0 of at most
   KOKSMA__MAX_RADIUS pixels, because tables of samples and the width of the film's border follow from it. Error:
   ARGUMENT. */
enum { KOKSMA__MAX_RADIUS = 64 };
koksma_status koksma__filter_check(const koksma_filter *filter);

/* The sampling densities of a filter f, as a table: [-radius, radius] is divided into cells of equal width, and
   for each cell the table has the mean of |f| and the mean of the positive part of f. */
typedef struct koksma__filter_table koksma__filter_table;

/* Makes the table of a filter. Errors: MEMORY. */
koksma_status koksma__filter_open(const koksma_filter *filter, koksma__filter_table **out);
void koksma__filter_close(koksma__filter_table *table);

/* Returns whether the filter f is negative anywhere. */
bool koksma__filter_is_signed(const koksma__filter_table *table);

/* Maps u in [0,1) to a position x in [-radius, radius] whose density is proportional to the mean of |f| over each
   cell. The weight is the cell's mean of f divided by its mean of |f|, scaled so that the mean weight is 1; if f
   has one sign all weights are 1. The effective filter is a step function: the mean of f over each of 1024 cells. */
float koksma__filter_sample(const koksma__filter_table *table, float u, float *weight);

/* Maps u in [0,1) to a position whose density is proportional to the positive part of f; every weight is 1. */
float koksma__filter_sample_positive(const koksma__filter_table *table, float u);

/* Balances the weights of the n samples of a pixel, so that weights of both signs preserve a constant image: w[i]
   becomes 1 + (w[i] - mean) n / (n - 1), and their mean becomes 1. Weights that are all 1 do not change. */
void koksma__filter_balance(float *w, size_t n);

/* Returns the filter's value f(x), scaled so that f integrates to 1. The result is 0 unless -radius <= x < radius, so
   that a position on the edge between two pixels belongs to one of them. */
float koksma__filter_value(const koksma__filter_table *table, float x);

#endif
