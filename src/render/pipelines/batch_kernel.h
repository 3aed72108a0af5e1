/* SPDX-License-Identifier: Apache-2.0 */
/* For the files that are compiled once for each instruction set: the loops' names there, and what they are written
   with. */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H
#define KOKSMA_RENDER_PIPELINES_BATCH_KERNEL_H

#include "render/pipelines/batch.h"

#define KERNEL(result, name, arguments) result BATCH_NAME(name) arguments;
#include "render/pipelines/batch.def"
#undef KERNEL

#define STEP(n) ((n) & ~(KOKSMA__LANE_STEP - 1)) /* tells the compiler that there is no remainder */

/* Before a loop over lanes: what it writes in one lane it reads in no other. gcc gives up checking that for many arrays. */
#if defined(__GNUC__) && !defined(__clang__)
#define LANES_APART _Pragma("GCC ivdep")
#else
#define LANES_APART
#endif

/* Functions that are compiled once for each value of an argument. */
#define INLINE static inline __attribute__((always_inline))

#endif
