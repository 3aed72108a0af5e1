/* SPDX-License-Identifier: Apache-2.0 */
/* What a bare mesh file lacks as a scene: a picture's size, and where it has none a camera and light. */
#include "scene/model.h"
#include "render/lights/lights.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "core/vector.h"
#include "scene/parse.h"

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

/* From the front, a little from above and the right, so far that a ball around everything fills the height. */
static void frame_all(koksma_scene *scene)
{
    static const double direction[3] = {-0.5, -0.4, -1}, up[3] = {0, 1, 0};
    const double fov = 40 * M_PI / 180;
    double low[3], high[3], eye[3], square = 0, forward[3] = {direction[0], direction[1], direction[2]};
    for (int k = 0; k < 3; k++) {
        low[k] = scene->placements[0].low[k];
        high[k] = scene->placements[0].high[k];
        for (size_t i = 1; i < scene->n_placements; i++) {
            low[k] = fmin(low[k], scene->placements[i].low[k]);
            high[k] = fmax(high[k], scene->placements[i].high[k]);
        }
        square += (high[k] - low[k]) * (high[k] - low[k]) / 4;
    }
    koksma__normalise(forward);
    for (int k = 0; k < 3; k++) {
        eye[k] = (low[k] + high[k]) / 2 - forward[k] * sqrt(square) / sin(fov / 2);
    }
    koksma__camera_aim(eye, forward, up, fov, &scene->camera);
}

koksma_status koksma__model_parse(const char *path, koksma__named by, koksma_scene *scene)
{
    bool has_camera = false;
    const char *slash = strrchr(path, '/');
    scene->lights = calloc(KOKSMA__MAX_LIGHTS, sizeof *scene->lights);
    scene->materials = calloc(KOKSMA__MAX_MATERIALS, sizeof *scene->materials);
    if (!scene->lights || !scene->materials) {
        return koksma__fail_memory(KOKSMA__MAX_MATERIALS * sizeof *scene->materials);
    }
    snprintf(scene->title, sizeof scene->title, "%s", slash ? slash + 1 : path);
    scene->is_model = true;
    scene->width = 512;
    scene->height = 384;
    scene->clamp = INFINITY;
    KOKSMA__TRY(koksma__model_read(path, by, scene, &has_camera));
    if (!has_camera) {
        frame_all(scene);
    }
    koksma__light *sky = NULL;
    if (!scene->n_lights && !koksma__scene_add_light(scene, &sky)) {
        sky->kind = &koksma__light_environment;
        sky->visible = true;
        sky->radiance[0] = sky->radiance[1] = sky->radiance[2] = 1;
    }
    koksma__scene_finish(scene);
    return KOKSMA_OK;
}
