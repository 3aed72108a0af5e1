/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the meshes of a glTF file: each primitive of triangles, strips or fans becomes a mesh. POSITION, NORMAL,
 * COLOR_0, one set of texture coordinates and the indices are read; the origin of texture coordinates is the upper
 * left in glTF and the lower left here, so v becomes 1 - v. All meshes are checked: attributes have as many elements
 * as there are positions, and every index names a position (glTF 2.0, section 3.7.2). Only meshes that a node of the
 * scene shows are kept.
 */
#include "meshes/gltf.h"

#include <stdlib.h>

#include "core/files.h"
#include "core/status.h"

typedef koksma__json_node field;

enum { TRIANGLES = 4, STRIP = 5, FAN = 6 };

typedef struct primitive {
    koksma__gltf_elements positions, normals, uvs, colours, indices; /* n is 0 for an attribute that is missing */
    /* material: index of the material, or the number of materials if the primitive has none */
    long long mode, material;
} primitive;

/* Reads the attribute `key`, if it exists: `width` components for each of n vertices, or, if `wide`, width + 1. */
static koksma_status take_attribute(const koksma__gltf *g, const field *list, const char *key, int width, bool floats,
                                    bool wide, const primitive *p, koksma__gltf_elements *out)
{
    long long number = 0, positions = 0;
    if (!koksma__json_has(list, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__gltf_elements_at(g, list, key, out, &number));
    const bool normalised = out->normalised && (out->component == 5121 || out->component == 5123);
    KOKSMA__JSON_FAIL_IF((out->width != width && !(wide && out->width == width + 1)) ||
                             (out->component != 5126 && (floats || !normalised)),
                         list, "%s: accessor %lld has %d components of type %d instead of %d of type 5126%s", key,
                         number, out->width, out->component, width,
                         floats ? "" : ", or normalized ones of 5121 or 5123");
    if (p && out->n != p->positions.n) {
        KOKSMA__TRY(koksma__json_get_whole(list, "POSITION", true, 0, KOKSMA__GLTF_ITEMS, &positions));
        return koksma__json_fail(list, "%s: accessor %lld has %zu elements, but accessor %lld has %zu positions", key,
                                 number, out->n, positions, p->positions.n);
    }
    return KOKSMA_OK;
}

static koksma_status take_indices(koksma__gltf *g, const field *f, const field *attributes, primitive *p)
{
    long long number = 0, positions = 0;
    koksma__gltf_elements *e = &p->indices;
    if (!koksma__json_has(f, "indices")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__gltf_elements_at(g, f, "indices", e, &number));
    if (e->width != 1 || (e->component != 5121 && e->component != 5123 && e->component != 5125)) {
        const field accessor = koksma__gltf_item(g, KOKSMA__GLTF_ACCESSORS, (size_t)number);
        const char *type = "";
        KOKSMA__TRY(koksma__json_get_text(&accessor, "type", true, &type));
        return koksma__json_fail(f,
                                 "indices: accessor %lld has %.16s of component type %d; indices are SCALAR of 5121, "
                                 "5123 or 5125",
                                 number, type, e->component);
    }
    /* Computed once for each accessor, because many primitives may share an accessor. All accessors may share the same
       bytes, too; those that don't are no longer together than a buffer may be. */
    if (!g->beyond[number]) {
        const size_t most = koksma__file_most(KOKSMA__FILE_BUFFER);
        g->index_bytes += e->n * koksma__gltf_component_size(e->component);
        KOKSMA__JSON_FAIL_IF(g->index_bytes > most, f,
                             "indices: accessors of more than %zu MiB of indices up to here; let primitives with the "
                             "same indices share an accessor",
                             most >> 20);
        for (size_t i = 0; i < e->n; i++) {
            const size_t after = koksma__gltf_whole(e, i) + 1;
            g->beyond[number] = after > g->beyond[number] ? after : g->beyond[number];
        }
    }
    for (size_t i = 0; g->beyond[number] > p->positions.n && i < e->n; i++) {
        const size_t vertex = koksma__gltf_whole(e, i);
        if (vertex >= p->positions.n) {
            KOKSMA__TRY(koksma__json_get_whole(attributes, "POSITION", true, 0, KOKSMA__GLTF_ITEMS, &positions));
            return koksma__json_fail(f,
                                     "indices: number %zu of accessor %lld is vertex %zu, but accessor %lld has %zu "
                                     "vertices, numbered from 0",
                                     i, number, vertex, positions, p->positions.n);
        }
    }
    return KOKSMA_OK;
}

/* Reads a primitive. A primitive without positions has n = 0 and shows nothing. */
static koksma_status take_primitive(koksma__gltf *g, const field *f, primitive *p)
{
    field list;
    *p = (primitive){.mode = TRIANGLES, .material = (long long)g->n[KOKSMA__GLTF_MATERIALS]};
    KOKSMA__TRY(koksma__json_member(f, "attributes", &list));
    if (!koksma__json_has(&list, "POSITION")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_get_whole(f, "mode", false, 0, FAN, &p->mode));
    KOKSMA__TRY(koksma__json_get_whole(f, "material", false, 0, p->material, &p->material));
    const char *const uvs = koksma__gltf_uv_set(g, (size_t)p->material) ? "TEXCOORD_1" : "TEXCOORD_0";
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
        status = koksma__file_take_mesh(g->out, &mesh, (size_t)p->material);
    } else {
        status = koksma__fail_in(status, g->out->path);
    }
    koksma__mesh_fini(&mesh);
    g->material_used[p->material] = true;
    return status;
}

koksma_status koksma__gltf_read_meshes(koksma__gltf *g)
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
