/* SPDX-License-Identifier: Apache-2.0 */
/* Hashes the files of points and parameters, the programs and the libraries that a plan's patterns name (file:PATH,
   net-file:PATH, exec:PROGRAM, plugin:LIBRARY.so:NAME), for all uses of an image and for its reference. A result depends
   on the contents of such a file, so that their hash is part of the result's key: after a change of the file, new rows
   are made and the old rows are kept. */
#define _GNU_SOURCE /* tdestroy */
#include "study/plan/point_files.h"

#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <koksma/render.h>

#include "core/files.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "study/plan/image_patterns.h"
#include "study/plan/made_by.h"

/* Receives a pattern with an operand. */
typedef koksma_status (*visitor)(void *context, const koksma_spec *spec);

static koksma_status visit_pattern(const koksma_spec *spec, visitor visit, void *context)
{
    return spec->pattern && spec->pattern->operand ? visit(context, spec) : KOKSMA_OK;
}

/* Calls `visit` for the patterns with an operand among those of an image's uses, or for the pattern of a set of points. A
   text that can't be parsed has none: its reader says what is wrong with it. */
static koksma_status visit_patterns(bool image, const char *patterns, visitor visit, void *context)
{
    koksma_render_options options = {0};
    const koksma_spec *spec;
    koksma_status status = KOKSMA_OK;
    if (!patterns[0] ||
        (image ? koksma_render_patterns(patterns, &options) : koksma_pattern_spec(patterns, &options.pattern))) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; !status && (spec = koksma__image_pattern_at(&options, i)); i++) {
        status = visit_pattern(spec, visit, context);
    }
    return status;
}

static koksma_status visit_row(const koksma__row_texts *row, visitor visit, void *context)
{
    char name[KOKSMA_MAX_SPEC], of_reference[KOKSMA_MAX_SPEC];
    long long spp, replicates;
    const koksma_status status = visit_patterns(row->image, row->patterns, visit, context);
    const bool has_reference = !status && row->reference[0] &&
                               !koksma__reference_parse(row->reference, name, of_reference, &spp, &replicates);
    return has_reference ? visit_patterns(true, of_reference, visit, context) : status;
}

/* Whether the operand of a pattern is a family of files (file_names.h). Only patterns that read points have one: for all
   others {n} is part of the file's name. */
static bool is_family(const koksma_spec *spec)
{
    return koksma__reads_points(spec->pattern) && koksma__file_is_family(spec->path);
}

/* Copies the path in the operand of a pattern. Returns false for an operand that is a list of numbers. */
static bool find_path(const koksma_spec *spec, char path[KOKSMA_MAX_SPEC])
{
    if (!koksma__names_path(spec->pattern)) {
        return false;
    }
    const char *end = koksma__names_library(spec->pattern) ? koksma__library_end(spec->path) : NULL;
    snprintf(path, KOKSMA_MAX_SPEC, "%.*s", (int)(end ? (size_t)(end - spec->path) : strlen(spec->path)), spec->path);
    return true;
}

static uint64_t mix(uint64_t all, uint64_t value)
{
    return (all ^ value) * 0x100000001b3;
}

/* Hash of all files of a family, with their numbers: a file under another name is another set. */
static uint64_t hash_of_family(const char *path)
{
    uint64_t all = 0;
    koksma__file_set *sets = NULL;
    size_t count = 0;
    if (koksma__file_sets(path, &sets, &count)) {
        return 0;
    }
    for (size_t i = 0; i < count; i++) {
        char name[KOKSMA_MAX_SPEC];
        uint64_t hash = 0;
        const bool read = !koksma__file_name(path, sets[i].n, sets[i].seed, name) && !koksma__hash_file(name, &hash);
        all = mix(mix(mix(all, sets[i].n), sets[i].seed), read ? hash : 0);
    }
    free(sets);
    return all;
}

/* A file or a family with its hash, in the tree of those that were hashed. */
typedef struct known_file {
    char *path;
    bool is_family; /* whether {n} and {seed} in the path are placeholders */
    uint64_t hash;
} known_file;

static int compare_files(const void *a, const void *b)
{
    const known_file *f = a, *g = b;
    return f->is_family != g->is_family ? f->is_family - g->is_family : strcmp(f->path, g->path);
}

static void free_file(void *file)
{
    free(((known_file *)file)->path);
    free(file);
}

/* Returns the hash of a file or of a family, 0 if it can't be read. It is taken from the tree if the tree has it. If the
   tree cannot grow, the file is hashed again next time. */
static uint64_t look_up(koksma__point_files *known, char *path, bool family)
{
    known_file file = {path, family, 0};
    known_file *const *found = known ? tfind(&file, &known->tree, compare_files) : NULL;
    if (found) {
        return (*found)->hash;
    }
    if (family) {
        file.hash = hash_of_family(path);
    } else if (koksma__hash_file(path, &file.hash)) {
        file.hash = 0;
    }
    known_file *more = known ? malloc(sizeof *more) : NULL;
    if (more) {
        *more = (known_file){strdup(path), family, file.hash};
        if (!more->path || !tsearch(more, &known->tree, compare_files)) {
            free_file(more);
        }
    }
    return file.hash;
}

/* The hash of all files that were visited. */
typedef struct all_files {
    koksma__point_files *known;
    size_t n;
    uint64_t hash;
} all_files;

/* An operand that is no path has the hash 0. Its numbers are in the pattern's text, so that the key needs no hash of
   them; the 0 is part of the keys of rows that stores have. */
static koksma_status add_hash(void *context, const koksma_spec *spec)
{
    char path[KOKSMA_MAX_SPEC];
    all_files *all = context;
    const uint64_t hash = find_path(spec, path) ? look_up(all->known, path, is_family(spec)) : 0;
    all->hash = all->n++ ? (all->hash * 0x100000001b3) ^ hash : hash;
    return KOKSMA_OK;
}

void koksma__hash_with_points(koksma__point_files *known, const char *scene_hash, const koksma__row_texts *row,
                              char out[KOKSMA__HASH_TEXT])
{
    all_files all = {.known = known};
    visit_row(row, add_hash, &all);
    const size_t used = (size_t)snprintf(out, KOKSMA__HASH_TEXT, "%s", scene_hash);
    if (all.n && used < KOKSMA__HASH_TEXT) {
        snprintf(out + used, KOKSMA__HASH_TEXT - used, "%s%016llx", used ? "+" : "", (unsigned long long)all.hash);
    }
}

static koksma_status can_be_read(void *context, const koksma_spec *spec)
{
    char path[KOKSMA_MAX_SPEC];
    koksma__file_set *sets = NULL;
    size_t count = 0;
    uint64_t hash;
    (void)context;
    if (!find_path(spec, path)) {
        return KOKSMA_OK;
    }
    if (!is_family(spec)) {
        return koksma__hash_file(path, &hash);
    }
    const koksma_status status = koksma__file_sets(path, &sets, &count);
    free(sets);
    return status;
}

koksma_status koksma__points_can_be_read(const koksma__row_texts *row)
{
    return visit_row(row, can_be_read, NULL);
}

/* Finding one of a family's files takes as long as reading so many bytes for each of them. */
enum { LOOK_UP = 4096 };

static uint64_t length_of(const char *path)
{
    struct stat about;
    return stat(path, &about) ? 0 : (uint64_t)about.st_size;
}

static uint64_t length_of_family(const char *path)
{
    koksma__file_set *sets = NULL;
    size_t count = 0;
    uint64_t longest = 0;
    if (!koksma__file_sets(path, &sets, &count)) {
        for (size_t i = 0; i < count; i++) {
            char name[KOKSMA_MAX_SPEC];
            const uint64_t length = koksma__file_name(path, sets[i].n, sets[i].seed, name) ? 0 : length_of(name);
            longest = length > longest ? length : longest;
        }
    }
    free(sets);
    return longest + (uint64_t)count * LOOK_UP;
}

static koksma_status add_length(void *context, const koksma_spec *spec)
{
    char path[KOKSMA_MAX_SPEC];
    uint64_t *all = context;
    if (find_path(spec, path) && !spec->pattern->runs_code) {
        *all += is_family(spec) ? length_of_family(path) : length_of(path);
    }
    return KOKSMA_OK;
}

uint64_t koksma__points_files_length(const koksma__row_texts *row)
{
    uint64_t all = 0;
    visit_row(row, add_length, &all);
    return all;
}

/* What a row names. */
typedef struct files_of_row {
    bool files, families;
} files_of_row;

static koksma_status find_files(void *context, const koksma_spec *spec)
{
    char path[KOKSMA_MAX_SPEC];
    files_of_row *of = context;
    of->files |= find_path(spec, path) && !spec->pattern->runs_code;
    of->families |= is_family(spec);
    return KOKSMA_OK;
}

bool koksma__points_read_files(const koksma__row_texts *row)
{
    files_of_row of = {0};
    visit_row(row, find_files, &of);
    return of.files;
}

bool koksma__points_have_family(const koksma__row_texts *row)
{
    files_of_row of = {0};
    visit_row(row, find_files, &of);
    return of.families;
}

void koksma__point_files_fini(koksma__point_files *known)
{
    tdestroy(known->tree, free_file);
    *known = (koksma__point_files){0};
}
