/* SPDX-License-Identifier: Apache-2.0 */
/* The report of a study: one HTML file. What it says follows from the plan and the store alone, so that the same rows
   give the same file, whenever and however often the run was interrupted. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/c_locale.h"
#include "core/status.h"
#include "study/answers.h"
#include "study/report.h"
#include "study/report_head.h"
#include "study/tables.h"

/* How far an image table's mean may be from the published one: the scenes are stand-ins. */
static const double IMAGE_TOLERANCE = 0.25;

/* Published means are of 100 sets; |z| below this is chance. */
static const double AGREEMENT_Z = 2.6;

/* ---- Marks ------------------------------------------------------------------------------------------------- */

/* The number of the note on a cell, from 1, or 0. */
static size_t note_of(const koksma__table *t, const char *pattern, int statistic)
{
    for (size_t i = 0; i < t->n_notes; i++) {
        const koksma__note *n = &t->notes[i];
        if (n->statistic == statistic && (!n->pattern || !strcmp(n->pattern, pattern))) {
            return i + 1;
        }
    }
    return 0;
}

/* The label and what is published. */
static void begin_row(koksma__html *h, const koksma__table *t, const koksma__table_row *row)
{
    koksma__html_add(h, "<tr><td>");
    koksma__html_text(h, row->label);
    koksma__html_add(h, "</td>");
    for (int s = 0; s < 3; s++) {
        const size_t note = note_of(t, row->pattern, s);
        const double value = row->published[s];
        if (isnan(value)) {
            koksma__html_add(h, "<td>&#8211;</td>");
            continue;
        }
        int decimals = 4; /* all that are printed, at least four */
        while (decimals < 7 && fabs(value * pow(10, decimals) - round(value * pow(10, decimals))) > 1e-6) {
            decimals++;
        }
        koksma__html_add(h, "<td>%.*f", decimals, value);
        if (note) {
            koksma__html_add(h, "<sup class=\"note\">%zu</sup>", note);
        }
        koksma__html_add(h, "</td>");
    }
}

static void add_mark(koksma__html *h, koksma__tally *tally, bool good, const char *good_text, const char *bad_text)
{
    tally->cells++;
    tally->agree += good;
    koksma__html_add(h, "<td class=\"%s\">%s %s</td>", good ? "good" : "bad", good ? "&#10003;" : "&#10007;",
                     good ? good_text : bad_text);
}

static void add_notes(koksma__html *h, const koksma__table *t)
{
    if (t->n_notes) {
        koksma__html_add(h, "<ol class=\"notes note\">\n");
        for (size_t i = 0; i < t->n_notes; i++) {
            koksma__html_add(h, "<li>");
            koksma__html_text(h, t->notes[i].reason);
            koksma__html_add(h, "</li>\n");
        }
        koksma__html_add(h, "</ol>\n");
    }
}

static void begin_table(koksma__html *h, const koksma__table *t)
{
    koksma__html_add(h, "<h3");
    koksma__html_id(h, "table", t->id);
    koksma__html_add(h, ">Table %s: ", t->id);
    koksma__html_text(h, t->title);
    koksma__html_add(h, "</h3>\n<div class=\"scroll\"><table>\n<thead>");
}

/* ---- Discrepancy tables ------------------------------------------------------------------------------------ */

static koksma_status add_discrepancy_row(koksma_study *study, koksma__html *h, koksma__tally *tally,
                                         const koksma__table *t, const koksma__table_row *row)
{
    koksma__cell cell, also = {0};
    koksma_status status = koksma__table_discrepancy(study, t, t->measure, row->pattern, &cell);
    if (!status && t->also) {
        status = koksma__table_discrepancy(study, t, t->also, row->pattern, &also);
    }
    if (status) {
        return status;
    }
    begin_row(h, t, row);
    koksma__html_add(h, "<td>%.4g <span class=\"pm\">&#177; %.2g</span></td><td>%.3g</td><td>%.3g", cell.mean.mean,
                     cell.mean.high - cell.mean.mean, cell.sd, cell.max);
    if (!isnan(cell.max_sd)) {
        koksma__html_add(h, " <span class=\"pm\">&#177; %.3f</span>", cell.max_sd);
    }
    koksma__html_add(h, "</td>");
    /* The published mean is of 100 sets, rounded to three digits. */
    const double n = (double)cell.mean.n, half_digit = 0.5 * pow(10, floor(log10(row->published[0])) - 2);
    const double error = sqrt(cell.sd * cell.sd * (0.01 + 1 / n)) + half_digit;
    const double z = (row->published[0] - cell.mean.mean) / error;
    char text[48];
    koksma__snprintf(text, sizeof text, "z = %+.1f", z);
    if (isnan(z)) {
        koksma__html_add(h, "<td>new</td>");
    } else if (note_of(t, row->pattern, 0) && fabs(z) >= AGREEMENT_Z) {
        tally->cells++;
        tally->explained++;
        koksma__html_add(h, "<td class=\"note\">note %zu</td>", note_of(t, row->pattern, 0));
    } else {
        add_mark(h, tally, fabs(z) < AGREEMENT_Z, text, text);
    }
    if (t->also) {
        koksma__html_add(h, "<td>%.4g <span class=\"pm\">&#177; %.2g</span></td>", also.mean.mean,
                         also.mean.high - also.mean.mean);
    }
    koksma__html_add(h, "</tr>\n");
    return KOKSMA_OK;
}

static koksma_status add_discrepancy_table(koksma_study *study, koksma__html *h, koksma__tally *tally,
                                           const koksma__table *t)
{
    size_t sets;
    koksma_status status = koksma__table_sets(study, t, &sets);
    if (status) {
        return status;
    }
    begin_table(h, t);
    koksma__html_add(h,
                     "<tr><th></th><th colspan=\"3\">published (100 sets)</th><th colspan=\"3\">%s, %zu sets</th>"
                     "<th></th>%s</tr>\n",
                     t->measure, sets, t->also ? "<th>exact</th>" : "");
    koksma__html_add(
        h, "<tr><th>pattern</th><th>ave</th><th>SD</th><th>max</th><th>mean <span class=\"pm\">95 %%</span></th>"
           "<th>SD</th><th>largest of 100</th><th>mean agrees</th>");
    if (t->also) {
        koksma__html_add(h, "<th>%s</th>", t->also);
    }
    koksma__html_add(h, "</tr></thead>\n<tbody>\n");
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        status = add_discrepancy_row(study, h, tally, t, &t->rows[r]);
    }
    koksma__html_add(h, "</tbody></table></div>\n");
    add_notes(h, t);
    return status;
}

/* ---- Image tables ------------------------------------------------------------------------------------------ */

static void add_image_cell(koksma__html *h, const koksma__cell *cell)
{
    koksma__html_add(h, "<td>%.5f <span class=\"pm\">&#177; %.5f</span></td><td>%.4f</td><td>%.3f</td>",
                     cell->mean.mean, cell->mean.high - cell->mean.mean, cell->sd, cell->max);
}

static koksma_status add_image_row(koksma_study *study, koksma__html *h, koksma__tally *tally, const koksma__table *t,
                                   const koksma__table_row *row, double *change)
{
    const koksma__image_block *block = koksma__table_images(study, t);
    koksma__cell cell, last = {0};
    koksma_status status = koksma__table_image(study, t, &block->references[0], row->pattern, &cell);
    if (!status) {
        status = koksma__table_image(study, t, &block->references[block->n_references - 1], row->pattern, &last);
    }
    if (status) {
        return status;
    }
    begin_row(h, t, row);
    add_image_cell(h, &cell);
    const double ratio = cell.mean.mean / row->published[0];
    char text[48];
    koksma__snprintf(text, sizeof text, "%+.0f %%", 100 * (ratio - 1));
    add_mark(h, tally, fabs(ratio - 1) <= IMAGE_TOLERANCE, text, text);
    add_image_cell(h, &last);
    koksma__html_add(h, "</tr>\n");
    *change = last.mean.mean / cell.mean.mean - 1;
    return KOKSMA_OK;
}

/* The order of the rows by a mean, as indices: insertion sort, ties by place. */
static koksma_status order_rows(koksma_study *study, const koksma__table *t, const koksma__reference *reference,
                                size_t *order)
{
    double means[256];
    for (size_t r = 0; r < t->n_rows; r++) {
        koksma__cell cell;
        const koksma_status status = koksma__table_image(study, t, reference, t->rows[r].pattern, &cell);
        if (status) {
            return status;
        }
        means[r] = cell.mean.mean;
        size_t at = r;
        for (; at > 0 && means[order[at - 1]] > means[r]; at--) {
            order[at] = order[at - 1];
        }
        order[at] = r;
    }
    return KOKSMA_OK;
}

/* Says how the choice of the reference changes the table. */
static koksma_status add_reference_remark(koksma_study *study, koksma__html *h, const koksma__table *t,
                                          const double changes[2])
{
    const koksma__image_block *block = koksma__table_images(study, t);
    const koksma__study_scene *scene = koksma__study_scene_of(study, t->scene);
    size_t first[256], last[256];
    koksma_status status = order_rows(study, t, &block->references[0], first);
    if (!status) {
        status = order_rows(study, t, &block->references[block->n_references - 1], last);
    }
    if (status || t->n_rows > 256) {
        return status;
    }
    koksma__html_add(h, "<p>Best to worst against the converged reference: ");
    for (size_t r = 0; r < t->n_rows; r++) {
        koksma__html_text(h, t->rows[last[r]].label);
        koksma__html_add(h, "%s", r + 1 < t->n_rows ? ", " : ". ");
    }
    koksma__html_add(
        h, "Taking the converged reference instead of the paper's changes the means by %+.1f to %+.1f %% and ",
        100 * changes[0], 100 * changes[1]);
    koksma__html_add(h, "%s. ",
                     memcmp(first, last, t->n_rows * sizeof *first) ? "changes the order of the patterns"
                                                                    : "leaves the order of the patterns as it is");
    char name[KOKSMA__REFERENCE_NAME];
    double error, smallest = INFINITY;
    size_t index;
    const koksma__reference *converged = &block->references[block->n_references - 1];
    status = koksma__reference_index(study, block, scene, "", block->n_references - 1, &index);
    if (status) {
        return status;
    }
    const koksma__series key = koksma__reference_key(&study->references[index], name);
    status = koksma__store_reference(study->store, &key, &error);
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        koksma__cell cell;
        status = koksma__table_image(study, t, converged, t->rows[r].pattern, &cell);
        smallest = fmin(smallest, cell.mean.mean);
    }
    koksma__html_add(
        h, "The converged reference's own mean error is %.2g: %.2g of the smallest error in the table.</p>\n", error,
        error / smallest);
    return status;
}

static koksma_status add_image_table(koksma_study *study, koksma__html *h, koksma__tally *tally,
                                     const koksma__table *t)
{
    const koksma__image_block *block = koksma__table_images(study, t);
    const koksma__reference *first = &block->references[0], *last = &block->references[block->n_references - 1];
    double changes[2] = {INFINITY, -INFINITY};
    koksma_status status = KOKSMA_OK;
    begin_table(h, t);
    koksma__html_add(
        h,
        "<tr><th></th><th colspan=\"3\">published</th><th colspan=\"4\">against %lld %s samples (%s), %lld "
        "trials</th><th colspan=\"3\">against %lld &#215; %lld %s samples (%s)</th></tr>\n",
        first->spp * first->replicates, first->pattern, first->name, block->trials, last->replicates, last->spp,
        last->pattern, last->name);
    koksma__html_add(h,
                     "<tr><th>pattern</th><th>ave</th><th>SD</th><th>max</th>"
                     "<th>mean <span class=\"pm\">95 %%</span></th><th>SD</th><th>max</th><th>mean within 25 %%</th>"
                     "<th>mean <span class=\"pm\">95 %%</span></th><th>SD</th><th>max</th></tr></thead>\n<tbody>\n");
    for (size_t r = 0; !status && r < t->n_rows; r++) {
        double change;
        status = add_image_row(study, h, tally, t, &t->rows[r], &change);
        changes[0] = fmin(changes[0], status ? (double)INFINITY : change);
        changes[1] = fmax(changes[1], status ? (double)-INFINITY : change);
    }
    koksma__html_add(h, "</tbody></table></div>\n");
    add_notes(h, t);
    return status ? status : add_reference_remark(study, h, t, changes);
}

/* ---- The whole --------------------------------------------------------------------------------------------- */

static koksma_status add_tables(koksma_study *study, koksma__html *h, bool images, koksma__tally *tally)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < study->plan.n_tables; i++) {
        const koksma__table *t = &study->plan.tables[i];
        if (images == (t->scene != NULL)) {
            status = (images ? add_image_table : add_discrepancy_table)(study, h, tally, t);
        }
    }
    return status;
}

static bool has_tables(const koksma_study *study, bool images)
{
    for (size_t i = 0; i < study->plan.n_tables; i++) {
        if (images == (study->plan.tables[i].scene != NULL)) {
            return true;
        }
    }
    return false;
}

static koksma_status add_body(koksma_study *study, koksma__html *h, const koksma_run *run)
{
    koksma__tally tally = {0};
    koksma__html_add(h, "%s<title>", koksma__report_head);
    koksma__html_text(h, study->plan.title);
    koksma__html_add(h, "</title>\n</head>\n<body>\n<main>\n<h1>");
    koksma__html_text(h, study->plan.title);
    koksma__html_add(h, "</h1>\n<p>");
    koksma__html_text(h, study->plan.about ? study->plan.about : "");
    koksma__html_add(h, "</p>\n");
    if (has_tables(study, true)) {
        koksma__html_add(h,
                         "<h2>Errors of images</h2>\n<p>Absolute error in luminance over the pixels, one pixel wide "
                         "box filter. Intervals are 95 %% over trials. A maximum is one pixel of the picture: it is "
                         "printed and not judged.</p>\n");
    }
    koksma_status status = add_tables(study, h, true, &tally);
    if (has_tables(study, false))
        koksma__html_add(
            h,
            "<h2>Irregularity of the patterns</h2>\n<p>Exact values, mean over point sets. z is the difference of "
            "the published mean from ours in standard errors of a mean of 100 sets; below "
            "%.1f it is taken for chance. The largest of 100 is a mean over blocks of 100 sets.</p>\n",
            AGREEMENT_Z);
    if (!status) {
        status = add_tables(study, h, false, &tally);
    }
    if (tally.cells) {
        koksma__html_add(
            h,
            "<p>Of %zu published means %zu agree, %zu differ for a reason that is known (notes), %zu differ.</p>\n",
            tally.cells, tally.agree, tally.explained, tally.cells - tally.agree - tally.explained);
    }
    status = status ? status : koksma__report_questions(study, h);
    status = status ? status : koksma__report_pictures(study, h, run);
    status = status ? status : koksma__report_figures(study, h, run);
    koksma__html_add(h, "<h2>How it was made</h2>\n<p>koksma %s, plan <code>", koksma_version());
    koksma__html_text(h, study->plan.name);
    koksma__html_add(
        h, "</code>. The rows are in <code>results.sqlite</code> beside this file; every one can be made again "
           "from its key. Results do not depend on the number of threads or on interruptions.</p>\n");
    status = status ? status : koksma__report_runs(study, h);
    koksma__html_add(h, "</main>\n</body>\n</html>\n");
    return status;
}

koksma_status koksma_study_report(koksma_study *study, const koksma_run *run)
{
    char path[1100];
    koksma__html html = {0};
    koksma__atomic_file file;
    koksma_status status = add_body(study, &html, run);
    if (!status && html.failed) {
        status = koksma__fail_memory(html.room);
    }
    snprintf(path, sizeof path, "%s/report.html", study->folder);
    if (!status) {
        status = koksma__atomic_open(path, &file);
    }
    if (!status) {
        fwrite(html.text, 1, html.size, file.stream);
        status = koksma__atomic_close(&file, true);
    }
    free(html.text);
    return status;
}
