/* SPDX-License-Identifier: Apache-2.0 */
/* Included by the files that are compiled once for each instruction set: declares the kernels under their names
   for this instruction set, and macros for loops over lanes. */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H
#define KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H

#include "render/pipelines/batch.h"

#define KERNEL(result, name, arguments) result BATCH_NAME(name) arguments;
#include "render/pipelines/batch.def"
#undef KERNEL

/* rounds n down to a multiple of KOKSMA__LANE_STEP, so that the compiler adds no remainder loop */
#define STEP(n) ((n) & ~(KOKSMA__LANE_STEP - 1))

/* Marks a loop over lanes whose iterations are independent: no lane reads what another lane writes. gcc gives up
   checking this for loops over many arrays. */
#if defined(__GNUC__) && !defined(__clang__)
#define LANES_APART _Pragma("GCC ivdep")
#else
#define LANES_APART
#endif

/* Forces inlining of functions that are compiled once for each value of a constant argument. */
#define INLINE static inline __attribute__((always_inline))

/* Returns how many of the first n rays have their closest hit on the primitive. */
INLINE int koksma__batch_count_hits(const koksma__hits *h, int32_t id, int n)
{
    int count = 0;
    for (int i = 0; i < STEP(n); i++) {
        count += h->primitive[i] == id;
    }
    return count;
}

#endif
