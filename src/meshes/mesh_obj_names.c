/* SPDX-License-Identifier: Apache-2.0 */
#include "meshes/mesh_obj_names.h"

#include "core/status.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/hash.h"
#include "core/read_file.h"

static uint64_t hash_of(const char *name, size_t length)
{
    const uint64_t hash = koksma__hash(name, length);
    return hash ? hash : 1;
}

static size_t place_of(const koksma__obj_set *set, uint64_t hash)
{
    size_t at = hash % KOKSMA__OBJ_NAMES;
    while (set->hashes[at] && set->hashes[at] != hash) {
        at = (at + 1) % KOKSMA__OBJ_NAMES;
    }
    return at;
}

bool koksma__obj_set_has(const koksma__obj_set *set, const char *name, size_t length)
{
    return set->hashes[place_of(set, hash_of(name, length))] != 0;
}

bool koksma__obj_set_add(koksma__obj_set *set, const char *name, size_t length)
{
    const uint64_t hash = hash_of(name, length);
    const size_t at = place_of(set, hash);
    if (set->hashes[at] || set->n >= KOKSMA__OBJ_NAMES / 2) {
        return false;
    }
    set->hashes[at] = hash;
    set->n++;
    return true;
}

/* The names that a material file makes. */
static void take_made(const unsigned char *file, size_t size, koksma__obj_set *made)
{
    const unsigned char *end = file + size;
    while (file < end) {
        const unsigned char *found = memchr(file, '\n', (size_t)(end - file)), *stop = found ? found : end;
        while (file < stop && (*file == ' ' || *file == '\t')) {
            file++;
        }
        if (stop - file > 7 && !memcmp(file, "newmtl", 6) && (file[6] == ' ' || file[6] == '\t')) {
            const unsigned char *last = stop;
            for (file += 6; file < last && (*file == ' ' || *file == '\t'); file++) {
            }
            while (last > file && (last[-1] == ' ' || last[-1] == '\t' || last[-1] == '\r')) {
                last--;
            }
            koksma__obj_set_add(made, (const char *)file, (size_t)(last - file));
        }
        file = found ? stop + 1 : end;
    }
}

/* One that can't be read or is malformed is an error where assimp asks for it. */
static void read_made(const char *path, koksma__obj_set *made)
{
    unsigned char *raw = NULL;
    koksma__bytes clean = {0};
    size_t size;
    if (!koksma__read_file(path, KOKSMA__MAX_MESH_FILE, &raw, &size)) {
        if (!koksma__mtl_clean(path, raw, size, &clean)) {
            take_made(clean.data, clean.size, made);
        }
        free(clean.data);
        free(raw);
    }
}

/* A backslash at the end would draw the next line up. */
koksma_status koksma__obj_put_name(const char *word, const char *name, size_t length, koksma__bytes *out)
{
    const char *end = length && name[length - 1] == '\\' ? " \n" : "\n";
    const bool good = koksma__bytes_put(out, out->size, word, strlen(word)) &&
                      koksma__bytes_put(out, out->size, name, length) &&
                      koksma__bytes_put(out, out->size, end, strlen(end));
    return good ? KOKSMA_OK : koksma__fail_memory(out->size);
}

static koksma_status put_library(const char *name, size_t length, koksma__bytes *out)
{
    return koksma__obj_put_name("mtllib ", name, length, out);
}

static bool read_library(const char *path, const char *name, koksma__obj_names *names)
{
    char full[KOKSMA__MAX_PATH];
    if (!koksma__find_named(path, name, full)) {
        return false;
    }
    read_made(full, &names->made);
    return true;
}

/* Where a file isn't there assimp takes the one of the model's own name. */
static void note_missing(const char *path, const char *name, koksma__obj_names *names, koksma__unread *unread)
{
    char own[KOKSMA__MAX_PATH];
    if (!unread->libraries++) {
        snprintf(unread->library, sizeof unread->library, "%.255s", name);
        if (strlen(path) < sizeof own) {
            strcpy(own, path);
            strcpy(strrchr(own, '.'), ".mtl");
            if (koksma__is_plain_file(own)) {
                read_made(own, &names->made);
            }
        }
    }
}

/* The names one by one. */
static koksma_status take_each(const char *path, const char *rest, koksma__obj_names *names, koksma__unread *unread,
                               koksma__bytes *out)
{
    koksma_status status = KOKSMA_OK;
    while (!status && *rest) {
        char name[1024];
        const size_t length = strcspn(rest, " \t");
        snprintf(name, sizeof name, "%.*s", (int)length, rest);
        if (!read_library(path, name, names)) {
            note_missing(path, name, names, unread);
        }
        status = put_library(name, length, out);
        rest += length + strspn(rest + length, " \t");
    }
    return status;
}

koksma_status koksma__obj_take_libraries(const char *path, const char *rest, koksma__obj_names *names,
                                         koksma__unread *unread, koksma__bytes *out)
{
    const size_t length = strlen(rest);
    const uint64_t hash = hash_of(rest, length);
    for (size_t i = 0; i < names->n_libraries; i++) {
        if (names->libraries[i] == hash) {
            return KOKSMA_OK;
        }
    }
    if (names->n_libraries == KOKSMA__OBJ_LIBRARIES) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: more than %d material files", path, KOKSMA__OBJ_LIBRARIES);
    }
    names->libraries[names->n_libraries++] = hash;
    return read_library(path, rest, names) ? put_library(rest, length, out)
                                           : take_each(path, rest, names, unread, out);
}
