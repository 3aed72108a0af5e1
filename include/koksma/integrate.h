/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Numerical integration: test functions with known integrals over the unit cube, and the error of the mean over a
 * point set. Part of libkoksma.
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
#include <koksma/mask.h>
#include <koksma/series.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A function on [0,1]^dim with its parameters and known properties. Opaque. */
typedef struct koksma_integral koksma_integral;

/* An integrand: a row of the table that `koksma list integrands` prints. */
typedef struct koksma_integrand {
    const char *name, *title, *cite; /* cite: keys of docs/references.bib, separated by blanks */
    const char *known;               /* how the integral was obtained, such as "closed form" */
    int min_dim, max_dim;
    int axes;                                            /* number of leading coordinates on which the function
                                                            depends; 0: on all */
    const koksma_param *params;                          /* NULL: none */
    koksma_status (*prepare)(koksma_integral *integral); /* computes the known properties (koksma_integral_facts)
                                                            for dim and parameters */
    double (*at)(const koksma_integral *integral, const double *x); /* returns the value at x, which has dim
                                                                       coordinates */
    const void *constants;                                          /* private data of the integrand; may be NULL */
    int revision;                                                   /* as koksma_pattern.revision (koksma.h) */
} koksma_integrand;

/* Returns integrand i of the table, or the integrand with this name, or NULL if there is none. */
KOKSMA_API const koksma_integrand *koksma_integrand_at(size_t i);
KOKSMA_API const koksma_integrand *koksma_integrand_find(const char *name);

/* An integrand that the caller provides. */
typedef struct koksma_function {
    const char *name; /* 1 to 63 characters */
    int min_dim, max_dim;
    double (*at)(const double *x, int dim, void *context); /* returns the value at x, where 0 <= x[k] <= 1. The value
                                                              must depend on x alone. Several threads call the
                                                              function at once unless koksma_run.threads is 1 */
    void *context;                                         /* passed to at */
    double integral; /* the integral over [0,1]^dim, or NaN if it is not known */
} koksma_function;

/* Opens an integrand in dim dimensions; allocates out.
     text  a spec, "name" or "name:key=value,key=value"
   Errors: UNKNOWN (the name; the message suggests the nearest one), ARGUMENT (a parameter), DIM, MEMORY. */
KOKSMA_API koksma_status koksma_integral_open(const char *text, int dim, koksma_integral **out);

/* Opens a function that the caller provides as an integrand in dim dimensions; *function is copied. Errors:
   ARGUMENT (the name or the function is missing), DIM, MEMORY. */
KOKSMA_API koksma_status koksma_integral_of_function(const koksma_function *function, int dim, koksma_integral **out);

/* Frees an integrand; it may be NULL. */
KOKSMA_API void koksma_integral_close(koksma_integral *integral);

/* The known properties of an integrand. Unknown numbers are NaN. */
typedef struct koksma_integral_facts {
    char text[KOKSMA_MAX_SPEC]; /* the canonical spec */
    int dim, axes;              /* axes: number of leading coordinates on which it depends */
    double value;               /* the integral */
    double variance;            /* the integral of (f - value)^2 */
    double variation; /* variation in the sense of Hardy and Krause, anchored at 1, as in Koksma's inequality; may
                         be infinite */
    double lowest, highest; /* lower and upper bounds of the function values; tight if the range has a simple
                               form */
} koksma_integral_facts;

KOKSMA_API void koksma_integral_about(const koksma_integral *integral, koksma_integral_facts *facts);

/* Computes the value at each point, or the mean over all points.
     points  of the integrand's dimension, with coordinates in [0,1]
     values  receives points->n numbers
   Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_integral_values(const koksma_integral *integral, const koksma_points *points,
                                                const koksma_run *run, double *values);
KOKSMA_API koksma_status koksma_integrate(const koksma_integral *integral, const koksma_points *points,
                                          const koksma_run *run, double *out);

/* ---- Errors against the number of points -------------------------------------------------------------- */

/* Statistics of the estimates of an integral by sets of n points. */
typedef struct koksma_integration_row {
    size_t n;
    uint64_t trials; /* number of point sets; always 1 for a deterministic pattern */
    double mean, sd; /* mean and standard deviation of the estimates; sd is NaN with one set */
    double rmse;     /* root mean square of estimate minus integral; with one set the absolute error. If the integral
                        is not known, rmse is set to sd, which estimates it if the estimates are unbiased */
    /* 95 % confidence interval of rmse by chi-squared, with degrees of freedom from the kurtosis and the skewness of
       the errors; NaN with one set */
    double low, high;
    double gain; /* variance / n / rmse^2: how many times as many random points would be needed for this error, or NaN
                    if the variance is not known, the error is only rounding, z says that the estimates are biased, or
                    the sets are (koksma_integration.bias) */
    double z; /* mean minus integral, divided by the standard error of the mean, sd / sqrt(trials); NaN with one set,
                    if the integral is not known, and if the difference is only rounding. The estimates are taken as
                    biased if z is beyond the two-sided quantile of Student's t at the level of 4 standard deviations
                    (6.3e-5), or of .001 divided by koksma_integration_options.tests if that is less, and, where the
                    interval is approximate, the difference is beyond 4 standard errors of random points, too */
    bool
        approximate; /* whether the interval may hold rmse less often than in 93 % of cases: there are fewer than 16 sets,
                         or their errors are so skewed or heavy-tailed that the variance of their squares is more than
                         twice that of normal errors. False with one set. In simulations of 8 to 128 sets the intervals hold
                         in 95 to 98 % for nearly normal errors, in 76 to 99 % for skewed or heavy-tailed ones and in 98 to
                         99.9 % for uniform ones */
} koksma_integration_row;

/* The slope of log rmse against log n by least squares, with its 95 % interval. With several trials the standard
   error comes from those of log rmse and from the correlations of the squared errors at different sizes; with one set
   it comes from the residuals. The fit leaves out sizes whose rmse is only rounding: below 2^-44 of the integral, of
   the largest estimate or of the root of the variance. All numbers are NaN if fewer than three sizes are left. */
typedef struct koksma_integration_slope {
    size_t count; /* number of sizes used */
    double value, standard_error, low, high;
    bool approximate; /* as that of a row, by the mean over the sizes, for any number of sets */
} koksma_integration_slope;

typedef struct koksma_integration {
    koksma_integration_row rows[KOKSMA_MAX_SIZES];
    koksma_integration_slope slope;
    char bias
        [200]; /* what koksma_verify_sets found if the sets are biased; else empty. Tested with up to 64 sets of the
                       smallest size of koksma_integration_errors, if the trials are KOKSMA_VERIFY_SETS or more and the
                       pattern is not known to be unbiased (koksma_is_unbiased) */
} koksma_integration;

typedef struct koksma_integration_options {
    size_t sizes[KOKSMA_MAX_SIZES];
    size_t n_sizes;  /* 1 to KOKSMA_MAX_SIZES different sizes; row i of the result is for sizes[i] points */
    uint64_t seed;   /* trial t uses seed + t; the last may be UINT64_MAX */
    uint64_t trials; /* number of point sets of each size, 1 to 1000000 */
    size_t tests; /* number of rows that are judged together, of all calls, among which the level of z is shared; less
                        than n_sizes: those of this call */
} koksma_integration_options;

/* Generates sets of each size and integrates over them.
   Errors: those of koksma_generate and koksma_integrate, ARGUMENT (a bad option). */
KOKSMA_API koksma_status koksma_integration_errors(const koksma_integral *integral, const koksma_spec *pattern,
                                                   const koksma_integration_options *options, const koksma_run *run,
                                                   koksma_integration *out);

/* Computes the statistics of koksma_integration_errors from estimates that the caller provides.
     value, variance  integral and variance of the integrand, or NaN if not known
     options          its seed has no effect
     estimates        trials * n_sizes numbers: estimates[t * n_sizes + i] is the estimate of trial t at size i
   Errors: ARGUMENT, MEMORY. */
KOKSMA_API koksma_status koksma_integration_summary(double value, double variance,
                                                    const koksma_integration_options *options,
                                                    const double *estimates, koksma_integration *out);

/* ---- Errors over a screen ----------------------------------------------------------------------------- */

enum { KOKSMA_SCREEN_MAX_DIM = 4, KOKSMA_SCREEN_MAX_SIDE = 512, KOKSMA_SCREEN_MAX_SPP = 256 };

typedef struct koksma_screen_options {
    int dim;    /* coordinates of the integrands, 1 to KOKSMA_SCREEN_MAX_DIM */
    int side;   /* pixels a side of the image, up to KOKSMA_SCREEN_MAX_SIDE; z-sampler takes powers of two */
    size_t spp; /* samples a pixel, 1 to KOKSMA_SCREEN_MAX_SPP */
    koksma_mask_filter filter; /* width and height are at most side / 2; need not be normalised */
    uint64_t seed;             /* image t has the seed + t */
    uint64_t trials;           /* number of images, 1 to 4096 */
} koksma_screen_options;

/* Errors for 100 integrands of `coordinates` of the coordinates, as root mean squares over integrands and images. Each
   number has its standard error over the images, NaN with one image. */
typedef struct koksma_screen_row {
    int coordinates;
    double plain, plain_error; /* error of a pixel in units of that of as many random points */
    double blurred,
        blurred_error; /* error after the filter, in units of that of white noise with the same plain error */
} koksma_screen_row;

/* Measures how much of the error a filter over the screen leaves, for steps, ramps, boxes, products and Genz's families
   with random parameters that no pattern of the library was made with.
     pattern  a pattern of images (with a parameter `width`, which is set to options->side) or of tiles (mask-offset,
              mask-file): one set has all pixels. Any other: each pixel has a set with a seed of its own. A pattern of
              fewer dimensions fills the coordinates in groups, each with another seed, and from the second on with the
              samples of each pixel in a random order
     rows     receives options->dim rows, for 1, 2 .. options->dim coordinates
   Cost: trials * side^2 * spp * dim * 100 values. Errors: those of koksma_generate and koksma_mask_filter_check,
   ARGUMENT, DIM, N. */
KOKSMA_API koksma_status koksma_screen_errors(const koksma_spec *pattern, const koksma_screen_options *options,
                                              const koksma_run *run, koksma_screen_row *rows);

#ifdef __cplusplus
}
#endif

#endif
