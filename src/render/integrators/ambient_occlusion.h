/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_INTEGRATORS_AMBIENT_OCCLUSION_H
#define KOKSMA_RENDER_INTEGRATORS_AMBIENT_OCCLUSION_H

#include "render/frame.h"

/* The scene that is rendered in place of a scene. Errors: MEMORY; *out is released even then. */
koksma_status koksma__ambient_occlusion_scene(const koksma_scene *scene, koksma_scene **out);
void koksma__ambient_occlusion_release(koksma_scene *scene);

#endif
