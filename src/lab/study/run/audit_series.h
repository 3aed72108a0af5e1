/* SPDX-License-Identifier: Apache-2.0 */
/* The series of a store that an audit compares, and the plan whose jobs compute their rows again. */
#ifndef KOKSMA_STUDY_RUN_AUDIT_SERIES_H
#define KOKSMA_STUDY_RUN_AUDIT_SERIES_H

#include "study/plan/made_by.h"
#include "study/run/tasks.h"
#include "study/store/store.h"

typedef enum koksma__audit_state {
    KOKSMA__AUDIT_OURS,  /* this build can compute the series again */
    KOKSMA__AUDIT_OTHER, /* other revisions of the pattern or the measure computed the series */
    KOKSMA__AUDIT_WRONG  /* the series cannot be computed: its key is invalid, or its scene or points have changed */
} koksma__audit_state;

typedef struct koksma__audit_series {
    koksma__series key;      /* the key, with its own copies of the strings */
    long long id, rows, end; /* end: 1 + the largest trial number */
    koksma__audit_state state;
    bool newer;           /* whether a newer version than this program made it; only in the state OTHER */
    bool is_reference;    /* whether it is a row of table `reference`, which has no pattern, trials and id */
    unsigned char *drawn; /* one bit per trial, which tells whether the trial was drawn for the audit */
} koksma__audit_series;

/* The series that one job computes: the measures in a row of table `result`; or the error of an image, its coherence,
   and the metrics of the block, in this order. */
enum { KOKSMA__AUDIT_MEMBERS = 2 + KOKSMA__MOST_METRICS };
typedef struct koksma__audit_group {
    koksma__audit_series *members[KOKSMA__AUDIT_MEMBERS]; /* NULL: unused entry */
} koksma__audit_group;

typedef struct koksma__audit_list {
    size_t n;
    koksma__audit_series *at; /* sorted by id */
    size_t n_references;
    koksma__audit_series *references;            /* rows of table `reference` */
    koksma__audit_group *discrepancies, *images; /* one group per block of the plan */
    long long strangers;                         /* number of values that belong to no series */
    koksma__point_files files;
} koksma__audit_list;

/* Reads all series and references of the store, and counts the rows of the series. */
koksma_status koksma__audit_list_read(koksma__store *store, koksma__audit_list *list);
void koksma__audit_list_fini(koksma__audit_list *list);

/* Finds the series with the given id; NULL if there is none. */
koksma__audit_series *koksma__audit_find(const koksma__audit_list *list, long long id);

/* Sets the state of a series or reference and opens its scene. Fails if the state is WRONG; the error text gives the
   reason. *here: the revisions of this build. */
koksma_status koksma__audit_check(koksma_study *study, koksma__audit_list *list, koksma__audit_series *series,
                                  koksma__made_by *here);

/* Builds study->plan from what has the state OURS: one block for each group of series, and one without trials for each
   reference. */
koksma_status koksma__audit_plan(koksma_study *study, koksma__audit_list *list);

#endif
