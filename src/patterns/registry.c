/* SPDX-License-Identifier: Apache-2.0 */
#include "patterns/patterns.h"

#include <string.h>

static const koksma_pattern *const patterns[] = {
#define PATTERN(name) &koksma__pattern_##name,
#include "patterns/patterns.def"
#undef PATTERN
};

const koksma_pattern *koksma_pattern_at(size_t i)
{
    return i < sizeof patterns / sizeof *patterns ? patterns[i] : NULL;
}

const koksma_pattern *koksma_pattern_find(const char *name)
{
    for (size_t i = 0; koksma_pattern_at(i); i++) {
        if (!strcmp(koksma_pattern_at(i)->name, name)) {
            return koksma_pattern_at(i);
        }
    }
    return NULL;
}
