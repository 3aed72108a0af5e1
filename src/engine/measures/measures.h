/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_MEASURES_H
#define KOKSMA_MEASURES_MEASURES_H

#include <koksma/koksma.h>

/* Returns the table row of a measure in l2_boxes.c (measures/l2/l2.h), or NULL for any other measure. */
const struct koksma__l2_row *koksma__l2_row_of(const koksma_measure *measure);

#define MEASURE(name) extern const koksma_measure koksma__measure_##name;
#include "measures/measures.def"
#undef MEASURE

#endif
