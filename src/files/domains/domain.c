/* SPDX-License-Identifier: Apache-2.0 */
/* What domains share: the part to which a random number belongs, found by bisection in the running sums of the parts'
   shares, where sums[i] is the sum over parts 0 to i. */
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
    /* if `at` was rounded up to the total, no sum is above it: take the last part whose share is not 0 */
    while (low > 0 && sums[low] <= sums[low - 1]) {
        low--;
    }
    return low;
}
