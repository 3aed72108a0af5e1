/* SPDX-License-Identifier: Apache-2.0 */
/* Cameras of scene files and models. */
#ifndef KOKSMA_SCENE_CAMERA_H
#define KOKSMA_SCENE_CAMERA_H

#include "render/description.h"

/* Returns the map from the unit square to the lens that has this name, "concentric" or "polar"; NULL for other names. */
const koksma_warp *koksma__lens_map(const char *name);

/* Sets the camera at `eye` that looks along `forward`; returns false if `up` is parallel to `forward`. */
bool koksma__camera_aim(const double eye[3], const double forward[3], const double up[3], double fov_rad,
                        koksma__camera *camera);

#endif
