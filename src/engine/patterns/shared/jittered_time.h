/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_JITTERED_TIME_H
#define KOKSMA_PATTERNS_SHARED_JITTERED_TIME_H

#include <koksma/koksma.h>

/* Fills `out` with 3D points in order of the cells: x and y are jittered in a grid of params[0] columns (0: as many as
   rows), t is uniform. */
koksma_status koksma__fill_jittered_time(const char *name, uint64_t seed, const koksma_args *args,
                                         koksma_points *out);

#endif
