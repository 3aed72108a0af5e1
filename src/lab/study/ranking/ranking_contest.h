/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A contest compares patterns in one scene at one image size: it renders their trials in rounds and takes the
 * decisions that the errors allow. ranking.c runs one contest for the ranking and one for each check at another
 * size.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_CONTEST_H
#define KOKSMA_STUDY_RANKING_RANKING_CONTEST_H

#include <pthread.h>
#include <stdatomic.h>

#include "image/metrics/metrics.h"
#include "study/plan/variants.h"
#include "study/ranking/ranking_decisions.h"
#include "study/run/run_control.h"
#include "study/run/study.h"

/*
 * The reference images that a ranking measures errors against, for one metric: each is the mean of independent
 * replicates. For the jackknife estimate of the reference's own error (ranking_decisions.c), the means over all
 * replicates but one are also stored. A ranking begins with a reference of stage 0, which costs as much as 16 trials, and
 * goes on to those of stages 1 and 2, with 4 and 16 times as many samples, after a number of rounds.
 * Errors of all stages are added up: the jackknife leaves out the replicates r of all
 * stages together. The samples depend only on the scene, the size, the samples per pixel and the stage.
 */
typedef struct koksma__rank_reference {
    koksma_metric_spec metric;
    int width, height;
    size_t pixels, values; /* values: pixels times metric.metric->channels */
    double *mean;          /* mean of each value over the replicates */
    double *without;       /* the mean of value v over all replicates except r is at r * values + v */
    double error;          /* expected mean absolute error of the luminance of `mean`; NaN: not known */
    int made;              /* number of replicates rendered so far */
} koksma__rank_reference;

enum { KOKSMA__RANK_STAGES = 3 };

/* The samples per pixel of a replicate when the patterns have spp samples per pixel: a square number, which suits
   jittered samplers of other renderers. */
long long koksma__rank_reference_spp(int spp, int stage);

void koksma__rank_reference_fini(koksma__rank_reference *reference);

/* Indices of a trial's errors: at 0 the error against the reference, at 1 + r the error against the reference
   without replicate r, from KOKSMA__RANK_ROBUST on the same without the few pixels that err most, and last these pixels'
   share of the error. */
enum {
    KOKSMA__RANK_ROBUST = 1 + KOKSMA__RANK_REPLICATES,
    KOKSMA__RANK_TOP_SHARE = 2 * KOKSMA__RANK_ROBUST,
    KOKSMA__RANK_ERRORS,
};

/* Of the trials summed so far: their mean error, the sum of the squared deviations, and sums of the errors against the
   references without a replicate. */
typedef struct koksma__rank_sums {
    double mean, squares, without[KOKSMA__RANK_REPLICATES];
} koksma__rank_sums;

/* ---- Contests ---------------------------------------------------------------------------------------------- */

enum { KOKSMA__RANK_LOOKS = 2 };

typedef struct koksma__contestant {
    size_t pattern;        /* index into the options' patterns */
    atomic_bool late;      /* postponed: whether its first round took more than its share of the time */
    atomic_bool refused;   /* whether the pattern cannot be ranked, for the reason in `reason` */
    atomic_ullong busy_ns; /* thread time spent on its trials */
    size_t refused_trial;  /* the first trial that failed */
    char reason[KOKSMA_RANK_REASON];
    double first[KOKSMA__RANK_FIRST_ROUND][KOKSMA__RANK_ERRORS]; /* errors of the trials of round 0 */
    /* whether `first` has the errors of trial t of round 0 */
    atomic_bool done[KOKSMA__RANK_FIRST_ROUND];
    size_t n;                      /* number of trials summed in the next fields; trials are added in their order */
    koksma__rank_sums all, robust; /* of all pixels, and without the few that err most */
    double top_share;              /* a sum */
    pthread_mutex_t lock;          /* guards the next four fields until round 0 is complete */
    koksma_image seen[KOKSMA__RANK_LOOKS]; /* the first trials, rendered for the first look and not yet measured */
    double *waiting[KOKSMA__RANK_FIRST_ROUND]; /* pixel errors of trials that wait for an earlier trial to be added */
    size_t added;                              /* number of trials added to `sums` */
    koksma_coherence sums;
    koksma_coherence_values coherence; /* of all trials of round 0; `images` in it is 0 until they are complete */
} koksma__contestant;

typedef struct koksma__contest {
    const koksma_rank_options *options;
    koksma__study_scene scene; /* the scene, with the width and height of this contest's pictures */
    const char *variant;
    koksma__run_control *control;
    /* NULL, or the contest at the size that the caller asked for, with all patterns in the order of the options: a
       pattern whose error is coherent at that size is not recommended in this contest either. */
    const struct koksma__contest *asked;
    int max_rounds;
    size_t n;
    koksma__contestant *contestants;
    koksma__rank_table table; /* entrant i is contestant i */
    koksma__rank_table
        robust; /* that of the errors without a few pixels: their rounds; all else is set where it is used */
    koksma__rank_reference references[KOKSMA__RANK_STAGES]; /* pixels is 0 before a stage is begun */
    atomic_ullong looked;                                   /* millionths of images that the first look rendered */
    char doubt[KOKSMA_RANK_REASON];                         /* what the first trials look like beside the reference */
    unsigned long long share_ns; /* thread time allowed for a pattern's first round; 0: no limit */
    pthread_mutex_t lock;        /* guards `reason` of all contestants */
} koksma__contest;

/* Whether a failed picture only takes its pattern out of the ranking. Others end the ranking. */
static inline bool koksma__rank_leaves_out(koksma_status status)
{
    return status && status != KOKSMA_INTERRUPTED && status != KOKSMA_MEMORY && status != KOKSMA_IO &&
           status != KOKSMA_SYSTEM;
}

/* The contest must not be moved in memory. Errors: MEMORY. koksma__contest_fini also accepts a zeroed contest and
   one whose init failed. */
koksma_status koksma__contest_init(koksma__contest *contest, const koksma_rank_options *options,
                                   const koksma__study_scene *scene, const char *variant,
                                   koksma__run_control *control, const size_t *patterns, size_t n, double alpha);
void koksma__contest_fini(koksma__contest *contest);

/* Excludes the patterns that cannot make spp points, and postpones those for which finding this out takes too long.
   Errors: MISSING, MALFORMED (a file or program of a pattern), FORBIDDEN (a program that may not run), MEMORY,
   INTERRUPTED. */
koksma_status koksma__contest_try_patterns(koksma__contest *contest);

/* The first look of koksma_rank_options: sets errors[i] for contestant i. Its images are those of the first two trials,
   which round 0 measures. Errors: MEMORY, INTERRUPTED; what fails for one pattern fails again in round 0, which says so.
   */
koksma_status koksma__contest_look(koksma__contest *contest, double *errors);

/* Runs rounds until the goal is decided or max_rounds is reached. Errors: those of rendering the reference, MEMORY,
   INTERRUPTED (also when the time limit is reached). */
koksma_status koksma__contest_run(koksma__contest *contest, koksma__rank_goal goal);

/* Makes the reference of a stage, or takes that of the options. Errors: those of rendering, IMPOSSIBLE (a
   pixel is not a finite number, or another renderer makes equal pictures for all seeds), MEMORY, INTERRUPTED. */
koksma_status koksma__contest_make_reference(const koksma_rank_options *options, const koksma__study_scene *scene,
                                             const char *variant, int stage, const koksma_run *run,
                                             koksma__rank_reference *reference);

/* The errors of contestant i's trials so far: those of all complete rounds or, before round 0 is complete, of the
   first trials without a gap. Without any trial, n is 0. */
koksma__rank_errors koksma__contest_errors(const koksma__contest *contest, size_t i);

#endif
