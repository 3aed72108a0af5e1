/* SPDX-License-Identifier: Apache-2.0 */
#include "measures/measures.h"

#include <string.h>

static const koksma_measure *const measures[] = {
#define MEASURE(name) &koksma__measure_##name,
#include "measures/measures.def"
#undef MEASURE
};

const koksma_measure *koksma_measure_at(size_t i)
{
    return i < sizeof measures / sizeof *measures ? measures[i] : NULL;
}

const koksma_measure *koksma_measure_find(const char *name)
{
    for (size_t i = 0; koksma_measure_at(i); i++) {
        if (!strcmp(koksma_measure_at(i)->name, name)) {
            return koksma_measure_at(i);
        }
    }
    return NULL;
}
