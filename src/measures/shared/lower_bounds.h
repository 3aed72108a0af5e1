/* SPDX-License-Identifier: Apache-2.0 */
/* What no points can do better than: the one table of theoretical lower bounds. */
#ifndef KOKSMA_MEASURES_SHARED_LOWER_BOUNDS_H
#define KOKSMA_MEASURES_SHARED_LOWER_BOUNDS_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* No points have a measure that falls faster than n^-power (log n)^logs. */
typedef struct koksma__bound {
    double power, logs;
    const char *source; /* as "Schmidt 1972" */
} koksma__bound;

/* The bound of a measure in dim dimensions; false where none is known. */
KOKSMA__LAB bool koksma__lower_bound(const koksma_measure *measure, int dim, koksma__bound *bound);

#endif
