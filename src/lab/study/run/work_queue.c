/* SPDX-License-Identifier: Apache-2.0 */
/* The queue has two bits for each number: whether it is taken, and whether it was put back. A cursor skips the taken
   numbers, so that taking is O(1) unless numbers are not ready. When all numbers are taken, a second cursor cycles
   through those that are not put back. */
#include "study/run/run.h"

#include <stdlib.h>

#include "core/status.h"

static bool get(const unsigned char *bits, size_t i)
{
    return bits[i / 8] >> i % 8 & 1;
}

static void set(unsigned char *bits, size_t i)
{
    bits[i / 8] |= (unsigned char)(1u << i % 8);
}

koksma_status koksma__work_queue_open(size_t n, koksma__work_queue *queue)
{
    *queue = (koksma__work_queue){.n = n, .left = n, .out = calloc(n / 8 + 1, 1), .done = calloc(n / 8 + 1, 1)};
    return queue->out && queue->done ? KOKSMA_OK : koksma__fail_memory(n / 4);
}

void koksma__work_queue_close(koksma__work_queue *queue)
{
    free(queue->out);
    free(queue->done);
    *queue = (koksma__work_queue){0};
}

bool koksma__work_queue_take(koksma__work_queue *queue, size_t reach, koksma__work_queue_ready ready,
                             const void *context, size_t *out)
{
    while (queue->next < queue->n && get(queue->out, queue->next)) {
        queue->next++;
    }
    for (size_t i = queue->next; i < queue->n && i - queue->next < reach; i++) {
        if (!get(queue->out, i) && (!ready || ready(context, i))) {
            set(queue->out, i);
            *out = i;
            return true;
        }
    }
    return false;
}

bool koksma__work_queue_take_lost(koksma__work_queue *queue, size_t *out)
{
    if (queue->left == 0 || queue->next < queue->n) {
        return false;
    }
    while (get(queue->done, queue->again)) {
        queue->again = (queue->again + 1) % queue->n;
    }
    *out = queue->again;
    queue->again = (queue->again + 1) % queue->n;
    return true;
}

bool koksma__work_queue_put(koksma__work_queue *queue, size_t i)
{
    if (get(queue->done, i)) {
        return false;
    }
    set(queue->out, i);
    set(queue->done, i);
    queue->left--;
    return true;
}
