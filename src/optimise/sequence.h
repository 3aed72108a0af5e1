/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences in base 2 by their first points: what KOKSMA_KEEP_SEQUENCE keeps. */
#ifndef KOKSMA_OPTIMISE_SEQUENCE_H
#define KOKSMA_OPTIMISE_SEQUENCE_H

#include <koksma/optimise.h>

/* Digits of a coordinate. */
enum { KOKSMA__SEQUENCE_DIGITS = 53 };

/* Errors: N (not 2^m points, m >= 1), ARGUMENT (they are not the first ones of a digital sequence). */
koksma_status koksma__sequence_check(const koksma_points *points);

#endif
