/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a paper concludes, and whether the rows of the study bear it out: one paragraph for each conclusion of the plan,
 * with which the page begins; the tables have the evidence. A conclusion holds if it passes
 * all its tests, in part if it passes some, and not if it passes none; it is undecided while rows are missing. Each kind of
 * conclusions.def has a function here, which writes the words of the result and counts its tests. Long because it has every
 * kind.
 */
#include <math.h>
#include <string.h>

#include <koksma/adaptive.h>

#include "core/elementary.h"
#include "study/plan/plan.h"
#include "study/report/report.h"

/* A conclusion that is being judged: the words of the result, the number of tests that it passes, and of those that its
   rows allow; rows that are missing count as `open`. */
typedef struct judged {
    koksma__report *r;
    const koksma__conclusion *c;
    koksma__document words;
    size_t passed, tests, open;
    size_t other; /* comparisons by another procedure than that of the printed numbers: no tests */
} judged;

static void test(judged *j, bool passes)
{
    j->tests++;
    j->passed += passes;
}

static const koksma__table *table_of(const judged *j, const char *id)
{
    return koksma__plan_table_of(&j->r->study->plan, j->c->part, id);
}

/* Writes the label of a pattern in the first table of the conclusion's plan that has it, or the pattern's spec. */
static void say_label(const judged *j, koksma__document *d, const char *pattern)
{
    const koksma__plan *plan = &j->r->study->plan;
    for (size_t i = 0; i < plan->n_tables; i++) {
        const koksma__table *t = &plan->tables[i];
        const koksma__table_row *row = t->part == j->c->part ? koksma__plan_row_of(t, pattern) : NULL;
        if (row) {
            koksma__doc_say(d, "%s", row->label);
            return;
        }
    }
    koksma__doc_say(d, "`%s`", pattern);
}

/* Whether a note on all rows of a table says that the printed means are of another procedure than ours. */
static bool is_other(const koksma__table *t, size_t k)
{
    bool other = false;
    for (size_t i = 0; i < t->n_notes; i++) {
        const koksma__note *note = &t->notes[i];
        other |= note->untested && !note->pattern && !note->statistic && (!note->n || note->n == t->n.at[k]);
    }
    return other;
}

/* The measure by which a table over n is judged: the exact one that stands beside that of the printed numbers, if any. */
static const char *judged_by(const koksma__table *t)
{
    return t->also && koksma__table_is_over_n(t) && !is_other(t, 0) ? t->also : t->measure;
}

/* Our mean [0], and the printed one [1], of a table's row at column k; NaN: none. */
static void means_of(const judged *j, const koksma__table *t, const char *pattern, size_t k, double means[2])
{
    const koksma__cell cell = t->scene ? koksma__table_cell(j->r, t, pattern, k)
                                       : koksma__points_cell(j->r, t, judged_by(t), pattern, t->n.at[k]);
    means[0] = cell.mean.n ? cell.mean.mean : (double)NAN;
    means[1] = koksma__plan_row_of(t, pattern)->published[k].value;
}

/* The means of all patterns of a conclusion in a table: ours, followed by the printed ones. */
static void list_means(const judged *j, const koksma__table *t, double *means)
{
    for (size_t i = 0; i < j->c->patterns.n; i++) {
        double both[2];
        means_of(j, t, j->c->patterns.at[i], 0, both);
        means[i] = both[0];
        means[j->c->patterns.n + i] = both[1];
    }
}

/* Number *at of the images in the blocks that a conclusion names: a scene with its options and a number of samples.
   Returns false at the end. */
static bool next_images(const koksma__report *r, const koksma__conclusion *c, size_t *at, koksma__subject *s,
                        long long *spp)
{
    const koksma__plan_part *part = &r->study->plan.parts[c->part];
    size_t i = (*at)++;
    for (size_t b = part->images[0]; c->images && b < part->images[1]; b++) {
        const koksma__image_block *block = &r->study->plan.images[b];
        const size_t sizes = block->spp.n, variants = block->variants.n, n = block->scenes.n * sizes * variants;
        if (!block->id || strcmp(block->id, c->images) != 0) {
            continue;
        }
        if (i < n) {
            *s = koksma__subject_of_images(block, block->scenes.at[i / sizes / variants],
                                           block->variants.at[i % variants],
                                           c->metric ? c->metric : KOKSMA__DEFAULT_METRIC);
            *spp = block->spp.at[i / variants % sizes];
            return true;
        }
        i -= n;
    }
    return false;
}

/* ---- order: the overall order of the patterns in a paper's text -------------------------------------------- */

/* Adds the rank of each of n values: 1 + the number of smaller ones, and half a rank for each other equal one. */
static void add_ranks(const double *values, size_t n, double *ranks)
{
    for (size_t i = 0; i < n; i++) {
        ranks[i] += 0.5;
        for (size_t k = 0; k < n; k++) {
            ranks[i] += values[k] < values[i] ? 1 : values[k] == values[i] ? 0.5 : 0;
        }
    }
}

/* Each pattern's mean rank over the tables, by our means against the paper's reference, must not fall along that order:
   each neighbouring pair is a test. */
static void conclude_order(judged *j)
{
    const size_t n = j->c->patterns.n, tables = j->c->tables.n;
    double *ranks = koksma__report_memory(j->r, 3 * n, sizeof *ranks), *means = ranks + n;
    bool tied = false;
    if (!ranks) {
        return;
    }
    for (size_t t = 0; t < tables; t++) {
        list_means(j, table_of(j, j->c->tables.at[t]), means);
        add_ranks(means, n, ranks);
        for (size_t i = 0; i < n; i++) {
            j->open += isnan(means[i]);
        }
    }
    koksma__doc_say(&j->words, "Ours by mean rank: ");
    for (size_t i = 0; i < n; i++) {
        if (i) {
            const int change = ranks[i - 1] > ranks[i] * (1 + 1e-12)   ? -1
                               : ranks[i - 1] > ranks[i] * (1 - 1e-12) ? 0
                                                                       : 1;
            test(j, change >= 0);
            tied |= !change;
            koksma__doc_say(&j->words, "%s", change < 0 ? " > " : change ? " < " : " = ");
        }
        say_label(j, &j->words, j->c->patterns.at[i]);
        koksma__doc_say(&j->words, " %.3g", ranks[i] / (double)tables);
    }
    koksma__doc_say(&j->words, "%s.", tied ? " (equal ranks neither confirm nor deny their order)" : "");
}

/* ---- best: the first pattern has the least error ----------------------------------------------------------- */

/* In the tables where it has not, only the patterns of `against` have less: each table is a test. More than half of the
   tables must have it first, which is one more test. */
static void conclude_best(judged *j)
{
    size_t first = 0;
    for (size_t k = 0; k < j->c->tables.n; k++) {
        const koksma__table *t = table_of(j, j->c->tables.at[k]);
        double own[2], other[2];
        size_t before = 0, unexpected = 0;
        means_of(j, t, j->c->patterns.at[0], 0, own);
        for (size_t i = 0; i < t->n_rows; i++) {
            means_of(j, t, t->rows[i].pattern, 0, other);
            j->open += isnan(other[0]);
            before += other[0] < own[0];
            unexpected += other[0] < own[0] && !koksma__texts_have(&j->c->against, t->rows[i].pattern);
        }
        first += !before;
        test(j, !unexpected);
    }
    test(j, 2 * first > j->c->tables.n);
    koksma__doc_say(&j->words, "First in %zu of %zu tables.", first, j->c->tables.n);
}

/* ---- predictor: a measure orders the patterns as the errors do --------------------------------------------- */

/* The rank correlation of a measure with the errors of each table, ours [0] and in print [1], in the report's memory;
   open: to count missing rows. NULL after a failure. */
static double *correlate(judged *j, const koksma__table *by, size_t *open)
{
    const size_t n = j->c->patterns.n;
    double *x = koksma__report_memory(j->r, 4 * n, sizeof *x), *y = x + 2 * n;
    double *rho = koksma__report_memory(j->r, 2 * j->c->tables.n, sizeof *rho);
    if (!x || !rho) {
        return NULL;
    }
    list_means(j, by, x);
    for (size_t k = 0; k < j->c->tables.n; k++) {
        list_means(j, table_of(j, j->c->tables.at[k]), y);
        rho[2 * k] = koksma__spearman(x, y, n);
        rho[2 * k + 1] = koksma__spearman(x + n, y + n, n);
        for (size_t i = 0; i < n; i++) {
            *open += isnan(x[i]) || isnan(y[i]);
        }
    }
    return rho;
}

/* Writes the correlations of a measure in all tables, and where they are not surely above 0. */
static void say_correlations(const judged *j, koksma__document *d, const double *rho, double least)
{
    const koksma__texts *tables = &j->c->tables;
    size_t unsure = 0;
    for (size_t i = 0; i < 2 * tables->n; i++) {
        const size_t k = i % tables->n, side = i / tables->n;
        koksma__doc_say(d, "%s%.2f", k ? ", " : side ? " (in print " : "", rho[2 * k + side]);
    }
    koksma__doc_say(d, ")");
    for (size_t k = 0; k < tables->n; k++) {
        if (!(rho[2 * k] > least - 1e-12)) {
            koksma__doc_say(d, "%s%s", unsure++ ? ", " : ", not surely above 0 in ", tables->at[k]);
        }
    }
    koksma__doc_say(d, ". ");
}

/* What a report calls the measure of a table: its symbol, or the measure or scene. */
static const char *name_of(const koksma__table *t)
{
    return t->symbol ? t->symbol : t->scene ? t->scene : t->measure;
}

/* Each measure of `by` must be surely correlated with the errors of each table, which is a test. The words give the
   correlations of the first, then the means over the tables of all, those of `than` beside them, ours [0] and in
   print [1]. */
static void conclude_predictor(judged *j)
{
    const koksma__conclusion *c = j->c;
    const size_t tables = c->tables.n;
    const double limit = koksma__spearman_limit(c->patterns.n, 0.025);
    koksma__document averages = {0};
    for (size_t i = 0; i < c->by.n + c->than.n; i++) {
        const koksma__table *of = table_of(j, i < c->by.n ? c->by.at[i] : c->than.at[i - c->by.n]);
        const char *spec = of->scene ? of->scene : of->measure;
        const double *rho = correlate(j, of, &j->open);
        double means[2] = {0};
        size_t sure = 0;
        if (!rho) {
            break;
        }
        for (size_t k = 0; k < tables; k++) {
            sure += rho[2 * k] > limit - 1e-12;
            means[0] += rho[2 * k] / (double)tables;
            means[1] += rho[2 * k + 1] / (double)tables;
        }
        koksma__doc_say(&averages, "%s%s%s`%s` %.2f (%.2f in print; %zu sure)", i ? ", " : "On average ",
                        of->symbol ? of->symbol : "", of->symbol ? " " : "", spec, means[0], means[1], sure);
        if (i >= c->by.n) {
            continue;
        }
        for (size_t k = 0; k < tables; k++) {
            test(j, rho[2 * k] > limit - 1e-12);
            if (!i) {
                koksma__doc_say(&j->words, k ? ", " : "Rank correlation of %s with the error in ", name_of(of));
                koksma__doc_say(&j->words, k + 1 < tables ? "%s" : "%s: ", c->tables.at[k]);
            }
        }
        if (!i) {
            say_correlations(j, &j->words, rho, limit);
        }
    }
    koksma__doc_say_words(&j->words, &averages);
    koksma__doc_say(&j->words, ". %zu of %zu correlations are surely above 0.", j->passed, j->tests);
}

/* ---- before: each pattern has a smaller mean than each of `against` ---------------------------------------- */

/* Every comparison in each table at each number of points is a test, by our means [0]; the same comparisons of the
   printed means [1] stand beside them. Comparisons by another procedure than the printed one are no tests, neither for
   nor against the paper. */
static void conclude_before(judged *j)
{
    const koksma__conclusion *c = j->c;
    size_t smaller[2][2] = {{0}}, of[2][2] = {{0}}; /* [by another procedure][ours, in print] */
    const char *procedure = "";
    for (size_t i = 0; i < c->tables.n * KOKSMA__TABLE_PRINTED; i++) {
        const koksma__table *t = table_of(j, c->tables.at[i / KOKSMA__TABLE_PRINTED]);
        const size_t k = i % KOKSMA__TABLE_PRINTED;
        for (size_t p = 0; k < t->n.n && p < c->patterns.n * c->against.n; p++) {
            const char *better = c->patterns.at[p / c->against.n], *worse = c->against.at[p % c->against.n];
            const bool other = is_other(t, k);
            double x[2], y[2];
            means_of(j, t, better, k, x);
            means_of(j, t, worse, k, y);
            j->open += isnan(x[0]) || isnan(y[0]);
            of[other][0]++;
            of[other][1] += !isnan(x[1]) && !isnan(y[1]);
            for (size_t side = 0; side < 2; side++) {
                smaller[other][side] += x[side] < y[side];
            }
            if (other) {
                procedure = t->measure;
                j->other++;
                continue;
            }
            test(j, x[0] < y[0]);
        }
    }
    if (j->tests) {
        koksma__doc_say(&j->words, "The mean is smaller in %zu of %zu comparisons, in print in %zu of %zu.",
                        smaller[0][0], of[0][0], smaller[0][1], of[0][1]);
    }
    if (j->other && !j->tests) {
        koksma__doc_say(
            &j->words,
            "By our rows' procedure (`%s`) it is the other way round in %zu of %zu comparisons, in print in "
            "%zu of %zu.",
            procedure, of[1][0] - smaller[1][0], of[1][0], of[1][1] - smaller[1][1], of[1][1]);
    }
}

/* ---- bands: the errors of the patterns are in visible bands, and those of `against` are not ---------------- */

/* What is found of coherences: the least and the largest of errors that are in bands [0], and of those that are noise
   [1]. */
typedef struct coherences {
    double low[2], high[2];
    size_t shades;           /* errors that should be in bands and are one slow wave */
    koksma__document beside; /* the words of those of `beside` */
} coherences;

/* Tests a pattern of list 0 (in bands), 1 (noise) or 2 (beside them, no test) by the coherence of the mean spectrum. In
   bands is an error that is coherent, with at least two periods over the longer side of the picture; a single slow wave is
   a shade. */
static void test_coherence(judged *j, const koksma__subject *s, const koksma_coherence_values *v, size_t list,
                           const char *pattern, coherences *found)
{
    int width, height;
    koksma__block_size(s->images, koksma__study_scene_of(j->r->study, s->scene), &width, &height);
    const double period = 1 / koksma__hypot(v->frequency_x, v->frequency_y);
    const bool banded = v->coherent && 2 * period <= (width > height ? width : height);
    const char *kind = !v->coherent ? "noise" : banded ? "in bands" : "a shade";
    if (list == 2) {
        koksma__doc_say(&found->beside, koksma__doc_is_empty(&found->beside) ? " Beside it: " : "; ");
        say_label(j, &found->beside, pattern);
        koksma__doc_say(&found->beside, " in %s %.3g, %s", s->scene, v->coherence, kind);
        return;
    }
    test(j, banded == (list == 0));
    found->shades += !list && v->coherent && !banded;
    if (banded == v->coherent) {
        found->low[!banded] = fmin(found->low[!banded], v->coherence);
        found->high[!banded] = fmax(found->high[!banded], v->coherence);
    }
}

/* Each pattern in each image is a test. */
static void test_bands(judged *j, const koksma__subject *s, long long spp, coherences *found)
{
    const koksma__texts *lists[] = {&j->c->patterns, &j->c->against, &j->c->beside};
    for (size_t list = 0; list < 3; list++) {
        for (size_t i = 0; i < lists[list]->n; i++) {
            const koksma_coherence_values v = koksma__mean_coherence(j->r, s, lists[list]->at[i], spp);
            if (v.images) {
                test_coherence(j, s, &v, list, lists[list]->at[i], found);
            } else {
                j->open++;
            }
        }
    }
}

static void conclude_bands(judged *j)
{
    koksma__subject s;
    long long spp;
    coherences found = {.low = {INFINITY, INFINITY}};
    for (size_t i = 0; i < j->c->tables.n; i++) {
        const koksma__table *t = table_of(j, j->c->tables.at[i]);
        s = koksma__table_images(j->r->study, t);
        test_bands(j, &s, t->n.at[0], &found);
    }
    for (size_t i = 0; next_images(j->r, j->c, &i, &s, &spp);) {
        test_bands(j, &s, spp, &found);
    }
    koksma__doc_say(&j->words, "%zu of %zu errors are as concluded", j->passed, j->tests);
    for (size_t k = 0; k < 2; k++) {
        if (found.low[k] <= found.high[k]) {
            koksma__doc_say(&j->words, found.low[k] < found.high[k] ? "%s%.3g to %.3g" : "%s%.3g",
                            k ? ", of noise " : ": coherence with bands ", found.low[k], found.high[k]);
        }
    }
    koksma__doc_say(&j->words, found.shades ? ", and %zu a shade, one slow wave." : ".", found.shades);
    if (!koksma__doc_is_empty(&found.beside)) {
        koksma__doc_say_words(&j->words, &found.beside);
        koksma__doc_say(&j->words, ".");
    }
}

/* ---- metric: images of the first pattern have a larger error than those of the first of `against` ---------- */

/* By a metric such as grain, in every scene of the block. Each scene is a test: the ratio of the means, with an interval
   from those of both by first-order propagation, must be surely above 1. */
static void conclude_metric(judged *j)
{
    const koksma__conclusion *c = j->c;
    koksma__subject s;
    long long spp;
    koksma__doc_say(&j->words, "Ratios of their %s: ", c->metric);
    for (size_t i = 0; next_images(j->r, c, &i, &s, &spp);) {
        const koksma__summary x = koksma__read_mean(j->r, &s, c->patterns.at[0], spp, NULL),
                              y = koksma__read_mean(j->r, &s, c->against.at[0], spp, NULL);
        if (x.n < 2 || y.n < 2) {
            j->open++;
            continue;
        }
        const double ratio = x.mean / y.mean;
        const double half = ratio * koksma__hypot((x.high - x.mean) / x.mean, (y.high - y.mean) / y.mean);
        test(j, ratio - half > 1);
        koksma__doc_say(&j->words, "%s%.2f ± %.2g in %s", j->tests > 1 ? ", " : "", ratio, half, s.scene);
    }
    koksma__doc_say(&j->words, "; surely above 1 in %zu of %zu.", j->passed, j->tests);
}

/* ---- rates: the patterns converge faster than random points ------------------------------------------------ */

/* Exponents that differ from -1/2 by less are taken for those of finite sizes: the part of an error that vanishes faster
   still tilts it. */
#define TOLERANCE 0.05

/* The slope of our means of a pattern: by a measure of a table over its columns, or of a subject over its numbers of
   points. NaN if one is missing. */
static koksma__estimate slope_of(const judged *j, const koksma__table *t, const koksma__subject *s,
                                 const char *measure, const char *pattern)
{
    const koksma__wholes *n = t ? &t->n : s->n;
    koksma__curve c = koksma__curve_of(j->r, n->n);
    for (size_t k = 0; k < n->n; k++) {
        koksma__curve_add(&c, n->at[k],
                          t ? koksma__points_cell(j->r, t, measure, pattern, n->at[k]).mean
                            : koksma__read_mean(j->r, s, pattern, n->at[k], NULL));
    }
    return c.n == n->n ? koksma__trend_of(c.x, c.y, c.n).slope : (koksma__estimate){NAN, NAN, NAN};
}

/* Each pattern and measure is a test: the whole interval of the slope over the block's numbers of points must be below
   -1/2 - TOLERANCE. If the block has random points, their slope is the first. */
static void test_rates(judged *j, const koksma__subject *s)
{
    const koksma__texts *patterns = &j->c->patterns;
    koksma__doc_say(&j->words, "`%s`, N = %lld to %lld: ", s->measure, s->n->at[0], s->n->at[s->n->n - 1]);
    if (koksma__texts_have(s->patterns, "random")) {
        const koksma__estimate slope = slope_of(j, NULL, s, NULL, "random");
        if (!isnan(slope.value)) {
            koksma__doc_say(&j->words, "random N^%.3f^ (± %.3f), ", slope.value, slope.high - slope.value);
        }
    }
    for (size_t i = 0; i < patterns->n; i++) {
        const koksma__estimate slope = slope_of(j, NULL, s, NULL, patterns->at[i]);
        if (isnan(slope.high)) {
            j->open++;
            continue;
        }
        test(j, slope.high < -0.5 - TOLERANCE);
        say_label(j, &j->words, patterns->at[i]);
        koksma__doc_say(&j->words, " N^%.3f^ (± %.3f%s)%s", slope.value, slope.high - slope.value,
                        slope.high < -0.5 - TOLERANCE ? "" : ", not surely better", i + 1 < patterns->n ? ", " : ".");
    }
}

static void conclude_rates(judged *j)
{
    const koksma__plan *plan = &j->r->study->plan;
    const koksma__plan_part *part = &plan->parts[j->c->part];
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        const koksma__discrepancy_block *block = &plan->discrepancies[b];
        for (size_t m = 0; block->id && !strcmp(block->id, j->c->discrepancies) && m < block->measures.n; m++) {
            const koksma__subject s = koksma__subject_of_points(block, block->measures.at[m], "");
            test_rates(j, &s);
        }
    }
}

/* ---- slopes: the printed tables over several n, by the slopes that stand beside their rows ------------------- */

/* Whether a slope is as a conclusion says: surely above that of another table, or surely below -1/2 - TOLERANCE if it is to
   be `faster`, and otherwise not. */
static bool slope_passes(koksma__estimate slope, const koksma__estimate *other, bool faster)
{
    return other ? slope.low > other->high : (slope.high < -0.5 - TOLERANCE) == faster;
}

/* Each row of a pattern is a test: its slope must be surely below -1/2 - TOLERANCE and, of a pattern of `against`, must not
   be; with `by` it must be surely above the pattern's slope in that table. Rows by another procedure than the printed
   one are no tests, and are named where there are no others. */
static void conclude_slopes(judged *j)
{
    const koksma__conclusion *c = j->c;
    const koksma__table *by = c->by.n ? table_of(j, c->by.at[0]) : NULL;
    for (size_t i = 0; i < c->tables.n; i++) {
        const koksma__table *t = table_of(j, c->tables.at[i]);
        const bool other = is_other(t, 0), exact = judged_by(t) != t->measure, shown = !other || c->tables.n == 1;
        koksma__document slopes = {0};
        size_t said = 0, unsure = 0; /* unsure: slopes that do not pass by the printed procedure */
        for (size_t k = 0; k < c->patterns.n + c->against.n; k++) {
            const bool faster = k < c->patterns.n;
            const char *pattern = faster ? c->patterns.at[k] : c->against.at[k - c->patterns.n];
            koksma__estimate least, *above = by ? &least : NULL;
            if (!koksma__plan_row_of(t, pattern)) {
                continue;
            }
            const koksma__estimate slope = slope_of(j, t, NULL, judged_by(t), pattern);
            koksma__doc_say(&slopes, said++ ? ", " : " ");
            say_label(j, &slopes, pattern);
            koksma__doc_say(&slopes, " %.3f ± %.3f", slope.value, slope.high - slope.value);
            if (by) {
                least = slope_of(j, by, NULL, judged_by(by), pattern);
                koksma__doc_say(&slopes, " (%.3f ± %.3f in table %s)", least.value, least.high - least.value, by->id);
            }
            if (exact) {
                unsure += !slope_passes(slope_of(j, t, NULL, t->measure, pattern), above, faster);
            }
            j->other += other;
            j->open += isnan(slope.high) || (by && isnan(least.high));
            if (!other) {
                test(j, slope_passes(slope, above, faster));
            }
        }
        if (!shown) {
            koksma__json_writer_fini(&slopes.json);
            continue;
        }
        koksma__doc_say(&j->words, other ? "By our rows' procedure (`%s`) in table %s:" : "%s in table %s",
                        other                             ? t->measure
                        : koksma__doc_is_empty(&j->words) ? "Slopes"
                                                          : ";",
                        t->id);
        if (!other && exact) {
            koksma__doc_say(&j->words, " (`%s`)", judged_by(t));
        }
        koksma__doc_say_words(&j->words, &slopes);
        if (unsure) {
            koksma__doc_say(&j->words,
                            by ? "; by the printed procedure the intervals overlap in %zu of %zu"
                               : "; by the printed procedure not surely in %zu of %zu",
                            unsure, said);
        }
        koksma__doc_say(&j->words, other ? "." : "");
    }
    koksma__doc_say(&j->words, j->tests ? "." : "");
}

/* ---- adaptive: adaptive sampling splits fewer strata needlessly in the first of two figures ------------------ */

/* Each pair of figures is a test, by the share of splits that were needless. */
static void conclude_adaptive(judged *j)
{
    const koksma__plan *plan = &j->r->study->plan;
    double share[2] = {0};
    for (size_t i = 0; i < j->c->figures.n; i++) {
        const koksma__figure *f = koksma__plan_figure_of(plan, j->c->part, j->c->figures.at[i]);
        const koksma_adaptive_report *cost = &j->r->adaptive[f - plan->figures];
        share[i % 2] = (double)cost->needless / (double)cost->splits;
        koksma__doc_say(&j->words, "%s%.0f %% in %s%s (`%s`)",
                        i % 2 ? " against "
                        : i   ? "; "
                              : "Needless splits: ",
                        100 * share[i % 2], i ? "" : "figure ", f->id, f->adaptive);
        if (i % 2) {
            test(j, share[0] < share[1]);
            j->open += isnan(share[0] + share[1]);
        }
    }
    koksma__doc_say(&j->words, ".");
}

/* ---- The section ------------------------------------------------------------------------------------------- */

/* The functions, in the order of koksma__conclusion_kinds. */
static void (*const functions[])(judged *) = {
#define CONCLUSION(name, fields) conclude_##name,
#include "study/plan/conclusions.def"
#undef CONCLUSION
};

/* Whether the scenes of a conclusion's tables or images were fitted to printed numbers of its plan. */
static bool is_fitted(const koksma__report *r, const koksma__conclusion *c)
{
    bool fitted = false;
    for (size_t i = 0; i < r->study->plan.n_tables; i++) {
        const koksma__table *t = &r->study->plan.tables[i];
        koksma__subject s;
        long long spp;
        bool shown = koksma__texts_have(&c->tables, t->id);
        for (size_t k = 0; t->scene && next_images(r, c, &k, &s, &spp);) {
            shown |= !strcmp(s.scene, t->scene);
        }
        fitted |= t->part == c->part && t->fitted && shown;
    }
    return fitted;
}

static void conclude(koksma__report *r, koksma__document *d, const koksma__conclusion *c)
{
    static const char *const verdicts[] = {[KOKSMA__ANSWER_HOLDS] = "Holds",
                                           [KOKSMA__ANSWER_PARTLY] = "Holds in part",
                                           [KOKSMA__ANSWER_FAILS] = "Does not hold"};
    judged j = {.r = r, .c = c};
    functions[c->kind - koksma__conclusion_kinds](&j);
    const koksma__words_kind answer = j.open || !j.tests    ? KOKSMA__ANSWER_UNDECIDED
                                      : j.passed == j.tests ? KOKSMA__ANSWER_HOLDS
                                      : j.passed            ? KOKSMA__ANSWER_PARTLY
                                                            : KOKSMA__ANSWER_FAILS;
    koksma__doc_answer(d, answer, "*%s%s%s:* %s ",
                       answer               ? verdicts[answer]
                       : j.other && !j.open ? "Not decided, as our rows are by another procedure"
                                            : "Not decided, as rows are missing",
                       j.other && answer ? ", as far as our procedure is the printed one" : "",
                       is_fitted(r, c) ? " (scenes fitted)" : "", c->says);
    koksma__doc_say_words(d, &j.words);
    if (c->remark) {
        koksma__doc_paragraph(d, "%s", c->remark);
    }
}

void koksma__conclude(koksma__report *r, koksma__document *d, bool on_figures)
{
    for (size_t i = 0; !r->status && i < r->study->plan.n_conclusions; i++) {
        const koksma__conclusion *c = &r->study->plan.conclusions[i];
        if (c->part == r->part && !(c->kind->fields & KOKSMA__NEEDS_FIGURES) == !on_figures) {
            conclude(r, d, c);
        }
    }
}

static void write_conclusions(koksma__report *r, koksma__document *d)
{
    koksma__conclude(r, d, false);
}

const koksma__section koksma__section_conclusions = {"What the paper concludes, and whether it holds", true,
                                                     write_conclusions};
