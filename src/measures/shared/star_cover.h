/* SPDX-License-Identifier: Apache-2.0 */
/* Upper bounds of the star discrepancy. */
#ifndef KOKSMA_MEASURES_SHARED_STAR_COVER_H
#define KOKSMA_MEASURES_SHARED_STAR_COVER_H

#include <koksma/koksma.h>

/* Computes an upper bound by refining a cover of the possible corners with boxes until the deadline. */
koksma_status koksma__star_cover(const koksma_points *points, const koksma_run *run, double deadline_s, double lower,
                                 double *upper);

#endif
