/* SPDX-License-Identifier: Apache-2.0 */
/* The nodes of a field (field.h), in an array that grows by half of its length when it is full. */
#include "domains/field.h"

#include <stdlib.h>

#include "core/status.h"

koksma_status koksma__field_add(koksma__field *field, size_t *capacity, koksma__field_node node)
{
    if (field->n_nodes == *capacity) {
        const size_t more = *capacity + *capacity / 2 + 1024;
        koksma__field_node *grown = realloc(field->nodes, more * sizeof *grown);
        KOKSMA__REQUIRE_MEMORY(grown, more * sizeof *grown);
        field->nodes = grown;
        *capacity = more;
    }
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
