/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The tables of plug-ins and parameters from which other renderers' scenes are read (pbrt_names.c, mitsuba_names.c). A row
 * is for the plug-ins of one class that have the same parameters. These are a text, as short as the documentation of the
 * other renderer: "TYPE NAME NAME:DEFAULT; TYPE NAME=VALUE|VALUE". A name after "~" has no effect on the pictures that Koksma
 * makes; one before "!" must be given; where a list of values is closed, the first is the default. The kind "*" has
 * parameters that all kinds have, "?" is what an unknown kind is read as.
 */
#include "scene/import.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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

bool koksma__plugin_is(const koksma__plugin *row, const char *of, const char *kind)
{
    return !strcmp(row->of, of) && koksma__lists(row->kinds, strlen(row->kinds), ' ', kind);
}

bool koksma__entry_next(const char **text, koksma__entry *e)
{
    const char *word = *text + strspn(*text, " ");
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
    e->length = strcspn(word, " ;=:!");
    word += e->length;
    e->is_needed = *word == '!';
    word += e->is_needed;
    const size_t rest = strcspn(word, " ;");
    e->otherwise = *word == ':' ? word + 1 : NULL;
    e->values = *word == '=' ? word + 1 : NULL;
    e->values_length = e->values ? rest - 1 : 0;
    *text = word + rest;
    return true;
}

const koksma__plugin *koksma__plugin_find(const koksma__plugins *all, const char *of, const char *kind)
{
    const koksma__plugin *other = NULL;
    for (size_t i = 0; i < all->n; i++) {
        if (koksma__plugin_is(&all->rows[i], of, kind)) {
            return &all->rows[i];
        }
        other = koksma__plugin_is(&all->rows[i], of, "?") ? &all->rows[i] : other;
    }
    return other;
}

bool koksma__plugin_entry(const koksma__plugins *all, const char *of, const char *kind, const char *name,
                          koksma__entry *out)
{
    const koksma__plugin *own = koksma__plugin_find(all, of, kind);
    for (size_t i = 0; i < all->n; i++) {
        const char *text = all->rows[i].parameters;
        if (&all->rows[i] != own && !koksma__plugin_is(&all->rows[i], of, own ? "*" : all->rows[i].kinds)) {
            continue;
        }
        *out = (koksma__entry){.type = NULL};
        while (koksma__entry_next(&text, out)) {
            if (koksma__text_is(out->name, out->length, name)) {
                return true;
            }
        }
    }
    *out = (koksma__entry){.type = NULL};
    return false;
}

double koksma__entry_number(const koksma__entry *e)
{
    return e->otherwise ? koksma__strtod(e->otherwise, NULL) : 0;
}
