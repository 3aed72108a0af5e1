/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the materials of a glTF file: factors of colour, metal and roughness, normals, emission and alpha, each with
 * its texture and its texture's transform (KHR_texture_transform); emissive strength and index of refraction; whether
 * the back is seen.
 * Occlusion is not read, because the renderer computes it. A mesh keeps only the set of texture coordinates that the
 * first texture of its material uses; textures with another set are counted for a warning. Specification: Khronos,
 * "glTF 2.0" (2021), section 3.9, and the specifications of the extensions.
 */
#include "meshes/gltf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"

typedef koksma__json_node field;

/* Largest magnitude that a number of a material may have in the file; values are clamped to their ranges later. */
#define WIDEST 1e30

/* ---- Textures ----------------------------------------------------------------------------------------------- */

/* The image of a texture: the name of a file, or bytes within the model. */
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
    out->name = strdup(name);
    out->within = true;
    out->bytes = bytes->bytes;
    out->size = bytes->size;
    return out->name ? KOKSMA_OK : koksma__fail_memory(sizeof name);
}

/* KHR_texture_transform: u' = c sx u + s sy v + ox, v' = -s sx u + c sy v + oy, with v downwards. Koksma's v is
   upwards: 1 - v. */
static koksma_status take_transform(const field *info, koksma__file_texture *out)
{
    double offset[2] = {0, 0}, scale[2] = {1, 1}, turn = 0;
    field f;
    if (!koksma__gltf_find(info, "extensions/KHR_texture_transform", &f)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_numbers(&f, "offset", false, -1e6, 1e6, 2, offset));
    KOKSMA__TRY(koksma__json_get_numbers(&f, "scale", false, -1e6, 1e6, 2, scale));
    KOKSMA__TRY(koksma__json_get_number(&f, "rotation", false, -1e6, 1e6, &turn));
    const double c = koksma__cos(turn), s = koksma__sin(turn);
    const double matrix[6] = {c * scale[0], -s * scale[1], s * scale[1] + offset[0],
                              s * scale[0], c * scale[1],  1 - c * scale[1] - offset[1]};
    out->moved = true;
    for (int i = 0; i < 6; i++) {
        out->matrix[i] = (float)matrix[i];
    }
    return KOKSMA_OK;
}

static koksma_status take_sampler(const koksma__gltf *g, const field *texture, koksma__file_texture *out)
{
    long long number = 0, wrap[2] = {10497, 10497}, filter = 0;
    if (!koksma__json_has(texture, "sampler")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_whole(texture, "sampler", true, 0, KOKSMA__GLTF_ITEMS, &number));
    const field f = koksma__gltf_item(g, KOKSMA__GLTF_SAMPLERS, (size_t)number);
    KOKSMA__TRY(koksma__json_get_whole(&f, "wrapS", false, 0, 65535, &wrap[0]));
    KOKSMA__TRY(koksma__json_get_whole(&f, "wrapT", false, 0, 65535, &wrap[1]));
    KOKSMA__TRY(koksma__json_get_whole(&f, "magFilter", false, 0, 65535, &filter));
    out->wrap[0] = (int)wrap[0];
    out->wrap[1] = (int)wrap[1];
    out->nearest = filter == 9728;
    return KOKSMA_OK;
}

/* The number of the set of texture coordinates that a texture uses. */
static koksma_status take_set(const field *info, long long *set)
{
    field f;
    *set = 0;
    KOKSMA__TRY(koksma__json_get_whole(info, "texCoord", false, 0, KOKSMA__GLTF_ITEMS, set));
    return koksma__gltf_find(info, "extensions/KHR_texture_transform", &f)
               ? koksma__json_get_whole(&f, "texCoord", false, 0, KOKSMA__GLTF_ITEMS, set)
               : KOKSMA_OK;
}

/* Reads the texture `key` of a part of a material, if the texture exists and has an image. */
static koksma_status take_texture(koksma__gltf *g, size_t material, const field *f, const char *key,
                                  koksma__file_texture *out)
{
    long long number = 0, image = 0, set = 0;
    field info;
    if (!koksma__json_is_object_at(f, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(f, key, &info));
    KOKSMA__TRY(koksma__json_get_whole(&info, "index", true, 0, KOKSMA__GLTF_ITEMS, &number));
    const field texture = koksma__gltf_item(g, KOKSMA__GLTF_TEXTURES, (size_t)number);
    KOKSMA__TRY(koksma__json_get_whole(&texture, "source", false, 0, KOKSMA__GLTF_ITEMS, &image));
    if (!koksma__json_has(&texture, "source")) {
        return KOKSMA_OK; /* its image comes from an unsupported extension, which a warning names */
    }
    KOKSMA__TRY(take_set(&info, &set));
    g->out->unread.second_uvs += set != koksma__gltf_uv_set(g, material);
    KOKSMA__TRY(take_transform(&info, out));
    KOKSMA__TRY(take_sampler(g, &texture, out));
    return take_image(g, (size_t)image, out);
}

int koksma__gltf_uv_set(const koksma__gltf *g, size_t material)
{
    static const char *const textures[] = {"pbrMetallicRoughness/baseColorTexture",
                                           "pbrMetallicRoughness/metallicRoughnessTexture", "normalTexture",
                                           "emissiveTexture"};
    long long set = 0;
    for (size_t i = 0; material < g->n[KOKSMA__GLTF_MATERIALS] && i < sizeof textures / sizeof *textures; i++) {
        const field f = koksma__gltf_item(g, KOKSMA__GLTF_MATERIALS, material);
        field info;
        if (koksma__gltf_find(&f, textures[i], &info) && !take_set(&info, &set)) {
            break;
        }
    }
    return set == 1;
}

/* ---- Materials ---------------------------------------------------------------------------------------------- */

/* Reads factors and textures of colour, metal and roughness. */
static koksma_status take_surface(koksma__gltf *g, size_t i, const field *f, koksma__file_material *m)
{
    double colour[4] = {1, 1, 1, 1}, metallic = 1, roughness = 1;
    field found;
    if (koksma__gltf_find(f, "pbrMetallicRoughness", &found)) {
        KOKSMA__TRY(koksma__json_get_numbers(&found, "baseColorFactor", false, -WIDEST, WIDEST, 4, colour));
        KOKSMA__TRY(koksma__json_get_number(&found, "metallicFactor", false, -WIDEST, WIDEST, &metallic));
        KOKSMA__TRY(koksma__json_get_number(&found, "roughnessFactor", false, -WIDEST, WIDEST, &roughness));
        KOKSMA__TRY(take_texture(g, i, &found, "baseColorTexture", &m->colour_map));
        KOKSMA__TRY(take_texture(g, i, &found, "metallicRoughnessTexture", &m->surface_map));
    }
    if (koksma__gltf_find(f, "extensions/KHR_materials_ior", &found)) {
        KOKSMA__TRY(koksma__json_get_number(&found, "ior", false, 0, WIDEST, &m->ior));
    }
    for (int k = 0; k < 3; k++) {
        m->colour[k] = (float)colour[k];
    }
    m->alpha = colour[3];
    m->metallic = (float)metallic;
    m->roughness = (float)roughness;
    return KOKSMA_OK;
}

static koksma_status take_emission(koksma__gltf *g, size_t i, const field *f, koksma__file_material *m)
{
    double glow[3] = {0, 0, 0}, times = 1;
    field found;
    KOKSMA__TRY(koksma__json_get_numbers(f, "emissiveFactor", false, -WIDEST, WIDEST, 3, glow));
    KOKSMA__TRY(take_texture(g, i, f, "emissiveTexture", &m->glow_map));
    if (koksma__gltf_find(f, "extensions/KHR_materials_emissive_strength", &found)) {
        KOKSMA__TRY(koksma__json_get_number(&found, "emissiveStrength", false, 0, 1e6, &times));
    }
    for (int k = 0; k < 3; k++) {
        m->glow[k] = (double)(float)glow[k] * times;
    }
    return KOKSMA_OK;
}

static koksma_status take_material(koksma__gltf *g, size_t i, koksma__file_material *m)
{
    const field f = koksma__gltf_item(g, KOKSMA__GLTF_MATERIALS, i);
    const char *alpha = "OPAQUE";
    double scale = 1, cutoff = 0.5;
    field found;
    KOKSMA__TRY(take_surface(g, i, &f, m));
    KOKSMA__TRY(take_emission(g, i, &f, m));
    KOKSMA__TRY(take_texture(g, i, &f, "normalTexture", &m->normal_map));
    if (koksma__gltf_find(&f, "normalTexture", &found)) {
        KOKSMA__TRY(koksma__json_get_number(&found, "scale", false, -WIDEST, WIDEST, &scale));
    }
    KOKSMA__TRY(koksma__json_get_flag(&f, "doubleSided", false, &m->two_sided));
    KOKSMA__TRY(koksma__json_get_text(&f, "alphaMode", false, &alpha));
    KOKSMA__TRY(koksma__json_get_number(&f, "alphaCutoff", false, 0, WIDEST, &cutoff));
    m->normal_map.scale = (float)scale;
    m->blends = strcmp(alpha, "OPAQUE") != 0;
    m->cutoff = strcmp(alpha, "MASK") ? 0 : cutoff;
    m->tinted = g->material_tinted[i];
    return KOKSMA_OK;
}

/* Reads all materials in use; the last one stands for primitives without a material. */
koksma_status koksma__gltf_read_materials(koksma__gltf *g)
{
    const size_t n = g->n[KOKSMA__GLTF_MATERIALS];
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i <= n; i++) {
        koksma__file_material *m;
        status = koksma__file_add_material(g->out, 1, &m);
        if (status) {
            return status;
        }
        m->metallic = m->roughness = 1; /* glTF's defaults */
        m->alpha = 1;
        m->ior = 1.5;
        m->principled = true;
        m->tinted = g->material_tinted[i];
        status = i < n && g->material_used[i] ? take_material(g, i, m) : KOKSMA_OK;
    }
    return status;
}
