/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers 0 .. n-1 that are taken once each and put back done. */
#ifndef KOKSMA_STUDY_RUN_QUEUE_H
#define KOKSMA_STUDY_RUN_QUEUE_H

#include <koksma/koksma.h>

typedef struct koksma__queue {
    size_t n, left;            /* left: not done */
    size_t next;               /* all below are taken */
    size_t again;              /* where the search for lost ones goes on */
    unsigned char *out, *done; /* a bit a number: taken; put back */
} koksma__queue;

typedef bool (*koksma__queue_ready)(const void *context, size_t i);

koksma_status koksma__queue_open(size_t n, koksma__queue *queue);
void koksma__queue_close(koksma__queue *queue);

/* The first of the next `reach` numbers that nobody has taken and that is ready (NULL: each is). */
bool koksma__queue_take(koksma__queue *queue, size_t reach, koksma__queue_ready ready, const void *context,
                        size_t *i);

/* When all are taken: one that is not done. */
bool koksma__queue_take_lost(koksma__queue *queue, size_t *i);

/* False when it was done before. */
bool koksma__queue_put(koksma__queue *queue, size_t i);

#endif
