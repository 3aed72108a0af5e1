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

koksma__pbrt_token koksma__pbrt_token_next(koksma__pbrt_source *s)
{
    skip(s);
    const char *at = s->at;
    if (at == s->end) {
        return (koksma__pbrt_token){.at = at};
    }
    if (*at == '"') {
        const char *stop = memchr(at + 1, '"', (size_t)(s->end - at - 1));
        koksma__import_fail_if(!stop || memchr(at, '\n', (size_t)(stop - at)), s->place,
                               "a text has no closing quotation mark");
        s->at = stop + 1;
        return (koksma__pbrt_token){KOKSMA__PBRT_TEXT, at + 1, (size_t)(stop - at - 1)};
    }
    if (*at == '[' || *at == ']') {
        return (koksma__pbrt_token){KOKSMA__PBRT_BRACKET, s->at++, 1};
    }
    while (s->at < s->end && !is_blank(*s->at) && !strchr("[]\"#", *s->at)) {
        s->at++;
    }
    return (koksma__pbrt_token){KOKSMA__PBRT_WORD, at, (size_t)(s->at - at)};
}

koksma__pbrt_token koksma__pbrt_token_peek(koksma__pbrt_source *s)
{
    koksma__pbrt_source ahead = *s;
    return koksma__pbrt_token_next(&ahead);
}

void koksma__pbrt_text(koksma__pbrt_source *s, char *out, size_t size)
{
    const koksma__pbrt_token t = koksma__pbrt_token_next(s);
    koksma__import_fail_if(t.kind != KOKSMA__PBRT_TEXT || t.length >= size, s->place,
                           "expected a text in quotation marks, shorter than %zu characters", size);
    memcpy(out, t.at, t.length);
    out[t.length] = 0;
}

/* Fails with "FILE:LINE: NAME: 'TOKEN' is not EXPECTED", unless `is_right`. */
static void need(bool is_right, const koksma__pbrt_source *s, const koksma__pbrt_token *t, const char *name,
                 const char *expected)
{
    koksma__import_fail_if(!is_right && t->kind == KOKSMA__PBRT_END, s->place, "%s: the file ends where %s belongs",
                           name, expected);
    koksma__import_fail_if(!is_right, s->place, "%s: '%.*s' is not %s", name, t->length < 40 ? (int)t->length : 40,
                           t->at, expected);
}

static double number_of(const koksma__pbrt_source *s, const koksma__pbrt_token *t, const char *name, bool whole)
{
    const char *at = t->at, *end = t->at + t->length;
    const bool negative = t->length && *at == '-';
    long long count;
    float value = 0;
    double out = 0;
    bool read = false;
    if (t->kind == KOKSMA__PBRT_WORD && whole) {
        at += negative;
        read = koksma__text_whole(&at, end, &count) && at == end;
        out = !read ? 0 : negative ? -(double)count : (double)count;
    }
    if (t->kind == KOKSMA__PBRT_WORD && !read) { /* integers may be written with a decimal point */
        at = t->at;
        read = koksma__text_float(&at, end, &value) && at == end && (!whole || value == floorf(value));
        out = (double)value;
    }
    need(read && isfinite(out), s, t, name, whole ? "a whole number" : read ? "a finite number" : "a number");
    return out;
}

static bool is_bracket(const koksma__pbrt_token *t, char which)
{
    return t->kind == KOKSMA__PBRT_BRACKET && *t->at == which;
}

void koksma__pbrt_numbers(koksma__pbrt_source *s, size_t n, double *out)
{
    const char *name = s->directive ? s->directive : "";
    koksma__pbrt_token t = koksma__pbrt_token_peek(s);
    const bool bracket = is_bracket(&t, '[');
    for (size_t i = 0; i < n + (bracket ? 2 : 0); i++) {
        t = koksma__pbrt_token_next(s);
        if (!bracket || (i > 0 && i <= n)) {
            out[i - bracket] = number_of(s, &t, name, false);
        }
    }
    koksma__import_fail_if(bracket && !is_bracket(&t, ']'), s->place, "%s: expected %zu numbers", name, n);
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
static void take_name(koksma__pbrt_source *s, koksma__pbrt_parameter *p)
{
    char both[64];
    koksma__pbrt_text(s, both, sizeof both);
    const char *type = both + strspn(both, " \t");
    const size_t length = strcspn(type, " \t");
    const char *name = type + length + strspn(type + length, " \t");
    koksma__import_fail_if(!*type || !type[length] || length >= sizeof p->type, s->place,
                           "'%s': a parameter has a type and a name", both);
    snprintf(p->type, sizeof p->type, "%.*s", (int)length, type);
    snprintf(p->name, sizeof p->name, "%.*s", (int)strcspn(name, " \t"), name);
}

static void take_text(koksma__pbrt_source *s, const koksma__pbrt_token *t, koksma__pbrt_parameter *p)
{
    koksma__import_fail_if(t->length >= sizeof p->text, s->place, "%s: the text is longer than %zu characters",
                           p->name, sizeof p->text - 1);
    if (!p->n_texts++) {
        memcpy(p->text, t->at, t->length);
        p->text[t->length] = 0;
    } else if (p->n_texts == 2) {
        snprintf(p->second, sizeof p->second, "%.*s", (int)t->length, t->at);
    }
}

static void take_value(koksma__pbrt_source *s, const koksma__pbrt_token *t, const parameter_type *type,
                       koksma__pbrt_parameter *p)
{
    const bool quoted = t->kind == KOKSMA__PBRT_TEXT;
    if (type->holds == FLAGS) {
        need(t->kind != KOKSMA__PBRT_BRACKET &&
                 (koksma__text_is(t->at, t->length, "true") || koksma__text_is(t->at, t->length, "false")),
             s, t, p->name, "true or false");
        take_text(s, t, p);
    } else if (type->holds == TEXTS || (type->holds == EITHER && (p->n_texts || (quoted && !p->n)))) {
        need(quoted, s, t, p->name, "a text in quotation marks");
        take_text(s, t, p);
    } else {
        double *to = koksma__import_add(s->place, &p->numbers, &p->n, sizeof *to);
        *to = number_of(s, t, p->name, type->holds == WHOLE);
    }
}

/* Reads the values of a parameter: one without brackets, or some within them. */
static void take_values(koksma__pbrt_source *s, koksma__pbrt_parameter *p)
{
    const parameter_type *type = NULL;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        type = !strcmp(types[i].name, p->type) ? &types[i] : type;
    }
    koksma__import_fail_if(!type, s->place, "%s: '%s' is not a type of pbrt-v4", p->name, p->type);
    koksma__pbrt_token t = koksma__pbrt_token_next(s);
    if (t.kind != KOKSMA__PBRT_BRACKET) {
        take_value(s, &t, type, p);
    } else {
        for (t = koksma__pbrt_token_next(s); !is_bracket(&t, ']'); t = koksma__pbrt_token_next(s)) {
            koksma__import_fail_if(t.kind == KOKSMA__PBRT_END, s->place, "%s: the list has no closing bracket",
                                   p->name);
            take_value(s, &t, type, p);
        }
    }
    koksma__import_fail_if(!p->n && !p->n_texts, s->place, "%s: a list without values", p->name);
    koksma__import_fail_if(p->n % type->each, s->place, "%s: %zu numbers, but each '%s' has %zu", p->name, p->n,
                           p->type, type->each);
}

/* Adds a parameter without name and values. */
static koksma__pbrt_parameter *add(const koksma__pbrt_source *s, koksma__pbrt_parameters *to)
{
    koksma__import_fail_if(to->n == KOKSMA__MAX_PBRT_PARAMETERS, s->place, "more than %d parameters",
                           KOKSMA__MAX_PBRT_PARAMETERS);
    koksma__pbrt_parameter *p = &to->items[to->n++];
    *p->type = *p->name = *p->text = *p->second = 0;
    p->numbers = NULL;
    p->n = p->n_texts = 0;
    return p;
}

void koksma__pbrt_parameter_copy(koksma__text_place place, const koksma__pbrt_parameter *from,
                                 koksma__pbrt_parameter *out)
{
    const size_t bytes = from->n * sizeof *out->numbers;
    *out = *from;
    out->numbers = NULL;
    if (bytes) {
        out->numbers = malloc(bytes);
        koksma__import_pass(place, out->numbers ? KOKSMA_OK : koksma__fail_memory(bytes));
        memcpy(out->numbers, from->numbers, bytes);
    }
}

void koksma__pbrt_parameters_read(koksma__pbrt_source *s, koksma__pbrt_parameters *out)
{
    out->n = 0;
    out->place = s->place;
    /* the attributes of the directive's target; a parameter of its own comes later, and so has priority */
    for (size_t i = 0; i < out->n_attributes; i++) {
        if (!strcmp(out->attributes[i].target, out->target)) {
            koksma__pbrt_parameter_copy(s->place, &out->attributes[i].parameter, add(s, out));
        }
    }
    out->n_inherited = out->n;
    while (koksma__pbrt_token_peek(s).kind == KOKSMA__PBRT_TEXT) {
        koksma__pbrt_parameter *p = add(s, out);
        take_name(s, p);
        p->line = s->place.line;
        take_values(s, p);
    }
}

void koksma__pbrt_parameters_fini(koksma__pbrt_parameters *parameters)
{
    for (size_t i = 0; i < parameters->n; i++) {
        free(parameters->items[i].numbers);
    }
    parameters->n = parameters->n_inherited = 0;
}
