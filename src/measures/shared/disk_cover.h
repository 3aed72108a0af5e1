/* SPDX-License-Identifier: Apache-2.0 */
/* Bounds of the disk discrepancy by branch and bound. */
#ifndef KOKSMA_MEASURES_SHARED_DISK_COVER_H
#define KOKSMA_MEASURES_SHARED_DISK_COVER_H

#include "measures/shared/disk_pencil.h"

/* Raises *best to the best of all disks by branch and bound. *upper is an upper bound for all disks; it exceeds the
   value of *best if the search stopped early, at the deadline or, without one, after 2^28 point tests. Errors:
   MEMORY, INTERRUPTED. */
koksma_status koksma__disk_cover(const koksma__disk_set *set, const koksma_run *run, double deadline_s,
                                 koksma__disk_best *best, double *upper);

#endif
