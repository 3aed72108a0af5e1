/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The module koksma-embree.so intersects rays with triangle meshes by Embree 3 or 4 (Wald et al. 2014) and with
 * analytic shapes by the loops of src/render/shapes, and combines the closest hits and the shadows of both. Rays are
 * traced in packets of 16 if the machine supports them, otherwise of 8; a hit's position and normal are computed from
 * its triangle, not from the ray, so that they are as exact as the vertices.
 *
 * Triangles that are transparent to some rays (glTF's alpha), or whose back the camera does not see, are skipped by a
 * filter function, which Embree calls at each hit. The file is long because only one file may include Embree's header.
 *
 * The tree is built by one thread, so that it is the same on every machine; results are equal for any number of
 * threads, but not between versions of Embree or the instruction sets that Embree selects. The floating-point mode is
 * not changed, although Embree recommends that denormals be treated as 0.
 */
#if KOKSMA_EMBREE == 3
#include <embree3/rtcore.h>
#else
#include <embree4/rtcore.h>
#endif
#include <fenv.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "meshes/mesh.h"
#include "modules/module_side.h"
#include "render/accel/accel.h"
#include "render/pipelines/batch.h"
#include "render/scene_images.h"
#include "render/vector3.h"

#define HOST ((const koksma__mesh_host *)koksma__own_host->functions)
#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
#define FROM_CAMERA 1u /* the id of rays that start at the camera, for the filter function */

/* ---- Triangles of placed meshes ----------------------------------------------------------------------------- */

/* A placement, prepared for tracing. The vertices that Embree gets are in world coordinates or, for an instance, in
   the mesh's coordinates. */
typedef struct part {
    const koksma__mesh *mesh;
    float *placed; /* owned by Embree; NULL: the mesh's own vertices are used */
    bool is_instance, smooth, moves;
    float matrix[12], normal_matrix[9], motion[3];
    int steps;         /* if `keys` is set: number of intervals between the times of its matrices; otherwise 0 */
    float (*keys)[12]; /* the matrices of an instance at the times i / steps; they are linear between these times */
    int32_t material, light;
    int32_t first; /* index of its first triangle among all primitives */
    /* its material, if some rays may pass through its triangles; otherwise NULL */
    const koksma__material *see_through;
    /* 0: both sides are seen; otherwise rays from the camera pass through the back, which is where front *
       dot(direction of the ray, normal of the triangle) > 0, in the coordinates of Embree's triangles */
    float front;
} part;

static void place(const float matrix[12], const float v[3], float out[3])
{
    for (int k = 0; k < 3; k++) {
        const float *row = matrix + 4 * k;
        out[k] = row[0] * v[0] + row[1] * v[1] + row[2] * v[2] + row[3];
    }
}

/* The matrix of a part at this time: the stored one, or one that is interpolated into `room`. */
static const float *matrix_at(const part *p, float time, float room[12])
{
    if (!p->steps) {
        return p->matrix;
    }
    const float at = time * (float)p->steps;
    const int step = at < 0 ? 0 : at < (float)p->steps ? (int)at : p->steps - 1;
    const float f = at - (float)step;
    for (int i = 0; i < 12; i++) {
        room[i] = (1 - f) * p->keys[step][i] + f * p->keys[step + 1][i];
    }
    return room;
}

static const float *corner_of(const part *p, uint32_t triangle, int c)
{
    return (p->placed ? p->placed : p->mesh->vertices) +
           3 * (size_t)p->mesh->indices[3 * (size_t)triangle + (size_t)c];
}

/* Prefetches a triangle's indices. Rays hit the triangles of a large mesh in an order that the processor cannot
   predict; therefore the data for a whole block of rays are prefetched before any of them are used. */
static void fetch_triangle(const part *p, uint32_t triangle)
{
    __builtin_prefetch(p->mesh->indices + 3 * (size_t)triangle);
}

/* Prefetches the corners of the triangles hit. At this stage l->primitive[i] is the index of a part, or -1 for no
   hit. */
static void fetch_landings(const part *parts, const koksma__landings *l, int n)
{
    for (int i = 0; i < n; i++) {
        const part *p = l->primitive[i] < 0 ? NULL : &parts[l->primitive[i]];
        for (int c = 0; p && c < 3; c++) {
            __builtin_prefetch(corner_of(p, l->triangle[i], c));
        }
    }
}

/* Copies triangle `triangle` of the part at this time into lane i. */
static void set_lane(const part *p, uint32_t triangle, float time, int i, koksma__landings *l)
{
    float room[12];
    const float *matrix = matrix_at(p, time, room);
    for (int c = 0; c < 3; c++) {
        const float *v = corner_of(p, triangle, c);
        float moved[3];
        if (p->is_instance) {
            place(matrix, v, moved);
            v = moved;
        }
        for (int k = 0; k < 3; k++) {
            l->corners[3 * c + k][i] = v[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        l->shift[k][i] = p->moves ? time * p->motion[k] : 0;
    }
    l->primitive[i] = p->first + (int32_t)triangle;
    l->material[i] = p->material;
}

/* The matrix that transforms the part's normals at this time. */
static const float *normals_at(const part *p, float time, float out[9])
{
    float room[12];
    double matrix[12], normals[9];
    if (!p->steps) {
        return p->normal_matrix;
    }
    const float *now = matrix_at(p, time, room);
    for (int i = 0; i < 12; i++) {
        matrix[i] = (double)now[i];
    }
    HOST->normal_matrix(matrix, normals);
    for (int i = 0; i < 9; i++) {
        out[i] = (float)normals[i];
    }
    return out;
}

/* Interpolates the normals of the vertices; the result is on the same side as the triangle's normal. Returns false if
   the vertices have no normals, or if the result points away from the eye although the triangle faces the eye. A ray
   that a mirror or glass reflects or refracts by an interpolated normal may hit the mesh from which it starts; light
   is lost by such hits: a white octahedron loses .014 of the light as a mirror and .021 as glass (docs/scenes.md). */
static bool smooth_normal(const part *p, const uint32_t *index, float time, const float w[3],
                          const float geometric[3], const float d[3], float out[3])
{
    float n[3] = {0, 0, 0}, turned[9];
    const float *normals = normals_at(p, time, turned);
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 3; k++) {
            n[k] += w[c] * p->mesh->normals[3 * (size_t)index[c] + (size_t)k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const float *row = normals + 3 * k;
        out[k] = row[0] * n[0] + row[1] * n[1] + row[2] * n[2];
    }
    if (!(koksma__dot3(out, out) > 1e-12f)) {
        return false;
    }
    const float side = koksma__dot3(out, geometric) < 0 ? -1.0f : 1.0f;
    for (int k = 0; k < 3; k++) {
        out[k] *= side;
    }
    koksma__unit3(out);
    return koksma__dot3(out, d) < 0;
}

/* The texture coordinates at these weights of the corners of a triangle. */
static void coordinates_at(const koksma__mesh *mesh, const uint32_t *index, const float w[3], float uv[2])
{
    for (int c = 0; c < 3; c++) {
        uv[0] += w[c] * mesh->uvs[2 * (size_t)index[c]];
        uv[1] += w[c] * mesh->uvs[2 * (size_t)index[c] + 1];
    }
}

/* Sets the normal and the texture coordinates of lane i, interpolated between the vertices of its triangle. */
static void refine(const part *p, const koksma__landings *l, const koksma__rays *rays, int i, koksma__hits *hits)
{
    const uint32_t *index = p->mesh->indices + 3 * (size_t)(l->primitive[i] - p->first);
    const float w[3] = {1 - l->u[i] - l->v[i], l->u[i], l->v[i]};
    const float d[3] = {rays->d[0][i], rays->d[1][i], rays->d[2][i]},
                n[3] = {hits->n[0][i], hits->n[1][i], hits->n[2][i]};
    float bent[3];
    const bool bends = p->smooth && smooth_normal(p, index, p->steps ? rays->time[i] : 0, w, n, d, bent);
    for (int k = 0; bends && k < 3; k++) {
        hits->n[k][i] = bent[k];
    }
    if (p->mesh->uvs) {
        float uv[2] = {0, 0};
        coordinates_at(p->mesh, index, w, uv);
        hits->u[i] = uv[0];
        hits->v[i] = uv[1];
    }
}

/* ---- The geometry --------------------------------------------------------------------------------------------- */

typedef struct embree {
    RTCDevice device;
    RTCScene scene, *shared; /* shared[m] is the tree of mesh m, if the mesh has instances */
    koksma__geometry shapes;
    const koksma__batch_table *batch;
    size_t n_parts, n_meshes;
    int32_t n_shapes;
    bool moves, wide;
    koksma__batch_faces few; /* all triangles, if they are few and at rest, in place of the tree; otherwise n = 0 */
    part parts[];
} embree;

static const char *tracer(void)
{
    return "Embree " RTC_VERSION_STRING;
}

/* ---- Rays that start on a triangle --------------------------------------------------------------------------- */

static const part *part_of(const embree *e, int32_t primitive)
{
    size_t low = 0, high = e->n_parts;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (e->parts[middle].first <= primitive) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return &e->parts[low];
}

/* Sets the origins s of n rays, moved off the triangles on which they start. */
static void start(const embree *e, const int32_t *from, const float *times, const koksma__lanes *o,
                  const koksma__lanes *d, int n, koksma__lanes *s)
{
    koksma__landings on;
    int any = 0;
    memcpy(s, o, 3 * sizeof *s);
    for (int i = 0; from && i < n; i++) {
        any |= from[i] >= e->n_shapes;
    }
    if (!any) {
        return;
    }
    memset(on.corners, 0, sizeof on.corners);
    for (int i = 0; i < n; i++) {
        on.primitive[i] = -1;
        if (from[i] >= e->n_shapes) {
            const part *p = part_of(e, from[i]);
            set_lane(p, (uint32_t)(from[i] - p->first), e->moves ? times[i] : 0, i, &on);
        }
    }
    e->batch->step_off(&on, d, n, s);
}

/* ---- Packets ---------------------------------------------------------------------------------------------- */

#if KOKSMA_EMBREE == 3
#define CONTEXT(coherent)                                                                                            \
    struct RTCIntersectContext context;                                                                              \
    rtcInitIntersectContext(&context);                                                                               \
    context.flags = (coherent) ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
#define INTERSECT(width, valid, e, packet) PASTE(rtcIntersect, width)(valid, (e)->scene, &context, packet)
#define OCCLUDED(width, valid, e, packet) PASTE(rtcOccluded, width)(valid, (e)->scene, &context, packet)
#else
#define CONTEXT(coherent)                                                                                            \
    struct RTCIntersectArguments intersect_how;                                                                      \
    struct RTCOccludedArguments occluded_how;                                                                        \
    rtcInitIntersectArguments(&intersect_how);                                                                       \
    rtcInitOccludedArguments(&occluded_how);                                                                         \
    intersect_how.flags = occluded_how.flags =                                                                       \
        (coherent) ? RTC_RAY_QUERY_FLAG_COHERENT : RTC_RAY_QUERY_FLAG_INCOHERENT
#define INTERSECT(width, valid, e, packet) PASTE(rtcIntersect, width)(valid, (e)->scene, packet, &intersect_how)
#define OCCLUDED(width, valid, e, packet) PASTE(rtcOccluded, width)(valid, (e)->scene, packet, &occluded_how)
#endif

/* Defines intersect_8, shade_8, intersect_16 and shade_16, for packets of 8 and of 16 rays. intersect_N traces rays
   start .. start + N - 1 of the block: for each ray with a hit closer than that in `hits`, it writes the part (in
   place of the primitive) and the triangle to `on`; it returns the number of these rays. shade_N sets the light of
   the shadow rays that are blocked to 0. */
#define PACKETS(WIDTH)                                                                                               \
    static int intersect_##WIDTH(const embree *e, const koksma__lanes *s, const koksma__rays *rays, int start,       \
                                 bool from_camera, const koksma__hits *hits, koksma__landings *on)                   \
    {                                                                                                                \
        _Alignas(64) int valid[WIDTH];                                                                               \
        struct RTCRayHit##WIDTH packet;                                                                              \
        int landed = 0;                                                                                              \
        memcpy(packet.ray.org_x, s[0] + start, sizeof packet.ray.org_x);                                             \
        memcpy(packet.ray.org_y, s[1] + start, sizeof packet.ray.org_y);                                             \
        memcpy(packet.ray.org_z, s[2] + start, sizeof packet.ray.org_z);                                             \
        memcpy(packet.ray.dir_x, rays->d[0] + start, sizeof packet.ray.dir_x);                                       \
        memcpy(packet.ray.dir_y, rays->d[1] + start, sizeof packet.ray.dir_y);                                       \
        memcpy(packet.ray.dir_z, rays->d[2] + start, sizeof packet.ray.dir_z);                                       \
        memcpy(packet.ray.tfar, hits->t + start, sizeof packet.ray.tfar);                                            \
        for (int i = 0; i < WIDTH; i++) {                                                                            \
            valid[i] = -1;                                                                                           \
            packet.ray.tnear[i] = 0;                                                                                 \
            packet.ray.mask[i] = ~0u;                                                                                \
            packet.ray.id[i] = from_camera ? FROM_CAMERA : 0;                                                        \
            packet.ray.flags[i] = 0;                                                                                 \
            packet.ray.time[i] = e->moves ? rays->time[start + i] : 0;                                               \
            packet.hit.geomID[i] = packet.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;                                \
        }                                                                                                            \
        CONTEXT(from_camera); /* which are coherent */                                                               \
        INTERSECT(WIDTH, valid, e, &packet);                                                                         \
        memcpy(on->t + start, packet.ray.tfar, sizeof packet.ray.tfar);                                              \
        memcpy(on->u + start, packet.hit.u, sizeof packet.hit.u);                                                    \
        memcpy(on->v + start, packet.hit.v, sizeof packet.hit.v);                                                    \
        memcpy(on->triangle + start, packet.hit.primID, sizeof packet.hit.primID);                                   \
        for (int i = 0; i < WIDTH; i++) {                                                                            \
            const uint32_t instance = packet.hit.instID[0][i], geometry = packet.hit.geomID[i];                      \
            /* RTC_INVALID_GEOMETRY_ID is -1 */                                                                      \
            on->primitive[start + i] = (int32_t)(instance == RTC_INVALID_GEOMETRY_ID ? geometry : instance);         \
            if (geometry != RTC_INVALID_GEOMETRY_ID) {                                                               \
                fetch_triangle(&e->parts[on->primitive[start + i]], packet.hit.primID[i]);                           \
                landed++;                                                                                            \
            }                                                                                                        \
        }                                                                                                            \
        return landed;                                                                                               \
    }                                                                                                                \
                                                                                                                     \
    static void shade_##WIDTH(const embree *e, const koksma__lanes *s, const koksma__hits *hits, int start,          \
                              koksma__shadows *shadows)                                                              \
    {                                                                                                                \
        _Alignas(64) int valid[WIDTH];                                                                               \
        struct RTCRay##WIDTH packet;                                                                                 \
        int any = 0;                                                                                                 \
        for (int i = 0; i < WIDTH; i++) {                                                                            \
            valid[i] = shadows->light[start + i] > 0 ? -1 : 0;                                                       \
            any |= valid[i];                                                                                         \
            packet.tnear[i] = 0;                                                                                     \
            packet.tfar[i] = KOKSMA__SHADOW_END;                                                                     \
            packet.mask[i] = ~0u;                                                                                    \
            packet.id[i] = packet.flags[i] = 0;                                                                      \
            packet.time[i] = e->moves ? hits->time[start + i] : 0;                                                   \
            /* the ray begins at the origin that was moved off the triangle, and ends where it ended before */       \
            packet.dir_x[i] = shadows->d[0][start + i] + (hits->p[0][start + i] - s[0][start + i]);                  \
            packet.dir_y[i] = shadows->d[1][start + i] + (hits->p[1][start + i] - s[1][start + i]);                  \
            packet.dir_z[i] = shadows->d[2][start + i] + (hits->p[2][start + i] - s[2][start + i]);                  \
            packet.org_x[i] = s[0][start + i];                                                                       \
            packet.org_y[i] = s[1][start + i];                                                                       \
            packet.org_z[i] = s[2][start + i];                                                                       \
        }                                                                                                            \
        if (any) {                                                                                                   \
            CONTEXT(false);                                                                                          \
            OCCLUDED(WIDTH, valid, e, &packet);                                                                      \
            for (int i = 0; i < WIDTH; i++) {                                                                        \
                shadows->light[start + i] = valid[i] && packet.tfar[i] < 0 ? 0 : shadows->light[start + i];          \
            }                                                                                                        \
        }                                                                                                            \
    }

PACKETS(8)
PACKETS(16)

static int closest(const koksma__geometry *geometry, const koksma__rays *rays, const int32_t *from, int n,
                   koksma__hits *hits)
{
    const embree *e = geometry->made;
    _Alignas(64) koksma__lanes s[3];
    koksma__landings on;
    int count = e->shapes.closest(&e->shapes, rays, from, n, hits), landed = 0, fine = 0;
    start(e, from, rays->time, rays->o, rays->d, n, s);
    if (e->few.n) {
        landed = e->batch->meet_faces(&e->few, s, rays, hits, n, &on);
    }
    for (int i = 0; !e->few.n && i < n; i += e->wide ? 16 : 8) {
        landed +=
            e->wide ? intersect_16(e, s, rays, i, !from, hits, &on) : intersect_8(e, s, rays, i, !from, hits, &on);
    }
    if (!landed) {
        return count;
    }
    fetch_landings(e->parts, &on, n);
    if (landed < n) {
        memset(on.corners, 0, sizeof on.corners);
    }
    for (int i = 0; i < n; i++) {
        const int32_t number = on.primitive[i]; /* index of a part, which set_lane replaces by the primitive */
        if (number >= 0) {
            count += hits->primitive[i] < 0;
            fine |= e->parts[number].smooth || e->parts[number].mesh->uvs;
            set_lane(&e->parts[number], on.triangle[i], e->moves ? rays->time[i] : 0, i, &on);
        }
    }
    e->batch->land(&on, rays, n, hits);
    for (int i = 0; fine && i < n; i++) {
        if (on.primitive[i] >= 0) {
            refine(part_of(e, on.primitive[i]), &on, rays, i, hits);
        }
    }
    return count;
}

static void occlude(const koksma__geometry *geometry, const koksma__hits *hits, int n, koksma__shadows *shadows)
{
    const embree *e = geometry->made;
    _Alignas(64) koksma__lanes s[3];
    e->shapes.occlude(&e->shapes, hits, n, shadows);
    start(e, hits->primitive, hits->time, hits->p, shadows->d, n, s);
    if (e->few.n) {
        e->batch->shade_faces(&e->few, s, hits, n, shadows);
    }
    for (int i = 0; !e->few.n && i < n; i += e->wide ? 16 : 8) {
        if (e->wide) {
            shade_16(e, s, hits, i, shadows);
        } else {
            shade_8(e, s, hits, i, shadows);
        }
    }
}

static int light_of(const koksma__geometry *geometry, int32_t primitive)
{
    const embree *e = geometry->made;
    return primitive < e->n_shapes ? e->shapes.light(&e->shapes, primitive) : part_of(e, primitive)->light;
}

/* ---- Texture coordinates of triangles ------------------------------------------------------------------------ */

/* The barycentric coordinates of a position in triangle t, computed from the areas of the three parts into which the
   position divides the triangle. */
static void weights_at(const koksma__landings *l, const float edges[2][3], const float p[3], float w[3])
{
    float d[3];
    for (int k = 0; k < 3; k++) {
        d[k] = p[k] - l->corners[k][0] - l->shift[k][0];
    }
    const float aa = koksma__dot3(edges[0], edges[0]), ab = koksma__dot3(edges[0], edges[1]);
    const float bb = koksma__dot3(edges[1], edges[1]), determinant = aa * bb - ab * ab;
    const float da = koksma__dot3(d, edges[0]), db = koksma__dot3(d, edges[1]);
    const float scale = determinant > 0 ? 1 / determinant : 0;
    w[1] = (bb * da - ab * db) * scale;
    w[2] = (aa * db - ab * da) * scale;
    w[0] = 1 - w[1] - w[2];
}

static bool triangle_of(const koksma__geometry *geometry, int32_t primitive, const float p[3], float time,
                        koksma__triangle *out)
{
    const embree *e = geometry->made;
    koksma__landings l;
    float edges[2][3], w[3], turns[2][2] = {{0}};
    if (primitive < e->n_shapes) {
        return false;
    }
    const part *from = part_of(e, primitive);
    const koksma__mesh *mesh = from->mesh;
    *out = (koksma__triangle){.number = (uint32_t)(primitive - from->first)};
    const uint32_t *index = mesh->indices + 3 * (size_t)out->number;
    set_lane(from, out->number, e->moves ? time : 0, 0, &l);
    for (int k = 0; k < 3; k++) {
        edges[0][k] = l.corners[3 + k][0] - l.corners[k][0];
        edges[1][k] = l.corners[6 + k][0] - l.corners[k][0];
    }
    weights_at(&l, (const float(*)[3])edges, p, w);
    for (int c = 0; mesh->uvs && c < 2; c++) {
        for (int k = 0; k < 2; k++) {
            turns[c][k] =
                mesh->uvs[2 * (size_t)index[c + 1] + (size_t)k] - mesh->uvs[2 * (size_t)index[0] + (size_t)k];
        }
    }
    const float area = turns[0][0] * turns[1][1] - turns[1][0] * turns[0][1];
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out->normal[k] = edges[0][i] * edges[1][j] - edges[0][j] * edges[1][i];
        out->along_u[k] = area != 0 ? (turns[1][1] * edges[0][k] - turns[0][1] * edges[1][k]) / area : 0;
        out->along_v[k] = area != 0 ? (turns[0][0] * edges[1][k] - turns[1][0] * edges[0][k]) / area : 0;
        out->colour[k] = 1;
        for (int c = 0; mesh->colours && c < 3; c++) {
            out->colour[k] += (c ? 0 : -1) + w[c] * mesh->colours[3 * (size_t)index[c] + (size_t)k];
        }
    }
    koksma__unit3(out->normal);
    return true;
}

/* Whether triangle t stops a ray that meets it at (u, v). A triangle of alpha 1/2 stops half of the rays; the
   decision is a hash of the position hit, so that it depends on nothing else. */
static bool is_there(const part *p, uint32_t t, float u, float v)
{
    const koksma__material *m = p->see_through;
    const koksma__map *map = &m->maps[KOKSMA__MAP_ALPHA];
    const uint32_t *index = p->mesh->indices + 3 * (size_t)t;
    float alpha[3] = {1, 1, 1};
    if (map->image && p->mesh->uvs) {
        const float w[3] = {1 - u - v, u, v};
        float at[2] = {0, 0};
        coordinates_at(p->mesh, index, w, at);
        koksma__texture(map->image, &map->mapping, at[0], at[1], 1, alpha);
    }
    const float share = alpha[0] * (float)m->alpha;
    uint32_t words[2];
    if (m->cutoff > 0) {
        return share >= (float)m->cutoff;
    }
    memcpy(&words[0], &u, sizeof u);
    memcpy(&words[1], &v, sizeof v);
    uint32_t hash = t * 0x9e3779b9u + words[0];
    for (int round = 0; round < 2; round++) {
        hash = (hash ^ hash >> 16) * 0x7feb352du;
        hash = (hash ^ hash >> 15) * 0x846ca68bu;
        hash ^= hash >> 16;
        hash += round ? 0 : words[1];
    }
    return (float)(hash >> 8) * 0x1p-24f < share;
}

/* Whether ray i of n comes from the camera and meets a back that the camera does not see. */
static bool is_hidden(const part *p, const float *ray, const float *normal, unsigned n, unsigned i)
{
    enum { DIRECTION = 4, ID = 10 };
    const float *d = ray + DIRECTION * n;
    uint32_t id;
    memcpy(&id, ray + ID * n + i, sizeof id);
    return id == FROM_CAMERA &&
           p->front * (d[i] * normal[i] + d[n + i] * normal[n + i] + d[2 * n + i] * normal[2 * n + i]) > 0;
}

/* The filter function that Embree calls. Embree stores n rays as arrays of n numbers: the origin (three arrays), tnear,
   the direction, the time, tfar, the mask, the id and the flags; and their hits likewise: the normal, u, v, the triangle,
   and others. Embree's C interface has no names for these arrays. */
static void pass_by(const struct RTCFilterFunctionNArguments *a)
{
    const part *p = a->geometryUserPtr;
    const float *numbers = (const float *)(const void *)a->hit, *ray = (const float *)(const void *)a->ray;
    for (unsigned i = 0; i < a->N; i++) {
        uint32_t triangle;
        memcpy(&triangle, numbers + 5 * a->N + i, sizeof triangle);
        if (a->valid[i] == -1 &&
            (is_hidden(p, ray, numbers, a->N, i) ||
             (p->see_through && !is_there(p, triangle, numbers[3 * a->N + i], numbers[4 * a->N + i])))) {
            a->valid[i] = 0;
        }
    }
}

/* ---- Building --------------------------------------------------------------------------------------------- */

static void release(koksma__geometry *geometry)
{
    embree *e = geometry->made;
    if (e) {
        for (size_t m = 0; e->shared && m < e->n_meshes; m++) {
            if (e->shared[m]) {
                rtcReleaseScene(e->shared[m]);
            }
        }
        if (e->scene) {
            rtcReleaseScene(e->scene);
        }
        if (e->device) {
            rtcReleaseDevice(e->device);
        }
        if (e->shapes.release) {
            e->shapes.release(&e->shapes);
        }
        for (size_t i = 0; i < e->n_parts; i++) {
            free(e->parts[i].keys);
        }
        free(e->shared);
        free(e);
    }
    *geometry = (koksma__geometry){0};
}

static koksma_status check(const embree *e)
{
    const enum RTCError error = rtcGetDeviceError(e->device);
    return error == RTC_ERROR_NONE            ? KOKSMA_OK
           : error == RTC_ERROR_OUT_OF_MEMORY ? koksma__fail(KOKSMA_MEMORY, "Embree: out of memory")
                                              : koksma__fail(KOKSMA_SYSTEM, "Embree: error %d", (int)error);
}

static part make_part(const koksma_scene *scene, const koksma__placement *from, int32_t first)
{
    part p = {.mesh = &scene->meshes[from->mesh],
              .smooth = from->smooth && scene->meshes[from->mesh].normals,
              .material = from->material,
              .light = from->light,
              .first = first};
    double normals[9];
    const koksma__material *material = from->material < 0 ? NULL : &scene->materials[from->material];
    p.see_through = material && material->see_through ? material : NULL;
    p.front = material && material->one_sided ? 1 : 0;
    HOST->normal_matrix(from->matrix, normals);
    for (int i = 0; i < 12; i++) {
        p.matrix[i] = (float)from->matrix[i];
    }
    for (int i = 0; i < 9; i++) {
        p.normal_matrix[i] = (float)normals[i];
    }
    for (int r = 0; r < 3; r++) {
        p.motion[r] = (float)from->motion[r];
    }
    p.moves = koksma__placement_moves(from);
    p.steps = from->steps;
    return p;
}

/* Makes an Embree geometry from the triangles of a mesh; if `placed`, they are transformed by the part's matrix and
   motion. */
static koksma_status make_triangles(const embree *e, part *p, bool placed, RTCGeometry *out)
{
    const koksma__mesh *m = p->mesh;
    RTCGeometry g = *out = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    if (p->see_through || p->front != 0) {
        rtcSetGeometryUserData(g, p);
        rtcSetGeometryIntersectFilterFunction(g, pass_by);
    }
    if (p->see_through) { /* only alpha lets shadow rays pass, backs block them */
        rtcSetGeometryOccludedFilterFunction(g, pass_by);
    }
    rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, m->indices, 0, 3 * sizeof *m->indices,
                               m->n_triangles);
    if (!placed) {
        rtcSetSharedGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, m->vertices, 0,
                                   3 * sizeof *m->vertices, m->n_vertices);
        rtcCommitGeometry(g);
        return check(e);
    }
    rtcSetGeometryTimeStepCount(g, p->moves ? 2 : 1);
    for (unsigned step = 0; step < (p->moves ? 2u : 1u); step++) {
        float *v =
            rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, 3 * sizeof *v, m->n_vertices);
        if (!v) {
            return check(e);
        }
        p->placed = step ? p->placed : v;
        for (size_t i = 0; i < m->n_vertices; i++) {
            place(p->matrix, m->vertices + 3 * i, v + 3 * i);
            for (size_t k = 0; k < 3; k++) {
                v[3 * i + k] += step ? p->motion[k] : 0;
            }
        }
    }
    rtcCommitGeometry(g);
    return check(e);
}

/* Builds a separate tree of mesh m for its instances. */
static koksma_status make_shared(embree *e, part *p, size_t m)
{
    RTCGeometry g = NULL;
    if (e->shared[m]) {
        return KOKSMA_OK;
    }
    const koksma_status status = make_triangles(e, p, false, &g);
    e->shared[m] = rtcNewScene(e->device);
    rtcSetSceneFlags(e->shared[m], RTC_SCENE_FLAG_ROBUST);
    rtcAttachGeometry(e->shared[m], g);
    rtcReleaseGeometry(g);
    rtcCommitScene(e->shared[m]);
    return status ? status : check(e);
}

static koksma_status make_keys(const koksma__placement *from, part *p)
{
    p->keys = p->steps ? malloc(((size_t)p->steps + 1) * sizeof *p->keys) : NULL;
    if (p->steps && !p->keys) {
        return koksma__fail_memory(((size_t)p->steps + 1) * sizeof *p->keys);
    }
    for (int i = 0; p->steps && i <= p->steps; i++) {
        double matrix[12];
        HOST->placement_at(from, (double)i / p->steps, matrix);
        for (int k = 0; k < 12; k++) {
            p->keys[i][k] = (float)matrix[k];
        }
    }
    return KOKSMA_OK;
}

static koksma_status make_instance(embree *e, const koksma__placement *from, part *p, size_t m, RTCGeometry *out)
{
    const unsigned steps = p->steps ? (unsigned)p->steps : p->moves;
    p->front *= HOST->matrix_mirrors(from->matrix) ? -1.0f : 1.0f;
    KOKSMA__TRY(make_shared(e, p, m));
    KOKSMA__TRY(make_keys(from, p));
    RTCGeometry g = *out = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_INSTANCE);
    p->is_instance = true;
    rtcSetGeometryInstancedScene(g, e->shared[m]);
    rtcSetGeometryTimeStepCount(g, steps + 1);
    for (unsigned step = 0; step <= steps; step++) {
        float rows[12];
        memcpy(rows, p->steps ? p->keys[step] : p->matrix, sizeof rows);
        for (int k = 0; k < 3; k++) {
            rows[4 * k + 3] += step ? p->motion[k] : 0;
        }
        rtcSetGeometryTransform(g, step, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, rows);
    }
    rtcCommitGeometry(g);
    return check(e);
}

/* Whether the scene has few triangles, all at rest and opaque to all rays. */
static bool has_few(const koksma_scene *scene)
{
    size_t total = 0;
    for (size_t i = 0; i < scene->n_placements; i++) {
        const part p = make_part(scene, &scene->placements[i], 0);
        total += p.moves || p.steps || p.see_through || p.front != 0 ? KOKSMA__MAX_FACES + 1 : p.mesh->n_triangles;
    }
    return total <= KOKSMA__MAX_FACES;
}

/* Lists the triangles of part i; returns how far slack lets a ray pass beside them, per distance. */
static float list_part(embree *e, size_t i, koksma__batch_bundle *box)
{
    const part *p = &e->parts[i];
    float beside = 0;
    for (size_t t = 0; t < p->mesh->n_triangles; t++) {
        koksma__batch_face *face = &e->few.faces[e->few.n];
        const float *const corners[3] = {corner_of(p, (uint32_t)t, 0), corner_of(p, (uint32_t)t, 1),
                                         corner_of(p, (uint32_t)t, 2)};
        if (!HOST->face(corners[0], corners[1], corners[2], face)) {
            continue;
        }
        float reach = 0, size = 0;
        for (int k = 0; k < 3; k++) {
            const float x = corners[0][k], y = corners[1][k], z = corners[2][k];
            reach += fabsf(y - x) + fabsf(z - x);
            box->low[k] = fminf(box->low[k], fminf(fminf(x, y), z));
            box->high[k] = fmaxf(box->high[k], fmaxf(fmaxf(x, y), z));
            size += fmaxf(fabsf(box->low[k]), fabsf(box->high[k]));
        }
        e->few.size = fmaxf(e->few.size, size);
        beside = fmaxf(beside, face->slack * reach);
        face->part = (int32_t)i;
        face->triangle = (uint32_t)t;
        e->few.n++;
    }
    return beside;
}

/* Lists all triangles. Those of a part are a bundle, unless they are few, or all, or slivers that rays meet outside. */
static void list_faces(embree *e)
{
    for (size_t i = 0; i < e->n_parts; i++) {
        koksma__batch_bundle box = {
            {INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, (size_t)e->few.n, 0};
        const bool thick = list_part(e, i, &box) < 0x1p-18f;
        box.end = (size_t)e->few.n;
        if (thick && e->n_parts > 1 && box.end - box.first >= KOKSMA__BUNDLED_FACES) {
            e->few.bundles[e->few.n_bundles++] = box;
        }
    }
}

static koksma_status build(const koksma_scene *scene, embree *e)
{
    size_t first = scene->n_shapes;
    const bool few = has_few(scene);
    koksma_status status = check(e);
    int *uses = calloc(scene->n_meshes + 1, sizeof *uses);
    KOKSMA__REQUIRE_MEMORY(uses, scene->n_meshes * sizeof *uses);
    for (size_t i = 0; i < e->n_parts; i++) {
        uses[scene->placements[i].mesh]++;
    }
    for (size_t i = 0; !status && i < e->n_parts; i++) {
        const size_t m = (size_t)scene->placements[i].mesh;
        RTCGeometry g = NULL;
        part *p = &e->parts[i];
        if (first + scene->meshes[m].n_triangles > INT32_MAX) {
            status = koksma__fail(KOKSMA_ARGUMENT, "the scene has more than 2^31 triangles, counting instances");
            break;
        }
        *p = make_part(scene, &scene->placements[i], (int32_t)first);
        e->moves |= p->moves;
        first += scene->meshes[m].n_triangles;
        status = p->steps || (uses[m] > 1 && !p->see_through && !few)
                     ? make_instance(e, &scene->placements[i], p, m, &g)
                     : make_triangles(e, p, true, &g);
        if (g) {
            rtcAttachGeometryByID(e->scene, g, (unsigned)i);
            rtcReleaseGeometry(g);
        }
    }
    free(uses);
    if (!status) {
        rtcCommitScene(e->scene);
        status = check(e);
    }
    if (!status && few) {
        list_faces(e);
    }
    return status;
}

static koksma_status make(const koksma_scene *scene, koksma__geometry *out)
{
    const size_t size = sizeof(embree) + scene->n_placements * sizeof(part);
    embree *e = calloc(1, size);
    *out = (koksma__geometry){e, NULL, NULL, closest, occlude, light_of, triangle_of, release};
    KOKSMA__REQUIRE_MEMORY(e, size);
    fenv_t mode; /* Embree may change the floating-point mode while it builds */
    fegetenv(&mode);
    e->n_parts = scene->n_placements;
    e->n_meshes = scene->n_meshes;
    e->n_shapes = (int32_t)scene->n_shapes;
    e->shared = calloc(scene->n_meshes + 1, sizeof(RTCScene));
    e->batch = HOST->batch();
    e->device = rtcNewDevice("threads=1,set_affinity=0");
    koksma_status status = HOST->shapes(scene, &e->shapes);
    if (!status && (!e->device || !e->shared)) {
        status = koksma__fail(KOKSMA_SYSTEM, "Embree cannot create its device (rtcNewDevice)");
    }
    if (!status) {
        e->wide = rtcGetDeviceProperty(e->device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0;
        e->scene = rtcNewScene(e->device);
        rtcSetSceneFlags(e->scene, RTC_SCENE_FLAG_ROBUST);
        status = build(scene, e);
    }
    fesetenv(&mode);
    if (status) {
        release(out);
    }
    return status;
}

static const koksma__mesh_functions functions = {tracer, make};
KOKSMA__MODULE(functions)
