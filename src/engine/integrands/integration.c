/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Errors of integration over trials and sizes. With e_t the error of trial t and T the number of trials, the RMSE is
 * the root of the mean of e_t^2 over the trials; stats/mean_square.c has its interval. The slope of the RMSE is half the
 * slope of the mean squared errors. Its standard error follows from those of their logarithms and from the correlations
 * over the trials (stats/joint.c); Student's t has T - 1 degrees of freedom.
 *
 * Each set (one trial at one size) is an independent job. If there are fewer jobs than threads, the jobs run one
 * after the other, each on all threads; the bits are the same either way.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/verify.h>

#include "core/parallel.h"
#include "core/status.h"
#include "integrands/integrands.h"
#include "stats/stats.h"

enum { MOST_TRIALS = 1000000, BIAS_SETS = 64 };

static koksma_status check_options(const koksma_integration_options *o)
{
    KOKSMA__FAIL_IF(o->n_sizes < 1 || o->n_sizes > KOKSMA_MAX_SIZES, KOKSMA_ARGUMENT,
                    "koksma_integration_options: n_sizes: it takes 1 to %d", KOKSMA_MAX_SIZES);
    KOKSMA__FAIL_IF(o->trials < 1 || o->trials > MOST_TRIALS, KOKSMA_ARGUMENT,
                    "koksma_integration_options: trials: it takes 1 to %d", MOST_TRIALS);
    for (size_t i = 0; i < o->n_sizes; i++) {
        KOKSMA__FAIL_IF(o->sizes[i] < 1 || o->sizes[i] > KOKSMA_MAX_COORDINATES, KOKSMA_ARGUMENT,
                        "koksma_integration_options: sizes: it takes 1 to %zu points", KOKSMA_MAX_COORDINATES);
        for (size_t k = 0; k < i; k++) { /* two equal sizes would count as two of the slope's */
            KOKSMA__FAIL_IF(o->sizes[k] == o->sizes[i], KOKSMA_ARGUMENT, "n: %zu is given twice", o->sizes[i]);
        }
    }
    return KOKSMA_OK;
}

/* ---- The statistics ----------------------------------------------------------------------------------------- */

/* Statistics of the estimates for one size. */
static koksma_tally tally_of(const koksma_integration_options *o, const double *estimates, size_t size)
{
    koksma_tally tally = {0};
    for (uint64_t t = 0; t < o->trials; t++) {
        koksma_tally_add(&tally, estimates[t * o->n_sizes + size]);
    }
    return tally;
}

/* Returns the squared error of an estimate. If the integral is unknown, it is the squared difference from the mean of
   the estimates, times T / (T - 1). */
static double squared(double estimate, double value, const koksma_tally *tally)
{
    const double error = estimate - (isnan(value) ? tally->mean : value);
    return isnan(value) ? error * error * tally->count / (tally->count - 1) : error * error;
}

static koksma_integration_row row_of(const koksma_integration_options *o, size_t size, const koksma_tally *tally,
                                     const koksma__mean_square *square, double variance)
{
    const size_t n = o->sizes[size];
    return (koksma_integration_row){.n = n,
                                    .trials = o->trials,
                                    .mean = tally->mean,
                                    .sd = koksma_tally_sd(tally),
                                    .rmse = sqrt(square->value),
                                    .low = sqrt(square->low),
                                    .high = sqrt(square->high),
                                    .gain = variance / (double)n / square->value,
                                    .approximate = square->approximate};
}

/* The level of 4 standard deviations on one side, P(Z > 4) of the normal law, and that of all rows together. */
#define BEYOND_4 3.167124183311986e-5
#define TOGETHER 0.0005

/* Returns the distance of the mean from the integral in standard errors; NaN where it says nothing. */
static double z_of(const koksma_integration_row *row, double value, double least)
{
    const double off = row->mean - value;
    return row->trials > 1 && fabs(off) > least ? off / (row->sd / sqrt((double)row->trials)) : (double)NAN;
}

/* Estimates that are 0 but for rare trials have a deviation that is too small, or 0, as long as these are missing. Where
   the interval is approximate, the mean must therefore be off by 4 standard errors of random points, too. */
static bool is_biased(const koksma_integration_options *o, const koksma_integration_row *row, double value,
                      double variance)
{
    const double level = fmin(BEYOND_4, TOGETHER / (double)(o->tests > o->n_sizes ? o->tests : o->n_sizes));
    const double random = sqrt(variance / ((double)row->n * (double)row->trials));
    return !isnan(row->z) && fabs(row->z) > koksma__student_quantile(1 - level, (double)row->trials - 1) &&
           (!row->approximate || fabs(row->mean - value) > 4 * random);
}

/* Returns the threshold below which errors count as rounding: 2^-44 of the largest among the integral, the values of
   the function and the estimates. */
static double rounding(const koksma_integration_options *o, const double *estimates, double value, double variance)
{
    double scale = fmax(isnan(value) ? 0 : fabs(value), isnan(variance) ? 0 : sqrt(variance));
    for (size_t i = 0; i < o->trials * o->n_sizes; i++) {
        scale = fmax(scale, fabs(estimates[i]));
    }
    return 0x1p-44 * scale;
}

/* The spread over the trials of the squared errors at all sizes. */
static koksma_joint joint_of(const koksma_integration_options *o, const double *estimates, double value,
                             const koksma_tally *tallies)
{
    koksma_joint joint = {0};
    double squares[KOKSMA_MAX_SIZES];
    for (uint64_t t = 0; t < o->trials; t++) {
        for (size_t i = 0; i < o->n_sizes; i++) {
            squares[i] = squared(estimates[t * o->n_sizes + i], value, &tallies[i]);
        }
        koksma_joint_add(&joint, o->n_sizes, squares);
    }
    return joint;
}

/* Fits the slope to the mean squared errors. Those that may consist only of rounding errors are set to NaN, and the fit
   ignores them. */
static void fit_slope(const koksma_integration_options *o, const koksma_joint *joint,
                      const koksma__mean_square *squares, double least, koksma_integration_slope *s)
{
    double sizes[KOKSMA_MAX_SIZES], means[KOKSMA_MAX_SIZES], errors[KOKSMA_MAX_SIZES], spread = 0;
    koksma_line line;
    for (size_t i = 0; i < o->n_sizes; i++) {
        const bool fits = sqrt(squares[i].value) > least;
        sizes[i] = (double)o->sizes[i];
        means[i] = fits ? squares[i].value : (double)NAN;
        errors[i] = squares[i].log_error;
        spread += fits ? squares[i].relative_variance : 0;
    }
    *s = (koksma_integration_slope){0, NAN, NAN, NAN, NAN, false};
    if (koksma_joint_line(joint, o->n_sizes, sizes, means, &line)) {
        const bool trials = o->trials > 1;
        const double half = koksma_student_975(trials ? (size_t)o->trials - 1 : line.count - 2);
        s->count = line.count;
        s->value = line.slope / 2;
        s->standard_error =
            (trials ? koksma__joint_error(joint, o->n_sizes, sizes, means, errors) : line.slope_error) / 2;
        s->low = s->value - half * s->standard_error;
        s->high = s->value + half * s->standard_error;
        s->approximate = trials && !(spread / (double)line.count <= KOKSMA__TOO_SPREAD);
    }
}

koksma_status koksma_integration_summary(double value, double variance, const koksma_integration_options *options,
                                         const double *estimates, koksma_integration *out)
{
    KOKSMA__REQUIRE(options, estimates, out);
    KOKSMA__TRY(check_options(options));
    const double least = rounding(options, estimates, value, variance);
    koksma_tally tallies[KOKSMA_MAX_SIZES];
    koksma__mean_square squares[KOKSMA_MAX_SIZES];
    for (size_t i = 0; i < options->n_sizes; i++) {
        tallies[i] = tally_of(options, estimates, i);
        squares[i] = koksma__mean_square_of(estimates + i, options->trials, options->n_sizes, value);
        out->rows[i] = row_of(options, i, &tallies[i], &squares[i], variance);
        out->rows[i].z = z_of(&out->rows[i], value, least);
        const bool gains = out->rows[i].rmse > least && !is_biased(options, &out->rows[i], value, variance);
        out->rows[i].gain = gains ? out->rows[i].gain : (double)NAN;
    }
    const koksma_joint joint = joint_of(options, estimates, value, tallies);
    fit_slope(options, &joint, squares, least, &out->slope);
    out->bias[0] = 0;
    return KOKSMA_OK;
}

/* ---- Sets of a pattern -------------------------------------------------------------------------------------- */

typedef struct job {
    const koksma_integral *f;
    const koksma_spec *pattern;
    const koksma_integration_options *options;
    const koksma_run *run; /* of a set */
    double *estimates;
} job;

/* Runs job number `block`; the jobs are in order of decreasing size of the sets. */
static koksma_status integrate_set(void *context, size_t block)
{
    const job *j = context;
    const size_t n_sizes = j->options->n_sizes, last = j->options->trials * n_sizes - 1 - block;
    koksma_points points;
    KOKSMA__TRY(koksma_points_init(&points, j->options->sizes[last % n_sizes], j->f->dim));
    koksma_status status = koksma_generate(j->pattern, j->options->seed + last / n_sizes, j->run, &points);
    status = status ? status : koksma_integrate(j->f, &points, j->run, &j->estimates[last]);
    koksma_points_fini(&points);
    return status;
}

static bool estimates_are_equal(const koksma_integration_options *o, const double *estimates)
{
    bool equal = true;
    for (size_t i = o->n_sizes; i < o->trials * o->n_sizes; i++) {
        equal = equal && estimates[i] == estimates[i % o->n_sizes];
    }
    return equal;
}

/* Returns whether the pattern gives the same set for all seeds; some patterns have this property without claiming it.
   Two seeds may have the same set by chance: mirror=1 gives four sets in two dimensions. */
static koksma_status has_one_set(const job *j, bool *one)
{
    const koksma_integration_options *o = j->options;
    const size_t bytes = o->sizes[0] * (size_t)j->f->dim * sizeof(double);
    koksma_points first, other;
    *one = true;
    KOKSMA__TRY(koksma_points_init(&first, o->sizes[0], j->f->dim));
    koksma_status status = koksma_points_init(&other, o->sizes[0], j->f->dim);
    status = status ? status : koksma_generate(j->pattern, o->seed, j->run, &first);
    for (uint64_t t = 1; t < o->trials && !status && *one; t++) {
        status = koksma_generate(j->pattern, o->seed + t, j->run, &other);
        *one = !status && !memcmp(first.xs, other.xs, bytes);
    }
    koksma_points_fini(&first);
    koksma_points_fini(&other);
    return status;
}

/* Tests whether the sets are biased. An integrand may hide a bias, as a symmetrical one does. */
static koksma_status look_for_bias(const job *j, koksma_integration *out)
{
    const koksma_integration_options *o = j->options;
    const size_t count = o->trials < BIAS_SETS ? (size_t)o->trials : BIAS_SETS;
    size_t n = o->sizes[0];
    for (size_t i = 1; i < o->n_sizes; i++) {
        n = o->sizes[i] < n ? o->sizes[i] : n;
    }
    if (o->trials < KOKSMA_VERIFY_SETS || koksma_is_unbiased(j->pattern)) {
        return KOKSMA_OK;
    }
    koksma_points sets[BIAS_SETS] = {{0}};
    koksma_findings findings = {0};
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < count && !status; i++) {
        status = koksma_points_init(&sets[i], n, j->f->dim);
        status = status ? status : koksma_generate(j->pattern, o->seed + i, j->run, &sets[i]);
    }
    status = status ? status : koksma_verify_sets(sets, count, j->run, &findings);
    if (!status && !findings.items[0].holds) { /* unbiased is the first finding */
        memcpy(out->bias, findings.items[0].detail, sizeof out->bias);
        for (size_t i = 0; i < o->n_sizes; i++) {
            out->rows[i].gain = NAN;
        }
    }
    for (size_t i = 0; i < count; i++) {
        koksma_points_fini(&sets[i]);
    }
    koksma_findings_fini(&findings);
    return status;
}

/* The keep_going callback within a set: it asks the caller whether to stop, but reports no fraction, because progress
   is counted in sets. */
static bool go_on(void *context, double fraction)
{
    (void)fraction;
    return koksma__keep_going(context, 0);
}

koksma_status koksma_integration_errors(const koksma_integral *integral, const koksma_spec *pattern,
                                        const koksma_integration_options *options, const koksma_run *run,
                                        koksma_integration *out)
{
    KOKSMA__REQUIRE(integral, pattern, options, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check_options(options));
    KOKSMA__FAIL_IF(!pattern->pattern, KOKSMA_ARGUMENT, "koksma_integration_errors: it takes the spec of a pattern");
    koksma_integration_options o = *options;
    o.trials = koksma_has_one_set(pattern) ? 1 : o.trials;
    KOKSMA__FAIL_IF(o.trials - 1 > UINT64_MAX - o.seed, KOKSMA_ARGUMENT,
                    "seed %llu: %llu trials end at this seed + %llu, but seeds end at "
                    "%llu; %llu or less would do",
                    (unsigned long long)o.seed, (unsigned long long)o.trials, (unsigned long long)o.trials - 1,
                    (unsigned long long)UINT64_MAX, (unsigned long long)(UINT64_MAX - (o.trials - 1)));
    const size_t jobs = (size_t)o.trials * o.n_sizes;
    const bool together = jobs >= (size_t)koksma__threads(run);
    const koksma_run one = {.threads = 1},
                     all = {.threads = run ? run->threads : 0, .keep_going = go_on, .context = (void *)run};
    job j = {integral, pattern, &o, together ? &one : &all, calloc(jobs, sizeof(double))};
    KOKSMA__REQUIRE_MEMORY(j.estimates, jobs * sizeof *j.estimates);
    koksma_run outer = run ? *run : (koksma_run){0};
    outer.threads = together ? outer.threads : 1;
    koksma_status status = koksma__parallel(&outer, jobs, integrate_set, &j);
    bool one_set = false;
    j.run = &all;
    if (!status && o.trials > 1 && estimates_are_equal(&o, j.estimates)) {
        status = has_one_set(&j, &one_set);
        o.trials = one_set ? 1 : o.trials;
    }
    koksma_integral_facts facts;
    koksma_integral_about(integral, &facts);
    status = status ? status : koksma_integration_summary(facts.value, facts.variance, &o, j.estimates, out);
    free(j.estimates);
    return status ? status : look_for_bias(&j, out);
}
