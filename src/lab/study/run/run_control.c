/* SPDX-License-Identifier: Apache-2.0 */
/* Deadline, interruption and progress of a run. The functions keep_running and keep_at_job are the keep_going
   callbacks of the run and of its jobs. Only the caller's thread calls the caller's keep_going and reads the clock;
   jobs on other threads read a flag that this thread sets, so that the caller's function needs no lock. */
#include "study/run/run_control.h"

#include <math.h>

#include "core/clock.h"
#include "core/parallel.h"

/* Calls the caller's keep_going before comparing the time with the limit: after a long job both may demand a stop,
   and an interruption by the caller takes precedence. The clock is read once, for the limit and for the progress. */
static bool look(koksma__run_control *control)
{
    const bool timed = control->end_s > 0 && !atomic_load(&control->stop);
    const double now_s = timed ? koksma__now_s() : control->end_s;
    const double part = control->by_time && control->end_s > 0
                            ? fmin((now_s - control->start_s) / (control->end_s - control->start_s), 1)
                            : control->fraction;
    if (!atomic_load(&control->interrupted) && !koksma__keep_going(control->caller_run, part)) {
        atomic_store(&control->interrupted, true);
        atomic_store(&control->stop, true);
    }
    if (!atomic_load(&control->stop) && timed && now_s > control->end_s) {
        atomic_store(&control->is_up, true);
        atomic_store(&control->stop, true);
    }
    return !atomic_load(&control->stop);
}

bool koksma__run_control_time_is_up(koksma__run_control *control)
{
    look(control);
    return atomic_load(&control->is_up) && !atomic_load(&control->interrupted);
}

static bool keep_running(void *context, double fraction)
{
    koksma__run_control *control = context;
    control->fraction = control->begin + control->share * fraction;
    return look(control);
}

static bool keep_at_job(void *context, double fraction)
{
    koksma__run_control *control = context;
    (void)fraction; /* the fraction done of a single job does not count as progress */
    return pthread_equal(pthread_self(), control->caller) ? look(control) : !atomic_load(&control->stop);
}

void koksma__run_control_begin(const koksma_run *run, double time_limit_s, koksma__run_control *control)
{
    const double now_s = koksma__now_s();
    *control = (koksma__run_control){.caller_run = run,
                                     .share = 1,
                                     .caller = pthread_self(),
                                     .start_s = now_s,
                                     .end_s = time_limit_s > 0 ? now_s + time_limit_s : 0};
    control->run = (koksma_run){.threads = koksma__threads(run), .keep_going = keep_running, .context = control};
    control->job = (koksma_run){.threads = 1, .keep_going = keep_at_job, .context = control};
}
