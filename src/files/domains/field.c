/* SPDX-License-Identifier: Apache-2.0 */
/* The nodes of a field (field.h). */
#include "domains/field.h"

#include <stdlib.h>

#include "core/capacity.h"
#include "core/status.h"

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
