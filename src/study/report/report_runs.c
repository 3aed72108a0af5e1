/* SPDX-License-Identifier: Apache-2.0 */
#include "study/report/report.h"

static double percent(double part, double of)
{
    return of > 0 ? 100 * part / of : 0;
}

koksma_status koksma__report_runs(koksma_study *study, koksma__html *h)
{
    bool found = true;
    koksma__run_record run;
    koksma_status status = KOKSMA_OK;
    koksma__html_add(h, "<ul id=\"runs\">");
    for (long long i = 0; !status && found; i++) {
        status = koksma__store_run(study->store, i, &run, &found);
        if (!status && found) {
            koksma__html_add(h, "<li>");
            koksma__html_text(h, run.started);
            koksma__html_add(h, ": %lld jobs in %.1f s with %lld workers on ", run.jobs, run.seconds, run.workers);
            koksma__html_text(h, run.machine);
            koksma__html_add(h, ", koksma ");
            koksma__html_text(h, run.version);
            koksma__html_add(h, "; idle %.1f %% of the time, in the database %.1f %% of the processor time</li>",
                             percent(run.idle_seconds, (double)run.workers * run.seconds),
                             percent(run.store_seconds, run.processor_seconds));
        }
    }
    koksma__html_add(h, "</ul>\n");
    return status;
}
