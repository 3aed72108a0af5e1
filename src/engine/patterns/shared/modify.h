/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_SHARED_MODIFY_H
#define KOKSMA_PATTERNS_SHARED_MODIFY_H

#include <koksma/koksma.h>

/* Applies all modifiers whose value is not 0, in the order of their table, to points in [0,1), which stay in [0,1). */
void koksma__modify(const double *values, uint64_t seed, koksma_points *points);

#endif
