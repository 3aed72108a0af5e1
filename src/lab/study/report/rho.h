/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rank correlations of measures with image errors. Sums by measure and scene give means over any set of scenes; all
 * cases are resampled together, so that the means of two measures can be compared resample by resample. Rankings of the
 * measures by these means say which differ significantly, and which statements hold whichever one scene is left out. All
 * is in the report's memory; after a failure of the report, rankings are empty.
 */
#ifndef KOKSMA_STUDY_REPORT_RHO_H
#define KOKSMA_STUDY_REPORT_RHO_H

#include "study/report/report.h"

/* The number of bootstrap resamples. With ten measures, Holm's correction compares the smallest p-value of the 45
   pairs with 0.05 / 45 = .0011. With 4,000 resamples, two or three resamples decide whether p is below this limit,
   and which differences were significant changed with the seed; with 20,000 resamples, eleven decide. */
enum { KOKSMA__RHO_SAMPLES = 20000 };

/* Sums over the cases of a measure in one scene. */
typedef struct koksma__rho_cell {
    size_t all, few; /* number of cases, and of those with too few patterns for an interval */
    double total;    /* sum of rho over the cases */
    double *draws;   /* sum of rho over the cases, for each resample; NULL: there is no case */
} koksma__rho_cell;

/* Sums of rho of one measure. */
typedef struct koksma__rho_sums {
    const char *measure;
    double total;
    size_t all, few; /* as of a cell */
    size_t sure;     /* number of cases whose interval excludes 0 */
    size_t n_cells;
    koksma__rho_cell *cells; /* of the first n_cells scenes */
} koksma__rho_sums;

typedef struct koksma__rho_means {
    size_t n, n_scenes;
    koksma__rho_sums *of;
    const char **scenes;
    double *draws; /* of all measures, for the ranking that is being made */
} koksma__rho_means;

/* Returns a correlation over n_patterns patterns as tables show it: its interval becomes NaN if it has no meaning,
   because there are fewer than KOKSMA__LEAST_PAIRS patterns or its width is 0. */
koksma__estimate koksma__rho_shown(const koksma__estimate *rho, size_t n_patterns);

/* Adds a case of a measure and a scene, whose texts must outlive the means: rho from koksma__rho_shown, and its resamples.
   For a measure that is better when larger, the caller reverses the sign of rho and of its resamples. */
void koksma__rho_add(koksma__report *r, koksma__rho_means *s, const char *measure, const char *scene,
                     size_t n_patterns, const koksma__estimate *rho, const double draws[KOKSMA__RHO_SAMPLES]);

/* Ends adding: sorts the measures by their mean over all cases, the largest first and equal means in the plan's order. */
void koksma__rho_order(koksma__report *r, koksma__rho_means *s);

typedef struct koksma__rho_standing {
    size_t cases;          /* 0: the measure has none in the subset */
    koksma__estimate mean; /* the mean with its interval, which is NaN if a case has too few patterns */
    koksma__estimate less; /* the mean minus that of the first measure */
    double p;              /* p-value of "the mean is 0", adjusted by Holm over the measures */
} koksma__rho_standing;

typedef struct koksma__rho_ranking {
    size_t n;        /* number of measures that have cases in the subset */
    size_t n_pairs;  /* number of compared pairs: both measures have intervals and equally many cases */
    size_t measures; /* number of all measures, by whose index are: */
    koksma__rho_standing *of;
    double
        *p; /* [measures][measures]: p-values of "the means are equal", by Holm over the pairs; NaN: not compared */
    size_t *order; /* the n measures by mean, the largest first */
} koksma__rho_ranking;

/* Ranks the measures over the cases of some scenes; scenes: whether each is one of them. */
koksma__rho_ranking koksma__rho_rank(koksma__report *r, const koksma__rho_means *s, const bool *scenes);

/* Whether measure a has a significantly larger mean than measure b (at 5 % for all pairs
   together). Measures are indices in koksma__rho_means. */
bool koksma__rho_is_better(const koksma__rho_ranking *ranking, size_t a, size_t b);

/* Rankings over all scenes, and over all scenes but one: of[0] includes all scenes, of[1 + s] all but scene s. If
   there is only one scene, there is only of[0]. */
typedef struct koksma__rho_jackknife {
    size_t n;
    koksma__rho_ranking *of;
} koksma__rho_jackknife;

/* Computes the rankings over all scenes and without each of them. */
koksma__rho_jackknife koksma__rho_leave_out(koksma__report *r, const koksma__rho_means *s);

/* Statements on measures. */
typedef enum koksma__rho_statement {
    KOKSMA__RHO_BETTER,   /* measure a is significantly better than b */
    KOKSMA__RHO_PREDICTS, /* the mean of a is significantly above 0 */
    KOKSMA__RHO_FIRST     /* a is the first by its mean */
} koksma__rho_statement;

/* Whether a statement holds over all scenes and whichever one scene is left out. */
bool koksma__rho_always(const koksma__rho_jackknife *jackknife, koksma__rho_statement statement, size_t a, size_t b);

/* The mean over all scenes, and the range of a measure's mean over the rankings of a jackknife. */
koksma__estimate koksma__rho_range(const koksma__rho_jackknife *jackknife, size_t measure);

/* The sentences on what predicts the error, which state only results that hold over all scenes and whichever one scene is
   left out. */
void koksma__rho_say(koksma__document *d, const koksma__rho_means *s, const koksma__rho_jackknife *jackknife);

#endif
