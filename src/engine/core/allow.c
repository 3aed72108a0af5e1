/* SPDX-License-Identifier: Apache-2.0 */
/* The permission to run external code, stored as one number per thread. Only the caller of the library can give this
   permission; no spec, plan, scene or store can contain it. core/parallel.c and the MPI server pass it on to the
   threads that they start. */
#include "core/allow.h"

enum { MOST_SECONDS = 86400 };

static _Thread_local double allowed_s;

double koksma_allow_exec(double seconds)
{
    const double before = allowed_s;
    allowed_s = !(seconds > 0) ? 0 : seconds < MOST_SECONDS ? seconds : MOST_SECONDS;
    return before;
}

double koksma__exec_seconds(void)
{
    return allowed_s;
}
