/* SPDX-License-Identifier: Apache-2.0 */
/* Exports the rows of a store, sorted by their keys, as CSV or JSON lines, or as the SHA-256 of the CSV. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/files.h"
#include "core/json_writer.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/report/report.h"
#include "study/run/study.h"
#include "study/store/store.h"

/* The columns: texts of the series, whole numbers of the series, trial and seed, values, and texts of the series again. */
enum { N_COLUMNS = 24, TRIAL = 10, SEED, FIRST_VALUE, N_VALUES = 9, FIRST_LAST = FIRST_VALUE + N_VALUES };

enum { BETWEEN_CALLS = 4096 }; /* rows that are hashed between two calls of keep_going */

static const char *const names[N_COLUMNS] = {
    "kind",  "scene",       "scene_hash",  "options", "pattern",   "what",   "n",       "dim",
    "width", "height",      "trial",       "seed",    "value",     "sd",     "max",     "rmse",
    "p",     "frequency_x", "frequency_y", "robust",  "top_share", "metric", "made_by", "measured_by"};

/* The values that a kind of rows fills: `value`, and then the n columns from column number `first` of the values on. */
static const struct {
    const char *kind;
    int first, n;
} filled[] = {{"image", 1, 3}, {"coherence", 4, 3}, {"metric", 7, 2}};

typedef struct writer {
    FILE *stream;
    koksma__sha256 *hash; /* receives the CSV instead of the stream, unless it is NULL */
    long long series;     /* the id of the series to which `before` and `after` belong; 0: no series */
    char *before, *after; /* the text of a CSV row before its trial, and the text after its values */
    koksma__json_writer json;
    size_t rows;           /* SHA-256: number of rows */
    const koksma_run *run; /* SHA-256: asked whether to go on */
} writer;

/* The text of a column; NULL for a column of numbers. */
static const char *text_of(const koksma__series *s, int k)
{
    const char *const texts[N_COLUMNS] = {
        s->kind,    s->scene,      s->scene_hash, s->options, s->pattern, s->what, [FIRST_LAST] = s->metric,
        s->made_by, s->measured_by};
    return texts[k];
}

static bool is_text(int k)
{
    return k < 6 || k >= FIRST_LAST;
}

static bool is_value(int k)
{
    return k >= FIRST_VALUE && k < FIRST_LAST;
}

/* The whole number of a column, other than the seed. */
static long long whole_of(const koksma__series *s, const koksma__result *result, int k)
{
    const long long wholes[] = {s->n, s->dim, s->width, s->height, result ? result->trial : 0};
    return wholes[k - 6];
}

/* Puts the values of a result into the columns that its kind fills, and NaN into the other columns. */
static void values_of(const koksma__series *s, const koksma__result *result, double values[N_VALUES])
{
    for (int k = 0; k < N_VALUES; k++) {
        values[k] = NAN;
    }
    values[0] = result->values[0];
    for (size_t k = 0; k < sizeof filled / sizeof *filled; k++) {
        if (!strcmp(s->kind, filled[k].kind)) {
            memcpy(&values[filled[k].first], &result->values[1], (size_t)filled[k].n * sizeof *values);
        }
    }
}

/* ---- CSV (RFC 4180) ------------------------------------------------------------------------------------ */

static void put_text(const writer *w, const char *text, size_t length)
{
    if (w->hash) {
        koksma__sha256_add(w->hash, text, length);
    } else {
        fwrite(text, 1, length, w->stream);
    }
}

/* Makes the columns that are the same in all rows of a series. */
static koksma_status begin_series(writer *w, const koksma__series *series)
{
    size_t size[2];
    KOKSMA__FREE(w->before, w->after);
    w->before = w->after = NULL;
    FILE *before = open_memstream(&w->before, &size[0]), *after = open_memstream(&w->after, &size[1]);
    for (int k = 0; before && k < TRIAL; k++) {
        if (is_text(k)) {
            koksma__csv_put(before, text_of(series, k));
        } else {
            fprintf(before, "%llu", (unsigned long long)whole_of(series, NULL, k));
        }
        putc(',', before);
    }
    for (int k = FIRST_LAST; after && k < N_COLUMNS; k++) {
        putc(',', after);
        koksma__csv_put(after, text_of(series, k));
    }
    if (after) {
        putc('\n', after);
    }
    const bool made = before && !fclose(before), ended = after && !fclose(after);
    w->series = series->id;
    return made && ended ? KOKSMA_OK : koksma__fail_memory(1);
}

static koksma_status put_csv(void *context, const koksma__series *series, const koksma__result *result)
{
    writer *w = context;
    char text[(2 + N_VALUES) * (KOKSMA__CSV_NUMBER + 1)];
    double values[N_VALUES];
    if (w->hash && w->rows++ % BETWEEN_CALLS == 0 && !koksma__keep_going(w->run, 0)) {
        return koksma__fail_interrupted();
    }
    KOKSMA__TRY(w->before && series->id == w->series ? KOKSMA_OK : begin_series(w, series));
    values_of(series, result, values);
    size_t length = koksma__csv_whole((uint64_t)result->trial, text);
    text[length++] = ',';
    length += koksma__csv_whole(result->seed, text + length);
    for (int k = 0; k < N_VALUES; k++) {
        text[length++] = ',';
        length += koksma__csv_number(values[k], text + length);
    }
    put_text(w, w->before, strlen(w->before));
    put_text(w, text, length);
    put_text(w, w->after, strlen(w->after));
    return KOKSMA_OK;
}

static void put_csv_header(const writer *w)
{
    for (int k = 0; k < N_COLUMNS; k++) {
        put_text(w, names[k], strlen(names[k]));
        put_text(w, k + 1 < N_COLUMNS ? "," : "\n", 1);
    }
}

/* ---- JSON lines ---------------------------------------------------------------------------------------- */

/* The seed is written as a string, because readers that parse numbers as doubles would lose its last bits. */
static koksma_status put_json(void *context, const koksma__series *series, const koksma__result *result)
{
    writer *w = context;
    char seed[24];
    double values[N_VALUES];
    values_of(series, result, values);
    snprintf(seed, sizeof seed, "%llu", (unsigned long long)result->seed);
    koksma__json_begin_object(&w->json, NULL);
    for (int k = 0; k < N_COLUMNS; k++) {
        if (is_value(k)) {
            koksma__json_write_number(&w->json, names[k], values[k - FIRST_VALUE]);
        } else if (is_text(k) || k == SEED) {
            koksma__json_write_text(&w->json, names[k], k == SEED ? seed : text_of(series, k));
        } else {
            koksma__json_write_whole(&w->json, names[k], whole_of(series, result, k));
        }
    }
    koksma__json_end(&w->json);
    return koksma__json_line(&w->json, w->stream);
}

/* ---- SHA-256 of the CSV -------------------------------------------------------------------------------- */

koksma_status koksma__rows_sha256(koksma__store *store, const koksma_run *run, char text[KOKSMA__SHA256_TEXT])
{
    koksma__sha256 hash;
    writer w = {.hash = &hash, .run = run};
    koksma__sha256_init(&hash);
    put_csv_header(&w);
    const koksma_status status = koksma__store_visit(store, put_csv, &w);
    koksma__sha256_finish(&hash, text);
    KOKSMA__FREE(w.before, w.after);
    return status;
}

/* ---- The export of a store ----------------------------------------------------------------------------- */

static koksma_status write_rows(koksma__store *store, koksma_export_format format, writer *w)
{
    char hash[KOKSMA__SHA256_TEXT];
    koksma_status status = KOKSMA_OK;
    switch (format) {
    case KOKSMA_EXPORT_CSV:
        put_csv_header(w);
        return koksma__store_visit(store, put_csv, w);
    case KOKSMA_EXPORT_JSON:
        return koksma__store_visit(store, put_json, w);
    case KOKSMA_EXPORT_SHA256:
        status = koksma__rows_sha256(store, NULL, hash);
        if (!status) {
            fprintf(w->stream, "%s\n", hash);
        }
        return status;
    }
    return koksma__fail(KOKSMA_ARGUMENT, "no export format %d", (int)format);
}

static bool same_file(const char *a, const char *b)
{
    struct stat info, other;
    return !stat(a, &info) && !stat(b, &other) && info.st_dev == other.st_dev && info.st_ino == other.st_ino;
}

/* Fails if `path` leads to what runs and reports keep in the study's folder, whether it is there yet or not: the store,
   also by another name, where SQLite would expect one of its logs, a report, or the folder of reference images. */
static koksma_status check_target(const char *study, const char *results, const char *path)
{
    static const char *const own[] = {"results.sqlite", "results.sqlite-", "report.json", "report.html",
                                      "references"};
    char references[2 * KOKSMA__PATH], *target = koksma__atomic_target(path);
    if (!target) { /* with reasons other than memory the path can't be opened either */
        return errno == ENOMEM ? koksma__fail_memory(strlen(path)) : KOKSMA_OK;
    }
    char *slash = strrchr(target, '/');
    const char *name = slash ? slash + 1 : target, *folder = slash == target ? "/" : slash ? target : ".";
    bool kept = same_file(results, target);
    if (slash) {
        *slash = '\0';
    }
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        const size_t length = strlen(own[i]);
        const bool same = !strncmp(name, own[i], length) && (!name[length] || own[i][length - 1] == '-');
        kept |= same && same_file(study, folder);
    }
    snprintf(references, sizeof references, "%s/references", study);
    kept |= strcmp(path, "-") && same_file(references, folder);
    free(target);
    KOKSMA__FAIL_IF(kept, KOKSMA_ARGUMENT,
                    "%s: the study keeps its results, reports or reference images there; choose another file", path);
    return KOKSMA_OK;
}

koksma_status koksma_study_export(const char *folder, koksma_export_format format, const char *path)
{
    KOKSMA__REQUIRE(folder, path);
    char results[KOKSMA__PATH];
    koksma__store *store;
    koksma__atomic_file file;
    writer w = {0};
    KOKSMA__TRY(koksma__results_path(folder, results));
    KOKSMA__TRY(check_target(folder, results, path));
    KOKSMA__TRY(koksma__store_open(results, KOKSMA__STORE_READ, NULL, &store));
    koksma_status status = koksma__atomic_open(NULL, path, &file);
    if (!status) {
        w.stream = file.stream;
        status = write_rows(store, format, &w);
        koksma__json_writer_fini(&w.json);
        KOKSMA__FREE(w.before, w.after);
        const koksma_status closed = koksma__atomic_close(&file, !status);
        status = status ? status : closed;
    }
    koksma__store_close(store);
    return status;
}
