/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The vertices that a glTF file's triangles name. assimp 5.2 leaves out every face with a vertex that is not there,
 * and the mesh gets a hole; attributes that have not as many elements as there are vertices it leaves out, too. So
 * the buffers are read here as well, from files beside the model, from base64 in it, or from the second piece of a
 * binary file, and every number of every index accessor is compared with the count of its POSITION (glTF 2.0,
 * sections 3.6.1, 3.7.2 and 4.4). Meshes packed by Draco have no such accessors: of those assimp sees to it.
 */
#include <stdlib.h>
#include <string.h>

#include "core/read_file.h"
#include "core/status.h"
#include "meshes/gltf.h"
#include "meshes/mesh_file.h"

typedef koksma__json_node field;

typedef struct buffer {
    const unsigned char *bytes; /* NULL: not there, which assimp reports */
    unsigned char *owned;       /* the same, or NULL */
    size_t size;
} buffer;

typedef struct source {
    const char *path;
    field buffers, views, accessors;
    size_t n_buffers, n_views, n_accessors;
    buffer *loaded; /* one a buffer */
} source;

/* ---- Buffers ------------------------------------------------------------------------------------------------ */

static int base64_value(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* RFC 4648, section 4. */
static koksma_status decode_base64(const field *f, const char *text, buffer *out)
{
    const size_t length = strlen(text);
    uint32_t bits = 0;
    int n_bits = 0;
    out->owned = malloc(length / 4 * 3 + 4);
    out->bytes = out->owned;
    if (!out->owned) {
        return koksma__fail_memory(length / 4 * 3 + 4);
    }
    for (size_t i = 0; i < length && text[i] != '='; i++) {
        const int value = base64_value(text[i]);
        if (value < 0) {
            return koksma__json_fail(f, "uri: character %zu of the data is not base64", i);
        }
        bits = bits << 6 | (uint32_t)value;
        n_bits += 6;
        if (n_bits >= 8) {
            n_bits -= 8;
            out->owned[out->size++] = (unsigned char)(bits >> n_bits & 0xff);
        }
    }
    return KOKSMA_OK;
}

static koksma_status load(const source *s, const field *f, const char *uri, buffer *out)
{
    static const char base64[] = ";base64";
    char file[KOKSMA__MAX_PATH];
    if (!strncmp(uri, "data:", 5)) {
        const char *comma = strchr(uri, ',');
        const size_t mark = strlen(base64);
        if (!comma || (size_t)(comma - uri) < mark || strncmp(comma - mark, base64, mark) != 0) {
            return koksma__json_fail(f, "uri: data that is not base64 is not read");
        }
        return decode_base64(f, comma + 1, out);
    }
    if (!koksma__find_named(s->path, uri, file)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__read_file(file, KOKSMA__MAX_MESH_FILE, &out->owned, &out->size);
    out->bytes = out->owned;
    return status;
}

/* bin: the binary piece of the file, which is its first buffer. */
static koksma_status load_all(source *s, const unsigned char *bin, size_t bin_size)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < s->n_buffers; i++) {
        const field f = koksma__json_item(&s->buffers, i);
        buffer *b = &s->loaded[i];
        const char *uri = NULL;
        long long length = 0;
        status = koksma__json_get_text(&f, "uri", false, &uri);
        status = status ? status : koksma__json_get_whole(&f, "byteLength", true, 0, 1 << 30, &length);
        if (!status && uri) {
            status = load(s, &f, uri, b);
        } else if (!i && bin) {
            *b = (buffer){.bytes = bin, .size = bin_size};
        }
        if (!status && b->bytes && b->size < (size_t)length) {
            return koksma__json_fail(&f, "byteLength is %lld, and there are %zu bytes", length, b->size);
        }
    }
    return status;
}

/* ---- Accessors ---------------------------------------------------------------------------------------------- */

static size_t number_at(const unsigned char *at, size_t bytes)
{
    size_t value = 0;
    for (size_t i = 0; i < bytes; i++) {
        value |= (size_t)at[i] << 8 * i;
    }
    return value;
}

/* The accessor that a member of the object names, and its count. gltf_check.c saw that numbers are in range. */
static koksma_status accessor_at(const source *s, const field *object, const char *key, long long *number, field *out,
                                 long long *count)
{
    koksma_status status = koksma__json_get_whole(object, key, true, 0, (long long)s->n_accessors - 1, number);
    if (!status) {
        *out = koksma__json_item(&s->accessors, (size_t)*number);
        status = koksma__json_get_whole(out, "count", true, 1, (long long)KOKSMA__MAX_VERTICES, count);
    }
    return status;
}

/* Where the elements of an accessor are, how far from each other; *first NULL: nowhere. */
static koksma_status elements(const source *s, const field *accessor, size_t bytes, const unsigned char **first,
                              size_t *stride)
{
    long long number = 0, offset = 0, more = 0, step = 0;
    *first = NULL;
    if (!koksma__json_has(accessor, "bufferView")) {
        return KOKSMA_OK; /* all are 0 */
    }
    koksma_status status =
        koksma__json_get_whole(accessor, "bufferView", true, 0, (long long)s->n_views - 1, &number);
    status = status ? status : koksma__json_get_whole(accessor, "byteOffset", false, 0, 1 << 30, &offset);
    if (status) {
        return status;
    }
    const field view = koksma__json_item(&s->views, (size_t)number);
    status = koksma__json_get_whole(&view, "buffer", true, 0, (long long)s->n_buffers - 1, &number);
    status = status ? status : koksma__json_get_whole(&view, "byteOffset", false, 0, 1 << 30, &more);
    status = status ? status : koksma__json_get_whole(&view, "byteStride", false, 0, 252, &step);
    const buffer *b = status ? NULL : &s->loaded[number];
    if (b && b->bytes) {
        *first = b->bytes + offset + more;
        *stride = (size_t)step > bytes ? (size_t)step : bytes;
    }
    return status;
}

static koksma_status check_indices(const source *s, const field *f, long long positions, long long n_vertices)
{
    field accessor;
    long long number = 0, count = 0, component = 0;
    const char *type = "";
    const unsigned char *at = NULL;
    size_t stride = 0;
    koksma_status status = accessor_at(s, f, "indices", &number, &accessor, &count);
    status = status ? status : koksma__json_get_text(&accessor, "type", true, &type);
    status = status ? status : koksma__json_get_whole(&accessor, "componentType", true, 5120, 5126, &component);
    const size_t bytes = component == 5121 ? 1 : component == 5123 ? 2 : component == 5125 ? 4 : 0;
    if (!status && (!bytes || strcmp(type, "SCALAR") != 0)) {
        return koksma__json_fail(
            f, "indices: accessor %lld has %.16s of component type %lld; indices are SCALAR of 5121, 5123 or 5125",
            number, type, component);
    }
    status = status ? status : elements(s, &accessor, bytes, &at, &stride);
    for (long long i = 0; !status && at && i < count; i++) {
        const size_t vertex = number_at(at + (size_t)i * stride, bytes);
        if (vertex >= (size_t)n_vertices) {
            return koksma__json_fail(
                f, "indices: number %lld of accessor %lld is vertex %zu; accessor %lld has %lld vertices, from 0 on",
                i, number, vertex, positions, n_vertices);
        }
    }
    return status;
}

/* ---- Meshes ------------------------------------------------------------------------------------------------- */

static bool is_packed(const field *primitive)
{
    field extensions;
    return koksma__json_is_object_at(primitive, "extensions") &&
           !koksma__json_member(primitive, "extensions", &extensions) &&
           koksma__json_has(&extensions, "KHR_draco_mesh_compression");
}

static koksma_status check_primitive(const source *s, const field *f)
{
    static const char *const others[] = {"NORMAL", "TANGENT", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0"};
    field list, accessor;
    long long positions = 0, number = 0, n_vertices = 0, n = 0;
    koksma_status status = koksma__json_member(f, "attributes", &list);
    if (status || is_packed(f) || !koksma__json_has(&list, "POSITION")) {
        return status;
    }
    status = accessor_at(s, &list, "POSITION", &positions, &accessor, &n_vertices);
    for (size_t i = 0; !status && i < sizeof others / sizeof *others; i++) {
        if (koksma__json_has(&list, others[i])) {
            status = accessor_at(s, &list, others[i], &number, &accessor, &n);
            if (!status && n != n_vertices) {
                return koksma__json_fail(&list,
                                         "%s: accessor %lld has %lld elements, and accessor %lld %lld positions",
                                         others[i], number, n, positions, n_vertices);
            }
        }
    }
    return status || !koksma__json_has(f, "indices") ? status : check_indices(s, f, positions, n_vertices);
}

static koksma_status check_meshes(const source *s, const field *root)
{
    field meshes, primitives;
    size_t n_meshes = 0, n = 0;
    koksma_status status = koksma__gltf_list(root, "meshes", &meshes, &n_meshes);
    for (size_t i = 0; !status && i < n_meshes; i++) {
        const field mesh = koksma__json_item(&meshes, i);
        status = koksma__gltf_list(&mesh, "primitives", &primitives, &n);
        for (size_t k = 0; !status && k < n; k++) {
            const field primitive = koksma__json_item(&primitives, k);
            status = check_primitive(s, &primitive);
        }
    }
    return status;
}

koksma_status koksma__gltf_check_indices(const char *path, const koksma__json_node *root, const unsigned char *bin,
                                         size_t bin_size)
{
    source s = {.path = path};
    koksma_status status = koksma__gltf_list(root, "buffers", &s.buffers, &s.n_buffers);
    status = status ? status : koksma__gltf_list(root, "bufferViews", &s.views, &s.n_views);
    status = status ? status : koksma__gltf_list(root, "accessors", &s.accessors, &s.n_accessors);
    if (status) {
        return status;
    }
    s.loaded = calloc(s.n_buffers + 1, sizeof *s.loaded);
    if (!s.loaded) {
        return koksma__fail_memory((s.n_buffers + 1) * sizeof *s.loaded);
    }
    status = load_all(&s, bin, bin_size);
    status = status ? status : check_meshes(&s, root);
    for (size_t i = 0; i < s.n_buffers; i++) {
        free(s.loaded[i].owned);
    }
    free(s.loaded);
    return status;
}
