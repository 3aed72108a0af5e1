/* SPDX-License-Identifier: Apache-2.0 */
#include "scene/mesh_file.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

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

static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), end = strlen(ending);
    return length >= end && !strcmp(path + length - end, ending);
}

bool koksma__mesh_part_check(const char *path, const unsigned char *file, size_t size)
{
    return !ends_in(path, ".mtl") || !koksma__mtl_check(path, file, size);
}

static koksma_status check_bytes(const char *path, const unsigned char *bytes, size_t size, koksma__gltf *gltf)
{
    if (!size) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: empty", path);
    }
    if (ends_in(path, ".gltf") || ends_in(path, ".glb")) {
        return koksma__gltf_read(path, bytes, size, gltf);
    }
    if (ends_in(path, ".obj")) {
        return koksma__obj_check(path, bytes, size);
    }
    return ends_in(path, ".off") ? koksma__off_check(path, bytes, size) : koksma__ply_check(path, bytes, size);
}

koksma_status koksma__mesh_file_check(const char *path, koksma__gltf *gltf)
{
    unsigned char *bytes = NULL;
    size_t size;
    koksma__gltf_init(gltf);
    if (!koksma__is_mesh_file(path)) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: a mesh file's name ends in .obj, .ply, .off, .gltf or .glb", path);
    }
    const bool plain = koksma__is_plain_file(path); /* where not, reading says why */
    koksma_status status = koksma__read_file(path, plain ? KOKSMA__MAX_MESH_FILE : 1, &bytes, &size);
    if (!status) {
        status =
            plain ? check_bytes(path, bytes, size, gltf) : koksma__fail(KOKSMA_MALFORMED, "%s: no plain file", path);
        free(bytes);
    }
    return status;
}
