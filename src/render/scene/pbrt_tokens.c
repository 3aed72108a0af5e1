/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Splits pbrt-v4's scene files into tokens: words, texts in quotation marks, and brackets; '#' starts a comment.
 * A parameter is a text "type name" and a value, or values in brackets. Numbers are rounded to floats, as in pbrt
 * itself; integers are exact. Only parameters are copied, and their number and lengths are limited.
 */
#include "scene/pbrt.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "meshes/mesh_text.h"

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

static void skip(koksma__pbrt_source *s)
{
    for (; s->at < s->end && (is_blank(*s->at) || *s->at == '#'); s->at++) {
        if (*s->at == '#') {
            const char *stop = memchr(s->at, '\n', (size_t)(s->end - s->at));
            s->at = stop ? stop : s->end - 1;
        }
        s->place.line += *s->at == '\n';
    }
}

koksma_status koksma__pbrt_token_next(koksma__pbrt_source *s, koksma__pbrt_token *out)
{
    skip(s);
    *out = (koksma__pbrt_token){.at = s->at};
    if (s->at == s->end) {
        return KOKSMA_OK;
    }
    if (*s->at == '"') {
        const char *stop = memchr(s->at + 1, '"', (size_t)(s->end - s->at - 1));
        if (!stop || memchr(s->at, '\n', (size_t)(stop - s->at))) {
            return koksma__import_fail(s->place, "a text has no closing quotation mark");
        }
        *out = (koksma__pbrt_token){KOKSMA__PBRT_TEXT, s->at + 1, (size_t)(stop - s->at - 1)};
        s->at = stop + 1;
        return KOKSMA_OK;
    }
    if (*s->at == '[' || *s->at == ']') {
        *out = (koksma__pbrt_token){KOKSMA__PBRT_BRACKET, s->at++, 1};
        return KOKSMA_OK;
    }
    while (s->at < s->end && !is_blank(*s->at) && !strchr("[]\"#", *s->at)) {
        s->at++;
    }
    out->kind = KOKSMA__PBRT_WORD;
    out->length = (size_t)(s->at - out->at);
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_token_peek(koksma__pbrt_source *s, koksma__pbrt_token *out)
{
    koksma__pbrt_source ahead = *s;
    return koksma__pbrt_token_next(&ahead, out);
}

koksma_status koksma__pbrt_text(koksma__pbrt_source *s, char *out, size_t size)
{
    koksma__pbrt_token t;
    KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
    if (t.kind != KOKSMA__PBRT_TEXT || t.length >= size) {
        return koksma__import_fail(s->place, "expected a text in quotation marks, shorter than %zu characters", size);
    }
    memcpy(out, t.at, t.length);
    out[t.length] = 0;
    return KOKSMA_OK;
}

/* Fails with "FILE:LINE: NAME: 'TOKEN' is not EXPECTED". */
static koksma_status wrong(const koksma__pbrt_source *s, const koksma__pbrt_token *t, const char *name,
                           const char *expected)
{
    return t->kind == KOKSMA__PBRT_END
               ? koksma__import_fail(s->place, "%s: the file ends where %s belongs", name, expected)
               : koksma__import_fail(s->place, "%s: '%.*s' is not %s", name, t->length < 40 ? (int)t->length : 40,
                                     t->at, expected);
}

static koksma_status number_of(const koksma__pbrt_source *s, const koksma__pbrt_token *t, const char *name,
                               bool whole, double *out)
{
    const char *at = t->at, *end = t->at + t->length;
    const bool negative = t->length && *at == '-';
    long long count;
    float value = 0;
    bool read = false;
    if (t->kind == KOKSMA__PBRT_WORD && whole) {
        at += negative;
        read = koksma__text_whole(&at, end, &count) && at == end;
        *out = negative ? -(double)count : (double)count;
    }
    if (t->kind == KOKSMA__PBRT_WORD && !read) { /* integers may be written with a decimal point */
        at = t->at;
        read = koksma__text_float(&at, end, &value) && at == end && (!whole || value == floorf(value));
        *out = (double)value;
    }
    return read && isfinite(*out) ? KOKSMA_OK
                                  : wrong(s, t, name,
                                          whole  ? "a whole number"
                                          : read ? "a finite number"
                                                 : "a number");
}

koksma_status koksma__pbrt_numbers(koksma__pbrt_source *s, size_t n, double *out)
{
    koksma__pbrt_token t;
    const char *name = s->directive ? s->directive : "";
    KOKSMA__TRY(koksma__pbrt_token_peek(s, &t));
    const bool bracket = t.kind == KOKSMA__PBRT_BRACKET && *t.at == '[';
    for (size_t i = 0; i < n + (bracket ? 2 : 0); i++) {
        KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
        if (!bracket || (i > 0 && i <= n)) {
            KOKSMA__TRY(number_of(s, &t, name, false, out + i - bracket));
        }
    }
    return bracket && (t.kind != KOKSMA__PBRT_BRACKET || *t.at != ']')
               ? koksma__import_fail(s->place, "%s: expected %zu numbers", name, n)
               : KOKSMA_OK;
}

/* The types of parameters. "point", "vector", "normal3" and "color" are names of earlier versions. */
typedef struct parameter_type {
    const char *name;
    enum { NUMBERS, WHOLE, FLAGS, TEXTS, EITHER } holds; /* EITHER: all values are numbers, or all are texts */
    size_t each;                                         /* number of numbers in each value */
} parameter_type;

static const parameter_type types[] = {{"float", NUMBERS, 1},   {"integer", WHOLE, 1},  {"bool", FLAGS, 1},
                                       {"string", TEXTS, 1},    {"texture", TEXTS, 1},  {"point2", NUMBERS, 2},
                                       {"vector2", NUMBERS, 2}, {"point3", NUMBERS, 3}, {"vector3", NUMBERS, 3},
                                       {"normal", NUMBERS, 3},  {"rgb", NUMBERS, 3},    {"blackbody", NUMBERS, 1},
                                       {"spectrum", EITHER, 2}, {"point", NUMBERS, 3},  {"vector", NUMBERS, 3},
                                       {"normal3", NUMBERS, 3}, {"color", NUMBERS, 3}};

/* Reads the text "type name" of a parameter. */
static koksma_status take_name(koksma__pbrt_source *s, koksma__pbrt_parameter *p)
{
    char both[64], *name;
    KOKSMA__TRY(koksma__pbrt_text(s, both, sizeof both));
    char *type = both + strspn(both, " \t");
    name = type + strcspn(type, " \t");
    if (!*type || !*name || name - type >= (long)sizeof p->type) {
        return koksma__import_fail(s->place, "'%s': a parameter has a type and a name", both);
    }
    *name++ = 0;
    name += strspn(name, " \t");
    name[strcspn(name, " \t")] = 0;
    snprintf(p->type, sizeof p->type, "%s", type);
    snprintf(p->name, sizeof p->name, "%.39s", name);
    return KOKSMA_OK;
}

static koksma_status take_text(koksma__pbrt_source *s, const koksma__pbrt_token *t, koksma__pbrt_parameter *p)
{
    if (t->length >= sizeof p->text) {
        return koksma__import_fail(s->place, "%s: the text is longer than %zu characters", p->name,
                                   sizeof p->text - 1);
    }
    if (!p->n_texts++) {
        memcpy(p->text, t->at, t->length);
        p->text[t->length] = 0;
    } else if (p->n_texts == 2) {
        snprintf(p->second, sizeof p->second, "%.*s", (int)t->length, t->at);
    }
    return KOKSMA_OK;
}

static koksma_status take_value(koksma__pbrt_source *s, const koksma__pbrt_token *t, const parameter_type *type,
                                koksma__pbrt_parameter *p)
{
    const bool quoted = t->kind == KOKSMA__PBRT_TEXT;
    if (type->holds == FLAGS) {
        return t->kind != KOKSMA__PBRT_BRACKET &&
                       (koksma__text_is(t->at, t->length, "true") || koksma__text_is(t->at, t->length, "false"))
                   ? take_text(s, t, p)
                   : wrong(s, t, p->name, "true or false");
    }
    if (type->holds == TEXTS || (type->holds == EITHER && (p->n_texts || (quoted && !p->n)))) {
        return quoted ? take_text(s, t, p) : wrong(s, t, p->name, "a text in quotation marks");
    }
    double *to = koksma__add_one(&p->numbers, &p->n, sizeof *to);
    return to ? number_of(s, t, p->name, type->holds == WHOLE, to) : KOKSMA_MEMORY;
}

/* Reads the values of a parameter: one without brackets, or some within them. */
static koksma_status take_values(koksma__pbrt_source *s, koksma__pbrt_parameter *p)
{
    const parameter_type *type = NULL;
    koksma__pbrt_token t;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        type = !strcmp(types[i].name, p->type) ? &types[i] : type;
    }
    if (!type) {
        return koksma__import_fail(s->place, "%s: '%s' is not a type of pbrt-v4", p->name, p->type);
    }
    KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
    if (t.kind != KOKSMA__PBRT_BRACKET) {
        KOKSMA__TRY(take_value(s, &t, type, p));
    }
    while (t.kind == KOKSMA__PBRT_BRACKET) {
        koksma__pbrt_token value;
        KOKSMA__TRY(koksma__pbrt_token_next(s, &value));
        if (value.kind == KOKSMA__PBRT_BRACKET && *value.at == ']') {
            break;
        }
        if (value.kind == KOKSMA__PBRT_END) {
            return koksma__import_fail(s->place, "%s: the list has no closing bracket", p->name);
        }
        KOKSMA__TRY(take_value(s, &value, type, p));
    }
    if (!p->n && !p->n_texts) {
        return koksma__import_fail(s->place, "%s: a list without values", p->name);
    }
    return p->n % type->each ? koksma__import_fail(s->place, "%s: %zu numbers, but each '%s' has %zu", p->name, p->n,
                                                   p->type, type->each)
                             : KOKSMA_OK;
}

/* Adds a parameter without name and values. */
static koksma_status add(const koksma__pbrt_source *s, koksma__pbrt_parameters *to, koksma__pbrt_parameter **out)
{
    if (to->n == KOKSMA__MAX_PBRT_PARAMETERS) {
        return koksma__import_fail(s->place, "more than %d parameters", KOKSMA__MAX_PBRT_PARAMETERS);
    }
    koksma__pbrt_parameter *p = *out = &to->items[to->n++];
    *p->type = *p->name = *p->text = *p->second = 0;
    p->numbers = NULL;
    p->n = p->n_texts = 0;
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_parameter_copy(const koksma__pbrt_parameter *from, koksma__pbrt_parameter *out)
{
    *out = *from;
    out->numbers = from->n ? malloc(from->n * sizeof *out->numbers) : NULL;
    if (from->n && !out->numbers) {
        out->n = 0;
        return koksma__fail_memory(from->n * sizeof *out->numbers);
    }
    if (from->n) {
        memcpy(out->numbers, from->numbers, from->n * sizeof *out->numbers);
    }
    return KOKSMA_OK;
}

/* Takes the attributes of the directive's target. A parameter of the directive's own comes later, and so has priority. */
static koksma_status inherit(const koksma__pbrt_source *s, koksma__pbrt_parameters *out)
{
    koksma__pbrt_parameter *p;
    for (size_t i = 0; i < out->n_attributes; i++) {
        if (!strcmp(out->attributes[i].target, out->target)) {
            KOKSMA__TRY(add(s, out, &p));
            KOKSMA__TRY(koksma__pbrt_parameter_copy(&out->attributes[i].parameter, p));
        }
    }
    out->n_inherited = out->n;
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_parameters_read(koksma__pbrt_source *s, koksma__pbrt_parameters *out)
{
    koksma__pbrt_token t;
    out->n = 0;
    out->place = s->place;
    KOKSMA__TRY(inherit(s, out));
    for (;;) {
        koksma__pbrt_parameter *p = NULL;
        KOKSMA__TRY(koksma__pbrt_token_peek(s, &t));
        if (t.kind != KOKSMA__PBRT_TEXT) {
            return out->judge ? out->judge(out->reader) : KOKSMA_OK;
        }
        KOKSMA__TRY(add(s, out, &p));
        KOKSMA__TRY(take_name(s, p));
        p->line = s->place.line;
        KOKSMA__TRY(take_values(s, p));
    }
}

void koksma__pbrt_parameters_fini(koksma__pbrt_parameters *parameters)
{
    for (size_t i = 0; i < parameters->n; i++) {
        free(parameters->items[i].numbers);
    }
    parameters->n = parameters->n_inherited = 0;
}
