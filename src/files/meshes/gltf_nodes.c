/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the nodes of a glTF file's scene: where they place meshes, lights (KHR_lights_punctual) and the camera. A
 * node's matrix is the product of the matrices from its root down to the node, in double precision. gltf_schema.c has
 * checked that nodes form trees.
 */
#include "meshes/gltf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

typedef koksma__json_node field;

enum { MAX_DEPTH = 512 /* of nodes */ };
#define WIDEST 1e30 /* largest magnitude of a node's numbers; the resulting positions are checked later */

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
    KOKSMA__TRY(koksma__json_get_numbers(node, "translation", false, -WIDEST, WIDEST, 3, t));
    KOKSMA__TRY(koksma__json_get_numbers(node, "rotation", false, -WIDEST, WIDEST, 4, q));
    KOKSMA__TRY(koksma__json_get_numbers(node, "scale", false, -WIDEST, WIDEST, 3, s));
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double turn[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - z * w),     2 * (x * z + y * w),
                            2 * (x * y + z * w),     1 - 2 * (x * x + z * z), 2 * (y * z - x * w),
                            2 * (x * z - y * w),     2 * (y * z + x * w),     1 - 2 * (x * x + y * y)};
    for (int i = 0; i < 12; i++) {
        out[i] = i % 4 == 3 ? t[i / 4] : turn[3 * (i / 4) + i % 4] * s[i % 4];
    }
    return KOKSMA_OK;
}

/* Visits a node, then its descendants: sets their matrices and adds the placements of their meshes. */
static koksma_status walk(graph *s, size_t i, const double parent[12], int depth)
{
    koksma__gltf *g = s->g;
    const field node = koksma__gltf_item(g, KOKSMA__GLTF_NODES, i);
    field list;
    size_t n = 0;
    long long number = 0;
    double own[12];
    KOKSMA__JSON_FAIL_IF(depth == MAX_DEPTH, &node, "nodes are nested too deeply");
    KOKSMA__JSON_FAIL_IF(s->shown[i], &node, "the scene names this node twice");
    s->shown[i] = true;
    KOKSMA__TRY(own_matrix(&node, own));
    koksma__matrix_multiply(parent, own, s->matrices[i]);
    if (koksma__json_has(&node, "mesh")) {
        koksma__file_placement *to = koksma__list_add(&g->shown, 1, sizeof *to);
        KOKSMA__TRY(to ? koksma__json_get_whole(&node, "mesh", true, 0, KOKSMA__GLTF_ITEMS, &number) : KOKSMA_MEMORY);
        to->mesh = (size_t)number;
        g->mesh_shown[number] = true;
        memcpy(to->matrix, s->matrices[i], sizeof to->matrix);
    }
    KOKSMA__TRY(koksma__gltf_list(&node, "children", &list, &n));
    for (size_t c = 0; c < n; c++) {
        const field child = koksma__json_item(&list, c);
        KOKSMA__TRY(koksma__json_whole(&child, 0, KOKSMA__GLTF_ITEMS, &number));
        KOKSMA__TRY(walk(s, (size_t)number, s->matrices[i], depth + 1));
    }
    return KOKSMA_OK;
}

/* Visits the scene that the file names as its default, or else its first scene. */
static koksma_status walk_scene(graph *s)
{
    static const double identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    koksma__gltf *g = s->g;
    field list;
    long long scene = 0, number = 0;
    size_t n = 0;
    KOKSMA__TRY(koksma__json_get_whole(&g->root, "scene", false, 0, KOKSMA__GLTF_ITEMS, &scene));
    KOKSMA__JSON_FAIL_IF(!g->n[KOKSMA__GLTF_SCENES], &g->root, "the file has no scenes: nothing is shown");
    const field shown = koksma__gltf_item(g, KOKSMA__GLTF_SCENES, (size_t)scene);
    KOKSMA__TRY(koksma__gltf_list(&shown, "nodes", &list, &n));
    for (size_t i = 0; i < n; i++) {
        const field item = koksma__json_item(&list, i);
        KOKSMA__TRY(koksma__json_whole(&item, 0, KOKSMA__GLTF_ITEMS, &number));
        KOKSMA__TRY(walk(s, (size_t)number, identity, 0));
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
    koksma_status status = koksma__json_get_whole(&found, "light", true, 0, KOKSMA__GLTF_ITEMS, &number);
    KOKSMA__JSON_FAIL_IF(!status && (size_t)number >= s->n_lights, &found, "light %lld of %zu lights does not exist",
                         number, s->n_lights);
    if (status || !s->shown[i]) {
        return status;
    }
    koksma__file_light *light = koksma__list_add(&s->g->out->lights, 1, sizeof *light);
    KOKSMA__TRY(light ? KOKSMA_OK : KOKSMA_MEMORY);
    const field from = koksma__json_item(&s->lights, (size_t)number);
    status = koksma__json_get_text(&from, "type", true, &type);
    status = status ? status : koksma__json_get_number(&from, "intensity", false, 0, WIDEST, &intensity);
    status = status ? status : koksma__json_get_numbers(&from, "color", false, 0, WIDEST, 3, colour);
    light->far_away = !strcmp(type, "directional");
    KOKSMA__JSON_FAIL_IF(!status && !light->far_away && strcmp(type, "point") != 0 && strcmp(type, "spot") != 0,
                         &from, "lights of type '%.32s' can't be read", type);
    light->is_spot = !strcmp(type, "spot");
    status = status || !light->is_spot ? status : take_cone(&from, light);
    for (int k = 0; k < 3; k++) {
        light->colour[k] = intensity * colour[k];
    }
    memcpy(light->matrix, s->matrices[i], sizeof light->matrix);
    return status;
}

/* Takes the perspective camera of the first node that has one. */
static koksma_status take_camera(const graph *s)
{
    koksma__gltf *g = s->g;
    long long best = (long long)g->n[KOKSMA__GLTF_CAMERAS];
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < g->n[KOKSMA__GLTF_NODES]; i++) {
        long long number = best;
        field found;
        const field node = koksma__gltf_item(g, KOKSMA__GLTF_NODES, i);
        status = koksma__json_get_whole(&node, "camera", false, 0, KOKSMA__GLTF_ITEMS, &number);
        if (!status && number < best && s->shown[i]) {
            const field camera = koksma__gltf_item(g, KOKSMA__GLTF_CAMERAS, (size_t)number);
            if (koksma__gltf_find(&camera, "perspective", &found)) {
                best = number;
                memcpy(g->out->camera, s->matrices[i], sizeof g->out->camera);
                status = koksma__json_get_number(&found, "yfov", true, 0, M_PI, &g->out->yfov_rad);
            }
        }
    }
    return status;
}

koksma_status koksma__gltf_read_nodes(koksma__gltf *g)
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
