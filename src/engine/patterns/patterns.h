/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_PATTERNS_H
#define KOKSMA_PATTERNS_PATTERNS_H

#include <koksma/koksma.h>

/* The member `ranges` of patterns that can make any range of their points whatever their parameters are. */
static inline bool koksma__ranges_always(const double *params)
{
    (void)params;
    return true;
}

/* Applies all modifiers whose value is not 0, in the order of their table, to points in [0,1), which stay in [0,1). */
void koksma__modify(const double *values, uint64_t seed, koksma_points *points);

#define PATTERN(name) extern const koksma_pattern koksma__pattern_##name;
#include "patterns/patterns.def"
#undef PATTERN

#endif
