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

/* Functions that are compiled once for each value of an argument. */
#define INLINE static inline __attribute__((always_inline))

#endif
