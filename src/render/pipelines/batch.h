/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Rays in blocks: structures of arrays of BLOCK lanes, and the loops over them, which are compiled once for each
 * instruction set (as the kernels of src/kernels are). Only + - * /, square roots, comparisons and floor are used,
 * each rounded as IEEE 754 says and none fused, so every instruction set gives the same bits.
 *
 * A function works on the first n lanes; n is a multiple of KOKSMA__LANE_STEP, and spare lanes hold copies.
 */
#ifndef KOKSMA_RENDER_PIPELINES_BATCH_H
#define KOKSMA_RENDER_PIPELINES_BATCH_H

#include <koksma/koksma.h>

#include "kernels/kernels.h"

enum { KOKSMA__BLOCK = 64, KOKSMA__LANE_STEP = 16 };

/* How many samples the loop `order` shuffles, and the most that it puts in order; the random words that it takes. */
enum { KOKSMA__SHUFFLED = 32, KOKSMA__ORDERED = 1 << 16 };
static inline size_t koksma__order_words(size_t n)
{
    return n <= KOKSMA__SHUFFLED ? (n + 3) / 4 * 4 : 8;
}

#define KOKSMA__LIGHT_LANES(name) _Alignas(64) float name[KOKSMA__MAX_BATCH_LIGHTS]
#define KOKSMA__LANES(type, name) _Alignas(64) type name[KOKSMA__BLOCK]

/* Rays o + t d, t > 0; d need not have length 1. time is read only where something moves. */
typedef struct koksma__rays {
    KOKSMA__LANES(float, ox);
    KOKSMA__LANES(float, oy);
    KOKSMA__LANES(float, oz);
    KOKSMA__LANES(float, dx);
    KOKSMA__LANES(float, dy);
    KOKSMA__LANES(float, dz);
    KOKSMA__LANES(float, time);
} koksma__rays;

/* The closest hits: position, unit normal towards the ray's origin, whether that is the back (the inside of a
   sphere, the side that a flat shape's normal leads away from), the surface's own coordinates (flat shapes), and
   which primitive of the maker's it is, by its number; primitive is -1 where nothing was hit, material there and on
   lights. time is for shadow rays, where something moves. */
typedef struct koksma__hits {
    KOKSMA__LANES(float, t);
    KOKSMA__LANES(float, px);
    KOKSMA__LANES(float, py);
    KOKSMA__LANES(float, pz);
    KOKSMA__LANES(float, nx);
    KOKSMA__LANES(float, ny);
    KOKSMA__LANES(float, nz);
    KOKSMA__LANES(float, u);
    KOKSMA__LANES(float, v);
    KOKSMA__LANES(float, time);
    KOKSMA__LANES(int32_t, back);
    KOKSMA__LANES(int32_t, primitive);
    KOKSMA__LANES(int32_t, material);
} koksma__hits;

/* Light that would come to the hits along d (from the hit at t = 0 to the light at t = 1) were nothing between.
   aimed[i]: the shape that is the light's own surface, which never shades it, or -1; NULL: no ray has one. */
typedef struct koksma__shadows {
    KOKSMA__LANES(float, dx);
    KOKSMA__LANES(float, dy);
    KOKSMA__LANES(float, dz);
    KOKSMA__LANES(float, light);
    const int32_t *aimed;
} koksma__shadows;

/* How the light of a sampled direction counts that a ray along a lobe could find too, of density p by sampling and q by
   the lobe: the heuristics of Veach 1997, section 9.2, and one strategy alone. */
typedef enum koksma__light_weight {
    KOKSMA__WEIGHT_POWER,   /* p^2 / (p^2 + q^2) */
    KOKSMA__WEIGHT_BALANCE, /* p / (p + q) */
    KOKSMA__WEIGHT_ONE,     /* sampling lights alone */
    KOKSMA__WEIGHT_ZERO     /* sampling lobes alone */
} koksma__light_weight;

/* Direction of film position (x, y): base + x step_x + y step_y. */
typedef struct koksma__batch_camera {
    float eye[3], base[3], step_x[3], step_y[3];
} koksma__batch_camera;

/* half as in koksma__shape; radius2: of a sphere about the centre that holds a shape that isn't flat. */
typedef struct koksma__batch_shape {
    int kind; /* index in koksma__shape_types */
    bool is_flat, moves;
    int32_t id, material;
    float centre[3], motion[3], normal[3], axis_u[3], axis_v[3];
    float half_u, half_v, radius2, inverse_radius;
} koksma__batch_shape;

/* Ids ascend. */
typedef struct koksma__batch_shapes {
    size_t n;
    const koksma__batch_shape *shapes;
} koksma__batch_shapes;

/* Triangles that rays met, or that they start on; lanes with primitive -1 have none. */
typedef struct koksma__landings {
    _Alignas(64) float corners[9][KOKSMA__BLOCK]; /* 3 c + k: coordinate k of corner c */
    _Alignas(64) float shift[3][KOKSMA__BLOCK];   /* by their motion */
    KOKSMA__LANES(float, u);                      /* weight of corner 1 */
    KOKSMA__LANES(float, v);                      /* of corner 2 */
    KOKSMA__LANES(float, t);
    KOKSMA__LANES(int32_t, primitive);
    KOKSMA__LANES(int32_t, material);
    KOKSMA__LANES(uint32_t, triangle); /* its number in its mesh */
} koksma__landings;

/* A checker's turn and scale as a matrix: s = su u + sv v + s0, t = tu u + tv v + t0. */
typedef struct koksma__batch_material {
    bool checker;
    float albedo[2], su, sv, s0, tu, tv, t0;
} koksma__batch_material;

/* A position on the light: corner + x edge_x + y edge_y, (x, y) in the unit square. */
typedef struct koksma__batch_light {
    float corner[3], edge_x[3], edge_y[3], normal[3];
    float power;
} koksma__batch_light;

enum { KOKSMA__MAX_BATCH_LIGHTS = 256 };

/* Lights for choosing one, in lanes: the estimate is
     fixed + power max(least, n.d / r) max(least, cosine at the light) / r^2,  0 when all of it is out of sight,
   with d from p to the centre and r = max(|d|, reach). Those far away have their direction in (nx, ny, nz) and power
   0. */
typedef struct koksma__batch_lights {
    int n, whole; /* of them; up to whole lanes, the rest being dark */
    KOKSMA__LIGHT_LANES(cx);
    KOKSMA__LIGHT_LANES(cy);
    KOKSMA__LIGHT_LANES(cz);
    KOKSMA__LIGHT_LANES(nx);
    KOKSMA__LIGHT_LANES(ny);
    KOKSMA__LIGHT_LANES(nz);
    KOKSMA__LIGHT_LANES(flat);  /* 1: it shines along its normal, 0: all around */
    KOKSMA__LIGHT_LANES(power); /* of those that have a position */
    KOKSMA__LIGHT_LANES(reach);
    KOKSMA__LIGHT_LANES(far);   /* irradiance of a directional one on a surface that faces it */
    KOKSMA__LIGHT_LANES(fixed); /* of an environment */
} koksma__batch_lights;

struct koksma__surfaces;
struct koksma__light_lanes;
struct koksma__beams;
struct koksma__directions;
struct koksma__lens;
struct koksma__vertices;
struct koksma__paths;
struct koksma__environment;

typedef struct koksma__batch_table {
#define KERNEL(result, name, arguments) result(*name) arguments;
#include "render/pipelines/batch.def"
#undef KERNEL
} koksma__batch_table;

/* The table for the instruction set of koksma__kernels(). */
const koksma__batch_table *koksma__batch(void);

/* By the name of the instruction set; NULL if this build or machine has none. */
const koksma__batch_table *koksma__batch_find(const char *isa);

/* The name of function `name` of this table in the instruction set that is being compiled, as KERNEL_NAME. */
#define BATCH_NAME(name) KOKSMA__JOIN(koksma__batch_, name, KOKSMA_ISA)

#endif
