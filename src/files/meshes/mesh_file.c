/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What the readers of mesh files share: lists that grow, the limits of a file, and the search for files that a model
 * names. Reading takes time linear in the file's size, and at most 36 bytes of memory for each byte of text (the worst
 * case is an OBJ file whose corners are all "1 "). All meshes of a file together have at most 64 Mi vertices and triangles.
 */
#include "meshes/mesh_file.h"

#include <ctype.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/capacity.h"
#include "core/hash.h"
#include "core/status.h"

enum { MAX_PLACEMENTS = 1 << 20 };

/* ---- Files beside a model ----------------------------------------------------------------------------------- */

static bool exists(const char *path)
{
    struct stat about;
    return !stat(path, &about);
}

bool koksma__is_file(const char *path)
{
    struct stat about;
    return !stat(path, &about) && !S_ISDIR(about.st_mode);
}

void koksma__file_key(const char *path, char out[KOKSMA__FILE_KEY])
{
    struct stat about;
    *out = '\0';
    if (!stat(path, &about)) {
        snprintf(out, KOKSMA__FILE_KEY, "%ju %ju", (uintmax_t)about.st_dev, (uintmax_t)about.st_ino);
    }
}

koksma_status koksma__file_count(koksma__file_sizes *sizes, const char *path)
{
    struct stat about;
    char key[KOKSMA__FILE_KEY];
    size_t known;
    koksma__file_key(path, key);
    if (!sizes || stat(path, &about) || koksma__names_find(&sizes->known, key, strlen(key), &known)) {
        return KOKSMA_OK;
    }
    sizes->bytes += (uint64_t)about.st_size;
    return koksma__names_put(&sizes->known, key, strlen(key), 0);
}

/* Decodes %20 and other URI escapes in place; returns false if there are none, or if one encodes a zero byte. */
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

/* Replaces each \ by /; returns false if there is no \. */
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
    bool found = koksma__path_beside(model, name, out) && koksma__is_file(out);
    for (size_t i = 0; !found && i < 2 && strlen(name) < sizeof other; i++) {
        strcpy(other, name);
        found = ways[i](other) && koksma__path_beside(model, other, out) && koksma__is_file(out);
    }
    return found || (*name && koksma__path_beside(model, name, out) && exists(out));
}

void koksma__mesh_file_hash(koksma__mesh_file *file, const unsigned char *bytes, size_t size)
{
    file->hash += koksma__hash(bytes, size) * (2 * (uint64_t)file->n_named++ + 1);
}

/* ---- What readers share ------------------------------------------------------------------------------------- */

bool koksma__list_reserve(koksma__list *list, size_t more, size_t item_size)
{
    if (list->capacity - list->n < more) {
        const size_t twice = 2 * list->capacity, capacity = list->n + more > twice ? list->n + more : twice;
        void *items = capacity < SIZE_MAX / item_size ? realloc(list->items, capacity * item_size) : NULL;
        if (!items) {
            koksma__fail_memory(capacity * item_size);
            return false;
        }
        list->items = items;
        list->capacity = capacity;
    }
    return true;
}

void *koksma__list_add(koksma__list *list, size_t more, size_t item_size)
{
    if (!koksma__list_reserve(list, more, item_size)) {
        return NULL;
    }
    void *first = (char *)list->items + list->n * item_size;
    memset(first, 0, more * item_size);
    list->n += more;
    return first;
}

koksma_status koksma__file_take_mesh(koksma__mesh_file *f, koksma__mesh *mesh, size_t material)
{
    const size_t most = KOKSMA__MAX_VERTICES;
    f->n_vertices += mesh->n_vertices;
    f->n_triangles += mesh->n_triangles;
    const bool fits = f->n_vertices <= most && f->n_triangles <= most;
    koksma__file_mesh *to = fits ? koksma__list_add(&f->meshes, 1, sizeof *to) : NULL;
    if (!to) {
        koksma__mesh_fini(mesh);
        return fits ? KOKSMA_MEMORY
                    : koksma__fail(KOKSMA_MALFORMED,
                                   "%s: all its meshes together have more than %zu vertices or triangles", f->path,
                                   most);
    }
    *to = (koksma__file_mesh){.mesh = *mesh, .material = material};
    *mesh = (koksma__mesh){0};
    return KOKSMA_OK;
}

koksma_status koksma__file_add_placement(koksma__mesh_file *f, size_t mesh, const double *matrix)
{
    KOKSMA__FAIL_IF(f->placements.n == MAX_PLACEMENTS, KOKSMA_MALFORMED, "%s: nodes place more than %d meshes",
                    f->path, MAX_PLACEMENTS);
    koksma__file_placement *to = koksma__list_add(&f->placements, 1, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    to->mesh = mesh;
    memcpy(to->matrix, matrix, sizeof to->matrix);
    return KOKSMA_OK;
}

koksma_status koksma__file_add_material(koksma__mesh_file *f, float grey, koksma__file_material **out)
{
    *out = koksma__list_add(&f->materials, 1, sizeof **out);
    KOKSMA__TRY(*out ? KOKSMA_OK : KOKSMA_MEMORY);
    **out = (koksma__file_material){.colour = {grey, grey, grey}, .roughness = 1};
    return KOKSMA_OK;
}

koksma_status koksma__file_keep(koksma__mesh_file *f, unsigned char *bytes)
{
    unsigned char **kept = koksma__list_add(&f->owned, 1, sizeof *kept);
    if (!kept) {
        free(bytes);
        return KOKSMA_MEMORY;
    }
    *kept = bytes;
    return KOKSMA_OK;
}

void koksma__mesh_file_fini(koksma__mesh_file *f)
{
    for (size_t i = 0; i < f->meshes.n; i++) {
        koksma__mesh_fini(&koksma__file_mesh_at(f, i)->mesh);
    }
    for (size_t i = 0; i < f->materials.n; i++) {
        koksma__file_material *m = koksma__file_material_at(f, i);
        KOKSMA__FREE(m->colour_map.name, m->glow_map.name, m->surface_map.name, m->normal_map.name);
    }
    for (size_t i = 0; i < f->owned.n; i++) {
        free(((void **)f->owned.items)[i]);
    }
    KOKSMA__FREE(f->meshes.items, f->materials.items, f->placements.items, f->lights.items, f->owned.items,
                 f->unknown);
    *f = (koksma__mesh_file){0};
}
