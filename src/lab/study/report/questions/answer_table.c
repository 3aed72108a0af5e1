/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables of the means of every pattern, with their intervals: one for each measure (and warp) of a block of points,
 * and one for each scene and options of a block of images. The patterns are sorted by the last column, the best
 * first. A sentence reports whether the best pattern differs from all others in that column, by the intervals of the
 * differences, which hold together at 95 % (Bonferroni). If the best pattern does not differ from some other, the
 * sentence says how many trials might separate the two. A table of images has the numbers of samples at which a
 * pattern's error is in visible bands (mean_coherence.h), and the sentence names the best pattern without bands.
 * Below it a second table compares the images with the largest number of samples by all metrics of the block.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/status.h"
#include "stats/stats.h"
#include "study/report/mean_coherence.h"
#include "study/report/means.h"
#include "study/report/questions/topic.h"

enum { NAMED = 4 };

/* The subject of a table: the means of one measure of points, or of the errors of images of one scene and
   variant. */
typedef struct subject {
    const koksma__discrepancy_block *discrepancy;
    const koksma__image_block *image;
    const char *scene, *variant, *metric; /* for images */
    const char *measure, *warp;           /* set for measures of points; if warp is "", the points are not warped */
    const koksma__texts *patterns;
    const koksma__wholes *n;
    const char *name, *last; /* heading of the table; head of its last column */
    bool larger;             /* whether larger means are better */
} subject;

/* The patterns by their means in the last column, the best first. */
typedef struct standing {
    koksma__summary *means; /* in the order of the patterns */
    /* by: indices of the patterns in order; known: number of patterns with a mean, which come first */
    size_t *by, known;
} standing;

static koksma_status cell_of(koksma_study *study, const subject *c, size_t pattern, size_t k, koksma__summary *mean)
{
    const char *name = c->patterns->at[pattern];
    return c->image
               ? koksma__image_mean_by(study,
                                       &(koksma__image_mean){c->image, c->scene, c->variant, name, c->n->at[k]},
                                       c->metric, NULL, mean)
               : koksma__discrepancy_mean(study, c->discrepancy, c->warp, name, c->n->at[k], c->measure, NULL, mean);
}

static void name_column(const subject *c, size_t k, char text[64])
{
    if (c->image) {
        snprintf(text, 64, "%lld sample%s", c->n->at[k], koksma__plural((double)c->n->at[k]));
    } else {
        snprintf(text, 64, "N = %lld", c->n->at[k]);
    }
}

static void add_heads(koksma__document *d, const subject *c)
{
    char text[64];
    koksma__doc_head(d, "pattern");
    for (size_t k = 0; k < c->n->n; k++) {
        name_column(c, k, text);
        koksma__doc_column(
            d, &(koksma__column){
                   .name = text, .group = c->image ? c->metric : NULL, .type = KOKSMA__COLUMN_INTERVAL, .digits = 4});
    }
    if (c->image) {
        koksma__doc_head(d, "in bands with");
    }
}

static bool is_before(const subject *c, double a, double b)
{
    return c->larger ? a > b : a < b;
}

static koksma_status order(koksma_study *study, const subject *c, standing *s)
{
    for (size_t p = 0; p < c->patterns->n; p++) {
        const koksma_status status = cell_of(study, c, p, c->n->n - 1, &s->means[p]);
        if (status) {
            return status;
        }
        size_t at = p;
        const bool known = !isnan(s->means[p].mean);
        for (; at > 0 && known && (at > s->known || is_before(c, s->means[p].mean, s->means[s->by[at - 1]].mean));
             at--) {
            s->by[at] = s->by[at - 1];
        }
        s->by[at] = p;
        s->known += known;
    }
    return KOKSMA_OK;
}

/* ---- Which is the best, and how sure that is --------------------------------------------------------------- */

/* Half the width of the interval of the difference of two means, at 95 % for all comparisons together; NaN:
   unknown. */
static double half_of(const koksma__summary *a, const koksma__summary *b, size_t comparisons)
{
    const double half = hypot(a->high - a->mean, b->high - b->mean);
    const size_t fewer = a->n > 1 && (a->n < b->n || b->n < 2) ? a->n : b->n;
    return half > 0 ? half * koksma__student_quantile(1 - 0.025 / (double)comparisons, (double)(fewer - 1)) /
                          koksma_student_975(fewer - 1)
                    : half;
}

/* Whether the interval of the difference between pattern i of the order and the first contains 0. */
static bool is_tied(const standing *s, size_t i)
{
    const koksma__summary *first = &s->means[s->by[0]], *other = &s->means[s->by[i]];
    return !koksma__compare(first->mean, other->mean) ||
           !(fabs(first->mean - other->mean) > half_of(first, other, s->known - 1));
}

/* Writes how many trials would separate the best pattern from pattern i of the order, the first one that is tied
   with it. */
static void say_trials(koksma__document *d, const subject *c, const standing *s, size_t i)
{
    const koksma__summary *a = &s->means[s->by[0]], *b = &s->means[s->by[i]];
    const char *first = c->patterns->at[s->by[0]], *other = c->patterns->at[s->by[i]];
    const double half = half_of(a, b, s->known - 1), trials = (double)(a->n > b->n ? a->n : b->n);
    if (!koksma__compare(a->mean, b->mean)) {
        koksma__doc_say(d, " %s and %s have equal means", first, other);
    } else if (isnan(half)) {
        koksma__doc_say(d, " A mean of one trial has no interval: 2 or more trials are needed");
    } else {
        const double needed = trials * koksma__trials_factor(a->mean - b->mean, half);
        const double unit = pow(10, floor(log10(needed)) - 1);
        koksma__doc_say(d, " About %.0f trials instead of %.0f would tell %s from %s",
                        fmax(ceil(needed / unit) * unit, trials + 1), trials, first, other);
    }
}

static void say_standing(koksma__document *d, const subject *c, const standing *s)
{
    const char *first = c->patterns->at[s->by[0]], *most = c->larger ? "largest" : "least";
    const koksma__summary *mean = &s->means[s->by[0]];
    size_t tied = 0, next = 0, named = 0;
    for (size_t i = s->known; i-- > 1;) {
        next = is_tied(s, i) ? i : next;
        tied += is_tied(s, i);
    }
    koksma__doc_answer_begin(d, !tied);
    koksma__doc_say(d, "*%s, %s:* ", c->name, c->last);
    if (tied) {
        koksma__doc_say(d, "undecided between %zu of %zu patterns: %s %.4g", tied + 1, s->known, first, mean->mean);
        for (size_t i = 1; i < s->known && named + 1 < NAMED; i++) {
            if (is_tied(s, i)) {
                koksma__doc_say(d, ", %s %.4g", c->patterns->at[s->by[i]], s->means[s->by[i]].mean);
                named++;
            }
        }
        if (tied > named) {
            koksma__doc_say(d, " and %zu more", tied - named);
        }
        koksma__doc_say(d, ".");
        say_trials(d, c, s, next);
    } else {
        koksma__doc_say(d, "%s has the %s mean, %.4g", first, most, mean->mean);
        if (mean->low < mean->high) {
            koksma__doc_say(d, " (%.4g to %.4g)", mean->low, mean->high);
        }
        koksma__doc_say(d, ", told apart from %s at 95 %%; %s follows with %.4g",
                        s->known > 2 ? "all others" : "the other", c->patterns->at[s->by[1]],
                        s->means[s->by[1]].mean);
    }
    koksma__doc_say(d, ".");
}

static koksma_status coherence_of(koksma_study *study, const subject *c, size_t pattern, size_t k,
                                  koksma_coherence_values *out)
{
    const koksma__image_mean of = {c->image, c->scene, c->variant, c->patterns->at[pattern], c->n->at[k]};
    return koksma__mean_coherence(study, &of, out);
}

/* Writes the cell with the numbers of samples at which a pattern's error is in bands, such as "4, 16 samples". */
static koksma_status add_bands(koksma_study *study, koksma__document *d, const subject *c, size_t pattern)
{
    koksma_status status = KOKSMA_OK;
    char text[512] = "";
    size_t length = 0, known = 0;
    for (size_t k = 0; !status && k < c->n->n; k++) {
        koksma_coherence_values coherence;
        status = coherence_of(study, c, pattern, k, &coherence);
        known += coherence.images > 0;
        if (coherence.coherent && length < sizeof text) {
            length +=
                (size_t)snprintf(text + length, sizeof text - length, "%s%lld", length ? ", " : "", c->n->at[k]);
        }
    }
    if (length && length < sizeof text) {
        snprintf(text + length, sizeof text - length, " samples");
    }
    koksma__doc_text(d, length ? text : known ? "none" : "not known");
    return status;
}

/* Writes whether the error of the best pattern, at the largest number of samples, is in visible bands. If it is, names
   the best pattern without bands. */
static koksma_status say_bands(koksma_study *study, koksma__document *d, const subject *c, const standing *s)
{
    koksma_status status = KOKSMA_OK;
    size_t i = 0, known = 0;
    for (; !status && i < s->known; i++) {
        koksma_coherence_values coherence;
        status = coherence_of(study, c, s->by[i], c->n->n - 1, &coherence);
        known += coherence.images > 0;
        if (!coherence.coherent) {
            break;
        }
    }
    if (status || !known) {
        return status;
    }
    const char *first = c->patterns->at[s->by[0]];
    if (i == 0) {
        koksma__doc_say(d, " The error of %s has no visible bands.", first);
    } else if (i < s->known) {
        koksma__doc_say(
            d,
            " The error of %s is in visible bands; of the patterns without bands, %s has the least error, "
            "%.1f %% more.",
            first, c->patterns->at[s->by[i]], 100 * (s->means[s->by[i]].mean / s->means[s->by[0]].mean - 1));
    } else {
        koksma__doc_say(d, " The errors of all patterns are in visible bands.");
    }
    return status;
}

/* ---- Tables ------------------------------------------------------------------------------------------------ */

/* Adds the rows. *gaps: whether some cell has no mean. */
static koksma_status add_rows(koksma_study *study, koksma__document *d, const subject *c, const standing *s,
                              bool *gaps)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < c->patterns->n; i++) {
        koksma__doc_row(d);
        koksma__doc_text(d, c->patterns->at[s->by[i]]);
        for (size_t k = 0; !status && k < c->n->n; k++) {
            koksma__summary mean = {0};
            status = cell_of(study, c, s->by[i], k, &mean);
            *gaps |= !mean.n;
            koksma__doc_interval(d, koksma__estimate_of(&mean));
        }
        if (!status && c->image) {
            status = add_bands(study, d, c, s->by[i]);
        }
    }
    return status;
}

/* ---- The other metrics ------------------------------------------------------------------------------------- */

/* The means by all metrics of the block, of the images with the largest number of samples: means[p * metrics + m]. */
typedef struct by_metrics {
    const koksma__texts *metrics;
    koksma__metric_means *means;
    size_t patterns;
} by_metrics;

static koksma_status read_metrics(koksma_study *study, const subject *c, by_metrics *all)
{
    koksma_status status = KOKSMA_OK;
    const size_t n = all->metrics->n;
    for (size_t i = 0; !status && i < all->patterns * n; i++) {
        const koksma__image_mean of = {c->image, c->scene, c->variant, c->patterns->at[i / n], c->n->at[c->n->n - 1]};
        status = koksma__image_metric(study, &of, all->metrics->at[i % n], &all->means[i]);
    }
    return status;
}

/* The position of a pattern by a metric: 1 + the number of patterns with a smaller mean; NaN: no mean. */
static double position_of(const by_metrics *all, size_t pattern, size_t metric)
{
    const size_t n = all->metrics->n;
    const koksma__summary *mean = &all->means[pattern * n + metric].value;
    double position = mean->n ? 1 : (double)NAN;
    for (size_t p = 0; p < all->patterns; p++) {
        const koksma__summary *other = &all->means[p * n + metric].value;
        position += other->n && other->mean < mean->mean;
    }
    return position;
}

/* Names the pattern with the least mean by each metric. */
static void say_metrics(koksma__document *d, const subject *c, const by_metrics *all)
{
    koksma__doc_paragraph_begin(d);
    koksma__doc_say(d, "The least error with %s, by each metric:", c->last);
    for (size_t m = 0; m < all->metrics->n; m++) {
        const char *best = NULL;
        for (size_t p = all->patterns; p-- > 0;) {
            best = position_of(all, p, m) < 1.5 ? c->patterns->at[p] : best; /* NaN: no mean */
        }
        koksma__doc_say(d, "%s `%s` %s", m ? "," : "", all->metrics->at[m], best ? best : "not measured");
    }
    koksma__doc_say(d, ".");
    koksma__doc_paragraph_end(d);
}

static void add_metric_heads(koksma__document *d, const by_metrics *all)
{
    koksma__doc_head(d, "pattern");
    for (size_t m = 0; m < all->metrics->n; m++) {
        char name[KOKSMA_MAX_SPEC + 32];
        const char *group = all->metrics->at[m];
        koksma__doc_column(
            d,
            &(koksma__column){
                .name = group, .title = "mean 95 %", .group = group, .type = KOKSMA__COLUMN_INTERVAL, .digits = 4});
        snprintf(name, sizeof name, "%s, position", group);
        koksma__doc_column(
            d, &(koksma__column){
                   .name = name, .title = "position", .group = group, .type = KOKSMA__COLUMN_NUMBER, .digits = 3});
        snprintf(name, sizeof name, "%s, robust", group);
        koksma__doc_column(d, &(koksma__column){.name = name,
                                                .title = "without 0.1 %",
                                                .group = group,
                                                .type = KOKSMA__COLUMN_NUMBER,
                                                .digits = 4,
                                                .hidden = true});
        snprintf(name, sizeof name, "%s, top share", group);
        koksma__doc_column(
            d, &(koksma__column){
                   .name = name, .group = group, .type = KOKSMA__COLUMN_NUMBER, .digits = 3, .hidden = true});
    }
}

static void add_metric_rows(koksma__document *d, const subject *c, const standing *s, const by_metrics *all)
{
    for (size_t i = 0; i < all->patterns; i++) {
        koksma__doc_row(d);
        koksma__doc_text(d, c->patterns->at[s->by[i]]);
        for (size_t m = 0; m < all->metrics->n; m++) {
            const koksma__metric_means *of = &all->means[s->by[i] * all->metrics->n + m];
            koksma__doc_interval(d, koksma__estimate_of(&of->value));
            koksma__doc_number(d, position_of(all, s->by[i], m));
            koksma__doc_number(d, of->robust.mean);
            koksma__doc_number(d, of->top_share.mean);
        }
    }
}

/* Adds the table of the means by all metrics, in the order of the table above it. */
static koksma_status add_metrics(koksma_study *study, koksma__document *d, const char *id, size_t number,
                                 const subject *c, const standing *s)
{
    by_metrics all = {.metrics = &c->image->metrics, .patterns = c->patterns->n};
    const size_t size = all.patterns * all.metrics->n * sizeof *all.means;
    char file[64];
    all.means = malloc(size);
    KOKSMA__REQUIRE_MEMORY(all.means, size);
    const koksma_status status = read_metrics(study, c, &all);
    if (!status) {
        snprintf(file, sizeof file, "metrics-%.32s-%zu", id, number);
        koksma__doc_section(d, NULL, "By all metrics");
        say_metrics(d, c, &all);
        koksma__doc_table_begin(d, file);
        add_metric_heads(d, &all);
        add_metric_rows(d, c, s, &all);
        koksma__doc_table_end(d);
        koksma__doc_end(d);
    }
    free(all.means);
    return status;
}

static koksma_status add_table(koksma_study *study, koksma__document *d, const char *id, size_t number, subject *c)
{
    const size_t n = c->patterns->n;
    char file[64], last[64];
    standing s = {calloc(n, sizeof *s.means), calloc(n, sizeof *s.by), 0};
    koksma_status status =
        s.means && s.by ? order(study, c, &s) : koksma__fail_memory(n * (sizeof *s.means + sizeof *s.by));
    if (!status) {
        snprintf(file, sizeof file, "means-%.32s-%zu", id, number);
        name_column(c, c->n->n - 1, last);
        c->last = last;
        koksma__doc_section(d, NULL, c->name);
        if (s.known > 1) {
            say_standing(d, c, &s);
            status = c->image ? say_bands(study, d, c, &s) : KOKSMA_OK;
            koksma__doc_paragraph_end(d);
        }
        status =
            !status && c->image ? koksma__say_reference(study, d, c->image, c->scene, c->variant, c->metric) : status;
        koksma__doc_sorted_table_begin(d, file, last, false, c->larger);
        add_heads(d, c);
        bool gaps = false;
        status = status ? status : add_rows(study, d, c, &s, &gaps);
        koksma__doc_table_end(d);
        if (gaps && koksma_study_left_out_at(study, 0)) {
            koksma__doc_paragraph(
                d, "A cell without a number has no results: the section *Left out* gives the reasons.");
        }
        status = !status && c->image ? add_metrics(study, d, id, number, c, &s) : status;
        koksma__doc_end(d);
    }
    free(s.means);
    free(s.by);
    return status;
}

/* Adds the tables of a block of points: one for each measure, and for each warp if the block has warps. */
static koksma_status add_points(koksma_study *study, koksma__document *d, const char *id,
                                const koksma__discrepancy_block *block, size_t *number)
{
    koksma_status status = KOKSMA_OK;
    char name[KOKSMA_MAX_SPEC + 64];
    for (size_t i = 0; !status && i < block->measures.n * (block->warps.n ? block->warps.n : 1); i++) {
        subject c = {.discrepancy = block,
                     .measure = block->measures.at[i % block->measures.n],
                     .warp = block->warps.n ? block->warps.at[i / block->measures.n] : "",
                     .patterns = &block->patterns,
                     .n = &block->n,
                     .name = name};
        koksma_spec spec;
        c.larger = !koksma_measure_spec(c.measure, &spec) && spec.measure->larger_is_better;
        const int length = snprintf(name, sizeof name, "%s", c.measure);
        if (block->dim != 2) {
            snprintf(name + length, sizeof name - (size_t)length, ", %dD", block->dim);
        } else if (c.warp[0]) {
            snprintf(name + length, sizeof name - (size_t)length, " through %.40s", c.warp);
        }
        status = add_table(study, d, id, ++*number, &c);
    }
    return status;
}

/* Adds the tables of a block of images: one for each scene and combination of options. */
static koksma_status add_images(koksma_study *study, koksma__document *d, const koksma__topic *topic,
                                const koksma__image_block *i, size_t *number)
{
    koksma_status status = KOKSMA_OK;
    char name[KOKSMA__VARIANT_TEXT + 64];
    for (size_t k = 0; !status && k < i->scenes.n * i->variants.n; k++) {
        subject c = {.image = i,
                     .scene = i->scenes.at[k / i->variants.n],
                     .variant = i->variants.at[k % i->variants.n],
                     .metric = topic->metric,
                     .patterns = &i->patterns,
                     .n = &i->spp,
                     .name = name};
        koksma__case_name(c.scene, c.variant, name, sizeof name);
        status = add_table(study, d, topic->id, ++*number, &c);
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
        status = add_images(study, d, topic, topic->images[b], &number);
    }
    return status;
}
