/* SPDX-License-Identifier: Apache-2.0 */
/*
 * References in the making. A reference is cut into parts of whole rows, as many as its size says; a part is all
 * replicates of its rows, added in their order, so that the picture has the same bits whoever makes which part, and
 * the sums of no more than the references in the making are held.
 */
#ifndef KOKSMA_STUDY_RUN_REFERENCE_TILES_H
#define KOKSMA_STUDY_RUN_REFERENCE_TILES_H

#include "study/run/tasks.h"

typedef struct koksma__part {
    unsigned long long reference; /* its index in study->references */
    long long first_row, rows;
} koksma__part;

typedef struct koksma__parts {
    koksma_study *study;
    size_t n, room;
    koksma__part *at;
    koksma__replicates *sums; /* of every reference of the study */
    long long *rows_left;
} koksma__parts;

/* Reads the references that the tasks' jobs need and that have a file; lists the parts of the others. */
koksma_status koksma__parts_open(const koksma__tasks *tasks, koksma__parts *parts);
void koksma__parts_close(koksma__parts *parts);

/* Renders a part: the sums of its rows, which the caller frees (out->sum). */
koksma_status koksma__part_do(const koksma_study *study, const koksma__part *part, const koksma_run *run,
                              koksma__replicates *out);

/* Takes a part's sums; *complete: they were the reference's last. One call at a time, each part once. */
koksma_status koksma__parts_put(koksma__parts *parts, const koksma__part *part, const koksma__replicates *sums,
                                bool *complete);

/* The pixels, file and row in the store of a reference that is complete. */
koksma_status koksma__parts_finish(koksma__parts *parts, size_t reference);

#endif
