/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds where the parts of a scene are: the bounding boxes of shapes and placed meshes, and the part of the image
 * that a box covers, from the projection of its corners. A box that reaches behind the camera, or is infinite,
 * may cover the whole image.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "render/description.h"
#include "render/shapes/shapes.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The extent of a shape from its centre along axis k; an infinite side perpendicular to the axis adds nothing. */
static double reach(const koksma__shape *shape, int k)
{
    if (!shape->type->is_flat) {
        return shape->type->radius ? shape->type->radius(shape) : shape->half[0];
    }
    const double u = fabs(shape->axis_u[k]), v = fabs(shape->axis_v[k]),
                 second = shape->half[1] ? shape->half[1] : shape->half[0];
    return (u > 0 ? u * shape->half[0] : 0) + (v > 0 ? v * second : 0);
}

/* Sets frame and in_frame of a part from its box. */
static void look(const koksma_scene *scene, koksma_scene_part *part)
{
    const koksma__camera *camera = &scene->camera;
    const bool parallel = camera->height > 0;
    const double half_height = parallel ? camera->height / 2 : tan(camera->fov_rad / 2),
                 half_width = half_height * scene->width / scene->height;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    int behind = 0, endless = 0;
    for (int corner = 0; corner < 8; corner++) {
        double d[3];
        for (int k = 0; k < 3; k++) {
            d[k] = (corner >> k & 1 ? part->high[k] : part->low[k]) - camera->eye[k];
            endless += !isfinite(d[k]);
        }
        const double z = dot(d, camera->forward), far = parallel ? 1 : z;
        behind += z <= 0;
        const double at[2] = {dot(d, camera->right) / far / half_width, dot(d, camera->down) / far / half_height};
        for (int k = 0; k < 2; k++) {
            low[k] = fmin(low[k], (1 + at[k]) / 2);
            high[k] = fmax(high[k], (1 + at[k]) / 2);
        }
    }
    const bool whole = endless || (behind % 8 && !parallel);
    for (int k = 0; k < 2; k++) {
        part->frame[2 * k] = whole ? 0 : fmax(low[k], 0);
        part->frame[2 * k + 1] = whole ? 1 : fmin(high[k], 1);
    }
    part->in_frame = whole || (behind < 8 && part->frame[0] < part->frame[1] && part->frame[2] < part->frame[3]);
}

static int by_placement(const void *key, const void *name)
{
    const size_t a = *(const size_t *)key, b = ((const koksma__part_name *)name)->placement;
    return (a > b) - (a < b);
}

/* The name of a placed mesh. */
static const char *name_of(const koksma_scene *scene, size_t placement)
{
    const koksma__part_name *own =
        scene->n_part_names ? bsearch(&placement, scene->part_names, scene->n_part_names, sizeof *own, by_placement)
                            : NULL;
    return own ? own->name : scene->meshes[scene->placements[placement].mesh].name;
}

bool koksma_scene_part_at(const koksma_scene *scene, size_t i, koksma_scene_part *out)
{
    KOKSMA__REQUIRE_OR(false, scene, out);
    if (i >= scene->n_shapes + scene->n_placements) {
        return false;
    }
    *out = (koksma_scene_part){.in_frame = false};
    if (i < scene->n_shapes) {
        const koksma__shape *shape = &scene->shapes[i];
        snprintf(out->name, sizeof out->name, "%s%s", shape->light < 0 ? "" : "light ", shape->type->kind.name);
        for (int k = 0; k < 3; k++) {
            out->low[k] = shape->centre[k] - reach(shape, k);
            out->high[k] = shape->centre[k] + reach(shape, k);
        }
    } else {
        const koksma__placement *placement = &scene->placements[i - scene->n_shapes];
        const char *name = name_of(scene, i - scene->n_shapes);
        snprintf(out->name, sizeof out->name, "%smesh%s%s", placement->light < 0 ? "" : "light ", *name ? " " : "",
                 name);
        memcpy(out->low, placement->low, sizeof out->low);
        memcpy(out->high, placement->high, sizeof out->high);
    }
    look(scene, out);
    return true;
}
