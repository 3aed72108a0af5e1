/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PATTERNS_PATTERNS_H
#define KOKSMA_PATTERNS_PATTERNS_H

#include <koksma/koksma.h>

#define PATTERN(name) extern const koksma_pattern koksma__pattern_##name;
#include "patterns/patterns.def"
#undef PATTERN

#endif
