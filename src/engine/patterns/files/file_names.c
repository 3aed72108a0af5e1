/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Paths with the placeholders {n} and {seed}. To make a path from numbers, each placeholder is replaced by decimal
 * digits without leading zeros. To find the existing files, glob(3) lists the paths with a `*` for each placeholder;
 * a path is kept if the numbers read from it give the same path again, so that `my_16_03.npy` is not taken for the
 * set of seed 3.
 */
#include "patterns/files/files.h"

#include <glob.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

/* Each such part is looked for in all folders of the one before: more of them would list a disk. */
enum { MOST_PARTS = 2 };

static const char place_n[] = "{n}", place_seed[] = "{seed}";

bool koksma__file_has(const char *path, const char *place)
{
    return strstr(path, place) != NULL;
}

bool koksma__file_is_family(const char *path)
{
    return koksma__file_has(path, "{n}") || koksma__file_has(path, "{seed}");
}

const char *koksma__library_end(const char *operand)
{
    const char *colon = strrchr(operand, ':');
    return colon && !strchr(colon, '/') ? colon : NULL;
}

/* Returns the length of the placeholder at the beginning of `text`, or 0 if there is none. */
static size_t place_at(const char *text, bool *is_seed)
{
    *is_seed = !strncmp(text, place_seed, sizeof place_seed - 1);
    return *is_seed ? sizeof place_seed - 1 : !strncmp(text, place_n, sizeof place_n - 1) ? sizeof place_n - 1 : 0;
}

koksma_status koksma__file_name(const char *path, size_t n, uint64_t seed, char out[KOKSMA_MAX_SPEC])
{
    size_t used = 0;
    while (*path && used < KOKSMA_MAX_SPEC) {
        bool is_seed;
        const size_t length = place_at(path, &is_seed);
        if (length) {
            used += (size_t)snprintf(out + used, KOKSMA_MAX_SPEC - used, "%llu",
                                     is_seed ? (unsigned long long)seed : (unsigned long long)n);
        } else {
            out[used++] = *path;
        }
        path += length ? length : 1;
    }
    KOKSMA__FAIL_IF(used >= KOKSMA_MAX_SPEC, KOKSMA_ARGUMENT,
                    "file: a path with its numbers is longer than %d characters", KOKSMA_MAX_SPEC - 1);
    out[used] = '\0';
    return KOKSMA_OK;
}

/* Makes the glob(3) pattern that finds the files of a path with placeholders; error messages print it, too. */
static void glob_of(const char *path, bool escape, char *out, size_t size)
{
    size_t used = 0;
    while (*path && used + 3 < size) {
        bool is_seed;
        const size_t length = place_at(path, &is_seed);
        if (length) {
            out[used++] = '*';
        } else {
            if (escape && strchr("*?[\\", *path)) {
                out[used++] = '\\';
            }
            out[used++] = *path;
        }
        path += length ? length : 1;
    }
    out[used] = '\0';
}

/* Reads n and seed from a path that glob found. Returns false if the path has another form; no set has 0 points. */
static bool read_numbers(const char *path, const char *found, koksma__file_set *set)
{
    char again[KOKSMA_MAX_SPEC];
    const char *at = path, *text = found;
    *set = (koksma__file_set){0};
    while (*at && *text) {
        bool is_seed;
        const size_t length = place_at(at, &is_seed);
        if (!length) {
            if (*at++ != *text++) {
                return false;
            }
            continue;
        }
        char *end;
        const unsigned long long number = strtoull(text, &end, 10);
        if (*text < '0' || *text > '9' || number > SIZE_MAX) {
            return false;
        }
        if (is_seed) {
            set->seed = number;
        } else {
            set->n = (size_t)number;
        }
        text = end;
        at += length;
    }
    return (set->n || !koksma__file_has(path, place_n)) && !koksma__file_name(path, set->n, set->seed, again) &&
           !strcmp(again, found);
}

static int compare_sets(const void *a, const void *b)
{
    const koksma__file_set *p = a, *q = b;
    return p->n != q->n ? (p->n < q->n ? -1 : 1) : p->seed != q->seed ? (p->seed < q->seed ? -1 : 1) : 0;
}

static koksma_status fail_none(const char *path)
{
    char looked_for[KOKSMA_MAX_SPEC], first[KOKSMA_MAX_SPEC];
    glob_of(path, false, looked_for, sizeof looked_for);
    KOKSMA__TRY(koksma__file_name(path, 256, 0, first));
    return koksma__fail(KOKSMA_MISSING,
                        "file:%s: there is no file %s with whole numbers in place of the stars, such as %s%s%s", path,
                        looked_for, first, koksma__file_has(path, place_n) ? " of 256 points" : "",
                        koksma__file_has(path, place_seed) ? " for seed 0" : "");
}

/* The number of parts of a path that have a placeholder. */
static int placed_parts(const char *path)
{
    int parts = 0;
    while (*path) {
        char part[KOKSMA_MAX_SPEC];
        const size_t length = strcspn(path, "/");
        snprintf(part, sizeof part, "%.*s", (int)length, path);
        parts += koksma__file_is_family(part);
        path += length + (path[length] == '/');
    }
    return parts;
}

koksma_status koksma__file_sets(const char *path, koksma__file_set **sets, size_t *count)
{
    char pattern[2 * KOKSMA_MAX_SPEC];
    glob_t found = {0};
    *sets = NULL;
    *count = 0;
    if (strstr(path, "}{")) {
        return koksma__fail(
            KOKSMA_ARGUMENT,
            "file:%s: its placeholders are adjacent; put a character between them, as in my_{n}_{seed}.npy", path);
    }
    KOKSMA__FAIL_IF(placed_parts(path) > MOST_PARTS, KOKSMA_ARGUMENT,
                    "file:%s: more than %d parts of the path have placeholders; two may, as in {n}/{seed}.npy", path,
                    MOST_PARTS);
    glob_of(path, true, pattern, sizeof pattern);
    const int failed = glob(pattern, GLOB_NOSORT, NULL, &found);
    *sets = failed == GLOB_NOSPACE ? NULL : calloc(found.gl_pathc + 1, sizeof **sets);
    for (size_t i = 0; *sets && i < found.gl_pathc; i++) {
        *count += read_numbers(path, found.gl_pathv[i], &(*sets)[*count]);
    }
    globfree(&found);
    KOKSMA__REQUIRE_MEMORY(*sets, sizeof **sets);
    if (!*count) {
        free(*sets);
        *sets = NULL;
        return fail_none(path);
    }
    qsort(*sets, *count, sizeof **sets, compare_sets);
    return KOKSMA_OK;
}

koksma_status koksma__file_fail_n(const char *path, size_t n, koksma_status status)
{
    char looked_for[KOKSMA_MAX_SPEC];
    glob_of(path, false, looked_for, sizeof looked_for);
    return koksma__fail(status, "file:%s: no file %s has %zu points", path, looked_for, n);
}

koksma_status koksma__file_gap(const koksma_spec *spec, size_t n, koksma_status status)
{
    char text[1024];
    koksma__file_set *sets = NULL;
    size_t count = 0;
    if (status != KOKSMA_MISSING || !koksma__reads_points(spec->pattern) || !koksma__file_has(spec->path, place_n)) {
        return status;
    }
    snprintf(text, sizeof text, "%s", koksma_error_text());
    const koksma_status none = koksma__file_sets(spec->path, &sets, &count);
    if (none) { /* its text names the files that were looked for */
        return none == KOKSMA_MEMORY ? none : status;
    }
    bool gap = true;
    for (size_t i = 0; i < count; i++) {
        gap &= sets[i].n != n;
    }
    free(sets);
    return gap ? koksma__file_fail_n(spec->path, n, KOKSMA_N) : koksma__fail(status, "%s", text);
}

uint64_t koksma__first_seed(const koksma_spec *spec, size_t n)
{
    koksma__file_set *sets = NULL;
    size_t count = 0;
    uint64_t seed = 0;
    if (koksma__reads_points(spec->pattern) && koksma__file_has(spec->path, place_seed) &&
        !koksma__file_sets(spec->path, &sets, &count)) {
        for (size_t i = count; i-- > 0;) {
            seed = sets[i].n == n || !sets[i].n ? sets[i].seed : seed;
        }
        free(sets);
    }
    return seed;
}
