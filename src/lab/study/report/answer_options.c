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

#include "core/elementary.h"
#include "core/status.h"
#include "study/report/report.h"

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

/* Collects the values of the trials that both sides have, in two lists with space for those of each side; returns their
   number. */
static size_t pair(const side *base, const side *other, double *of_base, double *of_other)
{
    size_t n = 0;
    for (size_t i = 0, k = 0; i < base->mean.n && k < other->mean.n;) {
        const koksma__result *a = &base->results[i], *b = &other->results[k];
        if (a->trial == b->trial) {
            of_base[n] = a->values[0];
            of_other[n++] = b->values[0];
        }
        i += a->trial <= b->trial;
        k += b->trial <= a->trial;
    }
    return n;
}

static void compare(koksma__report *r, koksma__document *d, const side *base, const side *other, comparison *t)
{
    const size_t capacity = base->mean.n < other->mean.n ? base->mean.n : other->mean.n;
    double *x = koksma__report_memory(r, 2 * capacity, sizeof *x), *y = x + capacity;
    if (!x) {
        return;
    }
    const size_t n = pair(base, other, x, y);
    koksma__estimate e = koksma__relative_change(y, x, n);
    if (n == 1 && base->mean.low == base->mean.high && other->mean.low == other->mean.high) { /* both are exact */
        e.low = e.high = e.value;
    }
    koksma__doc_cells(d, "i", e);
    if (!isnan(e.value)) {
        const bool equal = !memcmp(x, y, n * sizeof *x);
        t->cases++;
        t->better += e.high < 0;
        t->worse += e.low > 0;
        t->equal += equal;
        t->unknown += !equal && isnan(e.low);
        t->logs += koksma__log(1 + e.value);
    }
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
    koksma__doc_answer(d, t->better + t->worse + t->equal > 0,
                       "*%s instead of %s:* %+.1f %% (geometric mean over %zu cases); surely smaller in %zu, surely "
                       "larger in %zu, too close to tell in %zu",
                       name_of(other), name_of(base), 100 * (koksma__exp(t->logs / (double)t->cases) - 1), t->cases,
                       t->better, t->worse, t->cases - t->better - t->worse - t->equal - t->unknown);
    if (t->equal) {
        koksma__doc_say(d, ", equal bit for bit in %zu", t->equal);
    }
    if (t->unknown) {
        koksma__doc_say(d, ", unknown in %zu with a single trial", t->unknown);
    }
    koksma__doc_say(d, ".");
}

/* The options of a block and their comparisons. */
typedef struct options {
    const koksma__texts *of;
    comparison *changes;
} options;

/* Adds the rows of a case, one for each pattern and n: the first option's mean and the other options' relative
   differences. */
static void add_rows(koksma__report *r, koksma__document *d, koksma__subject s, const options *o)
{
    for (size_t i = 0; !r->status && i < s.patterns->n * s.n->n; i++) {
        const char *pattern = s.patterns->at[i / s.n->n];
        const long long n = s.n->at[i % s.n->n];
        side base = {0};
        koksma__doc_row(d, "ttd", s.images ? s.scene : s.measure, pattern, n);
        for (size_t v = 0; !r->status && v < o->of->n; v++) {
            side other = {0};
            *(s.images ? &s.variant : &s.warp) = o->of->at[v];
            other.mean = koksma__read_mean(r, &s, pattern, n, &other.results);
            if (v == 0) {
                base = other;
                koksma__doc_cells(d, "i", koksma__estimate_of(&base.mean));
            } else {
                compare(r, d, &base, &other, &o->changes[v]);
                free(other.results);
            }
        }
        free(base.results);
    }
}

/* Adds the sentences and the table of the block of a subject, whose cases are its scenes or its measures. */
static void add_block(koksma__report *r, koksma__document *d, const char *id, size_t number, koksma__subject s,
                      const koksma__texts *of)
{
    const koksma__texts *cases = s.images ? &s.images->scenes : &s.points->measures;
    const options o = {of, koksma__report_memory(r, of->n, sizeof *o.changes)};
    koksma__document rows = {0};
    koksma__doc_table(&rows, "options-%.32s-%zu", id, number);
    koksma__doc_columns(&rows, s.images ? "t scene;t pattern;n7 N" : "t measure;t pattern;n7 N");
    for (size_t v = 0; v < of->n; v++) {
        koksma__doc_columns(&rows, "i3 %s%s##%s", v ? "relative change: " : "", name_of(of->at[v]), s.metric);
    }
    for (size_t i = 0; i < cases->n; i++) {
        *(s.images ? &s.scene : &s.measure) = cases->at[i];
        add_rows(r, &rows, s, &o);
    }
    for (size_t v = 1; !r->status && v < of->n; v++) {
        say_change(d, of->at[0], of->at[v], &o.changes[v]);
    }
    koksma__doc_append(d, &rows);
}

void koksma__answer_options(koksma__report *r, koksma__document *d, const koksma__topic *topic)
{
    size_t number = 0;
    for (size_t b = 0; b < topic->n_discrepancies; b++) {
        const koksma__discrepancy_block *block = topic->discrepancies[b];
        if (block->warps.n > 1) {
            add_block(r, d, topic->id, ++number, koksma__subject_of_points(block, block->measures.at[0], ""),
                      &block->warps);
        }
    }
    for (size_t b = 0; b < topic->n_images; b++) {
        const koksma__image_block *block = topic->images[b];
        if (block->variants.n > 1) {
            add_block(r, d, topic->id, ++number,
                      koksma__subject_of_images(block, block->scenes.at[0], "", topic->metric), &block->variants);
        }
    }
}
