/* SPDX-License-Identifier: Apache-2.0 */
/* Time limits of long measures. */
#ifndef KOKSMA_MEASURES_SHARED_DEADLINE_H
#define KOKSMA_MEASURES_SHARED_DEADLINE_H

#include <math.h>

#include <koksma/koksma.h>

#include "core/clock.h"

/* The moment at which `share` of run's time limit will have passed; infinite without a limit. */
static inline double koksma__deadline_s(const koksma_run *run, double share)
{
    return run && run->time_limit_s > 0 ? koksma__now_s() + share * run->time_limit_s : (double)INFINITY;
}

#endif
