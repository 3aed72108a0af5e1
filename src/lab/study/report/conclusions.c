/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a paper concludes, and whether the rows of the study bear it out: one paragraph for each conclusion of the plan,
 * with which the page begins. A conclusion holds if it passes all its tests, in part if it passes some, and not if it
 * passes none; it is undecided while rows are missing. Each kind of conclusions.def has a function here, which writes
 * the words of the result into an open paragraph and counts its tests.
 */
#include <math.h>
#include <string.h>

#include "core/elementary.h"
#include "study/plan/plan.h"
#include "study/report/report.h"

/* The number of tests that a conclusion passes, of those that its rows allow; rows that are missing count as `open`. */
typedef struct tested {
    size_t passed, tests, open;
    /* of the tests, those by another procedure than the printed one, and those of them that fail: they decide nothing
       against the paper */
    size_t other, other_failed;
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

/* The label of a pattern in the first table of the conclusion's plan that has it, or the pattern. */
static const char *label_of(const koksma__report *r, const koksma__conclusion *c, const char *pattern)
{
    for (size_t i = 0; i < r->study->plan.n_tables; i++) {
        const koksma__table *t = &r->study->plan.tables[i];
        const koksma__table_row *row = t->part == c->part ? koksma__plan_row_of(t, pattern) : NULL;
        if (row) {
            return row->label;
        }
    }
    return pattern;
}

/* Our mean, and the printed one, of a table's row at column k; NaN: none. */
typedef struct pair {
    double ours, printed;
} pair;

static pair means_of(koksma__report *r, const koksma__table *t, const char *pattern, size_t k)
{
    const koksma__cell cell = koksma__table_cell(r, t, pattern, k);
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
    koksma__doc_say(d, "Ours by mean rank: ");
    for (size_t i = 0; i < n; i++) {
        if (i) {
            const bool falls = ranks[i - 1] > ranks[i] * (1 + 1e-12),
                       equal = !falls && ranks[i - 1] > ranks[i] * (1 - 1e-12);
            test(all, !falls);
            tied |= equal;
            koksma__doc_say(d, "%s", falls ? " > " : equal ? " = " : " < ");
        }
        koksma__doc_say(d, "%s %.3g", label_of(r, c, c->patterns.at[i]), ranks[i] / (double)tables);
    }
    koksma__doc_say(d, "%s", tied ? " (equal ranks neither confirm nor deny their order)" : "");
    koksma__doc_say(d, ". Rank correlation of the printed means with ours:");
    for (size_t t = 0; t < tables; t++) {
        koksma__doc_say(d, "%s %.2f in %s", t ? ";" : "", rho[t], c->tables.at[t]);
    }
    koksma__doc_say(d, ".");
}

/* ---- best: the first pattern has the least error ----------------------------------------------------------- */

/* In the tables where it has not, only the patterns of `against` have less: each table is a test. More than half of the
   tables must have it first, which is one more test. */
static void conclude_best(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    size_t first = 0;
    for (size_t k = 0; k < c->tables.n; k++) {
        const koksma__table *t = table_of(r, c, c->tables.at[k]);
        const double best = means_of(r, t, c->patterns.at[0], 0).ours;
        size_t before = 0, unexpected = 0;
        for (size_t i = 0; i < t->n_rows; i++) {
            const koksma__table_row *row = &t->rows[i];
            const double mean = means_of(r, t, row->pattern, 0).ours;
            all->open += isnan(mean);
            if (mean < best) {
                koksma__doc_say(d, before ? "; %s" : "%s: after ", before ? row->label : t->id);
                koksma__doc_say(d, "%s", before++ ? "" : row->label);
                unexpected += !koksma__texts_have(&c->against, row->pattern);
            }
        }
        if (before) {
            koksma__doc_say(d, ". ");
        } else {
            koksma__doc_say(d, "%s: first. ", t->id);
        }
        first += !before;
        test(all, !unexpected);
    }
    test(all, 2 * first > c->tables.n);
    koksma__doc_say(d, "First in %zu of %zu tables.", first, c->tables.n);
}

/* ---- predictor: a measure orders the patterns as the errors do --------------------------------------------- */

/* The Spearman's correlation of n means from which on it is above 0 at 5 %, by t = rho sqrt((n - 2) / (1 - rho^2)) with
   n - 2 degrees of freedom. */
static double sure_from(size_t n)
{
    const double t = n > 2 ? koksma__student_quantile(0.95, (double)n - 2) : (double)NAN;
    return t / sqrt((double)n - 2 + t * t);
}

static bool is_sure(double rho, size_t n)
{
    return rho > sure_from(n);
}

/* The measure of the first table of `by` must be surely correlated with the errors of each table, which is a test; the
   other tables of `by` stand beside it without a test. */
static void conclude_predictor(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    const size_t n = c->patterns.n;
    double *x = koksma__report_memory(r, 4 * n, sizeof *x);
    if (!x) {
        return;
    }
    double *x_printed = x + n, *y = x_printed + n, *y_printed = y + n;
    for (size_t by = 0; by < c->by.n; by++) {
        const koksma__table *of = table_of(r, c, c->by.at[by]);
        list_means(r, c, of, x, x_printed);
        koksma__doc_say(d, "%s%s (table %s):", by ? ". " : "Rank correlation with the error, ours (printed). ",
                        of->title, of->id);
        for (size_t k = 0; k < c->tables.n; k++) {
            const koksma__table *t = table_of(r, c, c->tables.at[k]);
            list_means(r, c, t, y, y_printed);
            const double rho = koksma__spearman(x, y, n);
            koksma__doc_say(d, "%s %.2f (%.2f) in %s", k ? ";" : "", rho, koksma__spearman(x_printed, y_printed, n),
                            t->id);
            for (size_t i = 0; i < n && !by; i++) {
                all->open += isnan(x[i]) || isnan(y[i]);
            }
            if (!by) {
                test(all, is_sure(rho, n));
            }
        }
    }
    koksma__doc_say(d, ". Of %zu patterns a correlation is surely above 0 (at 5 %%) from %.2f on.", n, sure_from(n));
}

/* ---- before: each pattern has a smaller mean than each of `against` ---------------------------------------- */

enum { NAMED = 2 };

/* Whether a note says that a printed mean is not of our procedure. */
static bool is_untested(const koksma__table *t, const char *pattern, size_t k)
{
    const size_t note = koksma__table_note(t, pattern, koksma__table_is_over_n(t) ? t->n.at[k] : 0, 0);
    return note && t->notes[note - 1].untested;
}

/* Every comparison in each table at each number of points is a test, by our means; the same comparisons of the printed
   means stand beside them. NAMED of those that fail are named. Where both means are by another procedure than the printed
   ones, a test that fails leaves the conclusion undecided. */
static void conclude_before(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    size_t in_print = 0, printed = 0, failed = 0;
    for (size_t i = 0; i < c->tables.n * KOKSMA__TABLE_PRINTED; i++) {
        const koksma__table *t = table_of(r, c, c->tables.at[i / KOKSMA__TABLE_PRINTED]);
        const size_t k = i % KOKSMA__TABLE_PRINTED;
        for (size_t j = 0; k < t->n.n && j < c->patterns.n * c->against.n; j++) {
            const char *better = c->patterns.at[j / c->against.n], *worse = c->against.at[j % c->against.n];
            const pair x = means_of(r, t, better, k), y = means_of(r, t, worse, k);
            all->open += isnan(x.ours) || isnan(y.ours);
            const bool other = is_untested(t, better, k) && is_untested(t, worse, k);
            test(all, x.ours < y.ours);
            all->other += other;
            all->other_failed += other && !(x.ours < y.ours);
            printed += !isnan(x.printed) && !isnan(y.printed);
            in_print += x.printed < y.printed;
            if (!(x.ours < y.ours) && failed++ < NAMED) {
                koksma__doc_say(d, "%s%s against %s in table %s", failed > 1 ? "; " : "Not: ", label_of(r, c, better),
                                label_of(r, c, worse), t->id);
                if (koksma__table_is_over_n(t)) {
                    koksma__doc_say(d, " at N = %lld", t->n.at[k]);
                }
            }
        }
    }
    if (failed > NAMED) {
        koksma__doc_say(d, "; and %zu more", failed - NAMED);
    }
    koksma__doc_say(d, "%s", failed ? ". " : "");
    koksma__doc_say(d, "Smaller in %zu of %zu comparisons, in print in %zu of %zu.", all->passed, all->tests,
                    in_print, printed);
    if (all->other) {
        koksma__doc_say(d, " %zu of our comparisons are by another procedure than the printed one (see the note).",
                        all->other);
    }
}

/* ---- bands: the errors of the patterns are in visible bands, and those of `against` are not ---------------- */

/* Each pattern in each image is a test, by the coherence of the mean spectrum. */
static void test_bands(koksma__report *r, koksma__document *d, const koksma__conclusion *c, const koksma__subject *s,
                       long long spp, tested *all)
{
    koksma__doc_say(d, "_%s_: ", s->scene);
    for (size_t i = 0; i < c->patterns.n + c->against.n; i++) {
        const bool expected = i < c->patterns.n;
        const char *pattern = expected ? c->patterns.at[i] : c->against.at[i - c->patterns.n];
        const koksma_coherence_values v = koksma__mean_coherence(r, s, pattern, spp);
        if (!v.images) {
            all->open++;
            continue;
        }
        test(all, v.coherent == expected);
        koksma__doc_say(d, "%s %.3g (%.2g)%s; ", label_of(r, c, pattern), v.coherence, v.noise_high,
                        v.coherent == expected ? ""
                        : expected             ? ", no bands"
                                               : ", in bands");
    }
}

static void conclude_bands(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    koksma__subject s;
    long long spp;
    koksma__doc_say(d, "Coherence (noise below), ");
    for (size_t i = 0; i < c->tables.n; i++) {
        const koksma__table *t = table_of(r, c, c->tables.at[i]);
        s = koksma__table_images(r->study, t);
        test_bands(r, d, c, &s, t->n.at[0], all);
    }
    for (size_t i = 0; next_images(r, c, &i, &s, &spp);) {
        test_bands(r, d, c, &s, spp, all);
    }
    koksma__doc_say(d, "%zu of %zu as concluded.", all->passed, all->tests);
}

/* ---- metric: images of the first pattern have a larger error than those of the first of `against` ---------- */

/* By a metric such as grain, in every scene of the block. Each scene is a test: the ratio of the means, with an interval
   from those of both by first-order propagation, must be surely above 1. */
static void conclude_metric(koksma__report *r, koksma__document *d, const koksma__conclusion *c, tested *all)
{
    koksma__subject s;
    long long spp;
    size_t least = SIZE_MAX;
    koksma__doc_say(d, "`%s` of %s over that of %s: ", c->metric, label_of(r, c, c->patterns.at[0]),
                    label_of(r, c, c->against.at[0]));
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
        koksma__doc_say(d, "%s%.3f (%.3f to %.3f) in %s", all->tests > 1 ? "; " : "", ratio, ratio - half,
                        ratio + half, s.scene);
        least = x.n < least ? x.n : least;
        least = y.n < least ? y.n : least;
    }
    if (all->tests) {
        koksma__doc_say(d, ", of the means of %zu images; surely above 1 in %zu of %zu scenes.", least, all->passed,
                        all->tests);
    }
}

/* ---- rates: the patterns converge faster than random points ------------------------------------------------ */

/* Exponents that differ from -1/2 by less are taken for those of finite sizes: the part of an error that vanishes faster
   still tilts it. */
#define TOLERANCE 0.05

/* Reads the means of a pattern at all sizes, those above 0, and returns their number. */
static size_t read_positive(koksma__report *r, const koksma__subject *s, const char *pattern, double *x,
                            koksma__summary *means)
{
    size_t known = 0;
    for (size_t k = 0; k < s->n->n; k++) {
        const koksma__summary mean = koksma__read_mean(r, s, pattern, s->n->at[k], NULL);
        if (mean.n && mean.mean > 0) {
            x[known] = (double)s->n->at[k];
            means[known++] = mean;
        }
    }
    return known;
}

/* Each pattern and measure is a test: the whole interval of the slope over the block's numbers of points must be below
   -1/2 - TOLERANCE. If the block has random points, each pattern's mean at the largest size is given as a multiple. */
static void test_rates(koksma__report *r, koksma__document *d, const koksma__conclusion *c, const koksma__subject *s,
                       tested *all)
{
    const size_t sizes = s->n->n;
    double *x = koksma__report_memory(r, sizes, sizeof *x), random = NAN;
    koksma__summary *means = koksma__report_memory(r, sizes, sizeof *means);
    if (!x || !means) {
        return;
    }
    if (koksma__texts_have(s->patterns, "random") && read_positive(r, s, "random", x, means) == sizes) {
        random = means[sizes - 1].mean;
    }
    koksma__doc_say(d, "`%s`, N = %lld to %lld: ", s->measure, s->n->at[0], s->n->at[sizes - 1]);
    for (size_t i = 0; i < c->patterns.n; i++) {
        const size_t known = read_positive(r, s, c->patterns.at[i], x, means);
        const koksma__estimate slope = koksma__trend_of(x, means, known).slope;
        if (known < sizes || isnan(slope.high)) {
            all->open++;
            continue;
        }
        test(all, slope.high < -0.5 - TOLERANCE);
        koksma__doc_say(d, "%s N^%.3f^ (± %.3f)", label_of(r, c, c->patterns.at[i]), slope.value,
                        slope.high - slope.value);
        if (!isnan(random)) {
            koksma__doc_say(d, ", at the end %.2g times random", means[known - 1].mean / random);
        }
        koksma__doc_say(d, i + 1 < c->patterns.n ? "; " : ". ");
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
    koksma__doc_say(d, "Faster means an exponent surely below %.2f; one nearer to -1/2 may be that of finite sizes.",
                    -0.5 - TOLERANCE);
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
        found |= r->study->plan.conclusions[i].part == r->part;
    }
    return found;
}

static void add(koksma__report *r, koksma__document *d, const koksma__conclusion *c)
{
    static const char *const verdicts[] = {[KOKSMA__ANSWER_UNDECIDED] = "Not decided: rows are missing",
                                           [KOKSMA__ANSWER_HOLDS] = "Holds",
                                           [KOKSMA__ANSWER_PARTLY] = "Holds in part",
                                           [KOKSMA__ANSWER_FAILS] = "Does not hold"};
    tested all = {0};
    koksma__document words = {0};
    koksma__doc_words_begin(&words);
    functions[c->kind - koksma__conclusion_kinds](r, &words, c, &all);
    const bool undecided = all.open || !all.tests || all.other_failed;
    const koksma__answer_kind answer = undecided                 ? KOKSMA__ANSWER_UNDECIDED
                                       : all.passed == all.tests ? KOKSMA__ANSWER_HOLDS
                                       : all.passed              ? KOKSMA__ANSWER_PARTLY
                                                                 : KOKSMA__ANSWER_FAILS;
    koksma__doc_verdict_begin(d, answer);
    koksma__doc_say(d, "*%s* _%s._ ", c->says,
                    all.other_failed && !all.open ? "Not decided: the rows are not by the paper's procedure"
                                                  : verdicts[answer]);
    koksma__doc_words_append(d, &words);
    if (c->remark) {
        koksma__doc_say(d, " %s", c->remark);
    }
    koksma__doc_paragraph_end(d);
}

static void write_conclusions(koksma__report *r, koksma__document *d)
{
    for (size_t i = 0; !r->status && i < r->study->plan.n_conclusions; i++) {
        if (r->study->plan.conclusions[i].part == r->part) {
            add(r, d, &r->study->plan.conclusions[i]);
        }
    }
}

const koksma__section koksma__section_conclusions = {"What the paper concludes, and whether it holds", true,
                                                     has_conclusions, write_conclusions};
