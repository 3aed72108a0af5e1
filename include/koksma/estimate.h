/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Integrals of functions whose truth is not known: estimates from several randomised sets of points (replicates),
 * intervals that hold the integral with a stated confidence, and as many points as a tolerance needs. Part of libkoksma.
 *
 *     koksma_status values(void *context, const koksma_points *points, double *out);  // out[i]: at point i
 *
 *     koksma_tolerance_options options = {.absolute = 1e-6};
 *     koksma_spec pattern;
 *     koksma_tolerance result;
 *     if (!koksma_pattern_spec("sobol:scramble=lms", &pattern) &&
 *         !koksma_integrate_to(values, NULL, 3, &pattern, &options, NULL, &result) && result.reached) {
 *         const koksma_integral_estimate *last = &result.steps[result.n_steps - 1].estimate;
 *         printf("%.9g, in [%.9g, %.9g]\n", last->value, last->low, last->high);
 *     }
 *
 * docs/findings/coverage.md measures how often each interval holds the integral, and the error of each estimator.
 */
#ifndef KOKSMA_ESTIMATE_H
#define KOKSMA_ESTIMATE_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Estimators and intervals ------------------------------------------------------------------------- */

/* An estimator: a function of the estimates y_1 .. y_R of one integral by R independent random sets of a pattern, each
   the mean of the integrand over the points of a set. */
typedef struct koksma_estimator {
    const char *name, *title, *cite; /* title: the formula; cite: keys of docs/references.bib, separated by blanks */
    const char *interval;            /* name of the interval that it has by default */
    double (*of)(double *values, size_t n); /* computes the estimate of n > 0 values, whose order it may change */
} koksma_estimator;

/* An interval for the integral from the same R estimates. */
typedef struct koksma_interval {
    const char *name, *title, *cite; /* as those of an estimator */
    const char *estimator;           /* name of the estimator that it has by default; NULL: auto chooses it */
    const char *assumes;             /* what its coverage rests on */
    bool proved;  /* the coverage is proved for all integrands with the given bounds and every R, if the sets are
                     independent and unbiased; false: it holds if `assumes` does, or for large R */
    bool bounded; /* it needs the bounds of the integrand's values */
} koksma_interval;

/* Returns member i of the table, or the member with this name, or NULL if there is none. */
KOKSMA_API const koksma_estimator *koksma_estimator_at(size_t i);
KOKSMA_API const koksma_estimator *koksma_estimator_find(const char *name);
KOKSMA_API const koksma_interval *koksma_interval_at(size_t i);
KOKSMA_API const koksma_interval *koksma_interval_find(const char *name);

/* How an integral is estimated. A struct of zeros has the defaults, for an integrand of unknown bounds. */
typedef struct koksma_estimate_options {
    const char *estimator;  /* name; NULL: that of the interval */
    const char *interval;   /* name; NULL: that of the estimator, and without either the first of the table, auto */
    double confidence;      /* of the interval, above 0 and below 1; 0: .95 */
    double lowest, highest; /* bounds of the integrand's values, lowest < highest; both 0: unknown */
    double
        share; /* what a point more or less may change an estimate by: the range of the values seen, divided by n; 0:
                     unknown. Only for the interval auto, which without it takes Student's */
} koksma_estimate_options;

typedef struct koksma_integral_estimate {
    double value, low, high; /* the estimate, which may lie outside the interval unless both are of one kind */
    double error;      /* the larger of high - value and value - low: the error of `value` with this confidence */
    double confidence; /* of the interval */
    const char *estimator, *interval; /* names of the members that were used; auto chooses them */
} koksma_integral_estimate;

/* Computes the estimate and the interval from n estimates by independent sets.
   The bootstrap draws 2000 resamples by hashes of their numbers, so that equal values give equal bits; its cost is
   2000 n log n, that of the others n log n.
   Errors: UNKNOWN (a name), ARGUMENT (a confidence or bounds out of range; a value that is not finite, or outside the
   bounds; an interval that needs bounds or more replicates), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_estimate_integral(const koksma_estimate_options *options, const double *values,
                                                  size_t n, const koksma_run *run, koksma_integral_estimate *out);

/* ---- As many points as a tolerance needs -------------------------------------------------------------- */

/* Computes the values of a function at points with coordinates in [0,1): values[i] at point i. It is called on the
   caller's thread, with sets of any size, in the same order for equal arguments. */
typedef koksma_status koksma_values_of(void *context, const koksma_points *points, double *values);

enum { KOKSMA_MAX_STEPS = 32 };

/* A struct of zeros has the defaults, and no tolerance: all steps are done. */
typedef struct koksma_tolerance_options {
    koksma_estimate_options estimate;
    double absolute, relative; /* the tolerance is the larger of `absolute` and `relative` times the least size of the
                                  integral in its interval; both are 0 or more */
    size_t replicates;         /* number R of independent sets, 2 to 100000; 0: see koksma_integrate_to */
    size_t first_n;            /* points of each set in the first step; 0: 64 of parts of one set, else 256 */
    uint64_t most_points;      /* limit of the points of all sets together; 0: 2^24 */
    uint64_t seed; /* set r has the seed `seed` + r; parts are of the set with this seed, their check of the next */
    const char *resume;   /* file that keeps the steps; NULL: none */
    const char *function; /* what the function is called in that file; NULL: - */
} koksma_tolerance_options;

/* A step: R sets of n points each. */
typedef struct koksma_tolerance_step {
    size_t n;
    uint64_t points; /* number of function values so far, of all sets and steps */
    koksma_integral_estimate estimate;
} koksma_tolerance_step;

typedef struct koksma_tolerance {
    bool reached;      /* whether the last step's error is within the tolerance */
    bool parts;        /* whether the R sets are parts of one set */
    size_t replicates; /* R */
    size_t n_steps;    /* steps done, at least 1 */
    koksma_tolerance_step steps[KOKSMA_MAX_STEPS];
    /* Slope of log error against log R n over the last steps, at most 5, with its standard error, and the number of points
       of points at which this line meets the tolerance, with its 95 % interval; NaN with fewer than three steps whose
       error is above 0, for errors that do not fall, and `needed` without a tolerance. Errors of successive steps
       depend on each other, so that the interval is approximate. */
    double rate, rate_error, needed, needed_low, needed_high;
    /* of all values that were computed: the extremes, and the share of the largest in the sum of absolute values. Above
       0.02 of at least 4096 values the integral may be infinite, or its peak narrow, and there is no rate */
    double least, largest, top_share;
} koksma_tolerance;

/* Integrates a function over [0,1)^dim: R sets of first_n points, twice as many in each further step, until the error
   is within the tolerance, or the next step exceeds most_points or what one set may have. Sequences with ranges are
   extended, so that no value is computed twice; the sets of other patterns are made anew for each step.

   Where replicates is 0, no estimator or interval is named, and the pattern is a sequence of nets in base 2
   (NET2_PREFIXES), the R = 8 sets are the consecutive parts of one set, with the mean and Student's interval: the error
   of the mean is that of one net of all points, the interval that of independent nets of n points, so that it is too wide
   rather than too narrow. One more set of n points, with the seed `seed` + 1, finds what all parts have alike: the error
   is at least what this check differs from the mean beyond its prediction interval. In all other cases the sets are
   independent, 15 where replicates is 0. With `resume` the steps are written to this file, each when it is done, and
   taken from it if it exists: a search that was interrupted or ended by its limit continues, with the result of one
   search bit for bit, and another tolerance, confidence, estimator or limit may be given. Its first value is computed
   again, to tell another function. The last interval holds with the stated confidence no matter when the search
   ends. Each step has this confidence if it is at least .9, with 6 replicates or more and an interval that is not
   `proved`: for normal estimates whose standard deviation falls at least as n^-1/2, all steps together then err with
   a probability below 1 - confidence (for 15 replicates and 95 %, in 2.9 %). Else it is divided by Bonferroni: with K
   steps allowed each interval misses with a probability of (1 - confidence) / K.  An interval of width 0 is widened
   by one point's share of the range of the values so far, (largest - least) / n, on both sides: functions with jumps
   give equal estimates that are off by less than that. While all values of the function have been equal, which tells
   nothing of rare peaks, no step but the last one ends the search before 2^16 points.  values, context  the function
   pattern          one whose sets are random and unbiased (koksma_is_unbiased) Errors: those of koksma_generate and
   koksma_estimate_integral; what `values` returns; ARGUMENT (a pattern with one set or not known to be unbiased; a
   value that is not finite, or outside the given bounds; a file of another search); MALFORMED (no file of a search),
   IO. */
KOKSMA_API koksma_status koksma_integrate_to(koksma_values_of *values, void *context, int dim,
                                             const koksma_spec *pattern, const koksma_tolerance_options *options,
                                             const koksma_run *run, koksma_tolerance *out);

/* A function that a program computes: the context of koksma_values_by_command. */
typedef struct koksma_values_command {
    const char *command; /* for the shell: a program that reads points, one a line of coordinates separated by blanks,
                              up to the end of its standard input, and prints as many values */
    double seconds;      /* time limit of each run, above 0 */
    const koksma_run *run; /* may be NULL; the command is ended when its keep_going returns false */
} koksma_values_command;

/* A koksma_values_of that runs a command, once for each 2^20 coordinates or fewer. It runs with the caller's permissions;
   all its processes are ended with it.
   Errors: MISSING (it can't be run), MALFORMED (it fails, takes too long, or prints something else than as many numbers as
   there are points), INTERRUPTED, MEMORY, SYSTEM. */
KOKSMA_API koksma_status koksma_values_by_command(void *context, const koksma_points *points, double *values);

#ifdef __cplusplus
}
#endif

#endif
