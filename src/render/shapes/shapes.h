/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shapes: what rays meet. A kind of shape is one file, shape_<name>.c, and one line of shapes.def: its name and
 * parameters in scene files, its definition, its bounds, and the loops that intersect it with a block of rays. Files
 * that include flat_loops.h or batch_kernel.h are compiled once for each instruction set, and
 * KOKSMA__SHAPE(name) is the entry of the set that is being compiled; elsewhere it is that of `ref`, whose loops
 * nobody calls from there.
 *
 * tests/render/test_every_shape.c checks every line of the table: hits, normals, bounds and shadows against the
 * definition, all instruction sets against each other, and the geometry with Embree against that without.
 */
#ifndef KOKSMA_RENDER_SHAPES_SHAPES_H
#define KOKSMA_RENDER_SHAPES_SHAPES_H

#include "render/description.h"
#include "render/fields.h"
#include "render/pipelines/batch.h"

typedef struct koksma__shape_type {
    koksma__kind kind; /* parameters are written to koksma__shape */
    bool is_flat;      /* in the plane through centre along axis_u and axis_v, as far as half */
    bool takes_checker, takes_image;
    bool may_emit; /* the field "emission" in place of "material" makes it a light */
    /* NULL, or: reads the fields that are no parameters; name is the scene file's. A compound adds what it is made of
       to the scene. Errors: those of the fields, of files, and of too many shapes. */
    koksma_status (*parse)(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape);

    /* The rest is NULL in a compound. */

    /* The radius of a sphere about the centre that holds the shape; NULL: half[0]. Unused of flat ones. */
    double (*radius)(const koksma__shape *shape);
    /* The definition, at time 0: p is on the surface where the result is 0 and beyond <= 0 (beyond the edge, in any
       unit); the result is > 0 on the front, where the normal leads. Tests compare the loops with it. */
    double (*equation)(const koksma__shape *shape, const double p[3], double *beyond);

    /* The loops; n as in batch.h. hit: sets t and primitive where the shape is closer. from: the shape that each ray
       starts on, or -1: there its t = 0 is no hit. */
    void (*hit)(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,
                koksma__hits *hits);
    /* Position, normal, coordinates, side and material of the hits on this shape; all: every lane hits it. NULL: flat
       shapes, which share a loop. */
    void (*finish)(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits, bool all);
    /* Takes away the light of lanes that the shape blocks; aimed: the shape that each ray goes to and that can't
       block it, or -1. */
    void (*shade)(const koksma__batch_shape *s, const koksma__hits *hits, const int32_t *aimed, int n,
                  koksma__shadows *shadows);
    /* NULL, or: hit and finish in one, for rays that start nowhere and can meet nothing else; the number of hits. */
    int (*only)(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits);
} koksma__shape_type;

/* A shadow ray ends this much short of the light. */
#define KOKSMA__SHADOW_END (1 - 0x1p-16f)

#ifdef KOKSMA_ISA
#define KOKSMA__SHAPE(name) KOKSMA__JOIN(koksma__shape_, name, KOKSMA_ISA)
#else
#define KOKSMA__SHAPE(name) koksma__shape_##name##_ref
#endif

/* All kinds in the order of shapes.def, then NULL. */
extern const koksma__shape_type *const koksma__shape_types[];
extern const koksma__kind *const koksma__shape_kinds[];

/* A parse() of flat shapes: the axes, from the normal and the field "up". */
koksma_status koksma__shape_axes(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape);

/* The shape in floats, as the loops read it. id: its number in the scene. */
koksma__batch_shape koksma__batch_shape_of(const koksma__shape *from, int32_t id);

#define SHAPE(name) extern const koksma__shape_type KOKSMA__SHAPE(name);
#define COMPOUND(name) extern const koksma__shape_type koksma__shape_##name;
#define COMPOUND_OF(name, file) COMPOUND(name)
#include "render/shapes/shapes.def"
#undef SHAPE
#undef COMPOUND
#undef COMPOUND_OF

#endif
