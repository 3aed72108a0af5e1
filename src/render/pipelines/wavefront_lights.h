/* SPDX-License-Identifier: Apache-2.0 */
/* Direct light at the vertices of paths. */
#ifndef KOKSMA_RENDER_PIPELINES_WAVEFRONT_LIGHTS_H
#define KOKSMA_RENDER_PIPELINES_WAVEFRONT_LIGHTS_H

#include "render/pipelines/wavefront_scratch.h"

/* Samples lights at the vertices and adds the light that the vertices reflect. */
koksma_status koksma__wavefront_light(const koksma__trace *trace, koksma__vertices *v, koksma__values *values);

/* Returns the probability that a vertex at p with normal n samples light `light`. */
float koksma__light_probability(const koksma__frame *frame, const float p[3], const float n[3], int light);

#endif
