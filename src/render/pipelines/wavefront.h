/* SPDX-License-Identifier: Apache-2.0 */
/* The tracing of paths. */
#ifndef KOKSMA_RENDER_PIPELINES_WAVEFRONT_H
#define KOKSMA_RENDER_PIPELINES_WAVEFRONT_H

#include "render/pipelines/wavefront_scratch.h"

/* Traces the paths in the first queue from trace->bounce until they end, and adds their light to the sums of their
   samples. */
koksma_status koksma__wavefront_follow(koksma__trace *trace, koksma__values *values);

#endif
