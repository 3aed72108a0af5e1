/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Measures the samplers at several sizes over several trials. A job is one trial of one sampler at one size, on
 * one thread. Each job stores its values in its own array elements; they are added up afterwards in the order of
 * trials, as in `koksma measure --sizes --trials`, so that the numbers equal those of that command to the last
 * bit. A sampler whose set is the same for every seed has one trial. Its values are exact and have no interval; its slope
 * has the error of the residuals, as has the slope of any single set.
 *
 * Samplers are compared by Welch's test (1947) on means over trials, each at a level of 5 % divided by the number
 * of tests (Bonferroni), so that all decisions of a sheet hold together with 95 %. An exact value has no error: beside it
 * the test is that of Student for the other sampler's mean. Means of sets that never vary are compared exactly.
 */
#include "study/sheet/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "stats/stats.h"
#include "study/run/run_control.h"

/* ---- Evaluation -------------------------------------------------------------------------------------------- */

typedef struct evaluation {
    koksma__sheet_values *values;
    const koksma__run_control *control;     /* whose `job` asks within a set whether to go on, on any thread */
    size_t trials;                          /* the largest number of trials of any sampler */
    size_t n, kept[KOKSMA__SHEET_MEASURES]; /* the number of measures; the indices of those that stay */
    double *found;         /* a value's index is ((sampler * sizes + size) * trials + trial) * n + measure */
    unsigned char *status; /* has the same indices as `found`; 0: a value, 1: a bound, 2: no value */
} evaluation;

static koksma_status evaluate_set(void *context, size_t job)
{
    const evaluation *e = context;
    koksma__sheet_values *v = e->values;
    const size_t t = job % e->trials, i = job / e->trials % v->n_sizes, s = job / e->trials / v->n_sizes;
    const koksma__sheet_sampler *sampler = v->samplers[s];
    const koksma_run *alone = &e->control->job;
    koksma_points points = {0};
    if (t >= v->trials[s]) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__sheet_points(sampler, v->sizes[i], v->dim, t, alone, &points);
    for (size_t m = 0; m < e->n && !status; m++) {
        koksma_value value = {.value = NAN};
        const koksma_status found = koksma_evaluate(&v->measures[m].spec, &points, alone, &value);
        const bool none = found != KOKSMA_OK;
        status = found == KOKSMA_INTERRUPTED ? found : KOKSMA_OK;
        e->found[job * e->n + m] = value.value;
        e->status[job * e->n + m] = none ? 2 : !value.exact;
    }
    koksma_points_fini(&points);
    return status;
}

/* Adds a note that says why a measure is left out: the error of the first set for which the measure has no value. */
static void note_missing(koksma__sheet *sheet, const evaluation *e, size_t m)
{
    koksma__sheet_values *v = e->values;
    for (size_t job = 0; job < v->n_samplers * v->n_sizes * e->trials; job++) {
        koksma_points points = {0};
        koksma_value value;
        const size_t t = job % e->trials, i = job / e->trials % v->n_sizes, s = job / e->trials / v->n_sizes;
        if (e->status[job * e->n + m] == 2 &&
            !koksma__sheet_points(v->samplers[s], v->sizes[i], v->dim, t, &e->control->job, &points)) {
            koksma_evaluate(&v->measures[m].spec, &points, &e->control->job, &value);
            koksma_points_fini(&points);
            koksma__sheet_note_error(sheet, v->measures[m].name);
            return;
        }
    }
}

/* Adds up the values of one sampler and one measure, trial by trial. */
static void add_up(const evaluation *e, size_t s, size_t m)
{
    koksma__sheet_values *v = e->values;
    for (size_t t = 0; t < v->trials[s]; t++) {
        double values[KOKSMA__SHEET_SIZES];
        for (size_t i = 0; i < v->n_sizes; i++) {
            const size_t job = (s * v->n_sizes + i) * e->trials + t;
            values[i] = e->found[job * e->n + e->kept[m]];
            v->measures[m].n_bounds += e->status[job * e->n + e->kept[m]] == 1;
            koksma_tally_add(&v->tallies[(s * v->n_measures + m) * v->n_sizes + i], values[i]);
        }
        koksma_joint_add(&v->joints[s * v->n_measures + m], v->n_sizes, values);
    }
}

koksma_status koksma__sheet_evaluate(koksma__sheet *sheet, koksma__sheet_values *v, const koksma_run *run)
{
    koksma__run_control control;
    evaluation e = {.values = v, .control = &control};
    koksma__run_control_begin(run, 0, &control);
    for (size_t s = 0; s < v->n_samplers; s++) {
        e.trials = v->trials[s] > e.trials ? v->trials[s] : e.trials;
    }
    const size_t jobs = v->n_samplers * v->n_sizes * e.trials;
    e.n = v->n_measures;
    e.found = calloc(jobs * e.n, sizeof *e.found);
    e.status = calloc(jobs * e.n, sizeof *e.status);
    v->tallies = calloc(v->n_samplers * e.n * v->n_sizes, sizeof *v->tallies);
    v->joints = calloc(v->n_samplers * e.n, sizeof *v->joints);
    koksma_status status = e.found && e.status && v->tallies && v->joints
                               ? koksma__parallel(&control.run, jobs, evaluate_set, &e)
                               : koksma__fail_memory(jobs * e.n * sizeof *e.found);
    for (size_t m = v->n_measures = 0; m < e.n && !status; m++) {
        bool missing = false;
        for (size_t job = 0; job < jobs; job++) {
            missing |= e.status[job * e.n + m] == 2;
        }
        if (missing) {
            note_missing(sheet, &e, m);
        } else {
            v->measures[v->n_measures] = v->measures[m];
            e.kept[v->n_measures++] = m;
        }
    }
    for (size_t row = 0; row < v->n_samplers * v->n_measures && !status; row++) {
        add_up(&e, row / v->n_measures, row % v->n_measures);
    }
    free(e.found);
    free(e.status);
    return status;
}

void koksma__sheet_values_fini(koksma__sheet_values *v)
{
    free(v->tallies);
    free(v->joints);
    *v = (koksma__sheet_values){0};
}

const koksma_tally *koksma__sheet_tally(const koksma__sheet_values *v, size_t s, size_t m, size_t i)
{
    return &v->tallies[(s * v->n_measures + m) * v->n_sizes + i];
}

/* The standard error of a mean: 0 of an exact value, NaN of the mean of a single random set. */
static double error_of(const koksma__sheet_values *v, size_t s, size_t m, size_t i)
{
    return v->samplers[s]->same ? 0 : koksma_tally_error(koksma__sheet_tally(v, s, m, i));
}

bool koksma__sheet_equal(const koksma__sheet_values *v, size_t a, size_t b, size_t m, size_t i)
{
    return error_of(v, a, m, i) == 0 && error_of(v, b, m, i) == 0 &&
           !koksma__compare(koksma__sheet_tally(v, a, m, i)->mean, koksma__sheet_tally(v, b, m, i)->mean);
}

int koksma__sheet_compare(const koksma__sheet_values *v, size_t a, size_t b, size_t m, size_t i, size_t tests)
{
    const koksma_tally *x = koksma__sheet_tally(v, a, m, i), *y = koksma__sheet_tally(v, b, m, i);
    const int sign = koksma__compare(x->mean, y->mean) * (v->measures[m].spec.measure->larger_is_better ? 1 : -1);
    const double ex = error_of(v, a, m, i), ey = error_of(v, b, m, i);
    const double variance = ex * ex + ey * ey;
    /* the comparison is undecided if a random sampler has a single set, whose standard error is NaN */
    if (!(variance > 0)) {
        return variance == 0 ? sign : 0;
    }
    const double fourth =
        (ex > 0 ? ex * ex * ex * ex / (x->count - 1) : 0) + (ey > 0 ? ey * ey * ey * ey / (y->count - 1) : 0);
    const double t = koksma__student_quantile(1 - 0.025 / (double)tests, variance * variance / fourth);
    return fabs(x->mean - y->mean) > t * sqrt(variance) ? sign : 0;
}

/* Notes a measure some of whose values are only bounds, because a search was cut short. */
static void note_bounds(koksma__sheet *sheet, const koksma__sheet_measure *measure)
{
    if (measure->n_bounds) {
        koksma__fail(KOKSMA_ARGUMENT, "%zu values are lower bounds: the search was cut short", measure->n_bounds);
        koksma__sheet_note_error(sheet, measure->name);
    }
}

koksma_status koksma__sheet_measure_plane(koksma__sheet *sheet, koksma__document *d)
{
    (void)d;
    koksma__sheet_values *v = &sheet->plane;
    const koksma_measure *measure;
    *v = (koksma__sheet_values){.dim = 2,
                                .n_samplers = sheet->n_samplers,
                                .n_sizes = sheet->n_sizes,
                                .samplers = sheet->samplers,
                                .sizes = sheet->sizes};
    for (size_t k = 0; (measure = koksma_measure_at(k)) && v->n_measures < KOKSMA__SHEET_MEASURES; k++) {
        koksma__sheet_measure *m = &v->measures[v->n_measures];
        if (measure->answer == KOKSMA_ANSWER_EXACT && measure->min_dim <= 2 && measure->max_dim >= 2 &&
            !koksma_measure_spec(measure->name, &m->spec)) {
            koksma_spec_text(&m->spec, m->name);
            v->n_measures++;
        }
    }
    for (size_t s = 0; s < v->n_samplers; s++) {
        v->trials[s] = koksma__sheet_trials(sheet->samplers[s], sheet->trials);
    }
    const koksma_run run = koksma__sheet_part(sheet, 0.4, 1);
    const koksma_status status = koksma__sheet_evaluate(sheet, v, &run);
    for (size_t m = 0; m < v->n_measures && !status; m++) {
        note_bounds(sheet, &v->measures[m]);
    }
    return status;
}

/* ---- The section ------------------------------------------------------------------------------------------- */

/* A mean and its interval, which begins at 0 or above, because no measure is negative, and is empty for an exact value. */
static koksma__estimate mean_of(const koksma__sheet_values *v, size_t s, size_t m, size_t i)
{
    const koksma_tally *t = koksma__sheet_tally(v, s, m, i);
    const double half = v->samplers[s]->same ? 0 : koksma_tally_interval(t), low = t->mean - half;
    return (koksma__estimate){t->mean, low < 0 ? 0 : low, t->mean + half};
}

static koksma__estimate slope_of(const koksma__sheet_values *v, size_t s, size_t m)
{
    double sizes[KOKSMA__SHEET_SIZES], means[KOKSMA__SHEET_SIZES];
    koksma_line line;
    for (size_t i = 0; i < v->n_sizes; i++) {
        sizes[i] = (double)v->sizes[i];
        means[i] = koksma__sheet_tally(v, s, m, i)->mean;
    }
    const koksma_joint *joint = &v->joints[s * v->n_measures + m];
    if (!koksma_joint_line(joint, v->n_sizes, sizes, means, &line)) {
        return (koksma__estimate){NAN, NAN, NAN};
    }
    const size_t degrees = joint->count > 1 ? (size_t)joint->count - 1 : line.count - 2;
    const double half = koksma_student_975(degrees) * line.slope_error;
    return (koksma__estimate){line.slope, line.slope - half, line.slope + half};
}

static size_t best_beside(const koksma__sheet_values *v, size_t m)
{
    const double sign = v->measures[m].spec.measure->larger_is_better ? -1 : 1;
    size_t best = 1;
    for (size_t s = 2; s < v->n_samplers; s++) {
        const double mean = koksma__sheet_tally(v, s, m, v->n_sizes - 1)->mean,
                     before = koksma__sheet_tally(v, best, m, v->n_sizes - 1)->mean;
        best = sign * mean < sign * before ? s : best;
    }
    return best;
}

static void put_summary(const koksma__sheet_values *v, koksma__document *d)
{
    const size_t last = v->n_sizes - 1;
    koksma__doc_table(d, "measures");
    const bool one = v->n_sizes == 1, others = v->n_samplers > 1; /* one size has no slope */
    koksma__doc_columns(d, one && others ? "t measure;i3 mean;t best of the others;i3 its mean"
                           : one         ? "t measure;i3 mean"
                           : others      ? "t measure;i3 mean;i2f slope;t best of the others;i3 its mean"
                                         : "t measure;i3 mean;i2f slope");
    for (size_t m = 0; m < v->n_measures; m++) {
        koksma__doc_row(d, "ti", v->measures[m].name, mean_of(v, 0, m, last));
        if (!one) {
            koksma__doc_cells(d, "i", slope_of(v, 0, m));
        }
        if (others) {
            const size_t best = best_beside(v, m);
            koksma__doc_cells(d, "ti", v->samplers[best]->text, mean_of(v, best, m, last));
        }
    }
}

static void put_chart(const koksma__sheet_values *v, size_t m, koksma__document *d)
{
    const koksma_measure *measure = v->measures[m].spec.measure;
    char title[256];
    snprintf(title, sizeof title, "%s%s", v->measures[m].name,
             measure->larger_is_better ? " (larger is better)" : "");
    bool positive = true; /* a logarithmic axis cannot show 0, a possible t-value of nets */
    for (size_t k = 0; k < v->n_samplers * v->n_sizes; k++) {
        positive &= koksma__sheet_tally(v, k / v->n_sizes, m, k % v->n_sizes)->mean > 0;
    }
    koksma__doc_chart(d, &(koksma__chart){title, "points n", v->measures[m].name, true, positive,
                                          measure->larger_is_better ? 1 : -1});
    for (size_t s = 0; s < v->n_samplers; s++) {
        koksma__doc_series(d, v->samplers[s]->text, NULL, KOKSMA__SERIES_LINE);
        for (size_t i = 0; i < v->n_sizes; i++) {
            const koksma__estimate e = mean_of(v, s, m, i);
            koksma__doc_point(d, (double)v->sizes[i], e.value, e.low, e.high);
        }
    }
}

static void put_values(const koksma__sheet_values *v, const char *name, koksma__document *d)
{
    koksma__doc_table(d, "%s", name);
    koksma__doc_columns(d, "tm measure;tm sampler;n9 n;i4 mean;n2 SD;n9 sets");
    for (size_t k = 0; k < v->n_measures * v->n_samplers * v->n_sizes; k++) {
        const size_t i = k % v->n_sizes, s = k / v->n_sizes % v->n_samplers, m = k / v->n_sizes / v->n_samplers;
        const koksma_tally *t = koksma__sheet_tally(v, s, m, i);
        koksma__doc_row(d, "ttninn", v->measures[m].name, v->samplers[s]->text, (double)v->sizes[i],
                        mean_of(v, s, m, i), koksma_tally_sd(t), t->count);
    }
}

/* Writes a table of all samplers' slopes, fitted as `koksma measure --sizes` does. */
static void put_slopes(const koksma__sheet_values *v, koksma__document *d)
{
    koksma__doc_table(d, "slopes");
    koksma__doc_columns(d, "tm measure;t sampler;i3f slope;n2 theory;n2 best possible");
    for (size_t k = 0; k < v->n_measures * v->n_samplers; k++) {
        const koksma__sheet_measure *m = &v->measures[k / v->n_samplers];
        const koksma__sheet_sampler *s = v->samplers[k % v->n_samplers];
        koksma__doc_row(d, "ttinn", m->name, s->text, slope_of(v, k % v->n_samplers, k / v->n_samplers),
                        -koksma_rate(&s->spec, m->spec.measure, v->dim), -koksma_best_rate(m->spec.measure, v->dim));
    }
}

void koksma__sheet_put_values(const koksma__sheet_values *v, const char *name, koksma__document *d)
{
    char list[KOKSMA__DOC_COMMAND] = "", sizes[128] = "";
    put_values(v, name, d);
    for (size_t m = 0; m < v->n_measures; m++) {
        koksma__text_join(list, sizeof list, ",", v->measures[m].name);
    }
    for (size_t i = 0; i < v->n_sizes; i++) {
        const size_t used = strlen(sizes);
        snprintf(sizes + used, sizeof sizes - used, "%s%zu", used ? "," : "", v->sizes[i]);
    }
    koksma__doc_commands(d);
    for (size_t s = 0; s < v->n_samplers; s++) {
        koksma__doc_command(d, "koksma measure %s --sizes %s -m %s --trials %zu --seed %llu",
                            koksma__sheet_source(v->samplers[s], v->sizes[v->n_sizes - 1], v->dim).text, sizes, list,
                            v->trials[s], (unsigned long long)v->samplers[s]->seed);
    }
}

koksma_status koksma__sheet_put_measures(koksma__sheet *sheet, koksma__document *d)
{
    const koksma__sheet_values *v = &sheet->plane;
    koksma__doc_section(d, "measures", "Discrepancies and distances");
    koksma__doc_paragraph(
        d,
        "Means over sets at n = %zu%s. Intervals are " KOKSMA__MEAN_INTERVALS
        ". A deterministic sampler has one set of each size; its values are exact and have no interval.",
        v->sizes[v->n_sizes - 1], v->n_sizes > 1 ? ", and slopes of log mean over log n" : "");
    put_summary(v, d);
    if (v->n_sizes > 1) { /* one size has neither lines nor slopes */
        for (size_t m = 0; m < v->n_measures; m++) {
            put_chart(v, m, d);
        }
        koksma__doc_collapsed_section(d, "slopes", "Slopes of all samplers");
        put_slopes(v, d);
        koksma__doc_end(d);
    }
    koksma__doc_collapsed_section(d, "values", "All values, and the commands that give them");
    koksma__sheet_put_values(v, "values", d);
    koksma__doc_end(d);
    koksma__doc_end(d);
    return KOKSMA_OK;
}
