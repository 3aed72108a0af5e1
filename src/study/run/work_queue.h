/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers 0 .. n-1 that are taken once each and put back done. */
#ifndef KOKSMA_STUDY_RUN_WORK_QUEUE_H
#define KOKSMA_STUDY_RUN_WORK_QUEUE_H

#include <koksma/koksma.h>

typedef struct koksma__work_queue {
    size_t n, left;            /* left: not done */
    size_t next;               /* all below are taken */
    size_t again;              /* where the search for lost ones goes on */
    unsigned char *out, *done; /* a bit a number: taken; put back */
} koksma__work_queue;

typedef bool (*koksma__work_queue_ready)(const void *context, size_t i);

koksma_status koksma__work_queue_open(size_t n, koksma__work_queue *queue);
void koksma__work_queue_close(koksma__work_queue *queue);

/* The first of the next `reach` numbers that nobody has taken and that is ready (NULL: each is). */
bool koksma__work_queue_take(koksma__work_queue *queue, size_t reach, koksma__work_queue_ready ready,
                             const void *context, size_t *i);

/* When all are taken: one that is not done. */
bool koksma__work_queue_take_lost(koksma__work_queue *queue, size_t *i);

/* False when it was done before. */
bool koksma__work_queue_put(koksma__work_queue *queue, size_t i);

#endif
