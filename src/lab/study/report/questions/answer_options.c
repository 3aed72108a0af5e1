/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Answers how options (of renders) and warps (of points) change the means: by the relative difference to the first
 * option or warp, paired by trial, because trials with the same number use the same points. A row is for one pattern
 * and one number of points or samples in a case (a scene or a measure). A sentence for each option sums up its rows
 * by the geometric mean of the ratios.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/report/means.h"
#include "study/report/questions/topic.h"

/* The comparisons of one option with option 0, counted over all rows (pattern, number of points or samples,
   case). */
typedef struct comparison {
    /* equal: number of rows that are equal bit for bit in every trial; unknown: number of rows without an interval */
    size_t cases, better, worse, equal, unknown;
    double logs; /* sum of the logarithms of the ratios */
} comparison;

typedef struct side {
    koksma__result *results;
    koksma__summary mean;
} side;

/* Collects the values of the trials that both sides have: *n values of `base`, followed by *n values of `other`. */
static koksma_status pair(const side *base, const side *other, double **values, size_t *n)
{
    const size_t room = base->mean.n < other->mean.n ? base->mean.n : other->mean.n;
    *n = 0;
    *values = malloc((2 * room + 1) * sizeof **values);
    KOKSMA__REQUIRE_MEMORY(*values, (2 * room + 1) * sizeof **values);
    for (size_t i = 0, k = 0; i < base->mean.n && k < other->mean.n;) {
        const koksma__result *a = &base->results[i], *b = &other->results[k];
        if (a->trial == b->trial) {
            (*values)[*n] = a->values[0];
            (*values)[room + (*n)++] = b->values[0];
        }
        i += a->trial <= b->trial;
        k += b->trial <= a->trial;
    }
    if (*n < room) { /* move the second list directly behind the first */
        memmove(*values + *n, *values + room, *n * sizeof **values);
    }
    return KOKSMA_OK;
}

static koksma_status compare(koksma__document *d, const side *base, const side *other, comparison *t)
{
    double *values;
    size_t n;
    KOKSMA__TRY(pair(base, other, &values, &n));
    koksma__estimate e = koksma__relative_change(values + n, values, n);
    if (n == 1 && base->mean.low == base->mean.high && other->mean.low == other->mean.high) { /* both are exact */
        e.low = e.high = e.value;
    }
    koksma__doc_interval(d, e);
    if (!isnan(e.value)) {
        const bool equal = !memcmp(values, values + n, n * sizeof *values);
        t->cases++;
        t->better += e.high < 0;
        t->worse += e.low > 0;
        t->equal += equal;
        t->unknown += !equal && isnan(e.low);
        t->logs += log(1 + e.value);
    }
    free(values);
    return KOKSMA_OK;
}

static const char *name_of(const char *option)
{
    return option[0] ? option : "defaults";
}

static void say_change(koksma__document *d, const char *base, const char *other, const comparison *t)
{
    if (!t->cases) {
        return;
    }
    koksma__doc_answer_begin(d, t->better + t->worse + t->equal > 0);
    koksma__doc_say(d,
                    "*%s instead of %s:* %+.1f %% (geometric mean over %zu cases); surely smaller in %zu, surely "
                    "larger in %zu, too close to tell in %zu",
                    name_of(other), name_of(base), 100 * (exp(t->logs / (double)t->cases) - 1), t->cases, t->better,
                    t->worse, t->cases - t->better - t->worse - t->equal - t->unknown);
    if (t->equal) {
        koksma__doc_say(d, ", equal bit for bit in %zu", t->equal);
    }
    if (t->unknown) {
        koksma__doc_say(d, ", unknown in %zu with a single trial", t->unknown);
    }
    koksma__doc_say(d, ".");
    koksma__doc_paragraph_end(d);
}

/* A case whose rows (one per pattern and n) have the first option's mean and the other options' relative
   differences. */
typedef struct option_case {
    const char *name, *measure, *metric; /* metric: metric of the image errors */
    const koksma__texts *patterns, *options;
    const koksma__wholes *n;
    const koksma__image_block *image;
    const koksma__discrepancy_block *discrepancy;
} option_case;

static koksma_status add_row(koksma_study *study, koksma__document *d, const option_case *c, const char *pattern,
                             long long n, comparison *changes)
{
    side base = {0};
    koksma_status status = KOKSMA_OK;
    koksma__doc_row(d);
    koksma__doc_text(d, c->image ? c->name : c->measure);
    koksma__doc_text(d, pattern);
    koksma__doc_number(d, (double)n);
    for (size_t v = 0; !status && v < c->options->n; v++) {
        side s = {0};
        const koksma__image_mean of = {c->image, c->name, c->options->at[v], pattern, n};
        status = c->image ? koksma__image_mean_by(study, &of, c->metric, &s.results, &s.mean)
                          : koksma__discrepancy_mean(study, c->discrepancy, c->options->at[v], pattern, n, c->measure,
                                                     &s.results, &s.mean);
        if (!status && v == 0) {
            base = s;
            koksma__doc_interval(d, koksma__estimate_of(&s.mean));
        } else if (!status) {
            status = compare(d, &base, &s, &changes[v]);
            free(s.results);
        }
    }
    free(base.results);
    return status;
}

static koksma_status add_case(koksma_study *study, koksma__document *d, const option_case *c, comparison *changes)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < c->patterns->n * c->n->n; i++) {
        status = add_row(study, d, c, c->patterns->at[i / c->n->n], c->n->at[i % c->n->n], changes);
    }
    return status;
}

static void add_heads(koksma__document *d, const option_case *c)
{
    char text[KOKSMA__VARIANT_TEXT + 64];
    koksma__doc_head(d, c->image ? "scene" : "measure");
    koksma__doc_head(d, "pattern");
    koksma__doc_head_number(d, "N", 7);
    for (size_t v = 0; v < c->options->n; v++) {
        snprintf(text, sizeof text, "%s%s", v ? "relative change: " : "", name_of(c->options->at[v]));
        koksma__doc_column(
            d, &(koksma__column){
                   .name = text, .group = c->image ? c->metric : NULL, .type = KOKSMA__COLUMN_INTERVAL, .digits = 3});
    }
}

/* Adds the sentences and the table of a block, whose cases are its scenes or its measures. */
static koksma_status add_block(koksma_study *study, koksma__document *d, const char *id, size_t number,
                               option_case *c)
{
    const koksma__texts *cases = c->image ? &c->image->scenes : &c->discrepancy->measures;
    comparison *changes = calloc(c->options->n, sizeof *changes);
    koksma__document rows = {0};
    char name[64];
    koksma_status status = changes ? KOKSMA_OK : koksma__fail_memory(c->options->n * sizeof *changes);
    snprintf(name, sizeof name, "options-%.32s-%zu", id, number);
    koksma__doc_table_begin(&rows, name);
    add_heads(&rows, c);
    for (size_t i = 0; !status && i < cases->n; i++) {
        *(c->image ? &c->name : &c->measure) = cases->at[i];
        status = add_case(study, &rows, c, changes);
    }
    koksma__doc_table_end(&rows);
    for (size_t v = 1; !status && v < c->options->n; v++) {
        say_change(d, c->options->at[0], c->options->at[v], &changes[v]);
    }
    koksma__doc_append(d, &rows);
    free(changes);
    return status;
}

koksma_status koksma__answer_options(koksma_study *study, koksma__document *d, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; !status && b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *block = topic->discrepancies[b];
        option_case c = {
            .discrepancy = block, .patterns = &block->patterns, .options = &block->warps, .n = &block->n};
        status = block->warps.n > 1 ? add_block(study, d, topic->id, ++number, &c) : KOKSMA_OK;
    }
    for (size_t b = 0; !status && b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        option_case c = {
            .image = i, .metric = topic->metric, .patterns = &i->patterns, .options = &i->variants, .n = &i->spp};
        status = i->variants.n > 1 ? add_block(study, d, topic->id, ++number, &c) : KOKSMA_OK;
    }
    return status;
}
