/* SPDX-License-Identifier: Apache-2.0 */
/* Counts how many published means agree with ours, by the verdicts of all tables of the study (koksma__table_judge).
   It counts three groups separately: means of measures, which are tested statistically; means of image errors; and
   image errors in scenes that were fitted to the published numbers. A table over several numbers of points has one
   mean per row and column, other tables one per row. */
#include <string.h>

#include "study/report/published_tables.h"
#include "study/report/report.h"

static bool is_shown(const koksma__report_scope *scope)
{
    return scope->study->plan.n_tables > 0;
}

/* Counts the verdicts of a row by their kind. */
static koksma_status count_row(koksma_study *study, const koksma__table *t, const koksma__table_row *row,
                               size_t counts[KOKSMA_VERDICT_UNEXPLAINED + 1])
{
    koksma_status status = KOKSMA_OK;
    for (size_t column = 0; !status && column < t->n.n; column++) {
        koksma__cell cell;
        status = t->scene ? koksma__table_image(study, t, &koksma__table_images(study, t)->references[0],
                                                row->pattern, &cell)
                          : koksma__table_discrepancy(study, t, t->measure, row->pattern, t->n.at[column], &cell);
        if (!status) {
            counts[koksma__table_judge(t, row, column, &cell).kind]++;
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
        koksma__doc_say(d, "of measures agree: chance and rounding explain their differences (|z| below %.1f)",
                        KOKSMA__AGREEMENT_Z);
    } else {
        koksma__doc_say(d, "of %s agree within %.0f %%%s",
                        group == IMAGES ? "images" : "images in scenes that were fitted to them",
                        100 * KOKSMA__IMAGE_TOLERANCE,
                        group == IMAGES ? "" : ", so their agreement confirms nothing");
    }
    if (explained) {
        koksma__doc_say(d, "; %zu %s for a known reason (notes)", explained, verb(explained));
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

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    size_t counts[GROUPS][KOKSMA_VERDICT_UNEXPLAINED + 1] = {{0}}, waiting = 0;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < scope->study->plan.n_tables; i++) {
        const koksma__table *t = &scope->study->plan.tables[i];
        for (size_t r = 0; !status && r < t->n_rows; r++) {
            status = count_row(scope->study, t, &t->rows[r],
                               counts[!t->scene   ? MEASURES
                                      : t->fitted ? FITTED
                                                  : IMAGES]);
        }
    }
    for (int group = 0; group < GROUPS; group++) {
        say_group(d, group, counts[group]);
        waiting += counts[group][KOKSMA_VERDICT_WAITING];
    }
    if (waiting) {
        koksma__doc_paragraph(d, "%zu published mean%s too few trials yet to be compared.", waiting,
                              waiting == 1 ? " has" : "s have");
    }
    return status;
}

const koksma__section koksma__section_agreement = {"Agreement with the published means", false, is_shown, write};
