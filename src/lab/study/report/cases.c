/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lists the cases of a question (koksma__cases) and reads their means. Blocks of one question may overlap: a case is
 * visited in the first block that renders it (is_before). If several blocks have results of a pattern, its means are
 * read from the one with the most trials (images) or point sets (measures).
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/report.h"
#include "study/run/references.h"

/* ---- Measures ------------------------------------------------------------------------------------------ */

/* Adds a measure in a number of dimensions, unless it is listed already. */
static void add_measured(koksma__cases *c, const char *measure, int dim)
{
    for (size_t i = 0; i < c->n; i++) {
        if (c->measured[i].dim == dim && !strcmp(c->measured[i].measure, measure)) {
            return;
        }
    }
    koksma_spec spec;
    koksma__measured *m = &c->measured[c->n++];
    *m = (koksma__measured){.measure = measure, .dim = dim};
    m->larger = !koksma_measure_spec(measure, &spec) && spec.measure->larger_is_better;
    const int length = snprintf(m->label, sizeof m->label, "%s", measure);
    if (dim != 2) {
        snprintf(m->label + length, sizeof m->label - (size_t)length, " (%dD)", dim);
    }
}

koksma__cases koksma__cases_of(koksma__report *r, const koksma__topic *topic)
{
    koksma__cases cases = {.report = r, .topic = topic};
    size_t most = 0;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        most += topic->discrepancies[b]->measures.n;
    }
    cases.measured = koksma__report_memory(r, most, sizeof *cases.measured);
    for (size_t b = 0; b < topic->n_discrepancies && koksma__report_goes_on(r); b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        for (size_t m = 0; !d->warps.n && m < d->measures.n; m++) {
            add_measured(&cases, d->measures.at[m], d->dim);
        }
    }
    return cases;
}

/* Whether a block evaluates the case's measure, without a warp, at the case's dimension and number of points. */
static bool measures_it(const koksma__discrepancy_block *d, const koksma__case *at)
{
    return !d->warps.n && d->dim == at->of->dim && koksma__wholes_have(&d->n, at->spp) &&
           koksma__texts_have(&d->measures, at->of->measure);
}

/* The topic's block that measures a pattern's points; if several do, the one with the most sets. NULL: none does. */
static const koksma__discrepancy_block *measured_in(const koksma__topic *topic, const koksma__case *at,
                                                    const char *pattern)
{
    const koksma__discrepancy_block *most = NULL;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        if ((!most || d->trials > most->trials) && measures_it(d, at) && koksma__texts_have(&d->patterns, pattern)) {
            most = d;
        }
    }
    return most;
}

/* ---- Images -------------------------------------------------------------------------------------------- */

/* Whether two blocks render a scene at the same size and with the same last reference, to which errors refer. */
static bool same_pictures(const koksma_study *study, const koksma__image_block *a, const koksma__image_block *b,
                          const char *scene)
{
    const koksma__study_scene *s = koksma__study_scene_of(study, scene);
    char name[KOKSMA__REFERENCE_NAME], other[KOKSMA__REFERENCE_NAME];
    int width[2], height[2];
    koksma__block_size(a, s, &width[0], &height[0]);
    koksma__block_size(b, s, &width[1], &height[1]);
    koksma__reference_name(&a->references[a->n_references - 1], name);
    koksma__reference_name(&b->references[b->n_references - 1], other);
    return width[0] == width[1] && height[0] == height[1] && !strcmp(name, other);
}

/* Whether a block renders the case: its scene, options and number of samples, with the same size and reference. */
static bool renders_it(const koksma_study *study, const koksma__image_block *i, const koksma__case *at)
{
    return i == at->image ||
           (koksma__wholes_have(&i->spp, at->spp) && koksma__texts_have(&i->variants, at->variant) &&
            koksma__texts_have(&i->scenes, at->scene) && same_pictures(study, i, at->image, at->scene));
}

/* The topic's block, among block b and those after it, that renders a pattern of the case; if several do, the one
   with the most trials. */
static const koksma__image_block *rendered_in(const koksma__cases *c, const koksma__case *at, const char *pattern,
                                              size_t b)
{
    const koksma__image_block *most = c->topic->images[b];
    for (; b < c->topic->n_images; b++) {
        const koksma__image_block *i = c->topic->images[b];
        if (i->trials > most->trials && koksma__texts_have(&i->patterns, pattern) &&
            renders_it(c->report->study, i, at)) {
            most = i;
        }
    }
    return most;
}

/* ---- Cases --------------------------------------------------------------------------------------------- */

/* Whether a block before block b renders the case (with this pattern, unless `pattern` is NULL). */
static bool is_before(const koksma__cases *c, const koksma__case *at, const char *pattern, size_t b)
{
    for (size_t k = 0; k < b; k++) {
        const koksma__image_block *i = c->topic->images[k];
        if ((!pattern || koksma__texts_have(&i->patterns, pattern)) && renders_it(c->report->study, i, at)) {
            return true;
        }
    }
    return false;
}

static void visit_measures(const koksma__cases *c, koksma__case *at, koksma__case_visitor visit, void *context)
{
    for (size_t m = 0; m < c->n; m++) {
        bool measured = false;
        at->of = &c->measured[m];
        for (size_t b = 0; !measured && b < c->topic->n_discrepancies; b++) {
            measured = measures_it(c->topic->discrepancies[b], at);
        }
        if (measured && !c->report->status) {
            visit(c, context, at);
        }
    }
}

void koksma__cases_visit(const koksma__cases *c, koksma__case_visitor visit, void *context)
{
    for (size_t b = 0; b < c->topic->n_images; b++) {
        const koksma__image_block *i = c->topic->images[b];
        const size_t variants = i->variants.n, sizes = i->spp.n;
        for (size_t k = 0; k < i->scenes.n * variants * sizes && koksma__report_goes_on(c->report); k++) {
            koksma__case at = {.image = i,
                               .scene = i->scenes.at[k / (variants * sizes)],
                               .variant = i->variants.at[k / sizes % variants],
                               .spp = i->spp.at[k % sizes]};
            if (!is_before(c, &at, NULL, b)) {
                visit_measures(c, &at, visit, context);
            }
        }
    }
}

/* Adds a pattern's means of the measure and of the image error. Block b is the first block that renders the pattern.
   A pattern that lacks results of points or of images, or comes after KOKSMA__CASE_PATTERNS others, is counted but
   not added. */
static void add_pair(const koksma__cases *c, const koksma__case *at, const char *pattern, size_t b,
                     koksma__pairs *out)
{
    const koksma__discrepancy_block *d = measured_in(c->topic, at, pattern);
    out->patterns_in_all++;
    if (!d || out->n == KOKSMA__CASE_PATTERNS) {
        return;
    }
    const koksma__subject points = koksma__subject_of_points(d, at->of->measure, ""),
                          images = koksma__subject_of_images(rendered_in(c, at, pattern, b), at->scene, at->variant,
                                                             c->topic->metric);
    const koksma__summary x = koksma__read_mean(c->report, &points, pattern, at->spp, NULL),
                          y = koksma__read_mean(c->report, &images, pattern, at->spp, NULL);
    if (x.n && y.n) {
        out->x[out->n] = x.mean;
        out->y[out->n] = y.mean;
        out->x_error[out->n] = x.sd / sqrt((double)x.n);
        out->y_error[out->n] = y.sd / sqrt((double)y.n);
        out->low[out->n] = y.low;
        out->high[out->n] = y.high;
        out->patterns[out->n++] = pattern;
    }
}

void koksma__case_pairs(const koksma__cases *c, const koksma__case *at, koksma__pairs *out)
{
    out->n = out->patterns_in_all = 0;
    for (size_t b = 0; b < c->topic->n_images; b++) {
        const koksma__image_block *i = c->topic->images[b];
        for (size_t p = 0; renders_it(c->report->study, i, at) && p < i->patterns.n; p++) {
            if (koksma__report_goes_on(c->report) && !is_before(c, at, i->patterns.at[p], b)) {
                add_pair(c, at, i->patterns.at[p], b, out);
            }
        }
    }
}
