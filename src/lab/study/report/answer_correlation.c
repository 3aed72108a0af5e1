/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers whether a measure orders the patterns as the error of images does. A case is a measure in a number of dimensions,
 * and a scene with its options and number of samples; for each it computes the rank correlation, over patterns, of the mean
 * of the measure of n points with the mean error of images of n samples per pixel. The interval of a correlation comes from
 * a bootstrap over the patterns that also redraws the means. All cases and measures are resampled together, so that the
 * mean correlations of two measures can be compared. The answer gives the means over all cases, then by group of scenes and
 * by scene.
 *
 * Blocks of one question may overlap: a case is that of the first block that renders it, with the patterns of all of them.
 * If several blocks have results of a pattern, its means are read from the one with the most trials (images) or point sets
 * (measures).
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/rho.h"
#include "study/run/references.h"

enum { MOST_PLOTS = 6 };

/* A measure of points of `dim` dimensions; the same measure in two and in three dimensions counts as two measures. */
typedef struct measured {
    const char *measure;
    int dim;
    bool larger;                      /* whether larger values of the measure are better */
    char label[KOKSMA_MAX_SPEC + 16]; /* "l2-star", "l2-star (3D)" */
} measured;

typedef struct one_case {
    const koksma__image_block *image; /* the first block that renders the case */
    const char *scene, *variant;
    long long spp;
    const measured *of;
} one_case;

/* Of each pattern with results of both: the mean x of the measure, and the mean y of the image error with its interval, and
   the standard errors of both. */
typedef struct pairs {
    size_t n;
    double *x, *y, *low, *high, *x_error, *y_error;
    const char **patterns;
} pairs;

/* ---- Cases ------------------------------------------------------------------------------------------------- */

/* Whether a block evaluates the case's measure, without a warp, at the case's dimension and number of points. */
static bool measures_it(const koksma__discrepancy_block *d, const one_case *at)
{
    return !d->warps.n && d->dim == at->of->dim && koksma__wholes_have(&d->n, at->spp) &&
           koksma__texts_have(&d->measures, at->of->measure);
}

/* The topic's block that measures a pattern's points (NULL: any pattern's); if several do, the one with the most sets.
   NULL: none does. */
static const koksma__discrepancy_block *measured_in(const koksma__topic *topic, const one_case *at,
                                                    const char *pattern)
{
    const koksma__discrepancy_block *most = NULL;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        if ((!most || d->trials > most->trials) && measures_it(d, at) &&
            (!pattern || koksma__texts_have(&d->patterns, pattern))) {
            most = d;
        }
    }
    return most;
}

/* Whether a block renders the case (with this pattern, unless it is NULL) as the case's first block does: at the same
   size and with the same last reference, to which errors refer. */
static bool renders_it(const koksma_study *study, const koksma__image_block *i, const one_case *at,
                       const char *pattern)
{
    const koksma__image_block *blocks[] = {i, at->image};
    const koksma__study_scene *scene = koksma__study_scene_of(study, at->scene);
    char names[2][KOKSMA__REFERENCE_NAME];
    int width[2], height[2];
    if ((pattern && !koksma__texts_have(&i->patterns, pattern)) || !koksma__wholes_have(&i->spp, at->spp) ||
        !koksma__texts_have(&i->variants, at->variant) || !koksma__texts_have(&i->scenes, at->scene)) {
        return false;
    }
    for (size_t k = 0; k < 2; k++) {
        koksma__block_size(blocks[k], scene, &width[k], &height[k]);
        koksma__reference_name(&blocks[k]->references[blocks[k]->n_references - 1], names[k]);
    }
    return width[0] == width[1] && height[0] == height[1] && !strcmp(names[0], names[1]);
}

/* Whether a block before block b renders the case (with this pattern, unless it is NULL). */
static bool is_before(const koksma__report *r, const koksma__topic *topic, const one_case *at, const char *pattern,
                      size_t b)
{
    bool before = false;
    for (size_t k = 0; !before && k < b; k++) {
        before = renders_it(r->study, topic->images[k], at, pattern);
    }
    return before;
}

/* Lists the measures that the blocks of a topic evaluate without a warp, each once for a number of dimensions. */
static measured *list_measures(koksma__report *r, const koksma__topic *topic, size_t *n)
{
    measured *list = NULL;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        for (size_t m = 0; !d->warps.n && m < d->measures.n; m++) {
            size_t i = 0;
            while (i < *n && (list[i].dim != d->dim || strcmp(list[i].measure, d->measures.at[m]) != 0)) {
                i++;
            }
            measured *new = i < *n ? NULL : koksma__report_add(r, &list, n, sizeof *new);
            if (new) {
                new->measure = d->measures.at[m];
                new->dim = d->dim;
                new->larger = koksma__subject_of_points(d, new->measure, "").larger;
                snprintf(new->label, sizeof new->label, d->dim != 2 ? "%s (%dD)" : "%s", new->measure, d->dim);
            }
        }
    }
    return list;
}

/* Lists the cases: every combination of scene, options, number of samples and measure, each once. */
static one_case *list_cases(koksma__report *r, const koksma__topic *topic, size_t *n)
{
    size_t n_measured = 0;
    const measured *of = list_measures(r, topic, &n_measured);
    one_case *list = NULL;
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        const size_t variants = i->variants.n, sizes = i->spp.n;
        for (size_t k = 0; k < i->scenes.n * variants * sizes && koksma__report_goes_on(r); k++) {
            one_case at = {.image = i,
                           .scene = i->scenes.at[k / (variants * sizes)],
                           .variant = i->variants.at[k / sizes % variants],
                           .spp = i->spp.at[k % sizes]};
            const bool listed = is_before(r, topic, &at, NULL, b);
            for (size_t m = 0; !listed && m < n_measured; m++) {
                at.of = &of[m];
                one_case *new = measured_in(topic, &at, NULL) ? koksma__report_add(r, &list, n, sizeof *new) : NULL;
                if (new) {
                    *new = at;
                }
            }
        }
    }
    return list;
}

/* Adds a pattern's means, if it has results of both points and images. */
static void add_pair(koksma__report *r, const koksma__topic *topic, const one_case *at, const char *pattern,
                     const koksma__image_block *most, pairs *out)
{
    const koksma__discrepancy_block *d = measured_in(topic, at, pattern);
    if (!d) {
        return;
    }
    const koksma__subject points = koksma__subject_of_points(d, at->of->measure, ""),
                          images = koksma__subject_of_images(most, at->scene, at->variant, topic->metric);
    const koksma__summary x = koksma__read_mean(r, &points, pattern, at->spp, NULL),
                          y = koksma__read_mean(r, &images, pattern, at->spp, NULL);
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

/* Reads the means of a case for all patterns that have results of both the measure and the image error. */
static pairs read_pairs(koksma__report *r, const koksma__topic *topic, const one_case *at)
{
    size_t most = 0;
    for (size_t b = 0; b < topic->n_images; b++) {
        most += topic->images[b]->patterns.n;
    }
    double *means = koksma__report_memory(r, 6 * most, sizeof *means);
    pairs out = {.patterns = koksma__report_memory(r, most, sizeof *out.patterns)};
    double **lists[] = {&out.x, &out.y, &out.low, &out.high, &out.x_error, &out.y_error};
    for (size_t i = 0; i < 6; i++) {
        *lists[i] = means + i * most;
    }
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__texts *patterns = &topic->images[b]->patterns;
        for (size_t p = 0; p < patterns->n && renders_it(r->study, topic->images[b], at, NULL); p++) {
            const koksma__image_block *block = topic->images[b];
            if (!koksma__report_goes_on(r) || is_before(r, topic, at, patterns->at[p], b)) {
                continue;
            }
            for (size_t k = b; k < topic->n_images; k++) {
                const koksma__image_block *i = topic->images[k];
                block = i->trials > block->trials && renders_it(r->study, i, at, patterns->at[p]) ? i : block;
            }
            add_pair(r, topic, at, patterns->at[p], block, &out);
        }
    }
    return out;
}

/* ---- Correlations ------------------------------------------------------------------------------------------ */

/* Computes Spearman's rho with its resamples, of the sign that is positive if the measure orders the patterns as the error
   does. */
static koksma_status correlate(const koksma_run *run, const one_case *p, const pairs *found,
                               double draws[KOKSMA__RHO_SAMPLES], koksma__estimate *rho)
{
    const koksma__means x = {found->x, found->x_error, koksma__job_seed("means|%s|%lld", p->of->label, p->spp)};
    const koksma__means y = {found->y, found->y_error,
                             koksma__job_seed("means|%s|%s|%lld", p->scene, p->variant, p->spp)};
    memset(draws, 0, KOKSMA__RHO_SAMPLES * sizeof *draws);
    KOKSMA__TRY(koksma__bootstrap_pairs(&x, &y, found->n, KOKSMA__RHO_SAMPLES, koksma__job_seed("correlation"), run,
                                        draws, rho));
    if (p->of->larger) {
        *rho = (koksma__estimate){-rho->value, -rho->high, -rho->low};
        for (size_t i = 0; i < KOKSMA__RHO_SAMPLES; i++) {
            draws[i] = -draws[i];
        }
    }
    return KOKSMA_OK;
}

/* Adds the row of a case to the table of all cases, and its correlation to the means. */
static void add_case(koksma__report *r, koksma__document *d, const koksma__topic *topic, const one_case *p,
                     koksma__rho_means *means)
{
    const pairs found = read_pairs(r, topic, p);
    double draws[KOKSMA__RHO_SAMPLES];
    koksma__estimate rho;
    if (!r->status && found.n >= 4 && koksma__report_keep(r, correlate(r->run, p, &found, draws, &rho)) &&
        !isnan(rho.value)) {
        rho = koksma__rho_shown(&rho, found.n);
        koksma__doc_row(d, "ttdtzi", p->scene, p->variant[0] ? p->variant : "defaults", p->spp, p->of->label, found.n,
                        rho);
        koksma__rho_add(r, means, p->of->label, p->scene, found.n, &rho, draws);
    }
}

/* ---- Tables ------------------------------------------------------------------------------------------------ */

/* Writes the table of all measures, with their means over all cases. */
static void add_measures(koksma__document *d, const char *id, const koksma__rho_means *s,
                         const koksma__rho_jackknife *j)
{
    const koksma__rho_ranking *r = &j->of[0];
    const koksma__estimate none = {NAN, NAN, NAN};
    koksma__doc_table(d, "correlation-%.40s", id);
    koksma__doc_columns(d, "t measure;i3 mean Spearman;n2 p of 0 (Holm);n3 lowest without a scene;n3 highest without "
                           "a scene;i2 less the first;n2 p of that (Holm);n7 cases;n7 cases that exclude 0");
    for (size_t m = 0; m < r->n; m++) { /* which are in the order of their means over all cases */
        const koksma__rho_standing *of = &r->of[m];
        const koksma__estimate range = j->n > 1 ? koksma__rho_range(j, m) : none;
        koksma__doc_row(d, "tinnninzz", s->of[m].measure, of->mean, of->p, range.low, range.high, m ? of->less : none,
                        m ? r->p[m] : (double)NAN, s->of[m].all, s->of[m].sure);
    }
}

/* Adds a row for some scenes: the mean of every measure, the best measure, and those that are significantly worse
   than the best, by Holm's method over the pairs of measures in that row. */
static void add_part(koksma__report *report, koksma__document *d, const koksma__rho_means *s, const char *name,
                     const bool *scenes)
{
    const koksma__rho_ranking r = koksma__rho_rank(report, s, scenes);
    char worse[512] = "";
    for (size_t i = 1; i < r.n; i++) {
        if (koksma__rho_is_better(&r, r.order[0], r.order[i])) {
            koksma__text_join(worse, sizeof worse, ", ", s->of[r.order[i]].measure);
        }
    }
    if (r.n) {
        koksma__doc_row(d, "tztt", name, r.of[r.order[0]].cases, s->of[r.order[0]].measure,
                        worse[0] ? worse : "none");
    }
    for (size_t m = 0; r.n && m < s->n; m++) {
        const koksma__estimate none = {NAN, NAN, NAN};
        koksma__doc_cells(d, "i", r.of[m].cases ? r.of[m].mean : none);
    }
}

/* Writes a table of the means by group of scenes if the plan has groups, or by scene if there are two or more. */
static void add_parts(koksma__report *r, koksma__document *d, const koksma__topic *topic, const koksma__rho_means *s,
                      bool by_group)
{
    const char *name = by_group ? "group" : "scene";
    const size_t n = by_group ? topic->n_groups : s->n_scenes;
    bool *scenes = koksma__report_memory(r, s->n_scenes, sizeof *scenes);
    if (n < (by_group ? 1 : 2)) {
        return;
    }
    koksma__doc_section(d, NULL, by_group ? "By what dominates the scenes' error" : "By scene");
    koksma__doc_table(d, "correlation-%s-%.40s", name, topic->id);
    koksma__doc_columns(d, "t %s;n7 cases;t best;t significantly worse than the best", name);
    for (size_t m = 0; m < s->n; m++) {
        koksma__doc_columns(d, "i2 %s", s->of[m].measure);
    }
    for (size_t i = 0; !r->status && i < n; i++) {
        char text[160], members[256] = "";
        for (size_t k = 0; k < s->n_scenes; k++) {
            scenes[k] = by_group ? koksma__texts_have(&topic->groups[i].scenes, s->scenes[k]) : k == i;
            if (scenes[k]) {
                koksma__text_join(members, sizeof members, ", ", s->scenes[k]);
            }
        }
        if (by_group) {
            snprintf(text, sizeof text, "%.70s (%.80s)", topic->groups[i].title, members);
        }
        add_part(r, d, s, by_group ? text : s->scenes[i], scenes);
    }
    koksma__doc_end(d);
}

static void add_scatter(koksma__report *r, koksma__document *d, const koksma__topic *topic, const one_case *p)
{
    const pairs found = read_pairs(r, topic, p);
    char title[256], name[KOKSMA__VARIANT_TEXT + 64];
    koksma__case_name(p->scene, p->variant, name, sizeof name);
    koksma__snprintf(title, sizeof title, "%.120s, %lld sample%s: error against %.60s, Spearman %.2f", name, p->spp,
                     koksma__plural((double)p->spp), p->of->label, koksma__spearman(found.x, found.y, found.n));
    koksma__doc_chart(d, &(koksma__chart){title, p->of->label, topic->metric, true, true, 0});
    for (size_t i = 0; i < found.n; i++) {
        koksma__doc_series(d, found.patterns[i], NULL, KOKSMA__SERIES_MARKS);
        koksma__doc_point(d, found.x[i], found.y[i], found.low[i], found.high[i]);
    }
}

void koksma__answer_correlation(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    koksma__document list = {0};
    koksma__rho_means means = {0};
    size_t n = 0;
    const one_case *cases = list_cases(r, topic, &n);
    koksma__doc_table(&list, "correlations-%.40s", topic->id);
    koksma__doc_columns(&list, "t scene;t options;n7 samples;t measure;n7 patterns;i3 Spearman##%s", topic->metric);
    for (size_t i = 0; !r->status && i < n; i++) {
        add_case(r, &list, topic, &cases[i], &means);
    }
    koksma__report_keep(r, list.json.status);
    koksma__rho_order(r, &means);
    const koksma__rho_jackknife jackknife = koksma__rho_leave_out(r, &means);
    if (r->status || !means.n) {
        koksma__json_writer_fini(&list.json);
        return;
    }
    koksma__rho_say(d, &means, &jackknife);
    add_measures(d, topic->id, &means, &jackknife);
    add_parts(r, d, topic, &means, true);
    add_parts(r, d, topic, &means, false);
    koksma__doc_collapsed_section(d, NULL, "Every case, with intervals");
    koksma__doc_append(d, &list);
    koksma__doc_end(d);
    for (size_t i = 0, plots = 0; i < n && plots < MOST_PLOTS; i++) {
        if (!strcmp(cases[i].of->label, means.of[0].measure) &&
            cases[i].spp == cases[i].image->spp.at[cases[i].image->spp.n / 2]) {
            add_scatter(r, d, topic, &cases[i]);
            plots++;
        }
    }
}
