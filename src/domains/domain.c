/* SPDX-License-Identifier: Apache-2.0 */
/* Draws a part of a domain by bisection of the sums of all parts before it. */
#include "domains/domain.h"

size_t koksma__domain_find(const double *sums, size_t count, double at)
{
    size_t low = 0, high = count - 1;
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (sums[middle] > at) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    /* where `at` was rounded up to the total: the last entry that is not empty */
    while (low > 0 && sums[low] <= sums[low - 1]) {
        low--;
    }
    return low;
}
