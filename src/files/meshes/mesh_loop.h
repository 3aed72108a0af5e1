/* SPDX-License-Identifier: Apache-2.0 */
/* Loop's subdivision of triangle meshes. */
#ifndef KOKSMA_MESHES_MESH_LOOP_H
#define KOKSMA_MESHES_MESH_LOOP_H

#include "meshes/mesh.h"

/* Divides a checked mesh `levels` times, moves its vertices to the limit surface and gives them normals; the result has
   4^levels times as many triangles, and no texture coordinates. out must be zeroed; the caller calls koksma__mesh_fini,
   also after an error. Errors: MALFORMED (too many triangles), MEMORY. */
koksma_status koksma__mesh_loop(const koksma__mesh *mesh, int levels, koksma__mesh *out);

#endif
