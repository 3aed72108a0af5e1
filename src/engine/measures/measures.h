/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_MEASURES_H
#define KOKSMA_MEASURES_MEASURES_H

#include <koksma/koksma.h>

#define MEASURE(name) extern const koksma_measure koksma__measure_##name;
#include "measures/measures.def"
#undef MEASURE

#endif
