/* SPDX-License-Identifier: Apache-2.0 */
/* The interface between the renderer (accel_meshes.c) and the module koksma-embree.so (accel_embree.c). */
#ifndef KOKSMA_RENDER_ACCEL_ACCEL_MESHES_H
#define KOKSMA_RENDER_ACCEL_ACCEL_MESHES_H

#include "render/accel/intersect.h"

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
} koksma__mesh_host;

/* Makes the geometry of the scene's shapes and meshes. Errors: UNSUPPORTED (the module is missing), ARGUMENT, MEMORY,
   SYSTEM. */
koksma_status koksma__accel_meshes(const koksma_scene *scene, koksma__geometry *out);

#endif
