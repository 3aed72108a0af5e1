/* SPDX-License-Identifier: Apache-2.0 */
/* The star discrepancy in one and two dimensions. */
#ifndef KOKSMA_MEASURES_SHARED_STAR_2D_H
#define KOKSMA_MEASURES_SHARED_STAR_2D_H

#include <koksma/koksma.h>

/* koksma__star_2d accepts one or two dimensions and n < 2^28. In one dimension it sorts; in two it uses a sweep in
   O(n^2) for few points and a kinetic tree in about O(n log n) for more. koksma__star_2d_by accepts two dimensions
   and the method to use; tests compare the two. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__star_2d(const koksma_points *points, const koksma_run *run, koksma_value *out);
koksma_status koksma__star_2d_by(bool kinetic, const koksma_points *points, const koksma_run *run, koksma_value *out);

/* Writes the box from the origin to corner[0..dim) to out if its value exceeds that in out. The function counts the
   points in the box again, so that the value is |count/n - volume| to the last bit. */
void koksma__star_keep(const koksma_points *points, const double *corner, bool closed, koksma_value *out);

#endif
