/* SPDX-License-Identifier: Apache-2.0 */
/* Deadlines for measures that run for a share of the time limit. */
#ifndef KOKSMA_MEASURES_SHARED_DEADLINE_H
#define KOKSMA_MEASURES_SHARED_DEADLINE_H

#include <math.h>

#include <koksma/koksma.h>

#include "core/clock.h"

/* Returns the time on the clock koksma__now_s at which the fraction `share` of run's time limit will have passed from
   now; infinite without a limit. */
static inline double koksma__deadline_s(const koksma_run *run, double share)
{
    return run && run->time_limit_s > 0 ? koksma__now_s() + share * run->time_limit_s : (double)INFINITY;
}

#endif
