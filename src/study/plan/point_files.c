/* SPDX-License-Identifier: Apache-2.0 */
/* Hashes the files of points and parameters that a plan's patterns name (file:PATH, net-file:PATH). A result
   depends on the contents of such a file, so that their hash is part of the result's key: after a change of the file,
   new rows are made and the old rows are kept. */
#include "study/plan/point_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/modifiers.h"
#include "core/read_file.h"
#include "core/status.h"
#include "patterns/shared/file_names.h"

/* Finds the path in a pattern or in the name of a reference; *length is the path's length without modifiers. NULL:
   no path. */
static const char *path_in(const char *spec, size_t *length)
{
    const koksma_pattern *p;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        char key[80];
        snprintf(key, sizeof key, ":%s:", p->name);
        const char *found = !p->operand ? NULL : !strncmp(spec, key + 1, strlen(key + 1)) ? spec : strstr(spec, key);
        const char *end = !found ? NULL : found == spec ? spec + strlen(spec) : strrchr(found, '@');
        if (end) {
            const char *path = found + strlen(key) - (found == spec), *modifiers = koksma__modifiers_of_path(path);
            *length = (size_t)((modifiers < end ? modifiers : end) - path);
            return path;
        }
    }
    return NULL;
}

/* Hash of a file; for a family of files (file_names.h), the combined hash of all of them. 0: it can't be read. */
static uint64_t hash_of_file(const char *path)
{
    uint64_t hash = 0, all = 0;
    koksma__file_set *sets = NULL;
    size_t count = 0;
    if (!koksma__file_has(path, "{n}") && !koksma__file_has(path, "{seed}")) {
        return koksma__hash_file(path, &hash) ? 0 : hash;
    }
    if (koksma__file_sets(path, &sets, &count)) {
        return 0;
    }
    for (size_t i = 0; i < count; i++) {
        char name[KOKSMA_MAX_SPEC];
        const bool read = !koksma__file_name(path, sets[i].n, sets[i].seed, name) && !koksma__hash_file(name, &hash);
        all = (all ^ (read ? hash : 0)) * 0x100000001b3;
    }
    free(sets);
    return all;
}

/* Returns the hash of a file, which is taken from the list if the list has it. If the list cannot grow, the file is
   hashed again next time. */
static uint64_t look_up(koksma__point_files *known, const char *path)
{
    for (size_t i = 0; known && i < known->n; i++) {
        if (!strcmp(known->at[i].path, path)) {
            return known->at[i].hash;
        }
    }
    const uint64_t hash = hash_of_file(path);
    koksma__point_file *more = known ? koksma__add_one(&known->at, &known->n, sizeof *more) : NULL;
    if (more) {
        *more = (koksma__point_file){strdup(path), hash};
        known->n -= !more->path;
    }
    return hash;
}

void koksma__hash_with_points(koksma__point_files *known, const char *hash, const char *spec,
                              char out[KOKSMA__HASH_TEXT])
{
    size_t length;
    const char *at = path_in(spec, &length);
    char *path = at ? strndup(at, length) : NULL;
    snprintf(out, KOKSMA__HASH_TEXT, "%s", hash);
    if (path) {
        const size_t used = strlen(out);
        snprintf(out + used, KOKSMA__HASH_TEXT - used, "%s%016llx", used ? "+" : "",
                 (unsigned long long)look_up(known, path));
    }
    free(path);
}

koksma_status koksma__points_can_be_read(const char *spec)
{
    size_t length, count = 0;
    const char *at = path_in(spec, &length);
    char *path = at ? strndup(at, length) : NULL;
    koksma__file_set *sets = NULL;
    koksma_status status = at && !path ? koksma__fail_memory(length) : KOKSMA_OK;
    uint64_t hash;
    if (path && (koksma__file_has(path, "{n}") || koksma__file_has(path, "{seed}"))) {
        status = koksma__file_sets(path, &sets, &count);
        if (!status && !count) {
            status = koksma__fail(KOKSMA_MISSING, "%s: no file has such a name", path);
        }
        free(sets);
    } else if (path) {
        status = koksma__hash_file(path, &hash);
    }
    free(path);
    return status;
}

void koksma__point_files_fini(koksma__point_files *known)
{
    for (size_t i = 0; i < known->n; i++) {
        free(known->at[i].path);
    }
    free(known->at);
    *known = (koksma__point_files){0};
}
