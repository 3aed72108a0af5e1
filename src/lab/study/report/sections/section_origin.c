/* SPDX-License-Identifier: Apache-2.0 */
/* The section on the origin of the report: the program, the plan, and every run with its time and machine. The list
   of runs is one line of the report's text, so that reports of equal rows differ in that line only. */
#include "study/report/report.h"

static bool is_shown(const koksma__report_scope *scope)
{
    (void)scope;
    return true;
}

static double percent(double part, double of)
{
    return of > 0 ? 100 * part / of : 0;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    bool found = true;
    koksma__run_record run;
    koksma_status status = KOKSMA_OK;
    koksma__doc_paragraph(
        d,
        "koksma %s, plan `%s`. The rows are in `results.sqlite` beside this file, and the numbers of "
        "this page in `report.json`. The key of a row is enough to make the row again. Results do "
        "not depend on the number of threads or on interruptions: `koksma study audit` makes rows again and "
        "compares them. The SHA-256 of all rows, as `koksma study export` writes them, is `%s`. The runs "
        "(one that was killed leaves its rows in the store, but no line here):",
        koksma_version(), scope->study->plan.name, scope->rows);
    koksma__doc_list_begin(d, "runs", false);
    for (long long i = 0; !status && found; i++) {
        status = koksma__store_run(scope->study->store, i, &run, &found);
        if (!status && found) {
            koksma__doc_item(d);
            koksma__doc_say(
                d,
                "%s: %lld jobs in %.1f s with %lld workers on %s, koksma %s; idle %.1f %% of the time, in "
                "the database %.1f %% of the processor time",
                run.started, run.jobs, run.seconds, run.workers, run.machine, run.version,
                percent(run.idle_seconds, (double)run.workers * run.seconds),
                percent(run.store_seconds, run.processor_seconds));
        }
    }
    koksma__doc_list_end(d);
    return status;
}

const koksma__section koksma__section_origin = {"How it was made", false, is_shown, write};
