/* SPDX-License-Identifier: Apache-2.0 */
/* Lists the revisions of the code that makes a row of the store: "random 0" for points, "renderer 0, n-rooks 0,
   sobol 0" for an image with two patterns. Each pattern, measure, metric or warp is listed once. When one of their
   revisions changes, so does the text, and with it the key of the row. Filters and integrators have no revisions:
   the renderer's revision covers them. */
#define _GNU_SOURCE /* tdestroy */
#include "study/plan/made_by.h"

#include <search.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>
#include <koksma/integrate.h>
#include <koksma/render.h>
#include <koksma/warp.h>

#include "core/files.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "study/plan/plan.h"
#include "study/plan/variants.h"

/* Appends "name revision" unless the text contains it already. The text has capacity for the patterns of all uses of
   an image (KOKSMA_MAX_PATTERNS_TEXT). */
static void add(char text[KOKSMA__MADE_BY], const char *name, int revision)
{
    char word[KOKSMA_MAX_SPEC + 16];
    const size_t used = strlen(text), size = (size_t)snprintf(word, sizeof word, "%s %d", name, revision);
    for (const char *at = text; (at = strstr(at, word)); at++) {
        if ((at == text || at[-1] == ' ') && (!at[size] || at[size] == ',')) {
            return;
        }
    }
    snprintf(text + used, KOKSMA__MADE_BY - used, "%s%s", used ? ", " : "", word);
}

static void add_pattern(char text[KOKSMA__MADE_BY], const koksma_spec *spec)
{
    if (spec->pattern) {
        add(text, spec->pattern->name, spec->pattern->revision);
    }
}

static koksma_status of_integrand(const char *measure, koksma__made_by *out)
{
    char name[KOKSMA_MAX_SPEC];
    const char *spec = koksma__integrand_of(measure);
    snprintf(name, sizeof name, "%.*s", (int)strcspn(spec, ":"), spec);
    const koksma_integrand *integrand = koksma_integrand_find(name);
    KOKSMA__FAIL_IF(!integrand, KOKSMA_UNKNOWN, "no integrand '%.64s'", name);
    snprintf(name, sizeof name, "error of %s", integrand->name);
    add(out->value, name, integrand->revision);
    return KOKSMA_OK;
}

static koksma_status of_points(const char *pattern, const char *warp_name, const char *measure, koksma__made_by *out)
{
    koksma_spec spec;
    koksma_status status = koksma_pattern_spec(pattern, &spec);
    if (!status) {
        add_pattern(out->points, &spec);
        if (koksma__integrand_of(measure)) {
            return of_integrand(measure, out);
        }
        status = koksma_measure_spec(measure, &spec);
    }
    KOKSMA__TRY(status);
    add(out->value, spec.measure->name, spec.measure->revision);
    const koksma_warp *warp = koksma_warp_find(warp_name);
    if (warp) {
        add(out->value, warp->name, warp->revision);
    }
    return warp || !warp_name[0] ? KOKSMA_OK : koksma__fail(KOKSMA_UNKNOWN, "no warp '%s'", warp_name);
}

static koksma_status of_image(const char *pattern, char text[KOKSMA__MADE_BY])
{
    koksma_render_options options = {0};
    const koksma_spec *spec;
    KOKSMA__TRY(koksma__image_pattern_set(pattern, &options));
    add(text, "renderer", KOKSMA__RENDERER_REVISION);
    for (size_t i = 0; (spec = koksma__image_pattern_at(&options, i)); i++) {
        add_pattern(text, spec);
    }
    return KOKSMA_OK;
}

static koksma_status of_metric(const char *text, char made_by[KOKSMA__MADE_BY])
{
    koksma_metric_spec spec;
    KOKSMA__TRY(koksma_metric_parse(text, &spec));
    add(made_by, spec.metric->name, spec.metric->revision);
    return KOKSMA_OK;
}

koksma_status koksma__find_made_by(bool image, const char *pattern, const char *options, const char *what,
                                   const char *metric, koksma__made_by *out)
{
    char name[KOKSMA_MAX_SPEC], of_reference[KOKSMA_MAX_SPEC];
    long long spp, replicates;
    *out = (koksma__made_by){0};
    if (!image) {
        return of_points(pattern, options, what, out);
    }
    koksma_status status = pattern[0] ? of_image(pattern, out->points) : KOKSMA_OK;
    status = status || !metric[0] ? status : of_metric(metric, out->value);
    status = status ? status : koksma__reference_parse(what, name, of_reference, &spp, &replicates);
    return status ? status : of_image(of_reference, out->value);
}

koksma_status koksma__reference_parse(const char *text, char name[KOKSMA_MAX_SPEC], char pattern[KOKSMA_MAX_SPEC],
                                      long long *spp, long long *replicates)
{
    const char *colon = strchr(text, ':'), *at = strrchr(text, '@');
    int end = 0;
    const bool fits = colon && at && at > colon && colon - text < KOKSMA_MAX_SPEC && at - colon - 1 < KOKSMA_MAX_SPEC;
    KOKSMA__FAIL_IF(!fits || sscanf(at, "@%18lldx%18lld%n", spp, replicates, &end) != 2 || at[end] || *spp < 1 ||
                        *replicates < 1,
                    KOKSMA_MALFORMED, "'%.100s' is not the text of a reference", text);
    snprintf(name, KOKSMA_MAX_SPEC, "%.*s", (int)(colon - text), text);
    snprintf(pattern, KOKSMA_MAX_SPEC, "%.*s", (int)(at - colon - 1), colon + 1);
    return KOKSMA_OK;
}

/* ---- Files of points ----------------------------------------------------------------------------------------- */

/* Hashes the files of points and parameters, the programs and the libraries that a plan's patterns name (file:PATH,
   net-file:PATH, exec:PROGRAM, plugin:LIBRARY.so:NAME), for all uses of an image and for its reference. A result depends
   on the contents of such a file, so that their hash is part of the result's key: after a change of the file, new rows
   are made and the old rows are kept. */

/* The patterns with an operand that a row names: those of an image's uses or that of a set of points, then those of the
   reference. A text that can't be parsed has none: its reader says what is wrong with it. */
typedef struct walk {
    const char *reference; /* NULL: its patterns are being walked, or there is none */
    koksma_render_options options;
    size_t next;
} walk;

static void read_patterns(walk *w, bool image, const char *patterns)
{
    w->next = 0;
    w->options = (koksma_render_options){0};
    if (patterns[0] && (image ? koksma_render_patterns(patterns, &w->options)
                              : koksma_pattern_spec(patterns, &w->options.pattern))) {
        w->options = (koksma_render_options){0};
    }
}

static walk begin_walk(const koksma__row_texts *row)
{
    walk w = {.reference = row->reference[0] ? row->reference : NULL};
    read_patterns(&w, row->image, row->patterns);
    return w;
}

/* The next of these patterns; NULL: there is none. */
static const koksma_spec *next_operand(walk *w)
{
    char name[KOKSMA_MAX_SPEC], patterns[KOKSMA_MAX_SPEC];
    long long spp, replicates;
    for (;;) {
        const koksma_spec *spec = koksma__image_pattern_at(&w->options, w->next++);
        if (spec && spec->pattern && spec->pattern->operand) {
            return spec;
        }
        if (!spec) {
            const char *reference = w->reference;
            w->reference = NULL;
            if (!reference || koksma__reference_parse(reference, name, patterns, &spp, &replicates)) {
                return NULL;
            }
            read_patterns(w, true, patterns);
        }
    }
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

/* An operand that is no path has the hash 0. Its numbers are in the pattern's text, so that the key needs no hash of
   them; the 0 is part of the keys of rows that stores have. */
void koksma__hash_with_points(koksma__point_files *known, const char *scene_hash, const koksma__row_texts *row,
                              char out[KOKSMA__HASH_TEXT])
{
    char path[KOKSMA_MAX_SPEC];
    const koksma_spec *spec;
    walk w = begin_walk(row);
    size_t n = 0;
    uint64_t all = 0;
    while ((spec = next_operand(&w))) {
        const uint64_t hash = find_path(spec, path) ? look_up(known, path, is_family(spec)) : 0;
        all = n++ ? (all * 0x100000001b3) ^ hash : hash;
    }
    const size_t used = (size_t)snprintf(out, KOKSMA__HASH_TEXT, "%s", scene_hash);
    if (n && used < KOKSMA__HASH_TEXT) {
        snprintf(out + used, KOKSMA__HASH_TEXT - used, "%s%016llx", used ? "+" : "", (unsigned long long)all);
    }
}

bool koksma__points_read_files(const koksma__row_texts *row)
{
    char path[KOKSMA_MAX_SPEC];
    const koksma_spec *spec;
    walk w = begin_walk(row);
    while ((spec = next_operand(&w)) && (spec->pattern->runs_code || !find_path(spec, path))) {
    }
    return spec;
}

void koksma__point_files_fini(koksma__point_files *known)
{
    tdestroy(known->tree, free_file);
    *known = (koksma__point_files){0};
}
