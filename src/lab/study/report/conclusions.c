/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a paper concludes, and whether the rows of the study bear it out: one paragraph for each conclusion of the plan,
 * with which the page begins, and one with the evidence, which stands in the section alone. A conclusion holds if it passes
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

/* The number of tests that a conclusion passes, of those that its rows allow; rows that are missing count as `open`. */
typedef struct tested {
    size_t passed, tests, open;
    size_t other;          /* comparisons by another procedure than that of the printed numbers: no tests */
    koksma__document more; /* words of the evidence: whole sentences, each with a space behind it */
} tested;

static void test(tested *t, bool passes)
{
    t->tests++;
    t->passed += passes;
}

/* The table of a conclusion's plan with this id. */
static const koksma__table *table_of(const koksma__report *r, const koksma__conclusion *c, const char *id)
{
    return koksma__plan_table_of(&r->study->plan, c->part, id);
}

/* Writes the label of a pattern in the first table of the conclusion's plan that has it, or the pattern's spec. */
static void say_label(koksma__document *d, const koksma__report *r, const koksma__conclusion *c, const char *pattern)
{
    for (size_t i = 0; i < r->study->plan.n_tables; i++) {
        const koksma__table *t = &r->study->plan.tables[i];
        const koksma__table_row *row = t->part == c->part ? koksma__plan_row_of(t, pattern) : NULL;
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

/* Our mean, and the printed one, of a table's row at column k; NaN: none. */
typedef struct pair {
    double ours, printed;
} pair;

static pair means_of(koksma__report *r, const koksma__table *t, const char *pattern, size_t k)
{
    const koksma__cell cell = t->scene ? koksma__table_cell(r, t, pattern, k)
                                       : koksma__points_cell(r, t, judged_by(t), pattern, t->n.at[k]);
    return (pair){cell.mean.n ? cell.mean.mean : (double)NAN, koksma__plan_row_of(t, pattern)->published[k].value};
}

/* The means of all patterns of a conclusion in a table, in lists of ours and of printed ones. */
static void list_means(koksma__report *r, const koksma__conclusion *c, const koksma__table *t, double *ours,
                       double *printed)
{
    for (size_t i = 0; i < c->patterns.n; i++) {
        const pair means = means_of(r, t, c->patterns.at[i], 0);
        ours[i] = means.ours;
        printed[i] = means.printed;
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

/* Whether the intervals of two means overlap; without an interval a mean is one point. */
static bool overlap(const koksma__summary *x, const koksma__summary *y)
{
    return (isnan(x->low) ? x->mean : x->low) <= (isnan(y->high) ? y->mean : y->high) &&
           (isnan(y->low) ? y->mean : y->low) <= (isnan(x->high) ? x->mean : x->high);
}

/* Names the pairs of means in the tables whose intervals overlap, so that chance may have ranked them. */
static void say_overlaps(koksma__report *r, koksma__document *d, const koksma__conclusion *c)
{
    size_t said = 0;
    for (size_t t = 0; t < c->tables.n; t++) {
        const koksma__table *of = table_of(r, c, c->tables.at[t]);
        for (size_t i = 0; i < c->patterns.n; i++) {
            const koksma__summary x = koksma__table_cell(r, of, c->patterns.at[i], 0).mean;
            for (size_t k = i + 1; k < c->patterns.n; k++) {
                const koksma__summary y = koksma__table_cell(r, of, c->patterns.at[k], 0).mean;
                if (overlap(&x, &y)) {
                    koksma__doc_say(d, said++ ? "; " : "Chance may have ranked, as their intervals overlap: ");
                    say_label(d, r, c, c->patterns.at[i]);
                    koksma__doc_say(d, " and ");
                    say_label(d, r, c, c->patterns.at[k]);
                    koksma__doc_say(d, " in %s", of->id);
                }
            }
        }
    }
    koksma__doc_say(d, said ? ". " : "");
}

/* Each pattern's mean rank over the tables, by our means against the paper's reference, must not fall along that order:
   each neighbouring pair is a test. Beside it stands Spearman's correlation of the printed with our means. */
static void conclude_order(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    const size_t n = c->patterns.n, tables = c->tables.n;
    double *ranks = koksma__report_memory(r, 3 * n + tables, sizeof *ranks);
    if (!ranks) {
        return;
    }
    double *ours = ranks + n, *printed = ours + n, *rho = printed + n;
    for (size_t t = 0; t < tables; t++) {
        list_means(r, c, table_of(r, c, c->tables.at[t]), ours, printed);
        rho[t] = koksma__spearman(ours, printed, n);
        add_ranks(ours, n, ranks);
        for (size_t i = 0; i < n; i++) {
            all->open += isnan(ours[i]);
        }
    }
    bool tied = false;
    say_overlaps(r, &all->more, c);
    koksma__doc_say(&all->more, "Rank correlation of the printed means with ours: ");
    for (size_t t = 0; t < tables; t++) {
        koksma__doc_say(&all->more, "%s%.2f in %s%s", t ? "; " : "", rho[t], t ? "" : "table ", c->tables.at[t]);
    }
    koksma__doc_say(&all->more, ". ");
    koksma__doc_say(d, "Ours by mean rank: ");
    for (size_t i = 0; i < n; i++) {
        if (i) {
            const bool falls = ranks[i - 1] > ranks[i] * (1 + 1e-12),
                       equal = !falls && ranks[i - 1] > ranks[i] * (1 - 1e-12);
            test(all, !falls);
            tied |= equal;
            koksma__doc_say(d, "%s", falls ? " > " : equal ? " = " : " < ");
        }
        say_label(d, r, c, c->patterns.at[i]);
        koksma__doc_say(d, " %.3g", ranks[i] / (double)tables);
    }
    koksma__doc_say(d, "%s.", tied ? " (equal ranks neither confirm nor deny their order)" : "");
}

/* ---- best: the first pattern has the least error ----------------------------------------------------------- */

/* Whether a pattern has the least SD (1) or maximum (2) of a table, in ours [0] and in print [1]. */
static void find_least(koksma__report *r, const koksma__table *t, const char *pattern, int statistic, size_t least[2])
{
    double best[2] = {INFINITY, INFINITY}, own[2] = {NAN, NAN};
    for (size_t i = 0; i < t->n_rows; i++) {
        const koksma__cell cell = koksma__table_cell(r, t, t->rows[i].pattern, 0);
        const double values[] = {statistic == 1 ? cell.sd : cell.max, t->rows[i].published[statistic].value};
        for (size_t k = 0; k < 2; k++) {
            best[k] = fmin(best[k], values[k]);
            own[k] = strcmp(t->rows[i].pattern, pattern) ? own[k] : values[k];
        }
    }
    for (size_t k = 0; k < 2; k++) {
        least[k] += own[k] <= best[k];
    }
}

/* In the tables where it has not, only the patterns of `against` have less: each table is a test. More than half of the
   tables must have it first, which is one more test. SD and maximum stand beside it. */
static void conclude_best(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    size_t first = 0, by_sd[2] = {0}, by_max[2] = {0};
    for (size_t k = 0; k < c->tables.n; k++) {
        const koksma__table *t = table_of(r, c, c->tables.at[k]);
        const double best = means_of(r, t, c->patterns.at[0], 0).ours;
        size_t before = 0, unexpected = 0;
        koksma__doc_say(&all->more, "Table %s: ", t->id);
        for (size_t i = 0; i < t->n_rows; i++) {
            const koksma__table_row *row = &t->rows[i];
            const double mean = means_of(r, t, row->pattern, 0).ours;
            all->open += isnan(mean);
            if (mean < best) {
                koksma__doc_say(&all->more, "%s%s", before++ ? "; " : "after ", row->label);
                unexpected += !koksma__texts_have(&c->against, row->pattern);
            }
        }
        koksma__doc_say(&all->more, before ? ". " : "first. ");
        first += !before;
        test(all, !unexpected);
        find_least(r, t, c->patterns.at[0], 1, by_sd);
        find_least(r, t, c->patterns.at[0], 2, by_max);
    }
    test(all, 2 * first > c->tables.n);
    koksma__doc_say(
        d, "First in %zu of %zu tables. Its SD is the least in %zu (in print %zu), its maximum in %zu (%zu).", first,
        c->tables.n, by_sd[0], by_sd[1], by_max[0], by_max[1]);
}

/* ---- predictor: a measure orders the patterns as the errors do --------------------------------------------- */

/* The rank correlation of a measure with the errors of each table, ours [0] and in print [1], in r's memory; open: of the
   tests, to count missing rows. NULL after a failure. */
static double *correlate(koksma__report *r, const koksma__conclusion *c, const koksma__table *by, size_t *open)
{
    const size_t n = c->patterns.n;
    double *x = koksma__report_memory(r, 4 * n, sizeof *x);
    double *rho = koksma__report_memory(r, 2 * c->tables.n, sizeof *rho);
    if (!x || !rho) {
        return NULL;
    }
    list_means(r, c, by, x, x + n);
    for (size_t k = 0; k < c->tables.n; k++) {
        list_means(r, c, table_of(r, c, c->tables.at[k]), x + 2 * n, x + 3 * n);
        rho[2 * k] = koksma__spearman(x, x + 2 * n, n);
        rho[2 * k + 1] = koksma__spearman(x + n, x + 3 * n, n);
        for (size_t i = 0; i < n; i++) {
            *open += isnan(x[i]) || isnan(x[2 * n + i]);
        }
    }
    return rho;
}

/* Writes the correlations of a measure in all tables, and where they are not surely above 0. */
static void say_correlations(koksma__document *d, const koksma__conclusion *c, const double *rho, double least)
{
    size_t unsure = 0;
    for (size_t side = 0; side < 2; side++) {
        for (size_t k = 0; k < c->tables.n; k++) {
            koksma__doc_say(d, "%s%.2f", k ? ", " : side ? " (in print " : "", rho[2 * k + side]);
        }
    }
    koksma__doc_say(d, ")");
    for (size_t k = 0; k < c->tables.n; k++) {
        if (!(rho[2 * k] > least - 1e-12)) {
            koksma__doc_say(d, "%s%s", unsure++ ? ", " : ", not surely above 0 in ", c->tables.at[k]);
        }
    }
    koksma__doc_say(d, ". ");
}

/* What a report calls the measure of a table: its symbol, or the measure or scene. */
static const char *name_of(const koksma__table *t)
{
    return t->symbol ? t->symbol : t->scene ? t->scene : t->measure;
}

/* Names the pattern with the least mean of a table, ours and in print. */
static void say_least(koksma__report *r, const koksma__conclusion *c, const koksma__table *t, koksma__document *d)
{
    for (size_t side = 0; side < 2; side++) {
        const char *best = NULL;
        double least = INFINITY;
        for (size_t i = 0; i < c->patterns.n; i++) {
            const pair means = means_of(r, t, c->patterns.at[i], 0);
            const double mean = side ? means.printed : means.ours;
            best = mean < least ? c->patterns.at[i] : best;
            least = fmin(least, mean);
        }
        if (best) {
            koksma__doc_say(d, side ? ", in print that of " : "Least %s: that of ", name_of(t));
            say_label(d, r, c, best);
        }
    }
    koksma__doc_say(d, ". ");
}

/* Writes what the correlations of the exact measure beside that of the printed numbers are. */
static void say_exact(koksma__report *r, const koksma__conclusion *c, const koksma__table *by, koksma__document *d)
{
    size_t open = 0;
    koksma__table exact = *by;
    exact.measure = by->also;
    const double *rho = by->also ? correlate(r, c, &exact, &open) : NULL;
    for (size_t k = 0; rho && k < c->tables.n; k++) {
        koksma__doc_say(d, k ? ", " : "By the exact `%s` ", by->also);
        koksma__doc_say(d, "%.2f", rho[2 * k]);
    }
    koksma__doc_say(d, rho ? ". " : "");
}

/* The averages of the measures' correlations, ours [0] and in print [1], and the measures with the least. */
typedef struct averages {
    koksma__document words;
    double least[2];
    const char *worst[2];
    bool printed; /* whether all measures are in print */
} averages;

/* Adds a measure's averages over the n tables and the number of its correlations of at least `limit`. */
static void add_averages(averages *a, const koksma__table *of, const double *rho, size_t n, double limit)
{
    double means[2] = {0};
    size_t sure = 0;
    for (size_t k = 0; k < n; k++) {
        sure += rho[2 * k] > limit - 1e-12;
        means[0] += rho[2 * k] / (double)n;
        means[1] += rho[2 * k + 1] / (double)n;
    }
    koksma__doc_say(&a->words, "%s%s%s`%s` %.2f (%.2f in print; %zu sure)",
                    koksma__doc_is_empty(&a->words) ? "On average " : ", ", of->symbol ? of->symbol : "",
                    of->symbol ? " " : "", of->scene ? of->scene : of->measure, means[0], means[1], sure);
    a->printed &= !isnan(means[1]);
    for (size_t side = 0; side < 2; side++) {
        a->worst[side] = means[side] < a->least[side] ? name_of(of) : a->worst[side];
        a->least[side] = fmin(a->least[side], means[side]);
    }
}

/* Each measure of `by` must be surely correlated with the errors of each table, which is a test. The words give the
   correlations of the first, those of the others are evidence; then the means over the tables of all, those of `than`
   beside them, and which is least. */
static void conclude_predictor(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    const double least = koksma__spearman_limit(c->patterns.n, 0.025);
    averages means = {.least = {INFINITY, INFINITY}, .worst = {"", ""}, .printed = true};
    for (size_t i = 0; i < c->by.n + c->than.n; i++) {
        const koksma__table *of = table_of(r, c, i < c->by.n ? c->by.at[i] : c->than.at[i - c->by.n]);
        const double *rho = correlate(r, c, of, &all->open);
        koksma__document *to = i ? &all->more : d;
        if (!rho) {
            break;
        }
        add_averages(&means, of, rho, c->tables.n, least);
        if (i >= c->by.n) {
            continue;
        }
        if (i) {
            koksma__doc_say(to, "%s (`%s`, table %s): ", name_of(of), of->scene ? of->scene : of->measure, of->id);
        }
        for (size_t k = 0; k < c->tables.n; k++) {
            test(all, rho[2 * k] > least - 1e-12);
            if (!i) {
                koksma__doc_say(d, k ? ", " : "Rank correlation of %s with the error in ", name_of(of));
                koksma__doc_say(d, k + 1 < c->tables.n ? "%s" : "%s: ", c->tables.at[k]);
            }
        }
        say_correlations(to, c, rho, least);
        say_exact(r, c, of, &all->more);
        say_least(r, c, of, &all->more);
    }
    koksma__doc_say_words(d, &means.words);
    if (c->by.n + c->than.n > 2) {
        koksma__doc_say(d, ": %s predicts worst", means.worst[0]);
        koksma__doc_say(d, means.printed ? ", in print %s" : "%s",
                        !means.printed                           ? ""
                        : strcmp(means.worst[0], means.worst[1]) ? means.worst[1]
                                                                 : "too");
    }
    koksma__doc_say(d, ". %zu of %zu correlations are surely above 0.", all->passed, all->tests);
    koksma__doc_say(&all->more,
                    "Of %zu patterns a correlation is surely above 0 (at 5 %% on two sides) from %.2f on. ",
                    c->patterns.n, least);
}

/* ---- before: each pattern has a smaller mean than each of `against` ---------------------------------------- */

enum { NAMED = 2 };

/* The comparisons that find a smaller mean in ours [0] and in print [1], and their numbers. */
typedef struct comparisons {
    size_t smaller[2], of[2];
} comparisons;

/* Every comparison in each table at each number of points is a test, by our means; the same comparisons of the printed
   means stand beside them. NAMED of those that fail are named. Comparisons by another procedure than the printed one are no
   tests, neither for nor against the paper. */
static void conclude_before(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    comparisons n[2] = {0};
    const char *procedure = "";
    size_t failed = 0;
    for (size_t i = 0; i < c->tables.n * KOKSMA__TABLE_PRINTED; i++) {
        const koksma__table *t = table_of(r, c, c->tables.at[i / KOKSMA__TABLE_PRINTED]);
        const size_t k = i % KOKSMA__TABLE_PRINTED;
        for (size_t j = 0; k < t->n.n && j < c->patterns.n * c->against.n; j++) {
            const char *better = c->patterns.at[j / c->against.n], *worse = c->against.at[j % c->against.n];
            const pair x = means_of(r, t, better, k), y = means_of(r, t, worse, k);
            const bool other = is_other(t, k), smaller = x.ours < y.ours;
            all->open += isnan(x.ours) || isnan(y.ours);
            n[other].of[0]++;
            n[other].smaller[0] += smaller;
            n[other].of[1] += !isnan(x.printed) && !isnan(y.printed);
            n[other].smaller[1] += x.printed < y.printed;
            if (other) {
                procedure = t->measure;
                all->other++;
                continue;
            }
            test(all, smaller);
            if (!smaller && failed++ < NAMED) {
                koksma__doc_say(&all->more, failed > 1 ? "; " : "Not: ");
                say_label(&all->more, r, c, better);
                koksma__doc_say(&all->more, " against ");
                say_label(&all->more, r, c, worse);
                koksma__doc_say(&all->more, koksma__table_is_over_n(t) ? " in table %s at N = %lld" : " in table %s",
                                t->id, t->n.at[k]);
            }
        }
    }
    if (failed > NAMED) {
        koksma__doc_say(&all->more, "; and %zu more", failed - NAMED);
    }
    koksma__doc_say(&all->more, failed ? ". " : "");
    if (all->tests) {
        koksma__doc_say(d, "The mean is smaller in %zu of %zu comparisons, in print in %zu of %zu.", n[0].smaller[0],
                        n[0].of[0], n[0].smaller[1], n[0].of[1]);
    }
    if (all->other) {
        koksma__doc_say(all->tests ? &all->more : d,
                        "By our rows' procedure (`%s`) it is the other way round in %zu of %zu comparisons, in print "
                        "in %zu of %zu.%s",
                        procedure, n[1].of[0] - n[1].smaller[0], n[1].of[0], n[1].of[1] - n[1].smaller[1], n[1].of[1],
                        all->tests ? " " : "");
    }
}

/* ---- bands: the errors of the patterns are in visible bands, and those of `against` are not ---------------- */

/* The least and the largest coherence of errors that are in bands [0], and of those that are noise [1]. */
typedef struct coherences {
    double low[2], high[2];
    size_t shades;           /* errors that should be in bands and are one slow wave */
    koksma__document beside; /* the words of those of `beside` */
} coherences;

/* Whether errors are in bands: coherent, with at least two periods over the longer side of the picture. A single slow wave
   is a shade. *period: in pixels. */
static bool is_banded(const koksma__report *r, const koksma__subject *s, const koksma_coherence_values *v,
                      double *period)
{
    int width, height;
    koksma__block_size(s->images, koksma__study_scene_of(r->study, s->scene), &width, &height);
    *period = 1 / koksma__hypot(v->frequency_x, v->frequency_y);
    return v->coherent && 2 * *period <= (width > height ? width : height);
}

/* Each pattern in each image is a test, by the coherence of the mean spectrum; those of `beside` stand beside them. */
static void test_bands(koksma__report *r, const koksma__conclusion *c, const koksma__subject *s, long long spp,
                       coherences *found, tested *all)
{
    const koksma__texts *lists[] = {&c->patterns, &c->against, &c->beside};
    koksma__doc_say(&all->more, "_%s_: ", s->scene);
    for (size_t list = 0, said = 0; list < 3; list++) {
        for (size_t i = 0; i < lists[list]->n; i++) {
            const koksma_coherence_values v = koksma__mean_coherence(r, s, lists[list]->at[i], spp);
            if (!v.images) {
                all->open++;
                continue;
            }
            double period;
            const bool banded = is_banded(r, s, &v, &period);
            const char *kind = !v.coherent ? "noise" : banded ? "in bands" : "a shade";
            koksma__doc_say(&all->more, "%s", said++ ? "; " : "");
            say_label(&all->more, r, c, lists[list]->at[i]);
            koksma__doc_say(&all->more, " %.3g, %s", v.coherence, kind);
            if (v.coherent) {
                koksma__doc_say(&all->more, " of period %.3g pixels", period);
            }
            if (list == 2) {
                koksma__doc_say(&found->beside, koksma__doc_is_empty(&found->beside) ? " Beside it: " : "; ");
                say_label(&found->beside, r, c, lists[list]->at[i]);
                koksma__doc_say(&found->beside, " in %s %.3g, %s", s->scene, v.coherence, kind);
            } else {
                test(all, banded == (list == 0));
                found->shades += !list && v.coherent && !banded;
                if (banded == v.coherent) {
                    found->low[!banded] = fmin(found->low[!banded], v.coherence);
                    found->high[!banded] = fmax(found->high[!banded], v.coherence);
                }
            }
        }
    }
    koksma__doc_say(&all->more, ". ");
}

static void conclude_bands(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    koksma__subject s;
    long long spp;
    coherences found = {.low = {INFINITY, INFINITY}};
    koksma__doc_say(&all->more, "Coherence of the errors in ");
    for (size_t i = 0; i < c->tables.n; i++) {
        const koksma__table *t = table_of(r, c, c->tables.at[i]);
        s = koksma__table_images(r->study, t);
        test_bands(r, c, &s, t->n.at[0], &found, all);
    }
    for (size_t i = 0; next_images(r, c, &i, &s, &spp);) {
        test_bands(r, c, &s, spp, &found, all);
    }
    koksma__doc_say(d, "%zu of %zu errors are as concluded", all->passed, all->tests);
    for (size_t k = 0; k < 2; k++) {
        if (found.low[k] <= found.high[k]) {
            koksma__doc_say(d, found.low[k] < found.high[k] ? "%s%.3g to %.3g" : "%s%.3g",
                            k ? ", of noise " : ": coherence with bands ", found.low[k], found.high[k]);
        }
    }
    koksma__doc_say(d, found.shades ? ", and %zu a shade, one slow wave." : ".", found.shades);
    if (!koksma__doc_is_empty(&found.beside)) {
        koksma__doc_say_words(d, &found.beside);
        koksma__doc_say(d, ".");
    }
}

/* ---- metric: images of the first pattern have a larger error than those of the first of `against` ---------- */

/* By a metric such as grain, in every scene of the block. Each scene is a test: the ratio of the means, with an interval
   from those of both by first-order propagation, must be surely above 1. */
static void conclude_metric(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    koksma__subject s;
    long long spp;
    size_t least = SIZE_MAX;
    koksma__doc_say(d, "Ratios of their %s: ", c->metric);
    koksma__doc_say(&all->more, "`%s` of ", c->metric);
    say_label(&all->more, r, c, c->patterns.at[0]);
    koksma__doc_say(&all->more, " over that of ");
    say_label(&all->more, r, c, c->against.at[0]);
    for (size_t i = 0; next_images(r, c, &i, &s, &spp);) {
        const koksma__summary x = koksma__read_mean(r, &s, c->patterns.at[0], spp, NULL),
                              y = koksma__read_mean(r, &s, c->against.at[0], spp, NULL);
        if (x.n < 2 || y.n < 2) {
            all->open++;
            continue;
        }
        const double ratio = x.mean / y.mean;
        const double half = ratio * koksma__hypot((x.high - x.mean) / x.mean, (y.high - y.mean) / y.mean);
        test(all, ratio - half > 1);
        koksma__doc_say(d, "%s%.2f in %s", all->tests > 1 ? ", " : "", ratio, s.scene);
        koksma__doc_say(&all->more, "%s %.3f (%.3f to %.3f) in %s", all->tests > 1 ? "," : ":", ratio, ratio - half,
                        ratio + half, s.scene);
        least = x.n < least ? x.n : least;
        least = y.n < least ? y.n : least;
    }
    koksma__doc_say(d, "; surely above 1 in %zu of %zu.", all->passed, all->tests);
    koksma__doc_say(&all->more, ", of the means of %zu images. ", all->tests ? least : 0);
}

/* ---- rates: the patterns converge faster than random points ------------------------------------------------ */

/* Exponents that differ from -1/2 by less are taken for those of finite sizes: the part of an error that vanishes faster
   still tilts it. */
#define TOLERANCE 0.05

static void say_tolerance(tested *all)
{
    koksma__doc_say(&all->more,
                    "Faster means an exponent surely below %.2f; one nearer to -1/2 may be that of finite sizes. ",
                    -0.5 - TOLERANCE);
}

/* The means of a pattern at all sizes, those above 0. */
static koksma__curve read_curve(koksma__report *r, const koksma__subject *s, const char *pattern)
{
    koksma__curve c = koksma__curve_of(r, s->n->n);
    for (size_t k = 0; k < s->n->n; k++) {
        koksma__curve_add(&c, s->n->at[k], koksma__read_mean(r, s, pattern, s->n->at[k], NULL));
    }
    return c;
}

/* Each pattern and measure is a test: the whole interval of the slope over the block's numbers of points must be below
   -1/2 - TOLERANCE. If the block has random points, each pattern's means are given, the last as a multiple of theirs. */
static void test_rates(koksma__report *r, koksma__document *d, const koksma__conclusion *c, const koksma__subject *s,
                       tested *all)
{
    const size_t sizes = s->n->n;
    koksma__curve random = {0};
    koksma__doc_say(d, "`%s`, N = %lld to %lld: ", s->measure, s->n->at[0], s->n->at[sizes - 1]);
    if (koksma__texts_have(s->patterns, "random") && (random = read_curve(r, s, "random")).n == sizes) {
        const koksma__estimate slope = koksma__trend_of(random.x, random.y, sizes).slope;
        koksma__doc_say(d, "random N^%.3f^ (± %.3f), ", slope.value, slope.high - slope.value);
    }
    for (size_t i = 0; i < c->patterns.n; i++) {
        const koksma__curve curve = read_curve(r, s, c->patterns.at[i]);
        const koksma__estimate slope = koksma__trend_of(curve.x, curve.y, curve.n).slope;
        if (curve.n < sizes || isnan(slope.high)) {
            all->open++;
            continue;
        }
        test(all, slope.high < -0.5 - TOLERANCE);
        say_label(d, r, c, c->patterns.at[i]);
        koksma__doc_say(d, " N^%.3f^ (± %.3f%s)%s", slope.value, slope.high - slope.value,
                        slope.high < -0.5 - TOLERANCE ? "" : ", not surely better",
                        i + 1 < c->patterns.n ? ", " : ".");
        for (size_t k = 0; k < sizes && random.n == sizes; k++) {
            if (!k) {
                say_label(&all->more, r, c, c->patterns.at[i]);
            }
            koksma__doc_say(&all->more, k ? ", %.3g at %lld" : " has means of %.3g at N = %lld", curve.y[k].mean,
                            s->n->at[k]);
            if (k + 1 == sizes) {
                koksma__doc_say(&all->more, ", the last %.2g times that of random points. ",
                                curve.y[k].mean / random.y[k].mean);
            }
        }
    }
}

static void conclude_rates(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    const koksma__plan_part *part = &r->study->plan.parts[c->part];
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        const koksma__discrepancy_block *block = &r->study->plan.discrepancies[b];
        for (size_t m = 0; block->id && !strcmp(block->id, c->discrepancies) && m < block->measures.n; m++) {
            const koksma__subject s = koksma__subject_of_points(block, block->measures.at[m], "");
            test_rates(r, d, c, &s, all);
        }
    }
    say_tolerance(all);
}

/* ---- slopes: the printed tables over several n, by the slopes that stand beside their rows ------------------- */

/* The slope of our means of a row by a measure of its table, of all columns; NaN if one is missing. */
static koksma__estimate slope_of(koksma__report *r, const koksma__table *t, const char *measure, const char *pattern)
{
    koksma__curve c = koksma__curve_of(r, t->n.n);
    for (size_t k = 0; k < t->n.n; k++) {
        koksma__curve_add(&c, t->n.at[k], koksma__points_cell(r, t, measure, pattern, t->n.at[k]).mean);
    }
    return c.n == t->n.n ? koksma__trend_of(c.x, c.y, c.n).slope : (koksma__estimate){NAN, NAN, NAN};
}

/* Whether a slope is as a conclusion says: surely above that of another table, or surely below -1/2 - TOLERANCE if it is to
   be `faster`, and otherwise not. */
static bool slope_passes(koksma__estimate slope, const koksma__estimate *other, bool faster)
{
    return other ? slope.low > other->high : (slope.high < -0.5 - TOLERANCE) == faster;
}

/* Each row of a pattern is a test: its slope must be surely below -1/2 - TOLERANCE and, of a pattern of `against`, must not
   be; with `by` it must be surely above the pattern's slope in that table. Rows by another procedure than the printed
   one are no tests. */
static void conclude_slopes(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    const koksma__table *by = c->by.n ? table_of(r, c, c->by.at[0]) : NULL;
    const koksma__estimate none = {NAN, NAN, NAN};
    for (size_t i = 0; i < c->tables.n; i++) {
        const koksma__table *t = table_of(r, c, c->tables.at[i]);
        const bool other = is_other(t, 0), exact = judged_by(t) != t->measure;
        koksma__document *to = other && c->tables.n > 1 ? &all->more : d;
        koksma__doc_say(to, other ? "By our rows' procedure (`%s`) in table %s:" : "%s in table %s",
                        other        ? t->measure
                        : all->tests ? ";"
                                     : "Slopes",
                        t->id);
        if (!other && exact) {
            koksma__doc_say(to, " (`%s`)", judged_by(t));
        }
        size_t said = 0, unsure = 0; /* unsure: slopes that do not pass by the printed procedure */
        for (size_t k = 0; k < c->patterns.n + c->against.n; k++) {
            const bool faster = k < c->patterns.n;
            const char *pattern = faster ? c->patterns.at[k] : c->against.at[k - c->patterns.n];
            if (!koksma__plan_row_of(t, pattern)) {
                continue;
            }
            const koksma__estimate slope = slope_of(r, t, judged_by(t), pattern),
                                   least = by ? slope_of(r, by, judged_by(by), pattern) : none;
            koksma__doc_say(to, said++ ? ", " : " ");
            say_label(to, r, c, pattern);
            koksma__doc_say(to, " %.3f ± %.3f", slope.value, slope.high - slope.value);
            if (exact) {
                const koksma__estimate printed = slope_of(r, t, t->measure, pattern);
                koksma__doc_say(&all->more, said > 1 ? ", " : "By `%s`, as printed, ", t->measure);
                say_label(&all->more, r, c, pattern);
                koksma__doc_say(&all->more, " %.3f ± %.3f", printed.value, printed.high - printed.value);
                unsure += !slope_passes(printed, by ? &least : NULL, faster);
            }
            if (by) {
                koksma__doc_say(to, " (%.3f ± %.3f in table %s)", least.value, least.high - least.value, by->id);
            }
            all->other += other;
            all->open += isnan(slope.high) || (by && isnan(least.high));
            if (!other) {
                test(all, slope_passes(slope, by ? &least : NULL, faster));
            }
        }
        koksma__doc_say(&all->more, exact ? ". " : "");
        if (unsure) {
            koksma__doc_say(d,
                            by ? "; by the printed procedure the intervals overlap in %zu of %zu"
                               : "; by the printed procedure not surely in %zu of %zu",
                            unsure, said);
        }
        koksma__doc_say(to, other ? to == d ? "." : ". " : "");
    }
    koksma__doc_say(d, all->tests ? "." : "");
    if (by) {
        koksma__doc_say(&all->more,
                        "The intervals must be apart; that of a pattern with one set is that of the fit. ");
    } else {
        say_tolerance(all);
    }
}

/* ---- adaptive: adaptive sampling splits fewer strata needlessly in the first of two figures ------------------ */

/* Each pair of figures is a test, by the share of splits that were needless. */
static void conclude_adaptive(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    double share[2] = {0};
    for (size_t i = 0; i < c->figures.n; i++) {
        const koksma__figure *f = koksma__plan_figure_of(&r->study->plan, c->part, c->figures.at[i]);
        const koksma_adaptive_report *cost = &r->adaptive[f - r->study->plan.figures];
        share[i % 2] = (double)cost->needless / (double)cost->splits;
        koksma__doc_say(d, "%s%.0f %% in %s%s (`%s`)",
                        i % 2 ? " against "
                        : i   ? "; "
                              : "Needless splits: ",
                        100 * share[i % 2], i ? "" : "figure ", f->id, f->adaptive);
        koksma__doc_say(&all->more, "%s%s: %.1f more samples a pixel", i ? ", " : "Figure ", f->id,
                        (double)(cost->samples - cost->first) / (double)cost->first * (double)f->n);
        if (i % 2) {
            test(all, share[0] < share[1]);
            all->open += isnan(share[0] + share[1]);
        }
    }
    koksma__doc_say(d, ".");
    koksma__doc_say(&all->more, ". ");
}

/* ---- The section ------------------------------------------------------------------------------------------- */

/* The functions, in the order of koksma__conclusion_kinds. */
static void (*const functions[])(koksma__report *, koksma__document *, const koksma__conclusion *, tested *) = {
#define CONCLUSION(name, fields) conclude_##name,
#include "study/plan/conclusions.def"
#undef CONCLUSION
};

static bool has_conclusions(const koksma__report *r)
{
    bool found = false;
    for (size_t i = 0; i < r->study->plan.n_conclusions; i++) {
        const koksma__conclusion *c = &r->study->plan.conclusions[i];
        found |= c->part == r->part && !(c->kind->fields & KOKSMA__NEEDS_FIGURES);
    }
    return found;
}

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

void koksma__conclude(koksma__report *r, koksma__document *d, const koksma__conclusion *c)
{
    static const char *const verdicts[] = {[KOKSMA__ANSWER_HOLDS] = "Holds",
                                           [KOKSMA__ANSWER_PARTLY] = "Holds in part",
                                           [KOKSMA__ANSWER_FAILS] = "Does not hold"};
    tested all = {0};
    koksma__document words = {0};
    functions[c->kind - koksma__conclusion_kinds](r, &words, c, &all);
    const koksma__answer_kind answer = all.open || !all.tests    ? KOKSMA__ANSWER_UNDECIDED
                                       : all.passed == all.tests ? KOKSMA__ANSWER_HOLDS
                                       : all.passed              ? KOKSMA__ANSWER_PARTLY
                                                                 : KOKSMA__ANSWER_FAILS;
    koksma__doc_answer(d, answer, "*%s%s%s:* %s ",
                       answer                   ? verdicts[answer]
                       : all.other && !all.open ? "Not decided, as our rows are by another procedure"
                                                : "Not decided, as rows are missing",
                       all.other && answer ? ", as far as our procedure is the printed one" : "",
                       is_fitted(r, c) ? " (scenes fitted)" : "", c->says);
    koksma__doc_say_words(d, &words);
    if (c->remark || !koksma__doc_is_empty(&all.more)) {
        koksma__doc_paragraph(d, "%s", "");
        koksma__doc_say_words(d, &all.more);
        koksma__doc_say(d, "%s", c->remark ? c->remark : "");
    }
}

static void write_conclusions(koksma__report *r, koksma__document *d)
{
    for (size_t i = 0; !r->status && i < r->study->plan.n_conclusions; i++) {
        const koksma__conclusion *c = &r->study->plan.conclusions[i];
        if (c->part == r->part && !(c->kind->fields & KOKSMA__NEEDS_FIGURES)) {
            koksma__conclude(r, d, c);
        }
    }
}

const koksma__section koksma__section_conclusions = {"What the paper concludes, and whether it holds", true,
                                                     has_conclusions, write_conclusions};
