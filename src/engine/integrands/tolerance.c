/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Integrates to a tolerance: R independent random sets, whose number of points doubles until the interval for the integral
 * is narrow enough. The points of several sets are put into batches of up to BATCH points or COORDINATES coordinates, so
 * that functions of other programs and languages are called seldom. The sums of each set are compensated and in the order
 * of its points, so that batches and threads change no bit.
 */
#include <math.h>
#include <stdlib.h>

#include <koksma/estimate.h>
#include <koksma/series.h>

#include "core/parallel.h"
#include "core/status.h"
#include "core/sum.h"
#include "stats/stats.h"

enum {
    REPLICATES = 15,
    MOST_REPLICATES = 100000,
    FIRST_N = 256,
    BATCH = 1 << 16,
    COORDINATES = 1 << 22,
    ENOUGH = 1 << 16,
    FITTED = 5,
    LEAST_EACH = 6
};

static const uint64_t MOST_POINTS = UINT64_C(1) << 24;

typedef struct job {
    koksma_values_of *values;
    void *context;
    const koksma_spec *pattern;
    const koksma_tolerance_options *options;
    const koksma_run *run; /* of the caller; in_step is that of all calls within a step */
    koksma_run in_step;
    double done;          /* fraction of the steps */
    bool extends;         /* the sets of a step begin with those of the step before */
    size_t replicates, n; /* n: of the present step */
    int dim;
    koksma__sum *sums; /* of the values of each set */
    double *means;
    uint64_t points;
    double least, largest; /* of all values so far */
} job;

/* Part of a set: points first .. first + count - 1 of the set `replicate`. */
typedef struct piece {
    size_t replicate, first, count;
} piece;

static koksma_status make(const job *j, const piece *p, koksma_points *out)
{
    const uint64_t seed = j->options->seed + p->replicate;
    return j->extends ? koksma_generate_range(j->pattern, seed, j->n, p->first, &j->in_step, out)
                      : koksma_generate(j->pattern, seed, &j->in_step, out);
}

static koksma_status add(job *j, const piece *p, const double *values)
{
    const koksma_estimate_options *o = &j->options->estimate;
    const bool bounded = o->lowest != 0 || o->highest != 0;
    for (size_t i = 0; i < p->count; i++) {
        KOKSMA__FAIL_IF(!isfinite(values[i]), KOKSMA_ARGUMENT,
                        "the value of the function is %g at point %zu of the set with seed %llu", values[i],
                        p->first + i, (unsigned long long)(j->options->seed + p->replicate));
        KOKSMA__FAIL_IF(bounded && !(values[i] >= o->lowest && values[i] <= o->highest), KOKSMA_ARGUMENT,
                        "the value of the function is %.17g, outside the bounds %g and %g", values[i], o->lowest,
                        o->highest);
        koksma__sum_add(&j->sums[p->replicate], values[i]);
        j->least = fmin(j->least, values[i]);
        j->largest = fmax(j->largest, values[i]);
    }
    j->points += p->count;
    return KOKSMA_OK;
}

/* Evaluates some pieces as one batch; `points` and `values` have room for them. */
static koksma_status evaluate(job *j, const piece *pieces, size_t count, double *xs, double *values)
{
    koksma_points batch = {.n = 0, .dim = j->dim, .xs = xs};
    for (size_t p = 0; p < count; p++) {
        koksma_points part = {.n = pieces[p].count, .dim = j->dim, .xs = xs + batch.n * (size_t)j->dim};
        KOKSMA__TRY(make(j, &pieces[p], &part));
        batch.n += part.n;
    }
    KOKSMA__TRY(koksma__ask(&j->in_step));
    const char kept = koksma__call_begin();
    KOKSMA__TRY(koksma__call_end(kept, j->values(j->context, &batch, values), "values"));
    for (size_t p = 0; p < count; p++) {
        KOKSMA__TRY(add(j, &pieces[p], values));
        values += pieces[p].count;
    }
    return KOKSMA_OK;
}

/* Adds points from .. n - 1 to all sets, or makes them anew. */
static koksma_status extend(job *j, size_t from)
{
    const size_t begin = j->extends ? from : 0, fresh = j->n - begin;
    const size_t most = COORDINATES / j->dim < BATCH ? (size_t)(COORDINATES / j->dim) : BATCH;
    const size_t length = j->extends && fresh > most ? most : fresh, at_once = length < most ? most / length : 1;
    piece *pieces = calloc(at_once, sizeof *pieces);
    koksma_points batch = {0};
    koksma_status status =
        pieces ? koksma_points_init(&batch, at_once * length, j->dim) : koksma__fail_memory(at_once * sizeof *pieces);
    double *values = status ? NULL : malloc(batch.n * sizeof *values);
    status = status || values ? status : koksma__fail_memory(batch.n * sizeof *values);
    size_t count = 0;
    for (size_t r = 0; r < j->replicates && !status; r++) {
        j->sums[r] = j->extends ? j->sums[r] : (koksma__sum){0};
        for (size_t first = begin; first < j->n && !status; first += length) {
            pieces[count++] = (piece){r, first, j->n - first < length ? j->n - first : length};
            if (count == at_once) {
                status = evaluate(j, pieces, count, batch.xs, values);
                count = 0;
            }
        }
    }
    status = status || !count ? status : evaluate(j, pieces, count, batch.xs, values);
    free(pieces);
    free(values);
    koksma_points_fini(&batch);
    return status;
}

static double tolerance_of(const koksma_tolerance_options *o, const koksma_integral_estimate *e)
{
    return fmax(o->absolute, o->relative * fmax(fabs(e->value) - e->error, 0));
}

static bool is_reached(const job *j, const koksma_integral_estimate *e)
{
    const koksma_tolerance_options *o = j->options;
    const bool wanted = o->absolute > 0 || o->relative > 0, seen = j->least < j->largest || j->points >= ENOUGH;
    return wanted && seen && e->error <= tolerance_of(o, e);
}

/* Fits the rate to the last steps, and extrapolates to the tolerance. */
static void predict(const job *j, koksma_tolerance *t)
{
    const size_t count = t->n_steps < FITTED ? t->n_steps : FITTED, first = t->n_steps - count;
    double points[FITTED], errors[FITTED];
    koksma_line line;
    t->rate = t->rate_error = t->needed = t->needed_low = t->needed_high = NAN;
    for (size_t i = 0; i < count; i++) {
        points[i] = (double)j->replicates * (double)t->steps[first + i].n;
        errors[i] = t->steps[first + i].estimate.error;
    }
    if (!koksma_log_line(count, points, errors, &line)) {
        return;
    }
    t->rate = line.slope;
    t->rate_error = line.slope_error;
    const koksma__estimate needed = koksma__reach(&line, points[count - 1], errors[count - 1],
                                                  tolerance_of(j->options, &t->steps[t->n_steps - 1].estimate));
    t->needed = needed.value;
    t->needed_low = needed.low;
    t->needed_high = needed.high;
}

/* The number of steps that the limits allow, or 0 after an error. */
static koksma_status count_steps(const job *j, size_t first_n, size_t *steps)
{
    const uint64_t most = j->options->most_points ? j->options->most_points : MOST_POINTS,
                   most_n = most / j->replicates,
                   capacity = j->extends ? KOKSMA_MAX_INDEX : KOKSMA_MAX_COORDINATES / (unsigned)j->dim;
    KOKSMA__FAIL_IF(first_n > most_n || first_n > capacity, KOKSMA_ARGUMENT,
                    "first_n: %zu sets of %zu points are more than most_points, %llu, or than one set may have",
                    j->replicates, first_n, (unsigned long long)most);
    *steps = 1;
    for (uint64_t n = first_n; 2 * n <= most_n && 2 * n <= capacity && *steps < KOKSMA_MAX_STEPS; n *= 2) {
        ++*steps;
    }
    return KOKSMA_OK;
}

static koksma_status check(const koksma_spec *pattern, const koksma_tolerance_options *o, int dim)
{
    char text[KOKSMA_MAX_SPEC];
    koksma_spec_text(pattern, text);
    KOKSMA__FAIL_IF(dim < 1 || dim > KOKSMA_MAX_DIM, KOKSMA_DIM, "dim: it takes 1 to %d dimensions, not %d",
                    KOKSMA_MAX_DIM, dim);
    KOKSMA__FAIL_IF(!pattern->pattern, KOKSMA_ARGUMENT, "pattern: it takes the spec of a pattern");
    KOKSMA__FAIL_IF(koksma_has_one_set(pattern), KOKSMA_ARGUMENT,
                    "pattern: %s has one set, whose error no interval knows; shift=1 or a scramble makes it random",
                    text);
    KOKSMA__FAIL_IF(!koksma_is_unbiased(pattern), KOKSMA_ARGUMENT,
                    "pattern: %s is not known to be unbiased, so that intervals may be around a wrong value; shift=1 "
                    "makes it so",
                    text);
    KOKSMA__FAIL_IF(!(o->absolute >= 0 && isfinite(o->absolute) && o->relative >= 0 && isfinite(o->relative)),
                    KOKSMA_ARGUMENT, "absolute, relative: a tolerance is 0 or more, not %g or %g", o->absolute,
                    o->relative);
    KOKSMA__FAIL_IF(o->replicates == 1 || o->replicates > MOST_REPLICATES, KOKSMA_ARGUMENT,
                    "replicates: it takes 2 to %d, not %zu", MOST_REPLICATES, o->replicates);
    const size_t replicates = o->replicates ? o->replicates : REPLICATES;
    KOKSMA__FAIL_IF(replicates - 1 > UINT64_MAX - o->seed, KOKSMA_ARGUMENT,
                    "seed: %zu replicates from %llu on exceed the last seed, 2^64 - 1", replicates,
                    (unsigned long long)o->seed);
    return KOKSMA_OK;
}

/* What a point more or less may change an estimate by. */
static double share_of(const job *j)
{
    return (j->largest - j->least) / (double)j->n;
}

/* Widens an interval of width 0. */
static void widen(const job *j, koksma_integral_estimate *e)
{
    const double share = e->low < e->high ? 0 : share_of(j);
    e->low -= share;
    e->high += share;
    e->error = fmax(e->error, share);
}

/* The keep_going within a step, whose calls know only fractions of their own. */
static bool go_on(void *context, double fraction)
{
    const job *j = context;
    (void)fraction;
    return koksma__keep_going(j->run, j->done);
}

/* The confidence of each step's interval. Intervals that are proved share theirs over all steps, by Bonferroni. The others
   have it in each step: a step errs where its estimate is off by more than the tolerance while the interval seems narrow
   enough. For normal estimates both are independent, and if the standard deviation falls at least as n^-1/2 the
   probabilities of all steps together are at most 0.80 of 1 - confidence for 6 replicates, 0.58 for 15 and 0.88 for
   1,000 at 95 %, and below 1 from 90 % on: only one or two steps have both a narrow interval and a large error. */
static double step_confidence(const job *j, size_t steps)
{
    const koksma_estimate_options *o = &j->options->estimate;
    const koksma_interval *interval = o->interval ? koksma_interval_find(o->interval) : NULL;
    const double confidence = o->confidence == 0 ? 0.95 : o->confidence;
    const bool each = j->replicates >= LEAST_EACH && confidence >= 0.9 && !(interval && interval->proved);
    return each ? confidence : 1 - (1 - confidence) / (double)steps;
}

static koksma_status run_steps(job *j, size_t n, size_t steps, koksma_tolerance *t)
{
    koksma_estimate_options estimate = j->options->estimate;
    estimate.confidence = step_confidence(j, steps);
    for (size_t k = 0; k < steps && !t->reached; k++) {
        const size_t before = j->n;
        j->n = k ? 2 * before : n;
        KOKSMA__TRY(extend(j, before));
        for (size_t r = 0; r < j->replicates; r++) {
            j->means[r] = koksma__sum_value(&j->sums[r]) / (double)j->n;
        }
        estimate.share = share_of(j);
        koksma_tolerance_step *step = &t->steps[t->n_steps++];
        *step = (koksma_tolerance_step){.n = j->n, .points = j->points};
        KOKSMA__TRY(koksma_estimate_integral(&estimate, j->means, j->replicates, &j->in_step, &step->estimate));
        widen(j, &step->estimate);
        t->reached = is_reached(j, &step->estimate);
        j->done = (double)(k + 1) / (double)steps;
    }
    predict(j, t);
    return KOKSMA_OK;
}

koksma_status koksma_integrate_to(koksma_values_of *values, void *context, int dim, const koksma_spec *pattern,
                                  const koksma_tolerance_options *options, const koksma_run *run,
                                  koksma_tolerance *out)
{
    KOKSMA__REQUIRE(pattern, options, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!values, KOKSMA_ARGUMENT, "koksma_integrate_to: values is NULL");
    KOKSMA__TRY(check(pattern, options, dim));
    job j = {.values = values,
             .context = context,
             .pattern = pattern,
             .options = options,
             .run = run,
             .extends = koksma_is_sequence(pattern) && koksma_has_ranges(pattern),
             .replicates = options->replicates ? options->replicates : REPLICATES,
             .dim = dim,
             .least = HUGE_VAL,
             .largest = -HUGE_VAL};
    j.in_step = (koksma_run){.threads = run ? run->threads : 0, .keep_going = go_on, .context = &j};
    const size_t n = options->first_n ? options->first_n : FIRST_N;
    size_t steps;
    KOKSMA__TRY(count_steps(&j, n, &steps));
    koksma_tolerance *t = calloc(1, sizeof *t);
    j.sums = calloc(j.replicates, sizeof *j.sums);
    j.means = calloc(j.replicates, sizeof *j.means);
    koksma_status status =
        t && j.sums && j.means ? run_steps(&j, n, steps, t) : koksma__fail_memory(j.replicates * sizeof *j.sums);
    if (!status) {
        *out = *t;
    }
    free(t);
    free(j.sums);
    free(j.means);
    return status;
}
