/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_optimise runs in steps of a fixed amount of work. In each step SEARCHES independent searches, each with its
 * own seed, start from the best set; they run on any number of threads. The best of their results (the first of equal
 * ones) becomes the new best set if it is better. koksma_evaluate measures every result; values that a method
 * computes are not used.
 *
 * Without a first set the search starts from the best of the listed patterns (start.c).
 *
 * The searches of a step, and the measures that they call, ask their run often. On the thread that called
 * koksma_optimise it asks the caller and looks at the clock; other threads see the answer. Searches of a step that ends
 * early return the best sets that they have so far. Which of them had begun depends on the threads and the clock, so
 * that no number of steps gives such a set again: its last_gain is the number of the step that was not completed.
 */
#include <koksma/optimise.h>

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "api/api.h"
#include "core/clock.h"
#include "core/lookup.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"
#include "measures/measures.h"
#include "optimise/search.h"

static const koksma_method *const methods[] = {
#define METHOD(name) &koksma__method_##name,
#include "optimise/methods.def"
#undef METHOD
};

KOKSMA__LOOKUP(koksma_method, methods)

enum { SEARCHES = 8, RANDOM_SHARE = 8, MOST_FIRST = 10 };

size_t koksma__searches_made = SEARCHES;

/* Searches ask the caller and the clock at most once in so many seconds. */
static const double PACE_S = 0.02;

typedef struct step {
    const koksma_spec *measure;
    const koksma_optimise_options *options;
    const koksma_method *method;
    const koksma_optimum *best;
    koksma_optimum *first; /* receives the first set */
    double *found;         /* results of SEARCHES searches */
    size_t piece;          /* number of doubles in the result of one search */
    const koksma_run *run;
    double start_s, end_s; /* end_s: when the step in progress is late; infinite before the first set is measured */
    double measured_s;     /* how long it took to measure the first set */
    double ended_s;        /* when the run was found late or stopped */
    pthread_t caller;      /* the thread that called koksma_optimise */
    double fraction;       /* of the step in progress, as koksma__parallel has reported it */
    koksma__pacing pacing; /* of the caller's thread while it searches */
    atomic_bool late, stopped; /* the time limit has passed; the caller wants to end the call */
} step;

/* Computes the value of a set, negated if larger values of the measure are better. */
static koksma_status evaluate(const koksma_spec *measure, const koksma_optimise_options *o,
                              const koksma_points *points, const koksma_run *run, double *value)
{
    const koksma_status status = koksma__search_value(measure, o, points, run, value);
    *value = measure->measure->larger_is_better ? -*value : *value;
    return status;
}

/* Returns the result of search i: its value, followed by its points. */
static double *piece(const step *s, size_t i)
{
    return s->found + i * s->piece;
}

/* Asks the caller, who is told the fraction of the run that is done, in steps or in time, and looks at the clock. */
static bool keep_going(void *context, double fraction)
{
    step *s = context;
    const uint64_t steps = s->options->steps;
    const double limit_s = s->run->time_limit_s, now_s = koksma__now_s();
    const double done = steps         ? ((double)s->best->steps + fraction) / (double)steps
                        : limit_s > 0 ? (now_s - s->start_s) / limit_s
                                      : 0;
    s->fraction = fraction;
    if (!s->stopped && !s->late) {
        s->ended_s = now_s;
    }
    if (!koksma__keep_going(s->run, fmin(done, 1))) {
        atomic_store(&s->stopped, true);
    } else if (now_s >= s->end_s) {
        atomic_store(&s->late, true);
    }
    return !s->stopped && !s->late;
}

/* The keep_going callback of searches and measures, on any thread. */
static bool search_goes_on(void *context, double fraction)
{
    (void)fraction;
    step *s = context;
    return pthread_equal(pthread_self(), s->caller) ? koksma__paced(&s->pacing, s->fraction)
                                                    : !atomic_load(&s->stopped) && !atomic_load(&s->late);
}

/* The keep_going callback for measuring a set after the end of the run: it may take twice the time that the first set
   took. */
static bool within_grace(void *context, double fraction)
{
    (void)fraction;
    const step *s = context;
    return koksma__now_s() < s->ended_s + 2 * s->measured_s + PACE_S;
}

/* Measures what a search had found when it was interrupted. *value is infinite if that is nothing, or cannot be measured
   in time. */
static void measure_partial(step *s, const koksma_points *points, double *value)
{
    const koksma_run run = {.threads = 1, .keep_going = within_grace, .context = s};
    const size_t bytes = (s->piece - 1) * sizeof(double);
    if (!memcmp(points->xs, s->best->points.xs, bytes) ||
        evaluate(s->measure, s->options, points, &run, value) != KOKSMA_OK) {
        *value = INFINITY;
    }
}

static koksma_status search(void *context, size_t i)
{
    step *s = context;
    const koksma_run run = {.threads = 1, .keep_going = search_goes_on, .context = s};
    const koksma_optimum *best = s->best;
    const uint64_t seed = koksma__random_seed(s->options->seed, best->steps * SEARCHES + i, 1);
    koksma_points points = {best->points.n, best->points.dim, piece(s, i) + 1};
    memcpy(points.xs, best->points.xs, (s->piece - 1) * sizeof(double));
    koksma_status status = s->method->search(s->measure, s->options, seed, best->value, &run, &points);
    status = status ? status : evaluate(s->measure, s->options, &points, &run, piece(s, i));
    if (status == KOKSMA_INTERRUPTED) {
        measure_partial(s, &points, piece(s, i));
        koksma__fail_interrupted();
    }
    return status;
}

/* Takes the best result of the searches of a step if it is better than the best set. */
static void take_best(step *s, koksma_optimum *best, bool done)
{
    const double sign = s->measure->measure->larger_is_better ? -1 : 1;
    best->steps += done;
    for (size_t i = 0; i < SEARCHES; i++) {
        if (*piece(s, i) < sign * best->value) {
            best->value = sign * *piece(s, i);
            best->last_gain = best->steps + !done;
            memcpy(best->points.xs, piece(s, i) + 1, (s->piece - 1) * sizeof(double));
        }
    }
}

/* Runs one step. If the time limit passes, the step does not count as done. */
static koksma_status take_step(step *s, koksma_optimum *best)
{
    const koksma_run run = {.threads = koksma__threads(s->run), .keep_going = keep_going, .context = s};
    for (size_t i = 0; i < SEARCHES; i++) {
        *piece(s, i) = INFINITY;
    }
    const koksma_status status = koksma__parallel(&run, koksma__searches_made, search, s);
    if (status && status != KOKSMA_INTERRUPTED) {
        return status;
    }
    take_best(s, best, !status);
    return s->stopped ? status : KOKSMA_OK;
}

/* Returns a lower bound of the value (NAN: none is known): the projections of n points on an axis have a star
   discrepancy of at least 1/(2n) and an extreme discrepancy of at least 1/n, and the discrepancies of the points
   themselves are no smaller. On a grid, the boxes of either can miss all of it. */
static double lower_bound(const koksma_spec *measure, const koksma_optimise_options *o)
{
    return koksma__search_of_prefixes(o) || o->n_projections                         ? (double)NAN
           : measure->measure == &koksma__measure_star && measure->params[0] == 0    ? 0.5 / (double)o->n
           : measure->measure == &koksma__measure_extreme && measure->params[0] == 0 ? 1 / (double)o->n
                                                                                     : (double)NAN;
}

/* Measures a set from which the search could start; the best one becomes the first set. */
static koksma_status consider(void *context, const koksma_points *points)
{
    step *s = context;
    koksma_optimum *best = s->first;
    const koksma_run run = {.threads = koksma__threads(s->run), .keep_going = search_goes_on, .context = s};
    const double sign = s->measure->measure->larger_is_better ? -1 : 1;
    double value;
    const koksma_status status =
        points ? evaluate(s->measure, s->options, points, &run, &value) : koksma__fail_interrupted();
    KOKSMA__TRY(status);
    if (value < sign * best->value) {
        best->value = sign * value;
        memcpy(best->points.xs, points->xs, (s->piece - 1) * sizeof(double));
    }
    return KOKSMA_OK;
}

/* Looks for a better first set among the listed patterns: until the time limit passes, and for an eighth of it among
   the random patterns, of which some take long. */
static koksma_status look_for_better(step *s)
{
    const koksma_run run = {.threads = koksma__threads(s->run), .keep_going = search_goes_on, .context = s};
    const double end_s = s->end_s;
    koksma_status status = KOKSMA_OK;
    for (int random = 0; random < 2 && !status; random++) {
        s->end_s = random ? fmin(end_s, koksma__now_s() + s->run->time_limit_s / RANDOM_SHARE) : end_s;
        s->end_s = s->run->time_limit_s > 0 ? s->end_s : end_s;
        status = koksma__search_starts(s->measure, s->options, random, &run, consider, s);
        status = status == KOKSMA_INTERRUPTED && !s->stopped ? KOKSMA_OK : status;
        s->late = s->late && koksma__now_s() >= end_s;
        s->pacing.stopped = s->late || s->stopped;
    }
    s->end_s = end_s;
    return status;
}

/* Makes and measures the first set, for which it takes up to ten times the time limit, and then, if the caller has given
   none, looks for a better one. */
static koksma_status find_first(step *s, koksma_optimum *out)
{
    const koksma_optimise_options *o = s->options;
    const koksma_run run = {.threads = koksma__threads(s->run), .keep_going = search_goes_on, .context = s};
    koksma_status status = KOKSMA_OK;
    if (o->first) {
        memcpy(out->points.xs, o->first->xs, (s->piece - 1) * sizeof(double));
    } else {
        status = koksma__search_default(o, s->run, &out->points);
    }
    status = status || o->keep != KOKSMA_KEEP_SEQUENCE ? status : koksma__sequence_check(&out->points);
    const double begin_s = koksma__now_s(), limit_s = s->run->time_limit_s;
    s->end_s = limit_s > 0 ? begin_s + MOST_FIRST * fmax(limit_s, 1) : (double)INFINITY;
    status = status ? status : evaluate(s->measure, o, &out->points, &run, &out->value);
    KOKSMA__FAIL_IF(
        status && s->late, KOKSMA_N,
        "%s: %zu points in %d dimensions: the first set alone takes more than %g s to measure; fewer points "
        "or a longer time limit would do",
        s->measure->measure->name, o->n, o->dim, MOST_FIRST * fmax(limit_s, 1));
    KOKSMA__TRY(status);
    out->value = s->measure->measure->larger_is_better ? -out->value : out->value;
    out->method = s->method->name;
    s->measured_s = koksma__now_s() - begin_s;
    s->end_s = limit_s > 0 ? s->start_s + limit_s : (double)INFINITY;
    s->first = out;
    return o->first || o->power ? KOKSMA_OK : look_for_better(s);
}

static koksma_status check(const koksma_spec *measure, const koksma_optimise_options *o, const koksma_method **method)
{
    KOKSMA__FAIL_IF(!measure->measure || measure->measure->answer != KOKSMA_ANSWER_EXACT, KOKSMA_ARGUMENT,
                    "%s: a search needs a measure with exact values, such as star or l2-star",
                    measure->measure ? measure->measure->name : "koksma_optimise");
    KOKSMA__FAIL_IF((unsigned)o->keep > KOKSMA_KEEP_PREFIXES, KOKSMA_ARGUMENT,
                    "koksma_optimise: keep = %d is not a value of koksma_keep", (int)o->keep);
    KOKSMA__TRY(koksma__search_check(o));
    const koksma_status status = o->first ? koksma__points_check(o->first) : KOKSMA_OK;
    KOKSMA__FAIL_IF(!status && o->first && (o->first->n != o->n || o->first->dim != o->dim), KOKSMA_N,
                    "the first set has %zu points of dim = %d, not %zu of %d", o->first->n, o->first->dim, o->n,
                    o->dim);
    int best = 0;
    for (size_t i = 0; koksma_method_at(i); i++) {
        const int serves = koksma_method_at(i)->serves(measure, o);
        if (serves > best) {
            best = serves;
            *method = koksma_method_at(i);
        }
    }
    return status;
}

static koksma_status run_steps(step *s, koksma_optimum *best)
{
    const koksma_optimise_options *o = s->options;
    koksma_status status = KOKSMA_OK;
    bool going = (!o->progress || o->progress(o->context, best)) && koksma__now_s() < s->end_s;
    while (!status && going && (o->steps == 0 || best->steps < o->steps)) {
        const uint64_t before = best->steps;
        status = take_step(s, best);
        if (best->last_gain > best->steps && o->progress) {
            o->progress(o->context, best); /* the step was not completed: the search ends in any case */
        }
        going = !status && best->steps > before && (!o->progress || o->progress(o->context, best)) &&
                koksma__now_s() < s->end_s;
    }
    return status;
}

koksma_status koksma_optimise(const koksma_spec *measure, const koksma_optimise_options *options,
                              const koksma_run *run, koksma_optimum *out)
{
    static const koksma_spec to_power = {.measure = &koksma__measure_radial_power};
    KOKSMA__REQUIRE(options, out);
    measure = options->power ? &to_power : measure;
    KOKSMA__REQUIRE(measure);
    KOKSMA__REQUIRE_RUN(run);
    static const koksma_run unlimited = {0};
    step s = {.measure = measure,
              .options = options,
              .best = out,
              .piece = options->n * (size_t)(options->dim > 0 ? options->dim : 0) + 1,
              .run = run ? run : &unlimited,
              .start_s = koksma__now_s(),
              .end_s = INFINITY,
              .caller = pthread_self(),
              .pacing = {.keep_going = keep_going, .context = &s, .interval_s = PACE_S}};
    *out = (koksma_optimum){.lower = lower_bound(measure, options)};
    koksma_status status = check(measure, options, &s.method);
    status = status ? status : koksma_points_init(&out->points, options->n, options->dim);
    status = status ? status : koksma__evaluate_check("koksma_optimise", measure, &out->points);
    s.found = status ? NULL : calloc(SEARCHES, s.piece * sizeof(double));
    if (!status && !s.found) {
        status = koksma__fail_memory(SEARCHES * s.piece * sizeof(double));
    }
    status = status ? status : find_first(&s, out);
    status = status ? status : run_steps(&s, out);
    free(s.found);
    /* before the first set is measured there is no result to keep */
    if (status && (status != KOKSMA_INTERRUPTED || !out->method)) {
        koksma_optimum_fini(out);
    }
    return status;
}

void koksma_optimum_fini(koksma_optimum *best)
{
    if (best) {
        koksma_points_fini(&best->points);
        *best = (koksma_optimum){0};
    }
}
