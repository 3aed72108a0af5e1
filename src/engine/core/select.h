/* SPDX-License-Identifier: Apache-2.0 */
/* Selection among points by one coordinate, for trees whose nodes are halved. */
#ifndef KOKSMA_CORE_SELECT_H
#define KOKSMA_CORE_SELECT_H

#include <stddef.h>
#include <stdint.h>

/* Quickselect (Hoare 1961): reorders the indices order[first .. end - 1] so that position `middle` has the index that
   sorting by coordinate k would put there, and no point before it has a larger coordinate. Point i has the
   coordinates xs[i * dim] to xs[i * dim + dim - 1]. The pivot is never the last point, so that no side
   is empty. */
static inline void koksma__select(uint32_t *order, size_t first, size_t end, size_t middle, const double *xs,
                                  size_t dim, size_t k)
{
    while (end - first > 1) {
        const double pivot = xs[order[first + (end - 1 - first) / 2] * dim + k];
        size_t i = first, j = end - 1;
        for (;; i++, j--) {
            while (xs[order[i] * dim + k] < pivot) {
                i++;
            }
            while (xs[order[j] * dim + k] > pivot) {
                j--;
            }
            if (i >= j) {
                break;
            }
            const uint32_t kept = order[i];
            order[i] = order[j];
            order[j] = kept;
        }
        if (middle <= j) {
            end = j + 1;
        } else {
            first = j + 1;
        }
    }
}

#endif
