/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of a scene file, one file each, and the fields that several of them have. */
#ifndef KOKSMA_SCENE_PARSE_H
#define KOKSMA_SCENE_PARSE_H

#include <math.h>
#include <stdbool.h>

#include "core/read_file.h"
#include "core/status.h"
#include "scene/scene.h"
#include "json/json.h"

#define FAR 1e6    /* coordinates and lengths */
#define TINY 1e-6  /* lengths that count as zero */
#define BRIGHT 1e6 /* luminance */
#define TURN (2 * M_PI)

#define KEYS(...) ((const char *const[]){__VA_ARGS__, NULL})

typedef koksma__json_node field;

koksma_status koksma__parse_camera(const field *root, koksma__camera *camera);
/* name: of the scene's file, next to which the files that it names are looked for. */
koksma_status koksma__parse_material(const char *name, const field *f, koksma_scene *scene);
koksma_status koksma__parse_shape(const char *name, const field *f, koksma_scene *scene);
koksma_status koksma__parse_mesh(const char *name, const field *f, koksma_scene *scene);
koksma_status koksma__parse_instance(const field *f, koksma_scene *scene);
koksma_status koksma__parse_light(const char *name, const field *f, koksma_scene *scene);

/* One more shape, zeroed but for light = -1; there is room for the last one until the next call. Errors: MALFORMED
   (too many; f is named), MEMORY. */
koksma_status koksma__parse_room(const field *f, koksma_scene *scene, koksma__shape **out);

/* What follows from the rest: grey and moves. */
void koksma__scene_finish(koksma_scene *scene);

/* One more mesh, zeroed; one more placement, zeroed but for material = light = -1. They may move the others.
   Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__scene_add_mesh(koksma_scene *scene, koksma__mesh **out);
koksma_status koksma__scene_add_placement(koksma_scene *scene, koksma__placement **out);

/* Makes the placement a luminaire. Errors: MALFORMED (too many, or it has no area where it stands). */
koksma_status koksma__scene_add_glow(koksma_scene *scene, koksma__placement *placement, const double radiance[3]);

/* One more luminaire, zeroed. Errors: MALFORMED (too many). */
koksma_status koksma__scene_add_light(koksma_scene *scene, koksma__light **out);

/* Who has a file that is missing, for the end of an error; "" where we don't know. */
const char *koksma__package_hint(const char *path);

/* The image of a file that the file `name` names, read; NULL on failure, which names f. */
koksma_status koksma__parse_image(const char *name, const field *f, const char *path, koksma_image **out);

/* The albedo of a material with an image: its mean. */
void koksma__material_mean(koksma__material *material);

koksma_status koksma__parse_point(const field *object, const char *key, double out[3]);
koksma_status koksma__parse_direction(const field *object, const char *key, double out[3]);

/* A number (grey) or an array of red, green and blue; left alone when it is not there and needed is false. */
koksma_status koksma__parse_colour(const field *object, const char *key, bool needed, double max, double out[3]);
koksma_status koksma__parse_colour_value(const field *node, double max, double out[3]);

/* The axes of a flat shape from its normal and "up" (default: y; -z for a normal along y). axis_v is up made square
   to the normal and axis_u = axis_v x normal: seen against the normal u goes right. A floor has u = x, v = -z. */
koksma_status koksma__parse_axes(const field *object, const double normal[3], double axis_u[3], double axis_v[3]);

/* "half", "radius" (into both halves), checked; "kind", which must be one of the words of `kinds`. */
koksma_status koksma__parse_half(const field *object, double half[2]);
koksma_status koksma__parse_radius(const field *object, double half[2]);
koksma_status koksma__parse_kind(const field *object, const char *kinds, const char **out);

#endif
