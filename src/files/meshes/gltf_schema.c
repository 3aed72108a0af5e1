/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The shape of a glTF file, as a table of the kinds of its objects and their members, for two walks before anything is
 * built.
 *
 * One names the members that the specification does not have: a misspelt one would otherwise be left out without a word,
 * with a light or a colour. The other checks that the parts fit together: every index of another item is in range, every
 * buffer view and accessor lies within its buffer or view, and nodes form trees. So the other gltf_*.c files read items and
 * bytes without further checks; they check only the contents of the buffers. Time is linear in the size of the JSON.
 *
 * A member "KEY:KIND" is an object of that kind or a list of such objects, "KEY>LIST" the index of an item of a list of the
 * file, "KEY=TEXT|TEXT" has a closed list of values, other members are values. Every object may have `extensions` and
 * `extras`; extras may hold anything, and extensions that are not read are named as such. Names: Khronos, "glTF 2.0"
 * (2021), section 5, and the specifications of the extensions that are read.
 */
#include "meshes/gltf.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef koksma__json_node field;

/* The first kind is that of the root. */
static const struct {
    const char *name, *members;
} kinds[] = {
    {"the file", "asset:asset scene>scenes buffers:buffer bufferViews:bufferView accessors:accessor "
                 "materials:material images:image "
                 "textures:texture meshes:mesh nodes:node scenes:scene samplers:sampler cameras:camera skins:skin "
                 "animations:animation extensionsUsed extensionsRequired"},
    {"asset", "version minVersion generator copyright"},
    {"scene", "name nodes"},
    {"node", "name camera>cameras children skin>skins matrix mesh>meshes rotation scale translation weights"},
    {"mesh", "name primitives:primitive weights"},
    {"primitive", "attributes:attributes indices>accessors material>materials mode targets:attributes"},
    {"attributes", "POSITION>accessors NORMAL>accessors TANGENT>accessors TEXCOORD_0>accessors TEXCOORD_1>accessors "
                   "COLOR_0>accessors TEXCOORD_# COLOR_# JOINTS_# WEIGHTS_# _*"},
    {"accessor", "name bufferView>bufferViews byteOffset componentType normalized count type max min sparse:sparse"},
    {"sparse", "count indices:sparse-indices values:sparse-values"},
    {"sparse-indices", "bufferView byteOffset componentType"},
    {"sparse-values", "bufferView byteOffset"},
    {"bufferView", "name buffer>buffers byteOffset byteLength byteStride target"},
    {"buffer", "name uri byteLength"},
    {"material",
     "name pbrMetallicRoughness:pbrMetallicRoughness normalTexture:normalTexture occlusionTexture:occlusionTexture "
     "emissiveTexture:textureInfo emissiveFactor alphaMode=OPAQUE|MASK|BLEND alphaCutoff doubleSided"},
    {"pbrMetallicRoughness", "baseColorFactor baseColorTexture:textureInfo metallicFactor roughnessFactor "
                             "metallicRoughnessTexture:textureInfo"},
    {"textureInfo", "index>textures texCoord"},
    {"normalTexture", "index>textures texCoord scale"},
    {"occlusionTexture", "index>textures texCoord strength"},
    {"texture", "name sampler>samplers source>images"},
    {"image", "name uri mimeType bufferView>bufferViews"},
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

/* The lists of the root object, and how messages call their items. */
static const struct {
    const char *key, *item;
} lists[KOKSMA__GLTF_LISTS] = {[KOKSMA__GLTF_BUFFERS] = {"buffers", "buffer"},
                               [KOKSMA__GLTF_VIEWS] = {"bufferViews", "buffer view"},
                               [KOKSMA__GLTF_ACCESSORS] = {"accessors", "accessor"},
                               [KOKSMA__GLTF_MATERIALS] = {"materials", "material"},
                               [KOKSMA__GLTF_CAMERAS] = {"cameras", "camera"},
                               [KOKSMA__GLTF_SAMPLERS] = {"samplers", "sampler"},
                               [KOKSMA__GLTF_SKINS] = {"skins", "skin"},
                               [KOKSMA__GLTF_SCENES] = {"scenes", "scene"},
                               [KOKSMA__GLTF_IMAGES] = {"images", "image"},
                               [KOKSMA__GLTF_TEXTURES] = {"textures", "texture"},
                               [KOKSMA__GLTF_MESHES] = {"meshes", "mesh"},
                               [KOKSMA__GLTF_NODES] = {"nodes", "node"}};

static const char *const extensions[] = {"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                         "KHR_materials_ior", "KHR_texture_transform", NULL};

enum { N_KINDS = sizeof kinds / sizeof *kinds, MOST_NAMES = 32, MOST_READ = 1 << 30 };

#define MARKS " :=>" /* that end a name in the members of a kind */

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

/* Adds the names of a list: "A B:KIND C=TEXT D>LIST", or "A|B". */
static void add_words(words *to, const char *list, const char *separators, const char *ends)
{
    while (*list && to->n < MOST_NAMES) {
        const size_t whole = strcspn(list, separators), length = strcspn(list, ends);
        snprintf(to->items[to->n++], sizeof *to->items, "%.*s", (int)(length < whole ? length : whole), list);
        list += whole + (list[whole] != 0);
    }
}

static const char *extension_at(const void *unused, size_t i)
{
    (void)unused;
    return extensions[i];
}

bool koksma__gltf_reads(const char *extension)
{
    size_t i = 0;
    while (extensions[i] && strcmp(extension, extensions[i]) != 0) {
        i++;
    }
    return extensions[i] != NULL;
}

/* Names a member or value. To find its line takes time, so that in a huge file more of them only count. */
static koksma_status name_one(koksma__gltf *g, const field *at, const char *what, const char *key,
                              koksma_name_at *name, const void *known, size_t kind)
{
    koksma__mesh_file *out = g->out;
    char text[256];
    const char *closest = koksma_closest_name(key, name, known);
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
    return name_one(g, at, what, text, word_at, &known, kind);
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
    const char *key;
    size_t ignored;
    field member;
    for (void *at = NULL; koksma__json_is_object(object) && koksma__json_next(object, &at, &key, &member);) {
        const size_t found = kind_of(key, strlen(key));
        if (koksma__gltf_reads(key) && found < N_KINDS) {
            KOKSMA__TRY(walk_all(g, &member, found));
        } else if (!koksma__names_find(&g->listed, key, strlen(key), &ignored)) { /* otherwise named already */
            KOKSMA__TRY(name_one(g, &member, "extension ", key, extension_at, NULL, kind));
        }
    }
    return KOKSMA_OK;
}

/* Checks a member of an object by the list of the members that its kind has. */
static koksma_status check_member(koksma__gltf *g, const field *member, const char *key, size_t kind)
{
    words known = {.n = 0};
    for (const char *at = kinds[kind].members; *at; at += *at == ' ') {
        const size_t whole = strcspn(at, " "), length = strcspn(at, MARKS);
        if (is_named(key, at, length)) {
            const char *more = at + length + 1;
            const size_t rest = whole - length - (whole > length);
            return at[length] == ':'   ? walk_all(g, member, kind_of(more, rest))
                   : at[length] == '=' ? check_value(g, member, key, more, rest, kind)
                                       : KOKSMA_OK;
        }
        at += whole;
    }
    add_words(&known, kinds[kind].members, " ", MARKS);
    return name_one(g, member, "", key, word_at, &known, kind);
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

/* ---- Checks ------------------------------------------------------------------------------------------------- */

/* Calls f for every item of a list of the root. */
static koksma_status each(const koksma__gltf *g, int list,
                          koksma_status (*f)(const koksma__gltf *g, const field *item))
{
    for (size_t i = 0; i < g->n[list]; i++) {
        const field item = koksma__gltf_item(g, list, i);
        KOKSMA__TRY(f(g, &item));
    }
    return KOKSMA_OK;
}

/* Checks that the member `key`, if the object has it, is the index of an item of the list that is named by `length`
   characters. */
static koksma_status check_index(const koksma__gltf *g, const field *object, const char *key, const char *list,
                                 size_t length)
{
    long long number = 0;
    int i = 0;
    while (strlen(lists[i].key) != length || memcmp(lists[i].key, list, length) != 0) {
        i++;
    }
    KOKSMA__TRY(koksma__json_get_whole(object, key, false, 0, KOKSMA__GLTF_ITEMS, &number));
    KOKSMA__JSON_FAIL_IF(koksma__json_has(object, key) && (size_t)number >= g->n[i], object,
                         "%s: there is no %s %lld; the file has %zu, numbered from 0", key, lists[i].item, number,
                         g->n[i]);
    return KOKSMA_OK;
}

/* Checks the indices within an object of this kind. */
static koksma_status check_indices(const koksma__gltf *g, const field *object, size_t kind)
{
    for (const char *at = kinds[kind].members; *at; at += *at == ' ') {
        const size_t whole = strcspn(at, " "), length = strcspn(at, MARKS), rest = whole - length - (whole > length);
        char key[40];
        field member;
        size_t n = 0;
        snprintf(key, sizeof key, "%.*s", (int)length, at);
        if (at[length] == '>') {
            KOKSMA__TRY(check_index(g, object, key, at + length + 1, rest));
        } else if (at[length] == ':' && koksma__json_has(object, key)) {
            const size_t of = kind_of(at + length + 1, rest);
            KOKSMA__TRY(koksma__json_member(object, key, &member));
            if (koksma__json_is_object(&member)) {
                KOKSMA__TRY(check_indices(g, &member, of));
            } else if (koksma__json_is_array(&member)) {
                KOKSMA__TRY(koksma__json_length(&member, KOKSMA__GLTF_ITEMS, &n));
            }
            for (size_t i = 0; i < n; i++) {
                const field item = koksma__json_item(&member, i);
                KOKSMA__TRY(check_indices(g, &item, of));
            }
        }
        at += whole;
    }
    return KOKSMA_OK;
}

static koksma_status bytes(const field *object, const char *key, bool needed, long long *out)
{
    *out = 0;
    return koksma__json_get_whole(object, key, needed, 0, 1 << 30, out);
}

static koksma_status check_buffer(const koksma__gltf *g, const field *f)
{
    long long length;
    (void)g;
    return bytes(f, "byteLength", true, &length);
}

static koksma_status check_view(const koksma__gltf *g, const field *f)
{
    long long number = 0, offset = 0, length = 0, room = 0, stride = 0;
    KOKSMA__TRY(koksma__json_get_whole(f, "buffer", true, 0, KOKSMA__GLTF_ITEMS, &number));
    KOKSMA__TRY(bytes(f, "byteOffset", false, &offset));
    KOKSMA__TRY(bytes(f, "byteLength", true, &length));
    KOKSMA__TRY(bytes(f, "byteStride", false, &stride));
    const field buffer = koksma__gltf_item(g, KOKSMA__GLTF_BUFFERS, (size_t)number);
    KOKSMA__TRY(bytes(&buffer, "byteLength", true, &room));
    KOKSMA__JSON_FAIL_IF(offset + length > room, f,
                         "its %lld bytes, from byte %lld on, go beyond the end of a buffer of %lld bytes", length,
                         offset, room);
    KOKSMA__JSON_FAIL_IF(stride > 252, f, "byteStride is %lld; it must be at most 252", stride);
    return KOKSMA_OK;
}

/* Number of components of an element; 0: unknown type. */
static long long components_of(const char *type)
{
    static const struct {
        const char *type;
        int n;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    size_t i = 0;
    while (i < sizeof types / sizeof *types && strcmp(types[i].type, type) != 0) {
        i++;
    }
    return i < sizeof types / sizeof *types ? types[i].n : 0;
}

static koksma_status check_accessor(const koksma__gltf *g, const field *f)
{
    long long number = 0, offset = 0, count = 0, component = 0, room = 0, stride = 0;
    const char *type = "";
    KOKSMA__TRY(bytes(f, "byteOffset", false, &offset));
    KOKSMA__TRY(koksma__json_get_whole(f, "count", true, 1, (long long)KOKSMA__MAX_VERTICES, &count));
    KOKSMA__TRY(koksma__json_get_whole(f, "componentType", true, 5120, 5126, &component));
    KOKSMA__TRY(koksma__json_get_text(f, "type", true, &type));
    const long long size = components_of(type) * (long long)koksma__gltf_component_size((int)component);
    KOKSMA__JSON_FAIL_IF(!size, f, "elements of type '%.32s' and component type %lld do not exist", type, component);
    KOKSMA__JSON_FAIL_IF(koksma__json_has(f, "sparse"), f, "sparse accessors are not read");
    if (!koksma__json_has(f, "bufferView")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_whole(f, "bufferView", true, 0, KOKSMA__GLTF_ITEMS, &number));
    const field view = koksma__gltf_item(g, KOKSMA__GLTF_VIEWS, (size_t)number);
    KOKSMA__TRY(bytes(&view, "byteLength", true, &room));
    KOKSMA__TRY(bytes(&view, "byteStride", false, &stride));
    stride = stride > size ? stride : size;
    KOKSMA__JSON_FAIL_IF(offset + (count - 1) * stride + size > room, f,
                         "%lld elements of %lld bytes lie beyond a view of %lld bytes", count, size, room);
    return KOKSMA_OK;
}

/* Checks that no node has two parents and that the roots of scenes have no parent, so that there are no cycles. */
static koksma_status check_tree(const koksma__gltf *g, unsigned char *has_parent)
{
    field nodes, scenes, list;
    size_t n, n_scenes = 0;
    koksma_status status = koksma__gltf_list(&g->root, "nodes", &nodes, &n);
    for (int pass = 0; !status && pass < 2; pass++) {
        status = pass ? koksma__gltf_list(&g->root, "scenes", &scenes, &n_scenes) : KOKSMA_OK;
        for (size_t i = 0; !status && i < (pass ? n_scenes : g->n[KOKSMA__GLTF_NODES]); i++) {
            const field item = koksma__json_item(pass ? &scenes : &nodes, i);
            status = koksma__gltf_list(&item, pass ? "nodes" : "children", &list, &n);
            for (size_t c = 0; !status && c < n; c++) {
                const field child = koksma__json_item(&list, c);
                long long number = 0;
                status = koksma__json_whole(&child, 0, (long long)g->n[KOKSMA__GLTF_NODES] - 1, &number);
                KOKSMA__JSON_FAIL_IF(!status && has_parent[number], &child,
                                     pass ? "node %lld has a parent" : "node %lld has two parents", number);
                has_parent[status ? 0 : number] |= !pass;
            }
        }
    }
    return status;
}

/* A reader that does not support an extension that the file requires must not show the file (glTF 2.0, section 3.12). */
static koksma_status check_required(const koksma__gltf *g)
{
    field list;
    size_t n = 0;
    KOKSMA__TRY(koksma__gltf_list(&g->root, "extensionsRequired", &list, &n));
    for (size_t i = 0; i < n; i++) {
        const field item = koksma__json_item(&list, i);
        const char *name;
        KOKSMA__TRY(koksma__json_text(&item, &name));
        KOKSMA__JSON_FAIL_IF(!koksma__gltf_reads(name), &item, "the file requires extension '%s', which is not read",
                             name);
    }
    return KOKSMA_OK;
}

koksma_status koksma__gltf_check(koksma__gltf *g)
{
    const field *root = &g->root;
    field asset;
    const char *version = "";
    KOKSMA__TRY(koksma__json_member(root, "asset", &asset));
    KOKSMA__TRY(koksma__json_get_text(&asset, "version", true, &version));
    KOKSMA__JSON_FAIL_IF(version[0] != '2', &asset, "glTF %.16s: only glTF 2 is read", version);
    for (int i = 0; i < KOKSMA__GLTF_LISTS; i++) {
        KOKSMA__TRY(koksma__gltf_list(root, lists[i].key, &g->lists[i], &g->n[i]));
    }
    KOKSMA__TRY(check_required(g));
    KOKSMA__TRY(check_indices(g, root, 0));
    KOKSMA__TRY(each(g, KOKSMA__GLTF_BUFFERS, check_buffer));
    KOKSMA__TRY(each(g, KOKSMA__GLTF_VIEWS, check_view));
    KOKSMA__TRY(each(g, KOKSMA__GLTF_ACCESSORS, check_accessor));
    unsigned char *has_parent = calloc(g->n[KOKSMA__GLTF_NODES] + 1, 1);
    KOKSMA__REQUIRE_MEMORY(has_parent, g->n[KOKSMA__GLTF_NODES]);
    const koksma_status status = check_tree(g, has_parent);
    free(has_parent);
    return status;
}
