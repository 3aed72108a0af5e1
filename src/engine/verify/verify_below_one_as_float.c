/* SPDX-License-Identifier: Apache-2.0 */
/*
 * below-one-as-float: checks that no coordinate becomes 1 when it is converted to float. Doubles from 1 - 2^-25 on
 * round to the float 1, which is outside [0,1): a renderer then reads past the end of a table. O(n dim).
 */
#include <stdio.h>

#include "verify/verify.h"

static koksma_status look(koksma__verification *v)
{
    const koksma_points *points = v->points;
    size_t count = 0, first = 0;
    for (size_t i = points->n * (size_t)points->dim; i-- > 0;) {
        if ((float)points->xs[i] >= 1) {
            count++;
            first = i / (size_t)points->dim;
        }
    }
    char where[48] = "";
    if (count) {
        snprintf(where, sizeof where, ", first of point %zu", first);
    }
    return koksma__add_finding(v, "-", (double)count, count == 0, "%zu of %zu coordinates become 1%s", count,
                               points->n * (size_t)points->dim, where);
}

const koksma__property koksma__property_below_one_as_float = {
    .public = {.name = "below-one-as-float",
               .meaning = "no coordinate becomes 1 as a float; value: number of coordinates that become 1"},
    .look = look,
};
