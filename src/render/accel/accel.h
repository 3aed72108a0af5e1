/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The interface through which the renderer intersects rays with the geometry: of analytic shapes (accel_shapes.c), or
 * of shapes and meshes (accel_meshes.c, by the module koksma-embree.so of accel_embree.c). Primitives are numbered:
 * first the shapes, then the triangles of all placements. A shadow ray starts on primitive hits->primitive and never
 * hits it at t = 0.
 */
#ifndef KOKSMA_RENDER_ACCEL_ACCEL_H
#define KOKSMA_RENDER_ACCEL_ACCEL_H

#include "render/description.h"
#include "render/pipelines/batch.h"

/* The data of a triangle that textures need beside texture coordinates: its index in its mesh, its outward normal,
   the change of position along each texture coordinate (0: it has no texture coordinates), and the interpolated
   vertex colour. */
typedef struct koksma__triangle {
    uint32_t number;
    float normal[3], along_u[3], along_v[3], colour[3];
} koksma__triangle;

typedef struct koksma__geometry {
    void *made;
    /* if the scene has no meshes: all analytic shapes, and the analytic shapes that can block shadow rays; otherwise
       NULL */
    const koksma__batch_shapes *shapes, *occluders;
    /* Finds the closest hits of n rays and returns the number of lanes with a hit. from: the primitive on which each
       ray starts (-1: none), or NULL for rays from the camera, which pass through backs of one-sided meshes. */
    int (*closest)(const struct koksma__geometry *geometry, const koksma__rays *rays, const int32_t *from, int n,
                   koksma__hits *hits);
    /* Sets the light of shadow rays that are blocked to 0; hits->time is the time of each ray. */
    void (*occlude)(const struct koksma__geometry *geometry, const koksma__hits *hits, int n,
                    koksma__shadows *shadows);
    /* If the primitive is part of a light's surface, the index of that light; otherwise -1. */
    int (*light)(const struct koksma__geometry *geometry, int32_t primitive);
    /* Writes the triangle on which p lies at this time to `out`; returns false if the primitive is an analytic shape. */
    bool (*triangle)(const struct koksma__geometry *geometry, int32_t primitive, const float p[3], float time,
                     koksma__triangle *out);
    void (*release)(struct koksma__geometry *geometry);
} koksma__geometry;

/* Makes the geometry of the scene's analytic shapes, without an acceleration structure. Errors: MEMORY. */
koksma_status koksma__accel_shapes(const koksma_scene *scene, koksma__geometry *out);

/* Puts the shapes of a list into bundles where that makes rays cheaper (bundles.c). Both arrays have room for all shapes.
   Errors: MEMORY. */
koksma_status koksma__bundle(koksma__batch_shapes *to, koksma__batch_bundle *bundles, uint32_t *order);

/* ---- The module ------------------------------------------------------------------------------------------------- */

/* Functions that the module provides. */
typedef struct koksma__mesh_functions {
    const char *(*tracer)(void); /* name and version of the ray tracer */
    koksma_status (*make)(const koksma_scene *scene, koksma__geometry *out);
} koksma__mesh_functions;

/* Functions that the renderer provides to the module. */
typedef struct koksma__mesh_host {
    koksma_status (*shapes)(const koksma_scene *scene, koksma__geometry *out); /* koksma__accel_shapes */
    const koksma__batch_table *(*batch)(void);
    void (*normal_matrix)(const double matrix[12], double out[9]);
    void (*placement_at)(const koksma__placement *placement, double t, double matrix[12]);
    bool (*matrix_mirrors)(const double matrix[12]);
    bool (*face)(const float a[3], const float b[3], const float c[3], koksma__batch_face *out); /* koksma__face_of */
} koksma__mesh_host;

/* Prepares the triangle of these corners for rays that test all triangles; returns false if it has no area. */
bool koksma__face_of(const float a[3], const float b[3], const float c[3], koksma__batch_face *out);

/* Makes the geometry of the scene's shapes and meshes. Errors: UNSUPPORTED (the module is missing), ARGUMENT, MEMORY,
   SYSTEM. */
koksma_status koksma__accel_meshes(const koksma_scene *scene, koksma__geometry *out);

#endif
