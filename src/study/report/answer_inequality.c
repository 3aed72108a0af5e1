/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Koksma's inequality shown: the error of the mean of f over N points is at most V(f) D*_N (Koksma 1942; in the plane
 * Hlawka 1961, with the variation of Hardy and Krause). One set a pattern and number of points, seed 0, made here: it
 * takes no rows. Functions of x alone see the points' first coordinates, and their star discrepancy.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "core/sum.h"
#include "study/report/answers.h"
#include "study/report/integrands.h"

enum { MAX_POINTS = 4096 };

/* What all rows have to say together. */
typedef struct verdict {
    size_t cases, beyond, idle, infinite; /* idle: V(f) D* is finite, but above every error that f can have */
    double closest;
    char where[KOKSMA_MAX_SPEC + 128];
} verdict;

static koksma_status star_of(const koksma_points *points, double *star)
{
    koksma_spec spec;
    koksma_value value = {0};
    koksma_status status = koksma_measure_spec("star", &spec);
    status = status ? status : koksma_evaluate(&spec, points, NULL, &value);
    *star = value.value;
    return status;
}

/* The points' first coordinates. */
static koksma_status on_line(const koksma_points *points, koksma_points *line)
{
    const koksma_status status = koksma_points_init(line, points->n, 1);
    for (size_t i = 0; !status && i < points->n; i++) {
        line->xs[i] = points->xs[i * (size_t)points->dim];
    }
    return status;
}

static double error_of(const koksma__integrand *f, const koksma_points *points)
{
    koksma__sum sum = {0};
    for (size_t i = 0; i < points->n; i++) {
        koksma__sum_add(&sum, f->at(points->xs + i * (size_t)points->dim));
    }
    return fabs(koksma__sum_value(&sum) / (double)points->n - f->integral);
}

static void add_row(koksma__grid *g, verdict *all, const char *pattern, const koksma_points *points,
                    const koksma__integrand *f, double star)
{
    const double error = error_of(f, points), bound = f->variation * star;
    koksma__grid_row(g);
    koksma__grid_text(g, f->title);
    koksma__grid_text(g, pattern);
    koksma__grid_number(g, (double)points->n, 6);
    koksma__grid_number(g, star, 3);
    koksma__grid_number(g, error, 3);
    if (isinf(f->variation)) {
        koksma__grid_text(g, "infinite");
        koksma__grid_text(g, "infinite");
        koksma__grid_text(g, "");
        all->infinite++;
        return;
    }
    koksma__grid_number(g, f->variation, 3);
    koksma__grid_number(g, bound, 3);
    koksma__grid_number(g, error / bound, 2);
    all->cases++;
    all->beyond += error > bound * (1 + 1e-12) + 1e-15;
    all->idle += bound >= f->range;
    if (error / bound > all->closest) {
        all->closest = error / bound;
        snprintf(all->where, sizeof all->where, "%s over %zu points of %.400s", f->title, points->n, pattern);
    }
}

static koksma_status add_set(koksma__grid *g, verdict *all, const char *pattern, long long n, int dim)
{
    koksma_spec spec;
    koksma_points points = {0}, line = {0};
    double star = 0, star_on_line = 0;
    koksma_status status = koksma_pattern_spec(pattern, &spec);
    status = status ? status : koksma_points_init(&points, (size_t)n, dim);
    status = status ? status : koksma_generate(&spec, 0, NULL, &points);
    status = status ? status : on_line(&points, &line);
    status = status ? status : star_of(&points, &star);
    status = status ? status : star_of(&line, &star_on_line);
    for (size_t i = 0; !status && koksma__integrand_at(i); i++) {
        const koksma__integrand *f = koksma__integrand_at(i);
        if (f->dim <= dim) {
            add_row(g, all, pattern, f->dim == 1 ? &line : &points, f, f->dim == 1 ? star_on_line : star);
        }
    }
    koksma_points_fini(&points);
    koksma_points_fini(&line);
    return status;
}

static void add_heads(koksma__grid *g)
{
    static const char *const heads[] = {"f", "pattern", "N", "D*", "|error|", "V(f)", "V(f) D*", "|error| / V(f) D*"};
    for (size_t i = 0; i < sizeof heads / sizeof *heads; i++) {
        koksma__grid_head(g, heads[i]);
    }
}

static void add_sentence(koksma__html *h, const verdict *all)
{
    koksma__html_add(
        h, "<p>Koksma's inequality: the mean of <em>f</em> over N points is off its integral by no more "
           "than V(<em>f</em>) D*, the variation of <em>f</em> (in the plane that of Hardy and Krause) times "
           "the star discrepancy of the points. Here one set of each pattern, with seed 0; of functions of "
           "<em>x</em> alone the first coordinates. ");
    koksma__html_add(h, "%zu of %zu errors are within the bound; closest to it, with %.0f %%, comes ",
                     all->cases - all->beyond, all->cases, 100 * all->closest);
    koksma__html_text(h, all->where);
    koksma__html_add(h, ". ");
    if (all->infinite) {
        koksma__html_add(h,
                         "The edge of an object in a picture is seldom along an axis: there the variation is "
                         "infinite (%zu rows), and the inequality promises nothing, though the errors are as small. ",
                         all->infinite);
    }
    if (all->idle) {
        koksma__html_add(
            h,
            "In %zu rows the variation is finite, but the bound is above f's whole range: no error can be so "
            "large.",
            all->idle);
    }
    koksma__html_add(h, "</p>\n");
}

koksma_status koksma__answer_inequality(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    verdict all = {0};
    koksma__html rows = {0};
    koksma__grid grid;
    char file[64];
    koksma_status status = KOKSMA_OK;
    (void)study;
    snprintf(file, sizeof file, "inequality-%.32s", topic->id);
    koksma__grid_open(&grid, &rows, file);
    add_heads(&grid);
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        for (size_t i = 0; !status && d->dim <= 2 && i < d->n.n * d->patterns.n; i++) {
            const long long n = d->n.at[i % d->n.n];
            if (n <= MAX_POINTS) {
                status = add_set(&grid, &all, d->patterns.at[i / d->n.n], n, d->dim);
            }
        }
    }
    koksma__grid_close(&grid);
    if (!status && all.cases) {
        add_sentence(h, &all);
        koksma__html_add(h, "%s", rows.text ? rows.text : "");
    }
    h->failed |= rows.failed;
    free(rows.text);
    return status;
}
