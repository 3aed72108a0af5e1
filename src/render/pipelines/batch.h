/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rays in blocks: structures of arrays with KOKSMA__BLOCK lanes, and the table of loops over them, which are compiled
 * once for each instruction set (like the kernels of src/engine/kernels). The loops use only + - * /, square roots,
 * comparisons and floor, each rounded as IEEE 754 prescribes and none fused, so that every instruction set gives the
 * same bits.
 *
 * A loop processes the first n lanes; n is a multiple of KOKSMA__LANE_STEP, and unused lanes hold copies of a used
 * lane.
 */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_H
#define KOKSMA_RENDER_PIPELINES_BATCH_H

#include <koksma/koksma.h>

#include "kernels/kernels.h"

/* A block of 256 rays, their hits and shadow rays take 24 KiB; smaller blocks would need more calls and hold fewer
   pixels. */
enum { KOKSMA__BLOCK = 256, KOKSMA__LANE_STEP = 16 };

/* The kernel `order` uses a full shuffle for up to KOKSMA__SHUFFLED samples, and accepts at most KOKSMA__ORDERED
   samples; koksma__order_words returns how many random words it takes. */
enum { KOKSMA__SHUFFLED = 32, KOKSMA__ORDERED = 1 << 16 };
static inline size_t koksma__order_words(size_t n)
{
    return n <= KOKSMA__SHUFFLED ? (n + 3) / 4 * 4 : 8;
}

typedef float koksma__lanes[KOKSMA__BLOCK];
#define KOKSMA__LANES(type, name) _Alignas(64) type name[KOKSMA__BLOCK]

/* Rays o + t d, t > 0; d need not have length 1. `time` is read only in scenes with motion. */
typedef struct koksma__rays {
    _Alignas(64) koksma__lanes o[3], d[3], time;
} koksma__rays;

/* The closest hits: the position p; the unit normal n on the side of the ray's origin; `back`, which is 1 if the ray
   hit the back (the inside of a sphere, or the side opposite to a flat shape's normal); the coordinates (u, v) on
   flat shapes; and the number of the primitive. primitive is -1 where the ray hit nothing; material is -1 there
   and on lights. `time` is for shadow rays in scenes with motion. */
typedef struct koksma__hits {
    _Alignas(64) koksma__lanes t, p[3], n[3], u, v, time;
    KOKSMA__LANES(int32_t, back);
    KOKSMA__LANES(int32_t, primitive);
    KOKSMA__LANES(int32_t, material);
} koksma__hits;

/* Shadow rays, each along d from the hit (t = 0) to the light (t = 1), with the light that arrives if nothing
   blocks them. aimed[i] is the shape of the light to which ray i goes, which never blocks that ray, or -1; NULL:
   no light has a shape. */
typedef struct koksma__shadows {
    _Alignas(64) koksma__lanes d[3], light;
    const int32_t *aimed;
} koksma__shadows;

/* The t at which a shadow ray ends, just before the light at t = 1. */
#define KOKSMA__SHADOW_END (1 - 0x1p-16f)

/* How to weight light that can be found by light sampling, with density p, and by a ray along a lobe, with density q:
   by one of the heuristics of Veach 1997, section 9.2, or by using only one of the two strategies. */
typedef enum koksma__light_weight {
    KOKSMA__WEIGHT_POWER,   /* p^2 / (p^2 + q^2) */
    KOKSMA__WEIGHT_BALANCE, /* p / (p + q) */
    KOKSMA__WEIGHT_ONE,     /* 1: light sampling alone */
    KOKSMA__WEIGHT_ZERO     /* 0: lobe sampling alone */
} koksma__light_weight;

/* The camera: the ray through film position (x, y) starts at `eye` and has the direction base + x step_x + y
   step_y. The lens, whose points are offsets from its centre in units of its radius, the shutter, and the motion of the
   eye per unit of time are read by `start` alone. */
typedef struct koksma__batch_camera {
    float eye[3], base[3], step_x[3], step_y[3];
    float radius, focus, right[3], down[3], motion[3], open, interval;
} koksma__batch_camera;

/* An analytic shape. half_u and half_v are as in koksma__shape; radius2 is the squared radius of a sphere about the
   centre that contains the shape, if it is not flat. moves: the shape's own loops add time * motion. turns: rays are
   transformed to the frame in which the shape rests, by the members of koksma__shape.turn, but with the angle as a
   fraction of a full turn. */
typedef struct koksma__batch_shape {
    int kind; /* index in koksma__shape_types */
    bool is_flat, moves, turns;
    int32_t id, material;
    float centre[3], motion[3], normal[3], axis_u[3], axis_v[3];
    float half_u, half_v, radius2, inverse_radius;
    float pivot[3], axis[3], angle, growth; /* growth: scale - 1 */
} koksma__batch_shape;

/* Shapes or triangles within a box: a ray that misses the box meets none of them. */
typedef struct koksma__batch_bundle {
    float low[3], high[3];
    size_t first, end; /* in koksma__batch_shapes.order or koksma__batch_faces.faces */
} koksma__batch_bundle;

/* A list of shapes in ascending order of id. */
typedef struct koksma__batch_shapes {
    size_t n;
    const koksma__batch_shape *shapes;
    /* If n_bundles > 0: `order` has the indices of the n_alone shapes in no bundle, then those of each bundle, all
       ascending; `size` is the largest sum of the absolute coordinates of a place in a bundle; and, in a list for
       `closest`, ids are indices. */
    size_t n_bundles, n_alone;
    const koksma__batch_bundle *bundles;
    const uint32_t *order;
    float size;
} koksma__batch_shapes;

/* Triangles that rays hit or on which rays start; lanes without a triangle have primitive -1. */
typedef struct koksma__landings {
    _Alignas(64) koksma__lanes corners[9]; /* 3 c + k: coordinate k of corner c */
    _Alignas(64) koksma__lanes shift[3];   /* displacement by motion */
    _Alignas(64) koksma__lanes u, v, t;    /* u, v: the weights of the corners 1 and 2 */
    KOKSMA__LANES(int32_t, primitive);
    KOKSMA__LANES(int32_t, material);
    KOKSMA__LANES(uint32_t, triangle); /* index of the triangle in its mesh */
} koksma__landings;

/* Triangles of a scene that has so few that every ray tests all of them. The ray o + t d meets the plane at t =
   -normal.e / normal.d with e = o - corner; the weights of the corners 1 and 2 at q = e + t d are across[0].q and
   across[1].q. A weight may be below 0 by slack (size + |e|), more than rounding errors, so that no ray passes between
   two triangles; |e| is the sum of its coordinates without sign. */
typedef struct koksma__batch_face {
    float corner[3], normal[3], across[2][3], slack, size;
    int32_t part; /* index of its placement */
    uint32_t triangle;
} koksma__batch_face;

enum { KOKSMA__MAX_FACES = 64, KOKSMA__BUNDLED_FACES = 6 };

/* Bundles are ascending and have at least KOKSMA__BUNDLED_FACES triangles each; `size` is that of koksma__batch_shapes. */
typedef struct koksma__batch_faces {
    int n, n_bundles;
    float size;
    koksma__batch_face faces[KOKSMA__MAX_FACES];
    koksma__batch_bundle bundles[KOKSMA__MAX_FACES / KOKSMA__BUNDLED_FACES];
} koksma__batch_faces;

/* A material: a constant albedo or a checker. The numbers su to t0 are the rotation, scale and offset of the checker:
   s = su u + sv v + s0, t = tu u + tv v + t0. */
typedef struct koksma__batch_material {
    bool checker;
    float albedo[2], su, sv, s0, tu, tv, t0;
} koksma__batch_material;

/* A rectangular light: the position (x, y) of the unit square is at corner + x edge_x + y edge_y. */
typedef struct koksma__batch_light {
    float corner[3], edge_x[3], edge_y[3], normal[3];
    float power;
} koksma__batch_light;

enum { KOKSMA__MAX_BATCH_LIGHTS = 256 };
typedef float koksma__light_numbers[KOKSMA__MAX_BATCH_LIGHTS];

/* The lights, one in each lane, for choosing a light with a probability proportional to its estimate. The estimate at
   p with normal n is
     fixed + power max(least, n.d / r) max(least, cosine at the light) / r^2,
   or 0 if no part of the light can be seen from p; d is the vector from p to the centre of the light, r = max(|d|,
   reach), and least is 0.05 (batch_lights.c). Distant lights have their direction in `normal` and power 0. */
typedef struct koksma__batch_lights {
    /* n is the number of lights; `whole` is n rounded up to a multiple of KOKSMA__LANE_STEP; the lanes added are dark
       lights */
    int n, whole;
    _Alignas(64) koksma__light_numbers centre[3], normal[3];
    koksma__light_numbers flat;  /* 1 if the light shines only on the side of its normal, 0 if in all directions */
    koksma__light_numbers power; /* power of a light that has a position; 0 for others */
    koksma__light_numbers reach;
    koksma__light_numbers far;   /* irradiance of a directional light on a surface that faces it */
    koksma__light_numbers fixed; /* constant part of the estimate of an environment light */
} koksma__batch_lights;

struct koksma__surfaces;
struct koksma__light_lanes;
struct koksma__beams;
struct koksma__directions;
struct koksma__vertices;
struct koksma__paths;
struct koksma__environment;
struct koksma__medium;

typedef struct koksma__batch_table {
#define KERNEL(result, name, arguments) result(*name) arguments;
#include "render/pipelines/batch.def"
#undef KERNEL
} koksma__batch_table;

/* Returns the table for the instruction set of koksma__kernels(). */
const koksma__batch_table *koksma__batch(void);

/* Returns the table for an instruction set by its name; NULL if this build or machine lacks it. */
const koksma__batch_table *koksma__batch_find(const char *isa);

/* The function name of the kernel `name` in the instruction set that is being compiled, as KERNEL_NAME
   (kernels/kernels.h) names other kernels. */
#define BATCH_NAME(name) KOKSMA__JOIN(koksma__batch_, name, KOKSMA_ISA)

#endif
