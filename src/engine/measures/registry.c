/* SPDX-License-Identifier: Apache-2.0 */
/* The table of all measures, from measures.def, with lookup by index and by name. */
#include "core/lookup.h"
#include "measures/measures.h"

static const koksma_measure *const measures[] = {
#define MEASURE(name) &koksma__measure_##name,
#include "measures/measures.def"
#undef MEASURE
};

KOKSMA__LOOKUP(koksma_measure, measures)
