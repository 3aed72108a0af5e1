/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What zlib packs: gzip files, and Mitsuba's .serialized files, versions 3 and 4, which have several meshes, each
 * compressed, and a dictionary at the end.
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
 * A stream is decompressed only as far as it is needed, so that a file that would decompress to more than it claims costs
 * nothing.
 *
 * Format: the documentation of Mitsuba's plug-in "serialized".
 */
#include "meshes/readers.h"

#include <stdlib.h>
#include <string.h>

#ifdef KOKSMA_ZLIB
#include <zlib.h>
#endif

#include "core/status.h"

enum { FORMAT = 0x041C, HEADER = 4, NORMALS = 1, UVS = 2, COLOURS = 8, SINGLE = 0x1000, DOUBLE = 0x2000 };

koksma_status koksma__serialized_start(const unsigned char *bytes, size_t size)
{
    KOKSMA__FAIL_IF(size < HEADER || koksma__bits_at(bytes, 2, false) != FORMAT, KOKSMA_MALFORMED,
                    "not 1C 04, with which Mitsuba's .serialized files begin");
    return KOKSMA_OK;
}

#ifdef KOKSMA_ZLIB

/* ---- Streams ------------------------------------------------------------------------------------------------ */

enum { MOST_BYTES = 1 << 30, ANY_HEADER = 32 };

/* A stream of zlib or gzip (RFC 1950 and 1952): zlib finds out which by itself, if 32 is added to its parameter windowBits.
   It counts bytes in 32 bits, so that longer blocks are passed in pieces. */
typedef struct inflater {
    z_stream z;
    size_t left; /* compressed bytes that zlib has not been given yet */
} inflater;

/* inflateEnd ends it, also after an error. */
static koksma_status start(const unsigned char *bytes, size_t size, inflater *in)
{
    *in = (inflater){.z = {.next_in = (z_const Bytef *)bytes}, .left = size};
    return inflateInit2(&in->z, MAX_WBITS + ANY_HEADER) == Z_OK ? KOKSMA_OK : koksma__fail_memory(sizeof *in);
}

/* Decompresses up to n bytes; *got is less than n where the stream ends. */
static koksma_status take(inflater *in, unsigned char *to, size_t n, size_t *got)
{
    int result = Z_OK;
    in->z.next_out = to;
    *got = 0;
    while (*got < n && result != Z_STREAM_END) {
        if (!in->z.avail_in) {
            in->z.avail_in = in->left < MOST_BYTES ? (uInt)in->left : MOST_BYTES;
            in->left -= in->z.avail_in;
        }
        const uInt asked = n - *got < MOST_BYTES ? (uInt)(n - *got) : MOST_BYTES;
        in->z.avail_out = asked;
        result = inflate(&in->z, Z_NO_FLUSH);
        *got += asked - in->z.avail_out;
        KOKSMA__FAIL_IF(result == Z_MEM_ERROR, KOKSMA_MEMORY, "out of memory while decompressing");
        KOKSMA__FAIL_IF(result != Z_OK && result != Z_STREAM_END, KOKSMA_MALFORMED, "its compressed data is %s",
                        result == Z_BUF_ERROR ? "cut short" : "damaged");
    }
    return KOKSMA_OK;
}

/* Decompresses the next n bytes. */
static koksma_status inflate_bytes(inflater *in, void *to, size_t n)
{
    size_t got = 0;
    KOKSMA__TRY(take(in, to, n, &got));
    KOKSMA__FAIL_IF(got < n, KOKSMA_MALFORMED, "its compressed data holds less than its header claims");
    return KOKSMA_OK;
}

/* Goes on to the next stream of a gzip file (RFC 1952, section 2.2); returns false if there is none. */
static bool next_stream(inflater *in)
{
    return in->z.avail_in + in->left > 0 && inflateReset(&in->z) == Z_OK;
}

koksma_status koksma__inflate_all(const unsigned char *bytes, size_t size, size_t most, unsigned char **out,
                                  size_t *out_size)
{
    inflater in;
    size_t capacity = 0, n = 0, got = 0;
    koksma_status status = start(bytes, size, &in);
    *out = NULL;
    while (!status) {
        if (n == capacity) {
            capacity = capacity ? 2 * capacity : 65536;
            capacity = capacity < most + 1 ? capacity : most + 1;
            unsigned char *more = realloc(*out, capacity + 1);
            status = more ? KOKSMA_OK : koksma__fail_memory(capacity + 1);
            *out = more ? more : *out;
        }
        status = status ? status : take(&in, *out + n, capacity - n, &got);
        n += got;
        if (!status && n > most) {
            status = koksma__fail(KOKSMA_MALFORMED, "it decompresses to more than %zu bytes", most);
        } else if (!status && n < capacity && !next_stream(&in)) {
            break;
        }
    }
    inflateEnd(&in.z);
    if (status) {
        free(*out);
        *out = NULL;
        return status;
    }
    (*out)[n] = 0;
    *out_size = n;
    return KOKSMA_OK;
}

/* ---- Meshes ------------------------------------------------------------------------------------------------- */

enum { MOST_NAME = 4096, PIECE = 4096 };

/* The largest ratio that deflate reaches: its longest match, 258 bytes, in two bits. */
enum { MOST_RATIO = 1032 };

/* A mesh that is being read. */
typedef struct stream {
    inflater in;
    bool is_double;
    size_t size;    /* size of the compressed data in bytes */
    uint64_t *read; /* number of bytes to which the file's meshes up to here decompress */
} stream;

static koksma_status take_whole(stream *s, int n, uint64_t *value)
{
    unsigned char bytes[8] = {0};
    KOKSMA__TRY(inflate_bytes(&s->in, bytes, (size_t)n));
    *value = koksma__bits_at(bytes, n, false);
    return KOKSMA_OK;
}

static koksma_status skip_name(stream *s)
{
    unsigned char c = 1;
    for (int i = 0; c; i++) {
        KOKSMA__FAIL_IF(i > MOST_NAME, KOKSMA_MALFORMED, "a mesh's name of more than %d bytes", MOST_NAME);
        KOKSMA__TRY(inflate_bytes(&s->in, &c, 1));
    }
    return KOKSMA_OK;
}

/* Reads n indices or numbers of single precision, or, if wide, rounds numbers of double precision; to: NULL to skip
   them. */
static koksma_status take_numbers(stream *s, size_t n, bool wide, void *to)
{
    unsigned char bytes[PIECE];
    const size_t each = wide ? 8 : 4;
    for (size_t done = 0; done < n;) {
        const size_t now = n - done < PIECE / each ? n - done : PIECE / each;
        KOKSMA__TRY(inflate_bytes(&s->in, bytes, now * each));
        for (size_t i = 0; to && i < now; i++) {
            const uint64_t bits = koksma__bits_at(bytes + i * each, each, false);
            const uint32_t narrow = (uint32_t)bits;
            double value;
            memcpy(&value, &bits, sizeof value);
            const float rounded = (float)value;
            memcpy((uint32_t *)to + done + i, wide ? (const void *)&rounded : &narrow, sizeof narrow);
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
    KOKSMA__FAIL_IF(claimed / MOST_RATIO > s->size, KOKSMA_MALFORMED,
                    "%llu vertices and %llu triangles are more than its %zu compressed bytes can hold",
                    (unsigned long long)vertices, (unsigned long long)triangles, s->size);
    *s->read += claimed;
    KOKSMA__FAIL_IF(*s->read > koksma__file_most(KOKSMA__FILE_MESH), KOKSMA_MALFORMED,
                    "its meshes decompress to more than %llu bytes",
                    (unsigned long long)koksma__file_most(KOKSMA__FILE_MESH));
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
    KOKSMA__TRY(take_numbers(s, 3 * n, s->is_double, mesh->vertices));
    KOKSMA__TRY(mesh->normals ? take_numbers(s, 3 * n, s->is_double, mesh->normals) : KOKSMA_OK);
    KOKSMA__TRY(mesh->uvs ? take_numbers(s, 2 * n, s->is_double, mesh->uvs) : KOKSMA_OK);
    KOKSMA__TRY(*coloured ? take_numbers(s, 3 * n, s->is_double, NULL) : KOKSMA_OK);
    return take_numbers(s, 3 * (size_t)triangles, false, mesh->indices);
}

/* The meshes of a file: their number, and the bytes of each up to those of the next. */
typedef struct directory {
    const unsigned char *bytes, *entries;
    uint64_t n, body; /* body: number of bytes before the entries */
    int each;         /* length of an entry */
} directory;

static uint64_t start_of(const directory *d, uint64_t i)
{
    return i < d->n ? koksma__bits_at(d->entries + i * (uint64_t)d->each, d->each, false) : d->body;
}

/* Finds the dictionary at the end of the file, and checks it. */
static koksma_status find_directory(const char *path, const unsigned char *bytes, size_t size, directory *d)
{
    *d = (directory){.bytes = bytes,
                     .n = size >= HEADER + 4 ? koksma__bits_at(bytes + size - 4, 4, false) : 0,
                     .each = size >= HEADER && koksma__bits_at(bytes + 2, 2, false) == 3 ? 4 : 8};
    KOKSMA__FAIL_IF(!d->n || d->n > (size - 4) / (size_t)d->each, KOKSMA_MALFORMED,
                    "%s: its last four bytes give %llu meshes, which its %zu bytes can't hold", path,
                    (unsigned long long)d->n, size);
    d->body = size - 4 - d->n * (uint64_t)d->each;
    d->entries = bytes + d->body;
    for (uint64_t i = 0; i < d->n; i++) {
        const uint64_t at = start_of(d, i), end = start_of(d, i + 1);
        KOKSMA__FAIL_IF(end > d->body || at > end || end - at <= HEADER, KOKSMA_MALFORMED,
                        "%s: mesh %llu would lie from byte %llu to byte %llu of %llu", path, (unsigned long long)i,
                        (unsigned long long)at, (unsigned long long)end, (unsigned long long)d->body);
    }
    return KOKSMA_OK;
}

/* Reads mesh number i; *mesh has to be freed even after an error. */
static koksma_status read_mesh(const char *path, const directory *d, uint64_t i, uint64_t *read, koksma__mesh *mesh,
                               bool *coloured)
{
    const unsigned char *bytes = d->bytes + start_of(d, i);
    stream s = {.size = (size_t)(start_of(d, i + 1) - start_of(d, i)) - HEADER, .read = read};
    const uint64_t version = koksma__bits_at(bytes + 2, 2, false);
    KOKSMA__FAIL_IF(koksma__bits_at(bytes, 2, false) != FORMAT || (version != 3 && version != 4), KOKSMA_MALFORMED,
                    "%s: a mesh begins with %llX and version %llu, not with 41C and version 3 or 4", path,
                    (unsigned long long)koksma__bits_at(bytes, 2, false), (unsigned long long)version);
    koksma_status status = start(bytes + HEADER, s.size, &s.in);
    status = status ? status : take_mesh(&s, version, mesh, coloured);
    inflateEnd(&s.in.z);
    return status ? koksma__fail_in(status, path) : KOKSMA_OK;
}

koksma_status koksma__serialized_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    directory d;
    uint64_t read = 0;
    koksma__file_material *grey;
    KOKSMA__TRY(find_directory(out->path, bytes, size, &d));
    for (uint64_t i = 0; i < d.n; i++) {
        koksma__mesh mesh = {0};
        bool coloured = false;
        koksma_status status = read_mesh(out->path, &d, i, &read, &mesh, &coloured);
        status = status ? status : koksma__file_take_mesh(out, &mesh, 0);
        koksma__mesh_fini(&mesh);
        KOKSMA__TRY(status);
        out->unread.vertex_colours += coloured;
        KOKSMA__TRY(koksma__file_add_placement(out, out->meshes.n - 1, koksma__identity_matrix));
    }
    return koksma__file_add_material(out, 0.6f, &grey);
}

#else

static koksma_status no_zlib(void)
{
    return koksma__fail(KOKSMA_UNSUPPORTED, "compressed models are not read: the build has no zlib");
}

koksma_status koksma__inflate_all(const unsigned char *bytes, size_t size, size_t most, unsigned char **out,
                                  size_t *out_size)
{
    (void)bytes, (void)size, (void)most, (void)out_size;
    *out = NULL;
    return no_zlib();
}

koksma_status koksma__serialized_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    (void)bytes, (void)size, (void)out;
    return no_zlib();
}

#endif
