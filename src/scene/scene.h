/* SPDX-License-Identifier: Apache-2.0 */
/* What a scene file says, checked, in double precision. Lengths are in the scene's own unit; y is up. */
#ifndef KOKSMA_SCENE_SCENE_H
#define KOKSMA_SCENE_SCENE_H

#include <koksma/render.h>

enum { KOKSMA__MAX_SHAPES = 4096, KOKSMA__MAX_MATERIALS = 1024, KOKSMA__MAX_LIGHTS = 256 };

typedef enum koksma__shape_kind {
    KOKSMA__SHAPE_PLANE,     /* endless */
    KOKSMA__SHAPE_RECTANGLE, /* |u| <= half[0], |v| <= half[1] */
    KOKSMA__SHAPE_DISK,      /* u^2 + v^2 <= half[0]^2 */
    KOKSMA__SHAPE_SPHERE
} koksma__shape_kind;

/* A place on a flat shape is centre + u axis_u + v axis_v; the axes and the normal are an orthonormal frame. */
typedef struct koksma__shape {
    koksma__shape_kind kind;
    double centre[3], axis_u[3], axis_v[3], normal[3];
    double half[2]; /* half sides; of a disk and a sphere half[0] is the radius; of a plane infinite */
    int material;
} koksma__shape;

/* Lambert: a diffuse surface of the given albedo. A checker has two, in squares of side `period` of a flat shape's
   own u, v: (floor(s + phase[0]) + floor(t + phase[1])) odd has the second, (s, t) = (u, v) turned by angle_rad /
   period. */
typedef struct koksma__material {
    char name[64];
    bool checker;
    double albedo[2], period, phase[2], angle_rad;
} koksma__material;

/* A rectangle that shines from the side that its normal points to, and that rays don't see. What a surface of albedo
   a reflects of it is a * power * mean over the light of cos cos / distance^2, power = radiance * area / pi. */
typedef struct koksma__light {
    double centre[3], axis_u[3], axis_v[3], normal[3];
    double half[2];
    double power;
} koksma__light;

/* Film coordinates (x, y), y downwards, see along forward + x right + y down. */
typedef struct koksma__camera {
    double eye[3], forward[3], right[3], down[3]; /* unit vectors */
    double fov_rad;                               /* of the height */
} koksma__camera;

struct koksma_scene {
    uint64_t hash;
    char title[128];
    int width, height;
    koksma__camera camera;
    double background; /* luminance that a ray sees which hits nothing */
    double ambient;    /* irradiance / pi from everywhere, without shadows */
    koksma__material *materials;
    koksma__shape *shapes;
    koksma__light *lights;
    size_t n_materials, n_shapes, n_lights;
};

/* Fills scene from a text; name is for errors. On failure the caller closes what is there. */
koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene);

#endif
