/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What is rendered, in double precision: the description that src/scene fills from files and that the renderer reads.
 * Lengths are in the scene's unit; y is up. Kinds of materials, lights and shapes are pointers to their entries in
 * the tables of src/render, so that a new kind needs no line here.
 */
#ifndef KOKSMA_RENDER_DESCRIPTION_H
#define KOKSMA_RENDER_DESCRIPTION_H

#include <koksma/render.h>
#include <koksma/warp.h>
#include <pthread.h>

#include "meshes/mesh.h"

enum { KOKSMA__MAX_SHAPES = 4096, KOKSMA__MAX_MATERIALS = 1024, KOKSMA__MAX_LIGHTS = 256 };

/* A position on a flat shape is centre + u axis_u + v axis_v; the axes and the normal are an orthonormal frame. */
typedef struct koksma__shape {
    const struct koksma__shape_type *type;
    double centre[3], axis_u[3], axis_v[3], normal[3];
    double half[2];   /* half sides; of a disk and a sphere half[0] is the radius; of a plane infinite */
    double motion[3]; /* of a sphere: at time t its centre is at centre + t motion */
    int material;     /* -1 for a light's own surface, which reflects nothing */
    int light;        /* the light whose surface this is, or -1 */
} koksma__shape;

enum { KOKSMA__MAX_VALUES = 16 }; /* numbers of a kind's parameters; a colour takes 3 */

/* How an image lies over a surface's coordinates (u, v): at matrix (u, v, 1), if it is moved. */
typedef enum koksma__wrap { KOKSMA__WRAP_REPEAT, KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_MIRROR } koksma__wrap;
typedef struct koksma__mapping {
    bool moved, nearest;
    float matrix[6];
    koksma__wrap wrap[2]; /* along u and v */
} koksma__mapping;

/* Images over a surface beside that of its albedo. */
typedef enum koksma__map_use {
    KOKSMA__MAP_SURFACE,  /* green times the roughness, blue times how metallic it is */
    KOKSMA__MAP_NORMAL,   /* 2 rgb - 1 is the normal along u, along v and outwards; scale: of the first two */
    KOKSMA__MAP_ALPHA,    /* grey times material.alpha */
    KOKSMA__MAP_EMISSION, /* times the radiance of the mesh's light */
    KOKSMA__N_MAPS
} koksma__map_use;

typedef struct koksma__map {
    koksma_image *image; /* or NULL */
    koksma__mapping mapping;
    float scale;
} koksma__map;

/* Colours are red, green and blue in linear light. A checker has two albedos, in squares of side `period` of a flat
   shape's own u, v: (floor(s + phase[0]) + floor(t + phase[1])) odd has the second, (s, t) = (u, v) turned by
   angle_rad / period. */
typedef struct koksma__material {
    char name[64];
    const struct koksma__bsdf *bsdf;
    bool checker;
    double albedo[2][3]; /* of the diffuse part */
    double period, phase[2], angle_rad;
    double values[KOKSMA__MAX_VALUES]; /* of the kind's parameters, where its file puts them */
    koksma_image *image;               /* the albedo over a surface's coordinates, in place of albedo; or NULL */
    koksma__mapping mapping;           /* of image, over meshes */
    koksma__map maps[KOKSMA__N_MAPS];
    bool tinted; /* the albedo is multiplied by the colours of a mesh's vertices, where it has them */
    /* see_through: the surface is there for this share of the rays; with a cutoff, wherever alpha is not below it */
    bool see_through;
    double alpha, cutoff;
    /* warnings about a model file's material; "": none */
    char lost[256]; /* why its texture is left out */
    char dark[256]; /* why its emission is left out */
} koksma__material;

/* A flat light shines from the side that its normal points to. What a surface of albedo a reflects of a rectangle
   is a * power * mean over the light of cos cos / distance^2, power = luminance * area / pi. */
typedef struct koksma__light {
    const struct koksma__light_kind *kind;
    double centre[3], axis_u[3], axis_v[3], normal[3];
    double half[2];     /* of a disk and a sphere half[0] is the radius */
    double power;       /* of rectangles and disks */
    double radiance[3]; /* of a point the intensity, of parallel light the irradiance of a surface that faces it */
    double values[KOKSMA__MAX_VALUES]; /* of the kind's own parameters, where its file puts them */
    bool visible;                      /* rays see it; the flat and round ones then have a shape */
    double angle_rad;                  /* by which the environment's image is turned about y */
    int placement;                     /* of a mesh */
    koksma_image *image;               /* the environment's, latitude and longitude, or NULL */
} koksma__light;

/* Film coordinates (x, y), y downwards, see along forward + x right + y down. */
typedef struct koksma__camera {
    double eye[3], forward[3], right[3], down[3]; /* unit vectors */
    double fov_rad;                               /* of the height */
    double lens_radius, focus_distance;           /* radius 0: a pinhole; the plane of focus is square to forward */
    const koksma_warp *lens_map;                  /* of the square to the lens */
    double shutter[2];                            /* the times when it opens and closes */
    double motion[3];                             /* at time t the eye is at eye + t motion */
} koksma__camera;

/* What the renderer makes of a scene that is the same for all pictures of it: made under the lock by the first that
   needs it, released with the scene. */
typedef struct koksma__scene_cache {
    pthread_mutex_t lock;
    void *made; /* or NULL */
    void (*release)(void *made);
} koksma__scene_cache;

/* What another renderer's scene has that is unknown here, and what was taken for it. */
typedef struct koksma__unknown {
    char file[64], text[256];
    unsigned long line; /* of the first place; there are n */
    size_t n;
} koksma__unknown;

struct koksma_scene {
    uint64_t hash;
    char title[128];
    int width, height;
    koksma__camera camera;
    double background[3]; /* what a ray sees that hits nothing */
    double ambient[3];    /* irradiance / pi from everywhere, without shadows */
    double clamp;         /* samples are cut to this; infinity: they are not */
    koksma__material *materials;
    koksma__shape *shapes;
    koksma__light *lights;
    koksma__mesh *meshes;
    koksma__placement *placements; /* of meshes */
    size_t n_materials, n_shapes, n_lights, n_meshes, n_placements;
    bool grey;                /* no colour in it: images have one channel */
    bool moves;               /* something depends on time */
    bool is_model;            /* a bare mesh file: nobody wrote its materials for this program */
    koksma__unread unread;    /* of a bare mesh file */
    koksma__unknown *unknown; /* of another renderer's scene */
    size_t n_unknown;
    bool glows; /* a placement with a material is a light, too */
    struct {
        size_t lights, shapes;
    } studio; /* how many of the last lights and shapes a bare mesh file got; each shape has one of the last materials */
    size_t n_notes; /* further warnings about a bare mesh file */
    char (*notes)[256];
    koksma__scene_cache *cache;
};

/* ---- Building one: description.c ------------------------------------------------------------------------------ */

/* The number of a material; -1 if there is none of that name. */
int koksma__find_material(const koksma_scene *scene, const char *name);

/* One more shape, a copy of *from; it moves when the next one is added. Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__scene_add_shape(koksma_scene *scene, const koksma__shape *from, koksma__shape **out);

/* One more light, zeroed. Errors: MALFORMED (too many). */
koksma_status koksma__scene_add_light(koksma_scene *scene, koksma__light **out);

/* One more warning about a bare mesh file. Errors: MEMORY. */
koksma_status koksma__scene_note(koksma_scene *scene, const char *text);

/* Sets the albedo of a material with an image to its mean. */
void koksma__material_mean(koksma__material *material);

/* What follows from the rest: grey, moves and the pixels' part of the hash. */
void koksma__scene_finish(koksma_scene *scene);

#endif
