/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Patterns against each other in one scene at one size: renders trials in rounds and takes the decisions that they
 * allow. ranking.c runs one contest for the ranking and one for each check at another size.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_CONTEST_H
#define KOKSMA_STUDY_RANKING_RANKING_CONTEST_H

#include <pthread.h>
#include <stdatomic.h>

#include "study/ranking/ranking_reference.h"
#include "study/run/run_control.h"

typedef struct koksma__contestant {
    size_t pattern;        /* index into the options' patterns */
    atomic_bool late;      /* put off: its first round takes more than its share of the time */
    atomic_bool refused;   /* it cannot serve: `reason` */
    atomic_ullong busy_ns; /* of threads, in its trials */
    size_t refused_trial;
    char reason[KOKSMA_RANK_REASON];
    double first[KOKSMA__RANK_FIRST_ROUND][KOKSMA__RANK_ERRORS]; /* errors of the trials of round 0 */
    atomic_bool done[KOKSMA__RANK_FIRST_ROUND];                  /* those that are there */
    size_t n;                                                    /* trials in what follows, added in their order */
    double mean, squares, robust, top_share, without[KOKSMA__RANK_REPLICATES]; /* sums from robust on */
    pthread_mutex_t lock;                      /* guards what follows until round 0 is complete */
    double *waiting[KOKSMA__RANK_FIRST_ROUND]; /* errors of the pixels of trials whose turn to be added is not yet */
    size_t added;                              /* trials that were added to */
    koksma_coherence sums;
    koksma_coherence_values coherence; /* of all trials of round 0, once they are there; before, images is 0 */
} koksma__contestant;

typedef struct koksma__contest {
    const koksma_rank_options *options;
    koksma__study_scene scene; /* width and height: of this contest */
    const char *variant;
    koksma__run_control *control;
    /* NULL, or the contest at the size that the caller asked for, with all patterns in the same order: a pattern whose
       error is coherent there is not recommended here either. */
    const struct koksma__contest *asked;
    int max_rounds;
    size_t n;
    koksma__contestant *contestants;
    koksma__rank_table table; /* entrant i: contestant i */
    koksma__rank_reference reference;
    unsigned long long share_ns; /* of threads, for a pattern's first round; 0: no limit */
    pthread_mutex_t lock;        /* guards reasons */
} koksma__contest;

/* The contest must stay where it is. Errors: MEMORY. fini takes zeros and what a failed init left. */
koksma_status koksma__contest_init(koksma__contest *contest, const koksma_rank_options *options,
                                   const koksma__study_scene *scene, const char *variant,
                                   koksma__run_control *control, const size_t *patterns, size_t n, double alpha);
void koksma__contest_fini(koksma__contest *contest);

/* Leaves those out that cannot make spp points, or puts those off that take too long to say. Errors: MEMORY,
   INTERRUPTED. */
koksma_status koksma__contest_try_patterns(koksma__contest *contest);

/* Goes on until what is asked for is decided, as far as max_rounds allow. Errors: those of rendering the reference,
   MEMORY, INTERRUPTED (also when the time is up). */
koksma_status koksma__contest_run(koksma__contest *contest, koksma__rank_goal goal);

/* The errors of all trials that count so far: those of the last complete round or, before it, of the first trials
   that are there. n is 0 without any. */
koksma__rank_errors koksma__contest_errors(const koksma__contest *contest, size_t i);

#endif
