/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Tables of the means of every pattern, with their intervals: one for each measure (and warp) of a block of points,
 * and one for each scene and options of a block of images. The patterns are sorted by the last column, the best
 * first. A sentence reports whether the best pattern differs from all others in that column, by the intervals of the
 * differences, which hold together at 95 % (Bonferroni). A table of images has the numbers of samples at which a
 * pattern's error is in visible bands (koksma__mean_coherence), and the sentence names the best pattern without bands.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/elementary.h"
#include "study/report/report.h"

enum { NAMED = 4 };

/* The means of a subject, and its patterns by their means in the last column, the best first. */
typedef struct standing {
    const koksma__subject *of;
    const koksma__summary *means; /* [pattern * sizes + size] */
    /* by: indices of the patterns in order; known: number of patterns with a mean, which come first */
    size_t *by, known;
    char last[64]; /* head of the last column */
} standing;

/* The name and the last mean of pattern i of the order. */
static const char *name_at(const standing *s, size_t i)
{
    return s->of->patterns->at[s->by[i]];
}

static const koksma__summary *mean_at(const standing *s, size_t i)
{
    return &s->means[(s->by[i] + 1) * s->of->n->n - 1];
}

static void name_column(const koksma__subject *s, size_t k, char text[64])
{
    if (s->images) {
        snprintf(text, 64, "%lld sample%s", s->n->at[k], koksma__plural((double)s->n->at[k]));
    } else {
        snprintf(text, 64, "N = %lld", s->n->at[k]);
    }
}

/* ---- Which is the best, and how sure that is --------------------------------------------------------------- */

/* Half the width of the interval of the difference of two means, at 95 % for all comparisons together; NaN:
   unknown. */
static double half_of(const koksma__summary *a, const koksma__summary *b, size_t comparisons)
{
    const double half = koksma__hypot(a->high - a->mean, b->high - b->mean);
    const size_t fewer = a->n > 1 && (a->n < b->n || b->n < 2) ? a->n : b->n;
    return half > 0 ? half * koksma__student_quantile(1 - 0.025 / (double)comparisons, (double)(fewer - 1)) /
                          koksma_student_975(fewer - 1)
                    : half;
}

/* Whether the interval of the difference between pattern i of the order and the first contains 0. */
static bool is_tied(const standing *s, size_t i)
{
    const koksma__summary *first = mean_at(s, 0), *other = mean_at(s, i);
    return !koksma__compare(first->mean, other->mean) ||
           !(fabs(first->mean - other->mean) > half_of(first, other, s->known - 1));
}

static void say_standing(koksma__document *d, const standing *s)
{
    const koksma__summary *mean = mean_at(s, 0);
    size_t tied = 0, named = 0;
    for (size_t i = 1; i < s->known; i++) {
        tied += is_tied(s, i);
    }
    koksma__doc_answer(d, !tied, "*%s, %s:* ", s->of->name, s->last);
    if (tied) {
        koksma__doc_say(d, "undecided between %zu of %zu patterns: %s %.4g", tied + 1, s->known, name_at(s, 0),
                        mean->mean);
        for (size_t i = 1; i < s->known && named + 1 < NAMED; i++) {
            if (is_tied(s, i)) {
                koksma__doc_say(d, ", %s %.4g", name_at(s, i), mean_at(s, i)->mean);
                named++;
            }
        }
        if (tied > named) {
            koksma__doc_say(d, " and %zu more", tied - named);
        }
    } else {
        koksma__doc_say(d, "%s has the %s mean, %.4g", name_at(s, 0), s->of->larger ? "largest" : "least",
                        mean->mean);
        if (mean->low < mean->high) {
            koksma__doc_say(d, " (%.4g to %.4g)", mean->low, mean->high);
        }
        koksma__doc_say(d, ", told apart from %s at 95 %%; %s follows with %.4g",
                        s->known > 2 ? "all others" : "the other", name_at(s, 1), mean_at(s, 1)->mean);
    }
    koksma__doc_say(d, ".");
}

/* Writes the cell with the numbers of samples at which a pattern's error is in bands, such as "4, 16 samples". */
static void add_bands(koksma__report *r, koksma__document *d, const koksma__subject *s, const char *pattern)
{
    char text[512] = "", number[32];
    size_t known = 0;
    for (size_t k = 0; k < s->n->n; k++) {
        const koksma_coherence_values v = koksma__mean_coherence(r, s, pattern, s->n->at[k]);
        known += v.images > 0;
        if (v.coherent) {
            snprintf(number, sizeof number, "%lld", s->n->at[k]);
            koksma__text_join(text, sizeof text, ", ", number);
        }
    }
    if (*text) {
        koksma__text_join(text, sizeof text, " ", "samples");
    }
    koksma__doc_cells(d, "t", *text ? text : known ? "none" : "not known");
}

/* Writes whether the error of the best pattern, at the largest number of samples, is in visible bands. If it is, names
   the best pattern without bands. */
static void say_bands(koksma__report *r, koksma__document *d, const standing *s)
{
    size_t i = 0, known = 0;
    for (; i < s->known; i++) {
        const koksma_coherence_values v =
            koksma__mean_coherence(r, s->of, name_at(s, i), s->of->n->at[s->of->n->n - 1]);
        known += v.images > 0;
        if (!v.coherent) {
            break;
        }
    }
    if (!known) {
        return;
    }
    if (i == 0) {
        koksma__doc_say(d, " The error of %s has no visible bands.", name_at(s, 0));
    } else if (i < s->known) {
        koksma__doc_say(d,
                        " The error of %s is in visible bands; of the patterns without bands, %s has the least "
                        "error, %.1f %% more.",
                        name_at(s, 0), name_at(s, i), 100 * (mean_at(s, i)->mean / mean_at(s, 0)->mean - 1));
    } else {
        koksma__doc_say(d, " The errors of all patterns are in visible bands.");
    }
}

/* Writes a paragraph that names the metric of the errors and describes their reference, the block's last one. */
static void say_reference(koksma__report *r, koksma__document *d, const koksma__subject *s)
{
    const koksma__image_block *block = s->images;
    const koksma__reference *last = &block->references[block->n_references - 1];
    const double error = koksma__reference_error(r, s);
    koksma__doc_paragraph(
        d, "Errors by `%s` against the reference _%s_, the mean of %lld render%s with %lld samples a pixel of %s; ",
        s->metric, last->name, last->replicates, koksma__plural((double)last->replicates), last->spp, last->pattern);
    if (isfinite(error)) {
        koksma__doc_say(d, "its own error is about %.2g", error);
        if (strcmp(s->metric, KOKSMA__DEFAULT_METRIC) != 0) {
            koksma__doc_say(d, " by `%s`", KOKSMA__DEFAULT_METRIC);
        }
    } else {
        koksma__doc_say(d, "its own error is not known");
    }
    koksma__doc_say(d, ". Up to %lld trial%s.", block->trials, koksma__plural((double)block->trials));
    if (block->n_references > 1) {
        koksma__doc_say(d, " `koksma study export` also writes the errors against the plan's other references.");
    }
}

/* ---- Tables ------------------------------------------------------------------------------------------------ */

/* Adds the table of means. Returns whether some cell has no mean. */
static bool add_means(koksma__report *r, koksma__document *d, const standing *s)
{
    const koksma__subject *of = s->of;
    bool gaps = false;
    char text[64];
    koksma__doc_columns(d, "t pattern");
    for (size_t k = 0; k < of->n->n; k++) {
        name_column(of, k, text);
        koksma__doc_columns(d, "i4 %s##%s", text, of->metric);
    }
    if (of->images) {
        koksma__doc_columns(d, "t in bands with");
    }
    for (size_t i = 0; i < of->patterns->n; i++) {
        koksma__doc_row(d, "t", name_at(s, i));
        for (size_t k = 0; k < of->n->n; k++) {
            const koksma__summary *mean = &s->means[s->by[i] * of->n->n + k];
            gaps |= !mean->n;
            koksma__doc_cells(d, "i", koksma__estimate_of(mean));
        }
        if (of->images) {
            add_bands(r, d, of, name_at(s, i));
        }
    }
    return gaps;
}

static void add_table(koksma__report *r, koksma__document *d, const char *id, size_t number,
                      const koksma__subject *of)
{
    standing s = {
        .of = of, .means = koksma__read_means(r, of), .by = koksma__report_memory(r, of->patterns->n, sizeof *s.by)};
    if (r->status) {
        return;
    }
    s.known = koksma__order_means(&s.means[of->n->n - 1].mean, of->n->n * sizeof *s.means / sizeof(double),
                                  of->patterns->n, of->larger, s.by);
    name_column(of, of->n->n - 1, s.last);
    koksma__doc_section(d, NULL, "%s", of->name);
    if (s.known > 1) {
        say_standing(d, &s);
        if (of->images) {
            say_bands(r, d, &s);
        }
    }
    if (of->images) {
        say_reference(r, d, of);
    }
    koksma__doc_table(d, "means-%.32s-%zu", id, number);
    koksma__doc_sort(d, s.last, of->larger);
    if (add_means(r, d, &s) && koksma_study_left_out_at(r->study, 0)) {
        koksma__doc_paragraph(d, "A cell without a number has no results: the section *Left out* gives the reasons.");
    }
    koksma__doc_end(d);
}

void koksma__answer_table(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    koksma__subject s;
    for (size_t i = 0; !r->status && koksma__topic_subject(topic, i, false, &s); i++) {
        add_table(r, d, topic->id, i + 1, &s);
    }
}
