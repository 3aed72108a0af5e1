/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The description of a scene in double precision, which src/render/scene fills from files and the renderer reads. Lengths
 * are in the scene's unit; y is up. A material, light or shape points to its kind's entry in the tables of
 * src/render, so that a new kind needs no change here.
 */
#ifndef KOKSMA_RENDER_DESCRIPTION_H
#define KOKSMA_RENDER_DESCRIPTION_H

#include <pthread.h>

#include <koksma/render.h>
#include <koksma/warp.h>

#include "meshes/mesh_file.h"

enum { KOKSMA__MAX_SHAPES = 4096, KOKSMA__MAX_MATERIALS = 1024, KOKSMA__MAX_LIGHTS = 256 };

/* A position on a flat shape is centre + u axis_u + v axis_v; the axes and the normal are an orthonormal frame. */
typedef struct koksma__shape {
    const struct koksma__shape_type *type;
    double centre[3], axis_u[3], axis_v[3], normal[3];
    double half[2];   /* half sides; half[0] is the radius of a disk or sphere; infinite for a plane */
    double motion[3]; /* at time t the shape is moved by t motion */
    /* turns: the shape also rotates and scales about the pivot; the intersection loops work on the shape at rest. A
       point p of the shape at rest is at time t at
           pivot + t motion + (1 + t (scale - 1)) Rotation(axis, t angle_rad) (p - pivot)  */
    struct {
        bool turns;
        double pivot[3], axis[3], angle_rad, scale;
    } turn;
    int material; /* -1 for a light's own surface, which reflects nothing */
    int light;    /* index of the light, if the shape is a light's surface; otherwise -1 */
} koksma__shape;

/* largest number of values that the parameters of a kind have; a colour has 3 values */
enum { KOKSMA__MAX_VALUES = 16 };

/* How an image is mapped to a surface: at texture coordinates (u, v) it is looked up at matrix (u, v, 1) if `moved`,
   and otherwise at (u, v). */
typedef enum koksma__wrap { KOKSMA__WRAP_REPEAT, KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_MIRROR } koksma__wrap;
typedef struct koksma__mapping {
    bool moved, nearest;
    float matrix[6];
    koksma__wrap wrap[2]; /* along u and v */
} koksma__mapping;

/* What a material's images are used for, except the image of its albedo, which is a separate member. */
typedef enum koksma__map_use {
    KOKSMA__MAP_SURFACE, /* the roughness is multiplied by the image's green, the metallic value by its blue */
    /* 2 rgb - 1 is the normal along u, along v and outwards; scale multiplies the first two */
    KOKSMA__MAP_NORMAL,
    KOKSMA__MAP_ALPHA,    /* material.alpha is multiplied by the image */
    KOKSMA__MAP_EMISSION, /* the radiance of the mesh's light is multiplied by the image */
    KOKSMA__N_MAPS
} koksma__map_use;

typedef struct koksma__map {
    koksma_image *image; /* or NULL; owned by the scene, as all images */
    koksma__mapping mapping;
    float scale;
} koksma__map;

/* Colours are red, green and blue in linear light. A checker has two albedos, in squares of side `period` in a flat
   shape's coordinates: the second albedo where floor(s + phase[0]) + floor(t + phase[1]) is odd, with (s, t) = (u, v)
   rotated by angle_rad and divided by period; or, if mapping.moved, where floor(s) + floor(t) is odd, with (s, t) =
   (u, v) mapped and divided by period. */
typedef struct koksma__material {
    char name[64];
    const struct koksma__bsdf *bsdf;
    bool checker;
    double albedo[2][3]; /* albedo of the diffuse part */
    double period, phase[2], angle_rad;
    double values[KOKSMA__MAX_VALUES]; /* values of the kind's parameters */
    /* the albedo as an image over the surface's coordinates, instead of `albedo`; or NULL */
    koksma_image *image;
    koksma__mapping mapping; /* how the image, or the checker, is mapped to a mesh */
    koksma__map maps[KOKSMA__N_MAPS];
    bool tinted; /* the albedo is multiplied by the vertex colours of a mesh that has them */
    /* see_through: only the fraction alpha of the rays meets the surface; with a cutoff, rays meet it where alpha is
       at least the cutoff */
    bool see_through;
    double alpha, cutoff;
    bool one_sided; /* of meshes: rays from the camera pass through the back, all others meet it */
    /* warnings about a material of a model file; empty if there is none */
    char lost[256]; /* why the texture is ignored */
    char dark[256]; /* why the emission is ignored */
} koksma__material;

/* A homogeneous medium in the box from low to high, which may be infinite; if it is in_shape, only where inverse maps to
   the unit ball, or to the cube from -1 to 1 if it is not is_ball, which the box bounds. Coefficients are per unit of
   length; `phase` is the material of the medium's points: its parameter 0 is the mean cosine g, its albedo the
   single-scattering albedo. */
typedef struct koksma__medium {
    bool is_there;
    double absorption[3], scattering[3];
    double low[3], high[3];
    bool in_shape, is_ball;
    double inverse[12];
    koksma__material phase;
} koksma__medium;

/* A flat light emits on the side to which its normal points. A diffuse surface of albedo a
   under a rectangular light reflects the radiance
       a * power * (mean over the light's area of cos(surface) cos(light) / distance^2),
   power = luminance * area / pi. */
typedef struct koksma__light {
    const struct koksma__light_kind *kind;
    double centre[3], axis_u[3], axis_v[3], normal[3];
    double half[2]; /* half the lengths of the sides; half[0] is the radius of a disk or sphere */
    double power;   /* set for rectangles and disks */
    /* for a point light the intensity, for parallel light the irradiance of a surface that faces the light */
    double radiance[3];
    double values[KOKSMA__MAX_VALUES]; /* values of the kind's parameters */
    bool visible;                      /* camera rays see the light; a flat light or sphere then also has a shape */
    double angle_rad;                  /* rotation of the environment's image about y */
    int placement;                     /* of a mesh */
    bool two_sided;                    /* of a mesh: its back emits as its front does */
    koksma_image *image;               /* the environment's image in latitude and longitude, or NULL */
} koksma__light;

/* The camera ray through film coordinates (x, y), y downwards, has the direction forward + x right + y down; of an
   orthographic camera it starts at eye + x right + y down and has the direction forward. */
typedef struct koksma__camera {
    double eye[3], forward[3], right[3], down[3]; /* unit vectors */
    double shift[2];                              /* film coordinates of the middle of the image */
    double fov_rad;                               /* vertical field of view */
    double height;   /* the height that the image of an orthographic camera shows; 0: the camera is perspective */
    bool by_degrees; /* the scene's file has the angle in degrees */
    /* lens_radius 0: a pinhole; the plane of focus is perpendicular to forward */
    double lens_radius, focus_distance;
    const koksma_warp *lens_map; /* map from the unit square to the lens */
    /* The lens is a regular polygon with this many corners, at lens_radius from its centre, or a disk if blades is 0;
       corner 0 is at this angle from `right` towards up. */
    int blades;
    double blade_angle_rad;
    double
        /* the times when the shutter opens and closes; rays before time 0 see the scene at 0, rays after 1 at 1 */
        shutter[2];
    double motion[3]; /* at time t the eye is eye + t motion */
    /* the camera sees what is between the planes at these distances along `forward`; far_clip 0: no end */
    double near_clip, far_clip;
} koksma__camera;

/* Data that the renderer derives from a scene and that all images of the scene share. They are made, under the lock,
   when they are first needed, and released with the scene. */
typedef struct koksma__scene_cache {
    pthread_mutex_t lock;
    void *made; /* or NULL */
    void (*release)(void *made);
} koksma__scene_cache;

struct koksma_scene {
    uint64_t hash;       /* of the texts, models and meshes; the readers add to it */
    uint64_t files_hash; /* of the images, and of the order of meshes; koksma__scene_hash joins both */
    uint64_t mesh_order; /* hash of the meshes from files, in their order */
    size_t n_mesh_files; /* the number of meshes in mesh_order */
    char title[128];
    int width, height;
    int spp; /* samples a pixel that the sampler of a foreign scene asks for; 0: none */
    koksma__camera camera;
    double background[3]; /* radiance of a ray that hits nothing */
    double ambient[3];    /* ambient light: irradiance / pi, without shadows */
    koksma__medium medium;
    double clamp;      /* samples are clamped to this; infinity: no clamping */
    int path_vertices; /* of path tracing unless options say otherwise: 1 + the most bounces; 0: the integrator decides */
    bool paths;        /* of pbrt and Mitsuba: its integrator follows paths between surfaces */
    bool hides_lights; /* rays from the camera pass through lights that rays hit, and see no environment */
    koksma__material *materials;
    koksma__shape *shapes;
    koksma__light *lights;
    koksma__mesh *meshes;
    koksma__placement *placements; /* of meshes */
    koksma__names mesh_names;      /* finds the meshes of scene files (shapes/shape_compound.c) */
    koksma__file_sizes mesh_files; /* the files that meshes are from */
    uint64_t mesh_bytes;           /* of the meshes from files, as koksma__scene_limit_mesh counts */
    size_t n_materials, n_shapes, n_lights, n_meshes, n_placements;
    bool grey;                /* the scene has no colours: images have one channel */
    bool moves;               /* some part of the scene depends on time */
    bool is_model;            /* the scene is a model file, whose materials were not written for this program */
    koksma__unread unread;    /* unsupported parts of a model file */
    koksma__unknown *unknown; /* unsupported features of another renderer's scene, unknown names in a model's file */
    size_t n_unknown;
    struct koksma__kept_image **images; /* owns all images (render/scene_images.h) */
    size_t n_images;
    uint64_t image_bytes, image_file_bytes; /* what images take or took, and the files that they are from */
    /* the numbers of lights and shapes that model.c added to the scene of a model file, at the ends of `lights` and
       `shapes`; each of these shapes uses one material, and these materials are at the end of `materials` */
    struct {
        size_t lights, shapes;
    } studio;
    size_t n_notes; /* number of `notes`: warnings about a model file, beside those that follow from `unread` */
    char (*notes)[256];
    koksma__scene_cache *cache;
};

/* The hash by which stored studies find the scene. */
static inline uint64_t koksma__scene_hash(const koksma_scene *scene)
{
    return scene->hash ^ scene->files_hash;
}

#endif
