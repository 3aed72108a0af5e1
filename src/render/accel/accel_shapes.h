/* SPDX-License-Identifier: Apache-2.0 */
/* Intersection of analytic shapes without a tree. */
#ifndef KOKSMA_RENDER_ACCEL_ACCEL_SHAPES_H
#define KOKSMA_RENDER_ACCEL_ACCEL_SHAPES_H

#include "render/accel/intersect.h"

/* Makes the geometry of the scene's analytic shapes, without an acceleration structure. Errors: MEMORY. */
koksma_status koksma__accel_shapes(const koksma_scene *scene, koksma__geometry *out);

#endif
