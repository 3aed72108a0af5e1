/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Compares published tables with the store: the cell of a row (mean, SD and maximum over trials), the verdict on the
 * published mean, the joint test of a table's verdicts, and the rows that koksma_study_table_row returns. A published mean
 * of a discrepancy agrees if |z|, the difference divided by the sum of its standard error and half a unit of the last
 * published digit, is below KOKSMA__AGREEMENT_Z; a published mean of image errors agrees if it is within
 * KOKSMA__IMAGE_TOLERANCE of ours. If the differences of a table are due to chance only, the sum of its k values of z
 * divided by sqrt k has a standard normal distribution, and the sum of their squares a chi-squared distribution with k
 * degrees of freedom.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/plan/plan.h"
#include "study/report/report.h"
#include "study/run/references.h"

/* ---- Cells ------------------------------------------------------------------------------------------------- */

koksma__subject koksma__table_images(const koksma_study *study, const koksma__table *t)
{
    return koksma__subject_of_images(&study->plan.images[t->images], t->scene, "", KOKSMA__DEFAULT_METRIC);
}

/* The block of the table's plan that has the results of a row; if several blocks have them, the one with the most
   sets. */
static const koksma__discrepancy_block *block_of(const koksma_study *study, const koksma__table *t,
                                                 const char *measure, const char *pattern, long long n)
{
    const koksma__plan_part *part = &study->plan.parts[t->part];
    const koksma__discrepancy_block *most = NULL;
    for (size_t b = part->discrepancies[0]; b < part->discrepancies[1]; b++) {
        const koksma__discrepancy_block *block = &study->plan.discrepancies[b];
        if (koksma__plan_block_makes(block, measure, pattern, n, t->dim) && (!most || block->trials > most->trials)) {
            most = block;
        }
    }
    return most;
}

koksma__cell koksma__points_cell(koksma__report *r, const koksma__table *t, const char *measure, const char *pattern,
                                 long long n)
{
    const koksma__discrepancy_block *block = block_of(r->study, t, measure, pattern, n);
    koksma__cell cell = {0};
    if (!block) {
        koksma__report_keep(
            r, koksma__fail(KOKSMA_MALFORMED,
                            "plan '%s': table %s: no discrepancy block of the plan measures %s at n = %lld",
                            r->study->plan.name, t->id, measure, n));
        return cell;
    }
    const koksma__subject points = koksma__subject_of_points(block, measure, "");
    koksma__result *results;
    cell.mean = koksma__read_mean(r, &points, pattern, n, &results);
    if (results) {
        const size_t sets = cell.mean.n;
        cell.sd = cell.mean.sd;
        koksma__largest_of(results->values, sets, KOKSMA__RESULT_STRIDE, 100, &cell.max, &cell.max_sd);
        cell.max_sd = sets < 500 ? (double)NAN : cell.max_sd; /* an SD of fewer than five blocks says nothing */
        cell.max = isnan(cell.max) ? cell.mean.max : cell.max;
    }
    free(results);
    return cell;
}

koksma__cell koksma__image_cell(koksma__report *r, const koksma__table *t, const koksma__reference *reference,
                                const char *pattern)
{
    koksma__subject images = koksma__table_images(r->study, t);
    koksma__result *results;
    images.reference = reference;
    koksma__cell cell = {.mean = koksma__read_mean(r, &images, pattern, t->n.at[0], &results)};
    if (results) {
        const size_t n = cell.mean.n;
        cell.sd = koksma__summarize_sizes(results->values + 1, n, KOKSMA__RESULT_STRIDE).mean;
        const koksma__summary max = koksma__summarize_sizes(results->values + 2, n, KOKSMA__RESULT_STRIDE);
        cell.max = max.mean;
        cell.max_sd = max.sd;
    }
    free(results);
    return cell;
}

koksma__cell koksma__table_cell(koksma__report *r, const koksma__table *t, const char *pattern, size_t k)
{
    return t->scene ? koksma__image_cell(r, t, &r->study->plan.images[t->images].references[0], pattern)
                    : koksma__points_cell(r, t, t->measure, pattern, t->n.at[k]);
}

/* ---- Agreement of published means with ours ---------------------------------------------------------------- */

size_t koksma__table_note(const koksma__table *t, const char *pattern, long long n, int statistic)
{
    for (size_t i = 0; i < t->n_notes; i++) {
        const koksma__note *note = &t->notes[i];
        if (note->statistic == statistic && (!note->pattern || !strcmp(note->pattern, pattern)) &&
            (!note->n || note->n == n)) {
            return i + 1;
        }
    }
    return 0;
}

koksma__verdict koksma__table_judge(const koksma__table *t, const koksma__table_row *row, size_t column,
                                    const koksma__cell *cell)
{
    const koksma__printed *printed = &row->published[column];
    const double n = (double)cell->mean.n;
    koksma__verdict v = {.z = NAN, .ratio = NAN};
    v.note = koksma__table_note(t, row->pattern, koksma__table_is_over_n(t) ? t->n.at[column] : 0, 0);
    if (isnan(printed->value)) {
        v.kind = KOKSMA_VERDICT_NEW;
        return v;
    }
    bool agrees;
    if (t->scene) {
        v.ratio = cell->mean.mean == printed->value ? 0 : cell->mean.mean / printed->value - 1; /* both may be 0 */
        agrees = fabs(v.ratio) <= KOKSMA__IMAGE_TOLERANCE;
    } else { /* the published mean was taken over 100 sets */
        v.z = (printed->value - cell->mean.mean) / (sqrt(cell->sd * cell->sd * (0.01 + 1 / n)) + printed->half_digit);
        agrees = fabs(v.z) < KOKSMA__AGREEMENT_Z;
    }
    v.kind = cell->mean.n == 0 || (!t->scene && isnan(v.z)) ? KOKSMA_VERDICT_WAITING
             : v.note && t->notes[v.note - 1].untested      ? KOKSMA_VERDICT_UNTESTED
             : agrees && t->scene && t->fitted              ? KOKSMA_VERDICT_FITTED
             : agrees                                       ? KOKSMA_VERDICT_AGREES
             : v.note && t->notes[v.note - 1].explained     ? KOKSMA_VERDICT_EXPLAINED
                                                            : KOKSMA_VERDICT_UNEXPLAINED;
    return v;
}

void koksma__z_add(koksma__z_sums *sums, const koksma__verdict *v, const koksma__cell *cell)
{
    if (!isfinite(v->z)) {
        return;
    }
    if (v->kind == KOKSMA_VERDICT_UNTESTED) {
        sums->untested++;
    } else if (!(cell->sd > 0)) { /* all sets are equal */
        sums->one_set++;
    } else {
        sums->count++;
        sums->sum += v->z;
        sums->squares += v->z * v->z;
    }
}

bool koksma__z_deviates(const koksma__z_sums *z, double alpha)
{
    return z->count > 1 && z->sum * z->sum > (double)z->count * koksma__chi_squared_quantile(1 - alpha, 1);
}

bool koksma__z_spreads(const koksma__z_sums *z, double alpha)
{
    return z->count > 1 && z->squares > koksma__chi_squared_quantile(1 - alpha, (double)z->count);
}

/* ---- The section that counts them -------------------------------------------------------------------------- */

/* The groups of tables that are counted separately: means of measures, which are tested statistically; means of image
   errors; and image errors in scenes that were fitted to the published numbers. */
enum { MEASURES, IMAGES, FITTED, GROUPS };

/* The verdicts of each group, where the means of measures are no test, and the values of z of each table. */
typedef struct counts {
    size_t of[GROUPS][KOKSMA_VERDICT_UNTESTED + 1];
    koksma__z_sums *z; /* [table] */
} counts;

/* A table over several numbers of points has one mean per row and column, other tables one per row. */
static void count_table(koksma__report *r, const koksma__table *t, counts *all, koksma__z_sums *z)
{
    size_t *of = all->of[!t->scene ? MEASURES : t->fitted ? FITTED : IMAGES];
    for (size_t i = 0; !r->status && i < t->n_rows * t->n.n; i++) {
        const koksma__table_row *row = &t->rows[i / t->n.n];
        const koksma__cell cell = koksma__table_cell(r, t, row->pattern, i % t->n.n);
        const koksma__verdict verdict = koksma__table_judge(t, row, i % t->n.n, &cell);
        of[verdict.kind]++;
        koksma__z_add(z, &verdict, &cell);
    }
}

static const char *verb(size_t n)
{
    return n == 1 ? "differs" : "differ";
}

/* Writes how many published means of a group agree, unless the group has no means to compare. The answer is undecided if
   some differ for an unknown reason. */
static void say_group(koksma__document *d, int group, const counts *all, size_t tables)
{
    size_t one_set = 0;
    const size_t *of = all->of[group];
    const size_t agree = of[KOKSMA_VERDICT_AGREES] + of[KOKSMA_VERDICT_FITTED],
                 explained = of[KOKSMA_VERDICT_EXPLAINED], unexplained = of[KOKSMA_VERDICT_UNEXPLAINED];
    if (!(agree + explained + unexplained)) {
        return;
    }
    if (group == FITTED) {
        koksma__doc_paragraph(d, "%s", ""); /* by construction, so that it answers nothing */
    } else {
        koksma__doc_answer(d, !unexplained, "%s", "");
    }
    koksma__doc_say(d, "%zu of %zu published means ", agree, agree + explained + unexplained);
    if (group == MEASURES) {
        koksma__doc_say(d, "of measures agree, each alone: chance and rounding explain differences of |z| below %.1f",
                        KOKSMA__AGREEMENT_Z);
    } else {
        koksma__doc_say(d, "of %s agree within %.0f %%%s",
                        group == IMAGES ? "images" : "images in scenes that were fitted to them",
                        100 * KOKSMA__IMAGE_TOLERANCE,
                        group == IMAGES ? "" : ", so their agreement in size confirms nothing");
    }
    if (explained) {
        koksma__doc_say(d, "; %zu %s for a reason that a note below the table gives", explained, verb(explained));
    }
    if (unexplained) {
        koksma__doc_say(d, "; %zu %s for an unknown reason%s: ✗ in the tables", unexplained, verb(unexplained),
                        group == MEASURES ? " or by chance" : "");
    }
    for (size_t i = 0; i < tables && group == MEASURES; i++) {
        one_set += all->z[i].one_set;
    }
    if (one_set) {
        koksma__doc_say(d, "; %zu of the %zu are of a pattern with one set, where rounding alone decides", one_set,
                        agree + explained + unexplained);
    }
    if (group == MEASURES && of[KOKSMA_VERDICT_UNTESTED]) {
        koksma__doc_say(d, "; %zu more are no test", of[KOKSMA_VERDICT_UNTESTED]);
    }
    koksma__doc_say(d, ".");
}

static bool fails(const koksma__z_sums *z, double alpha)
{
    return koksma__z_deviates(z, alpha) || koksma__z_spreads(z, alpha);
}

/* Lists the tables that fail one of their two tests at 5 %, with both sums; strict: those that fail at 5 % for all
   tests of all tables together, otherwise those that do not. */
static void list_failed(koksma__document *d, const koksma__plan *plan, const koksma__z_sums *z, double all_tests,
                        bool strict)
{
    size_t named = 0;
    for (size_t i = 0; i < plan->n_tables; i++) {
        if (fails(&z[i], 0.05) && fails(&z[i], 0.05 / all_tests) == strict) {
            koksma__doc_say(d, "%s%s (%+.2f, %.1f of %zu)", named++ ? "; " : "", plan->tables[i].id,
                            z[i].sum / sqrt((double)z[i].count), z[i].squares, z[i].count);
        }
    }
}

/* Of many tests some fail by chance at 5 % each. A table that fails at 5 % for all tests together is not explained by
   chance (Bonferroni); otherwise a failure decides nothing. */
static void say_joint(koksma__document *d, const koksma__plan *plan, const koksma__z_sums *z)
{
    size_t tested = 0, failed = 0, strictly = 0, named = 0;
    for (size_t i = 0; i < plan->n_tables; i++) {
        tested += z[i].count > 1;
    }
    const double all_tests = 2 * (double)tested;
    for (size_t i = 0; i < plan->n_tables; i++) {
        failed += fails(&z[i], 0.05);
        strictly += fails(&z[i], 0.05 / all_tests);
    }
    if (!tested) {
        return;
    }
    koksma__doc_answer(
        d,
        strictly ? KOKSMA__ANSWER_FAILS
        : failed ? KOKSMA__ANSWER_UNDECIDED
                 : KOKSMA__ANSWER_DECIDED,
        "The values of z of %zu of %zu tables pass their joint tests (of sum / √k and of squares, 5 %% each)",
        tested - failed, tested);
    if (strictly) {
        koksma__doc_say(d, "; chance alone does not explain the tables that fail: table ");
        list_failed(d, plan, z, all_tests, true);
    }
    if (failed > strictly) {
        koksma__doc_say(d, "; one failure at 5 %% decides nothing: table ");
        list_failed(d, plan, z, all_tests, false);
        koksma__doc_say(d, " (of %.0f tests %.2g fail by chance)", all_tests, 0.05 * all_tests);
    }
    for (size_t i = 0; i < plan->n_tables; i++) {
        if (z[i].count < 2 && z[i].untested) {
            koksma__doc_say(d, named++ ? ", %s" : ". No test, because of its note: table %s", plan->tables[i].id);
        }
    }
    koksma__doc_say(d, ".");
}

static void write_agreement(koksma__report *r, koksma__document *d)
{
    const koksma__plan *plan = &r->study->plan;
    counts all = {.z = koksma__report_memory(r, plan->n_tables, sizeof *all.z)};
    size_t waiting = 0;
    for (size_t i = 0; all.z && i < plan->n_tables; i++) {
        count_table(r, &plan->tables[i], &all, &all.z[i]);
    }
    for (int group = 0; !r->status && group < GROUPS; group++) {
        say_group(d, group, &all, plan->n_tables);
        waiting += all.of[group][KOKSMA_VERDICT_WAITING];
        if (group == MEASURES) {
            say_joint(d, plan, all.z);
        }
    }
    if (waiting) {
        koksma__doc_paragraph(d, "%zu published mean%s too few trials yet to be compared.", waiting,
                              waiting == 1 ? " has" : "s have");
    }
}

const koksma__section koksma__section_agreement = {"Agreement with the published means", false, write_agreement};

/* ---- The public interface ---------------------------------------------------------------------------------- */

const char *koksma_study_table_at(const koksma_study *study, size_t i)
{
    KOKSMA__REQUIRE_OR(NULL, study);
    return i < study->plan.n_tables ? study->plan.tables[i].id : NULL;
}

const char *koksma_study_verdict_name(koksma_study_verdict verdict)
{
    static const char *const names[] = {[KOKSMA_VERDICT_NEW] = "new",
                                        [KOKSMA_VERDICT_WAITING] = "waiting",
                                        [KOKSMA_VERDICT_AGREES] = "agrees",
                                        [KOKSMA_VERDICT_FITTED] = "fitted",
                                        [KOKSMA_VERDICT_EXPLAINED] = "explained",
                                        [KOKSMA_VERDICT_UNEXPLAINED] = "unexplained",
                                        [KOKSMA_VERDICT_UNTESTED] = "untested"};
    return (unsigned)verdict < sizeof names / sizeof *names ? names[verdict] : NULL;
}

koksma_status koksma_study_table_row(koksma_study *study, const char *id, size_t i, koksma_study_row *row,
                                     bool *found)
{
    KOKSMA__REQUIRE(study, id, row, found);
    const koksma__table *t = NULL;
    *found = false;
    for (size_t k = 0; !t && k < study->plan.n_tables; k++) {
        t = strcmp(study->plan.tables[k].id, id) ? NULL : &study->plan.tables[k];
    }
    KOKSMA__FAIL_IF(!t, KOKSMA_UNKNOWN, "plan '%s' has no table '%s'", study->plan.name, id);
    if (i / t->n.n >= t->n_rows) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(!study->store, KOKSMA_ARGUMENT, "a study without a folder has no results");
    koksma__report r = {.study = study};
    const koksma__table_row *from = &t->rows[i / t->n.n];
    const size_t column = i % t->n.n;
    const koksma__cell cell = koksma__table_cell(&r, t, from->pattern, column);
    *row = (koksma_study_row){.pattern = from->pattern,
                              .label = from->label,
                              .n = t->n.at[column],
                              .mean = cell.mean.mean,
                              .low = cell.mean.low,
                              .high = cell.mean.high,
                              .sd = cell.sd,
                              .max = cell.max,
                              .trials = cell.mean.n,
                              .converged = NAN,
                              .verdict = koksma__table_judge(t, from, column, &cell).kind};
    for (size_t s = 0; s < 3; s++) {
        row->published[s] = !koksma__table_is_over_n(t) ? from->published[s].value
                            : s                         ? (double)NAN
                                                        : from->published[column].value;
    }
    if (t->scene) {
        const koksma__image_block *block = &study->plan.images[t->images];
        row->converged =
            koksma__image_cell(&r, t, &block->references[block->n_references - 1], from->pattern).mean.mean;
    }
    *found = !r.status;
    return r.status;
}
