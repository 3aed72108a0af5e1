/* SPDX-License-Identifier: Apache-2.0 */
/* What an audit compares: the series of a store, and the plan whose jobs make their rows again. */
#ifndef KOKSMA_STUDY_RUN_AUDIT_SERIES_H
#define KOKSMA_STUDY_RUN_AUDIT_SERIES_H

#include "study/plan/made_by.h"
#include "study/plan/point_files.h"
#include "study/run/tasks.h"

typedef enum koksma__audit_state {
    KOKSMA__AUDIT_OURS,  /* can be made again */
    KOKSMA__AUDIT_OTHER, /* other revisions made it */
    KOKSMA__AUDIT_WRONG  /* nothing makes it: its key is none, or its scene or points are others now */
} koksma__audit_state;

typedef struct koksma__audit_series {
    koksma__series key;      /* its texts are copies */
    long long id, rows, end; /* end: all its trials are below */
    koksma__audit_state state;
    unsigned char *drawn; /* a bit a trial */
} koksma__audit_series;

/* The series that a job makes: a row of table result, or the error of an image and its coherence. */
enum { KOKSMA__AUDIT_MEMBERS = KOKSMA__RESULT_VALUES };
typedef struct koksma__audit_group {
    koksma__audit_series *members[KOKSMA__AUDIT_MEMBERS]; /* NULL: none */
} koksma__audit_group;

typedef struct koksma__audit_list {
    size_t n;
    koksma__audit_series *at;                    /* by their ids */
    koksma__audit_group *discrepancies, *images; /* of the plan's blocks */
    koksma__point_files files;
} koksma__audit_list;

/* Reads the series and counts their rows. */
koksma_status koksma__audit_list_read(koksma__store *store, koksma__audit_list *list);
void koksma__audit_list_fini(koksma__audit_list *list);

/* The series with an id; NULL: none. */
koksma__audit_series *koksma__audit_find(const koksma__audit_list *list, long long id);

/* Sets the state of a series, and opens its scene. Fails where it is WRONG: the text says why. other: made by. */
koksma_status koksma__audit_check(koksma_study *study, koksma__audit_list *list, koksma__audit_series *series,
                                  koksma__made_by *here);

/* Makes study->plan of the series that are OURS: a block for each group. */
koksma_status koksma__audit_plan(koksma_study *study, koksma__audit_list *list);

/* "image checker, jittered, n = 4, 8 x 6, a:regular@4x1, trial 2". */
void koksma__audit_name(const koksma__series *key, long long trial, char *text, size_t size);

#endif
