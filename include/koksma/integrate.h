/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Integration: functions whose integral over the unit cube is known, the error of the mean over points, and the share
 * of a function's variance that each projection carries. Part of libkoksma.
 *
 *     koksma_integral *f;
 *     koksma_spec sobol;
 *     koksma_integration_options options = {.sizes = {16, 64, 256}, .n_sizes = 3, .trials = 32};
 *     koksma_integration result;
 *     if (!koksma_integral_open("genz-gaussian:difficulty=5", 4, &f) &&
 *         !koksma_pattern_spec("sobol:scramble=owen", &sobol) &&
 *         !koksma_integration_errors(f, &sobol, &options, NULL, &result)) {
 *         printf("RMSE %g at n = 256, slope %g\n", result.rows[2].rmse, result.slope.value);
 *     }
 *     koksma_integral_close(f);
 */
#ifndef KOKSMA_INTEGRATE_H
#define KOKSMA_INTEGRATE_H

#include <koksma/koksma.h>
#include <koksma/series.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A function on [0,1]^dim with its parameters, and what is known of it. Opaque. */
typedef struct koksma_integral koksma_integral;

/* A line of `koksma list integrands`. */
typedef struct koksma_integrand {
    const char *name, *title, *cite; /* cite: keys of docs/references.bib, separated by blanks */
    const char *known;               /* how its integral is known, as "closed form" */
    int min_dim, max_dim;
    int axes;                                            /* it depends on so many leading coordinates; 0: on all */
    const koksma_param *params;                          /* NULL: none */
    koksma_status (*prepare)(koksma_integral *integral); /* computes what is known for dim and parameters */
    double (*at)(const koksma_integral *integral, const double *x); /* the value; x as in koksma_points */
    const void *constants;                                          /* of the member's file; may be NULL */
    int revision;                                                   /* as of a pattern (koksma.h) */
} koksma_integrand;

/* Returns integrand i of the table, or the integrand with this name; NULL if there is none. */
KOKSMA_API const koksma_integrand *koksma_integrand_at(size_t i);
KOKSMA_API const koksma_integrand *koksma_integrand_find(const char *name);

/* A function of the caller, or of a shared library: a library for `koksma integrate ./LIBRARY.so` exports

       const koksma_function *koksma_function_at(size_t i);

   which returns function i, NULL past the last. Functions and names stay valid while the library is loaded. */
typedef struct koksma_function {
    const char *name; /* of 1 to 63 characters */
    int min_dim, max_dim;
    double (*at)(const double *x, int dim, void *context); /* the value at x, 0 <= x[k] <= 1. It depends on x alone;
                                                              several threads call it at once unless koksma_run says
                                                              otherwise */
    void *context;                                         /* passed to at */
    double integral;                                       /* over [0,1]^dim; NaN: not known */
} koksma_function;

/* Opens an integrand in dim dimensions; allocates out.
     text  a spec, "name" or "name:key=value,key=value"
   Errors: UNKNOWN (the name; the message suggests the nearest one), ARGUMENT (a parameter), DIM, MEMORY. */
KOKSMA_API koksma_status koksma_integral_open(const char *text, int dim, koksma_integral **out);

/* Opens a function of the caller as an integrand in dim dimensions; *function is copied. Errors: ARGUMENT (no name or
   function), DIM, MEMORY. */
KOKSMA_API koksma_status koksma_integral_of_function(const koksma_function *function, int dim, koksma_integral **out);

/* integral may be NULL. */
KOKSMA_API void koksma_integral_close(koksma_integral *integral);

/* What is known. Unknown numbers are NaN. */
typedef struct koksma_integral_facts {
    char text[KOKSMA_MAX_SPEC]; /* the canonical spec */
    int dim, axes;              /* axes: it depends on so many leading coordinates */
    double value;               /* the integral */
    double variance;            /* the integral of the squared difference from it */
    double variation; /* in the sense of Hardy and Krause, anchored at 1, as Koksma's inequality has it; infinite
                               where no grid's rectangles are small enough */
    double lowest, highest; /* bounds of its values; the closest ones where the range is simple */
} koksma_integral_facts;

KOKSMA_API void koksma_integral_about(const koksma_integral *integral, koksma_integral_facts *facts);

/* Computes the value at each point, or the mean over all points.
     points  of the integral's dim, coordinates in [0,1]
     values  receives points->n numbers
   Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_integral_values(const koksma_integral *integral, const koksma_points *points,
                                                const koksma_run *run, double *values);
KOKSMA_API koksma_status koksma_integrate(const koksma_integral *integral, const koksma_points *points,
                                          const koksma_run *run, double *out);

/* ---- Errors over randomisations and sizes ------------------------------------------------------------- */

/* The estimates by sets of n points. */
typedef struct koksma_integration_row {
    size_t n;
    uint64_t trials; /* sets; of a pattern that is deterministic always 1 */
    double mean, sd; /* of the estimates; sd NaN with one set */
    double rmse;     /* root mean square of estimate minus integral. Where the integral is not known, sd: without bias
                        the same. With one set the absolute error */
    double low,
        high;    /* 95 % interval of rmse over all sets (delta method on its logarithm, Student's t); NaN with one
                         set */
    double gain; /* variance / n / rmse^2: how many times more random points give this error; NaN if not known, or if
                         the error is rounding */
} koksma_integration_row;

/* The slope of log rmse against log n by least squares, with its 95 % interval: from the trials as koksma_joint_line,
   of one set from the residuals. Sizes whose rmse is rounding take no part: below 2^-44 of the integral, the
   largest estimate or the root of the variance. All NaN with fewer than three sizes left. */
typedef struct koksma_integration_slope {
    size_t count; /* sizes used */
    double value, standard_error, low, high;
} koksma_integration_slope;

typedef struct koksma_integration {
    koksma_integration_row rows[KOKSMA_MAX_SIZES];
    koksma_integration_slope slope;
} koksma_integration;

typedef struct koksma_integration_options {
    size_t sizes[KOKSMA_MAX_SIZES];
    size_t n_sizes;  /* 1 to KOKSMA_MAX_SIZES; row i is of sizes[i] points */
    uint64_t seed;   /* trial t has seed + t */
    uint64_t trials; /* 1 to 1000000 sets of each size */
} koksma_integration_options;

/* Generates sets of each size and integrates over them.
   Errors: those of koksma_generate and koksma_integrate, ARGUMENT (options). */
KOKSMA_API koksma_status koksma_integration_errors(const koksma_integral *integral, const koksma_spec *pattern,
                                                   const koksma_integration_options *options, const koksma_run *run,
                                                   koksma_integration *out);

/* Computes the same from estimates that the caller has.
     value, variance  of the integrand; NaN: not known
     options          its seed has no effect
     estimates        trials * n_sizes numbers: that of trial t and size i is estimates[t * n_sizes + i]
   Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_integration_summary(double value, double variance,
                                                    const koksma_integration_options *options,
                                                    const double *estimates, koksma_integration *out);

/* ---- Analysis of variance ----------------------------------------------------------------------------- */

/* A part of the variance, 0 to 1, and its 95 % interval; both ends equal value where it is exact. */
typedef struct koksma_share {
    double value, low, high;
} koksma_share;

/* Sobol' indices of a set u of coordinates. */
typedef struct koksma_sensitivity {
    koksma_share component; /* of the ANOVA component of exactly u: of one coordinate its first-order index */
    koksma_share closed;    /* of all components within u: Var(E(f | x_u)) / Var(f) */
    koksma_share total;     /* of all components that meet u */
    double variance;        /* of the integrand; an estimate unless exact */
    bool exact; /* by a closed form; else by pick-freeze estimates (Saltelli et al. 2010, Jansen 1999) over
                               16 Owen-scrambled Sobol' sets, whose spread gives the interval */
} koksma_sensitivity;

enum { KOKSMA_MAX_ANOVA_AXES = 8 };

/* Computes them for the coordinates axes[0] .. axes[n_axes - 1], numbered from 0.
     n_axes   1 to KOKSMA_MAX_ANOVA_AXES different ones below dim. An exact component takes 2^n_axes closed forms, an
              estimated one as many evaluations of each sample
     samples  points in each of the 16 sets, up to 2^20; 0: the closed form where there is one, else 4096
   Errors: ARGUMENT (axes, samples, a function without variance), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_integral_sensitivity(const koksma_integral *integral, const int *axes, size_t n_axes,
                                                     size_t samples, uint64_t seed, const koksma_run *run,
                                                     koksma_sensitivity *out);

/* Opens the ANOVA component of the coordinates axes[0] .. axes[n_axes - 1] as an integral of its own, 0; allocates out. The
   errors of all components add up to that of the integrand, so that koksma_integration_errors of them shows which
   projections of a pattern make it.
     n_axes  1 to KOKSMA_MAX_ANOVA_AXES different ones, below the axes of the integrand
   Errors: ARGUMENT (axes), UNSUPPORTED (the integrand is no product of functions of one coordinate), MEMORY. */
KOKSMA_API koksma_status koksma_integral_component(const koksma_integral *integral, const int *axes, size_t n_axes,
                                                   koksma_integral **out);

#ifdef __cplusplus
}
#endif

#endif
