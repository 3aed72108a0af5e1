/* SPDX-License-Identifier: Apache-2.0 */
/* The rows of a store in formats that others read, sorted by their keys. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/atomic_file.h"
#include "core/c_locale.h"
#include "core/status.h"
#include "study/run/study.h"
#include "study/store/store.h"

enum { N_TEXTS = 6, N_WHOLES = 4, N_VALUES = 7 };

static const char *const text_names[N_TEXTS] = {"kind", "scene", "scene_hash", "options", "pattern", "what"};
static const char *const whole_names[N_WHOLES] = {"n", "dim", "width", "height"};
static const char *const value_names[N_VALUES] = {"value", "sd", "max", "rmse", "p", "frequency_x", "frequency_y"};

typedef struct writer {
    FILE *stream;
    size_t rows, widths[N_TEXTS]; /* of NPY's byte strings */
} writer;

static const char *text_of(const koksma__series *s, int k)
{
    const char *const texts[N_TEXTS] = {s->kind, s->scene, s->scene_hash, s->options, s->pattern, s->what};
    return texts[k];
}

static long long whole_of(const koksma__series *s, int k)
{
    const long long wholes[N_WHOLES] = {s->n, s->dim, s->width, s->height};
    return wholes[k];
}

/* A result's values in the columns of its kind; NaN in the others. */
static void values_of(const koksma__series *s, const koksma__result *result, double values[N_VALUES])
{
    const int first = strcmp(s->kind, "coherence") ? 1 : KOKSMA__RESULT_VALUES;
    for (int k = 0; k < N_VALUES; k++) {
        values[k] = NAN;
    }
    values[0] = result->values[0];
    memcpy(&values[first], &result->values[1], (KOKSMA__RESULT_VALUES - 1) * sizeof *values);
}

/* ---- CSV (RFC 4180) ------------------------------------------------------------------------------------ */

static void put_csv_text(FILE *f, const char *text)
{
    if (!strpbrk(text, ",\"\r\n")) {
        fputs(text, f);
        return;
    }
    putc('"', f);
    for (; *text; text++) {
        if (*text == '"') {
            putc('"', f);
        }
        putc(*text, f);
    }
    putc('"', f);
}

static koksma_status put_csv(void *context, const koksma__series *series, const koksma__result *result)
{
    FILE *f = ((writer *)context)->stream;
    double values[N_VALUES];
    values_of(series, result, values);
    for (int k = 0; k < N_TEXTS; k++) {
        put_csv_text(f, text_of(series, k));
        putc(',', f);
    }
    for (int k = 0; k < N_WHOLES; k++) {
        fprintf(f, "%lld,", whole_of(series, k));
    }
    fprintf(f, "%lld,%llu", result->trial, (unsigned long long)result->seed);
    for (int k = 0; k < N_VALUES; k++) {
        putc(',', f);
        if (!isnan(values[k])) {
            koksma__fprintf(f, "%.17g", values[k]);
        }
    }
    putc('\n', f);
    return KOKSMA_OK;
}

static void put_csv_header(FILE *f)
{
    for (int k = 0; k < N_TEXTS; k++) {
        fprintf(f, "%s,", text_names[k]);
    }
    for (int k = 0; k < N_WHOLES; k++) {
        fprintf(f, "%s,", whole_names[k]);
    }
    fputs("trial,seed", f);
    for (int k = 0; k < N_VALUES; k++) {
        fprintf(f, ",%s", value_names[k]);
    }
    putc('\n', f);
}

/* ---- JSON lines ---------------------------------------------------------------------------------------- */

static void put_json_text(FILE *f, const char *text)
{
    putc('"', f);
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '"' || c == '\\') {
            fprintf(f, "\\%c", c);
        } else if (c < 0x20) {
            fprintf(f, "\\u%04x", c);
        } else {
            putc(c, f);
        }
    }
    putc('"', f);
}

/* The seed is a text: readers that take numbers for doubles would lose its last bits. JSON has no infinity. */
static koksma_status put_json(void *context, const koksma__series *series, const koksma__result *result)
{
    FILE *f = ((writer *)context)->stream;
    double values[N_VALUES];
    values_of(series, result, values);
    for (int k = 0; k < N_TEXTS; k++) {
        fprintf(f, "%s\"%s\":", k ? "," : "{", text_names[k]);
        put_json_text(f, text_of(series, k));
    }
    for (int k = 0; k < N_WHOLES; k++) {
        fprintf(f, ",\"%s\":%lld", whole_names[k], whole_of(series, k));
    }
    fprintf(f, ",\"trial\":%lld,\"seed\":\"%llu\"", result->trial, (unsigned long long)result->seed);
    for (int k = 0; k < N_VALUES; k++) {
        koksma__fprintf(f, !isfinite(values[k]) ? ",\"%s\":null" : ",\"%s\":%.17g", value_names[k], values[k]);
    }
    fputs("}\n", f);
    return KOKSMA_OK;
}

/* ---- NPY: an array of records, little-endian ------------------------------------------------------------ */

static koksma_status measure_npy(void *context, const koksma__series *series, const koksma__result *result)
{
    writer *w = context;
    (void)result;
    w->rows++;
    for (int k = 0; k < N_TEXTS; k++) {
        const size_t width = strlen(text_of(series, k));
        w->widths[k] = width > w->widths[k] ? width : w->widths[k];
    }
    return KOKSMA_OK;
}

/* Version 1.0 of the format: the magic bytes, the length of a Python literal padded to a multiple of 64, the literal.
 */
static void put_npy_header(const writer *w)
{
    char header[1024];
    int size = snprintf(header, sizeof header, "{'descr': [");
    for (int k = 0; k < N_TEXTS; k++) {
        size += snprintf(header + size, sizeof header - (size_t)size, "('%s', '|S%zu'), ", text_names[k],
                         w->widths[k] ? w->widths[k] : 1);
    }
    for (int k = 0; k < N_WHOLES; k++) {
        size += snprintf(header + size, sizeof header - (size_t)size, "('%s', '<i8'), ", whole_names[k]);
    }
    size += snprintf(header + size, sizeof header - (size_t)size, "('trial', '<i8'), ('seed', '<u8')");
    for (int k = 0; k < N_VALUES; k++) {
        size += snprintf(header + size, sizeof header - (size_t)size, ", ('%s', '<f8')", value_names[k]);
    }
    size += snprintf(header + size, sizeof header - (size_t)size, "], 'fortran_order': False, 'shape': (%zu,), }",
                     w->rows);
    const int total = (10 + size + 1 + 63) / 64 * 64;
    fprintf(w->stream, "%cNUMPY%c%c%c%c", 0x93, 1, 0, (total - 10) & 255, (total - 10) >> 8);
    fprintf(w->stream, "%-*s\n", total - 11, header);
}

static void put_word(FILE *f, uint64_t word)
{
    for (int i = 0; i < 8; i++) {
        putc((int)(word >> 8 * i & 255), f);
    }
}

static koksma_status put_npy(void *context, const koksma__series *series, const koksma__result *result)
{
    const writer *w = context;
    double values[N_VALUES];
    values_of(series, result, values);
    for (int k = 0; k < N_TEXTS; k++) {
        const char *text = text_of(series, k);
        const size_t length = strlen(text), width = w->widths[k] ? w->widths[k] : 1;
        fwrite(text, 1, length, w->stream);
        for (size_t i = length; i < width; i++) {
            putc(0, w->stream);
        }
    }
    for (int k = 0; k < N_WHOLES; k++) {
        put_word(w->stream, (uint64_t)whole_of(series, k));
    }
    put_word(w->stream, (uint64_t)result->trial);
    put_word(w->stream, result->seed);
    for (int k = 0; k < N_VALUES; k++) {
        uint64_t word;
        memcpy(&word, &values[k], sizeof word);
        put_word(w->stream, isnan(values[k]) ? UINT64_C(0x7ff8000000000000) : word);
    }
    return KOKSMA_OK;
}

/* ---- The whole ----------------------------------------------------------------------------------------- */

static koksma_status write_rows(koksma__store *store, koksma_export_format format, writer *w)
{
    koksma_status status = KOKSMA_OK;
    switch (format) {
    case KOKSMA_EXPORT_CSV:
        put_csv_header(w->stream);
        return koksma__store_visit(store, put_csv, w);
    case KOKSMA_EXPORT_JSON:
        return koksma__store_visit(store, put_json, w);
    case KOKSMA_EXPORT_NPY:
        status = koksma__store_visit(store, measure_npy, w);
        if (!status) {
            put_npy_header(w);
            status = koksma__store_visit(store, put_npy, w);
        }
        return status;
    }
    return koksma__fail(KOKSMA_ARGUMENT, "no export format %d", (int)format);
}

koksma_status koksma_study_export(const char *folder, koksma_export_format format, const char *path)
{
    char results[KOKSMA__PATH];
    koksma__store *store;
    koksma__atomic_file file;
    writer w = {0};
    snprintf(results, sizeof results, "%s/results.sqlite", folder);
    koksma_status status = koksma__store_open(results, KOKSMA__STORE_READ, NULL, &store);
    if (status) {
        return status;
    }
    status = koksma__atomic_open(path, &file);
    if (!status) {
        w.stream = file.stream;
        status = write_rows(store, format, &w);
        const koksma_status closed = koksma__atomic_close(&file, !status);
        status = status ? status : closed;
    }
    koksma__store_close(store);
    return status;
}
