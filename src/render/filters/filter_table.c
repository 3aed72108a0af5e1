/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The table of filters, and the sampling of positions from a filter f: |f| is tabulated in 1024 cells of equal width
 * as cumulative sums, which are inverted by binary search. All positions in a cell have the same weight, the mean of
 * f over the cell divided by the mean of |f|, so that the expected weight in each cell is exactly the integral of f.
 */
#include "render/filters/filter_table.h"

#include <math.h>
#include <stdlib.h>

#include "core/lookup.h"
#include "core/status.h"
#include "render/filters/filters.h"

enum { CELLS = 1024, PARTS = 16 };

static const koksma_filter *const table[] = {
#define FILTER(name) &koksma__filter_##name,
#include "render/filters/filters.def"
#undef FILTER
};

KOKSMA__LOOKUP(koksma_filter, table)

struct koksma__filter_table {
    const koksma_filter *filter;
    bool is_signed;
    double scale;               /* 1 / integral of f */
    double cdf[CELLS + 1];      /* cumulative distribution of |f| at the left edge of each cell */
    double positive[CELLS + 1]; /* cumulative distribution of max(f, 0) */
    float weights[CELLS];       /* the weight of a position in the cell when positions are drawn from |f| */
};

/* Normalises a table of cumulative sums, one for each cell's left edge: divides it by the sum over all cells. */
static void normalise(double *cdf, double sum)
{
    for (int i = 0; i < CELLS; i++) {
        cdf[i] /= sum;
    }
    cdf[CELLS] = 1;
}

koksma_status koksma__filter_open(const koksma_filter *filter, koksma__filter_table **out)
{
    koksma__filter_table *t = malloc(sizeof *t);
    *out = t;
    KOKSMA__REQUIRE_MEMORY(t, sizeof *t);
    const double width = 2 * filter->radius / CELLS;
    double sum = 0, integral = 0, positive = 0;
    t->filter = filter;
    for (int i = 0; i < CELLS; i++) {
        double part = 0, signed_part = 0, positive_part = 0;
        for (int k = 0; k < PARTS; k++) { /* midpoint rule */
            const double f = filter->value(-filter->radius + width * (i + (k + 0.5) / PARTS));
            part += fabs(f);
            signed_part += f;
            positive_part += fmax(f, 0);
        }
        t->cdf[i] = sum;
        t->positive[i] = positive;
        t->weights[i] = (float)(part > 0 ? signed_part / part : 0);
        sum += part;
        integral += signed_part;
        positive += positive_part;
    }
    for (int i = 0; i < CELLS; i++) {
        t->weights[i] *= (float)(sum / integral); /* all weights are 1 if f has one sign */
    }
    t->is_signed = integral < sum;
    normalise(t->cdf, sum);
    normalise(t->positive, positive);
    t->scale = PARTS / (integral * width);
    return KOKSMA_OK;
}

void koksma__filter_close(koksma__filter_table *t)
{
    free(t);
}

bool koksma__filter_is_signed(const koksma__filter_table *t)
{
    return t->is_signed;
}

/* Returns the position below which the cumulative distribution is u, and the cell that contains the position. */
static float invert(const koksma__filter_table *t, const double *cdf, float u, int *cell)
{
    int low = 0, high = CELLS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (cdf[middle] <= (double)u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double width = 2 * t->filter->radius / CELLS, share = cdf[low + 1] - cdf[low];
    *cell = low;
    return (float)(-t->filter->radius + width * (low + (share > 0 ? ((double)u - cdf[low]) / share : 0.5)));
}

float koksma__filter_sample(const koksma__filter_table *t, float u, float *weight)
{
    int cell;
    const float x = invert(t, t->cdf, u, &cell);
    *weight = t->weights[cell];
    return x;
}

float koksma__filter_sample_positive(const koksma__filter_table *t, float u)
{
    int cell;
    return invert(t, t->positive, u, &cell);
}

void koksma__filter_balance(float *w, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += (double)w[i];
    }
    const double mean = sum / (double)n, scale = n > 1 ? (double)n / (double)(n - 1) : 0;
    for (size_t i = 0; i < n; i++) {
        w[i] = (float)(1 + ((double)w[i] - mean) * scale);
    }
}

float koksma__filter_value(const koksma__filter_table *t, float x)
{
    const double r = t->filter->radius, at = (double)x;
    return at >= -r && at < r ? (float)(t->scale * t->filter->value(at)) : 0;
}
