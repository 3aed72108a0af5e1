/* SPDX-License-Identifier: Apache-2.0 */
/* Adds the shapes of other renderers' scenes. */
#ifndef KOKSMA_SCENE_IMPORT_SHAPES_H
#define KOKSMA_SCENE_IMPORT_SHAPES_H

#include "scene/import.h"

/* What becomes of a mesh from a file. */
typedef struct koksma__mesh_rules {
    bool facets;  /* its normals are left out */
    bool smooths; /* without normals in the file, it gets those of koksma__mesh_smooth_by_angles() */
    bool flips_v; /* each texture coordinate v becomes 1 - v */
} koksma__mesh_rules;

/* Add a mesh and set *out to its index in the scene, or to -1 if the mesh is left out with a warning.
   koksma__import_mesh takes over the memory of *mesh. koksma__import_mesh_file reads the mesh from a file, each mesh
   only once; `part` is the number of the mesh in a .serialized file, -1 for all its meshes as one. */
koksma_status koksma__import_mesh(koksma__import *im, koksma__text_place place, koksma__mesh *mesh, int *out);
koksma_status koksma__import_mesh_file(koksma__import *im, koksma__text_place place, const char *name, long part,
                                       koksma__mesh_rules rules, int *out);

/* Adds a shape to the scene; `outer`, which may be NULL, is a transformation that is applied after the shape's own
   matrix. If that transformation moves, `poses` has its poses at the times 0 and 1; otherwise `poses` is NULL. */
koksma_status koksma__import_put(koksma__import *im, const koksma__import_item *item, const double outer[12],
                                 const koksma__pose poses[2]);

/* Frees the lists that import_shapes.c keeps for an import. */
void koksma__import_shapes_fini(koksma__import *im);

#endif
