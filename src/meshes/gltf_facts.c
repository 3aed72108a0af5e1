/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What assimp 5.2 does not tell of a glTF file, or tells otherwise. It has every light and camera once and finds its
 * node by a name, which several nodes may have; so both are read here, node by node.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "meshes/gltf.h"

typedef koksma__json_node field;

enum { MAX_DEPTH = 512 /* of nodes */ };
#define WIDEST 1e30 /* of a node's numbers; where things end up is checked later */

koksma_status koksma__gltf_list(const field *object, const char *key, field *list, size_t *n)
{
    *n = 0;
    if (!koksma__json_has(object, key)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_member(object, key, list);
    return status ? status : koksma__json_length(list, KOKSMA__GLTF_ITEMS, n);
}

/* Follows keys into objects; false: one is not there. */
static bool find(const field *from, const char *const keys[], field *out)
{
    field at = *from;
    for (; *keys; keys++) {
        const field object = at;
        if (!koksma__json_has(&object, *keys) || koksma__json_member(&object, *keys, &at)) {
            return false;
        }
    }
    *out = at;
    return true;
}

static const char *const punctual[] = {"extensions", "KHR_lights_punctual", NULL};

/* ---- Where nodes stand -------------------------------------------------------------------------------------- */

typedef struct graph {
    field nodes, lights, cameras;
    size_t n_nodes, n_lights, n_cameras;
    uint32_t *parents;    /* of nodes; a node that has none is its own */
    unsigned char *roots; /* whether the scene has it */
} graph;

/* gltf_check.c saw that numbers are in range and nodes are trees. */
static koksma_status link_nodes(const field *root, graph *g)
{
    field scenes, list;
    size_t n_scenes, n;
    long long number = 0, scene = 0;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < g->n_nodes; i++) {
        const field node = koksma__json_item(&g->nodes, i);
        status = koksma__gltf_list(&node, "children", &list, &n);
        for (size_t c = 0; !status && c < n; c++) {
            const field child = koksma__json_item(&list, c);
            status = koksma__json_whole(&child, 0, (long long)g->n_nodes - 1, &number);
            g->parents[status ? 0 : number] = (uint32_t)i;
        }
    }
    status = status ? status : koksma__json_get_whole(root, "scene", false, 0, KOKSMA__GLTF_ITEMS, &scene);
    status = status ? status : koksma__gltf_list(root, "scenes", &scenes, &n_scenes);
    if (status || (size_t)scene >= n_scenes) {
        return status;
    }
    const field shown = koksma__json_item(&scenes, (size_t)scene);
    status = koksma__gltf_list(&shown, "nodes", &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const field item = koksma__json_item(&list, i);
        status = koksma__json_whole(&item, 0, (long long)g->n_nodes - 1, &number);
        g->roots[status ? 0 : number] |= !status;
    }
    return status;
}

/* Whether the scene has the node. Errors: MALFORMED (too deep). */
static koksma_status is_shown(const graph *g, size_t node, bool *out)
{
    size_t at = node;
    int depth = 0;
    for (; g->parents[at] != at; at = g->parents[at]) {
        if (++depth == MAX_DEPTH) {
            return koksma__json_fail(&g->nodes, "nodes are nested too deeply");
        }
    }
    *out = g->roots[at];
    return KOKSMA_OK;
}

/* A matrix by columns, or x -> translation + rotation (scale x), the rotation a quaternion (glTF 2.0, 3.5.3). */
static koksma_status own_matrix(const field *node, double out[12])
{
    double m[16], t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (koksma__json_has(node, "matrix")) {
        const koksma_status status = koksma__json_get_numbers(node, "matrix", true, -WIDEST, WIDEST, 16, m);
        for (int i = 0; !status && i < 12; i++) {
            out[i] = m[4 * (i % 4) + i / 4];
        }
        return status;
    }
    koksma_status status = koksma__json_get_numbers(node, "translation", false, -WIDEST, WIDEST, 3, t);
    status = status ? status : koksma__json_get_numbers(node, "rotation", false, -WIDEST, WIDEST, 4, q);
    status = status ? status : koksma__json_get_numbers(node, "scale", false, -WIDEST, WIDEST, 3, s);
    if (status) {
        return status;
    }
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                            2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                            2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 12; i++) {
        out[i] = i % 4 == 3 ? t[i / 4] : turn[3 * (i / 4) + i % 4] * s[i % 4];
    }
    return KOKSMA_OK;
}

static koksma_status world_matrix(const graph *g, size_t node, double out[12])
{
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    memcpy(out, identity, sizeof identity);
    for (size_t at = node, parent = node;; at = parent) {
        double own[12], below[12];
        const field item = koksma__json_item(&g->nodes, at);
        const koksma_status status = own_matrix(&item, own);
        if (status) {
            return status;
        }
        memcpy(below, out, sizeof below);
        koksma__matrix_multiply(own, below, out);
        parent = g->parents[at];
        if (parent == at) {
            return KOKSMA_OK;
        }
    }
}

/* ---- Lights and cameras ------------------------------------------------------------------------------------- */

/* The node's light, if it has one (KHR_lights_punctual). */
static koksma_status take_light(const graph *g, size_t i, const field *node, koksma__gltf *out)
{
    field found;
    long long number = 0;
    const char *type = "";
    double intensity = 1, colour[3] = {1, 1, 1};
    bool shown = false;
    if (!find(node, punctual, &found) || !koksma__json_has(&found, "light")) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__json_get_whole(&found, "light", true, 0, KOKSMA__GLTF_ITEMS, &number);
    if (!status && (size_t)number >= g->n_lights) {
        return koksma__json_fail(&found, "light is %lld of %zu", number, g->n_lights);
    }
    status = status ? status : is_shown(g, i, &shown);
    if (status || !shown || out->n_lights++ >= KOKSMA__GLTF_LIGHTS) {
        return status;
    }
    koksma__gltf_light *light = &out->lights[out->n_lights - 1];
    const field from = koksma__json_item(&g->lights, (size_t)number);
    status = koksma__json_get_text(&from, "type", true, &type);
    status = status ? status : koksma__json_get_number(&from, "intensity", false, 0, WIDEST, &intensity);
    status = status ? status : koksma__json_get_numbers(&from, "color", false, 0, WIDEST, 3, colour);
    light->far_away = !strcmp(type, "directional");
    if (!status && !light->far_away && strcmp(type, "point") != 0 && strcmp(type, "spot") != 0) {
        return koksma__json_fail(&from, "no lights of type '%.32s' are read", type);
    }
    for (int k = 0; k < 3; k++) {
        light->colour[k] = intensity * colour[k];
    }
    return status ? status : world_matrix(g, i, light->matrix);
}

/* The first of the cameras with perspective that stand somewhere, where it first does. */
static koksma_status take_camera(const graph *g, koksma__gltf *out)
{
    static const char *const perspective[] = {"perspective", NULL};
    size_t at = g->n_nodes;
    long long number = 0, best = (long long)g->n_cameras;
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < g->n_nodes; i++) {
        bool shown = false;
        field found;
        const field node = koksma__json_item(&g->nodes, i);
        number = best;
        status = koksma__json_get_whole(&node, "camera", false, 0, KOKSMA__GLTF_ITEMS, &number);
        status = !status && number < best ? is_shown(g, i, &shown) : status;
        if (!status && shown) {
            const field camera = koksma__json_item(&g->cameras, (size_t)number);
            const bool sees = find(&camera, perspective, &found);
            at = sees ? i : at;
            best = sees ? number : best;
            status = sees ? koksma__json_get_number(&found, "yfov", true, 0, M_PI, &out->yfov_rad) : KOKSMA_OK;
        }
    }
    return status || at == g->n_nodes ? status : world_matrix(g, at, out->camera);
}

static koksma_status read_nodes(const field *root, koksma__gltf *out)
{
    graph g = {0};
    field found;
    koksma_status status = koksma__gltf_list(root, "nodes", &g.nodes, &g.n_nodes);
    status = status ? status : koksma__gltf_list(root, "cameras", &g.cameras, &g.n_cameras);
    if (!status && find(root, punctual, &found)) {
        status = koksma__gltf_list(&found, "lights", &g.lights, &g.n_lights);
    }
    if (status || !g.n_nodes) {
        return status;
    }
    g.parents = malloc((g.n_nodes + 1) * sizeof *g.parents);
    g.roots = calloc(g.n_nodes + 1, 1);
    status = g.parents && g.roots ? KOKSMA_OK : koksma__fail_memory((g.n_nodes + 1) * sizeof *g.parents);
    for (size_t i = 0; !status && i < g.n_nodes; i++) {
        g.parents[i] = (uint32_t)i;
    }
    status = status ? status : link_nodes(root, &g);
    for (size_t i = 0; !status && i < g.n_nodes; i++) {
        const field node = koksma__json_item(&g.nodes, i);
        status = take_light(&g, i, &node, out);
    }
    status = status ? status : take_camera(&g, out);
    free(g.parents);
    free(g.roots);
    return status;
}

/* ---- The rest ----------------------------------------------------------------------------------------------- */

/* A reader that lacks one of these must not show the file (glTF 2.0, section 3.12). */
static koksma_status check_extension(const field *item)
{
    static const char *const known[] = {"KHR_draco_mesh_compression", "KHR_lights_punctual",
                                        "KHR_materials_emissive_strength"};
    const char *name;
    const koksma_status status = koksma__json_text(item, &name);
    for (size_t i = 0; !status && i < sizeof known / sizeof *known; i++) {
        if (!strcmp(name, known[i])) {
            return KOKSMA_OK;
        }
    }
    return status ? status : koksma__json_fail(item, "the file requires extension '%s', which is not read", name);
}

static koksma_status read_material(const field *material, size_t i, koksma__gltf *out)
{
    static const char *const strength[] = {"extensions", "KHR_materials_emissive_strength", NULL};
    static const char *const texture[] = {"pbrMetallicRoughness", "baseColorTexture", NULL};
    static const char *const transform[] = {"extensions", "KHR_texture_transform", NULL};
    field found, moved;
    long long set = 0;
    koksma_status status = KOKSMA_OK;
    if (i < KOKSMA__GLTF_MATERIALS && find(material, strength, &found)) {
        status = koksma__json_get_number(&found, "emissiveStrength", false, 0, 1e6, &out->strengths[i]);
    }
    if (!status && find(material, texture, &found)) {
        status = koksma__json_get_whole(&found, "texCoord", false, 0, KOKSMA__GLTF_ITEMS, &set);
        out->unread.second_uvs += set > 0;
        out->unread.transforms += find(&found, transform, &moved);
    }
    return status;
}

koksma_status koksma__gltf_facts(const field *root, koksma__gltf *out)
{
    field list;
    size_t n;
    koksma_status status = koksma__gltf_list(root, "animations", &list, &out->unread.animations);
    status = status ? status : koksma__gltf_list(root, "skins", &list, &out->unread.skins);
    status = status ? status : koksma__gltf_list(root, "extensionsRequired", &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const field item = koksma__json_item(&list, i);
        status = check_extension(&item);
    }
    status = status ? status : koksma__gltf_list(root, "materials", &list, &n);
    for (size_t i = 0; !status && i < n; i++) {
        const field material = koksma__json_item(&list, i);
        status = read_material(&material, i, out);
    }
    return status ? status : read_nodes(root, out);
}

void koksma__gltf_init(koksma__gltf *gltf)
{
    memset(gltf, 0, sizeof *gltf);
    for (int i = 0; i < KOKSMA__GLTF_MATERIALS; i++) {
        gltf->strengths[i] = 1;
    }
}
