/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Triangle meshes: allocation, checks, smooth normals and hashes; and the matrices of placements. A vertex's smooth
 * normal is the sum of the vector areas of the triangles around its position, which sorting finds in linear time.
 */
#include "meshes/mesh.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/hash.h"
#include "core/status.h"
#include "core/vector.h"

#define FAR 1e6

const double koksma__identity_matrix[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

koksma_status koksma__mesh_init(size_t n_vertices, size_t n_triangles, bool normals, bool uvs, koksma__mesh *out)
{
    KOKSMA__FAIL_IF(n_vertices > KOKSMA__MAX_VERTICES || n_triangles > KOKSMA__MAX_TRIANGLES, KOKSMA_MALFORMED,
                    "%zu vertices and %zu triangles: a mesh has at most %zu of each", n_vertices, n_triangles,
                    KOKSMA__MAX_TRIANGLES);
    out->n_vertices = n_vertices;
    out->n_triangles = n_triangles;
    out->vertices = calloc(3 * n_vertices + 1, sizeof *out->vertices);
    out->indices = calloc(3 * n_triangles + 1, sizeof *out->indices);
    out->normals = normals ? calloc(3 * n_vertices + 1, sizeof *out->normals) : NULL;
    out->uvs = uvs ? calloc(2 * n_vertices + 1, sizeof *out->uvs) : NULL;
    if (!out->vertices || !out->indices || (normals && !out->normals) || (uvs && !out->uvs)) {
        return koksma__fail_memory((8 * n_vertices + 3 * n_triangles) * sizeof(float));
    }
    return KOKSMA_OK;
}

koksma_status koksma__mesh_init_corners(koksma__mesh *mesh)
{
    mesh->corners = calloc(2 * mesh->n_vertices + 1, sizeof *mesh->corners);
    return mesh->corners ? KOKSMA_OK : koksma__fail_memory(2 * mesh->n_vertices * sizeof *mesh->corners);
}

void koksma__mesh_fini(koksma__mesh *mesh)
{
    KOKSMA__FREE(mesh->vertices, mesh->normals, mesh->uvs, mesh->colours, mesh->indices, mesh->corners);
    *mesh = (koksma__mesh){0};
}

void koksma__mesh_flip(koksma__mesh *mesh)
{
    for (size_t t = 0; t < mesh->n_triangles; t++) {
        const uint32_t second = mesh->indices[3 * t + 1];
        mesh->indices[3 * t + 1] = mesh->indices[3 * t + 2];
        mesh->indices[3 * t + 2] = second;
    }
    for (size_t i = 0; mesh->normals && i < 3 * mesh->n_vertices; i++) {
        mesh->normals[i] = 0 - mesh->normals[i];
    }
}

koksma_status koksma__mesh_copy(const koksma__mesh *from, koksma__mesh *to)
{
    KOKSMA__TRY(koksma__mesh_init(from->n_vertices, from->n_triangles, from->normals != NULL, from->uvs != NULL, to));
    memcpy(to->vertices, from->vertices, 3 * from->n_vertices * sizeof *to->vertices);
    memcpy(to->indices, from->indices, 3 * from->n_triangles * sizeof *to->indices);
    if (from->normals) {
        memcpy(to->normals, from->normals, 3 * from->n_vertices * sizeof *to->normals);
    }
    if (from->uvs) {
        memcpy(to->uvs, from->uvs, 2 * from->n_vertices * sizeof *to->uvs);
    }
    if (from->colours) {
        to->colours = malloc(3 * from->n_vertices * sizeof *to->colours);
        KOKSMA__REQUIRE_MEMORY(to->colours, 3 * from->n_vertices * sizeof *to->colours);
        memcpy(to->colours, from->colours, 3 * from->n_vertices * sizeof *to->colours);
    }
    return KOKSMA_OK;
}

/* Twice the vector area of triangle t: its length is twice the area, its direction the normal. */
static void twice_area(const koksma__mesh *m, size_t t, double out[3])
{
    double corners[3][3], a[3], b[3];
    for (size_t c = 0; c < 3; c++) {
        for (size_t k = 0; k < 3; k++) {
            corners[c][k] = (double)m->vertices[3 * m->indices[3 * t + c] + k];
        }
    }
    koksma__subtract(corners[1], corners[0], a);
    koksma__subtract(corners[2], corners[0], b);
    koksma__cross(a, b, out);
}

static koksma_status check_vertices(koksma__mesh *m)
{
    float low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (size_t i = 0; i < m->n_vertices; i++) {
        for (size_t k = 0; k < 3; k++) {
            /* turns -0 into 0, so that equal positions have equal bits */
            const float x = m->vertices[3 * i + k] += 0.0f;
            KOKSMA__FAIL_IF(!(fabsf(x) <= (float)FAR), KOKSMA_MALFORMED,
                            "vertex %zu has a coordinate of %g: it must be -1e6 to 1e6", i, (double)x);
            low[k] = x < low[k] ? x : low[k];
            high[k] = x > high[k] ? x : high[k];
        }
    }
    for (size_t k = 0; k < 3; k++) {
        m->low[k] = (double)low[k];
        m->high[k] = (double)high[k];
    }
    for (size_t i = 0; m->uvs && i < 2 * m->n_vertices; i++) {
        KOKSMA__FAIL_IF(!(fabs((double)m->uvs[i]) <= FAR), KOKSMA_MALFORMED,
                        "vertex %zu has a texture coordinate of %g", i / 2, (double)m->uvs[i]);
    }
    for (size_t i = 0; m->colours && i < 3 * m->n_vertices; i++) {
        m->colours[i] = m->colours[i] > 0 ? fminf(m->colours[i], 1) : 0;
    }
    for (size_t i = 0; m->normals && i < m->n_vertices; i++) {
        float *n = m->normals + 3 * i;
        double v[3] = {(double)n[0], (double)n[1], (double)n[2]};
        const bool whole = isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]) && koksma__normalise(v);
        for (size_t k = 0; k < 3; k++) {
            n[k] = whole ? (float)v[k] + 0.0f : 0; /* a normal of 0 means that the triangle's normal is used */
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__mesh_check(koksma__mesh *m)
{
    KOKSMA__FAIL_IF(!m->n_triangles, KOKSMA_MALFORMED, "no triangles");
    const koksma_status status = check_vertices(m);
    for (size_t i = 0; !status && i < 3 * m->n_triangles; i++) {
        KOKSMA__FAIL_IF(m->indices[i] >= m->n_vertices, KOKSMA_MALFORMED,
                        "triangle %zu names a vertex that does not exist: there are %zu", i / 3, m->n_vertices);
    }
    m->n_degenerate = 0;
    for (size_t t = 0; !status && t < m->n_triangles; t++) {
        double area[3];
        twice_area(m, t, area);
        m->n_degenerate += !(koksma__dot(area, area) > 0);
    }
    KOKSMA__FAIL_IF(!status && m->n_degenerate == m->n_triangles, KOKSMA_MALFORMED, "no triangle has any area");
    return status;
}

/* Number `word` of a vertex's key: of its position, with the same bits for 0 and -0, or, if by_corner, of its `corners`. */
static uint32_t key_word(const koksma__mesh *m, bool by_corner, size_t vertex, size_t word)
{
    if (by_corner) {
        return m->corners[2 * vertex + word];
    }
    const float x = m->vertices[3 * vertex + word] + 0.0f;
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static size_t byte_of(const koksma__mesh *m, bool by_corner, size_t vertex, size_t digit)
{
    return key_word(m, by_corner, vertex, digit / 4) >> 8 * (digit % 4) & 255;
}

static bool same_key(const koksma__mesh *m, bool by_corner, size_t a, size_t b)
{
    bool same = true;
    for (size_t word = 0; word < (by_corner ? 2 : 3); word++) {
        same &= key_word(m, by_corner, a, word) == key_word(m, by_corner, b, word);
    }
    return same;
}

/* For each vertex the first vertex with the same key: files repeat positions where textures have seams, and readers what
   several triangles share. They are sorted by the bytes of their keys, which takes as long for any keys; a hash table
   would take the square of that for keys that are chosen so that their hashes agree. Returns NULL when memory runs out;
   the caller frees the result. */
static uint32_t *first_alike(const koksma__mesh *m, bool by_corner)
{
    const size_t n = m->n_vertices;
    uint32_t *order = malloc((n + 1) * sizeof *order), *other = malloc((n + 1) * sizeof *other);
    if (!order || !other) {
        free(order);
        free(other);
        return NULL;
    }
    for (size_t i = 0; i < n; i++) {
        order[i] = (uint32_t)i;
    }
    for (size_t digit = 0; digit < (by_corner ? 8 : 12); digit++) {
        size_t starts[257] = {0};
        for (size_t i = 0; i < n; i++) {
            starts[byte_of(m, by_corner, i, digit) + 1]++;
        }
        if (n && starts[byte_of(m, by_corner, 0, digit) + 1] == n) {
            continue; /* the byte is equal everywhere */
        }
        for (size_t b = 1; b < 257; b++) {
            starts[b] += starts[b - 1];
        }
        for (size_t i = 0; i < n; i++) {
            other[starts[byte_of(m, by_corner, order[i], digit)]++] = order[i];
        }
        uint32_t *const sorted = other;
        other = order;
        order = sorted;
    }
    for (size_t i = 0; i < n; i++) { /* vertices with one key are in the order of the file */
        other[order[i]] = i && same_key(m, by_corner, order[i], order[i - 1]) ? other[order[i - 1]] : order[i];
    }
    free(order);
    return other;
}

/* The angle of triangle t at corner c, and 0 for a triangle without area. */
static double corner_angle(const koksma__mesh *m, size_t t, size_t c)
{
    double sides[2][3];
    for (size_t k = 0; k < 6; k++) {
        const uint32_t *corners = m->indices + 3 * t;
        sides[k / 3][k % 3] = (double)m->vertices[3 * corners[(c + 1 + k / 3) % 3] + k % 3] -
                              (double)m->vertices[3 * corners[c] + k % 3];
    }
    double across[3];
    koksma__cross(sides[0], sides[1], across);
    return koksma__atan2(sqrt(koksma__dot(across, across)), koksma__dot(sides[0], sides[1]));
}

/* Gives each vertex the sum of its triangles' normals, weighted by their areas or by their angles at the vertex: of all
   triangles at its position, or by angles of those at its corner in the file. */
static koksma_status smooth(koksma__mesh *m, bool by_angles)
{
    const bool joins = !by_angles || m->corners;
    double *sums = calloc(3 * m->n_vertices + 1, sizeof *sums);
    uint32_t *first = joins ? first_alike(m, by_angles) : NULL;
    m->normals = calloc(3 * m->n_vertices + 1, sizeof *m->normals);
    if (!sums || !m->normals || (joins && !first)) {
        KOKSMA__FREE(sums, first);
        return koksma__fail_memory(3 * m->n_vertices * sizeof *sums);
    }
    for (size_t t = 0; t < m->n_triangles; t++) {
        double normal[3];
        twice_area(m, t, normal);
        const bool counts = !by_angles || koksma__normalise(normal);
        for (size_t c = 0; counts && c < 3; c++) {
            const double weight = by_angles ? corner_angle(m, t, c) : 1;
            const size_t vertex = m->indices[3 * t + c], at = first ? first[vertex] : vertex;
            for (size_t k = 0; k < 3; k++) {
                sums[3 * at + k] += weight * normal[k];
            }
        }
    }
    for (size_t i = 0; i < m->n_vertices; i++) {
        const size_t at = first ? first[i] : i; /* at most i, so that those of `at` are made */
        double *n = sums + 3 * i;
        const double length = sqrt(koksma__dot(n, n));
        const bool has_direction = at == i && (by_angles ? koksma__normalise(n) : length > 0);
        for (size_t k = 0; k < 3; k++) {
            m->normals[3 * i + k] = at < i           ? m->normals[3 * at + k]
                                    : !has_direction ? 0
                                                     : (float)(by_angles ? n[k] : n[k] / length);
        }
    }
    KOKSMA__FREE(sums, first);
    return KOKSMA_OK;
}

koksma_status koksma__mesh_smooth(koksma__mesh *m)
{
    return m->normals ? KOKSMA_OK : smooth(m, false);
}

koksma_status koksma__mesh_smooth_by_angles(koksma__mesh *m)
{
    return smooth(m, true);
}

bool koksma__mesh_is_curved(const koksma__mesh *m)
{
    bool curved = false;
    for (size_t t = 0; m->normals && !curved && t < m->n_triangles; t++) {
        double normal[3];
        twice_area(m, t, normal);
        const bool has_area = koksma__normalise(normal);
        for (size_t i = 0; has_area && i < 9; i++) {
            curved |= fabs((double)m->normals[3 * m->indices[3 * t + i / 3] + i % 3] - normal[i % 3]) > 1e-3;
        }
    }
    return curved;
}

uint64_t koksma__mesh_hash(const koksma__mesh *m)
{
    const void *const arrays[4] = {m->vertices, m->indices, m->normals, m->uvs};
    const size_t sizes[4] = {3 * m->n_vertices * sizeof *m->vertices, 3 * m->n_triangles * sizeof *m->indices,
                             m->normals ? 3 * m->n_vertices * sizeof *m->normals : 0,
                             m->uvs ? 2 * m->n_vertices * sizeof *m->uvs : 0};
    uint64_t parts[4];
    koksma__hash_four(arrays, sizes, parts);
    parts[2] = m->normals ? parts[2] : 0;
    parts[3] = m->uvs ? parts[3] : 0;
    return koksma__hash(parts, sizeof parts);
}

void koksma__placement_box(const koksma__mesh *mesh, koksma__placement *placement)
{
    for (int k = 0; k < 3; k++) {
        const double *row = placement->matrix + 4 * k;
        placement->low[k] = placement->high[k] = row[3];
        for (int j = 0; j < 3; j++) {
            const double a = row[j] * mesh->low[j], b = row[j] * mesh->high[j];
            placement->low[k] += fmin(a, b);
            placement->high[k] += fmax(a, b);
        }
    }
}

void koksma__placement_matrix(const double translate[3], const double rotate_deg[3], const double scale[3],
                              double matrix[12])
{
    const double to_rad = M_PI / 180;
    const double cx = koksma__cos(rotate_deg[0] * to_rad), sx = koksma__sin(rotate_deg[0] * to_rad);
    const double cy = koksma__cos(rotate_deg[1] * to_rad), sy = koksma__sin(rotate_deg[1] * to_rad);
    const double cz = koksma__cos(rotate_deg[2] * to_rad), sz = koksma__sin(rotate_deg[2] * to_rad);
    const double turn[9] = {cz * cy,
                            cz * sy * sx - sz * cx,
                            cz * sy * cx + sz * sx,
                            sz * cy,
                            sz * sy * sx + cz * cx,
                            sz * sy * cx - cz * sx,
                            -sy,
                            cy * sx,
                            cy * cx};
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            matrix[4 * k + j] = turn[3 * k + j] * scale[j];
        }
        matrix[4 * k + 3] = translate[k];
    }
}

koksma__pose koksma__pose_of(const double translate[3], const double rotate_deg[3], const double scale[3])
{
    koksma__pose p = {.rotation = {1, 0, 0, 0}};
    for (int k = 0; k < 3; k++) { /* the product q = z y x rotates about x first */
        const double half = rotate_deg[k] * M_PI / 360, c = koksma__cos(half), s = koksma__sin(half), *q = p.rotation;
        const int i = 1 + (k + 1) % 3, j = 1 + (k + 2) % 3;
        double out[4];
        out[0] = c * q[0] - s * q[1 + k];
        out[1 + k] = c * q[1 + k] + s * q[0];
        out[i] = c * q[i] - s * q[j];
        out[j] = c * q[j] + s * q[i];
        memcpy(p.rotation, out, sizeof out);
        p.translate[k] = translate[k];
        p.stretch[4 * k] = scale[k];
    }
    return p;
}

/* The unit quaternion of a rotation. The largest of its components is found first, so that none is divided by a small
   number (Shepperd 1978). */
static void quaternion_of(const double m[9], double q[4])
{
    const double trace = m[0] + m[4] + m[8], squares[4] = {trace, m[0], m[4], m[8]};
    int largest = 0;
    for (int i = 1; i < 4; i++) {
        largest = squares[i] > squares[largest] ? i : largest;
    }
    const double most = sqrt(fmax(largest ? 1 + 2 * squares[largest] - trace : 1 + trace, 0)) / 2;
    const double from_w[3] = {m[7] - m[5], m[2] - m[6], m[3] - m[1]};
    q[largest] = most;
    for (int k = 0; k < 3; k++) {
        if (!largest) {
            q[1 + k] = from_w[k] / (4 * most);
        } else if (k == largest - 1) {
            q[0] = from_w[k] / (4 * most);
        } else {
            q[1 + k] = (m[3 * k + largest - 1] + m[3 * (largest - 1) + k]) / (4 * most);
        }
    }
}

bool koksma__pose_of_matrix(const double matrix[12], koksma__pose *out)
{
    double m[9], q[9], c[9], change = 1;
    for (int i = 0; i < 9; i++) {
        q[i] = m[i] = matrix[i / 3 * 4 + i % 3];
    }
    const bool mirrors = koksma__cofactors(m, c) < 0;
    for (int i = 0; i < 9; i++) { /* if m mirrors, the orthogonal matrix nearest to -m is a rotation */
        q[i] = mirrors ? -q[i] : q[i];
    }
    for (int round = 0; round < 100 && change > 1e-14; round++) { /* Q <- (Q + transpose of its inverse) / 2 */
        const double determinant = koksma__cofactors(q, c);
        if (!isnormal(determinant)) {
            return false;
        }
        change = 0;
        for (int i = 0; i < 9; i++) {
            const double next = (q[i] + c[i] / determinant) / 2;
            change = fmax(change, fabs(next - q[i]));
            q[i] = next;
        }
    }
    quaternion_of(q, out->rotation);
    for (int i = 0; i < 9; i++) {
        out->stretch[i] = q[i / 3] * m[i % 3] + q[3 + i / 3] * m[3 + i % 3] + q[6 + i / 3] * m[6 + i % 3];
    }
    for (int k = 0; k < 3; k++) {
        out->translate[k] = matrix[4 * k + 3];
    }
    return change <= 1e-14;
}

/* The angle between two unit quaternions along the shorter arc, which is half the angle of the rotation from one to
   the other; *sign is -1 if the second quaternion must be negated for the shorter arc. */
static double arc(const koksma__pose poses[2], double *sign)
{
    const double *a = poses[0].rotation, *b = poses[1].rotation;
    const double dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    double difference = 0, sum = 0;
    *sign = dot < 0 ? -1 : 1;
    for (int i = 0; i < 4; i++) {
        difference += (a[i] - *sign * b[i]) * (a[i] - *sign * b[i]);
        sum += (a[i] + *sign * b[i]) * (a[i] + *sign * b[i]);
    }
    return 2 * koksma__atan2(sqrt(difference), sqrt(sum));
}

void koksma__poses_at(const koksma__pose poses[2], double t, double m[12])
{
    double sign, q[4], length = 0;
    const double angle = arc(poses, &sign), whole = koksma__sin(angle);
    const double first = whole > 1e-9 ? koksma__sin((1 - t) * angle) / whole : 1 - t;
    const double second = sign * (whole > 1e-9 ? koksma__sin(t * angle) / whole : t);
    for (int i = 0; i < 4; i++) {
        q[i] = first * poses[0].rotation[i] + second * poses[1].rotation[i];
        length += q[i] * q[i];
    }
    for (int i = 0; i < 4; i++) {
        q[i] /= sqrt(length);
    }
    const double w = q[0], x = q[1], y = q[2], z = q[3];
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                            2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                            2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    for (int k = 0; k < 3; k++) {
        for (int j = 0; j < 3; j++) {
            m[4 * k + j] = 0;
            for (int i = 0; i < 3; i++) {
                m[4 * k + j] +=
                    turn[3 * k + i] * ((1 - t) * poses[0].stretch[3 * i + j] + t * poses[1].stretch[3 * i + j]);
            }
        }
        m[4 * k + 3] = (1 - t) * poses[0].translate[k] + t * poses[1].translate[k];
    }
}

void koksma__placement_at(const koksma__placement *placement, double t, double matrix[12])
{
    double pose[12], inner[12];
    koksma__poses_at(placement->poses, t, pose);
    koksma__matrix_multiply(pose, placement->before, inner);
    koksma__matrix_multiply(placement->after, inner, matrix);
}

int koksma__pose_steps(const koksma__pose poses[2])
{
    double sign;
    const double steps = ceil(2 * arc(poses, &sign) / (M_PI / KOKSMA__MAX_STEPS) - 1e-9);
    return steps < 1 ? 1 : steps > KOKSMA__MAX_STEPS ? KOKSMA__MAX_STEPS : (int)steps;
}

/* The cofactors of a placement's matrix without its translation; returns the determinant. */
static double placed_cofactors(const double matrix[12], double out[9])
{
    double m[9];
    for (int i = 0; i < 9; i++) {
        m[i] = matrix[i / 3 * 4 + i % 3];
    }
    return koksma__cofactors(m, out);
}

void koksma__normal_matrix(const double m[12], double out[9])
{
    double largest = 0;
    int exponent = 0;
    placed_cofactors(m, out);
    for (int i = 0; i < 9; i++) {
        largest = fmax(largest, fabs(out[i]));
    }
    frexp(largest, &exponent);
    for (int i = 0; i < 9; i++) {
        out[i] = ldexp(out[i], -exponent);
    }
}

bool koksma__matrix_mirrors(const double m[12])
{
    double cofactors[9];
    return placed_cofactors(m, cofactors) < 0;
}

/* Compares the determinant with the product of the columns' lengths: the ratio is the volume of the parallelepiped
   over that of a box with edges of the same lengths. The matrix's entries may have been rounded to 24 bits. */
bool koksma__matrix_flattens(const double m[12])
{
    double columns[3][3], cross[3], box = 1;
    for (int c = 0; c < 3; c++) {
        for (int r = 0; r < 3; r++) {
            columns[c][r] = m[4 * r + c];
        }
        box *= sqrt(koksma__dot(columns[c], columns[c]));
    }
    koksma__cross(columns[0], columns[1], cross);
    return !(fabs(koksma__dot(cross, columns[2])) > 1e-6 * box);
}

double koksma__placed_triangle(const koksma__mesh *mesh, const double matrix[12], size_t t, float corners[9])
{
    double a[3], b[3], area[3];
    for (size_t i = 0; i < 9; i++) {
        const double *row = matrix + 4 * (i % 3);
        const float *v = mesh->vertices + 3 * (size_t)mesh->indices[3 * t + i / 3];
        corners[i] = (float)(row[0] * (double)v[0] + row[1] * (double)v[1] + row[2] * (double)v[2] + row[3]);
    }
    for (int k = 0; k < 3; k++) {
        a[k] = (double)corners[3 + k] - (double)corners[k];
        b[k] = (double)corners[6 + k] - (double)corners[k];
    }
    koksma__cross(a, b, area);
    return sqrt(koksma__dot(area, area)) / 2;
}

void koksma__matrix_multiply(const double a[12], const double b[12], double out[12])
{
    for (int i = 0; i < 12; i++) {
        const double *row = a + 4 * (i / 4);
        const int j = i % 4;
        out[i] = row[0] * b[j] + row[1] * b[4 + j] + row[2] * b[8 + j] + (j == 3 ? row[3] : 0);
    }
}
