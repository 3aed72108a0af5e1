/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads and checks the published tables of a plan. A table has one number of points, and each row a printed mean,
 * SD and maximum; or it has several numbers of points, and each row a printed mean for each. Printed numbers may be
 * JSON strings, which keep trailing zeros: the number of digits tells how precise the number is (rounding changed it
 * by at most half a unit of the last digit).
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/status.h"
#include "study/plan/plan.h"
#include "study/plan/plan_read.h"
#include "study/plan/variants.h"

/* ---- Printed numbers ------------------------------------------------------------------------------------- */

static koksma_status parse_printed(const koksma__json_node *node, koksma__printed *out)
{
    const char *text;
    char number[sizeof out->text];
    if (koksma__json_is_text(node)) {
        koksma_status status = koksma__json_text(node, &text);
        char *end = NULL;
        out->value = status ? (double)NAN : koksma__strtod(text, &end);
        KOKSMA__JSON_FAIL_IF(
            !status && (end == text || *end || strspn(text, "0123456789.") != strlen(text) || !isfinite(out->value)),
            node, "'%s': it takes a number as printed, such as 0.0370", text);
        KOKSMA__JSON_FAIL_IF(!status && strlen(text) >= sizeof out->text, node,
                             "a printed number has at most %zu characters", sizeof out->text - 1);
        KOKSMA__TRY(status);
    } else {
        KOKSMA__TRY(koksma__json_number(node, 0, 1e6, &out->value));
        koksma__snprintf(number, sizeof number, "%.9g", out->value);
        text = number;
    }
    const char *point = strchr(text, '.'), *exponent = strchr(text, 'e'); /* a small JSON number has an exponent */
    const double places = (point ? (double)strcspn(point + 1, "e") : 0) - (exponent ? atoi(exponent + 1) : 0);
    strcpy(out->text, text);
    out->half_digit = 0.5 * koksma__pow(10, -places);
    return KOKSMA_OK;
}

/* Reads the printed numbers of a row: mean, SD and maximum, or the means of a table over several n. Numbers at
   the end may be missing. */
static koksma_status parse_published(const koksma__json_node *node, koksma__table_row *row)
{
    koksma__json_node list;
    size_t length;
    for (size_t i = 0; i < KOKSMA__TABLE_PRINTED; i++) {
        row->published[i] = (koksma__printed){.value = NAN};
    }
    KOKSMA__TRY(koksma__json_member(node, "published", &list));
    KOKSMA__TRY(koksma__json_length(&list, KOKSMA__TABLE_PRINTED, &length));
    for (size_t i = 0; i < length; i++) {
        const koksma__json_node item = koksma__json_item(&list, i);
        KOKSMA__TRY(parse_printed(&item, &row->published[i]));
    }
    row->n_published = length;
    return KOKSMA_OK;
}

/* ---- Tables ---------------------------------------------------------------------------------------------- */

/* The patterns of a table of a scene are those of images, and those of a table of a measure are of sets of points. */
static koksma_status parse_pattern(const koksma__json_node *node, const koksma__plan_trials *trials, bool needed,
                                   char **out)
{
    return koksma__plan_spec(node, "pattern", trials->of_images ? koksma__image_pattern_text : koksma__pattern_text,
                             needed, trials->stored, out);
}

static koksma_status parse_row(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "pattern", "label", "published", "rate", "of-random", NULL};
    koksma__table_row *r = item;
    r->rate = r->of_random = NAN;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : parse_pattern(node, trials, true, &r->pattern);
    status = status ? status : koksma__plan_text(node, "label", true, &r->label);
    status = status ? status : koksma__json_get_number(node, "rate", false, -10, 0, &r->rate);
    status = status ? status : koksma__json_get_number(node, "of-random", false, 0, 100, &r->of_random);
    return status ? status : parse_published(node, r);
}

static koksma_status parse_note(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "pattern",   "n",        "statistic",
                                       "reason",  "explained", "untested", NULL};
    static const char *const statistics[] = {"mean", "sd", "max"};
    const char *statistic;
    koksma__note *n = item;
    n->explained = true;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : parse_pattern(node, trials, false, &n->pattern);
    status = status ? status : koksma__json_get_whole(node, "n", false, 1, (int)KOKSMA_MAX_COORDINATES, &n->n);
    status = status ? status : koksma__plan_text(node, "reason", true, &n->reason);
    status = status ? status : koksma__json_get_flag(node, "explained", false, &n->explained);
    status = status ? status : koksma__json_get_flag(node, "untested", false, &n->untested);
    status = status ? status : koksma__json_get_text(node, "statistic", true, &statistic);
    for (n->statistic = 0; !status && strcmp(statistics[n->statistic], statistic) != 0;) {
        KOKSMA__JSON_FAIL_IF(++n->statistic == 3, node, "statistic '%s': it takes mean, sd or max", statistic);
    }
    return status;
}

/* Reads "n": one number, or a list of several. */
static koksma_status parse_sizes(const koksma__json_node *node, koksma__table *t)
{
    koksma__json_node n;
    koksma_status status = koksma__json_member(node, "n", &n);
    if (!status && koksma__json_is_array(&n)) {
        status = koksma__plan_wholes(node, "n", 1, (long long)KOKSMA_MAX_COORDINATES, &t->n);
        return !status && t->n.n > KOKSMA__TABLE_PRINTED
                   ? koksma__json_fail(&n, "a table has at most %d numbers of points", KOKSMA__TABLE_PRINTED)
                   : status;
    }
    t->n.at = calloc(1, sizeof *t->n.at);
    t->n.n = t->n.at ? 1 : 0;
    status = !status && !t->n.at ? koksma__fail_memory(sizeof *t->n.at) : status;
    return status ? status
                  : koksma__json_get_whole(node, "n", true, 1, (long long)KOKSMA_MAX_COORDINATES, &t->n.at[0]);
}

static koksma_status check_shape(const koksma__json_node *node, const koksma__table *t)
{
    const bool over_n = koksma__table_is_over_n(t);
    KOKSMA__JSON_FAIL_IF(!t->scene == !t->measure, node, "a table has either a scene or a measure");
    KOKSMA__JSON_FAIL_IF(t->scene && over_n, node, "a table of a scene has one number of samples");
    KOKSMA__JSON_FAIL_IF(t->measure && t->fitted, node,
                         "'fitted' needs a scene, because a measure has nothing to fit");
    for (size_t i = 0; i + 1 < t->n.n; i++) {
        KOKSMA__JSON_FAIL_IF(t->n.at[i] >= t->n.at[i + 1], node,
                             "a table's numbers of points must ascend, but %lld comes before %lld", t->n.at[i],
                             t->n.at[i + 1]);
    }
    for (size_t r = 0; r < t->n_rows; r++) {
        KOKSMA__JSON_FAIL_IF(t->rows[r].n_published > (over_n ? t->n.n : 3), node,
                             "the row of %s has more printed numbers than the table has columns", t->rows[r].pattern);
    }
    return KOKSMA_OK;
}

koksma_status koksma__plan_table(const koksma__json_node *node, const koksma__plan_trials *trials, void *item)
{
    static const char *const keys[] = {"comment", "id",     "title", "scene", "measure", "also", "n",
                                       "dim",     "fitted", "rows",  "notes", "symbol",  NULL};
    koksma__table *t = item;
    koksma_status status = koksma__json_only(node, keys);
    status = status ? status : koksma__plan_id(node, true, &t->id);
    status = status ? status : koksma__plan_text(node, "title", true, &t->title);
    status = status ? status : koksma__plan_text(node, "symbol", false, &t->symbol);
    status = status ? status : koksma__plan_text(node, "scene", false, &t->scene);
    status = status ? status : koksma__plan_spec(node, "measure", koksma__measure_text, false, false, &t->measure);
    status = status ? status : koksma__plan_spec(node, "also", koksma__measure_text, false, false, &t->also);
    status = status ? status : koksma__json_get_flag(node, "fitted", false, &t->fitted);
    status = status ? status : parse_sizes(node, t);
    t->dim = 2;
    status = status ? status : koksma__json_get_whole(node, "dim", false, 1, KOKSMA_MAX_DIM, &t->dim);
    koksma__plan_trials of_rows = *trials;
    of_rows.of_images = t->scene;
    status = status ? status
                    : koksma__plan_list(node, "rows", true, sizeof *t->rows, parse_row, &of_rows, (void **)&t->rows,
                                        &t->n_rows);
    status = status ? status
                    : koksma__plan_list(node, "notes", false, sizeof *t->notes, parse_note, &of_rows,
                                        (void **)&t->notes, &t->n_notes);
    return status ? status : check_shape(node, t);
}

/* ---- Whether the plan's blocks make the rows ------------------------------------------------------------- */

static bool makes_image(const koksma__image_block *i, const koksma__table *t, const char *pattern)
{
    return koksma__texts_have(&i->variants, "") && koksma__texts_have(&i->scenes, t->scene) &&
           koksma__texts_have(&i->patterns, pattern) && koksma__wholes_have(&i->spp, t->n.at[0]);
}

/* Finds the first image block that makes all rows of a table, so that all rows are compared with the same references
   at one size. Returns the number of rows or, if there is no such block, the first row that is missing from the block that
   makes the most rows before it. */
static size_t find_images(const koksma__plan *plan, koksma__table *t)
{
    size_t row = 0;
    for (size_t b = 0; b < plan->n_images && row < t->n_rows; b++) {
        size_t r = 0;
        while (r < t->n_rows && makes_image(&plan->images[b], t, t->rows[r].pattern)) {
            r++;
        }
        t->images = r == t->n_rows ? b : t->images;
        row = r > row ? r : row;
    }
    return row;
}

/* Whether discrepancy blocks evaluate the measure for a row's pattern at every n of the table. */
static bool is_made(const koksma__plan *plan, const koksma__table *t, const char *measure, const char *pattern)
{
    bool made = true;
    for (size_t i = 0; i < t->n.n && made; i++) {
        made = false;
        for (size_t b = 0; b < plan->n_discrepancies && !made; b++) {
            made = koksma__plan_block_makes(&plan->discrepancies[b], measure, pattern, t->n.at[i], t->dim);
        }
    }
    return made;
}

/* The first row that no blocks make, or the number of rows. */
static size_t find_discrepancies(const koksma__plan *plan, const koksma__table *t)
{
    size_t row = 0;
    while (row < t->n_rows && is_made(plan, t, t->measure, t->rows[row].pattern) &&
           (!t->also || is_made(plan, t, t->also, t->rows[row].pattern))) {
        row++;
    }
    return row;
}

koksma_status koksma__plan_check_tables(const koksma__json_node *root, const koksma__plan *plan)
{
    koksma__json_node tables;
    KOKSMA__TRY(plan->n_tables ? koksma__json_member(root, "tables", &tables) : KOKSMA_OK);
    for (size_t i = 0; i < plan->n_tables; i++) {
        koksma__table *t = &plan->tables[i];
        const koksma__json_node table = koksma__json_item(&tables, i);
        const size_t row = t->scene ? find_images(plan, t) : find_discrepancies(plan, t);
        KOKSMA__JSON_FAIL_IF(row < t->n_rows && row && t->scene, &table,
                             "no single block of the plan makes the row of %s together with the rows before it",
                             t->rows[row].pattern);
        KOKSMA__JSON_FAIL_IF(row < t->n_rows, &table, "no block of the plan makes the row of %s",
                             t->rows[row].pattern);
    }
    return KOKSMA_OK;
}
