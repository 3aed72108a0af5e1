/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The lists and the bytes of a glTF file. Bytes are in buffers: files beside the model, base64 in it, or the second chunk
 * of a binary file. Views are parts of buffers, and accessors list the elements in a view, which are contiguous or
 * `byteStride` apart (glTF 2.0, sections 3.6.1 and 4.4). Numbers are little-endian on every machine. A missing buffer is an
 * error only if data in it are needed.
 */
#include "meshes/gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/files.h"

typedef koksma__json_node field;

/* ---- Lists and members; a missing list counts as empty ------------------------------------------------------ */

koksma_status koksma__gltf_list(const field *object, const char *key, field *list, size_t *n)
{
    *n = 0;
    if (!koksma__json_has(object, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(object, key, list);
    return status ? status : koksma__json_length(list, KOKSMA__GLTF_ITEMS, n);
}

bool koksma__gltf_find(const field *from, const char *path, field *out)
{
    field at = *from;
    for (size_t length; *path; path += length + (path[length] == '/')) {
        const field object = at;
        char key[40];
        length = strcspn(path, "/");
        snprintf(key, sizeof key, "%.*s", (int)length, path);
        if (!koksma__json_has(&object, key) || koksma__json_member(&object, key, &at)) {
            return false;
        }
    }
    *out = at;
    return true;
}

size_t koksma__gltf_index(const field *object, const char *key, size_t otherwise)
{
    long long number = (long long)otherwise;
    (void)koksma__json_get_whole(object, key, false, 0, KOKSMA__GLTF_ITEMS, &number);
    return (size_t)number;
}

koksma__json_node koksma__gltf_item(const koksma__gltf *g, int which, size_t i)
{
    return koksma__json_item(&g->lists[which], i);
}

/* ---- Buffers ------------------------------------------------------------------------------------------------ */

static int base64_value(char c)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const char *at = c ? strchr(digits, c) : NULL;
    return at ? (int)(at - digits) : -1;
}

/* Gives the bytes to the koksma__mesh_file, which frees them when it is closed. */
static koksma_status keep(koksma__gltf *g, unsigned char *bytes, size_t size, koksma__gltf_bytes *out)
{
    *out = (koksma__gltf_bytes){bytes, size};
    return koksma__file_keep(g->out, bytes);
}

/* RFC 4648, section 4. */
koksma_status koksma__gltf_decode(koksma__gltf *g, const field *f, const char *uri, koksma__gltf_bytes *out)
{
    static const char base64[] = ";base64";
    const char *text = strchr(uri, ',');
    const size_t mark = strlen(base64);
    KOKSMA__JSON_FAIL_IF(!text || (size_t)(text - uri) < mark || strncmp(text - mark, base64, mark) != 0, f,
                         "uri: only data in base64 can be read");
    const size_t length = strlen(++text);
    unsigned char *bytes = malloc(length / 4 * 3 + 4);
    uint32_t bits = 0;
    int n_bits = 0;
    size_t size = 0;
    KOKSMA__REQUIRE_MEMORY(bytes, length / 4 * 3 + 4);
    for (size_t i = 0; i < length && text[i] != '='; i++) {
        const int value = base64_value(text[i]);
        if (value < 0) {
            free(bytes);
            return koksma__json_fail(f, "uri: character %zu of the data is not base64", i);
        }
        bits = bits << 6 | (uint32_t)value;
        n_bits += 6;
        if (n_bits >= 8) {
            n_bits -= 8;
            bytes[size++] = (unsigned char)(bits >> n_bits & 0xff);
        }
    }
    return keep(g, bytes, size, out);
}

/* Loads a buffer. files: the buffers that are files, by koksma__file_key; each file is read once, under whatever names. */
static koksma_status load(koksma__gltf *g, const field *f, const char *uri, koksma__names *files,
                          koksma__gltf_bytes *out)
{
    char file[KOKSMA__MAX_PATH], key[KOKSMA__FILE_KEY];
    unsigned char *bytes = NULL;
    size_t size = 0, known;
    if (!strncmp(uri, "data:", 5)) {
        return koksma__gltf_decode(g, f, uri, out);
    }
    if (!koksma__find_named(g->out->path, uri, file)) {
        return KOKSMA_OK;
    }
    koksma__file_key(file, key);
    if (koksma__names_find(files, key, strlen(key), &known)) {
        *out = g->buffers[known];
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__names_put(files, key, strlen(key), (size_t)(out - g->buffers)));
    KOKSMA__TRY(koksma__file_count(g->out->sizes, file));
    KOKSMA__TRY(koksma__read_file(file, KOKSMA__FILE_BUFFER, KOKSMA__BY_FILE, NULL, &bytes, &size));
    koksma__mesh_file_hash(g->out, bytes, size);
    return keep(g, bytes, size, out);
}

koksma_status koksma__gltf_load_buffers(koksma__gltf *g)
{
    koksma_status status = KOKSMA_OK;
    koksma__names files = {0};
    for (size_t i = 0; !status && i < g->n[KOKSMA__GLTF_BUFFERS]; i++) {
        const field f = koksma__gltf_item(g, KOKSMA__GLTF_BUFFERS, i);
        koksma__gltf_bytes *b = &g->buffers[i];
        const char *uri = NULL;
        long long length = 0;
        status = koksma__json_get_text(&f, "uri", false, &uri);
        status = status ? status : koksma__json_get_whole(&f, "byteLength", true, 0, 1 << 30, &length);
        if (!status && uri) {
            status = load(g, &f, uri, &files, b);
        } else if (!i) {
            *b = g->binary;
        }
        if (!status && b->bytes && b->size < (size_t)length) {
            status = koksma__json_fail(&f, "byteLength is %lld, but there are only %zu bytes", length, b->size);
        }
    }
    koksma__names_fini(&files);
    return status;
}

/* ---- Views and accessors ------------------------------------------------------------------------------------ */

koksma_status koksma__gltf_view_bytes(const koksma__gltf *g, size_t view, koksma__gltf_bytes *out)
{
    const koksma__gltf_view *v = &g->views[view];
    if (!g->buffers[v->buffer].bytes) {
        const field buffer = koksma__gltf_item(g, KOKSMA__GLTF_BUFFERS, v->buffer);
        const char *uri = NULL;
        KOKSMA__TRY(koksma__json_get_text(&buffer, "uri", false, &uri));
        return koksma__json_fail(&buffer, uri ? "uri: there is no file '%.300s'" : "there is no uri%s",
                                 uri ? uri : ", and the file has no binary chunk");
    }
    *out = (koksma__gltf_bytes){g->buffers[v->buffer].bytes + v->offset, v->size};
    return KOKSMA_OK;
}

koksma_status koksma__gltf_elements_at(const koksma__gltf *g, const field *object, const char *key,
                                       koksma__gltf_elements *out, size_t *number)
{
    koksma__gltf_bytes bytes = {0};
    *out = (koksma__gltf_elements){0};
    *number = koksma__gltf_index(object, key, 0);
    const field f = koksma__gltf_item(g, KOKSMA__GLTF_ACCESSORS, *number);
    const koksma__gltf_elements *e = &g->accessors[*number];
    KOKSMA__JSON_FAIL_IF(!e->view, &f, "no bufferView: its elements are all 0");
    KOKSMA__TRY(koksma__gltf_view_bytes(g, e->view - 1, &bytes));
    *out = *e;
    out->first = bytes.bytes + e->offset;
    return KOKSMA_OK;
}

size_t koksma__gltf_component_size(int component)
{
    static const unsigned char sizes[] = {1, 1, 2, 2, 0, 4, 4}; /* of 5120 to 5126 */
    return sizes[component - 5120];
}

size_t koksma__gltf_whole(const koksma__gltf_elements *e, size_t i)
{
    return koksma__bits_at(e->first + i * e->stride, koksma__gltf_component_size(e->component), false);
}

/* Normalised integers (glTF 2.0, section 3.6.2.2): unsigned ones are c / 255 or c / 65535, signed ones max(c / 127,
   -1) or max(c / 32767, -1). */
float koksma__gltf_real(const koksma__gltf_elements *e, size_t i, int k)
{
    const unsigned char *at = e->first + i * e->stride;
    float value = 0, full = 0;
    if (e->component == 5126 || e->component == 5125) {
        const uint32_t bits = (uint32_t)koksma__bits_at(at + 4 * k, 4, false);
        memcpy(&value, &bits, sizeof value);
        return e->component == 5126 ? value : (float)bits;
    }
    if (e->component < 5122) {
        value = e->component == 5121 ? (float)at[k] : (float)(signed char)at[k];
        full = e->component == 5121 ? 255 : 127;
    } else {
        const uint32_t bits = (uint32_t)koksma__bits_at(at + 2 * k, 2, false);
        value = e->component == 5123 ? (float)bits : (float)(int16_t)bits;
        full = e->component == 5123 ? 65535 : 32767;
    }
    return !e->normalised ? value : value < -full ? -1 : value / full;
}
