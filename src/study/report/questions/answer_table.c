/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Means of every pattern with their intervals, a table for each block of points (and warp) and for each scene and
 * options of a block of images. The best pattern of the last column comes first. A table of images has the numbers of
 * samples at which a pattern's error is in visible bands (coherence_rows.h), and names the best pattern without bands.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "study/report/coherence_rows.h"
#include "study/report/means.h"
#include "study/report/questions/topic.h"

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

static void add_heads(koksma__document *d, const columns *c)
{
    char text[KOKSMA_MAX_SPEC + 32];
    koksma__doc_head(d, "pattern");
    for (size_t k = 0; k < c->n; k++) {
        if (c->image) {
            snprintf(text, sizeof text, "%lld samples", c->image->spp.at[k]);
        } else {
            const size_t sizes = c->discrepancy->n.n;
            snprintf(text, sizeof text, "%s, N = %lld", c->discrepancy->measures.at[k / sizes],
                     c->discrepancy->n.at[k % sizes]);
        }
        koksma__doc_head_interval(d, text, 4);
    }
    if (c->image) {
        koksma__doc_head(d, "in bands with");
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
static koksma_status add_bands(koksma_study *study, koksma__document *d, const columns *c, const char *pattern)
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
    koksma__doc_text(d, length ? text : known ? "none" : "not known");
    return status;
}

/* Says which pattern has the least error in the last column, and, where that is in bands, which has it without. */
static koksma_status say_best(koksma_study *study, koksma__document *d, const columns *c,
                              const koksma__texts *patterns, const double *means, const size_t *by)
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
    const char *best = patterns->at[by[0]];
    const long long spp = c->image->spp.at[c->n - 1];
    if (i == 0) {
        koksma__doc_paragraph(d, "With %lld samples %s leaves the least error, and no visible bands.", spp, best);
    } else if (i < patterns->n && isfinite(means[by[i]])) {
        koksma__doc_paragraph(d,
                              "With %lld samples %s leaves the least error, but in visible bands; of the patterns "
                              "without bands %s leaves the least, %.1f %% more.",
                              spp, best, patterns->at[by[i]], 100 * (means[by[i]] / means[by[0]] - 1));
    } else {
        koksma__doc_paragraph(
            d, "With %lld samples %s leaves the least error, but in visible bands; so do all others.", spp, best);
    }
    return status;
}

static koksma_status add_rows(koksma_study *study, koksma__document *d, const columns *c,
                              const koksma__texts *patterns, const size_t *by)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < patterns->n; i++) {
        koksma__doc_row(d);
        koksma__doc_text(d, patterns->at[by[i]]);
        for (size_t k = 0; !status && k < c->n; k++) {
            koksma__summary mean = {0};
            status = cell_of(study, c, patterns->at[by[i]], k, &mean);
            koksma__doc_interval(d, koksma__estimate_of(&mean));
        }
        if (!status && c->image) {
            status = add_bands(study, d, c, patterns->at[by[i]]);
        }
    }
    return status;
}

static koksma_status add_table(koksma_study *study, koksma__document *d, const char *file, const char *title,
                               const columns *c, const koksma__texts *patterns)
{
    double *means = malloc(patterns->n * sizeof *means);
    size_t *by = malloc(patterns->n * sizeof *by);
    koksma_status status = means && by ? order(study, c, patterns, means, by)
                                       : koksma__fail_memory(patterns->n * (sizeof *means + sizeof *by));
    if (!status) {
        koksma__doc_section(d, NULL, title);
        status = c->image ? koksma__say_reference(study, d, c->image, c->scene, c->variant) : KOKSMA_OK;
        koksma__doc_table_begin(d, file);
        add_heads(d, c);
        status = status ? status : add_rows(study, d, c, patterns, by);
        koksma__doc_table_end(d);
        status = !status && c->image ? say_best(study, d, c, patterns, means, by) : status;
        koksma__doc_end(d);
    }
    free(means);
    free(by);
    return status;
}

/* Means of a block's points, by warp where it has some. */
static koksma_status add_points(koksma_study *study, koksma__document *d, const char *id,
                                const koksma__discrepancy_block *block, size_t *number)
{
    koksma_status status = KOKSMA_OK;
    char file[64], title[96];
    for (size_t w = 0; !status && w < (block->warps.n ? block->warps.n : 1); w++) {
        const columns c = {.discrepancy = block,
                           .warp = block->warps.n ? block->warps.at[w] : "",
                           .n = block->n.n * block->measures.n};
        int length = snprintf(title, sizeof title, "Measures of the points");
        if (block->dim != 2) {
            snprintf(title + length, sizeof title - (size_t)length, ", %dD", block->dim);
        } else if (c.warp[0]) {
            snprintf(title + length, sizeof title - (size_t)length, " through %.40s", c.warp);
        }
        snprintf(file, sizeof file, "means-%.32s-%zu", id, ++*number);
        status = add_table(study, d, file, title, &c, &block->patterns);
    }
    return status;
}

/* Means of a block's images, by scene and options. */
static koksma_status add_images(koksma_study *study, koksma__document *d, const char *id,
                                const koksma__image_block *i, size_t *number)
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
        status = add_table(study, d, file, title, &c, &i->patterns);
    }
    return status;
}

koksma_status koksma__answer_table(koksma_study *study, koksma__document *d, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; !status && b < topic->n_discrepancies; b++) {
        status = add_points(study, d, topic->id, topic->discrepancies[b], &number);
    }
    for (size_t b = 0; !status && b < topic->n_images; b++) {
        status = add_images(study, d, topic->id, topic->images[b], &number);
    }
    return status;
}
