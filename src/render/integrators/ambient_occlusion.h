/* SPDX-License-Identifier: Apache-2.0 */
/* The scene that the integrator `ambient-occlusion` renders (ambient_occlusion.c). */
#ifndef KOKSMA_RENDER_INTEGRATORS_AMBIENT_OCCLUSION_H
#define KOKSMA_RENDER_INTEGRATORS_AMBIENT_OCCLUSION_H

#include "render/frame.h"

/* Makes the scene that is rendered in place of `scene`. Errors: MEMORY; the caller must release *out even after an
   error. */
koksma_status koksma__ambient_occlusion_scene(const koksma_scene *scene, koksma_scene **out);
void koksma__ambient_occlusion_release(koksma_scene *scene);

#endif
