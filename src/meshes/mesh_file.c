/* SPDX-License-Identifier: Apache-2.0 */
#include "meshes/mesh_file.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/hash.h"
#include "core/read_file.h"
#include "core/status.h"

static const char *const endings[] = {".obj", ".ply", ".off", ".gltf", ".glb", NULL};

bool koksma__is_mesh_file(const char *path)
{
    const char *dot = strrchr(path, '.');
    for (int i = 0; dot && endings[i]; i++) {
        if (!strcmp(dot, endings[i])) {
            return true;
        }
    }
    return false;
}

bool koksma__is_plain_file(const char *path)
{
    struct stat about;
    return !stat(path, &about) && S_ISREG(about.st_mode);
}

/* Decodes what is encoded; false: that is nothing, or a zero. */
static bool decode(char *text)
{
    char *to = text;
    bool any = false;
    for (const char *from = text; *from; from++) {
        const char hex[3] = {from[0] == '%' ? from[1] : '\0', from[0] == '%' && from[1] ? from[2] : '\0', '\0'};
        const bool encoded = isxdigit((unsigned char)hex[0]) && isxdigit((unsigned char)hex[1]);
        *to++ = encoded ? (char)strtol(hex, NULL, 16) : *from;
        if (!to[-1]) {
            return false;
        }
        from += encoded ? 2 : 0;
        any |= encoded;
    }
    *to = '\0';
    return any;
}

/* Writes \ as /; false: there is none. */
static bool use_slashes(char *text)
{
    bool any = false;
    for (; *text; text++) {
        any |= *text == '\\';
        *text = *text == '\\' ? '/' : *text;
    }
    return any;
}

bool koksma__find_named(const char *model, const char *name, char out[KOKSMA__MAX_PATH])
{
    static bool (*const ways[])(char *text) = {decode, use_slashes};
    char other[KOKSMA__MAX_PATH];
    bool found = koksma__path_beside(model, name, out) && koksma__is_plain_file(out);
    for (size_t i = 0; !found && i < 2 && strlen(name) < sizeof other; i++) {
        strcpy(other, name);
        found = ways[i](other) && koksma__path_beside(model, other, out) && koksma__is_plain_file(out);
    }
    return found;
}

bool koksma__find_part(const char *model, const char *path, char out[KOKSMA__MAX_PATH])
{
    const char *slash = strrchr(model, '/');
    const size_t folder = slash ? (size_t)(slash - model) + 1 : 0;
    const bool beside = !strncmp(path, model, folder);
    return strlen(path) < KOKSMA__MAX_PATH &&
           (koksma__is_plain_file(strcpy(out, path)) || (beside && koksma__find_named(model, path + folder, out)));
}

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), end = strlen(ending);
    return length >= end && !strcmp(path + length - end, ending);
}

size_t koksma__byte_order_mark(const unsigned char *file, size_t size)
{
    return size >= 3 && !memcmp(file, "\357\273\277", 3) ? 3 : 0;
}

static koksma_status clean_model(const char *path, const unsigned char *file, size_t size, koksma__mesh_source *out)
{
    if (!size) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: empty", path);
    }
    if (ends_in(path, ".gltf") || ends_in(path, ".glb")) {
        return koksma__gltf_read(path, file, size, &out->gltf);
    }
    if (ends_in(path, ".obj")) {
        return koksma__obj_clean(path, file, size, &out->gltf.unread, &out->bytes);
    }
    return ends_in(path, ".off") ? koksma__off_clean(path, file, size, &out->bytes)
                                 : koksma__ply_clean(path, file, size, &out->bytes);
}

/* The file itself, where there is nothing in its place. */
static koksma_status settle(koksma_status status, unsigned char *file, size_t size, koksma__bytes *out)
{
    if (status || out->data) {
        free(file);
    } else {
        *out = (koksma__bytes){file, size, size};
    }
    if (status) {
        free(out->data);
        *out = (koksma__bytes){0};
    }
    return status;
}

koksma_status koksma__mesh_part_open(const char *path, koksma__bytes *out, uint64_t *hash)
{
    unsigned char *file = NULL;
    size_t size = 0;
    *out = (koksma__bytes){0};
    koksma_status status = koksma__read_file(path, KOKSMA__MAX_MESH_FILE, &file, &size);
    if (status) {
        return status;
    }
    *hash = koksma__hash(file, size);
    status = ends_in(path, ".mtl") ? koksma__mtl_clean(path, file, size, out) : KOKSMA_OK;
    return settle(status, file, size, out);
}

koksma_status koksma__mesh_file_open(const char *path, koksma__mesh_source *out)
{
    unsigned char *file = NULL;
    size_t size = 0;
    *out = (koksma__mesh_source){0};
    koksma__gltf_init(&out->gltf);
    if (!koksma__is_mesh_file(path)) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: a mesh file's name ends in .obj, .ply, .off, .gltf or .glb", path);
    }
    const bool plain = koksma__is_plain_file(path); /* where not, reading says why */
    koksma_status status = koksma__read_file(path, plain ? KOKSMA__MAX_MESH_FILE : 1, &file, &size);
    if (status) {
        return status;
    }
    out->hash = koksma__hash(file, size);
    status = plain ? clean_model(path, file, size, out) : koksma__fail(KOKSMA_MALFORMED, "%s: no plain file", path);
    return settle(status, file, size, &out->bytes);
}
