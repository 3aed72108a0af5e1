/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The tables of plug-ins and parameters from which other renderers' scenes are read (pbrt_names.c, mitsuba_names.c). A
 * row is for the plug-ins of one class that have the same parameters. These are a text, as short as the documentation of
 * the other renderer: "TYPE NAME NAME:DEFAULT; TYPE NAME=VALUE|VALUE". A name after "~" has no effect on the pictures
 * that Koksma makes (where it has a default or a closed list: if its value is that or in the list); one before "!" must
 * be given, and NAME|OLDER is a name and that of earlier versions. Where a list of values is closed, the first is the
 * default. The kind "*" has parameters that all kinds have, "?" is what an unknown kind is read as.
 */
#include "scene/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/c_locale.h"
#include "meshes/mesh_text.h"

bool koksma__lists(const char *list, size_t size, char separator, const char *word)
{
    const size_t length = strlen(word);
    for (size_t from = 0, to; from < size; from = to + 1) {
        const char *end = memchr(list + from, separator, size - from);
        to = end ? (size_t)(end - list) : size;
        if (to - from == length && !memcmp(list + from, word, length)) {
            return true;
        }
    }
    return false;
}

/* Whether a row is for this kind of a class. */
static bool is_for(const koksma__plugin *row, const char *of, const char *kind)
{
    return !strcmp(row->of, of) && koksma__lists(row->kinds, strlen(row->kinds), ' ', kind);
}

bool koksma__entry_next(koksma__entry *e)
{
    const char *word = e->rest + strspn(e->rest, " ");
    bool is_type = !e->type;
    if (*word == ';') {
        word += 1 + strspn(word + 1, " ");
        is_type = true;
    }
    if (!*word) {
        return false;
    }
    if (is_type) {
        e->type = word;
        e->type_length = strcspn(word, " ");
        word += e->type_length;
        word += strspn(word, " ");
    }
    e->without_effect = *word == '~';
    word += e->without_effect;
    e->name = word;
    e->length = strcspn(word, " ;=:!|");
    word += e->length;
    e->older = *word == '|' ? word + 1 : NULL;
    e->older_length = e->older ? strcspn(e->older, " ;=:!") : 0;
    word += e->older ? e->older_length + 1 : 0;
    e->is_needed = *word == '!';
    word += e->is_needed;
    const size_t rest = strcspn(word, " ;");
    e->otherwise = *word == ':' ? word + 1 : NULL;
    e->values = *word == '=' ? word + 1 : NULL;
    e->values_length = e->values ? rest - 1 : 0;
    e->rest = word + rest;
    return true;
}

const koksma__plugin *koksma__plugin_find(const koksma__plugins *all, const char *of, const char *kind)
{
    const koksma__plugin *other = NULL;
    for (size_t i = 0; i < all->n; i++) {
        if (is_for(&all->rows[i], of, kind)) {
            return &all->rows[i];
        }
        other = is_for(&all->rows[i], of, "?") ? &all->rows[i] : other;
    }
    return other;
}

const char *koksma__kind_meant(const koksma__plugins *all, const char *of, const char *kind, char *text)
{
    koksma__word_list kinds = {.n = 0};
    for (size_t i = 0; i < all->n; i++) {
        if (!strcmp(all->rows[i].of, of)) {
            koksma__word_list_add(&kinds, all->rows[i].kinds, strlen(all->rows[i].kinds), " ", "");
        }
    }
    return koksma__or_meant(koksma__word_list_closest(&kinds, kind), text);
}

const char *koksma__parameter_meant(const koksma__plugin *row, const char *name, char *text)
{
    koksma__word_list names = {.n = 0};
    for (koksma__entry e = koksma__entries_of(row); koksma__entry_next(&e);) {
        koksma__word_list_add(&names, e.name, e.length, "", "");
    }
    return koksma__or_meant(koksma__word_list_closest(&names, name), text);
}

bool koksma__row_entry(const koksma__plugin *row, const char *name, koksma__entry *out)
{
    *out = koksma__entries_of(row);
    while (koksma__entry_next(out)) {
        if (koksma__text_is(out->name, out->length, name)) {
            return true;
        }
    }
    return false;
}

bool koksma__plugin_entry(const koksma__plugins *all, const char *of, const char *kind, const char *name,
                          koksma__entry *out)
{
    const koksma__plugin *own = koksma__plugin_find(all, of, kind);
    for (size_t i = 0; i < all->n; i++) {
        const koksma__plugin *row = &all->rows[i];
        if ((row == own || is_for(row, of, own ? "*" : row->kinds)) && koksma__row_entry(row, name, out)) {
            return true;
        }
    }
    return false;
}

double koksma__entry_number(const koksma__entry *e)
{
    return e->otherwise ? koksma__strtod(e->otherwise, NULL) : 0;
}

int koksma__entry_choice(const koksma__entry *e, const char *value)
{
    const char *at = e->values;
    for (int i = 0; at && at < e->values + e->values_length; i++) {
        const size_t length = strcspn(at, "| ;");
        if (strlen(value) == length && !strncasecmp(at, value, length)) {
            return i;
        }
        at += length + 1;
    }
    return -1;
}
