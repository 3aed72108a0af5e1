/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_INTEGRATORS_IRRADIANCE_CACHE_H
#define KOKSMA_RENDER_INTEGRATORS_IRRADIANCE_CACHE_H

#include "render/frame.h"

/* The records that are made before the picture; NULL frame->cache: there are none. */
koksma_status koksma__irradiance_cache_open(koksma__frame *frame, const koksma_run *run);
void koksma__irradiance_cache_close(koksma__frame *frame);
koksma_status koksma__irradiance_cache_indirect(const koksma__frame *frame, const koksma__surface *s, float time,
                                                float out[3]);

#endif
