/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_SCENE_WARNINGS_H
#define KOKSMA_RENDER_SCENE_WARNINGS_H

#include "render/description.h"
#include "render/integrators/integrator_flags.h"

/* Warning i of koksma_scene_warning, of those that concern the integrator. flags: NULL for all integrators. */
bool koksma__scene_warning(const koksma_scene *scene, const koksma__integrator_flags *flags, size_t i, char *text,
                           size_t size);

/* Writes the first part of a scene that is not read; returns false if there is none. */
bool koksma__scene_unread(const koksma_scene *scene, char *text, size_t size);

#endif
