/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads a glTF 2.0 file, as JSON (.gltf) or binary (.glb): checks it, loads its buffers, finds what its scene shows,
 * and reads the meshes, and of the materials that these use the colour, metallic and roughness factors, the emission,
 * and the textures of colour and emission. What the file has that is not read is counted, for the warnings.
 * Specification: Khronos, "glTF 2.0" (2021), KHR_lights_punctual, KHR_materials_emissive_strength.
 */
#include "meshes/gltf_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"
#include "meshes/gltf_buffers.h"
#include "meshes/gltf_check.h"
#include "meshes/gltf_meshes.h"
#include "meshes/gltf_nodes.h"

typedef koksma__json_node field;

#define WIDEST 1e30 /* of a material's numbers; they are clamped later */

/* ---- Materials ---------------------------------------------------------------------------------------------- */

/* The image of a texture: a file's name, or bytes of the model. */
static koksma_status take_image(koksma__gltf *g, size_t number, koksma__file_texture *out)
{
    const field f = koksma__gltf_item(g, KOKSMA__GLTF_IMAGES, number);
    const char *uri = NULL, *type = NULL;
    char name[32];
    long long view = 0;
    size_t stride;
    koksma__gltf_bytes *bytes = &g->images[number];
    koksma_status status = koksma__json_get_text(&f, "uri", false, &uri);
    const bool data = uri && !strncmp(uri, "data:", 5);
    if (!status && uri && !data) {
        out->name = strdup(uri);
        return out->name ? KOKSMA_OK : koksma__fail_memory(strlen(uri));
    }
    if (!status && data && !bytes->bytes) {
        status = koksma__gltf_decode(g, &f, uri, bytes);
    } else if (!status && !data) {
        status = koksma__json_get_whole(&f, "bufferView", true, 0, KOKSMA__GLTF_ITEMS, &view);
        status = status ? status : koksma__json_get_text(&f, "mimeType", true, &type);
        status = status ? status : koksma__gltf_view(g, (size_t)view, bytes, &stride);
    }
    if (status) {
        return status;
    }
    snprintf(name, sizeof name, "images[%zu]", number);
    *out = (koksma__file_texture){.name = strdup(name), .within = true, .bytes = bytes->bytes, .size = bytes->size};
    return out->name ? KOKSMA_OK : koksma__fail_memory(sizeof name);
}

/* The texture `key` of a part of a material, if there is one, and if that has an image. */
static koksma_status take_texture(koksma__gltf *g, const field *f, const char *key, koksma__file_texture *out)
{
    long long number = 0, image = 0;
    field info;
    if (!koksma__json_is_object_at(f, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(f, key, &info));
    KOKSMA__TRY(koksma__json_get_whole(&info, "index", true, 0, KOKSMA__GLTF_ITEMS, &number));
    const field texture = koksma__gltf_item(g, KOKSMA__GLTF_TEXTURES, (size_t)number);
    const koksma_status status = koksma__json_get_whole(&texture, "source", false, 0, KOKSMA__GLTF_ITEMS, &image);
    return status || !koksma__json_has(&texture, "source") ? status : take_image(g, (size_t)image, out);
}

/* What is not read of the texture of base colour. */
static koksma_status note_unread(koksma__gltf *g, const field *f)
{
    static const char *const texture[] = {"pbrMetallicRoughness", "baseColorTexture", NULL};
    static const char *const transform[] = {"extensions", "KHR_texture_transform", NULL};
    koksma__unread *unread = &g->out->unread;
    field found, moved;
    long long set = 0;
    if (!koksma__gltf_find(f, texture, &found)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_get_whole(&found, "texCoord", false, 0, KOKSMA__GLTF_ITEMS, &set);
    unread->second_uvs += !status && set > 0;
    unread->transforms += !status && koksma__gltf_find(&found, transform, &moved);
    return status;
}

static koksma_status take_material(koksma__gltf *g, const field *f, koksma__file_material *m)
{
    static const char *const metal[] = {"pbrMetallicRoughness", NULL};
    static const char *const strength[] = {"extensions", "KHR_materials_emissive_strength", NULL};
    double colour[4] = {1, 1, 1, 1}, glow[3] = {0, 0, 0}, metallic = 1, roughness = 1, times = 1;
    const char *alpha = "OPAQUE";
    field found;
    koksma_status status = KOKSMA_OK;
    if (koksma__gltf_find(f, metal, &found)) {
        status = koksma__json_get_numbers(&found, "baseColorFactor", false, -WIDEST, WIDEST, 4, colour);
        status =
            status ? status : koksma__json_get_number(&found, "metallicFactor", false, -WIDEST, WIDEST, &metallic);
        status =
            status ? status : koksma__json_get_number(&found, "roughnessFactor", false, -WIDEST, WIDEST, &roughness);
        status = status ? status : take_texture(g, &found, "baseColorTexture", &m->colour_map);
    }
    status = status ? status : koksma__json_get_numbers(f, "emissiveFactor", false, -WIDEST, WIDEST, 3, glow);
    status = status ? status : take_texture(g, f, "emissiveTexture", &m->glow_map);
    status = status ? status : koksma__json_get_text(f, "alphaMode", false, &alpha);
    if (!status && koksma__gltf_find(f, strength, &found)) {
        status = koksma__json_get_number(&found, "emissiveStrength", false, 0, 1e6, &times);
    }
    for (int k = 0; k < 3; k++) {
        m->colour[k] = (float)colour[k];
        m->glow[k] = (double)(float)glow[k] * times;
    }
    m->metallic = (float)metallic;
    m->roughness = (float)roughness;
    m->see_through = !status && strcmp(alpha, "OPAQUE") != 0;
    return status;
}

/* Materials have the numbers that the file gives them; the last is for primitives that name none. */
static koksma_status take_materials(koksma__gltf *g)
{
    const size_t n = g->n[KOKSMA__GLTF_MATERIALS];
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i <= n; i++) {
        koksma__file_material *m;
        status = koksma__file_add_material(g->out, 1, &m);
        if (!status && i < n) {
            const field f = koksma__gltf_item(g, KOKSMA__GLTF_MATERIALS, i);
            status = note_unread(g, &f);
            status = status || !g->material_used[i] ? status : take_material(g, &f, m);
        } else if (!status) {
            m->metallic = 1; /* glTF's default */
        }
    }
    return status;
}

/* ---- The file ----------------------------------------------------------------------------------------------- */

static size_t number_at(const unsigned char *at)
{
    return at[0] | (size_t)at[1] << 8 | (size_t)at[2] << 16 | (size_t)at[3] << 24;
}

/* A binary file: a head, then pieces with their length and kind. The JSON's text; and the binary piece, if any. */
static koksma_status split(const char *path, koksma__gltf_bytes *text, koksma__gltf_bytes *binary)
{
    const unsigned char *file = text->bytes;
    const size_t size = text->size;
    if (size < 4 || memcmp(file, "glTF", 4) != 0) {
        return KOKSMA_OK;
    }
    KOKSMA__FAIL_IF(size < 20 || number_at(file + 4) != 2 || memcmp(file + 16, "JSON", 4) != 0 ||
                        number_at(file + 12) > size - 20,
                    KOKSMA_MALFORMED, "%s: no glTF 2 in its binary form, or cut short", path);
    *text = (koksma__gltf_bytes){file + 20, number_at(file + 12)};
    const size_t next = 20 + text->size;
    KOKSMA__FAIL_IF(number_at(file + 8) != size ||
                        (next < size && (size - next < 8 || number_at(file + next) > size - next - 8)),
                    KOKSMA_MALFORMED, "%s: its pieces are not as long as the file", path);
    if (next < size && text->size % 4) { /* glTF 2.0, section 4.4.3.1 */
        return koksma__fail(KOKSMA_MALFORMED, "%s: its first piece has %zu bytes, no multiple of 4", path,
                            text->size);
    }
    if (next < size && !memcmp(file + next + 4, "BIN", 4)) {
        *binary = (koksma__gltf_bytes){file + next + 8, number_at(file + next)};
    }
    return KOKSMA_OK;
}

/* Room by the lengths of the lists, all zero. */
static koksma_status make_arrays(koksma__gltf *g)
{
    g->buffers = calloc(g->n[KOKSMA__GLTF_BUFFERS] + 1, sizeof *g->buffers);
    g->images = calloc(g->n[KOKSMA__GLTF_IMAGES] + 1, sizeof *g->images);
    g->beyond = calloc(g->n[KOKSMA__GLTF_ACCESSORS] + 1, sizeof *g->beyond);
    g->mesh_shown = calloc(g->n[KOKSMA__GLTF_MESHES] + 1, sizeof *g->mesh_shown);
    g->material_used = calloc(g->n[KOKSMA__GLTF_MATERIALS] + 1, sizeof *g->material_used);
    const bool all = g->buffers && g->images && g->beyond && g->mesh_shown && g->material_used;
    return all ? KOKSMA_OK : koksma__fail_memory(g->n[KOKSMA__GLTF_ACCESSORS] * sizeof *g->beyond);
}

static koksma_status read_all(koksma__gltf *g)
{
    koksma__unread *unread = &g->out->unread;
    field list;
    koksma_status status = koksma__gltf_check(g);
    status = status ? status : make_arrays(g);
    status = status ? status : koksma__gltf_list(&g->root, "animations", &list, &unread->animations);
    unread->skins = g->n[KOKSMA__GLTF_SKINS];
    status = status ? status : koksma__gltf_load_buffers(g);
    status = status ? status : koksma__gltf_read_nodes(g);
    status = status ? status : koksma__gltf_read_meshes(g);
    return status ? status : take_materials(g);
}

koksma_status koksma__gltf_read(const unsigned char *bytes, size_t size, koksma__mesh_file *out)
{
    koksma__gltf g = {.out = out};
    koksma__json *document;
    koksma__gltf_bytes text = {bytes, size};
    KOKSMA__TRY(split(out->path, &text, &g.binary));
    koksma_status status = koksma__json_open("glTF", out->path, (const char *)text.bytes, text.size, &document);
    if (!status) {
        g.root = koksma__json_root(document);
        status = read_all(&g);
    }
    koksma__json_close(document);
    KOKSMA__FREE(g.buffers, g.images, g.beyond, g.mesh_shown, g.material_used, g.shown.items);
    return status;
}
