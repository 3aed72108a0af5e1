/* SPDX-License-Identifier: Apache-2.0 */
/* The permission to run code of others, one number of each thread. It belongs to the caller and never to data: no spec,
   plan, scene or store can hold it. core/parallel.c and the MPI server hand it to the threads that they start. */
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
