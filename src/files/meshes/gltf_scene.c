/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads what the scene of a glTF file shows: where its nodes place meshes, lights (KHR_lights_punctual) and the camera,
 * then the meshes, then the materials that these use. Specification: Khronos, "glTF 2.0" (2021), and the extensions'.
 * Long because these share what is marked as shown and used.
 *
 * A node's matrix is the product of the matrices from its root down to the node, in double precision. gltf_schema.c has
 * checked that nodes form trees.
 *
 * Each primitive of triangles, strips or fans becomes a mesh. POSITION, NORMAL, COLOR_0, one set of texture coordinates
 * and the indices are read; the origin of texture coordinates is the upper left in glTF and the lower left here, so v
 * becomes 1 - v. All meshes are checked: attributes have as many elements as there are positions, and every index names a
 * position (section 3.7.2). Only meshes that a node of the scene shows are kept.
 *
 * Of materials are read: factors of colour, metal and roughness, normals, emission and alpha, each with its texture and its
 * texture's transform (KHR_texture_transform); emissive strength and index of refraction; whether the back is seen (section
 * 3.9). Occlusion is not read, because the renderer computes it. A mesh keeps only the set of texture coordinates that the
 * first texture of its material uses; textures with another set are counted for a warning.
 */
#include "meshes/gltf.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"

typedef koksma__json_node field;

enum { MAX_DEPTH = 512 /* of nodes */, TRIANGLES = 4, STRIP = 5, FAN = 6 };
#define WIDEST 1e30  /* largest magnitude of a number of a node or material; positions and ranges are checked later */
#define ROUNDED 0.01 /* what rounding may add to the length of a quaternion */

static const char punctual[] = "extensions/KHR_lights_punctual";

typedef struct graph {
    koksma__gltf *g;
    field lights;
    size_t n_lights;
    double (*matrices)[12]; /* world matrices of the nodes that are shown */
    bool *shown;            /* whether the node is in the scene */
} graph;

/* ---- Matrices of nodes -------------------------------------------------------------------------------------- */

/* A node's own transform: a matrix stored by columns, or x -> translation + rotation (scale x) with the rotation as a
   quaternion (glTF 2.0, 3.5.3). */
static koksma_status own_matrix(koksma__gltf *g, const field *node, double out[12])
{
    double m[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (koksma__json_has(node, "matrix")) {
        KOKSMA__TRY(koksma__json_get_numbers(node, "matrix", true, -WIDEST, WIDEST, 16, m));
        for (int i = 0; i < 12; i++) {
            out[i] = m[4 * (i % 4) + i / 4];
        }
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_numbers(node, "translation", false, -WIDEST, WIDEST, 3, t));
    KOKSMA__TRY(koksma__json_get_numbers(node, "rotation", false, -WIDEST, WIDEST, 4, q));
    KOKSMA__TRY(koksma__json_get_numbers(node, "scale", false, -WIDEST, WIDEST, 3, s));
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    KOKSMA__TRY(fabs(sqrt(x * x + y * y + z * z + w * w) - 1) < ROUNDED
                    ? KOKSMA_OK
                    : koksma__gltf_name(g, node,
                                        "a rotation is a quaternion of length 1, and this has another length; "
                                        "is it in degrees?"));
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                            2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                            2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 12; i++) {
        out[i] = i % 4 == 3 ? t[i / 4] : turn[3 * (i / 4) + i % 4] * s[i % 4];
    }
    return KOKSMA_OK;
}

/* Visits a node, then its descendants: sets their matrices and adds the placements of their meshes. */
static koksma_status walk_node(graph *s, size_t i, const double parent[12], int depth)
{
    koksma__gltf *g = s->g;
    const field node = koksma__gltf_item(g, KOKSMA__GLTF_NODES, i);
    const size_t mesh = koksma__gltf_index(&node, "mesh", SIZE_MAX >> 1);
    field list;
    size_t n = 0;
    long long number = 0;
    double own[12];
    KOKSMA__JSON_FAIL_IF(depth == MAX_DEPTH, &node, "nodes are nested too deeply");
    KOKSMA__JSON_FAIL_IF(s->shown[i], &node, "the scene names this node twice");
    s->shown[i] = true;
    KOKSMA__TRY(own_matrix(g, &node, own));
    koksma__matrix_multiply(parent, own, s->matrices[i]);
    if (mesh < g->n[KOKSMA__GLTF_MESHES]) {
        koksma__file_placement *to = koksma__list_add(&g->shown, 1, sizeof *to);
        KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
        to->mesh = mesh;
        g->mesh_shown[mesh] = true;
        memcpy(to->matrix, s->matrices[i], sizeof to->matrix);
    }
    KOKSMA__TRY(koksma__gltf_list(&node, "children", &list, &n));
    for (size_t c = 0; c < n; c++) {
        const field child = koksma__json_item(&list, c);
        KOKSMA__TRY(koksma__json_whole(&child, 0, KOKSMA__GLTF_ITEMS, &number));
        KOKSMA__TRY(walk_node(s, (size_t)number, s->matrices[i], depth + 1));
    }
    return KOKSMA_OK;
}

/* Visits the scene that the file names as its default, or else its first scene. */
static koksma_status walk_scene(graph *s)
{
    koksma__gltf *g = s->g;
    field list;
    long long number = 0;
    size_t n = 0;
    KOKSMA__JSON_FAIL_IF(!g->n[KOKSMA__GLTF_SCENES], &g->root, "the file has no scenes: nothing is shown");
    const field shown = koksma__gltf_item(g, KOKSMA__GLTF_SCENES, koksma__gltf_index(&g->root, "scene", 0));
    KOKSMA__TRY(koksma__gltf_list(&shown, "nodes", &list, &n));
    for (size_t i = 0; i < n; i++) {
        const field item = koksma__json_item(&list, i);
        KOKSMA__TRY(koksma__json_whole(&item, 0, KOKSMA__GLTF_ITEMS, &number));
        KOKSMA__TRY(walk_node(s, (size_t)number, koksma__identity_matrix, 0));
    }
    return KOKSMA_OK;
}

/* ---- Lights and cameras ------------------------------------------------------------------------------------- */

/* A spot's angles. */
static koksma_status take_cone(const field *from, koksma__file_light *light)
{
    field f;
    light->outer = M_PI / 4;
    if (!koksma__gltf_find(from, "spot", &f)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_number(&f, "outerConeAngle", false, 0, M_PI, &light->outer));
    KOKSMA__TRY(koksma__json_get_number(&f, "innerConeAngle", false, 0, M_PI, &light->inner));
    light->outer = fmin(fmax(light->outer, 0.01), M_PI / 2);
    light->inner = fmin(light->inner, light->outer);
    return KOKSMA_OK;
}

/* Reads the node's light, if it has one (KHR_lights_punctual). */
static koksma_status take_light(const graph *s, size_t i, const field *node)
{
    field found;
    long long number = 0;
    const char *type = "";
    double intensity = 1, colour[3] = {1, 1, 1};
    if (!koksma__gltf_find(node, punctual, &found) || !koksma__json_has(&found, "light")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_whole(&found, "light", true, 0, KOKSMA__GLTF_ITEMS, &number));
    KOKSMA__JSON_FAIL_IF((size_t)number >= s->n_lights, &found, "light %lld of %zu lights does not exist", number,
                         s->n_lights);
    if (!s->shown[i]) {
        return KOKSMA_OK;
    }
    koksma__file_light *light = koksma__list_add(&s->g->out->lights, 1, sizeof *light);
    KOKSMA__TRY(light ? KOKSMA_OK : KOKSMA_MEMORY);
    const field from = koksma__json_item(&s->lights, (size_t)number);
    KOKSMA__TRY(koksma__json_get_text(&from, "type", true, &type));
    KOKSMA__TRY(koksma__json_get_number(&from, "intensity", false, 0, WIDEST, &intensity));
    KOKSMA__TRY(koksma__json_get_numbers(&from, "color", false, 0, WIDEST, 3, colour));
    light->far_away = !strcmp(type, "directional");
    light->is_spot = !strcmp(type, "spot");
    KOKSMA__JSON_FAIL_IF(!light->far_away && !light->is_spot && strcmp(type, "point") != 0, &from,
                         "lights of type '%.32s' can't be read", type);
    for (int k = 0; k < 3; k++) {
        light->colour[k] = intensity * colour[k];
    }
    memcpy(light->matrix, s->matrices[i], sizeof light->matrix);
    return light->is_spot ? take_cone(&from, light) : KOKSMA_OK;
}

/* Takes the perspective camera of the first node that has one. */
static koksma_status take_camera(const graph *s)
{
    koksma__gltf *g = s->g;
    size_t best = g->n[KOKSMA__GLTF_CAMERAS];
    for (size_t i = 0; i < g->n[KOKSMA__GLTF_NODES]; i++) {
        field found;
        const field node = koksma__gltf_item(g, KOKSMA__GLTF_NODES, i);
        const size_t number = koksma__gltf_index(&node, "camera", best);
        if (number >= best || !s->shown[i]) {
            continue;
        }
        const field camera = koksma__gltf_item(g, KOKSMA__GLTF_CAMERAS, number);
        if (koksma__gltf_find(&camera, "perspective", &found)) {
            best = number;
            memcpy(g->out->camera, s->matrices[i], sizeof g->out->camera);
            double *yfov = &g->out->yfov_rad;
            KOKSMA__TRY(koksma__json_get_number(&found, "yfov", true, -WIDEST, WIDEST, yfov));
            KOKSMA__JSON_FAIL_IF(!(*yfov >= 0 && *yfov <= M_PI), &found,
                                 "yfov: it is in radians, 0 to 3.1416, not %g", *yfov);
        }
    }
    return KOKSMA_OK;
}

static koksma_status read_nodes(koksma__gltf *g)
{
    const size_t n = g->n[KOKSMA__GLTF_NODES];
    graph s = {.g = g, .matrices = malloc((n + 1) * sizeof *s.matrices), .shown = calloc(n + 1, sizeof *s.shown)};
    field found;
    koksma_status status = s.matrices && s.shown ? KOKSMA_OK : koksma__fail_memory((n + 1) * sizeof *s.matrices);
    status = status ? status : walk_scene(&s);
    if (!status && koksma__gltf_find(&g->root, punctual, &found)) {
        status = koksma__gltf_list(&found, "lights", &s.lights, &s.n_lights);
    }
    for (size_t i = 0; !status && i < n; i++) {
        const field node = koksma__gltf_item(g, KOKSMA__GLTF_NODES, i);
        status = take_light(&s, i, &node);
    }
    status = status ? status : take_camera(&s);
    free(s.matrices);
    free(s.shown);
    return status;
}

/* ---- Meshes -------------------------------------------------------------------------------------------------- */

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

/* The set of texture coordinates, 0 or 1, for meshes of a material: that of the material's first texture. */
static int uv_set(const koksma__gltf *g, size_t material)
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

typedef struct primitive {
    koksma__gltf_elements positions, normals, uvs, colours, indices; /* n is 0 for an attribute that is missing */
    long long mode;
    size_t material; /* the number of materials if the primitive has none */
} primitive;

/* Reads the attribute `key`, if it exists: `width` components for each of n vertices, or, if `wide`, width + 1. */
static koksma_status take_attribute(const koksma__gltf *g, const field *list, const char *key, int width, bool floats,
                                    bool wide, const primitive *p, koksma__gltf_elements *out)
{
    size_t number;
    if (!koksma__json_has(list, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__gltf_elements_at(g, list, key, out, &number));
    const bool normalised = out->normalised && (out->component == 5121 || out->component == 5123);
    KOKSMA__JSON_FAIL_IF((out->width != width && !(wide && out->width == width + 1)) ||
                             (out->component != 5126 && (floats || !normalised)),
                         list, "%s: accessor %zu has %d components of type %d instead of %d of type 5126%s", key,
                         number, out->width, out->component, width,
                         floats ? "" : ", or normalized ones of 5121 or 5123");
    KOKSMA__JSON_FAIL_IF(p && out->n != p->positions.n, list,
                         "%s: accessor %zu has %zu elements, but accessor %zu has %zu positions", key, number, out->n,
                         koksma__gltf_index(list, "POSITION", 0), p->positions.n);
    return KOKSMA_OK;
}

static koksma_status take_indices(koksma__gltf *g, const field *f, const field *attributes, primitive *p)
{
    size_t number;
    koksma__gltf_elements *e = &p->indices;
    if (!koksma__json_has(f, "indices")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__gltf_elements_at(g, f, "indices", e, &number));
    if (e->width != 1 || (e->component != 5121 && e->component != 5123 && e->component != 5125)) {
        const field accessor = koksma__gltf_item(g, KOKSMA__GLTF_ACCESSORS, number);
        const char *type = "";
        KOKSMA__TRY(koksma__json_get_text(&accessor, "type", true, &type));
        return koksma__json_fail(f,
                                 "indices: accessor %zu has %.16s of component type %d; indices are SCALAR of 5121, "
                                 "5123 or 5125",
                                 number, type, e->component);
    }
    /* Computed once for each accessor, because many primitives may share an accessor. All accessors may share the same
       bytes, too; those that don't are no longer together than a buffer may be. */
    size_t *beyond = &g->accessors[number].beyond;
    if (!*beyond) {
        const size_t most = koksma__file_most(KOKSMA__FILE_BUFFER);
        g->index_bytes += e->n * koksma__gltf_component_size(e->component);
        KOKSMA__JSON_FAIL_IF(g->index_bytes > most, f,
                             "indices: accessors of more than %zu MiB of indices up to here; let primitives with the "
                             "same indices share an accessor",
                             most >> 20);
        for (size_t i = 0; i < e->n; i++) {
            const size_t after = koksma__gltf_whole(e, i) + 1;
            *beyond = after > *beyond ? after : *beyond;
        }
    }
    for (size_t i = 0; *beyond > p->positions.n && i < e->n; i++) {
        const size_t vertex = koksma__gltf_whole(e, i);
        KOKSMA__JSON_FAIL_IF(vertex >= p->positions.n, f,
                             "indices: number %zu of accessor %zu is vertex %zu, but accessor %zu has %zu vertices, "
                             "numbered from 0",
                             i, number, vertex, koksma__gltf_index(attributes, "POSITION", 0), p->positions.n);
    }
    return KOKSMA_OK;
}

/* Reads a primitive. A primitive without positions has n = 0 and shows nothing. */
static koksma_status take_primitive(koksma__gltf *g, const field *f, primitive *p)
{
    field list;
    *p = (primitive){.mode = TRIANGLES, .material = koksma__gltf_index(f, "material", g->n[KOKSMA__GLTF_MATERIALS])};
    KOKSMA__TRY(koksma__json_member(f, "attributes", &list));
    if (!koksma__json_has(&list, "POSITION")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_whole(f, "mode", false, 0, FAN, &p->mode));
    const char *const uvs = uv_set(g, p->material) ? "TEXCOORD_1" : "TEXCOORD_0";
    KOKSMA__TRY(take_attribute(g, &list, "POSITION", 3, true, false, NULL, &p->positions));
    KOKSMA__TRY(take_attribute(g, &list, "NORMAL", 3, true, false, p, &p->normals));
    KOKSMA__TRY(take_attribute(g, &list, uvs, 2, false, false, p, &p->uvs));
    KOKSMA__TRY(take_attribute(g, &list, "COLOR_0", 3, false, true, p, &p->colours));
    return take_indices(g, f, &list, p);
}

/* The vertex at corner k of triangle t; every second triangle of a strip has the opposite order (glTF 2.0, section
   3.7.2.1). */
static uint32_t corner(const primitive *p, size_t t, size_t k)
{
    size_t at = p->mode == TRIANGLES ? 3 * t + k : t + k;
    if (p->mode == FAN) {
        at = k ? t + k : 0;
    } else if (p->mode == STRIP && t % 2 && k < 2) {
        at = t + 1 - k;
    }
    return (uint32_t)(p->indices.n ? koksma__gltf_whole(&p->indices, at) : at);
}

static void fill(const primitive *p, koksma__mesh *mesh)
{
    for (size_t i = 0; i < p->positions.n; i++) {
        for (int k = 0; k < 3; k++) {
            mesh->vertices[3 * i + (size_t)k] = koksma__gltf_real(&p->positions, i, k);
            if (mesh->normals) {
                mesh->normals[3 * i + (size_t)k] = koksma__gltf_real(&p->normals, i, k);
            }
        }
        if (mesh->uvs) {
            mesh->uvs[2 * i] = koksma__gltf_real(&p->uvs, i, 0);
            mesh->uvs[2 * i + 1] = 1 - koksma__gltf_real(&p->uvs, i, 1);
        }
    }
    for (size_t i = 0; mesh->colours && i < 3 * p->positions.n; i++) {
        mesh->colours[i] = koksma__gltf_real(&p->colours, i / 3, (int)(i % 3));
    }
    for (size_t i = 0; i < 3 * mesh->n_triangles; i++) {
        mesh->indices[i] = corner(p, i / 3, i % 3);
    }
}

/* Whether the primitive has a vertex colour other than white; white ones change nothing. */
static bool is_coloured(const primitive *p)
{
    for (size_t i = 0; i < p->colours.n; i++) {
        for (int k = 0; k < 3; k++) {
            if (koksma__gltf_real(&p->colours, i, k) != 1) {
                return true;
            }
        }
    }
    return false;
}

static koksma_status keep_primitive(koksma__gltf *g, const primitive *p)
{
    const size_t corners = p->indices.n ? p->indices.n : p->positions.n;
    const size_t n = p->mode == TRIANGLES ? corners / 3 : p->mode >= STRIP && corners > 2 ? corners - 2 : 0;
    koksma__mesh mesh = {0};
    g->out->unread.lines += p->positions.n && p->mode < TRIANGLES;
    if (!n) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__mesh_init(p->positions.n, n, p->normals.n > 0, p->uvs.n > 0, &mesh);
    if (!status && is_coloured(p)) {
        mesh.colours = calloc(3 * p->positions.n + 1, sizeof *mesh.colours);
        status = mesh.colours ? KOKSMA_OK : koksma__fail_memory(3 * p->positions.n * sizeof *mesh.colours);
        g->material_tinted[p->material] = true;
    }
    if (!status) {
        fill(p, &mesh);
        status = koksma__file_take_mesh(g->out, &mesh, p->material);
    } else {
        status = koksma__fail_in(status, g->out->path);
    }
    koksma__mesh_fini(&mesh);
    g->material_used[p->material] = true;
    return status;
}

static koksma_status read_meshes(koksma__gltf *g)
{
    const size_t n_meshes = g->n[KOKSMA__GLTF_MESHES];
    size_t n_primitives = 0;
    /* the file's mesh i became the meshes first[i] .. first[i + 1] - 1 */
    size_t *first = calloc(n_meshes + 1, sizeof *first);
    koksma_status status = first ? KOKSMA_OK : koksma__fail_memory((n_meshes + 1) * sizeof *first);
    for (size_t i = 0; !status && i < n_meshes; i++) {
        const field mesh = koksma__gltf_item(g, KOKSMA__GLTF_MESHES, i);
        field primitives;
        status = koksma__gltf_list(&mesh, "primitives", &primitives, &n_primitives);
        for (size_t k = 0; !status && k < n_primitives; k++) {
            const field item = koksma__json_item(&primitives, k);
            primitive p;
            status = take_primitive(g, &item, &p);
            g->out->unread.morphs += g->mesh_shown[i] && koksma__json_has(&item, "targets");
            status = status || !g->mesh_shown[i] ? status : keep_primitive(g, &p);
        }
        first[i + 1] = g->out->meshes.n;
    }
    for (size_t i = 0; !status && i < g->shown.n; i++) {
        const koksma__file_placement *p = (koksma__file_placement *)g->shown.items + i;
        for (size_t k = first[p->mesh]; !status && k < first[p->mesh + 1]; k++) {
            status = koksma__file_add_placement(g->out, k, p->matrix);
        }
    }
    free(first);
    return status;
}

/* ---- Textures ----------------------------------------------------------------------------------------------- */

/* The image of a texture: the name of a file, or bytes within the model. */
static koksma_status take_image(koksma__gltf *g, size_t number, koksma__file_texture *out)
{
    const field f = koksma__gltf_item(g, KOKSMA__GLTF_IMAGES, number);
    const char *uri = NULL, *type = NULL;
    char name[32];
    long long view = 0;
    koksma__gltf_bytes *bytes = &g->images[number];
    KOKSMA__TRY(koksma__json_get_text(&f, "uri", false, &uri));
    const bool within = !uri || !strncmp(uri, "data:", 5);
    if (uri && within && !bytes->bytes) {
        KOKSMA__TRY(koksma__gltf_decode(g, &f, uri, bytes));
    } else if (!uri) {
        KOKSMA__TRY(koksma__json_get_whole(&f, "bufferView", true, 0, KOKSMA__GLTF_ITEMS, &view));
        KOKSMA__TRY(koksma__json_get_text(&f, "mimeType", true, &type));
        KOKSMA__TRY(koksma__gltf_view_bytes(g, (size_t)view, bytes));
    }
    snprintf(name, sizeof name, "images[%zu]", number);
    out->name = strdup(within ? name : uri);
    out->within = within;
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
    long long wrap[2] = {10497, 10497}, filter = 0;
    if (!koksma__json_has(texture, "sampler")) {
        return KOKSMA_OK;
    }
    const field f = koksma__gltf_item(g, KOKSMA__GLTF_SAMPLERS, koksma__gltf_index(texture, "sampler", 0));
    KOKSMA__TRY(koksma__json_get_whole(&f, "wrapS", false, 0, 65535, &wrap[0]));
    KOKSMA__TRY(koksma__json_get_whole(&f, "wrapT", false, 0, 65535, &wrap[1]));
    KOKSMA__TRY(koksma__json_get_whole(&f, "magFilter", false, 0, 65535, &filter));
    out->wrap[0] = (int)wrap[0];
    out->wrap[1] = (int)wrap[1];
    out->nearest = filter == 9728;
    return KOKSMA_OK;
}

/* Reads the texture `key` of a part of a material, if the texture exists and has an image. */
static koksma_status take_texture(koksma__gltf *g, size_t material, const field *f, const char *key,
                                  koksma__file_texture *out)
{
    long long number = 0, set = 0;
    field info;
    if (!koksma__json_is_object_at(f, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(f, key, &info));
    KOKSMA__TRY(koksma__json_get_whole(&info, "index", true, 0, KOKSMA__GLTF_ITEMS, &number));
    const field texture = koksma__gltf_item(g, KOKSMA__GLTF_TEXTURES, (size_t)number);
    if (!koksma__json_has(&texture, "source")) {
        return KOKSMA_OK; /* its image comes from an unsupported extension, which a warning names */
    }
    KOKSMA__TRY(take_set(&info, &set));
    g->out->unread.second_uvs += set != uv_set(g, material);
    KOKSMA__TRY(take_transform(&info, out));
    KOKSMA__TRY(take_sampler(g, &texture, out));
    return take_image(g, koksma__gltf_index(&texture, "source", 0), out);
}

/* ---- Materials ---------------------------------------------------------------------------------------------- */

/* Names a factor that is beyond glTF's 0 to 1. what: what becomes of it. */
static koksma_status name_factor(koksma__gltf *g, const field *f, const char *key, const double *values, size_t n,
                                 const char *what)
{
    char text[128];
    bool beyond = false;
    for (size_t i = 0; i < n; i++) {
        beyond |= !(values[i] >= 0 && values[i] <= 1);
    }
    snprintf(text, sizeof text, "%s beyond 0 to 1 is %s", key, what);
    return beyond ? koksma__gltf_name(g, f, text) : KOKSMA_OK;
}

/* Reads factors and textures of colour, metal and roughness. */
static koksma_status take_surface(koksma__gltf *g, size_t i, const field *f, koksma__file_material *m)
{
    double colour[4] = {1, 1, 1, 1}, metallic = 1, roughness = 1;
    field found;
    if (koksma__gltf_find(f, "pbrMetallicRoughness", &found)) {
        KOKSMA__TRY(koksma__json_get_numbers(&found, "baseColorFactor", false, -WIDEST, WIDEST, 4, colour));
        KOKSMA__TRY(koksma__json_get_number(&found, "metallicFactor", false, -WIDEST, WIDEST, &metallic));
        KOKSMA__TRY(koksma__json_get_number(&found, "roughnessFactor", false, -WIDEST, WIDEST, &roughness));
        KOKSMA__TRY(name_factor(g, &found, "baseColorFactor", colour, 4, "clamped"));
        KOKSMA__TRY(name_factor(g, &found, "metallicFactor", &metallic, 1, "clamped"));
        KOKSMA__TRY(name_factor(g, &found, "roughnessFactor", &roughness, 1, "clamped"));
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
    KOKSMA__TRY(name_factor(g, f, "emissiveFactor", glow, 3, "not glTF, and is taken as it stands"));
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
static koksma_status read_materials(koksma__gltf *g)
{
    const size_t n = g->n[KOKSMA__GLTF_MATERIALS];
    for (size_t i = 0; i <= n; i++) {
        koksma__file_material *m;
        KOKSMA__TRY(koksma__file_add_material(g->out, 1, &m));
        m->metallic = m->roughness = 1; /* glTF's defaults */
        m->alpha = 1;
        m->ior = 1.5;
        m->principled = true;
        m->tinted = g->material_tinted[i];
        KOKSMA__TRY(i < n && g->material_used[i] ? take_material(g, i, m) : KOKSMA_OK);
    }
    return KOKSMA_OK;
}

koksma_status koksma__gltf_read_scene(koksma__gltf *g)
{
    KOKSMA__TRY(read_nodes(g));
    KOKSMA__TRY(read_meshes(g));
    return read_materials(g);
}
