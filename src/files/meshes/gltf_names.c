/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Names the members of a glTF file's objects that the specification does not have: a misspelt one would otherwise be left
 * out without a word, with a light or a colour. The objects are walked by a table of their kinds. A member "KEY:KIND" is
 * an object of that kind or a list of such objects, "KEY=TEXT|TEXT" has a closed list of values, other members are values.
 * Every object may have `extensions` and `extras`; extras may hold anything, and extensions that are not read are named
 * as such. Names: Khronos, "glTF 2.0" (2021), section 5, and the specifications of the extensions that are read.
 */
#include "meshes/gltf_names.h"

#include <stdio.h>
#include <string.h>

#include "meshes/gltf_check.h"

typedef koksma__json_node field;

static const struct {
    const char *name, *members;
} kinds[] = {
    {"the file",
     "asset:asset scene scenes:scene nodes:node meshes:mesh accessors:accessor bufferViews:bufferView buffers:buffer "
     "materials:material textures:texture images:image samplers:sampler cameras:camera skins:skin "
     "animations:animation extensionsUsed extensionsRequired"},
    {"asset", "version minVersion generator copyright"},
    {"scene", "name nodes"},
    {"node", "name camera children skin matrix mesh rotation scale translation weights"},
    {"mesh", "name primitives:primitive weights"},
    {"primitive", "attributes:attributes indices material mode targets:attributes"},
    {"attributes", "POSITION NORMAL TANGENT TEXCOORD_# COLOR_# JOINTS_# WEIGHTS_# _*"},
    {"accessor", "name bufferView byteOffset componentType normalized count type max min sparse:sparse"},
    {"sparse", "count indices:sparse-indices values:sparse-values"},
    {"sparse-indices", "bufferView byteOffset componentType"},
    {"sparse-values", "bufferView byteOffset"},
    {"bufferView", "name buffer byteOffset byteLength byteStride target"},
    {"buffer", "name uri byteLength"},
    {"material",
     "name pbrMetallicRoughness:pbrMetallicRoughness normalTexture:normalTexture occlusionTexture:occlusionTexture "
     "emissiveTexture:textureInfo emissiveFactor alphaMode=OPAQUE|MASK|BLEND alphaCutoff doubleSided"},
    {"pbrMetallicRoughness", "baseColorFactor baseColorTexture:textureInfo metallicFactor roughnessFactor "
                             "metallicRoughnessTexture:textureInfo"},
    {"textureInfo", "index texCoord"},
    {"normalTexture", "index texCoord scale"},
    {"occlusionTexture", "index texCoord strength"},
    {"texture", "name sampler source"},
    {"image", "name uri mimeType bufferView"},
    {"sampler", "name magFilter minFilter wrapS wrapT"},
    {"camera", "name type=perspective|orthographic perspective:perspective orthographic:orthographic"},
    {"perspective", "aspectRatio yfov zfar znear"},
    {"orthographic", "xmag ymag zfar znear"},
    {"skin", "name inverseBindMatrices skeleton joints"},
    {"animation", "name channels:channel samplers:animation-sampler"},
    {"channel", "sampler target:target"},
    {"target", "node path=translation|rotation|scale|weights|pointer"},
    {"animation-sampler", "input output interpolation=LINEAR|STEP|CUBICSPLINE"},
    {"KHR_lights_punctual", "lights:light light"},
    {"light", "name color intensity type=directional|point|spot range spot:spot"},
    {"spot", "innerConeAngle outerConeAngle"},
    {"KHR_materials_emissive_strength", "emissiveStrength"},
    {"KHR_materials_ior", "ior"},
    {"KHR_texture_transform", "offset rotation scale texCoord"}};

enum { MOST_READ = 1 << 30 };
enum { N_KINDS = sizeof kinds / sizeof *kinds, MOST_NAMES = 32 };

static size_t kind_of(const char *name, size_t length)
{
    size_t i = 0;
    while (i < N_KINDS && (strlen(kinds[i].name) != length || memcmp(kinds[i].name, name, length) != 0)) {
        i++;
    }
    return i;
}

/* Whether a key is a member's name; "#" at its end stands for a number, "*" for anything. */
static bool is_named(const char *key, const char *name, size_t length)
{
    const bool number = name[length - 1] == '#', any = name[length - 1] == '*';
    if (!number && !any) {
        return strlen(key) == length && !memcmp(key, name, length);
    }
    if (strncmp(key, name, length - 1) != 0 || !key[length - 1]) {
        return false;
    }
    return any || strspn(key + length - 1, "0123456789") == strlen(key + length - 1);
}

/* The words between separators of a text, for a suggestion. */
typedef struct words {
    char items[MOST_NAMES][40];
    size_t n;
} words;

static const char *word_at(const void *from, size_t i)
{
    const words *w = from;
    return i < w->n ? w->items[i] : NULL;
}

/* Adds the names of a list: "A B:KIND C=TEXT", or "A|B". */
static void add_words(words *to, const char *list, const char *separators, const char *ends)
{
    while (*list && to->n < MOST_NAMES) {
        const size_t whole = strcspn(list, separators), length = strcspn(list, ends);
        snprintf(to->items[to->n++], sizeof *to->items, "%.*s", (int)(length < whole ? length : whole), list);
        list += whole + (list[whole] != 0);
    }
}

/* Names a member or value. To find its line takes time, so that in a huge file more of them only count. */
static koksma_status name_one(koksma__gltf *g, const field *at, const char *what, const char *key, const words *known,
                              size_t kind)
{
    koksma__mesh_file *out = g->out;
    char text[256];
    const char *closest = koksma_closest_name(key, word_at, known);
    snprintf(text, sizeof text, "%s'%.64s' of %s is unknown%s%s%s", what, key, kinds[kind].name,
             closest ? "; did you mean '" : "", closest ? closest : "", closest ? "'?" : "");
    if (out->n_unknown && out->n_unknown * g->text_size > MOST_READ) {
        out->unknown[out->n_unknown - 1].n++;
        return KOKSMA_OK;
    }
    return koksma__unknown_count(out->unknown, out->n_unknown, text)
               ? KOKSMA_OK
               : koksma__unknown_add(&out->unknown, &out->n_unknown, out->path,
                                     (unsigned long)koksma__json_line_of(at), text);
}

static koksma_status check_value(koksma__gltf *g, const field *at, const char *key, const char *values, size_t length,
                                 size_t kind)
{
    words known = {.n = 0};
    char list[96], what[80];
    const char *text = NULL;
    snprintf(list, sizeof list, "%.*s", (int)length, values);
    add_words(&known, list, "|", "|");
    if (!koksma__json_is_text(at) || koksma__json_text(at, &text)) {
        return KOKSMA_OK; /* its reader says what is wrong */
    }
    for (size_t i = 0; i < known.n; i++) {
        if (!strcmp(known.items[i], text)) {
            return KOKSMA_OK;
        }
    }
    snprintf(what, sizeof what, "%.60s ", key);
    return name_one(g, at, what, text, &known, kind);
}

static koksma_status walk(koksma__gltf *g, const field *object, size_t kind);

/* Walks an object or a list of objects. */
static koksma_status walk_all(koksma__gltf *g, const field *at, size_t kind)
{
    size_t n = 0;
    if (!koksma__json_is_array(at)) {
        return walk(g, at, kind);
    }
    KOKSMA__TRY(koksma__json_length(at, KOKSMA__GLTF_ITEMS, &n));
    for (size_t i = 0; i < n; i++) {
        const field item = koksma__json_item(at, i);
        KOKSMA__TRY(walk(g, &item, kind));
    }
    return KOKSMA_OK;
}

static koksma_status walk_extensions(koksma__gltf *g, const field *object, size_t kind)
{
    static const words known = {
        {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior", "KHR_texture_transform"}, 4};
    const char *key;
    size_t ignored;
    field member;
    for (void *at = NULL; koksma__json_is_object(object) && koksma__json_next(object, &at, &key, &member);) {
        const size_t found = kind_of(key, strlen(key));
        if (koksma__gltf_reads(key) && found < N_KINDS) {
            KOKSMA__TRY(walk_all(g, &member, found));
        } else if (!koksma__names_find(&g->listed, key, strlen(key), &ignored)) { /* otherwise named already */
            KOKSMA__TRY(name_one(g, &member, "extension ", key, &known, kind));
        }
    }
    return KOKSMA_OK;
}

/* Checks a member of an object by the list of the members that its kind has. */
static koksma_status check_member(koksma__gltf *g, const field *member, const char *key, size_t kind)
{
    words known = {.n = 0};
    for (const char *at = kinds[kind].members; *at; at += *at == ' ') {
        const size_t whole = strcspn(at, " "), length = strcspn(at, " :=");
        if (is_named(key, at, length)) {
            const char *more = at + length + 1;
            const size_t rest = whole - length - (whole > length);
            return at[length] == ':'   ? walk_all(g, member, kind_of(more, rest))
                   : at[length] == '=' ? check_value(g, member, key, more, rest, kind)
                                       : KOKSMA_OK;
        }
        at += whole;
    }
    add_words(&known, kinds[kind].members, " ", " :=");
    return name_one(g, member, "", key, &known, kind);
}

static koksma_status walk(koksma__gltf *g, const field *object, size_t kind)
{
    const char *key;
    field member;
    for (void *at = NULL; koksma__json_is_object(object) && koksma__json_next(object, &at, &key, &member);) {
        if (!strcmp(key, "extensions")) {
            KOKSMA__TRY(walk_extensions(g, &member, kind));
        } else if (strcmp(key, "extras") != 0) {
            KOKSMA__TRY(check_member(g, &member, key, kind));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__gltf_name_unknown(koksma__gltf *g)
{
    return walk(g, &g->root, 0);
}
