/* SPDX-License-Identifier: Apache-2.0 */
/* What options (of renders) and warps (of points) change: the relative difference to the first of them, paired by
   trial, because both see the same points. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/report/answers.h"

/* One comparison: option v of a pattern at n in a case against option 0. */
typedef struct tally {
    size_t cases, better, worse, equal, unknown; /* equal: every trial bit for bit; unknown: without an interval */
    double logs;                                 /* sum of the logs of the ratios */
} tally;

typedef struct side {
    koksma__result *results;
    koksma__summary mean;
} side;

/* The values of trials that both sides have; *n: how many. */
static koksma_status pair(const side *base, const side *other, double **values, size_t *n)
{
    const size_t room = base->mean.n < other->mean.n ? base->mean.n : other->mean.n;
    *n = 0;
    *values = malloc((2 * room + 1) * sizeof **values);
    if (!*values) {
        return koksma__fail_memory((2 * room + 1) * sizeof **values);
    }
    for (size_t i = 0, k = 0; i < base->mean.n && k < other->mean.n;) {
        const koksma__result *a = &base->results[i], *b = &other->results[k];
        if (a->trial == b->trial) {
            (*values)[*n] = a->values[0];
            (*values)[room + (*n)++] = b->values[0];
        }
        i += a->trial <= b->trial;
        k += b->trial <= a->trial;
    }
    if (*n < room) { /* together again */
        memmove(*values + *n, *values + room, *n * sizeof **values);
    }
    return KOKSMA_OK;
}

static koksma_status compare(koksma__grid *g, const side *base, const side *other, tally *t)
{
    double *values;
    size_t n;
    const koksma_status status = pair(base, other, &values, &n);
    if (status) {
        return status;
    }
    koksma__estimate e = koksma__relative_change(values + n, values, n);
    if (n == 1 && base->mean.low == base->mean.high && other->mean.low == other->mean.high) { /* they don't vary */
        e.low = e.high = e.value;
    }
    koksma__grid_interval(g, e, 3);
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

static void add_answer(koksma__html *h, const char *base, const char *other, const tally *t)
{
    if (t->cases) {
        koksma__html_add(h, "<p><strong>Answer.</strong> ");
        koksma__html_text(h, other[0] ? other : "defaults");
        koksma__html_add(h, " instead of ");
        koksma__html_text(h, base[0] ? base : "defaults");
        koksma__html_add(
            h,
            ": the value is %+.1f %% (geometric mean over %zu cases); surely smaller in %zu, surely larger "
            "in %zu, too close to tell in %zu",
            100 * (exp(t->logs / (double)t->cases) - 1), t->cases, t->better, t->worse,
            t->cases - t->better - t->worse - t->equal - t->unknown);
        if (t->equal) {
            koksma__html_add(h, ", equal bit for bit in %zu", t->equal);
        }
        if (t->unknown) {
            koksma__html_add(h, ", one trial alone and so unsure in %zu", t->unknown);
        }
        koksma__html_add(h, ".</p>\n");
    }
}

/* The rows of one case: patterns x n, the first option's value and the others' relative differences. */
typedef struct grid_case {
    const char *name, *measure;
    const koksma__texts *patterns, *options;
    const koksma__wholes *n;
    const koksma__image_block *image;
    const koksma__discrepancy_block *discrepancy;
} grid_case;

static koksma_status add_row(koksma_study *study, koksma__grid *g, const grid_case *c, const char *pattern,
                             long long n, tally *tallies)
{
    side base = {0};
    koksma_status status = KOKSMA_OK;
    koksma__grid_row(g);
    koksma__grid_text(g, c->image ? c->name : c->measure);
    koksma__grid_text(g, pattern);
    koksma__grid_number(g, (double)n, 7);
    for (size_t v = 0; !status && v < c->options->n; v++) {
        side s = {0};
        status = c->image ? koksma__image_mean(study, c->image, c->name, c->options->at[v], pattern, n, &s.results,
                                               &s.mean)
                          : koksma__discrepancy_mean(study, c->discrepancy, c->options->at[v], pattern, n, c->measure,
                                                     &s.results, &s.mean);
        if (!status && v == 0) {
            base = s;
            koksma__grid_interval(g, koksma__estimate_of(&s.mean), 3);
        } else if (!status) {
            status = compare(g, &base, &s, &tallies[v]);
            free(s.results);
        }
    }
    free(base.results);
    return status;
}

static koksma_status add_case(koksma_study *study, koksma__grid *g, const grid_case *c, tally *tallies)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < c->patterns->n * c->n->n; i++) {
        status = add_row(study, g, c, c->patterns->at[i / c->n->n], c->n->at[i % c->n->n], tallies);
    }
    return status;
}

/* All cases of a block: its scenes, or its measures. */
static koksma_status add_block(koksma_study *study, koksma__html *h, const char *id, size_t number, grid_case *c)
{
    const koksma__texts *cases = c->image ? &c->image->scenes : &c->discrepancy->measures;
    tally *tallies = calloc(c->options->n, sizeof *tallies);
    koksma__html rows = {0};
    koksma__grid grid;
    char text[KOKSMA__VARIANT_TEXT + 64];
    koksma_status status = tallies ? KOKSMA_OK : koksma__fail_memory(c->options->n * sizeof *tallies);
    snprintf(text, sizeof text, "options-%.32s-%zu", id, number);
    koksma__grid_open(&grid, &rows, text);
    koksma__grid_head(&grid, c->image ? "scene" : "measure");
    koksma__grid_head(&grid, "pattern");
    koksma__grid_head(&grid, "N");
    for (size_t v = 0; v < c->options->n; v++) {
        snprintf(text, sizeof text, "%s%s", v ? "relative change: " : "",
                 c->options->at[v][0] ? c->options->at[v] : "defaults");
        koksma__grid_head_interval(&grid, text);
    }
    for (size_t i = 0; !status && i < cases->n; i++) {
        *(c->image ? &c->name : &c->measure) = cases->at[i];
        status = add_case(study, &grid, c, tallies);
    }
    koksma__grid_close(&grid);
    for (size_t v = 1; !status && v < c->options->n; v++) {
        add_answer(h, c->options->at[0], c->options->at[v], &tallies[v]);
    }
    koksma__html_add(h, "%s", rows.text ? rows.text : "");
    h->failed |= rows.failed;
    free(rows.text);
    free(tallies);
    return status;
}

koksma_status koksma__answer_options(koksma_study *study, koksma__html *h, const koksma__topic *topic)
{
    koksma_status status = KOKSMA_OK;
    size_t number = 0;
    for (size_t b = 0; !status && b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *d = topic->discrepancies[b];
        grid_case c = {.discrepancy = d, .patterns = &d->patterns, .options = &d->warps, .n = &d->n};
        status = d->warps.n > 1 ? add_block(study, h, topic->id, ++number, &c) : KOKSMA_OK;
    }
    for (size_t b = 0; !status && b < topic->n_images; b++) {
        const koksma__image_block *i = topic->images[b];
        grid_case c = {.image = i, .patterns = &i->patterns, .options = &i->variants, .n = &i->spp};
        status = i->variants.n > 1 ? add_block(study, h, topic->id, ++number, &c) : KOKSMA_OK;
    }
    return status;
}
