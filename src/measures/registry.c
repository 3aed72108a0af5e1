/* SPDX-License-Identifier: Apache-2.0 */
/* The table of measures (measures.def): member i, and the member of a name. */
#include "core/lookup.h"
#include "measures/measures.h"

static const koksma_measure *const measures[] = {
#define MEASURE(name) &koksma__measure_##name,
#include "measures/measures.def"
#undef MEASURE
};

KOKSMA__LOOKUP(koksma_measure, measures)
