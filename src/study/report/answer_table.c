/* SPDX-License-Identifier: Apache-2.0 */
/* Means of every pattern, best first; and how many samples of each are as good as 16 of the plan's first. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "study/report/answers.h"
#include "study/report/coherence_rows.h"

enum { EQUAL_TO = 16 };

/* ---- Means --------------------------------------------------------------------------------------------- */

/* The columns of a table: n x measures, or n of a scene and variant. */
typedef struct columns {
    const koksma__discrepancy_block *discrepancy;
    const koksma__image_block *image;
    const char *scene, *variant; /* of images */
    const char *warp;            /* of points; "": none */
    size_t n;
} columns;

static koksma_status cell_of(koksma_study *study, const columns *c, const char *pattern, size_t k,
                             koksma__summary *mean)
{
    if (c->image) {
        return koksma__image_mean(study, c->image, c->scene, c->variant, pattern, c->image->spp.at[k], NULL, mean);
    }
    const size_t sizes = c->discrepancy->n.n;
    return koksma__discrepancy_mean(study, c->discrepancy, c->warp, pattern, c->discrepancy->n.at[k % sizes],
                                    c->discrepancy->measures.at[k / sizes], NULL, mean);
}

static void add_heads(koksma__grid *g, const columns *c)
{
    char text[KOKSMA_MAX_SPEC + 32];
    koksma__grid_head(g, "pattern");
    for (size_t k = 0; k < c->n; k++) {
        if (c->image) {
            snprintf(text, sizeof text, "%lld samples", c->image->spp.at[k]);
        } else {
            const size_t sizes = c->discrepancy->n.n;
            snprintf(text, sizeof text, "%s, N = %lld", c->discrepancy->measures.at[k / sizes],
                     c->discrepancy->n.at[k % sizes]);
        }
        koksma__grid_head_interval(g, text);
    }
    if (c->image) {
        koksma__grid_head(g, "in bands with");
    }
}

/* Whether the best of the last column is the largest. */
static bool is_larger_better(const columns *c)
{
    koksma_spec spec;
    return !c->image && !koksma_measure_spec(c->discrepancy->measures.at[(c->n - 1) / c->discrepancy->n.n], &spec) &&
           spec.measure->larger_is_better;
}

/* Patterns by their mean in the last column, the best first; means: room for them. */
static koksma_status order(koksma_study *study, const columns *c, const koksma__texts *patterns, double *means,
                           size_t *by)
{
    const double sign = is_larger_better(c) ? -1 : 1;
    for (size_t p = 0; p < patterns->n; p++) {
        koksma__summary mean;
        const koksma_status status = cell_of(study, c, patterns->at[p], c->n - 1, &mean);
        if (status) {
            return status;
        }
        size_t at = p;
        means[p] = isnan(mean.mean) ? (double)INFINITY : sign * mean.mean;
        for (; at > 0 && means[by[at - 1]] > means[p]; at--) {
            by[at] = by[at - 1];
        }
        by[at] = p;
    }
    return KOKSMA_OK;
}

static koksma_status coherence_of(koksma_study *study, const columns *c, const char *pattern, size_t k,
                                  koksma__row_coherence *out)
{
    return koksma__image_coherence(study, c->image, c->scene, c->variant, pattern, c->image->spp.at[k], out);
}

/* The numbers of samples at which a pattern's error is in bands: "4, 16 samples". */
static koksma_status add_bands(koksma_study *study, koksma__grid *grid, const columns *c, const char *pattern)
{
    koksma_status status = KOKSMA_OK;
    char text[512] = "";
    size_t length = 0, known = 0;
    for (size_t k = 0; !status && k < c->n; k++) {
        koksma__row_coherence coherence;
        status = coherence_of(study, c, pattern, k, &coherence);
        known += coherence.mean.n > 0;
        if (koksma__in_bands(&coherence) && length < sizeof text) {
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%lld", length ? ", " : "",
                                       c->image->spp.at[k]);
        }
    }
    if (length && length < sizeof text) {
        snprintf(text + length, sizeof text - length, " samples");
    }
    koksma__grid_text(grid, length ? text : known ? "none" : "not known");
    return status;
}

/* Says which pattern has the least error in the last column, and, where that is in bands, which has it without. */
static koksma_status add_best(koksma_study *study, koksma__html *h, const columns *c, const koksma__texts *patterns,
                              const double *means, const size_t *by)
{
    koksma_status status = KOKSMA_OK;
    size_t i = 0, known = 0;
    for (; !status && i < patterns->n && isfinite(means[by[i]]); i++) {
        koksma__row_coherence coherence;
        status = coherence_of(study, c, patterns->at[by[i]], c->n - 1, &coherence);
        known += coherence.mean.n > 0;
        if (!koksma__in_bands(&coherence)) {
            break;
        }
    }
    if (status || !known) {
        return status;
    }
    const bool found = i < patterns->n && isfinite(means[by[i]]);
    koksma__html_add(h, "<p>With %lld samples ", c->image->spp.at[c->n - 1]);
    koksma__html_text(h, patterns->at[by[0]]);
    if (found && i == 0) {
        koksma__html_add(h, " leaves the least error, and no visible bands.</p>\n");
        return status;
    }
    koksma__html_add(h, " leaves the least error, but in visible bands; ");
    if (found) {
        koksma__html_add(h, "of the patterns without bands ");
        koksma__html_text(h, patterns->at[by[i]]);
        koksma__html_add(h, " leaves the least, %.1f %% more.</p>\n", 100 * (means[by[i]] / means[by[0]] - 1));
    } else {
        koksma__html_add(h, "so do all others.</p>\n");
    }
    return status;
}

static koksma_status add_rows(koksma_study *study, koksma__grid *grid, const columns *c,
                              const koksma__texts *patterns, const size_t *by)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < patterns->n; i++) {
        koksma__grid_row(grid);
        koksma__grid_text(grid, patterns->at[by[i]]);
        for (size_t k = 0; !status && k < c->n; k++) {
            koksma__summary mean = {0};
            status = cell_of(study, c, patterns->at[by[i]], k, &mean);
            koksma__grid_interval(grid, koksma__estimate_of(&mean), 4);
        }
        if (!status && c->image) {
            status = add_bands(study, grid, c, patterns->at[by[i]]);
        }
    }
    return status;
}

static koksma_status add_table(koksma_study *study, koksma__html *h, const char *file, const char *title,
                               const columns *c, const koksma__texts *patterns)
{
    koksma__grid grid;
    double *means = malloc(patterns->n * sizeof *means);
    size_t *by = malloc(patterns->n * sizeof *by);
    koksma_status status = means && by ? order(study, c, patterns, means, by)
                                       : koksma__fail_memory(patterns->n * (sizeof *means + sizeof *by));
    if (!status) {
        koksma__html_add(h, "<h4>");
        koksma__html_text(h, title);
        koksma__html_add(h, "</h4>\n");
        status = c->image ? koksma__add_reference(study, h, c->image, c->scene, c->variant) : KOKSMA_OK;
        koksma__grid_open(&grid, h, file);
        add_heads(&grid, c);
        status = status ? status : add_rows(study, &grid, c, patterns, by);
        koksma__grid_close(&grid);
        status = !status && c->image ? add_best(study, h, c, patterns, means, by) : status;
    }
    free(means);
    free(by);
    return status;
}

/* Means of a block's points, by warp where it has some. */
static koksma_status add_points(koksma_study *study, koksma__html *h, const char *id,
                                const koksma__discrepancy_block *d, size_t *number)
{
    koksma_status status = KOKSMA_OK;
    char file[64], title[96];
    for (size_t w = 0; !status && w < (d->warps.n ? d->warps.n : 1); w++) {
        const columns c = {.discrepancy = d, .warp = d->warps.n ? d->warps.at[w] : "", .n = d->n.n * d->measures.n};
        int length = snprintf(title, sizeof title, "Measures of the points");
        if (d->dim != 2) {
            snprintf(title + length, sizeof title - (size_t)length, ", %dD", d->dim);
        } else if (c.warp[0]) {
            snprintf(title + length, sizeof title - (size_t)length, " through %.40s", c.warp);
        }
        snprintf(file, sizeof file, "means-%.32s-%zu", id, ++*number);
        status = add_table(study, h, file, title, &c, &d->patterns);
    }
    return status;
}

/* Means of a block's images, by scene and options. */
static koksma_status add_images(koksma_study *study, koksma__html *h, const char *id, const koksma__image_block *i,
                                size_t *number)
{
    koksma_status status = KOKSMA_OK;
    char file[64], title[KOKSMA__VARIANT_TEXT + 64];
    for (size_t k = 0; !status && k < i->scenes.n * i->variants.n; k++) {
        const columns c = {.image = i,
                           .scene = i->scenes.at[k / i->variants.n],
                           .variant = i->variants.at[k % i->variants.n],
                           .n = i->spp.n};
        koksma__case_name(c.scene, c.variant, title, sizeof title);
        snprintf(file, sizeof file, "means-%.32s-%zu", id, ++*number);
        status = add_table(study, h, file, title, &c, &i->patterns);
    }
    return status;
}

koksma_status koksma__answer_table(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; !status && b < topic->n_discrepancies; b++) {
        status = add_points(study, h, topic->id, topic->discrepancies[b], &number);
    }
    for (size_t b = 0; !status && b < topic->n_images; b++) {
        status = add_images(study, h, topic->id, topic->images[b], &number);
    }
    return status;
}

/* ---- Equal error --------------------------------------------------------------------------------------- */

static koksma_status convergence(koksma_study *study, const columns *c, const char *pattern, double *n, double *mean,
                                 double *error, koksma__convergence *out)
{
    koksma_status status = KOKSMA_OK;
    *out = (koksma__convergence){n, mean, error, 0};
    for (size_t k = 0; !status && k < c->n; k++) {
        koksma__summary s;
        status = cell_of(study, c, pattern, k, &s);
        if (!status && s.n && s.mean > 0) {
            n[out->count] = (double)c->image->spp.at[k];
            mean[out->count] = s.mean;
            error[out->count++] = s.sd / sqrt((double)s.n);
        }
    }
    return status;
}

static koksma_status add_equal(koksma_study *study, koksma__grid *g, const columns *c)
{
    const koksma__texts *patterns = &c->image->patterns;
    koksma__convergence p;
    koksma__summary target = {0};
    double *n = malloc(3 * c->n * sizeof *n);
    if (!n) {
        return koksma__fail_memory(3 * c->n * sizeof *n);
    }
    koksma_status status =
        koksma__image_mean(study, c->image, c->scene, c->variant, patterns->at[0], EQUAL_TO, NULL, &target);
    for (size_t i = 0; !status && target.n && i < patterns->n; i++) {
        bool outside = false;
        char name[KOKSMA__VARIANT_TEXT + 64];
        status = convergence(study, c, patterns->at[i], n, n + c->n, n + 2 * c->n, &p);
        const koksma__estimate e =
            i ? koksma__samples_for(&p, target.mean, target.sd / sqrt((double)target.n), &outside)
              : (koksma__estimate){EQUAL_TO, EQUAL_TO, EQUAL_TO};
        koksma__case_name(c->scene, c->variant, name, sizeof name);
        koksma__grid_row(g);
        koksma__grid_text(g, name);
        koksma__grid_text(g, patterns->at[i]);
        koksma__grid_interval(g, e, 3);
        koksma__grid_text(g, i == 0           ? "itself"
                             : isnan(e.value) ? "its error doesn't fall"
                             : outside        ? "extrapolated"
                                              : "between sizes");
    }
    free(n);
    return status;
}

koksma_status koksma__answer_equal(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    char text[KOKSMA_MAX_SPEC + 64];
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        bool has_target = false;
        for (size_t k = 0; k < i->spp.n; k++) {
            has_target |= i->spp.at[k] == EQUAL_TO;
        }
        if (i->spp.n < 2 || !has_target) {
            continue;
        }
        koksma__grid grid;
        snprintf(text, sizeof text, "equal-%.32s-%zu", topic->id, b + 1);
        koksma__grid_open(&grid, h, text);
        koksma__grid_head(&grid, "scene");
        koksma__grid_head(&grid, "pattern");
        snprintf(text, sizeof text, "samples as good as %d of %s", EQUAL_TO, i->patterns.at[0]);
        koksma__grid_head_interval(&grid, text);
        koksma__grid_head(&grid, "how");
        for (size_t k = 0; !status && k < i->scenes.n * i->variants.n; k++) {
            const columns c = {.image = i,
                               .scene = i->scenes.at[k / i->variants.n],
                               .variant = i->variants.at[k % i->variants.n],
                               .n = i->spp.n};
            status = add_equal(study, &grid, &c);
        }
        koksma__grid_close(&grid);
    }
    return status;
}
