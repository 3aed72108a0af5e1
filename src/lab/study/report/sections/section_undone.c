/* SPDX-License-Identifier: Apache-2.0 */
/* Tells how many jobs of the plan have no rows, so that nobody takes the tables of a part of a study for those of the
   whole. */
#include "study/report/report.h"
#include "study/run/run.h"

static bool is_shown(const koksma__report_scope *scope)
{
    (void)scope;
    return true;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    size_t jobs, undone;
    KOKSMA__TRY(koksma__count_undone(scope->study, &jobs, &undone));
    if (undone) {
        koksma__doc_warning_begin(d);
        koksma__doc_say(
            d,
            "%zu of %zu jobs have no rows: a run ended before them, or made rows of files, scenes or code that "
            "have changed since. `koksma study run` does them.",
            undone, jobs);
        koksma__doc_paragraph_end(d);
    }
    return KOKSMA_OK;
}

const koksma__section koksma__section_undone = {"Not done", false, is_shown, write};
