/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Completes a scene that consists of nothing but a mesh file. The scene gets an image size; a camera if the file has
 * none; and, if no mesh emits light and the file has no other lights, a studio: a key light, a dim sky and, if the
 * camera was added, a ground. This file also replaces the sky of a scene by one that the user chooses
 * (koksma_scene_set_sky).
 */
#include "scene/model.h"
#include "image/image.h"
#include "render/description_build.h"
#include "render/lights/lights.h"
#include "scene/camera.h"
#include "scene/model_build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/status.h"
#include "core/vector.h"
#include "image/formats.h"
#include "render/materials/materials.h"
#include "render/medium.h"
#include "render/scene_images.h"
#include "render/shapes/shapes.h"

/* A version number in the hash of scenes from mesh files; it is raised when a change of the code alters their
   images. */
#define MODEL_REVISION 3

/* Finds the sphere around the bounding box of all meshes; returns its radius. *low_y is the lowest height of the
   box. */
static double surround(const koksma_scene *scene, double centre[3], double *low_y)
{
    double low[3], high[3], square = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = scene->placements[0].low[k];
        high[k] = scene->placements[0].high[k];
        for (size_t i = 1; i < scene->n_placements; i++) {
            low[k] = fmin(low[k], scene->placements[i].low[k]);
            high[k] = fmax(high[k], scene->placements[i].high[k]);
        }
        centre[k] = (low[k] + high[k]) / 2;
        square += (high[k] - low[k]) * (high[k] - low[k]) / 4;
    }
    *low_y = low[1];
    return sqrt(square);
}

/* Sets a camera that looks from the front, a little from above and from the right, at a distance where a sphere
   around everything fills the image's height. */
static void frame_all(koksma_scene *scene, const double centre[3], double radius)
{
    static const double up[3] = {0, 1, 0};
    const double fov = 40 * M_PI / 180;
    double eye[3], forward[3] = {-0.5, -0.4, -1};
    koksma__normalise(forward);
    for (int k = 0; k < 3; k++) {
        eye[k] = centre[k] - forward[k] * radius / sin(fov / 2);
    }
    koksma__camera_aim(eye, forward, up, fov, &scene->camera);
}

/* Adds a grey plane just below everything. */
static koksma_status add_ground(koksma_scene *scene, const double centre[3], double low_y, double radius)
{
    koksma__material *grey = &scene->materials[scene->n_materials];
    size_t kind = 0;
    while (strcmp(koksma__shape_kinds[kind]->name, "plane") != 0) {
        kind++;
    }
    koksma__shape plane = {.type = koksma__shape_types[kind],
                           .centre = {centre[0], low_y - 1e-4 * radius, centre[2]},
                           .normal = {0, 1, 0},
                           .axis_u = {1, 0, 0},
                           .axis_v = {0, 0, -1},
                           .half = {INFINITY, INFINITY},
                           .material = (int)scene->n_materials++,
                           .light = -1},
                  *added;
    snprintf(grey->name, sizeof grey->name, "ground");
    grey->bsdf = &koksma__bsdf_lambert;
    for (int k = 0; k < 6; k++) {
        grey->albedo[k / 3][k % 3] = 0.4;
    }
    scene->studio.shapes = 1;
    return koksma__scene_add_shape(scene, &plane, &added);
}

/* Adds the key light: a square, invisible to rays, with sides as long as the model's diameter, to the upper left
   in front of the model and five radii away. A surface in the model's centre that faces the square has an
   irradiance of 2. */
static koksma_status add_key(koksma_scene *scene, const double centre[3], double radius)
{
    static const double up[3] = {0, 1, 0};
    double from[3] = {-0.5, 0.9, 0.6};
    koksma__light *key = NULL;
    KOKSMA__TRY(koksma__scene_add_light(scene, &key));
    koksma__normalise(from);
    key->kind = &koksma__light_rectangle;
    key->half[0] = key->half[1] = radius;
    for (int k = 0; k < 3; k++) {
        key->centre[k] = centre[k] + 5 * radius * from[k];
        key->normal[k] = -from[k];
        key->radiance[k] = 2 * 25.0 / 4;
    }
    koksma__cross(up, key->normal, key->axis_u);
    koksma__normalise(key->axis_u);
    koksma__cross(key->normal, key->axis_u, key->axis_v);
    key->power = key->radiance[0] * 4 * radius * radius / M_PI;
    return KOKSMA_OK;
}

static koksma_status add_sky(koksma_scene *scene, double radiance)
{
    koksma__light *sky = NULL;
    KOKSMA__TRY(koksma__scene_add_light(scene, &sky));
    sky->kind = &koksma__light_environment;
    sky->visible = true;
    sky->radiance[0] = sky->radiance[1] = sky->radiance[2] = radiance;
    return KOKSMA_OK;
}

/* Limits the brightness of lights from a file. glTF gives lights in lux and candela and leaves the exposure to the
   viewer. If the lights make a white surface in the centre brighter than radiance 10, all are dimmed by the same
   factor, so that this surface gets radiance 1, with a warning. */
static koksma_status expose(koksma_scene *scene, const double centre[3])
{
    double sum = 0;
    char text[128];
    for (size_t i = 0; i < scene->n_lights; i++) {
        const koksma__light *l = &scene->lights[i];
        double d[3];
        koksma__subtract(l->centre, centre, d);
        const bool near = l->kind->distance == KOKSMA__LIGHT_NEAR;
        const double largest = fmax(fmax(l->radiance[0], l->radiance[1]), l->radiance[2]);
        sum += l->kind == &koksma__light_mesh ? 0 : largest / (near ? fmax(koksma__dot(d, d), TINY) : 1) / M_PI;
    }
    if (!(sum > 10)) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; i < scene->n_lights; i++) {
        for (int k = 0; k < 3 && scene->lights[i].kind != &koksma__light_mesh; k++) {
            scene->lights[i].radiance[k] /= sum;
        }
    }
    snprintf(text, sizeof text, "the lights at nodes are too bright: all are divided by %llu",
             (unsigned long long)sum);
    return koksma__scene_note(scene, text);
}

/* Adds the camera and the studio, where the model lacks them. The studio's lights and ground come last in their
   lists, so that koksma_scene_set_sky() can remove them. */
static koksma_status complete(koksma_scene *scene, bool has_camera)
{
    double centre[3], low_y;
    const double radius = surround(scene, centre, &low_y);
    bool lit = false;
    for (size_t i = 0; i < scene->n_lights; i++) {
        lit |= scene->lights[i].kind != &koksma__light_mesh;
    }
    if (!has_camera) {
        frame_all(scene, centre, radius);
    }
    if (lit) {
        return expose(scene, centre);
    }
    scene->studio.lights = 2;
    KOKSMA__TRY(add_key(scene, centre, radius));
    KOKSMA__TRY(add_sky(scene, 0.4));
    return has_camera ? KOKSMA_OK : add_ground(scene, centre, low_y, radius);
}

/* Removes the studio, whose lights and shapes are the last in their lists. */
static void take_down(koksma_scene *scene)
{
    scene->n_lights -= scene->studio.lights;
    scene->n_shapes -= scene->studio.shapes;
    scene->n_materials -= scene->studio.shapes;
    memset(&scene->studio, 0, sizeof scene->studio);
}

koksma_status koksma_scene_set_sky(koksma_scene *scene, const char *image, double radiance)
{
    KOKSMA__REQUIRE(scene);
    koksma__light *sky = NULL;
    koksma_image *pixels = NULL, read = {0};
    KOKSMA__FAIL_IF(!(radiance >= 0 && radiance <= BRIGHT), KOKSMA_ARGUMENT,
                    "a sky of radiance %g: it must be 0 to %g", radiance, BRIGHT);
    KOKSMA__FAIL_IF(scene->cache->made, KOKSMA_ARGUMENT, "the scene was rendered already; set its sky before that");
    if (image) {
        koksma_status status = koksma__image_read(image, KOKSMA__FILE_TEXTURE, KOKSMA__BY_USER, &read);
        status = status ? status : koksma__image_check(&read, image);
        if (!status && *koksma_image_remark()) {
            status = koksma__scene_image_remark(scene, image, koksma_image_remark());
        }
        status = status ? status : koksma__scene_image_keep(scene, &read, &pixels);
        if (status) {
            koksma_image_fini(&read);
            return status;
        }
    }
    take_down(scene);
    for (size_t i = 0; i < scene->n_lights; i++) {
        sky = scene->lights[i].kind == &koksma__light_environment ? &scene->lights[i] : sky;
    }
    KOKSMA__TRY(sky ? KOKSMA_OK : koksma__scene_add_light(scene, &sky));
    const koksma_image *old = sky->image;
    *sky = (koksma__light){.kind = &koksma__light_environment,
                           .visible = true,
                           .radiance = {radiance, radiance, radiance},
                           .image = pixels};
    koksma__scene_image_drop(scene, old);
    const uint64_t parts[2] = {koksma__scene_hash(scene), koksma__hash(&radiance, sizeof radiance)};
    scene->hash = koksma__hash(parts, sizeof parts);
    koksma__scene_finish(scene);
    return koksma__medium_check(scene);
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
    scene->hash += MODEL_REVISION;
    KOKSMA__TRY(complete(scene, has_camera));
    koksma__scene_finish(scene);
    return KOKSMA_OK;
}
