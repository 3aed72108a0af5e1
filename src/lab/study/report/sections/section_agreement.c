/* SPDX-License-Identifier: Apache-2.0 */
/* Counts how many published means agree with ours, by the verdicts of all tables of the study (koksma__table_judge).
   It counts three groups separately: means of measures, which are tested statistically; means of image errors; and
   image errors in scenes that were fitted to the published numbers. A table over several numbers of points has one
   mean per row and column, other tables one per row. */
#include <stdio.h>
#include <string.h>

#include "study/report/published_columns.h"
#include "study/report/report.h"

static bool is_shown(const koksma__report_scope *scope)
{
    return scope->study->plan.n_tables > 0;
}

/* Counts the verdicts of a row by their kind, and adds its values of z. */
static koksma_status count_row(koksma_study *study, const koksma__table *t, const koksma__table_row *row,
                               size_t counts[KOKSMA_VERDICT_UNEXPLAINED + 1], koksma__z_sums *z)
{
    koksma_status status = KOKSMA_OK;
    for (size_t column = 0; !status && column < t->n.n; column++) {
        koksma__cell cell;
        status = t->scene ? koksma__table_image(study, t, &koksma__table_images(study, t)->references[0],
                                                row->pattern, &cell)
                          : koksma__table_discrepancy(study, t, t->measure, row->pattern, t->n.at[column], &cell);
        if (!status) {
            const koksma__verdict verdict = koksma__table_judge(t, row, column, &cell);
            counts[verdict.kind]++;
            koksma__published_add_z(z, &verdict, &cell);
        }
    }
    return status;
}

/* The groups of tables that are counted separately. */
enum { MEASURES, IMAGES, FITTED, GROUPS };

static const char *verb(size_t n)
{
    return n == 1 ? "differs" : "differ";
}

/* Writes how many published means of a group of tables agree, unless the group has no means to compare. If some differ
   for an unknown reason, a second sentence gives their number and is marked as an undecided answer. */
static void say_group(koksma__document *d, int group, const size_t counts[KOKSMA_VERDICT_UNEXPLAINED + 1])
{
    const size_t agree = counts[KOKSMA_VERDICT_AGREES] + counts[KOKSMA_VERDICT_FITTED],
                 explained = counts[KOKSMA_VERDICT_EXPLAINED], unexplained = counts[KOKSMA_VERDICT_UNEXPLAINED];
    if (!(agree + explained + unexplained)) {
        return;
    }
    koksma__doc_answer_begin(d, true);
    koksma__doc_say(d, "%zu of %zu published means ", agree, agree + explained + unexplained);
    if (group == MEASURES) {
        koksma__doc_say(d, "of measures agree, each alone: chance and rounding explain differences of |z| below %.1f",
                        KOKSMA__AGREEMENT_Z);
    } else {
        koksma__doc_say(d, "of %s agree within %.0f %%%s",
                        group == IMAGES ? "images" : "images in scenes that were fitted to them",
                        100 * KOKSMA__IMAGE_TOLERANCE,
                        group == IMAGES ? "" : ", so their agreement confirms nothing");
    }
    if (explained) {
        koksma__doc_say(d, "; %zu %s for a reason that a note below the table gives", explained, verb(explained));
    }
    koksma__doc_say(d, ".");
    koksma__doc_paragraph_end(d);
    if (unexplained) {
        koksma__doc_answer_begin(d, false);
        koksma__doc_say(d, "%zu of %zu published means of %s %s for an unknown reason: ✗ in the tables.", unexplained,
                        agree + explained + unexplained, group == MEASURES ? "measures" : "images",
                        verb(unexplained));
        koksma__doc_paragraph_end(d);
    }
}

/* The tables of measures whose values of z fail their joint tests (koksma__z_fails), and the number of those tested. */
typedef struct joint {
    size_t tables, failed;
    char ids[256];
} joint;

static void add_joint(joint *j, const koksma__table *t, const koksma__z_sums *z)
{
    const size_t used = strlen(j->ids);
    j->tables += z->count > 1;
    if (koksma__z_fails(z)) {
        snprintf(j->ids + used, sizeof j->ids - used, "%s%.40s", used ? "; " : "", t->id);
        j->failed++;
    }
}

static void say_joint(koksma__document *d, const joint *j)
{
    if (j->tables) {
        koksma__doc_verdict_begin(d, j->failed ? KOKSMA__ANSWER_FAILS : KOKSMA__ANSWER_DECIDED);
        koksma__doc_say(
            d,
            "Together, the values of z of %zu of %zu tables pass their joint tests, each at 5 %% for the sum "
            "and for the squares",
            j->tables - j->failed, j->tables);
        if (j->failed) {
            koksma__doc_say(d, "; chance alone does not explain the tables that fail: %s", j->ids);
        }
        koksma__doc_say(d, ".");
        koksma__doc_paragraph_end(d);
    }
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    size_t counts[GROUPS][KOKSMA_VERDICT_UNEXPLAINED + 1] = {{0}}, waiting = 0;
    koksma_status status = KOKSMA_OK;
    joint all = {0};
    for (size_t i = 0; i < scope->study->plan.n_tables; i++) {
        const koksma__table *t = &scope->study->plan.tables[i];
        koksma__z_sums z = {0};
        for (size_t r = 0; !status && r < t->n_rows; r++) {
            status = count_row(scope->study, t, &t->rows[r],
                               counts[!t->scene   ? MEASURES
                                      : t->fitted ? FITTED
                                                  : IMAGES],
                               &z);
        }
        add_joint(&all, t, &z);
    }
    for (int group = 0; group < GROUPS; group++) {
        say_group(d, group, counts[group]);
        waiting += counts[group][KOKSMA_VERDICT_WAITING];
        if (group == MEASURES) {
            say_joint(d, &all);
        }
    }
    if (waiting) {
        koksma__doc_paragraph(d, "%zu published mean%s too few trials yet to be compared.", waiting,
                              waiting == 1 ? " has" : "s have");
    }
    return status;
}

const koksma__section koksma__section_agreement = {"Agreement with the published means", false, is_shown, write};
