/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the renderer asks of geometry, whoever makes it: analytic shapes (accel_shapes.c), or these and meshes
 * (accel_meshes.c). Primitives: the shapes by their numbers, then the triangles of the placements, one after the
 * other. A shadow ray starts on primitive hits->primitive and never hits it at t = 0.
 */
#ifndef KOKSMA_RENDER_ACCEL_INTERSECT_H
#define KOKSMA_RENDER_ACCEL_INTERSECT_H

#include "render/description.h"
#include "render/pipelines/batch.h"

/* What textures need of a triangle beside texture coordinates: its number in its mesh, its own normal outwards, how
   positions change along its texture coordinates (0: it has none), and the colour of its vertices at a position. */
typedef struct koksma__triangle {
    uint32_t number;
    float normal[3], along_u[3], along_v[3], colour[3];
} koksma__triangle;

typedef struct koksma__geometry {
    void *made;
    const koksma__batch_shapes *shapes; /* the analytic shapes, if the scene has no meshes; else NULL */
    /* The closest hits of n rays; the number of lanes with one. from: the primitive that each ray starts on (-1:
       none), or NULL for rays that start nowhere. */
    int (*closest)(const struct koksma__geometry *geometry, const koksma__rays *rays, const int32_t *from, int n,
                   koksma__hits *hits);
    /* Takes away the light of the shadow rays that meet something; hits->time says when. */
    void (*occlude)(const struct koksma__geometry *geometry, const koksma__hits *hits, int n,
                    koksma__shadows *shadows);
    /* The light whose surface a primitive is, or -1. */
    int (*light)(const struct koksma__geometry *geometry, int32_t primitive);
    /* Of the triangle that p lies on at this time; false: the primitive is an analytic shape. */
    bool (*triangle)(const struct koksma__geometry *geometry, int32_t primitive, const float p[3], float time,
                     koksma__triangle *out);
    void (*release)(struct koksma__geometry *geometry);
} koksma__geometry;

/* The scene's analytic shapes, all tried for every block. Errors: MEMORY. */
koksma_status koksma__accel_shapes(const koksma_scene *scene, koksma__geometry *out);

#endif
