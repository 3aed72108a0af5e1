/* SPDX-License-Identifier: Apache-2.0 */
/* The table of filters, and how samples are drawn from one. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

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
    double scale;          /* 1 / integral of f */
    double cdf[CELLS + 1]; /* of |f| */
    float weights[CELLS];  /* of a place in each cell */
};

koksma_status koksma__filter_open(const koksma_filter *filter, koksma__filter_table **out)
{
    koksma__filter_table *t = malloc(sizeof *t);
    *out = t;
    if (!t) {
        return koksma__fail_memory(sizeof *t);
    }
    const double width = 2 * filter->radius / CELLS;
    double sum = 0, integral = 0;
    t->filter = filter;
    for (int i = 0; i < CELLS; i++) {
        double part = 0, signed_part = 0;
        for (int k = 0; k < PARTS; k++) { /* by midpoints */
            const double f = filter->value(-filter->radius + width * (i + (k + 0.5) / PARTS));
            part += fabs(f);
            signed_part += f;
        }
        t->cdf[i] = sum;
        t->weights[i] = (float)(part > 0 ? signed_part / part : 0);
        sum += part;
        integral += signed_part;
    }
    for (int i = 0; i < CELLS; i++) {
        t->cdf[i] /= sum;
        t->weights[i] *= (float)(sum / integral); /* 1 everywhere when f has one sign */
    }
    t->cdf[CELLS] = 1;
    t->scale = PARTS / (integral * width);
    return KOKSMA_OK;
}

void koksma__filter_close(koksma__filter_table *t)
{
    free(t);
}

float koksma__filter_sample(const koksma__filter_table *t, float u, float *weight)
{
    int low = 0, high = CELLS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (t->cdf[middle] <= (double)u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double width = 2 * t->filter->radius / CELLS, share = t->cdf[low + 1] - t->cdf[low];
    const double x = -t->filter->radius + width * (low + (share > 0 ? ((double)u - t->cdf[low]) / share : 0.5));
    *weight = t->weights[low];
    return (float)x;
}

float koksma__filter_value(const koksma__filter_table *t, float x)
{
    const double r = t->filter->radius, at = (double)x;
    return at >= -r && at < r ? (float)(t->scale * t->filter->value(at)) : 0;
}
