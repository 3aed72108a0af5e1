/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Splits pbrt-v4's scene files into tokens: words, texts in quotation marks, and brackets; '#' starts a comment.
 * A parameter is a text "type name" and a value, or values in brackets. Numbers are rounded to floats, as in pbrt
 * itself; integers are exact. Only parameters are copied, and their number and lengths are limited.
 */
#include "scene/pbrt_tokens.h"

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

static koksma_status number_of(const koksma__pbrt_source *s, const koksma__pbrt_token *t, bool whole, double *out)
{
    const char *at = t->at, *end = t->at + t->length;
    const bool negative = t->length && *at == '-';
    long long count;
    float value = 0;
    bool read = false;
    if (whole) {
        at += negative;
        read = koksma__text_whole(&at, end, &count) && at == end;
        *out = negative ? -(double)count : (double)count;
    }
    if (!read) { /* integers may be written with a decimal point */
        at = t->at;
        read = koksma__text_float(&at, end, &value) && at == end;
        *out = (double)value;
    }
    return t->kind == KOKSMA__PBRT_WORD && read ? KOKSMA_OK
                                                : koksma__import_fail(s->place, "'%.*s': expected a number",
                                                                      t->length < 40 ? (int)t->length : 40, t->at);
}

koksma_status koksma__pbrt_numbers(koksma__pbrt_source *s, size_t n, double *out)
{
    koksma__pbrt_token t;
    KOKSMA__TRY(koksma__pbrt_token_peek(s, &t));
    const bool bracket = t.kind == KOKSMA__PBRT_BRACKET && *t.at == '[';
    for (size_t i = 0; i < n + (bracket ? 2 : 0); i++) {
        KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
        if (!bracket || (i > 0 && i <= n)) {
            KOKSMA__TRY(number_of(s, &t, false, out + i - bracket));
        }
    }
    return bracket && (t.kind != KOKSMA__PBRT_BRACKET || *t.at != ']')
               ? koksma__import_fail(s->place, "expected %zu numbers", n)
               : KOKSMA_OK;
}

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

static koksma_status take_value(koksma__pbrt_source *s, const koksma__pbrt_token *t, koksma__pbrt_parameter *p)
{
    const bool flag = !strcmp(p->type, "bool");
    if (t->kind == KOKSMA__PBRT_TEXT || (flag && t->kind == KOKSMA__PBRT_WORD)) {
        if (t->length >= sizeof p->text) {
            return koksma__import_fail(s->place, "%s: the text is longer than %zu characters", p->name,
                                       sizeof p->text - 1);
        }
        if (!p->n_texts++) {
            memcpy(p->text, t->at, t->length);
            p->text[t->length] = 0;
        }
        return KOKSMA_OK;
    }
    double *to = koksma__add_one(&p->numbers, &p->n, sizeof *to);
    return to ? number_of(s, t, !strcmp(p->type, "integer"), to) : KOKSMA_MEMORY;
}

static koksma_status take_values(koksma__pbrt_source *s, koksma__pbrt_parameter *p)
{
    koksma__pbrt_token t;
    KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
    if (t.kind != KOKSMA__PBRT_BRACKET) {
        return take_value(s, &t, p);
    }
    for (;;) {
        KOKSMA__TRY(koksma__pbrt_token_next(s, &t));
        if (t.kind == KOKSMA__PBRT_BRACKET && *t.at == ']') {
            return KOKSMA_OK;
        }
        if (t.kind == KOKSMA__PBRT_END) {
            return koksma__import_fail(s->place, "%s: the list has no closing bracket", p->name);
        }
        KOKSMA__TRY(take_value(s, &t, p));
    }
}

koksma_status koksma__pbrt_parameters_read(koksma__pbrt_source *s, koksma__pbrt_parameters *out)
{
    koksma__pbrt_token t;
    out->n = 0;
    out->place = s->place;
    for (;;) {
        KOKSMA__TRY(koksma__pbrt_token_peek(s, &t));
        if (t.kind != KOKSMA__PBRT_TEXT) {
            return KOKSMA_OK;
        }
        if (out->n == KOKSMA__MAX_PBRT_PARAMETERS) {
            return koksma__import_fail(s->place, "more than %d parameters", KOKSMA__MAX_PBRT_PARAMETERS);
        }
        koksma__pbrt_parameter *p = &out->items[out->n++];
        *p->type = *p->name = *p->text = 0;
        p->numbers = NULL;
        p->n = p->n_texts = 0;
        KOKSMA__TRY(take_name(s, p));
        KOKSMA__TRY(take_values(s, p));
    }
}

void koksma__pbrt_parameters_fini(koksma__pbrt_parameters *parameters)
{
    for (size_t i = 0; i < parameters->n; i++) {
        free(parameters->items[i].numbers);
    }
    parameters->n = 0;
}

const koksma__pbrt_parameter *koksma__pbrt_find(const koksma__pbrt_parameters *p, const char *name)
{
    for (size_t i = 0; i < p->n; i++) {
        if (!strcmp(p->items[i].name, name)) {
            if (p->used) {
                p->used[i] = true;
            }
            return &p->items[i];
        }
    }
    return NULL;
}

double koksma__pbrt_number(const koksma__pbrt_parameters *p, const char *name, double otherwise)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find(p, name);
    return found && found->n ? found->numbers[0] : otherwise;
}

const char *koksma__pbrt_word(const koksma__pbrt_parameters *p, const char *name, const char *otherwise)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find(p, name);
    return found && found->n_texts ? found->text : otherwise;
}

bool koksma__pbrt_flag(const koksma__pbrt_parameters *p, const char *name, bool otherwise)
{
    const char *word = koksma__pbrt_word(p, name, "");
    return *word ? !strcmp(word, "true") : otherwise;
}
