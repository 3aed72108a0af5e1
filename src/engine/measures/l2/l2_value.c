/* SPDX-License-Identifier: Apache-2.0 */
/* The choice of a method for the L2 discrepancies: sorting in one and two dimensions (l2_sort.c), divide and conquer
   in three and four (l2_divide.c), otherwise sums over pairs (l2_range.c). */
#include "measures/l2/l2.h"

#include <math.h>

#include "core/sum.h"

enum { SORT_FROM = 256 };

/* Returns whether to use divide and conquer. The table has the least n from which divide and conquer is faster than
   summing pairs (measured with AVX-512), by dimension and by the number of products of the kernel. Above n = 2^24 the
   lists of divide and conquer would take gigabytes. */
static bool divides(const koksma__l2_row *row, const koksma_points *points)
{
    static const size_t from[][3] = {{3072, 6144, 16384}, {8192, 49152, 131072}};
    const int ranks = koksma__l2_ranks(row);
    return points->dim >= 3 && points->dim <= KOKSMA__L2_DIVIDE_DIM &&
           points->n >= from[points->dim - 3][ranks - 1] && points->n <= (size_t)1 << 24;
}

koksma_status koksma__l2(const koksma__l2_row *row, const koksma_points *points, const koksma_run *run,
                         koksma_value *out)
{
    const bool sort = points->dim <= 2 && points->n >= SORT_FROM && points->n < (size_t)1 << 28;
    if (!sort && !divides(row, points)) {
        return koksma__l2_value_by_pairs(row, points, run, out);
    }
    const koksma_status status =
        (sort ? koksma__l2_by_sorting : koksma__l2_by_dividing)(row, points, run, &out->square);
    out->square = koksma__not_below_0(out->square);
    out->value = sqrt(out->square);
    return status;
}
