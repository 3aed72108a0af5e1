/* SPDX-License-Identifier: Apache-2.0 */
/* The report of a study: one HTML file. What it says follows from the plan and the store alone, so that the same rows
   give the same file, whenever and however often the run was interrupted. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/status.h"
#include "study/report/answers.h"
#include "study/report/report.h"
#include "study/report/report_head.h"
#include "study/report/report_tables.h"

static koksma_status add_tables(koksma_study *study, koksma__html *h, size_t part, bool images,
                                koksma__agreement *agreement)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < study->plan.n_tables; i++) {
        const koksma__table *t = &study->plan.tables[i];
        if (t->part == part && images == (t->scene != NULL)) {
            status = (images                       ? koksma__report_image_table
                      : koksma__table_is_over_n(t) ? koksma__report_sizes_table
                                                   : koksma__report_discrepancy_table)(study, h, agreement, t);
        }
    }
    return status;
}

static bool has_tables(const koksma_study *study, size_t part, bool images)
{
    for (size_t i = 0; i < study->plan.n_tables; i++) {
        const koksma__table *t = &study->plan.tables[i];
        if (t->part == part && images == (t->scene != NULL)) {
            return true;
        }
    }
    return false;
}

static bool shows_something(const koksma_study *study, size_t part)
{
    const koksma__plan_part *of = &study->plan.parts[part];
    return has_tables(study, part, true) || has_tables(study, part, false) || of->figures[0] < of->figures[1];
}

/* Title and description of one plan of several. */
static void add_part_heading(const koksma_study *study, koksma__html *h, const koksma__plan_part *part)
{
    if (study->plan.n_parts > 1) {
        koksma__html_add(h, "<h2 class=\"paper\">");
        koksma__html_text(h, part->title);
        koksma__html_add(h, "</h2>\n");
        if (part->about) {
            koksma__html_add(h, "<p>");
            koksma__html_text(h, part->about);
            koksma__html_add(h, "</p>\n");
        }
    }
}

/* Everything that is of one plan: its heading where there are several, its tables and figures. */
static koksma_status add_part(koksma_study *study, koksma__html *h, size_t part, koksma__agreement *agreement,
                              const koksma_run *run)
{
    const koksma__plan_part *of = &study->plan.parts[part];
    koksma_status status = KOKSMA_OK;
    add_part_heading(study, h, of);
    if (has_tables(study, part, true)) {
        koksma__html_add(h,
                         "<h2>Errors of images</h2>\n<p>Absolute error in luminance over the pixels, one pixel wide "
                         "box filter. Intervals are 95 %% over trials. A maximum is one pixel of the picture: it is "
                         "printed and not judged.</p>\n");
        status = add_tables(study, h, part, true, agreement);
        status = status ? status : koksma__report_order(study, h, part);
    }
    if (!status && has_tables(study, part, false)) {
        koksma__html_add(
            h,
            "<h2>Irregularity of the patterns</h2>\n<p>Exact values, mean over point sets. z is the difference of "
            "the published mean from ours over SD &#8730;(1/100 + 1/T) and half of the last printed digit, with the "
            "SD and the number T of our sets: the errors of both means and the rounding. Below %.1f it is taken for "
            "chance, one by one; in tables over several numbers of points it is the tooltip of each mark. Below each "
            "table are its z taken together: of k independent z by chance the largest exceeds 2 with probability "
            "1 - 0.954^k (25 %% for six), and six of -0.8 are as rare as one of -2. The largest of 100 is a mean "
            "over "
            "blocks of 100 sets, with the SD of such a block behind the "
            "&#177;, where others are 95 %% intervals of means; of fewer sets it is the largest of all.</p>\n",
            KOKSMA__AGREEMENT_Z);
        status = add_tables(study, h, part, false, agreement);
    }
    return status ? status : koksma__report_figures(study, h, of, run);
}

/* How many printed means have each verdict; the four counts add up to those that have trials. */
static void add_agreement(koksma__html *h, const koksma__agreement *a)
{
    const size_t *of = a->of, agree = of[KOKSMA_VERDICT_AGREES], fitted = of[KOKSMA_VERDICT_FITTED],
                 explained = of[KOKSMA_VERDICT_EXPLAINED], unexplained = of[KOKSMA_VERDICT_UNEXPLAINED],
                 all = agree + fitted + explained + unexplained;
    if (all) {
        koksma__html_add(h,
                         "<p id=\"agreement\">Of %zu printed means %zu agree with ours, %zu agree within %.0f %% in "
                         "scenes that were fitted to the printed numbers, which confirms nothing, %zu differ for a "
                         "known reason (notes), and %zu are not explained.</p>\n",
                         all, agree, fitted, 100 * KOKSMA__IMAGE_TOLERANCE, explained, unexplained);
    }
    if (of[KOKSMA_VERDICT_WAITING]) {
        koksma__html_add(h, "<p>The rows of %zu printed means have too few trials yet.</p>\n",
                         of[KOKSMA_VERDICT_WAITING]);
    }
}

static koksma_status add_body(koksma_study *study, koksma__html *h, const koksma_run *run)
{
    koksma__agreement agreement = {0};
    koksma_status status = KOKSMA_OK;
    koksma__html_add(h, "%s<title>", koksma__report_head);
    koksma__html_text(h, study->plan.title);
    koksma__html_add(h, "</title>\n</head>\n<body>\n<main>\n<h1>");
    koksma__html_text(h, study->plan.title);
    koksma__html_add(h, "</h1>\n");
    if (study->plan.n_parts == 1) {
        koksma__html_add(h, "<p>");
        koksma__html_text(h, study->plan.about ? study->plan.about : "");
        koksma__html_add(h, "</p>\n");
    }
    for (size_t part = 0; !status && part < study->plan.n_parts; part++) {
        status = shows_something(study, part) ? add_part(study, h, part, &agreement, run) : KOKSMA_OK;
    }
    add_agreement(h, &agreement);
    for (size_t part = 0; part < study->plan.n_parts; part++) { /* plans of questions alone, whose answers follow */
        if (!shows_something(study, part)) {
            add_part_heading(study, h, &study->plan.parts[part]);
        }
    }
    status = status ? status : koksma__report_questions(study, h);
    status = status ? status : koksma__report_pictures(study, h, run);
    koksma__html_add(h, "<h2>How it was made</h2>\n<p>koksma %s, plan <code>", koksma_version());
    koksma__html_text(h, study->plan.name);
    koksma__html_add(
        h, "</code>. The rows are in <code>results.sqlite</code> beside this file; every one can be made again "
           "from its key. Results do not depend on the number of threads or on interruptions. A run that was "
           "killed left its rows there, and no line below.</p>\n");
    status = status ? status : koksma__report_runs(study, h);
    koksma__html_add(h, "</main>\n</body>\n</html>\n");
    return status;
}

koksma_status koksma_study_report(koksma_study *study, const koksma_run *run)
{
    char path[1100];
    koksma__html html = {0};
    koksma__atomic_file file;
    if (!study->store) {
        return koksma__fail(KOKSMA_ARGUMENT, "a study without a folder has no report");
    }
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
