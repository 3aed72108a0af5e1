/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads Mitsuba's .serialized files, versions 3 and 4, which have several meshes, each compressed, and a dictionary
 * at the end.
 *
 *   mesh        0x041C and the version (16 bits each), then a zlib stream (RFC 1950) of:
 *                 flags (32 bits); version 4: a name that ends with a zero byte; the numbers of vertices and of
 *                 triangles (64 bits each); for all vertices the positions (3 numbers each), then, if the flags say
 *                 so, the normals (3), texture coordinates (2) and colours (3); for all triangles three indices
 *                 (32 bits each)
 *   dictionary  the position of each mesh in the file (version 3: 32 bits each, 4: 64), and their number (32 bits)
 *
 * All numbers are little-endian; those of vertices have single or double precision. Mitsuba's flag for face normals
 * is ignored; Mitsuba 3 ignores it too and follows the property face_normals of the scene file. A mesh without
 * normals gets none here.
 *
 * The numbers of vertices and triangles that a mesh claims are compared with the size of its stream before memory is
 * allocated, and all meshes of a file together may decompress to at most as many bytes as a model may have. The
 * positions in the dictionary must increase, so that no mesh is read twice.
 *
 * Format: the documentation of Mitsuba's plug-in "serialized".
 */
#include "meshes/mesh_serialized.h"

#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "meshes/inflate.h"

enum { FORMAT = 0x041C, HEADER = 4, NORMALS = 1, UVS = 2, COLOURS = 8, SINGLE = 0x1000, DOUBLE = 0x2000 };
enum { MOST_NAME = 4096, PIECE = 4096 };

/* A mesh that is being read. */
typedef struct stream {
    koksma__inflate *in;
    bool is_double;
    size_t size;    /* size of the compressed data in bytes */
    uint64_t *left; /* number of bytes to which the file's meshes may still decompress */
} stream;

static uint64_t whole(const unsigned char *bytes, int n)
{
    uint64_t value = 0;
    while (n--) {
        value = value << 8 | bytes[n];
    }
    return value;
}

koksma_status koksma__serialized_start(const unsigned char *bytes, size_t size)
{
    KOKSMA__FAIL_IF(size < HEADER || whole(bytes, 2) != FORMAT, KOKSMA_MALFORMED,
                    "not 1C 04, with which Mitsuba's .serialized files begin");
    return KOKSMA_OK;
}

static koksma_status take_whole(stream *s, int n, uint64_t *value)
{
    unsigned char bytes[8] = {0};
    KOKSMA__TRY(koksma__inflate_read(s->in, bytes, (size_t)n));
    *value = whole(bytes, n);
    return KOKSMA_OK;
}

static koksma_status skip_name(stream *s)
{
    unsigned char c = 1;
    for (int i = 0; c; i++) {
        KOKSMA__FAIL_IF(i > MOST_NAME, KOKSMA_MALFORMED, "a mesh's name of more than %d bytes", MOST_NAME);
        KOKSMA__TRY(koksma__inflate_read(s->in, &c, 1));
    }
    return KOKSMA_OK;
}

/* Reads n numbers; to: NULL to skip them. */
static koksma_status take_numbers(stream *s, size_t n, float *to)
{
    unsigned char bytes[PIECE];
    const size_t each = s->is_double ? 8 : 4;
    for (size_t done = 0; done < n;) {
        const size_t now = n - done < PIECE / each ? n - done : PIECE / each;
        KOKSMA__TRY(koksma__inflate_read(s->in, bytes, now * each));
        for (size_t i = 0; to && i < now; i++) {
            const uint64_t bits = whole(bytes + i * each, (int)each);
            const uint32_t narrow = (uint32_t)bits;
            double value;
            if (s->is_double) {
                memcpy(&value, &bits, sizeof value);
                to[done + i] = (float)value;
            } else {
                memcpy(&to[done + i], &narrow, sizeof narrow);
            }
        }
        done += now;
    }
    return KOKSMA_OK;
}

static koksma_status take_indices(stream *s, size_t n, uint32_t *to)
{
    unsigned char bytes[PIECE];
    for (size_t done = 0; done < n;) {
        const size_t now = n - done < PIECE / 4 ? n - done : PIECE / 4;
        KOKSMA__TRY(koksma__inflate_read(s->in, bytes, 4 * now));
        for (size_t i = 0; i < now; i++) {
            to[done + i] = (uint32_t)whole(bytes + 4 * i, 4);
        }
        done += now;
    }
    return KOKSMA_OK;
}

/* Compares what a mesh claims with the size of its stream. */
static koksma_status check_claim(stream *s, uint64_t flags, uint64_t vertices, uint64_t triangles)
{
    const unsigned numbers = 3 + (flags & NORMALS ? 3 : 0) + (flags & UVS ? 2 : 0) + (flags & COLOURS ? 3 : 0);
    KOKSMA__FAIL_IF(!(flags & SINGLE) == !(flags & DOUBLE), KOKSMA_MALFORMED,
                    "the flags of a mesh are 0x%llX: they state neither single nor double precision, or both",
                    (unsigned long long)flags);
    KOKSMA__FAIL_IF(vertices > KOKSMA__MAX_VERTICES || triangles > KOKSMA__MAX_TRIANGLES, KOKSMA_MALFORMED,
                    "%llu vertices and %llu triangles: a mesh has at most %zu of each", (unsigned long long)vertices,
                    (unsigned long long)triangles, KOKSMA__MAX_TRIANGLES);
    const uint64_t claimed = vertices * numbers * (s->is_double ? 8 : 4) + triangles * 12;
    KOKSMA__FAIL_IF(claimed / KOKSMA__INFLATE_RATIO > s->size, KOKSMA_MALFORMED,
                    "%llu vertices and %llu triangles are more than its %zu compressed bytes can hold",
                    (unsigned long long)vertices, (unsigned long long)triangles, s->size);
    KOKSMA__FAIL_IF(claimed > *s->left, KOKSMA_MALFORMED, "its meshes decompress to more than %llu bytes",
                    (unsigned long long)koksma__file_most(KOKSMA__FILE_MESH));
    *s->left -= claimed;
    return KOKSMA_OK;
}

static koksma_status take_mesh(stream *s, uint64_t version, koksma__mesh *mesh, bool *coloured)
{
    uint64_t flags = 0, vertices = 0, triangles = 0;
    KOKSMA__TRY(take_whole(s, 4, &flags));
    KOKSMA__TRY(version == 4 ? skip_name(s) : KOKSMA_OK);
    KOKSMA__TRY(take_whole(s, 8, &vertices));
    KOKSMA__TRY(take_whole(s, 8, &triangles));
    s->is_double = flags & DOUBLE;
    *coloured = flags & COLOURS;
    KOKSMA__TRY(check_claim(s, flags, vertices, triangles));
    const size_t n = (size_t)vertices;
    KOKSMA__TRY(koksma__mesh_init(n, (size_t)triangles, flags & NORMALS, flags & UVS, mesh));
    KOKSMA__TRY(take_numbers(s, 3 * n, mesh->vertices));
    KOKSMA__TRY(mesh->normals ? take_numbers(s, 3 * n, mesh->normals) : KOKSMA_OK);
    KOKSMA__TRY(mesh->uvs ? take_numbers(s, 2 * n, mesh->uvs) : KOKSMA_OK);
    KOKSMA__TRY(*coloured ? take_numbers(s, 3 * n, NULL) : KOKSMA_OK);
    return take_indices(s, 3 * (size_t)triangles, mesh->indices);
}

/* Adds the mesh in these bytes of the file. */
static koksma_status add_mesh(const unsigned char *bytes, size_t size, uint64_t *left, koksma__mesh_file *out)
{
    stream s = {.size = size - HEADER, .left = left};
    koksma__mesh mesh = {0};
    bool coloured = false;
    const uint64_t version = whole(bytes + 2, 2);
    KOKSMA__FAIL_IF(whole(bytes, 2) != FORMAT || (version != 3 && version != 4), KOKSMA_MALFORMED,
                    "%s: a mesh begins with %llX and version %llu, not with 41C and version 3 or 4", out->path,
                    (unsigned long long)whole(bytes, 2), (unsigned long long)version);
    koksma_status status = koksma__inflate_open(bytes + HEADER, s.size, &s.in);
    status = status ? status : take_mesh(&s, version, &mesh, &coloured);
    koksma__inflate_close(s.in);
    status = status ? koksma__fail_in(status, out->path) : koksma__file_take_mesh(out, &mesh, 0);
    koksma__mesh_fini(&mesh);
    out->unread.vertex_colours += !status && coloured;
    return status ? status : koksma__file_add_placement(out, out->meshes.n - 1, NULL);
}

koksma_status koksma__serialized_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    const int each = size >= HEADER && whole(bytes + 2, 2) == 3 ? 4 : 8;
    const uint64_t n = size >= HEADER + 4 ? whole(bytes + size - 4, 4) : 0;
    uint64_t left = koksma__file_most(KOKSMA__FILE_MESH);
    koksma__file_material *grey;
    KOKSMA__FAIL_IF(!n || n > (size - 4) / (size_t)each, KOKSMA_MALFORMED,
                    "%s: its last four bytes give %llu meshes, which its %zu bytes can't hold", out->path,
                    (unsigned long long)n, size);
    const unsigned char *dictionary = bytes + size - 4 - n * (size_t)each;
    const uint64_t body = (uint64_t)(dictionary - bytes);
    KOKSMA__FAIL_IF(out->part >= 0 && (uint64_t)out->part >= n, KOKSMA_MALFORMED,
                    "%s: there is no mesh %ld; the file has %llu, counted from 0", out->path, out->part,
                    (unsigned long long)n);
    for (uint64_t i = 0; i < n; i++) {
        const uint64_t at = whole(dictionary + i * (size_t)each, each);
        const uint64_t end = i + 1 < n ? whole(dictionary + (i + 1) * (size_t)each, each) : body;
        KOKSMA__FAIL_IF(end > body || at > end || end - at <= HEADER, KOKSMA_MALFORMED,
                        "%s: mesh %llu would lie from byte %llu to byte %llu of %llu", out->path,
                        (unsigned long long)i, (unsigned long long)at, (unsigned long long)end,
                        (unsigned long long)body);
        if (out->part < 0 || (uint64_t)out->part == i) {
            KOKSMA__TRY(add_mesh(bytes + at, (size_t)(end - at), &left, out));
        }
    }
    return koksma__file_add_material(out, 0.6f, &grey);
}
