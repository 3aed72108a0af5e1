/* SPDX-License-Identifier: Apache-2.0 */
/* What domains share: the part to which a random number belongs, found by bisection in the running sums of the parts'
   shares, where sums[i] is the sum over parts 0 to i; and the nodes of a field (field.h). */
#include "domains/field.h"

#include <stdlib.h>

#include "core/capacity.h"

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

koksma_status koksma__field_add(koksma__field *field, size_t *capacity, koksma__field_node node)
{
    KOKSMA__TRY(koksma__reserve(&field->nodes, capacity, field->n_nodes + 1, sizeof *field->nodes));
    field->nodes[field->n_nodes++] = node;
    return KOKSMA_OK;
}

void koksma__field_close(koksma__field *field)
{
    if (field->close) {
        field->close(field->data);
    }
    free(field->nodes);
    *field = (koksma__field){0};
}
