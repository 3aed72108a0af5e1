/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_optimise: steps of a fixed amount of work. A step hands the best set to SEARCHES searches of the method, with
 * a seed each, which know nothing of each other and run on any number of threads; the best of their results, the first
 * of equals, is the new best if it is better. Every result is measured by koksma_evaluate: a method's own opinion of a
 * set decides nothing.
 */
#include <koksma/optimise.h>

#include <math.h>
#include <string.h>

#include "api/evaluate.h"
#include "core/clock.h"
#include "core/parallel.h"
#include "core/points_io.h"
#include "core/status.h"
#include "measures/measures.h"
#include "optimise/methods.h"

enum { SEARCHES = 8 };

typedef struct step {
    const koksma_spec *measure;
    const koksma_optimise_options *options;
    const koksma_method *method;
    const koksma_optimum *best;
    koksma_points found[SEARCHES];
    double values[SEARCHES];
    const koksma_run *run;
    double start_s;
} step;

static koksma_status evaluate(const koksma_spec *measure, const koksma_points *points, double *value)
{
    const koksma_run run = {.threads = 1};
    koksma_value result;
    const koksma_status status = koksma_evaluate(measure, points, &run, &result);
    *value = measure->measure->larger_is_better ? -result.value : result.value;
    return status;
}

static koksma_status search(void *context, size_t block)
{
    step *s = context;
    const koksma_optimum *best = s->best;
    const uint64_t seed = koksma__random_seed(s->options->seed, best->steps * SEARCHES + block, 1);
    memcpy(s->found[block].xs, best->points.xs, best->points.n * (size_t)best->points.dim * sizeof(double));
    const koksma_status status = s->method->search(s->measure, s->options->keep, seed, best->value, &s->found[block]);
    return status ? status : evaluate(s->measure, &s->found[block], &s->values[block]);
}

/* The share of the whole search: of its steps, or of its time. */
static bool keep_going(void *context, double fraction)
{
    const step *s = context;
    const uint64_t steps = s->options->steps;
    const double limit_s = s->run->time_limit_s;
    const double done = steps         ? ((double)s->best->steps + fraction) / (double)steps
                        : limit_s > 0 ? (koksma__now_s() - s->start_s) / limit_s
                                      : 0;
    return koksma__keep_going(s->run, fmin(done, 1));
}

static koksma_status take_step(step *s, koksma_optimum *best)
{
    const koksma_run run = {.threads = koksma__threads(s->run), .keep_going = keep_going, .context = s};
    const koksma_status status = koksma__parallel(&run, SEARCHES, search, s);
    if (status) {
        return status;
    }
    const double sign = s->measure->measure->larger_is_better ? -1 : 1;
    best->steps++;
    for (size_t i = 0; i < SEARCHES; i++) {
        if (s->values[i] < sign * best->value) {
            best->value = sign * s->values[i];
            best->last_gain = best->steps;
            memcpy(best->points.xs, s->found[i].xs, best->points.n * (size_t)best->points.dim * sizeof(double));
        }
    }
    return KOKSMA_OK;
}

/* A coordinate of n points on the line alone forces 1/2n of the star discrepancy and 1/n of the extreme one. */
static double lower_bound(const koksma_spec *measure, size_t n)
{
    return measure->measure == &koksma__measure_star      ? 0.5 / (double)n
           : measure->measure == &koksma__measure_extreme ? 1 / (double)n
                                                          : (double)NAN;
}

static koksma_status first_set(const koksma_optimise_options *o, const koksma_run *run, koksma_points *points)
{
    koksma_spec spec;
    if (o->first) {
        memcpy(points->xs, o->first->xs, o->n * (size_t)o->dim * sizeof(double));
        return KOKSMA_OK;
    }
    const koksma_status status = koksma_pattern_spec(o->keep == KOKSMA_KEEP_NET ? "sobol" : "latin-hypercube", &spec);
    return status ? status : koksma_generate(&spec, o->seed, run, points);
}

static koksma_status check(const koksma_spec *measure, const koksma_optimise_options *o, const koksma_method **method)
{
    if (!measure->measure || measure->measure->answer != KOKSMA_ANSWER_EXACT) {
        return koksma__fail(KOKSMA_ARGUMENT, "%s: it takes a measure with exact values, as star is",
                            measure->measure ? measure->measure->name : "koksma_optimise");
    }
    if (o->keep != KOKSMA_KEEP_NONE && o->keep != KOKSMA_KEEP_LATIN && o->keep != KOKSMA_KEEP_NET) {
        return koksma__fail(KOKSMA_ARGUMENT, "koksma_optimise: keep = %d is none of koksma_keep", (int)o->keep);
    }
    const koksma_status status = o->first ? koksma__points_check(o->first) : KOKSMA_OK;
    if (!status && o->first && (o->first->n != o->n || o->first->dim != o->dim)) {
        return koksma__fail(KOKSMA_N, "the first set has %zu points of dim = %d, not %zu of %d", o->first->n,
                            o->first->dim, o->n, o->dim);
    }
    int best = 0;
    for (size_t i = 0; koksma_method_at(i); i++) {
        const int serves = koksma_method_at(i)->serves(measure, o->n, o->dim, o->keep);
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
    bool going = !o->progress || o->progress(o->context, best);
    while (!status && going && (o->steps == 0 || best->steps < o->steps)) {
        status = take_step(s, best);
        going = !status && (!o->progress || o->progress(o->context, best)) &&
                !(s->run->time_limit_s > 0 && koksma__now_s() - s->start_s >= s->run->time_limit_s);
    }
    return status;
}

koksma_status koksma_optimise(const koksma_spec *measure, const koksma_optimise_options *options,
                              const koksma_run *run, koksma_optimum *out)
{
    KOKSMA__REQUIRE(measure, options, out);
    KOKSMA__REQUIRE_RUN(run);
    static const koksma_run unlimited = {0};
    step s = {.measure = measure,
              .options = options,
              .best = out,
              .run = run ? run : &unlimited,
              .start_s = koksma__now_s()};
    *out = (koksma_optimum){.lower = lower_bound(measure, options->n)};
    koksma_status status = check(measure, options, &s.method);
    status = status ? status : koksma_points_init(&out->points, options->n, options->dim);
    status = status ? status : koksma__evaluate_check("koksma_optimise", measure, &out->points);
    for (size_t i = 0; i < SEARCHES && !status; i++) {
        status = koksma_points_init(&s.found[i], options->n, options->dim);
    }
    status = status ? status : first_set(options, s.run, &out->points);
    status = status ? status : evaluate(measure, &out->points, &out->value);
    if (!status) {
        out->value = measure->measure->larger_is_better ? -out->value : out->value;
        out->method = s.method->name;
        status = run_steps(&s, out);
    }
    for (size_t i = 0; i < SEARCHES; i++) {
        koksma_points_fini(&s.found[i]);
    }
    if (status && status != KOKSMA_INTERRUPTED) {
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
