/* SPDX-License-Identifier: Apache-2.0 */
/* Reads POSIX's monotonic clock, or the clock that a test has set. */
#include "core/clock.h"

#include <stdatomic.h>
#include <time.h>

typedef double (*clock_function)(void);

static _Atomic(clock_function) override;

double koksma__now_s(void)
{
    const clock_function other = atomic_load_explicit(&override, memory_order_relaxed);
    if (other) {
        return other();
    }
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void koksma__set_clock(double (*clock)(void))
{
    atomic_store(&override, clock);
}
