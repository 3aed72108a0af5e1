/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Entries: point sets submitted as records, one JSON file each, and their check. The points are decimal numbers of 17
 * digits, which read back to the same doubles. The digest is the SHA-256 of the measure's spec, the author, the dimension
 * and the bits of the coordinates; the value is left out, so that a wrong claim is found by measuring, not by the digest.
 *
 * Where the table has no record, an entry must beat the sets of the listed patterns, those from which a search would start:
 * a table of records that a pattern beats would be none. Up to 512 coordinates that takes seconds at most.
 */
#include <koksma/atlas.h>
#include <koksma/optimise.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/json_writer.h"
#include "core/status.h"
#include "optimise/search.h"
#include "json/json.h"

enum { NUMBER = 32, MOST_LISTED = 512 };
static const double clear = 1e-9,
                    digits = 1e-13; /* clear: a copy is no better, nor one whose points are moved by rounding */

typedef struct entry {
    koksma_points points;
    koksma_spec measure;
    const char *author, *digest; /* in the document */
    double value;
    koksma__json *document;
} entry;

static void find_digest(const koksma_points *points, const char *measure, const char *author,
                        char digest[KOKSMA__SHA256_TEXT])
{
    koksma__sha256 hash;
    char text[NUMBER];
    koksma__sha256_init(&hash);
    koksma__sha256_add(&hash, measure, strlen(measure) + 1);
    koksma__sha256_add(&hash, author, strlen(author) + 1);
    koksma__sha256_add(&hash, text, (size_t)snprintf(text, sizeof text, "%d", points->dim));
    for (size_t i = 0; i < points->n * (size_t)points->dim; i++) {
        uint64_t bits;
        memcpy(&bits, &points->xs[i], sizeof bits);
        koksma__sha256_add(&hash, text, (size_t)snprintf(text, sizeof text, " %016llx", (unsigned long long)bits));
    }
    koksma__sha256_finish(&hash, digest);
}

static koksma_status measure_exactly(const koksma_spec *measure, const koksma_points *points, const koksma_run *run,
                                     double *out)
{
    koksma_value value;
    KOKSMA__FAIL_IF(measure->measure->answer != KOKSMA_ANSWER_EXACT, KOKSMA_ARGUMENT,
                    "%s: an entry's measure has exact values, such as star or l2-star", measure->measure->name);
    KOKSMA__TRY(koksma_evaluate(measure, points, run, &value));
    KOKSMA__FAIL_IF(!value.exact, KOKSMA_UNSUPPORTED, "%s: only bounds are known for these points",
                    measure->measure->name);
    *out = value.value;
    return KOKSMA_OK;
}

koksma_status koksma_entry_text(const koksma_points *points, const koksma_spec *measure, const char *author,
                                const koksma_run *run, char **json)
{
    KOKSMA__REQUIRE(points, measure, author, json);
    KOKSMA__REQUIRE_RUN(run);
    char name[KOKSMA_MAX_SPEC], digest[KOKSMA__SHA256_TEXT];
    koksma__json_writer w = {0};
    double value = 0;
    size_t size;
    KOKSMA__FAIL_IF(!measure->measure, KOKSMA_ARGUMENT, "measure: it must be the spec of a measure");
    KOKSMA__FAIL_IF(!*author, KOKSMA_ARGUMENT, "author: it must not be empty");
    KOKSMA__TRY(measure_exactly(measure, points, run, &value));
    koksma_spec_text(measure, name);
    find_digest(points, name, author, digest);
    koksma__json_begin_object(&w, NULL);
    koksma__json_write_text(&w, "format", "koksma-entry");
    koksma__json_write_whole(&w, "version", 1);
    koksma__json_write_text(&w, "author", author);
    koksma__json_write_text(&w, "measure", name);
    koksma__json_write_whole(&w, "n", (int64_t)points->n);
    koksma__json_write_whole(&w, "dim", points->dim);
    koksma__json_write_number(&w, "value", value);
    koksma__json_write_text(&w, "digest", digest);
    koksma__json_begin_array(&w, "points");
    for (size_t i = 0; i < points->n; i++) {
        koksma__json_break(&w);
        koksma__json_begin_array(&w, NULL);
        for (int k = 0; k < points->dim; k++) {
            koksma__json_write_number(&w, NULL, points->xs[i * (size_t)points->dim + (size_t)k]);
        }
        koksma__json_end(&w);
    }
    koksma__json_end(&w);
    koksma__json_end(&w);
    return koksma__json_finish(&w, json, &size);
}

/* ---- Reading --------------------------------------------------------------------------------------------------- */

static koksma_status read_points(const koksma__json_node *root, entry *e)
{
    koksma__json_node list;
    long long n, dim;
    size_t length;
    KOKSMA__TRY(koksma__json_get_whole(root, "n", true, 1, (long long)KOKSMA_MAX_COORDINATES, &n));
    KOKSMA__TRY(koksma__json_get_whole(root, "dim", true, 1, KOKSMA_MAX_DIM, &dim));
    KOKSMA__TRY(koksma__json_member(root, "points", &list));
    KOKSMA__TRY(koksma__json_length(&list, KOKSMA_MAX_COORDINATES, &length));
    KOKSMA__JSON_FAIL_IF(length != (size_t)n, &list, "it has %zu points, and n is %lld", length, n);
    KOKSMA__TRY(koksma_points_init(&e->points, length, (int)dim));
    for (size_t i = 0; i < length; i++) {
        const koksma__json_node point = koksma__json_item(&list, i);
        KOKSMA__TRY(koksma__json_numbers(&point, 0, 1, (size_t)dim, e->points.xs + i * (size_t)dim));
    }
    return KOKSMA_OK;
}

static koksma_status read_entry(const char *path, entry *e)
{
    static const char *const keys[] = {"format", "version", "author", "measure", "n",
                                       "dim",    "value",   "digest", "points",  NULL};
    unsigned char *bytes;
    size_t size;
    const char *format, *measure;
    long long version;
    *e = (entry){0};
    KOKSMA__TRY(koksma__read_file(path, KOKSMA__FILE_PARAMETERS, KOKSMA__BY_USER, koksma__check_text, &bytes, &size));
    const koksma_status status = koksma__json_open("entry", path, (char *)bytes, size, &e->document);
    free(bytes);
    KOKSMA__TRY(status);
    const koksma__json_node root = koksma__json_root(e->document);
    KOKSMA__TRY(koksma__json_get_text(&root, "format", true, &format));
    KOKSMA__JSON_FAIL_IF(strcmp(format, "koksma-entry") != 0, &root, "format is '%s', not 'koksma-entry'", format);
    KOKSMA__TRY(koksma__json_only(&root, keys));
    KOKSMA__TRY(koksma__json_get_whole(&root, "version", true, 1, 1, &version));
    KOKSMA__TRY(koksma__json_get_text(&root, "author", true, &e->author));
    KOKSMA__TRY(koksma__json_get_text(&root, "digest", true, &e->digest));
    KOKSMA__TRY(koksma__json_get_number(&root, "value", true, 0, HUGE_VAL, &e->value));
    KOKSMA__TRY(koksma__json_get_text(&root, "measure", true, &measure));
    koksma__json_node node;
    KOKSMA__TRY(koksma__json_member(&root, "measure", &node));
    if (koksma_measure_spec(measure, &e->measure)) {
        return koksma__json_fail_in(&node, KOKSMA_MALFORMED);
    }
    KOKSMA__JSON_FAIL_IF(e->measure.measure->answer != KOKSMA_ANSWER_EXACT, &node,
                         "'%s' has no exact values; an entry's measure does, such as star", measure);
    return read_points(&root, e);
}

static void entry_fini(entry *e)
{
    koksma_points_fini(&e->points);
    koksma__json_close(e->document);
}

/* ---- The check ------------------------------------------------------------------------------------------------- */

static bool is_rival(const entry *e, const koksma_entry_result *mine, const char *measure, size_t n, int dim)
{
    return e->points.n == n && e->points.dim == dim && !strcmp(mine->measure, measure);
}

/* Compares an entry with the value of a set of the same measure and size, which it must beat. */
static void compare(const entry *e, koksma_entry_result *r, double value, const char *name)
{
    const double sign = e->measure.measure->larger_is_better ? 1 : -1;
    if (isnan(r->record) || sign * value > sign * r->record) {
        r->record = value;
    }
    if (!strcmp(r->verdict, "accepted") && !(sign * (r->value - value) > clear)) {
        r->verdict = "worse";
        koksma__snprintf(r->reason, sizeof r->reason,
                         "%.17g is not better by more than %g than %.17g, the value of %.150s", r->value, clear,
                         value, name);
    }
}

/* Returns whether the table has a record of an entry's measure, number of points and dimension. */
static bool compare_record(const entry *e, koksma_entry_result *r)
{
    const koksma_record *record;
    bool found = false;
    for (size_t i = 0; (record = koksma_record_at(i)); i++) {
        if (is_rival(e, r, record->measure, record->n, record->dim)) {
            char name[KOKSMA_MAX_SPEC + 64];
            snprintf(name, sizeof name, "record:measure=%s@%zu@%d", record->measure, record->n, record->dim);
            compare(e, r, record->value, name);
            found = true;
        }
    }
    return found;
}

/* The best value of the listed patterns so far. */
typedef struct listed {
    const koksma_spec *measure;
    const koksma_run *run;
    double value;
} listed;

static koksma_status consider(void *context, const koksma_points *points)
{
    listed *l = context;
    double value;
    KOKSMA__FAIL_IF(!points, KOKSMA_INTERRUPTED, "interrupted");
    const koksma_status status = measure_exactly(l->measure, points, l->run, &value);
    if (!status && !(l->measure->measure->larger_is_better ? value <= l->value : value >= l->value)) {
        l->value = value;
    }
    return status == KOKSMA_MEMORY || status == KOKSMA_INTERRUPTED ? status : KOKSMA_OK;
}

/* Compares an entry for which the table has no record with the listed patterns. first: no entry before it was accepted. */
static koksma_status compare_patterns(const entry *e, koksma_entry_result *r, bool first, const koksma_run *run)
{
    const size_t n = e->points.n, dim = (size_t)e->points.dim;
    const koksma_optimise_options options = {.n = n, .dim = e->points.dim};
    listed l = {.measure = &e->measure, .run = run, .value = NAN};
    char name[KOKSMA_MAX_SPEC + 96];
    koksma_status status = KOKSMA_OK;
    if (n * dim <= MOST_LISTED) {
        status = koksma__search_starts(&e->measure, &options, false, run, consider, &l);
        status = status ? status : koksma__search_starts(&e->measure, &options, true, run, consider, &l);
        snprintf(name, sizeof name, "the best listed pattern ('koksma optimise %s -n %zu -d %zu --steps 0')",
                 r->measure, n, dim);
        if (!status && !isnan(l.value)) {
            compare(e, r, l.value, name);
        }
    }
    if (first && !status && !strcmp(r->verdict, "accepted")) {
        koksma__snprintf(r->reason, sizeof r->reason,
                         isnan(l.value)
                             ? "first entry for %.200s, n = %zu, dim = %zu; nothing to compare with (patterns: up to "
                               "512 coordinates)"
                             : "first entry for %.200s, n = %zu, dim = %zu; the best listed pattern has %.17g",
                         r->measure, n, dim, l.value);
    }
    return status;
}

static koksma_status check(const entry *entries, const char *const *paths, koksma_entry_result *results, size_t i,
                           const koksma_run *run)
{
    const entry *e = &entries[i];
    koksma_entry_result *r = &results[i];
    char digest[KOKSMA__SHA256_TEXT];
    *r = (koksma_entry_result){.verdict = "accepted", .n = e->points.n, .dim = e->points.dim, .claimed = e->value};
    r->value = r->record = NAN;
    koksma_spec_text(&e->measure, r->measure);
    find_digest(&e->points, r->measure, e->author, digest);
    if (strcmp(digest, e->digest) != 0) {
        r->verdict = "altered";
        snprintf(r->reason, sizeof r->reason, "the points, the measure or the author are not those of the digest");
        return KOKSMA_OK;
    }
    KOKSMA__TRY(measure_exactly(&e->measure, &e->points, run, &r->value));
    if (!(fabs(r->value - e->value) <= digits * fabs(r->value))) {
        r->verdict = "false";
        koksma__snprintf(r->reason, sizeof r->reason, "it claims %.17g, and the points have %.17g", e->value,
                         r->value);
        return KOKSMA_OK;
    }
    const bool has_record = compare_record(e, r);
    bool first = true;
    for (size_t k = 0; k < i; k++) {
        const bool sound = !isnan(results[k].value) && strcmp(results[k].verdict, "false") != 0;
        if (sound && is_rival(e, r, results[k].measure, results[k].n, results[k].dim)) {
            first = first && strcmp(results[k].verdict, "accepted") != 0;
            compare(e, r, results[k].value, paths[k]);
        }
    }
    return has_record ? KOKSMA_OK : compare_patterns(e, r, first, run);
}

/* Reads and checks entry i. A file that is no entry has this verdict. */
static koksma_status check_file(entry *entries, const char *const *paths, koksma_entry_result *results, size_t i,
                                const koksma_run *run)
{
    koksma_entry_result *r = &results[i];
    *r = (koksma_entry_result){.claimed = NAN, .value = NAN, .record = NAN};
    koksma_status status = read_entry(paths[i], &entries[i]);
    status = status ? status : check(entries, paths, results, i, run);
    if (status == KOKSMA_OK || status == KOKSMA_MEMORY || status == KOKSMA_INTERRUPTED) {
        return status;
    }
    r->verdict = "invalid";
    r->status = status;
    r->value = NAN;
    snprintf(r->reason, sizeof r->reason, "%s", koksma_error_text());
    return KOKSMA_OK;
}

koksma_status koksma_entries_check(const char *const *paths, size_t n, const koksma_run *run,
                                   koksma_entry_result *results)
{
    KOKSMA__REQUIRE(paths, results);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!n, KOKSMA_ARGUMENT, "n: there must be at least one entry");
    KOKSMA__TRY(koksma__array_check("paths", paths, n, sizeof *paths));
    KOKSMA__FAIL_IF(n > SIZE_MAX / sizeof(entry) / 2, KOKSMA_ARGUMENT, "n: too many entries");
    for (size_t i = 0; i < n; i++) {
        KOKSMA__FAIL_IF(!paths[i], KOKSMA_ARGUMENT, "paths[%zu] is NULL", i);
    }
    entry *entries = calloc(n, sizeof *entries);
    KOKSMA__REQUIRE_MEMORY(entries, n * sizeof *entries);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < n && !status; i++) {
        status = check_file(entries, paths, results, i, run);
    }
    for (size_t i = 0; i < n; i++) {
        entry_fini(&entries[i]);
    }
    free(entries);
    return status;
}
