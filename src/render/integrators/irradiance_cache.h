/* SPDX-License-Identifier: Apache-2.0 */
/* The hooks of the integrator `irradiance-cache` (irradiance_cache.c). */
#ifndef KOKSMA_RENDER_INTEGRATORS_IRRADIANCE_CACHE_H
#define KOKSMA_RENDER_INTEGRATORS_IRRADIANCE_CACHE_H

#include "render/frame.h"

/* Computes the records of the cache before the image. frame->cache remains NULL at depth 0, which needs no
   records. */
koksma_status koksma__irradiance_cache_open(koksma__frame *frame, const koksma_run *run);
void koksma__irradiance_cache_close(koksma__frame *frame);
koksma_status koksma__irradiance_cache_indirect(const koksma__frame *frame, const koksma__surface *s, float time,
                                                float out[3]);

#endif
