/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Masks and orders for patterns over the whole image: tables that tell each pixel which points of one pattern are its
 * own, or how its copy of a pattern is shifted, so that the errors of neighbouring pixels differ and average out to
 * the eye.
 *
 *     void-and-cluster mask   shift pixel (x, y)'s points on the torus by (rank + 1/2) / size^2 (Georgiev & Fajardo
 *                             2016), or threshold images with it
 *     koksma_z_rank           (koksma/sampler.h) gives pixel (x, y) the samples rank * spp .. rank * spp + spp - 1 of
 *                             one sequence (Ahmed & Wonka 2020)
 */
#ifndef KOKSMA_MASK_H
#define KOKSMA_MASK_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { KOKSMA_MASK_MIN = 4, KOKSMA_MASK_MAX = 256 };

/* The void-and-cluster mask of Ulichney (1993): ranks[y * size + x] is a permutation of 0 .. size^2 - 1 such that the
   pixels below any rank are spread evenly on the torus. size is KOKSMA_MASK_MIN to KOKSMA_MASK_MAX; time grows with
   size^4, about 30 ms for 64. run may be NULL. Errors: ARGUMENT, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_mask_void_and_cluster(int size, uint64_t seed, const koksma_run *run,
                                                      uint32_t *ranks);

#ifdef __cplusplus
}
#endif

#endif
