/* SPDX-License-Identifier: Apache-2.0 */
#include "scene/model_build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "image/formats.h"
#include "scene/mesh_file.h"
#include "scene/model.h"
#include "scene/parse.h"
#include "scene/vector.h"

koksma_status koksma__build_init(koksma__build *build, size_t n_materials, size_t n_meshes)
{
    if (n_materials > KOKSMA__MAX_MATERIALS - 1) {
        return koksma__fail(KOKSMA_MALFORMED, "more than %d materials", KOKSMA__MAX_MATERIALS - 1);
    }
    build->meshes = malloc((n_meshes + 1) * sizeof *build->meshes);
    build->glows = calloc(n_materials + 1, sizeof *build->glows);
    if (!build->meshes || !build->glows) {
        return koksma__fail_memory((n_meshes + 1) * sizeof *build->meshes);
    }
    for (size_t i = 0; i < n_meshes; i++) {
        build->meshes[i] = -1;
    }
    return KOKSMA_OK;
}

void koksma__build_fini(koksma__build *build)
{
    free(build->meshes);
    free(build->glows);
}

/* ---- Materials --------------------------------------------------------------------------------------------- */

static double clamp01(float x)
{
    return x > 0 ? fmin((double)x, 1) : 0;
}

/* An image of the file's own (glb), or a file beside it. Errors: MALFORMED (it isn't there, or we can't make it out),
   MISSING (it is there and can't be read), MEMORY. */
static koksma_status read_texture(const koksma__build *build, const koksma__file_material *from, koksma_image *image)
{
    char full[KOKSMA__MAX_PATH];
    if (from->bytes) {
        const koksma_status status = koksma__image_read_bytes(from->bytes, from->size, image);
        return status ? koksma__fail_in(status, from->texture) : KOKSMA_OK;
    }
    if (from->within) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: bare texels", from->texture);
    }
    if (!koksma__path_beside(build->path, from->texture, full) || !koksma__is_plain_file(full)) {
        return koksma__fail(KOKSMA_MALFORMED, "%s: there is no such file", from->texture);
    }
    return koksma_image_read(full, image);
}

/* What isn't there or can't be made out is left out with a warning, and the colour is taken; what fails otherwise
   is build->status. */
static void take_texture(koksma__build *build, const koksma__file_material *from, koksma__material *m)
{
    if (m->kind != KOKSMA__MATERIAL_LAMBERT) {
        snprintf(m->lost, sizeof m->lost, "%s: metals have one colour here", from->texture);
        return;
    }
    m->image = calloc(1, sizeof *m->image);
    const koksma_status status =
        m->image ? read_texture(build, from, m->image) : koksma__fail_memory(sizeof *m->image);
    if (!status) {
        koksma__material_mean(m);
        return;
    }
    koksma_image_fini(m->image);
    free(m->image);
    m->image = NULL;
    if (status == KOKSMA_MEMORY || status == KOKSMA_MISSING) {
        build->status = status;
    } else {
        snprintf(m->lost, sizeof m->lost, "%s", koksma_error_text());
    }
}

void koksma__build_material(koksma__build *build, const koksma__file_material *from)
{
    const size_t i = build->scene->n_materials++;
    koksma__material *m = &build->scene->materials[i];
    const double strength = i < KOKSMA__GLTF_MATERIALS ? build->gltf.strengths[i] : 1;
    snprintf(m->name, sizeof m->name, "%zu", i);
    m->kind = from->metallic > 0.5f ? KOKSMA__MATERIAL_GGX : KOKSMA__MATERIAL_LAMBERT;
    m->roughness = fmin(fmax((double)from->roughness, 0.03), 1);
    double *to = m->kind == KOKSMA__MATERIAL_GGX ? m->reflectance : m->albedo[0];
    for (int k = 0; k < 3; k++) {
        const double glow = (double)from->glow[k] * strength;
        to[k] = clamp01(from->colour[k]);
        build->glows[i][k] = glow > 0 ? fmin(glow, BRIGHT) : 0;
    }
    memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
    if (from->texture && !build->status) {
        take_texture(build, from, m);
    }
}

void koksma__build_grey(koksma__build *build)
{
    build->scene->n_materials = 1;
    for (int i = 0; i < 6; i++) {
        build->scene->materials[0].albedo[i / 3][i % 3] = 0.8;
    }
}

/* ---- Placements, camera, lights -------------------------------------------------------------------------- */

/* The scene's mesh for one of the file's, made where it is first placed. */
static koksma_status find_mesh(koksma__build *build, const koksma__file_mesh *mesh, int *out)
{
    int *known = &build->meshes[mesh->number];
    koksma_status status = KOKSMA_OK;
    if (*known < 0) {
        koksma__mesh *to = NULL;
        status = koksma__scene_add_mesh(build->scene, &to);
        status = status ? status : koksma__file_mesh_take(mesh, to);
        *known = (int)build->scene->n_meshes - 1;
    }
    *out = *known;
    return status;
}

static koksma_status place(koksma__build *build, int mesh, unsigned material, const double matrix[12])
{
    koksma_scene *scene = build->scene;
    koksma__placement *p = NULL;
    koksma_status status = koksma__scene_add_placement(scene, &p);
    if (status) {
        return status;
    }
    material = material < scene->n_materials ? material : 0;
    p->mesh = mesh;
    p->material = (int)material;
    p->smooth = scene->meshes[mesh].normals != NULL;
    memcpy(p->matrix, matrix, sizeof p->matrix);
    koksma__placement_box(&scene->meshes[mesh], p);
    for (int k = 0; k < 3; k++) {
        if (!(p->low[k] >= -FAR && p->high[k] <= FAR)) {
            return koksma__fail(KOKSMA_MALFORMED, "a node places a mesh beyond 1e6");
        }
    }
    const double *glow = build->glows[material];
    if (glow[0] > 0 || glow[1] > 0 || glow[2] > 0) {
        p->smooth = false;
        status = koksma__scene_add_glow(scene, p, glow);
    }
    if (!status && scene->materials[material].image && !scene->meshes[mesh].uvs) {
        status = koksma__fail(KOKSMA_MALFORMED, "a mesh with a texture has no texture coordinates");
    }
    return status;
}

void koksma__build_placement(void *context, const koksma__file_mesh *mesh, const double matrix[12])
{
    koksma__build *build = context;
    int ours;
    if (!build->status && koksma__file_triangles(mesh)) {
        build->status = find_mesh(build, mesh, &ours);
        build->status = build->status ? build->status : place(build, ours, mesh->material, matrix);
    }
}

static void transform(const double m[12], const double v[3], double w, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = m[4 * k] * v[0] + m[4 * k + 1] * v[1] + m[4 * k + 2] * v[2] + w * m[4 * k + 3];
    }
}

static bool within(const double v[3], double bound)
{
    return fabs(v[0]) <= bound && fabs(v[1]) <= bound && fabs(v[2]) <= bound;
}

/* Only glTF has cameras: at the origin of their node, looking down its -z. What assimp says besides differs by
   version: 5.2 adds the node's translation once more, and has other angles. */
bool koksma__build_camera(koksma__build *build, const double matrix[12])
{
    static const double origin[3] = {0, 0, 0}, ahead[3] = {0, 0, -1}, over[3] = {0, 1, 0};
    const double fov = build->gltf.yfov_rad;
    double eye[3], forward[3], up[3];
    transform(matrix, origin, 1, eye);
    transform(matrix, ahead, 0, forward);
    transform(matrix, over, 0, up);
    return within(eye, FAR) && within(forward, FAR) && within(up, FAR) && fov > 2e-4 && fov < 3.1 &&
           koksma__camera_aim(eye, forward, up, fov, &build->scene->camera);
}

koksma_status koksma__build_light(koksma__build *build, const koksma__file_light *from)
{
    koksma__light *to = NULL;
    const koksma_status status = koksma__scene_add_light(build->scene, &to);
    if (status) {
        return status;
    }
    const double position[3] = {(double)from->position[0], (double)from->position[1], (double)from->position[2]};
    const double direction[3] = {(double)from->direction[0], (double)from->direction[1], (double)from->direction[2]};
    to->kind = from->far_away ? KOKSMA__LIGHT_DIRECTIONAL : KOKSMA__LIGHT_POINT;
    transform(from->matrix, position, 1, to->centre);
    transform(from->matrix, direction, 0, to->normal);
    for (int k = 0; k < 3; k++) {
        to->radiance[k] = from->colour[k] > 0 ? fmin((double)from->colour[k], BRIGHT) : 0;
    }
    if (!within(to->centre, FAR) || (from->far_away && !koksma__normalise(to->normal))) {
        return koksma__fail(KOKSMA_MALFORMED, "light '%s' is beyond 1e6 or leads nowhere", from->name);
    }
    return KOKSMA_OK;
}
