/* SPDX-License-Identifier: Apache-2.0 */
/*
 * origin-unique and origin-present: how many points are at the origin. The first point of a digital sequence is the
 * origin; a generator that skips it destroys the net property of the sequence's prefixes. origin-present fails where
 * the points look like points 1 to n of such a sequence: each coordinate takes different multiples of 2^-m, 2^m > n,
 * of which none is 0 and not all are odd multiples. O(n dim).
 */
#include <stdio.h>
#include <string.h>

#include "verify/verify.h"

static size_t at_origin(const koksma_points *points)
{
    size_t count = 0;
    for (size_t i = 0; i < points->n; i++) {
        bool zero = true;
        for (int k = 0; k < points->dim; k++) {
            zero = zero && points->xs[i * (size_t)points->dim + (size_t)k] == 0;
        }
        count += zero;
    }
    return count;
}

/* Whether the points look like points 1 to n of a sequence like Sobol's: in each coordinate different multiples of
   2^-m, 2^m > n, none of them 0 and not all odd. Grids are excluded because their points share coordinates, and cell
   centres because all their coordinates are odd multiples. `seen` has room for one bit for each multiple. */
static bool is_sequence_from_one(const koksma_points *points, uint32_t *seen)
{
    size_t cells = 1;
    while (cells <= points->n) {
        cells *= 2;
    }
    for (int k = 0; k < points->dim; k++) {
        bool odd = true;
        memset(seen, 0, (cells / 32 + 1) * sizeof *seen);
        for (size_t i = 0; i < points->n; i++) {
            const double place = points->xs[i * (size_t)points->dim + (size_t)k] * (double)cells;
            const size_t cell = (size_t)place;
            if (place != (double)cell || cell == 0 || seen[cell / 32] >> cell % 32 & 1) {
                return false;
            }
            seen[cell / 32] |= 1u << cell % 32;
            odd = odd && cell % 2;
        }
        if (odd) {
            return false;
        }
    }
    return true;
}

static koksma_status look_unique(koksma__verification *v)
{
    const size_t count = at_origin(v->points);
    return koksma__add_finding(v, "-", (double)count, count <= 1, "%zu at the origin", count);
}

static koksma_status look_present(koksma__verification *v)
{
    const size_t count = at_origin(v->points);
    const bool holds = count > 0 || !is_sequence_from_one(v->points, v->counts);
    return koksma__add_finding(
        v, "-", (double)count, holds, "%zu at the origin%s", count,
        count > 0 ? ""
        : holds   ? "; only unscrambled sequences need a point there"
                  : ": different multiples of 2^-m in each coordinate, as a sequence without its first point");
}

const koksma__property koksma__property_origin_unique = {
    .public = {.name = "origin-unique",
               .meaning = "at most one point is at the origin; value: number of points there"},
    .look = look_unique,
};

const koksma__property koksma__property_origin_present = {
    .public = {.name = "origin-present",
               .meaning = "the points do not look like an unscrambled sequence whose first point, the origin, is "
                          "missing; value: number of points at the origin"},
    .look = look_present,
};
