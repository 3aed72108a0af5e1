/* SPDX-License-Identifier: Apache-2.0 */
/* Triangle meshes and their placements. A mesh is in its file's own coordinates; a placement rotates, scales and
   moves a mesh, and several placements can share one mesh. */
#ifndef KOKSMA_MESHES_MESH_H
#define KOKSMA_MESHES_MESH_H

#include <koksma/koksma.h>

#define KOKSMA__MAX_VERTICES ((size_t)1 << 26)
#define KOKSMA__MAX_TRIANGLES ((size_t)1 << 26) /* of a mesh */

typedef struct koksma__mesh {
    char name[64]; /* the name that instances refer to; may be empty */
    size_t n_vertices, n_triangles;
    float *vertices;   /* 3 for each vertex, and capacity for one number more, which Embree may read */
    float *normals;    /* 3 for each vertex, or NULL */
    float *uvs;        /* 2 for each vertex, or NULL */
    float *colours;    /* 3 for each vertex, linear, or NULL; a reader allocates them after koksma__mesh_init */
    uint32_t *indices; /* 3 for each triangle, counterclockwise seen from outside */
    /* NULL, or 2 numbers for each vertex: those with equal numbers are one vertex in the file (OBJ's position and texture
       vertex), which has become several */
    uint32_t *corners;
    double low[3], high[3];
    size_t n_degenerate; /* triangles without area */
} koksma__mesh;

extern const double koksma__identity_matrix[12];

/* x -> translate + rotation (stretch x), with the rotation as a unit quaternion (w, x, y, z) and the stretch as a
   matrix of three rows. */
typedef struct koksma__pose {
    double translate[3], rotation[4], stretch[9];
} koksma__pose;

/* The map x -> matrix x; the matrix has three rows of four numbers. At time t each position is moved by t * motion;
   or, if steps > 0, the matrix is that of koksma__placement_at at the times i / steps, and linear between them. */
typedef struct koksma__placement {
    int mesh;
    double matrix[12], motion[3];
    int steps;
    koksma__pose poses[2]; /* at the times 0 and 1, if steps > 0 */
    /* matrices that are applied before and after the pose interpolated between `poses` */
    double before[12], after[12];
    double low[3], high[3]; /* a box around the placed mesh at time 0 */
    int material;           /* -1 for a light's own surface, which reflects nothing */
    int light;              /* index of the light, if the mesh is a light's surface; otherwise -1 */
    bool smooth;            /* normals are interpolated over the triangles */
} koksma__placement;

/* Allocates a mesh of this size, zeroed except for the sizes. Errors: MALFORMED (too many), MEMORY. */
koksma_status koksma__mesh_init(size_t n_vertices, size_t n_triangles, bool normals, bool uvs, koksma__mesh *out);
void koksma__mesh_fini(koksma__mesh *mesh);

/* Turns a mesh inside out: swaps two corners of each triangle and inverts the normals. */
void koksma__mesh_flip(koksma__mesh *mesh);

/* Copies the vertices and triangles of a mesh. Call koksma__mesh_fini even after an error. Error: MEMORY. */
koksma_status koksma__mesh_copy(const koksma__mesh *from, koksma__mesh *to);

/* Checks a mesh that was read: every vertex is finite and at most 1e6, every index in range, and at least one
   triangle has an area. Sets the box and n_degenerate, and replaces normals that have no direction. Errors:
   MALFORMED. */
koksma_status koksma__mesh_check(koksma__mesh *mesh);

/* Computes normals for a mesh whose file has none: each is the area-weighted mean of the normals of the triangles
   around the vertex. Errors: MEMORY. */
koksma_status koksma__mesh_smooth(koksma__mesh *mesh);

/* Allocates `corners`. Errors: MEMORY. */
koksma_status koksma__mesh_init_corners(koksma__mesh *mesh);

/* Computes normals for a checked mesh that has none, as Mitsuba does: each is the mean of the normals of the vertex's
   triangles, weighted by their angles at the vertex (Thuermer and Wuethrich 1998). Vertices that the file lists
   separately get separate normals, even at the same position; those with equal `corners` get one. Errors: MEMORY. */
koksma_status koksma__mesh_smooth_by_angles(koksma__mesh *mesh);

/* Whether some normal of a checked mesh differs from that of one of its triangles. */
bool koksma__mesh_is_curved(const koksma__mesh *mesh);

/* 64-bit hash of the mesh's content. */
uint64_t koksma__mesh_hash(const koksma__mesh *mesh);

/* Whether the placed mesh depends on time. */
static inline bool koksma__placement_moves(const koksma__placement *p)
{
    return p->steps || p->motion[0] != 0 || p->motion[1] != 0 || p->motion[2] != 0;
}

/* Sets the placement's box around the placed mesh. */
void koksma__placement_box(const koksma__mesh *mesh, koksma__placement *placement);

/* matrix = translation * rotation * scaling; the rotation is about x first, then y, then z. */
void koksma__placement_matrix(const double translate[3], const double rotate_deg[3], const double scale[3],
                              double matrix[12]);

/* The pose whose matrix koksma__placement_matrix computes from the same arguments. */
koksma__pose koksma__pose_of(const double translate[3], const double rotate_deg[3], const double scale[3]);

/* The matrix of the pose interpolated between two poses, at time t from 0 to 1: translation and stretch are
   interpolated linearly, the rotation along the shortest arc at constant speed (slerp, Shoemake 1985).
   koksma__placement_at multiplies it by the placement's matrices before and after it. */
void koksma__poses_at(const koksma__pose poses[2], double t, double matrix[12]);
void koksma__placement_at(const koksma__placement *placement, double t, double matrix[12]);

/* The pose with this matrix, by the polar decomposition (Shoemake and Duff 1992): the rotation is the nearest to the
   matrix, the stretch is symmetric. Returns false if the matrix has no inverse. */
bool koksma__pose_of_matrix(const double matrix[12], koksma__pose *out);

/* The number of steps, 1 to KOKSMA__MAX_STEPS, for which the rotation in each step is at most 1.5 degrees. With
   matrices that are linear within a step, a point leaves its circle around the axis by at most 1e-4 of the radius. */
enum { KOKSMA__MAX_STEPS = 120 };
int koksma__pose_steps(const koksma__pose poses[2]);

/* The matrix for normals: the cofactors of `matrix`, which are its inverse transpose times its determinant (negative
   for a mirroring matrix), divided by a power of 2 such that the largest is within [0.5, 1). All are 0 if the rank is
   below 2. */
void koksma__normal_matrix(const double matrix[12], double out[9]);

/* Whether the matrix reverses orientation: it then turns counterclockwise triangles into clockwise ones. */
bool koksma__matrix_mirrors(const double matrix[12]);

/* Whether the matrix maps every body to volume 0, that is whether its determinant vanishes. */
bool koksma__matrix_flattens(const double matrix[12]);

/* The corners of triangle t as placed, rounded to floats as in the renderer; returns its area. */
double koksma__placed_triangle(const koksma__mesh *mesh, const double matrix[12], size_t t, float corners[9]);

/* out = a b, where both matrices have an implied fourth row 0 0 0 1. */
void koksma__matrix_multiply(const double a[12], const double b[12], double out[12]);

/* Counts of the parts of a model file that are not supported, for warnings. */
typedef struct koksma__unread {
    size_t animations, skins;
    size_t vertex_colours; /* number of meshes with vertex colours */
    size_t second_uvs;     /* textures that use another set of coordinates than the first texture of their material */
    /* morphs: primitives with morph targets; lines: primitives of points or lines */
    size_t morphs, lines;
    size_t too_bright;           /* lights and emissive materials brighter than a scene allows */
    size_t see_through;          /* materials */
    size_t libraries, materials; /* material files that are missing; materials that no material file defines */
    /* names of the first missing file and of the first undefined material */
    char library[256], material[256];
    /* number of unsupported extensions in use; `extension` lists their names, as many as fit */
    size_t extensions;
    char extension[256];
} koksma__unread;

/* Loop's subdivision (mesh_loop.c): divides a checked mesh `levels` times, moves its vertices to the limit surface and
   gives them normals; the result has 4^levels times as many triangles, and no texture coordinates. out must be zeroed;
   the caller calls koksma__mesh_fini, also after an error. Errors: MALFORMED (too many triangles), MEMORY. */
koksma_status koksma__mesh_loop(const koksma__mesh *mesh, int levels, koksma__mesh *out);

#endif
