/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_JITTERED_TIME_H
#define KOKSMA_PATTERNS_SHARED_JITTERED_TIME_H

#include <koksma/koksma.h>

/* Fills 3D points: x, y jittered in the cells of params[0] columns (0: square), t uniform. In order of the cells. */
koksma_status koksma__fill_jittered_time(const char *name, uint64_t seed, const koksma_args *args,
                                         koksma_points *out);

#endif
