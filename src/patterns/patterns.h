/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_PATTERNS_H
#define KOKSMA_PATTERNS_PATTERNS_H

#include <koksma/koksma.h>

/* The function koksma_pattern.ranges of patterns that can always compute a point from its index. */
static inline bool koksma__ranges_always(const double *params)
{
    (void)params;
    return true;
}

#define PATTERN(name) extern const koksma_pattern koksma__pattern_##name;
#include "patterns/patterns.def"
#undef PATTERN

#endif
