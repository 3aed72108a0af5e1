/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads OBJ's material files. A line is a keyword and its values; "newmtl NAME" begins the material of that name, or
 * continues it if it exists. The reader uses Kd (colour), Ke (emission), d and Tr (opaque or not), Pm and Pr
 * (metallic, roughness), map_Kd and map_Ke or map_emissive (textures, whose options are skipped), and ignores all
 * other keywords of the format; what is not one of them is named. A colour is one to three numbers; missing numbers are
 * equal to the first. Format: Wavefront's
 * "Advanced Visualizer Manual", section 2.3 (Pm, Pr and map_Ke: the PBR extension of 2013).
 */
#include "meshes/readers.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <strings.h>

#include "core/hash.h"
#include "meshes/mesh_text.h"

enum { MAX_LINE = 1000 };

/* ---- Names -------------------------------------------------------------------------------------------------- */

static koksma__mtl_name *name_at(const koksma__mtl_names *names, size_t i)
{
    return (koksma__mtl_name *)names->names.items + i;
}

koksma__mtl_name *koksma__mtl_find(koksma__mtl_names *names, koksma__mesh_file *f, const char *name, size_t length)
{
    koksma__file_material *material;
    size_t known;
    if (koksma__names_find(&names->places, name, length, &known)) {
        return name_at(names, known);
    }
    koksma__mtl_name *new = koksma__list_add(&names->names, 1, sizeof *new);
    if (new) {
        *new = (koksma__mtl_name){.name = strndup(name, length), .material = f->materials.n};
    }
    if (!new || !new->name || koksma__names_put(&names->places, name, length, names->names.n - 1) ||
        koksma__file_add_material(f, 0.6f, &material)) {
        koksma__fail_memory(length);
        return NULL;
    }
    return new;
}

void koksma__mtl_names_fini(koksma__mtl_names *names)
{
    for (size_t i = 0; i < names->names.n; i++) {
        free(name_at(names, i)->name);
    }
    free(names->names.items);
    koksma__names_fini(&names->places);
}

/* ---- Lines -------------------------------------------------------------------------------------------------- */

/* Reads a word that is a number below 1e38; if the next word is not, returns false and consumes nothing. */
static bool take_number(koksma__text *t, float *out)
{
    koksma__text after = *t;
    const char *word;
    size_t length;
    float value = 0;
    if (!koksma__text_word(&after, &word, &length) || !koksma__text_float(&word, after.at, &value) ||
        word != after.at || !(fabsf(value) < 1e38f)) {
        return false;
    }
    *out = value;
    *t = after;
    return true;
}

static koksma_status take_colour(koksma__text *t, float out[3])
{
    int n = 0;
    const char *rest;
    while (n < 3 && take_number(t, &out[n])) {
        n++;
    }
    koksma__text span = *t;
    const size_t left = n < 3 ? koksma__text_rest(&span, &rest) : 0;
    if (!n || (left && *rest != '#')) {
        return koksma__text_wrong(t, "a colour is one to three numbers below 1e38");
    }
    for (; n < 3; n++) {
        out[n] = out[0];
    }
    return KOKSMA_OK;
}

/* The keywords of the format and of its extensions, without case: programs write map_Bump and map_bump. */
static const char *const keywords[] = {
    "newmtl", "Ka",       "Kd",       "Ks",        "Ke",       "Km",           "Ns",          "Ni",       "d",
    "Tr",     "Tf",       "illum",    "sharpness", "map_Ka",   "map_Kd",       "map_Ks",      "map_Ke",   "map_Ns",
    "map_Ni", "map_d",    "map_Tr",   "map_Tf",    "map_bump", "bump",         "disp",        "decal",    "refl",
    "norm",   "map_disp", "map_refl", "map_aat",   "map_ao",   "map_emissive", "map_opacity", "map_norm", "Pr",
    "Pm",     "Ps",       "Pc",       "Pcr",       "aniso",    "anisor",       "map_Pr",      "map_Pm",   "map_Ps",
    "map_Pc", "map_Pcr",  "map_RMA",  "map_ORM",   NULL};

static const char *keyword_at(const void *table, size_t i)
{
    return ((const char *const *)table)[i];
}

koksma_status koksma__name_word(const koksma__text *t, const char *word, size_t length, const char *what,
                                const char *const *all, koksma__mesh_file *f)
{
    char given[48], text[256], meant[KOKSMA__OR_MEANT];
    snprintf(given, sizeof given, "%.*s", length < 40 ? (int)length : 40, word);
    snprintf(text, sizeof text, "'%s' is not %s%s", given, what,
             koksma__or_meant(koksma_closest_name(given, keyword_at, all), meant));
    return koksma__unknown_put(&f->unknown, &f->n_unknown, t->path, (unsigned long)t->number, text);
}

static koksma_status name_keyword(const koksma__text *t, const char *word, koksma__mesh_file *f)
{
    for (size_t i = 0; keywords[i]; i++) {
        /* a colour's keyword in other case is another word to every reader */
        const bool map = strlen(keywords[i]) > 3;
        if (map ? !strcasecmp(keywords[i], word) : !strcmp(keywords[i], word)) {
            return KOKSMA_OK;
        }
    }
    return koksma__name_word(t, word, strlen(word), "a keyword of material files", keywords, f);
}

/* Reads the file's name, which follows the options, as in "-s 2 1 image.png". The options -o, -s and -t have one to
   three numbers. */
static koksma_status take_texture(koksma__text *t, koksma__mesh_file *f, koksma__file_texture *out)
{
    static const struct {
        const char *name;
        int least, most;
    } options[] = {{"-blendu", 1, 1}, {"-blendv", 1, 1}, {"-boost", 1, 1}, {"-texres", 1, 1}, {"-clamp", 1, 1},
                   {"-bm", 1, 1},     {"-cc", 1, 1},     {"-type", 1, 1},  {"-mm", 2, 2},     {"-imfchan", 1, 1},
                   {"-o", 1, 3},      {"-s", 1, 3},      {"-t", 1, 3}};
    const char *word, *rest;
    size_t length;
    float value;
    for (koksma__text after = *t; koksma__text_word(&after, &word, &length) && *word == '-'; after = *t) {
        bool known = false;
        for (size_t i = 0; i < sizeof options / sizeof *options; i++) {
            if (koksma__text_is(word, length, options[i].name)) {
                const char *ignored;
                size_t n;
                known = true;
                for (int k = 0; k < options[i].least; k++) {
                    koksma__text_word(&after, &ignored, &n);
                }
                for (int k = options[i].least; k < options[i].most && take_number(&after, &value); k++) {
                }
            }
        }
        if (!known) {
            KOKSMA__TRY(
                koksma__name_word(t, word, length, "an option of material files", (const char *const[]){NULL}, f));
        }
        *t = after;
    }
    length = koksma__text_rest(t, &rest);
    free(out->name);
    *out = (koksma__file_texture){0};
    if (!length) {
        return KOKSMA_OK;
    }
    out->name = strndup(rest, length);
    KOKSMA__REQUIRE_MEMORY(out->name, length);
    return KOKSMA_OK;
}

static koksma_status take_one(koksma__text *t, float *out)
{
    return take_number(t, out) ? KOKSMA_OK : koksma__text_wrong(t, "expected a number below 1e38");
}

/* Reads the property of material m that a line sets. */
static koksma_status take_property(koksma__text *t, const char *word, koksma__mesh_file *f, koksma__file_material *m)
{
    float value = 1, glow[3];
    if (!strcmp(word, "Kd")) {
        return take_colour(t, m->colour);
    }
    if (!strcmp(word, "Ke")) {
        KOKSMA__TRY(take_colour(t, glow));
        for (int k = 0; k < 3; k++) {
            m->glow[k] = (double)glow[k];
        }
    } else if (!strcmp(word, "d") || !strcmp(word, "Tr")) {
        koksma__text after = *t;
        const char *halo;
        size_t n;
        *t = koksma__text_word(&after, &halo, &n) && koksma__text_is(halo, n, "-halo") ? after : *t;
        KOKSMA__TRY(take_one(t, &value));
        m->see_through = *word == 'd' ? value < 1 : value > 0;
    } else if (!strcmp(word, "Pm") || !strcmp(word, "Pr")) {
        return take_one(t, word[1] == 'm' ? &m->metallic : &m->roughness);
    } else if (!strcasecmp(word, "map_Kd")) {
        return take_texture(t, f, &m->colour_map);
    } else if (!strcasecmp(word, "map_Ke") || !strcasecmp(word, "map_emissive")) {
        return take_texture(t, f, &m->glow_map);
    }
    return KOKSMA_OK;
}

static koksma_status take_line(koksma__text *t, koksma__mtl_names *names, koksma__mesh_file *f, size_t *current)
{
    koksma__file_material unnamed = {0};
    const char *first, *rest;
    char word[48]; /* keywords are shorter */
    size_t length;
    if (t->stop - t->at > MAX_LINE || memchr(t->at, '\0', (size_t)(t->stop - t->at))) {
        return koksma__text_wrong(t, t->stop - t->at > MAX_LINE ? "longer than 1000 characters"
                                                                : "the file is not text: it contains a zero byte");
    }
    if (!koksma__text_word(t, &first, &length)) {
        return KOKSMA_OK;
    }
    snprintf(word, sizeof word, "%.*s", length < 40 ? (int)length : 40, first);
    if (!strcmp(word, "newmtl")) {
        length = koksma__text_rest(t, &rest);
        koksma__mtl_name *name = koksma__mtl_find(names, f, rest, length);
        KOKSMA__TRY(name ? KOKSMA_OK : KOKSMA_MEMORY);
        name->made = true;
        *current = name->material;
        return KOKSMA_OK;
    }
    KOKSMA__TRY(*word == '#' ? KOKSMA_OK : name_keyword(t, word, f));
    const bool known = *current < f->materials.n;
    const koksma_status status = take_property(t, word, f, known ? koksma__file_material_at(f, *current) : &unnamed);
    free(unnamed.colour_map.name);
    free(unnamed.glow_map.name);
    return status;
}

koksma_status koksma__mtl_read(const char *path, koksma__mtl_names *names, koksma__mesh_file *f)
{
    unsigned char *bytes = NULL;
    size_t size = 0, current = SIZE_MAX;
    koksma_status status =
        koksma__read_file(path, KOKSMA__FILE_MATERIALS, KOKSMA__BY_FILE, koksma__check_text, &bytes, &size);
    if (status) {
        return status;
    }
    koksma__mesh_file_hash(f, bytes, size);
    koksma__text t = koksma__text_open(path, bytes, size);
    while (!status && koksma__text_line(&t)) {
        status = take_line(&t, names, f, &current);
    }
    free(bytes);
    return status;
}
