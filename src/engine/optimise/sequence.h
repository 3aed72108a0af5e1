/* SPDX-License-Identifier: Apache-2.0 */
/* Digital sequences in base 2, given by their first points; a search with KOKSMA_KEEP_SEQUENCE changes only their
   generator matrices. */
#ifndef KOKSMA_OPTIMISE_SEQUENCE_H
#define KOKSMA_OPTIMISE_SEQUENCE_H

#include <koksma/optimise.h>

/* The number of binary digits of a coordinate. */
enum { KOKSMA__SEQUENCE_DIGITS = 53 };

/* Checks that the points begin a digital sequence. Errors: N (not 2^m points, m >= 1), ARGUMENT (they are not the
   first points of a digital sequence). */
koksma_status koksma__sequence_check(const koksma_points *points);

#endif
