/* SPDX-License-Identifier: Apache-2.0 */
/* Theoretical lower bounds of discrepancies, which no set of points can beat. */
#ifndef KOKSMA_MEASURES_SHARED_LOWER_BOUNDS_H
#define KOKSMA_MEASURES_SHARED_LOWER_BOUNDS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* A bound: no sets of n points have a measure that falls faster than n^-power (log n)^logs. */
typedef struct koksma__bound {
    double power, logs;
    const char *source; /* for example "Schmidt 1972" */
} koksma__bound;

/* Writes the bound of a measure in dim dimensions; returns false if none is known. */
KOKSMA__LAB bool koksma__lower_bound(const koksma_measure *measure, int dim, koksma__bound *bound);

#endif
