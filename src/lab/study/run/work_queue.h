/* SPDX-License-Identifier: Apache-2.0 */
/* A queue of the numbers 0 .. n-1, each of which is taken once, and put back as done after its work. */
#ifndef KOKSMA_STUDY_RUN_WORK_QUEUE_H
#define KOKSMA_STUDY_RUN_WORK_QUEUE_H

#include <koksma/koksma.h>

typedef struct koksma__work_queue {
    size_t n, left;            /* left: how many numbers have not been put back */
    size_t next;               /* all numbers below `next` are taken */
    size_t again;              /* where koksma__work_queue_take_lost continues its search */
    unsigned char *out, *done; /* one bit per number: whether it is taken; whether it was put back */
} koksma__work_queue;

typedef bool (*koksma__work_queue_ready)(const void *context, size_t i);

koksma_status koksma__work_queue_open(size_t n, koksma__work_queue *queue);
void koksma__work_queue_close(koksma__work_queue *queue);

/* Takes the first number that is ready and not taken, among the next `reach` numbers; returns false if there is
   none. If `ready` is NULL, every number is ready. */
bool koksma__work_queue_take(koksma__work_queue *queue, size_t reach, koksma__work_queue_ready ready,
                             const void *context, size_t *i);

/* Takes a number again that is taken but not put back. Returns false if some number is not taken yet or all were put
   back. */
bool koksma__work_queue_take_lost(koksma__work_queue *queue, size_t *i);

/* Puts a number back as done; returns false if the number was put back before. */
bool koksma__work_queue_put(koksma__work_queue *queue, size_t i);

#endif
