/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Integrates to a tolerance: R sets, whose number of points doubles until the interval for the integral is narrow enough.
 * They are independent random sets, or by default the PARTS consecutive parts of one scrambled net of N = PARTS n points.
 * The mean of R independent nets has the error of one net of N points times R^(a - 1/2), if that falls as N^-a; parts of
 * one net cost no such factor. Their spread is that of nets of n points, and Student's interval from it as wide as that
 * of independent ones, since the mean of the parts errs by the Walsh coefficients that N points don't integrate, while the
 * parts differ by those that n points don't, which come first (Hickernell & Jimenez Rugama 2016 bound the former by some
 * of the latter). What one net can't show is a coefficient that all its points have alike, as products of |x - 1/2|
 * get from one linear scrambling of some fifteen: a CHECK beside the parts, an independent set of n points, finds it.
 * The error is at least what that differs from the mean of the parts beyond its prediction interval of the same
 * confidence. docs/findings/coverage.md has how often all this holds.
 *
 * The points of several sets are put into batches of up to BATCH points or COORDINATES coordinates, so that functions of
 * other programs and languages are called seldom. The sums of each set are compensated and in the order of its points,
 * so that batches and threads change no bit.
 */
#include <math.h>
#include <stdlib.h>

#include <koksma/estimate.h>
#include <koksma/series.h>

#include "core/parallel.h"
#include "core/spec.h"
#include "core/status.h"
#include "core/sum.h"
#include "integrands/tolerance_path.h"
#include "stats/stats.h"

enum {
    REPLICATES = 15,
    PARTS = 8,
    MOST_REPLICATES = 100000,
    FIRST_N = 256,
    FIRST_PART = 64,
    BATCH = 1 << 16,
    COORDINATES = 1 << 22,
    ENOUGH = 1 << 16,
    FITTED = 5,
    LEAST_EACH = 6
};

static const uint64_t LEAST_KNOWN = 4096; /* values, of which one has at most this share of the sum: */
static const double MOST_OF_ONE = 0.02;
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
    bool parts;           /* the sets are parts of one set, which extends */
    size_t replicates, n; /* n: of the present step */
    size_t sets;          /* replicates, and the check of parts */
    int dim;
    koksma__search path; /* the steps so far; its sums are those of the values of each set */
    uint64_t points;
    double least, largest; /* of all values so far */
    double sizes;          /* the sum of their absolute values */
} job;

/* Part of a set: points first .. first + count - 1 of the set `replicate`. */
typedef struct piece {
    size_t replicate, first, count;
} piece;

static uint64_t seed_of(const job *j, const piece *p)
{
    return j->options->seed + (j->parts ? p->replicate == PARTS : p->replicate);
}

/* The index of a piece's first point in the set of its seed. */
static uint64_t index_of(const job *j, const piece *p)
{
    return p->first + (j->parts && p->replicate < PARTS ? (uint64_t)p->replicate * j->n : 0);
}

static koksma_status make(const job *j, const piece *p, koksma_points *out)
{
    const size_t n = j->parts ? j->replicates * j->n : j->n;
    return j->extends ? koksma_generate_range(j->pattern, seed_of(j, p), n, index_of(j, p), &j->in_step, out)
                      : koksma_generate(j->pattern, seed_of(j, p), &j->in_step, out);
}

static koksma_status add(job *j, const piece *p, const double *values)
{
    const koksma_estimate_options *o = &j->options->estimate;
    const bool bounded = o->lowest != 0 || o->highest != 0;
    for (size_t i = 0; i < p->count; i++) {
        KOKSMA__FAIL_IF(!isfinite(values[i]), KOKSMA_ARGUMENT,
                        "the value of the function is %g at point %llu of the set with seed %llu", values[i],
                        (unsigned long long)(index_of(j, p) + i), (unsigned long long)seed_of(j, p));
        KOKSMA__FAIL_IF(bounded && !(values[i] >= o->lowest && values[i] <= o->highest), KOKSMA_ARGUMENT,
                        "the value of the function is %.17g, outside the bounds %g and %g", values[i], o->lowest,
                        o->highest);
        koksma__sum_add(&j->path.sums[p->replicate], values[i]);
        j->least = fmin(j->least, values[i]);
        j->largest = fmax(j->largest, values[i]);
        j->sizes += fabs(values[i]);
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

/* Two parts of the step before are one of this step. */
static void join_parts(job *j)
{
    koksma__sum *sums = j->path.sums;
    for (size_t r = 0; r < PARTS; r++) {
        const koksma__sum *second = &sums[2 * r + 1];
        sums[r] = r < PARTS / 2 ? sums[2 * r] : (koksma__sum){0};
        if (r < PARTS / 2) {
            koksma__sum_add(&sums[r], second->total);
            koksma__sum_add(&sums[r], second->lost);
        }
    }
}

/* Adds points from .. n - 1 to all sets, or makes them anew; or the second half of the parts. */
static koksma_status extend(job *j, size_t from)
{
    const size_t fresh = j->n - (j->extends && !j->parts ? from : 0);
    const size_t most = COORDINATES / j->dim < BATCH ? (size_t)(COORDINATES / j->dim) : BATCH;
    const size_t length = j->extends && fresh > most ? most : fresh, at_once = length < most ? most / length : 1;
    piece *pieces = calloc(at_once, sizeof *pieces);
    koksma_points batch = {0};
    koksma_status status =
        pieces ? koksma_points_init(&batch, at_once * length, j->dim) : koksma__fail_memory(at_once * sizeof *pieces);
    double *values = status ? NULL : malloc(batch.n * sizeof *values);
    status = status || values ? status : koksma__fail_memory(batch.n * sizeof *values);
    size_t count = 0;
    const bool join = j->parts && from;
    if (join) {
        join_parts(j);
    }
    for (size_t r = join ? PARTS / 2 : 0; r < j->sets && !status; r++) {
        const size_t begin = j->extends && !(j->parts && r < PARTS) ? from : 0;
        j->path.sums[r] = j->extends ? j->path.sums[r] : (koksma__sum){0};
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
    t->least = j->least;
    t->largest = j->largest;
    t->top_share = j->sizes > 0 ? fmax(fabs(j->least), fabs(j->largest)) / j->sizes : 0;
    if (j->points >= LEAST_KNOWN && t->top_share > MOST_OF_ONE) {
        return; /* errors that hang on a few values have no rate */
    }
    for (size_t i = 0; i < count; i++) {
        points[i] = (double)j->sets * (double)t->steps[first + i].n;
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
    const uint64_t most = j->options->most_points ? j->options->most_points : MOST_POINTS, most_n = most / j->sets,
                   capacity = j->extends ? KOKSMA_MAX_INDEX / (j->parts ? PARTS : 1)
                                         : KOKSMA_MAX_COORDINATES / (unsigned)j->dim;
    KOKSMA__FAIL_IF(
        first_n > most_n || first_n > capacity, KOKSMA_ARGUMENT,
        "%zu sets of n = %zu points are more than --max-points (max_points), %llu, or than one set may have", j->sets,
        first_n, (unsigned long long)most);
    *steps = 1;
    for (uint64_t n = first_n; 2 * n <= most_n && 2 * n <= capacity && *steps < KOKSMA_MAX_STEPS; n *= 2) {
        ++*steps;
    }
    return KOKSMA_OK;
}

/* Whether parts of one set are the default: of nets in base 2 each part is a net, too. */
static bool takes_parts(const koksma_spec *pattern, const koksma_tolerance_options *o)
{
    return !o->replicates && !o->estimate.estimator && !o->estimate.interval && koksma_is_sequence(pattern) &&
           koksma_has_ranges(pattern) && koksma__claims_left(pattern, 1) & KOKSMA_CLAIM_NET2_PREFIXES;
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

/* Widens the interval of parts to what their check tells: Student's t sd sqrt(1 + 1 / PARTS) of its prediction is 3 times
   its t sd / sqrt PARTS. Then an interval of width 0. */
static void widen(const job *j, double check, koksma_integral_estimate *e)
{
    const double apart = j->parts ? fabs(check - e->value) - sqrt(PARTS + 1) * e->error : 0;
    if (apart > e->error) {
        e->error = apart;
        e->low = e->value - apart;
        e->high = e->value + apart;
    }
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

/* Makes step k, or takes it from the file of an earlier search. */
static koksma_status take_step(job *j, size_t k)
{
    const size_t before = j->n;
    j->n = k ? 2 * before : j->path.first_n;
    if (k < j->path.n_steps) {
        const koksma__search_step *step = &j->path.steps[k];
        const koksma_estimate_options *o = &j->options->estimate;
        KOKSMA__FAIL_IF(
            (o->lowest != 0 || o->highest != 0) && !(step->least >= o->lowest && step->largest <= o->highest),
            KOKSMA_ARGUMENT, "the values of the function, %.17g to %.17g, are outside the bounds %g and %g",
            step->least, step->largest, o->lowest, o->highest);
        j->points = step->points;
        j->least = step->least;
        j->largest = step->largest;
        return KOKSMA_OK;
    }
    KOKSMA__TRY(extend(j, before));
    koksma__search_step *step = &j->path.steps[k];
    *step = (koksma__search_step){.points = j->points, .least = j->least, .largest = j->largest};
    step->means = malloc(j->sets * sizeof *step->means);
    KOKSMA__REQUIRE_MEMORY(step->means, j->sets * sizeof *step->means);
    j->path.n_steps = k + 1;
    for (size_t r = 0; r < j->sets; r++) {
        step->means[r] = koksma__sum_value(&j->path.sums[r]) / (double)j->n;
    }
    return j->options->resume ? koksma__search_write(j->options->resume, &j->path) : KOKSMA_OK;
}

static koksma_status run_steps(job *j, size_t steps, koksma_tolerance *t)
{
    koksma_estimate_options estimate = j->options->estimate;
    estimate.confidence = step_confidence(j, steps);
    estimate.interval = j->parts ? "student" : estimate.interval;
    for (size_t k = 0; k < steps && !t->reached; k++) {
        const koksma_status status = take_step(j, k);
        KOKSMA__FAIL_IF(status == KOKSMA_N && k, status, "%s; the tolerance is out of reach of n = %zu",
                        koksma_error_text(), (size_t)t->steps[k - 1].n);
        KOKSMA__TRY(status);
        estimate.share = share_of(j);
        koksma_tolerance_step *step = &t->steps[t->n_steps++];
        *step = (koksma_tolerance_step){.n = j->n, .points = j->points};
        KOKSMA__TRY(
            koksma_estimate_integral(&estimate, j->path.steps[k].means, j->replicates, &j->in_step, &step->estimate));
        widen(j, j->path.steps[k].means[j->sets - 1], &step->estimate);
        t->reached = is_reached(j, &step->estimate);
        j->done = (double)(k + 1) / (double)steps;
    }
    predict(j, t);
    return KOKSMA_OK;
}

/* Opens the path: what identifies the search, with the value at its first point, and the steps of the file `resume`. */
static koksma_status open_path(job *j)
{
    const koksma_tolerance_options *o = j->options;
    j->path.sums = calloc(j->sets, sizeof *j->path.sums);
    KOKSMA__REQUIRE_MEMORY(j->path.sums, j->sets * sizeof *j->path.sums);
    if (!o->resume) {
        return KOKSMA_OK;
    }
    koksma_points points;
    double value;
    KOKSMA__TRY(koksma_points_init(&points, j->extends ? 1 : j->path.first_n, j->dim));
    j->n = j->path.first_n;
    koksma_status status = make(j, &(piece){0, 0, 1}, &points);
    j->n = 0;
    points.n = 1;
    if (!status) {
        const char kept = koksma__call_begin();
        status = koksma__call_end(kept, j->values(j->context, &points, &value), "values");
    }
    koksma_points_fini(&points);
    KOKSMA__TRY(status);
    char pattern[KOKSMA_MAX_SPEC];
    koksma_spec_text(j->pattern, pattern);
    koksma__search_head(&j->path, o->function ? o->function : "-", pattern, j->dim, o->seed, j->parts, value);
    return koksma__search_read(o->resume, &j->path);
}

koksma_status koksma_integrate_to(koksma_values_of *values, void *context, int dim, const koksma_spec *pattern,
                                  const koksma_tolerance_options *options, const koksma_run *run,
                                  koksma_tolerance *out)
{
    KOKSMA__REQUIRE(pattern, options, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!values, KOKSMA_ARGUMENT, "koksma_integrate_to: values is NULL");
    KOKSMA__TRY(check(pattern, options, dim));
    const bool parts = takes_parts(pattern, options);
    const size_t replicates = options->replicates ? options->replicates : parts ? PARTS : REPLICATES;
    job j = {.values = values,
             .context = context,
             .pattern = pattern,
             .options = options,
             .run = run,
             .extends = koksma_is_sequence(pattern) && koksma_has_ranges(pattern),
             .parts = parts,
             .replicates = replicates,
             .sets = replicates + parts,
             .path = {.sets = replicates + parts,
                      .first_n = options->first_n ? options->first_n
                                 : parts          ? FIRST_PART
                                                  : FIRST_N},
             .dim = dim,
             .least = HUGE_VAL,
             .largest = -HUGE_VAL};
    j.in_step = (koksma_run){.threads = run ? run->threads : 0, .keep_going = go_on, .context = &j};
    size_t steps = 0;
    KOKSMA__TRY(count_steps(&j, j.path.first_n, &steps));
    koksma_tolerance *t = calloc(1, sizeof *t);
    koksma_status status = t ? open_path(&j) : koksma__fail_memory(sizeof *t);
    status = status ? status : run_steps(&j, steps, t);
    if (!status) {
        t->replicates = replicates;
        t->parts = parts;
        *out = *t;
    }
    free(t);
    koksma__search_fini(&j.path);
    return status;
}
