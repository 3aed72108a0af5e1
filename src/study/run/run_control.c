/* SPDX-License-Identifier: Apache-2.0 */
#include "study/run/run_control.h"

#include "core/parallel.h"
#include "core/processor_clock.h"

/* The caller first: after a long job both may say stop, and an interruption counts more than the time. */
static bool look(koksma__watch *w)
{
    if (!atomic_load(&w->interrupted) && !koksma__keep_going(w->caller_run, w->fraction)) {
        atomic_store(&w->interrupted, true);
        atomic_store(&w->stop, true);
    }
    if (!atomic_load(&w->stop) && w->end_s > 0 && koksma__now_s() > w->end_s) {
        atomic_store(&w->is_up, true);
        atomic_store(&w->stop, true);
    }
    return !atomic_load(&w->stop);
}

bool koksma__watch_time_is_up(koksma__watch *w)
{
    look(w);
    return atomic_load(&w->is_up) && !atomic_load(&w->interrupted);
}

static bool keep_running(void *context, double fraction)
{
    koksma__watch *w = context;
    w->fraction = fraction;
    return look(w);
}

static bool keep_at_job(void *context, double fraction)
{
    koksma__watch *w = context;
    (void)fraction; /* of the job */
    return pthread_equal(pthread_self(), w->caller) ? look(w) : !atomic_load(&w->stop);
}

void koksma__watch_begin(const koksma_run *run, double time_limit_s, koksma__watch *w)
{
    *w = (koksma__watch){
        .caller_run = run, .caller = pthread_self(), .end_s = time_limit_s > 0 ? koksma__now_s() + time_limit_s : 0};
    w->run = (koksma_run){.threads = koksma__threads(run), .keep_going = keep_running, .context = w};
    w->job = (koksma_run){.threads = 1, .keep_going = keep_at_job, .context = w};
}
