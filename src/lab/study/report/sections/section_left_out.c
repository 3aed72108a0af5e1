/* SPDX-License-Identifier: Apache-2.0 */
/* Lists combinations without results or with failed trials: the sizes that blocks with `skip` leave out, and the
   jobs that failed when they ran. Each line has the pattern, the numbers of points or samples, and the reason. */
#include <koksma/study.h>

#include "study/report/means.h"
#include "study/report/report.h"

static bool is_shown(const koksma__report_scope *scope)
{
    return koksma_study_left_out_at(scope->study, 0) != NULL;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    const char *line;
    koksma_status status = KOKSMA_OK;
    koksma__doc_paragraph(d, "These combinations have no results; where trials are counted, only those have none:");
    koksma__doc_list_begin(d, NULL, false);
    for (size_t i = 0; !status && (line = koksma_study_left_out_at(scope->study, i)); i++) {
        koksma__doc_item(d);
        koksma__doc_say(d, "%s", line);
        status = koksma__report_goes_on(scope->study);
    }
    koksma__doc_list_end(d);
    return status;
}

const koksma__section koksma__section_left_out = {"Left out", false, is_shown, write};
