/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_PROCESSOR_CLOCK_H
#define KOKSMA_CORE_PROCESSOR_CLOCK_H

#include <time.h>

#include "core/clock.h"

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
