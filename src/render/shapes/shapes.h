/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Shapes: the surfaces that rays hit. A kind of shape is one line of shapes.def, which names its file: its name and
 * parameters in scene files, its definition, its bounds, and the loops that intersect it with a block of rays. Files
 * that include batch_kernel.h are compiled once for each instruction set, and KOKSMA__SHAPE(name) is the entry for the
 * instruction set that is being compiled; in other files it is the entry for `ref`, whose loops those files do not use.
 *
 * tests/render/test_every_shape.c checks every line of the table: hits, normals, bounds and shadows against the
 * definition, all instruction sets against each other, and the geometry with Embree against the geometry without it.
 */
#ifndef KOKSMA_RENDER_SHAPES_SHAPES_H
#define KOKSMA_RENDER_SHAPES_SHAPES_H

#include "render/description.h"
#include "render/fields.h"
#include "render/pipelines/batch.h"

typedef struct koksma__shape_type {
    koksma__kind kind; /* parameters are written to koksma__shape */
    bool is_flat;      /* lies in a plane, within half[0] of the centre along axis_u and half[1] along axis_v */
    bool takes_checker, takes_image;
    bool may_emit; /* the field "emission", instead of "material", makes the shape a light */
    /* NULL, or reads the fields that are not parameters; `name` is the name of the scene file. A compound adds its
       parts to the scene. Errors: those of the fields, of files, and of too many shapes. */
    koksma_status (*parse)(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape);

    /* The members below are NULL for a compound. */

    /* Returns the radius of a sphere about the centre that contains the shape; NULL: the radius is half[0]. Not used
       for flat shapes. */
    double (*radius)(const koksma__shape *shape);
    /* The implicit equation at time 0, with which tests compare the loops: p is on the surface if the result is 0 and
       *beyond <= 0 (*beyond: how far p is beyond the edge, in any unit). The result is positive on the front, to
       which the normal points. */
    double (*equation)(const koksma__shape *shape, const double p[3], double *beyond);

    /* The loops; n as in batch.h. hit: sets t and primitive where the shape is closer than the closest hit so far.
       from: the shape on which each ray starts, where t = 0 does not count as a hit, or -1. */
    void (*hit)(const koksma__batch_shape *s, const koksma__rays *rays, const int32_t *from, int n,
                koksma__hits *hits);
    /* Sets position, normal, coordinates, side and material of the hits on this shape. all: whether every lane hits
       it. NULL for flat shapes: one loop, finish_flat in batch_shapes.c, serves all of them. */
    void (*finish)(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits, bool all);
    /* Sets the light of lanes that the shape blocks to 0; aimed: the shape at which each ray is aimed, which cannot
       block it, or -1. */
    void (*shade)(const koksma__batch_shape *s, const koksma__hits *hits, const int32_t *aimed, int n,
                  koksma__shadows *shadows);
    /* NULL, or hit and finish in one loop, for rays that start on no shape and can hit no other shape; returns the
       number of hits. */
    int (*only)(const koksma__batch_shape *s, const koksma__rays *rays, int n, koksma__hits *hits);
} koksma__shape_type;

#ifdef KOKSMA_ISA
#define KOKSMA__SHAPE(name) KOKSMA__JOIN(koksma__shape_, name, KOKSMA_ISA)
#else
#define KOKSMA__SHAPE(name) koksma__shape_##name##_ref
#endif

/* All kinds of shapes in the order of shapes.def; ends with NULL. */
extern const koksma__shape_type *const koksma__shape_types[];
extern const koksma__kind *const koksma__shape_kinds[];

/* Reads the fields "motion", if has_motion, and "to" of a shape whose centre is set. */
koksma_status koksma__shape_motion(const field *f, bool has_motion, koksma__shape *shape);

/* A parse() for flat shapes: computes the axes from the normal and the field "up", and reads the motion. */
koksma_status koksma__shape_axes(const char *name, const field *f, koksma_scene *scene, koksma__shape *shape);

/* Converts a shape to floats for the loops. id: its index in the scene. */
koksma__batch_shape koksma__batch_shape_of(const koksma__shape *from, int32_t id);

#define SHAPE(name) extern const koksma__shape_type KOKSMA__SHAPE(name);
#define COMPOUND(name) extern const koksma__shape_type koksma__shape_##name;
#include "render/shapes/shapes.def"
#undef SHAPE
#undef COMPOUND

#endif
