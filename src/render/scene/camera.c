/* SPDX-License-Identifier: Apache-2.0 */
/* Finds a camera's lens map by its name, and computes a camera's axes from its direction of view. */
#include "scene/camera.h"

#include <string.h>

#include "core/vector.h"

const koksma_warp *koksma__lens_map(const char *name)
{
    return koksma_warp_find(!strcmp(name, "concentric") ? "concentric-disk"
                            : !strcmp(name, "polar")    ? "polar-disk"
                                                        : "");
}

bool koksma__camera_aim(const double eye[3], const double forward[3], const double up[3], double fov_rad,
                        koksma__camera *camera)
{
    memcpy(camera->eye, eye, sizeof camera->eye);
    memcpy(camera->forward, forward, sizeof camera->forward);
    camera->fov_rad = fov_rad;
    camera->focus_distance = 1;
    camera->lens_map = koksma__lens_map("concentric");
    camera->shutter[1] = 1;
    if (!koksma__normalise(camera->forward)) {
        return false;
    }
    koksma__cross(camera->forward, up, camera->right);
    if (!koksma__normalise(camera->right)) {
        return false;
    }
    koksma__cross(camera->forward, camera->right, camera->down);
    return true;
}
