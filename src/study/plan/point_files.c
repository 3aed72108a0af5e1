/* SPDX-License-Identifier: Apache-2.0 */
/* Hashes the files of points and parameters that a plan's patterns name (file:PATH, net-file:PATH), for all uses of an
   image and for its reference. A result depends on the contents of such a file, so that their hash is part of the
   result's key: after a change of the file, new rows are made and the old rows are kept. */
#include "study/plan/point_files.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "core/capacity.h"
#include "core/read_file.h"
#include "core/status.h"
#include "patterns/shared/file_names.h"
#include "study/plan/image_patterns.h"
#include "study/plan/made_by.h"

/* Calls `visit` for every path in the patterns of an image's uses, or in the single pattern of a set of points, and with
   NULL for an operand that is no path. Other texts have none: their reader says what is wrong with them. */
static koksma_status visit_patterns(const char *patterns, koksma_status (*visit)(void *context, const char *path),
                                    void *context)
{
    koksma_render_options options = {0};
    const koksma_spec *spec;
    koksma_status status = KOKSMA_OK;
    if (!patterns[0] || koksma_render_patterns(patterns, &options)) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; !status && (spec = koksma__image_pattern_at(&options, i)); i++) {
        const koksma_pattern *p = spec->pattern;
        status = p && p->operand ? visit(context, koksma__names_path(p) ? spec->path : NULL) : KOKSMA_OK;
    }
    return status;
}

static koksma_status visit_paths(const char *patterns, const char *reference,
                                 koksma_status (*visit)(void *context, const char *path), void *context)
{
    char name[KOKSMA_MAX_SPEC], of_reference[KOKSMA_MAX_SPEC];
    long long spp, replicates;
    const koksma_status status = visit_patterns(patterns, visit, context);
    const bool has_reference =
        !status && reference[0] && !koksma__reference_parse(reference, name, of_reference, &spp, &replicates);
    return has_reference ? visit_patterns(of_reference, visit, context) : status;
}

/* Hash of a file; for a family of files (file_names.h), the combined hash of all of them. 0: it can't be read. */
static uint64_t hash_of_file(const char *path)
{
    uint64_t hash = 0, all = 0;
    koksma__file_set *sets = NULL;
    size_t count = 0;
    if (!koksma__file_is_family(path)) {
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

/* The hash of all files that were visited. */
typedef struct all_files {
    koksma__point_files *known;
    size_t n;
    uint64_t hash;
} all_files;

/* An operand that is no path has the hash 0. Its numbers are in the pattern's text, so that the key needs no hash of
   them; the 0 is part of the keys of rows that stores have. */
static koksma_status add_hash(void *context, const char *path)
{
    all_files *all = context;
    const uint64_t hash = path ? look_up(all->known, path) : 0;
    all->hash = all->n++ ? (all->hash * 0x100000001b3) ^ hash : hash;
    return KOKSMA_OK;
}

void koksma__hash_with_points(koksma__point_files *known, const char *scene_hash, const char *patterns,
                              const char *reference, char out[KOKSMA__HASH_TEXT])
{
    all_files all = {.known = known};
    visit_paths(patterns, reference, add_hash, &all);
    const size_t used = (size_t)snprintf(out, KOKSMA__HASH_TEXT, "%s", scene_hash);
    if (all.n && used < KOKSMA__HASH_TEXT) {
        snprintf(out + used, KOKSMA__HASH_TEXT - used, "%s%016llx", used ? "+" : "", (unsigned long long)all.hash);
    }
}

static koksma_status can_be_read(void *context, const char *path)
{
    koksma__file_set *sets = NULL;
    size_t count = 0;
    uint64_t hash;
    (void)context;
    if (!path) {
        return KOKSMA_OK;
    }
    if (!koksma__file_is_family(path)) {
        return koksma__hash_file(path, &hash);
    }
    const koksma_status status = koksma__file_sets(path, &sets, &count);
    free(sets);
    return status;
}

koksma_status koksma__points_can_be_read(const char *patterns, const char *reference)
{
    return visit_paths(patterns, reference, can_be_read, NULL);
}

static koksma_status find_family(void *context, const char *path)
{
    *(bool *)context |= path && koksma__file_is_family(path);
    return KOKSMA_OK;
}

bool koksma__points_have_family(const char *patterns, const char *reference)
{
    bool found = false;
    visit_paths(patterns, reference, find_family, &found);
    return found;
}

void koksma__point_files_fini(koksma__point_files *known)
{
    for (size_t i = 0; i < known->n; i++) {
        free(known->at[i].path);
    }
    free(known->at);
    *known = (koksma__point_files){0};
}
