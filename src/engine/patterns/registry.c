/* SPDX-License-Identifier: Apache-2.0 */
/* The table of patterns (patterns.def) and the public functions that look up a pattern by its index or its name. */
#include "core/lookup.h"
#include "patterns/patterns.h"

static const koksma_pattern *const patterns[] = {
#define PATTERN(name) &koksma__pattern_##name,
#include "patterns/patterns.def"
#undef PATTERN
};

KOKSMA__LOOKUP(koksma_pattern, patterns)
