/* SPDX-License-Identifier: Apache-2.0 */
/* Triangle meshes and where they stand. A mesh is in its file's own coordinates; a placement turns, scales and moves
   it, and several placements share one mesh. */
#ifndef KOKSMA_MESHES_MESH_H
#define KOKSMA_MESHES_MESH_H

#include <koksma/koksma.h>

#define KOKSMA__MAX_VERTICES ((size_t)1 << 26)
#define KOKSMA__MAX_TRIANGLES ((size_t)1 << 26) /* of a mesh */

typedef struct koksma__mesh {
    char name[64]; /* for instances; may be empty */
    size_t n_vertices, n_triangles;
    float *vertices;   /* 3 a vertex, and room for one number more, which Embree may read */
    float *normals;    /* 3 a vertex, or NULL */
    float *uvs;        /* 2 a vertex, or NULL */
    float *colours;    /* 3 a vertex, linear, or NULL; whoever wants them makes them after koksma__mesh_init */
    uint32_t *indices; /* 3 a triangle, counterclockwise seen from outside */
    double low[3], high[3];
    size_t n_degenerate; /* triangles without area */
} koksma__mesh;

/* x -> matrix x: three rows of four. At time t everything is t motion further. */
typedef struct koksma__placement {
    int mesh;
    double matrix[12], motion[3];
    double low[3], high[3]; /* a box around it at time 0 */
    int material;           /* -1 for a light's own surface, which reflects nothing */
    int light;              /* the light whose surface this is, or -1 */
    bool smooth;            /* normals are interpolated over the triangles */
} koksma__placement;

/* Room for so many; zeroed but for the sizes. Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__mesh_init(size_t n_vertices, size_t n_triangles, bool normals, bool uvs, koksma__mesh *out);
void koksma__mesh_fini(koksma__mesh *mesh);

/* Looks at what was read: no vertex that is not finite or beyond 1e6, no index out of range, no mesh without a
   triangle of some area; sets the box and n_degenerate, mends normals of no length. Errors: MALFORMED. */
koksma_status koksma__mesh_check(koksma__mesh *mesh);

/* Normals from the triangles around each vertex, weighted by their areas, where the file has none. Errors: MEMORY. */
koksma_status koksma__mesh_smooth(koksma__mesh *mesh);

/* 64-bit hash of its content. */
uint64_t koksma__mesh_hash(const koksma__mesh *mesh);

/* The box around the mesh as it is placed. */
void koksma__placement_box(const koksma__mesh *mesh, koksma__placement *placement);

/* matrix = moved by translate, of what is turned about x, then y, then z, of what is scaled. */
void koksma__placement_matrix(const double translate[3], const double rotate_deg[3], const double scale[3],
                              double matrix[12]);

/* By what normals are multiplied where places are by matrix: the inverse transposed, that is the cofactors over the
   determinant, or rather over a power of 2: the largest is within [0.5, 1). All are 0 where the rank is below 2. */
void koksma__normal_matrix(const double matrix[12], double out[9]);

/* Whether it swaps left and right: then it turns counterclockwise triangles into clockwise ones. */
bool koksma__matrix_mirrors(const double matrix[12]);

/* Whether it maps every body to volume 0 (its determinant vanishes). */
bool koksma__matrix_flattens(const double matrix[12]);

/* Triangle t as it stands, rounded as the renderer has it; its area. */
double koksma__placed_triangle(const koksma__mesh *mesh, const double matrix[12], size_t t, float corners[9]);

/* out = a b, where both have a fourth row 0 0 0 1. */
void koksma__matrix_multiply(const double a[12], const double b[12], double out[12]);

/* What a file has that is not read, by number. */
typedef struct koksma__unread {
    size_t animations, skins;
    size_t vertex_colours;            /* meshes */
    size_t second_uvs;                /* textures by other coordinates than the first */
    size_t morphs, lines;             /* primitives with morph targets; of points or lines */
    size_t too_bright;                /* lights, or materials that glow */
    size_t see_through;               /* materials */
    size_t libraries, materials;      /* material files that are not there; materials that no such file makes */
    char library[256], material[256]; /* the first of each */
    size_t extensions;                /* of the file, which are not read; their names, as far as there is room */
    char extension[256];
} koksma__unread;

#endif
