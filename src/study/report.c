/* SPDX-License-Identifier: Apache-2.0 */
/* The report of a study: one HTML file. What it says follows from the plan and the store alone, so that the same rows
   give the same file, whenever and however often the run was interrupted. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/status.h"
#include "study/answers.h"
#include "study/report.h"
#include "study/report_head.h"
#include "study/report_tables.h"

static koksma_status add_tables(koksma_study *study, koksma__html *h, bool images, koksma__tally *tally)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < study->plan.n_tables; i++) {
        const koksma__table *t = &study->plan.tables[i];
        if (images == (t->scene != NULL)) {
            status = (images ? koksma__report_image_table : koksma__report_discrepancy_table)(study, h, tally, t);
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
            "the published mean from ours over SD &#8730;(1/100 + 1/T) and half of the last printed digit, with the "
            "SD and the number T of our sets: the errors of both means and the rounding. Below %.1f it is taken for "
            "chance, one by one; below each table stand its z taken together: of k independent z by chance the "
            "largest "
            "exceeds 2 with probability 1 - 0.954^k (25 %% for six), and six of -0.8 are as rare as one of -2. The "
            "largest of 100 is a mean over blocks of 100 sets, with the SD of such a block behind the "
            "&#177;, where others are 95 %% intervals of means; of fewer sets it is the largest of all.</p>\n",
            KOKSMA__AGREEMENT_Z);
    if (!status) {
        status = add_tables(study, h, false, &tally);
    }
    if (tally.cells) {
        koksma__html_add(
            h,
            "<p>Of %zu published means %zu agree, %zu differ for a reason that is known (notes), %zu differ.</p>\n",
            tally.cells, tally.agree, tally.explained, tally.cells - tally.agree - tally.explained);
    }
    if (tally.waiting) {
        koksma__html_add(h, "<p>The rows of %zu published means have no trials yet.</p>\n", tally.waiting);
    }
    status = status ? status : koksma__report_questions(study, h);
    status = status ? status : koksma__report_pictures(study, h, run);
    status = status ? status : koksma__report_figures(study, h, run);
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
