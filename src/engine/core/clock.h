/* SPDX-License-Identifier: Apache-2.0 */
/* The clock that measures time limits, and those of processor time. */
#ifndef KOKSMA_CORE_CLOCK_H
#define KOKSMA_CORE_CLOCK_H

#include <time.h>

#include "core/visibility.h"

/* Seconds on a clock that never goes back. Any thread may call it. */
KOKSMA__LAB double koksma__now_s(void);

/* Replaces the clock, for tests that must not depend on the speed of the machine: koksma__now_s then returns the
   result of `clock`, which any thread may call. NULL restores the system's clock. */
void koksma__set_clock(double (*clock)(void));

static inline double koksma__clock_s(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Processor time used by this process and by this thread, in seconds. */
static inline double koksma__processor_s(void)
{
    return koksma__clock_s(CLOCK_PROCESS_CPUTIME_ID);
}

static inline double koksma__thread_s(void)
{
    return koksma__clock_s(CLOCK_THREAD_CPUTIME_ID);
}

#endif
