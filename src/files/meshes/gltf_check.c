/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Checks that the parts of a glTF file fit together, before anything is built from them: every index of another item
 * is in range, every buffer view and accessor lies within its buffer or view, and nodes form trees. So the other
 * gltf_*.c files read items and bytes without further checks; they check only the contents of the buffers. Time is
 * linear in the size of the JSON. Specification: Khronos, "glTF 2.0" (2021).
 */
#include "meshes/gltf_check.h"

#include <stdlib.h>
#include <string.h>

#include "core/status.h"

typedef koksma__json_node field;

#define MAX_BYTES ((long long)1 << 30)

/* Calls f for every item of the list, until one fails. */
static koksma_status each(const koksma__gltf *g, const field *object, const char *key,
                          koksma_status (*f)(const koksma__gltf *g, const field *item))
{
    field list;
    size_t n;
    koksma_status status = koksma__gltf_list(object, key, &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const field item = koksma__json_item(&list, i);
        status = f(g, &item);
    }
    return status;
}

/* Checks that the member `key`, if the object has it, is an index below n; `thing` names the indexed items in the
   error message. */
static koksma_status names(const field *object, const char *key, const char *thing, size_t n)
{
    long long number = 0;
    KOKSMA__TRY(koksma__json_get_whole(object, key, false, 0, KOKSMA__GLTF_ITEMS, &number));
    KOKSMA__JSON_FAIL_IF(koksma__json_has(object, key) && (size_t)number >= n, object,
                         "%s: there is no %s %lld; the file has %zu, numbered from 0", key, thing, number, n);
    return KOKSMA_OK;
}

static koksma_status bytes(const field *object, const char *key, bool needed, long long *out)
{
    *out = 0;
    return koksma__json_get_whole(object, key, needed, 0, MAX_BYTES, out);
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
    field buffer;
    koksma_status status = names(f, "buffer", "buffer", g->n[KOKSMA__GLTF_BUFFERS]);
    status = status ? status : koksma__json_get_whole(f, "buffer", true, 0, KOKSMA__GLTF_ITEMS, &number);
    status = status ? status : bytes(f, "byteOffset", false, &offset);
    status = status ? status : bytes(f, "byteLength", true, &length);
    status = status ? status : bytes(f, "byteStride", false, &stride);
    if (!status) {
        buffer = koksma__gltf_item(g, KOKSMA__GLTF_BUFFERS, (size_t)number);
        status = bytes(&buffer, "byteLength", true, &room);
    }
    KOKSMA__JSON_FAIL_IF(!status && offset + length > room, f,
                         "its %lld bytes, from byte %lld on, go beyond the end of a buffer of %lld bytes", length,
                         offset, room);
    KOKSMA__JSON_FAIL_IF(!status && stride > 252, f, "byteStride is %lld; it must be at most 252", stride);
    return status;
}

/* Size of one element in bytes; 0: unknown type. */
static long long element_size(const char *type, long long component)
{
    static const struct {
        const char *type;
        int n;
    } types[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
    const int size = component == 5120 || component == 5121   ? 1
                     : component == 5122 || component == 5123 ? 2
                     : component == 5125 || component == 5126 ? 4
                                                              : 0;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++) {
        if (!strcmp(types[i].type, type)) {
            return types[i].n * size;
        }
    }
    return 0;
}

static koksma_status check_accessor(const koksma__gltf *g, const field *f)
{
    long long number = 0, offset = 0, count = 0, component = 0, room = 0, stride = 0;
    const char *type = "";
    field view;
    koksma_status status = names(f, "bufferView", "buffer view", g->n[KOKSMA__GLTF_VIEWS]);
    status = status ? status : bytes(f, "byteOffset", false, &offset);
    status = status ? status : koksma__json_get_whole(f, "count", true, 1, (long long)KOKSMA__MAX_VERTICES, &count);
    status = status ? status : koksma__json_get_whole(f, "componentType", true, 5120, 5126, &component);
    status = status ? status : koksma__json_get_text(f, "type", true, &type);
    const long long size = status ? 1 : element_size(type, component);
    KOKSMA__JSON_FAIL_IF(!status && !size, f, "elements of type '%.32s' and component type %lld do not exist", type,
                         component);
    KOKSMA__JSON_FAIL_IF(!status && koksma__json_has(f, "sparse"), f, "sparse accessors are not read");
    if (status || !koksma__json_has(f, "bufferView")) {
        return status;
    }
    KOKSMA__TRY(koksma__json_get_whole(f, "bufferView", true, 0, KOKSMA__GLTF_ITEMS, &number));
    view = koksma__gltf_item(g, KOKSMA__GLTF_VIEWS, (size_t)number);
    status = bytes(&view, "byteLength", true, &room);
    status = status ? status : bytes(&view, "byteStride", false, &stride);
    stride = stride > size ? stride : size;
    KOKSMA__JSON_FAIL_IF(!status && offset + (count - 1) * stride + size > room, f,
                         "%lld elements of %lld bytes lie beyond a view of %lld bytes", count, size, room);
    return status;
}

static koksma_status check_primitive(const koksma__gltf *g, const field *f)
{
    static const char *const attributes[] = {"POSITION",   "NORMAL",  "TANGENT",  "TEXCOORD_0",
                                             "TEXCOORD_1", "COLOR_0", "JOINTS_0", "WEIGHTS_0"};
    field list;
    koksma_status status = names(f, "indices", "accessor", g->n[KOKSMA__GLTF_ACCESSORS]);
    status = status ? status : names(f, "material", "material", g->n[KOKSMA__GLTF_MATERIALS]);
    status = status ? status : koksma__json_member(f, "attributes", &list);
    for (size_t i = 0; !status && i < sizeof attributes / sizeof *attributes; i++) {
        status = names(&list, attributes[i], "accessor", g->n[KOKSMA__GLTF_ACCESSORS]);
    }
    return status;
}

static koksma_status check_mesh(const koksma__gltf *g, const field *f)
{
    return each(g, f, "primitives", check_primitive);
}

static koksma_status check_texture(const koksma__gltf *g, const field *f)
{
    const koksma_status status = names(f, "source", "image", g->n[KOKSMA__GLTF_IMAGES]);
    return status ? status : names(f, "sampler", "sampler", g->n[KOKSMA__GLTF_SAMPLERS]);
}

/* Checks the texture whose index is the member `key` of a material or of a part of a material. */
static koksma_status check_texture_of(const koksma__gltf *g, const field *f, const char *key)
{
    field info;
    if (!koksma__json_is_object_at(f, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(f, key, &info);
    return status ? status : names(&info, "index", "texture", g->n[KOKSMA__GLTF_TEXTURES]);
}

static koksma_status check_material(const koksma__gltf *g, const field *f)
{
    field metal;
    koksma_status status = check_texture_of(g, f, "normalTexture");
    status = status ? status : check_texture_of(g, f, "occlusionTexture");
    status = status ? status : check_texture_of(g, f, "emissiveTexture");
    if (status || !koksma__json_is_object_at(f, "pbrMetallicRoughness")) {
        return status;
    }
    status = koksma__json_member(f, "pbrMetallicRoughness", &metal);
    status = status ? status : check_texture_of(g, &metal, "baseColorTexture");
    return status ? status : check_texture_of(g, &metal, "metallicRoughnessTexture");
}

static koksma_status check_image(const koksma__gltf *g, const field *f)
{
    return names(f, "bufferView", "buffer view", g->n[KOKSMA__GLTF_VIEWS]);
}

static koksma_status check_node(const koksma__gltf *g, const field *f)
{
    koksma_status status = names(f, "mesh", "mesh", g->n[KOKSMA__GLTF_MESHES]);
    status = status ? status : names(f, "camera", "camera", g->n[KOKSMA__GLTF_CAMERAS]);
    return status ? status : names(f, "skin", "skin", g->n[KOKSMA__GLTF_SKINS]);
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

bool koksma__gltf_reads(const char *extension)
{
    static const char *const known[] = {"KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_materials_ior",
                                        "KHR_texture_transform"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!strcmp(extension, known[i])) {
            return true;
        }
    }
    return false;
}

/* Checks one of the extensions that the file requires: a reader that does not support a required extension must not
   show the file (glTF 2.0, section 3.12). */
static koksma_status check_extension(const koksma__gltf *g, const field *item)
{
    const char *name;
    const koksma_status status = koksma__json_text(item, &name);
    (void)g;
    return status || koksma__gltf_reads(name)
               ? status
               : koksma__json_fail(item, "the file requires extension '%s', which is not read", name);
}

koksma_status koksma__gltf_check(koksma__gltf *g)
{
    static const struct {
        const char *key;
        koksma_status (*check)(const koksma__gltf *g, const field *item);
    } all[KOKSMA__GLTF_LISTS] = {[KOKSMA__GLTF_BUFFERS] = {"buffers", check_buffer},
                                 [KOKSMA__GLTF_VIEWS] = {"bufferViews", check_view},
                                 [KOKSMA__GLTF_ACCESSORS] = {"accessors", check_accessor},
                                 [KOKSMA__GLTF_MATERIALS] = {"materials", check_material},
                                 [KOKSMA__GLTF_CAMERAS] = {"cameras", NULL},
                                 [KOKSMA__GLTF_SAMPLERS] = {"samplers", NULL},
                                 [KOKSMA__GLTF_SKINS] = {"skins", NULL},
                                 [KOKSMA__GLTF_SCENES] = {"scenes", NULL},
                                 [KOKSMA__GLTF_IMAGES] = {"images", check_image},
                                 [KOKSMA__GLTF_TEXTURES] = {"textures", check_texture},
                                 [KOKSMA__GLTF_MESHES] = {"meshes", check_mesh},
                                 [KOKSMA__GLTF_NODES] = {"nodes", check_node}};
    const field *root = &g->root;
    field asset;
    const char *version = "";
    koksma_status status = koksma__json_member(root, "asset", &asset);
    status = status ? status : koksma__json_get_text(&asset, "version", true, &version);
    KOKSMA__JSON_FAIL_IF(!status && version[0] != '2', &asset, "glTF %.16s: only glTF 2 is read", version);
    for (int i = 0; !status && i < KOKSMA__GLTF_LISTS; i++) {
        status = koksma__gltf_list(root, all[i].key, &g->lists[i], &g->n[i]);
    }
    status = status ? status : each(g, root, "extensionsRequired", check_extension);
    status = status ? status : names(root, "scene", "scene", g->n[KOKSMA__GLTF_SCENES]);
    for (int i = 0; !status && i < KOKSMA__GLTF_LISTS; i++) {
        status = all[i].check ? each(g, root, all[i].key, all[i].check) : KOKSMA_OK;
    }
    unsigned char *has_parent = status ? NULL : calloc(g->n[KOKSMA__GLTF_NODES] + 1, 1);
    if (!has_parent) {
        return status ? status : koksma__fail_memory(g->n[KOKSMA__GLTF_NODES]);
    }
    status = check_tree(g, has_parent);
    free(has_parent);
    return status;
}
