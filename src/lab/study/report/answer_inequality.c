/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Demonstrates Koksma's inequality: the error of the mean of f over N points is at most V(f) D*_N (Koksma 1942; in
 * the plane Hlawka 1961, with the variation of Hardy and Krause). The answer uses no rows of the store: it generates
 * one point set of each pattern and number of points, with seed 0. For functions of x alone it uses the points'
 * first coordinates and their star discrepancy.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <koksma/integrate.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/report/report.h"

enum { MAX_POINTS = 4096 };

/* The summary of all rows. */
typedef struct verdict {
    /* no_use: the bound V(f) D* is finite, but larger than any error that f can have */
    size_t cases, beyond, no_use, infinite;
    double closest;
    /* errors where the variation is finite [0] and where it is not [1] */
    size_t n_errors[2];
    double *errors[2];
    char where[KOKSMA_MAX_SPEC + 128];
} verdict;

static koksma_status star_of(const koksma_points *points, const koksma_run *run, double *star)
{
    koksma_spec spec;
    koksma_value value = {0};
    koksma_status status = koksma_measure_spec("star", &spec);
    status = status ? status : koksma_evaluate(&spec, points, run, &value);
    *star = value.value;
    return status;
}

/* Makes a point set in one dimension of the points' first coordinates. */
static koksma_status on_line(const koksma_points *points, koksma_points *line)
{
    const koksma_status status = koksma_points_init(line, points->n, 1);
    for (size_t i = 0; !status && i < points->n; i++) {
        line->xs[i] = points->xs[i * (size_t)points->dim];
    }
    return status;
}

static koksma_status keep_error(verdict *all, bool infinite, double error)
{
    double *kept = koksma__add_one(&all->errors[infinite], &all->n_errors[infinite], sizeof *kept);
    if (!kept) {
        return KOKSMA_MEMORY;
    }
    *kept = error;
    return KOKSMA_OK;
}

static int compare_errors(const void *a, const void *b)
{
    return koksma__compare(*(const double *)a, *(const double *)b);
}

/* The median of a group's errors, which this sorts; NaN: none. */
static double median_error(verdict *all, bool infinite)
{
    const size_t n = all->n_errors[infinite];
    double *errors = all->errors[infinite];
    if (!n) {
        return NAN;
    }
    qsort(errors, n, sizeof *errors, compare_errors);
    return (errors[(n - 1) / 2] + errors[n / 2]) / 2;
}

/* The error of a mean; what rounding alone explains is none. */
static double error_of(const koksma_integral_facts *facts, double mean)
{
    const double error = fabs(mean - facts->value);
    return error <= 4 * DBL_EPSILON * (facts->highest - facts->lowest) ? 0 : error;
}

static void add_row(koksma__document *d, verdict *all, const char *pattern, const koksma_points *points,
                    const koksma_integrand *f, const koksma_integral_facts *facts, double star, double mean)
{
    const double error = error_of(facts, mean), bound = facts->variation * star;
    koksma__doc_row(d);
    koksma__doc_cells(d, "ttznn", f->title, pattern, points->n, star, error);
    if (isinf(facts->variation)) {
        koksma__doc_cells(d, "ttt", "infinite", "infinite", "");
        all->infinite++;
        return;
    }
    koksma__doc_cells(d, "nnn", facts->variation, bound, error / bound);
    all->cases++;
    all->beyond += error > bound * (1 + 1e-12) + 1e-15;
    all->no_use += bound >= facts->highest - facts->lowest;
    if (error / bound > all->closest) {
        all->closest = error / bound;
        snprintf(all->where, sizeof all->where, "%s over %zu point%s of %.400s", f->title, points->n,
                 koksma__plural((double)points->n), pattern);
    }
}

/* Adds the row of an integrand for a point set of the integrand's dimension. */
static koksma_status add_integrand(koksma__document *d, verdict *all, const char *pattern,
                                   const koksma_points *points, const koksma_integrand *f, double star)
{
    koksma_integral *integral;
    koksma_integral_facts facts;
    double mean = 0;
    KOKSMA__TRY(koksma_integral_open(f->name, f->axes, &integral));
    koksma_integral_about(integral, &facts);
    koksma_status status = koksma_integrate(integral, points, NULL, &mean);
    status = status ? status : keep_error(all, isinf(facts.variation), error_of(&facts, mean));
    if (!status) {
        add_row(d, all, pattern, points, f, &facts, star, mean);
    }
    koksma_integral_close(integral);
    return status;
}

static koksma_status add_set(koksma__document *d, verdict *all, const char *pattern, long long n, int dim,
                             const koksma_run *run)
{
    koksma_spec spec;
    koksma_points points = {0}, line = {0};
    double star = 0, star_on_line = 0;
    koksma_status status = koksma_pattern_spec(pattern, &spec);
    status = status ? status : koksma_points_init(&points, (size_t)n, dim);
    status = status ? status : koksma_generate(&spec, 0, run, &points);
    status = status ? status : on_line(&points, &line);
    status = status ? status : star_of(&points, run, &star);
    status = status ? status : star_of(&line, run, &star_on_line);
    const koksma_integrand *f;
    for (size_t i = 0; !status && (f = koksma_integrand_at(i)); i++) {
        if (f->axes && f->axes <= dim) {
            status =
                add_integrand(d, all, pattern, f->axes == 1 ? &line : &points, f, f->axes == 1 ? star_on_line : star);
        }
    }
    koksma_points_fini(&points);
    koksma_points_fini(&line);
    return status == KOKSMA_FORBIDDEN ? KOKSMA_OK
                                      : status; /* patterns that run code are left out unless the user allowed that */
}

static void say_verdict(koksma__document *d, verdict *all)
{
    koksma__doc_paragraph_begin(d);
    koksma__doc_say(
        d,
        "Koksma's inequality: the mean of _f_ over N points differs from its integral by at most V(_f_) D%s, the "
        "variation of _f_ (in the plane that of Hardy and Krause) times the star discrepancy of the points. There is "
        "one set of each pattern here, with seed 0; functions of _x_ alone use the first coordinates.",
        "*");
    koksma__doc_paragraph_end(d);
    koksma__doc_answer_begin(d, !all->beyond);
    koksma__doc_say(d, "%zu of %zu errors are within the bound; the closest, at %.0f %% of it, is that of %s.",
                    all->cases - all->beyond, all->cases, 100 * all->closest, all->where);
    if (all->infinite) {
        koksma__doc_say(d, " For %zu more, of slanted and curved edges, V(_f_) is infinite and it promises nothing.",
                        all->infinite);
    }
    koksma__doc_paragraph_end(d);
    if (!all->infinite && !all->no_use) {
        return;
    }
    koksma__doc_paragraph_begin(d);
    if (all->infinite) {
        koksma__doc_say(d,
                        "The edge of an object in a picture is seldom parallel to an axis, so that the variation is "
                        "infinite. The median of these errors is %.2g, and that of the other rows %.2g. ",
                        median_error(all, true), median_error(all, false));
    }
    if (all->no_use) {
        koksma__doc_say(d,
                        "In %zu rows the variation is finite, but the bound exceeds the whole range of f: no error "
                        "can be so large.",
                        all->no_use);
    }
    koksma__doc_paragraph_end(d);
}

void koksma__answer_inequality(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    verdict all = {0};
    koksma__document rows = {0};
    koksma__phases phases = {0};
    const koksma_run run = koksma__phase_run(&phases, r->run, 0); /* many short calls: their fractions say nothing */
    koksma__doc_table_begin(&rows, "inequality-%.32s", topic->id);
    koksma__doc_columns(&rows, "t f;t pattern;n6 N;n3 D*;n3 |error|;n3 V(f);n3 V(f) D*;n2 |error| / V(f) D*");
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *block = topic->discrepancies[b];
        for (size_t i = 0; !r->status && block->dim <= 2 && i < block->n.n * block->patterns.n; i++) {
            const long long n = block->n.at[i % block->n.n];
            if (n <= MAX_POINTS &&
                !koksma__is_left_out(&block->left_out, i / block->n.n, block->n.n, i % block->n.n)) {
                koksma__report_keep(r, add_set(&rows, &all, block->patterns.at[i / block->n.n], n, block->dim, &run));
            }
        }
    }
    koksma__doc_table_end(&rows);
    if (!r->status && all.cases) {
        say_verdict(d, &all);
        koksma__doc_append(d, &rows);
    }
    koksma__report_keep(r, rows.json.status);
    koksma__json_writer_fini(&rows.json);
    KOKSMA__FREE(all.errors[0], all.errors[1]);
}
