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

enum { N_KINDS = sizeof kinds / sizeof *kinds, MOST_READ = 1 << 30 };

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

/* To find a line takes time, so that in a huge file what comes later only counts. */
koksma_status koksma__gltf_name(koksma__gltf *g, const field *at, const char *text)
{
    koksma__mesh_file *out = g->out;
    if (out->n_unknown && out->n_unknown * g->text_size > MOST_READ) {
        out->unknown[out->n_unknown - 1].n++;
        return KOKSMA_OK;
    }
    return koksma__unknown_count(out->unknown, out->n_unknown, text)
               ? KOKSMA_OK
               : koksma__unknown_add(&out->unknown, &out->n_unknown, out->path,
                                     (unsigned long)koksma__json_line_of(at), text);
}

/* Names a member or value that is unknown. */
static koksma_status name_one(koksma__gltf *g, const field *at, const char *what, const char *key,
                              const char *closest, size_t kind)
{
    char text[256], meant[KOKSMA__OR_MEANT];
    snprintf(text, sizeof text, "%s'%.64s' of %s is unknown%s", what, key, kinds[kind].name,
             koksma__or_meant(closest, meant));
    return koksma__gltf_name(g, at, text);
}

static koksma_status check_value(koksma__gltf *g, const field *at, const char *key, const char *values, size_t length,
                                 size_t kind)
{
    koksma__word_list known = {.n = 0};
    char what[80];
    const char *text = NULL;
    if (!koksma__json_is_text(at) || koksma__json_text(at, &text)) {
        return KOKSMA_OK; /* its reader says what is wrong */
    }
    koksma__word_list_add(&known, values, length, "|", "|");
    for (size_t i = 0; i < known.n; i++) {
        if (!strcmp(known.items[i], text)) {
            return KOKSMA_OK;
        }
    }
    snprintf(what, sizeof what, "%.60s ", key);
    return name_one(g, at, what, text, koksma__word_list_closest(&known, text), kind);
}

static koksma_status walk(koksma__gltf *g, const field *object, size_t kind, bool names);

/* Walks an object or a list of objects. */
static koksma_status walk_all(koksma__gltf *g, const field *at, size_t kind, bool names)
{
    size_t n = 0;
    if (!koksma__json_is_array(at)) {
        return walk(g, at, kind, names);
    }
    KOKSMA__TRY(koksma__json_length(at, KOKSMA__GLTF_ITEMS, &n));
    for (size_t i = 0; i < n; i++) {
        const field item = koksma__json_item(at, i);
        KOKSMA__TRY(walk(g, &item, kind, names));
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
            KOKSMA__TRY(walk_all(g, &member, found, true));
        } else if (!koksma__names_find(&g->listed, key, strlen(key), &ignored)) { /* otherwise named already */
            KOKSMA__TRY(name_one(g, &member, "extension ", key, koksma_closest_name(key, extension_at, NULL), kind));
        }
    }
    return KOKSMA_OK;
}

/* Checks that the member `key` of an object is the index of an item of the list that is named by `length` characters. */
static koksma_status check_index(const koksma__gltf *g, const field *object, const char *key, const char *list,
                                 size_t length)
{
    long long number = 0;
    int i = 0;
    while (strlen(lists[i].key) != length || memcmp(lists[i].key, list, length) != 0) {
        i++;
    }
    KOKSMA__TRY(koksma__json_get_whole(object, key, true, 0, KOKSMA__GLTF_ITEMS, &number));
    KOKSMA__JSON_FAIL_IF((size_t)number >= g->n[i], object,
                         "%s: there is no %s %lld; the file has %zu, numbered from 0", key, lists[i].item, number,
                         g->n[i]);
    return KOKSMA_OK;
}

/* Checks a member of an object by the list of the members that its kind has. */
static koksma_status check_member(koksma__gltf *g, const field *object, field *member, const char *key, size_t kind,
                                  bool names)
{
    koksma__word_list known = {.n = 0};
    for (const char *at = kinds[kind].members; *at; at += *at == ' ') {
        const size_t whole = strcspn(at, " "), length = strcspn(at, MARKS);
        if (is_named(key, at, length)) {
            const char *more = at + length + 1;
            const size_t rest = whole - length - (whole > length);
            if (at[length] == ':') {
                KOKSMA__TRY(names ? KOKSMA_OK : koksma__json_member(object, key, member)); /* with its path */
                return walk_all(g, member, kind_of(more, rest), names);
            }
            return at[length] == '=' && names    ? check_value(g, member, key, more, rest, kind)
                   : at[length] == '>' && !names ? check_index(g, object, key, more, rest)
                                                 : KOKSMA_OK;
        }
        at += whole;
    }
    koksma__word_list_add(&known, kinds[kind].members, strlen(kinds[kind].members), " ", MARKS);
    return names ? name_one(g, member, "", key, koksma__word_list_closest(&known, key), kind) : KOKSMA_OK;
}

/* Walks the members of an object; names: names those that are unknown, or otherwise checks the indices of others. */
static koksma_status walk(koksma__gltf *g, const field *object, size_t kind, bool names)
{
    const char *key;
    field member;
    for (void *at = NULL; koksma__json_is_object(object) && koksma__json_next(object, &at, &key, &member);) {
        const bool extends = !strcmp(key, "extensions");
        if (extends && names) {
            KOKSMA__TRY(walk_extensions(g, &member, kind));
        } else if (!extends && strcmp(key, "extras") != 0) {
            KOKSMA__TRY(check_member(g, object, &member, key, kind, names));
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__gltf_name_unknown(koksma__gltf *g)
{
    return walk(g, &g->root, 0, true);
}

/* ---- Checks ------------------------------------------------------------------------------------------------- */

static koksma_status bytes(const field *object, const char *key, bool needed, long long *out)
{
    *out = 0;
    return koksma__json_get_whole(object, key, needed, 0, 1 << 30, out);
}

static koksma_status check_view(const koksma__gltf *g, const field *f, koksma__gltf_view *out)
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
    *out = (koksma__gltf_view){(size_t)number, (size_t)offset, (size_t)length, (size_t)stride};
    return KOKSMA_OK;
}

static koksma_status check_accessor(const koksma__gltf *g, const field *f, koksma__gltf_elements *out)
{
    static const struct {
        const char *type;
        int n;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    enum { TYPES = sizeof types / sizeof *types };
    long long offset = 0, count = 0, component = 0;
    const char *type = "";
    size_t t = 0;
    KOKSMA__TRY(bytes(f, "byteOffset", false, &offset));
    KOKSMA__TRY(koksma__json_get_whole(f, "count", true, 1, (long long)KOKSMA__MAX_VERTICES, &count));
    KOKSMA__TRY(koksma__json_get_whole(f, "componentType", true, 5120, 5126, &component));
    KOKSMA__TRY(koksma__json_get_text(f, "type", true, &type));
    KOKSMA__TRY(koksma__json_get_flag(f, "normalized", false, &out->normalised));
    while (t < TYPES && strcmp(types[t].type, type) != 0) {
        t++;
    }
    const size_t size = t < TYPES ? (size_t)types[t].n * koksma__gltf_component_size((int)component) : 0;
    KOKSMA__JSON_FAIL_IF(!size, f, "elements of type '%.32s' and component type %lld do not exist", type, component);
    KOKSMA__JSON_FAIL_IF(koksma__json_has(f, "sparse"), f, "sparse accessors are not read");
    out->n = (size_t)count;
    out->component = (int)component;
    out->width = t < 4 ? types[t].n : 0;
    out->offset = (size_t)offset;
    if (!koksma__json_has(f, "bufferView")) {
        return KOKSMA_OK;
    }
    out->view = koksma__gltf_index(f, "bufferView", 0) + 1;
    const koksma__gltf_view *view = &g->views[out->view - 1];
    out->stride = view->stride > size ? view->stride : size;
    KOKSMA__JSON_FAIL_IF(out->offset + (out->n - 1) * out->stride + size > view->size, f,
                         "%lld elements of %zu bytes lie beyond a view of %zu bytes", count, size, view->size);
    return KOKSMA_OK;
}

/* Checks that no node has two parents and that the roots of scenes have no parent, so that there are no cycles. */
static koksma_status check_tree(const koksma__gltf *g)
{
    field list;
    size_t n;
    for (int pass = 0; pass < 2; pass++) {
        const int which = pass ? KOKSMA__GLTF_SCENES : KOKSMA__GLTF_NODES;
        for (size_t i = 0; i < g->n[which]; i++) {
            const field item = koksma__gltf_item(g, which, i);
            KOKSMA__TRY(koksma__gltf_list(&item, pass ? "nodes" : "children", &list, &n));
            for (size_t c = 0; c < n; c++) {
                const field child = koksma__json_item(&list, c);
                long long number = 0;
                KOKSMA__TRY(koksma__json_whole(&child, 0, (long long)g->n[KOKSMA__GLTF_NODES] - 1, &number));
                KOKSMA__JSON_FAIL_IF(g->has_parent[number], &child,
                                     pass ? "node %lld has a parent" : "node %lld has two parents", number);
                g->has_parent[number] = !pass;
            }
        }
    }
    return KOKSMA_OK;
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

/* Allocates zeroed arrays that are as long as the file's lists. */
static koksma_status make_arrays(koksma__gltf *g)
{
    const size_t *n = g->n;
    g->buffers = calloc(n[KOKSMA__GLTF_BUFFERS] + 1, sizeof *g->buffers);
    g->images = calloc(n[KOKSMA__GLTF_IMAGES] + 1, sizeof *g->images);
    g->views = calloc(n[KOKSMA__GLTF_VIEWS] + 1, sizeof *g->views);
    g->accessors = calloc(n[KOKSMA__GLTF_ACCESSORS] + 1, sizeof *g->accessors);
    g->has_parent = calloc(n[KOKSMA__GLTF_NODES] + 1, sizeof *g->has_parent);
    g->mesh_shown = calloc(n[KOKSMA__GLTF_MESHES] + 1, sizeof *g->mesh_shown);
    g->material_used = calloc(n[KOKSMA__GLTF_MATERIALS] + 1, sizeof *g->material_used);
    g->material_tinted = calloc(n[KOKSMA__GLTF_MATERIALS] + 1, sizeof *g->material_tinted);
    return g->buffers && g->images && g->views && g->accessors && g->has_parent && g->mesh_shown &&
                   g->material_used && g->material_tinted
               ? KOKSMA_OK
               : koksma__fail_memory(n[KOKSMA__GLTF_ACCESSORS] * sizeof *g->accessors);
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
    KOKSMA__TRY(walk(g, root, 0, false));
    KOKSMA__TRY(make_arrays(g));
    for (size_t i = 0; i < g->n[KOKSMA__GLTF_BUFFERS]; i++) {
        const field f = koksma__gltf_item(g, KOKSMA__GLTF_BUFFERS, i);
        long long length;
        KOKSMA__TRY(bytes(&f, "byteLength", true, &length));
    }
    for (size_t i = 0; i < g->n[KOKSMA__GLTF_VIEWS]; i++) {
        const field f = koksma__gltf_item(g, KOKSMA__GLTF_VIEWS, i);
        KOKSMA__TRY(check_view(g, &f, &g->views[i]));
    }
    for (size_t i = 0; i < g->n[KOKSMA__GLTF_ACCESSORS]; i++) {
        const field f = koksma__gltf_item(g, KOKSMA__GLTF_ACCESSORS, i);
        KOKSMA__TRY(check_accessor(g, &f, &g->accessors[i]));
    }
    return check_tree(g);
}
