/* SPDX-License-Identifier: Apache-2.0 */
/*
 * glTF 2 before assimp sees it: every number that names another thing is in range, every piece lies within what holds
 * it, and nodes are trees. assimp takes some of that on trust. gltf_indices.c looks into the buffers; the file's
 * other errors are left to assimp.
 */
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "meshes/gltf.h"

typedef koksma__json_node field;

#define MAX_BYTES ((long long)1 << 30)

typedef struct lists {
    field root;
    size_t buffers, views, accessors, meshes, nodes, materials, cameras, images, textures, samplers, skins, scenes;
} lists;

/* Calls f for every item of the list. */
static koksma_status each(const lists *l, const field *object, const char *key,
                          koksma_status (*f)(const lists *l, const field *item))
{
    field list;
    size_t n;
    koksma_status status = koksma__gltf_list(object, key, &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const field item = koksma__json_item(&list, i);
        status = f(l, &item);
    }
    return status;
}

/* The number of a thing of which there are n, where the object has one. */
static koksma_status names(const field *object, const char *key, const char *thing, size_t n)
{
    long long number = 0;
    const koksma_status status = koksma__json_get_whole(object, key, false, 0, KOKSMA__GLTF_ITEMS, &number);
    if (!status && koksma__json_has(object, key) && (size_t)number >= n) {
        return koksma__json_fail(object, "%s: there is no %s %lld; the file has %zu, from 0 on", key, thing, number,
                                 n);
    }
    return status;
}

static koksma_status bytes(const field *object, const char *key, bool needed, long long *out)
{
    *out = 0;
    return koksma__json_get_whole(object, key, needed, 0, MAX_BYTES, out);
}

/* Item i of a list of the root. */
static koksma_status item_of(const lists *l, const char *key, long long i, field *out)
{
    field list;
    const koksma_status status = koksma__json_member(&l->root, key, &list);
    if (!status) {
        *out = koksma__json_item(&list, (size_t)i);
    }
    return status;
}

static koksma_status check_buffer(const lists *l, const field *f)
{
    long long length;
    (void)l;
    return bytes(f, "byteLength", true, &length);
}

static koksma_status check_view(const lists *l, const field *f)
{
    long long number = 0, offset = 0, length = 0, room = 0, stride = 0;
    field buffer;
    koksma_status status = names(f, "buffer", "buffer", l->buffers);
    status = status ? status : koksma__json_get_whole(f, "buffer", true, 0, KOKSMA__GLTF_ITEMS, &number);
    status = status ? status : bytes(f, "byteOffset", false, &offset);
    status = status ? status : bytes(f, "byteLength", true, &length);
    status = status ? status : bytes(f, "byteStride", false, &stride);
    status = status ? status : item_of(l, "buffers", number, &buffer);
    status = status ? status : bytes(&buffer, "byteLength", true, &room);
    if (!status && (offset + length > room || stride > 252)) {
        return koksma__json_fail(f, "%lld bytes from %lld on lie beyond a buffer of %lld, or a stride above 252",
                                 length, offset, room);
    }
    return status;
}

/* Bytes of one element; 0: unknown. */
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

static koksma_status check_accessor(const lists *l, const field *f)
{
    long long number = 0, offset = 0, count = 0, component = 0, room = 0, stride = 0;
    const char *type = "";
    field view;
    koksma_status status = names(f, "bufferView", "buffer view", l->views);
    status = status ? status : bytes(f, "byteOffset", false, &offset);
    status = status ? status : koksma__json_get_whole(f, "count", true, 1, (long long)KOKSMA__MAX_VERTICES, &count);
    status = status ? status : koksma__json_get_whole(f, "componentType", true, 5120, 5126, &component);
    status = status ? status : koksma__json_get_text(f, "type", true, &type);
    const long long size = status ? 1 : element_size(type, component);
    if (!status && !size) {
        return koksma__json_fail(f, "no elements of type '%.32s' and component type %lld", type, component);
    }
    if (!status && koksma__json_has(f, "sparse")) {
        return koksma__json_fail(f, "sparse accessors are not read");
    }
    if (status || !koksma__json_has(f, "bufferView")) {
        return status;
    }
    status = koksma__json_get_whole(f, "bufferView", true, 0, KOKSMA__GLTF_ITEMS, &number);
    status = status ? status : item_of(l, "bufferViews", number, &view);
    status = status ? status : bytes(&view, "byteLength", true, &room);
    status = status ? status : bytes(&view, "byteStride", false, &stride);
    stride = stride > size ? stride : size;
    if (!status && offset + (count - 1) * stride + size > room) {
        return koksma__json_fail(f, "%lld elements of %lld bytes lie beyond a view of %lld bytes", count, size, room);
    }
    return status;
}

static koksma_status check_primitive(const lists *l, const field *f)
{
    static const char *const attributes[] = {"POSITION",   "NORMAL",  "TANGENT",  "TEXCOORD_0",
                                             "TEXCOORD_1", "COLOR_0", "JOINTS_0", "WEIGHTS_0"};
    field list;
    koksma_status status = names(f, "indices", "accessor", l->accessors);
    status = status ? status : names(f, "material", "material", l->materials);
    status = status ? status : koksma__json_member(f, "attributes", &list);
    for (size_t i = 0; !status && i < sizeof attributes / sizeof *attributes; i++) {
        status = names(&list, attributes[i], "accessor", l->accessors);
    }
    if (!status && koksma__json_has(f, "targets")) {
        return koksma__json_fail(f, "morph targets are not read");
    }
    return status;
}

static koksma_status check_mesh(const lists *l, const field *f)
{
    return each(l, f, "primitives", check_primitive);
}

static koksma_status check_texture(const lists *l, const field *f)
{
    const koksma_status status = names(f, "source", "image", l->images);
    return status ? status : names(f, "sampler", "sampler", l->samplers);
}

/* The texture of that member of a material, or of a part of it. */
static koksma_status check_texture_of(const lists *l, const field *f, const char *key)
{
    field info;
    if (!koksma__json_is_object_at(f, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(f, key, &info);
    return status ? status : names(&info, "index", "texture", l->textures);
}

static koksma_status check_material(const lists *l, const field *f)
{
    field metal;
    koksma_status status = check_texture_of(l, f, "normalTexture");
    status = status ? status : check_texture_of(l, f, "occlusionTexture");
    status = status ? status : check_texture_of(l, f, "emissiveTexture");
    if (status || !koksma__json_is_object_at(f, "pbrMetallicRoughness")) {
        return status;
    }
    status = koksma__json_member(f, "pbrMetallicRoughness", &metal);
    status = status ? status : check_texture_of(l, &metal, "baseColorTexture");
    return status ? status : check_texture_of(l, &metal, "metallicRoughnessTexture");
}

static koksma_status check_image(const lists *l, const field *f)
{
    return names(f, "bufferView", "buffer view", l->views);
}

static koksma_status check_node(const lists *l, const field *f)
{
    koksma_status status = names(f, "mesh", "mesh", l->meshes);
    status = status ? status : names(f, "camera", "camera", l->cameras);
    return status ? status : names(f, "skin", "skin", l->skins);
}

/* Every node has one parent at most, and the roots of scenes have none: then no way leads round. */
static koksma_status check_tree(const lists *l, unsigned char *has_parent)
{
    field nodes, scenes, list;
    size_t n, n_scenes = 0;
    koksma_status status = koksma__gltf_list(&l->root, "nodes", &nodes, &n);
    for (int pass = 0; !status && pass < 2; pass++) {
        status = pass ? koksma__gltf_list(&l->root, "scenes", &scenes, &n_scenes) : KOKSMA_OK;
        for (size_t i = 0; !status && i < (pass ? n_scenes : l->nodes); i++) {
            const field item = koksma__json_item(pass ? &scenes : &nodes, i);
            status = koksma__gltf_list(&item, pass ? "nodes" : "children", &list, &n);
            for (size_t c = 0; !status && c < n; c++) {
                const field child = koksma__json_item(&list, c);
                long long number = 0;
                status = koksma__json_whole(&child, 0, (long long)l->nodes - 1, &number);
                if (!status && has_parent[number]) {
                    return koksma__json_fail(&child, pass ? "node %lld has a parent" : "node %lld has two parents",
                                             number);
                }
                has_parent[status ? 0 : number] |= !pass;
            }
        }
    }
    return status;
}

static koksma_status check_root(const field *root)
{
    lists l = {.root = *root};
    const struct {
        const char *key;
        size_t *n;
        koksma_status (*check)(const lists *l, const field *item);
    } all[] = {{"buffers", &l.buffers, check_buffer},
               {"bufferViews", &l.views, check_view},
               {"accessors", &l.accessors, check_accessor},
               {"materials", &l.materials, check_material},
               {"cameras", &l.cameras, NULL},
               {"samplers", &l.samplers, NULL},
               {"skins", &l.skins, NULL},
               {"scenes", &l.scenes, NULL},
               {"images", &l.images, check_image},
               {"textures", &l.textures, check_texture},
               {"meshes", &l.meshes, check_mesh},
               {"nodes", &l.nodes, check_node}};
    field asset, list;
    const char *version = "";
    koksma_status status = koksma__json_member(root, "asset", &asset);
    status = status ? status : koksma__json_get_text(&asset, "version", true, &version);
    if (!status && version[0] != '2') {
        return koksma__json_fail(&asset, "glTF %.16s: only glTF 2 is read", version);
    }
    for (size_t i = 0; !status && i < sizeof all / sizeof *all; i++) {
        status = koksma__gltf_list(root, all[i].key, &list, all[i].n);
    }
    status = status ? status : names(root, "scene", "scene", l.scenes);
    for (size_t i = 0; !status && i < sizeof all / sizeof *all; i++) {
        status = all[i].check ? each(&l, root, all[i].key, all[i].check) : KOKSMA_OK;
    }
    if (status) {
        return status;
    }
    unsigned char *has_parent = calloc(l.nodes + 1, 1);
    if (!has_parent) {
        return koksma__fail_memory(l.nodes);
    }
    status = check_tree(&l, has_parent);
    free(has_parent);
    return status;
}

static size_t number_at(const unsigned char *at)
{
    return at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

koksma_status koksma__gltf_read(const char *path, const unsigned char *file, size_t size, koksma__gltf *out)
{
    koksma__json *document;
    const unsigned char *text = file;
    const unsigned char *bin = NULL;
    size_t length = size, bin_size = 0;
    if (size >= 4 && !memcmp(file, "glTF", 4)) { /* binary: a head, then pieces with their length and kind */
        if (size < 20 || number_at(file + 4) != 2 || memcmp(file + 16, "JSON", 4) != 0 ||
            number_at(file + 12) > size - 20) {
            return koksma__fail(KOKSMA_MALFORMED, "%s: no glTF 2 in its binary form, or cut short", path);
        }
        text = file + 20;
        length = number_at(file + 12);
        const size_t next = 20 + length;
        if (number_at(file + 8) != size ||
            (next < size && (size - next < 8 || number_at(file + next) > size - next - 8))) {
            return koksma__fail(KOKSMA_MALFORMED, "%s: its pieces are not as long as the file", path);
        }
        if (next < size && length % 4) { /* assimp looks for the second one at a multiple of 4 */
            return koksma__fail(KOKSMA_MALFORMED, "%s: its first piece has %zu bytes, no multiple of 4", path,
                                length);
        }
        if (next < size && !memcmp(file + next + 4, "BIN", 4)) {
            bin = file + next + 8;
            bin_size = number_at(file + next);
        }
    }
    koksma_status status = koksma__json_open("glTF", path, (const char *)text, length, &document);
    if (!status) {
        const field root = koksma__json_root(document);
        status = check_root(&root);
        status = status ? status : koksma__gltf_facts(&root, out);
        status = status ? status : koksma__gltf_check_indices(path, &root, bin, bin_size);
    }
    koksma__json_close(document);
    return status;
}

koksma_status koksma__gltf_check(const char *path, const unsigned char *file, size_t size)
{
    koksma__gltf idle;
    koksma__gltf_init(&idle);
    return koksma__gltf_read(path, file, size, &idle);
}
