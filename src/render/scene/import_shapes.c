/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Adds the shapes of other renderers' scenes. Spheres and disks that are still round under their matrix, and squares
 * that are still rectangular, become Koksma's own shapes and lights. All others become meshes: read from a file once,
 * passed by the reader, or made from a basic shape (a sphere of 64 x 32 rectangles, a disk or cylinder with 64
 * sides). A mesh is stored once and placed by a matrix as often as the scene contains it. A placement whose matrix
 * mirrors, or whose front and back sides are swapped, uses a copy of the mesh that is turned inside out, as glTF 2.0,
 * section 3.7.4, explains. One whose material has textures, where the mesh has no texture coordinates, uses a copy
 * with default ones. Each copy is made once. A light whose surface reflects also becomes a mesh, because Koksma's own
 * lights do not reflect. But a sphere or disk that emits and reflects remains a light of Koksma's own, with a warning
 * that it does not reflect, because a mesh with flat sides would emit less light than the round shape.
 * Long because all ways of placing a shape share the matrices and the motion of one type.
 */
#include "scene/import.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/vector.h"
#include "meshes/mesh_file.h"
#include "render/description_build.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/shapes/shapes.h"

enum { SIDES = 64, RINGS = 32 };

void koksma__import_fini(koksma__import *im)
{
    for (size_t i = 0; i < im->n_packed; i++) {
        koksma__mesh_file_fini(&im->packed[i]);
    }
    while (im->n_texts) {
        koksma__import_text_close(im);
    }
    for (size_t i = 0; i < im->n_names; i++) {
        free(im->names[i]);
    }
    koksma__mesh_fini(&im->mesh);
    KOKSMA__FREE(im->twins, im->packed, im->texts, im->names);
    koksma__names_fini(&im->packed_names);
    koksma__names_fini(&im->files);
}

/* ---- Meshes ------------------------------------------------------------------------------------------------ */

struct koksma__mesh_twins {
    int inside_out, with_uv; /* the mesh turned inside out; with default texture coordinates; below 0: none yet */
    bool of_file;            /* the mesh is from a file; otherwise the scene's text has it */
};

/* in_file: the mesh is from a file; otherwise the scene's text has it. */
static int add_mesh(koksma__text_place place, bool in_file)
{
    koksma__import *im = place.im;
    koksma__mesh *to = NULL;
    if (koksma__mesh_check(&im->mesh)) {
        koksma__mesh_fini(&im->mesh);
        koksma__import_unknown(place, "a mesh is left out: %s", koksma_error_text());
        return -1;
    }
    struct koksma__mesh_twins *twin = koksma__import_add(place, &im->twins, &im->n_twins, sizeof *twin);
    *twin = (struct koksma__mesh_twins){-1, -1, in_file};
    koksma__import_check(place, koksma__scene_add_mesh(im->scene, &to));
    *to = im->mesh;
    im->mesh = (koksma__mesh){0};
    koksma__scene_hash_mesh(im->scene, in_file);
    return (int)im->scene->n_meshes - 1;
}

int koksma__import_mesh(koksma__text_place place)
{
    const koksma__mesh *mesh = &place.im->mesh;
    const size_t numbers = 3 + (mesh->normals ? 3 : 0) + (mesh->uvs ? 2 : 0);
    koksma__import_hold(place,
                        2 * sizeof *mesh + sizeof(float) * (numbers * mesh->n_vertices + 3 * mesh->n_triangles));
    return add_mesh(place, false);
}

/* Copies mesh number `part` of a .serialized file, of which `key` is that of koksma__file_key. Files are kept, because a
   scene names one for each of its meshes; those that are together larger than a model may be are read again. */
static void read_part(koksma__text_place place, const char *path, const char *key, long part)
{
    koksma__import *im = place.im;
    size_t at;
    if (!koksma__names_find(&im->packed_names, key, strlen(key), &at)) {
        at = im->n_packed;
        koksma__import_add(place, &im->packed, &im->n_packed, sizeof *im->packed);
        koksma__import_put_name(place, &im->packed_names, key, at);
    }
    koksma__mesh_file *f = &im->packed[at];
    if (!f->meshes.n) {
        koksma__import_check(place, koksma__file_count(&im->scene->mesh_files, path));
        koksma__import_check(place, koksma__mesh_file_read(path, KOKSMA__BY_FILE, f));
        const size_t size = f->n_vertices + f->n_triangles;
        koksma__import_spend(place, size / 4);
        im->kept += size;
        for (size_t i = 0; im->kept > KOKSMA__MAX_VERTICES && i < im->n_packed; i++) {
            if (i != at) {
                im->kept -= im->packed[i].n_vertices + im->packed[i].n_triangles;
                koksma__mesh_file_fini(&im->packed[i]);
            }
        }
    }
    koksma__import_fail_if(part < 0 || (size_t)part >= f->meshes.n, place,
                           "%s: there is no mesh %ld; the file has %zu, counted from 0", path, part, f->meshes.n);
    koksma__import_check(place, koksma__mesh_copy(&koksma__file_mesh_at(f, (size_t)part)->mesh, &im->mesh));
    const koksma_status status = koksma__mesh_check(&im->mesh);
    koksma__import_check(place, status ? koksma__fail_in(status, path) : KOKSMA_OK);
}

/* Reads a mesh and adapts it to the conventions of the other renderer. */
static void read_mesh(koksma__text_place place, const char *path, const char *key, long part,
                      koksma__mesh_rules rules)
{
    koksma__mesh *mesh = &place.im->mesh;
    koksma_scene *scene = place.im->scene;
    if (part < 0) {
        koksma__import_check(place, koksma__mesh_read(path, KOKSMA__BY_FILE, &scene->mesh_files, mesh));
    } else {
        read_part(place, path, key, part);
    }
    koksma__import_check(place, koksma__scene_limit_mesh(scene, mesh, path));
    for (size_t i = 0; rules.flips_v && mesh->uvs && i < mesh->n_vertices; i++) {
        mesh->uvs[2 * i + 1] = 1 - mesh->uvs[2 * i + 1];
    }
    if (rules.facets) {
        free(mesh->normals);
        mesh->normals = NULL;
    } else if (rules.smooths && !mesh->normals) {
        koksma__import_check(place, koksma__mesh_smooth_by_angles(mesh));
    }
    free(mesh->corners);
    mesh->corners = NULL;
}

int koksma__import_mesh_file(koksma__text_place place, const char *name, long part, koksma__mesh_rules rules)
{
    char full[KOKSMA__MAX_PATH], file[KOKSMA__FILE_KEY], which[128];
    size_t known = 0;
    koksma__import_path(place, name, full);
    if (!koksma__is_mesh_file(full)) {
        koksma__import_unknown(place, "the mesh %s has an unsupported format: it is left out", name);
        return -1;
    }
    /* a file may be named in many ways, of which the ending tells how it is read; if it has no key, reading says why */
    koksma__file_key(full, file);
    const char *ending = strrchr(full, '.');
    part = strcmp(ending, ".serialized") != 0 ? -1 : part; /* others have no numbered meshes */
    snprintf(which, sizeof which, "%s %ld %d%d%d%.16s", file, part, rules.facets, rules.smooths, rules.flips_v,
             ending);
    if (*file && koksma__names_find(&place.im->files, which, strlen(which), &known)) {
        return (int)known - 1;
    }
    read_mesh(place, full, file, part, rules);
    const int mesh = add_mesh(place, true);
    koksma__import_put_name(place, &place.im->files, which, (size_t)(mesh + 1));
    return mesh;
}

void koksma__import_default_uv(koksma__text_place place, bool quads)
{
    static const float corners[2][3][2] = {{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    koksma__mesh *mesh = &place.im->mesh, out = {0};
    const size_t n = 3 * mesh->n_triangles;
    const koksma_status status = koksma__mesh_init(n, mesh->n_triangles, mesh->normals != NULL, true, &out);
    if (status) {
        koksma__mesh_fini(&out);
    }
    koksma__import_pass(place, status);
    for (size_t i = 0; i < n; i++) {
        const size_t from = mesh->indices[i];
        memcpy(out.vertices + 3 * i, mesh->vertices + 3 * from, 3 * sizeof *out.vertices);
        if (mesh->normals) {
            memcpy(out.normals + 3 * i, mesh->normals + 3 * from, 3 * sizeof *out.normals);
        }
        memcpy(out.uvs + 2 * i, corners[quads && i / 3 % 2][i % 3], 2 * sizeof *out.uvs);
        out.uvs[2 * i] = place.im->rows_down && i % 3 == 2 ? 0 : out.uvs[2 * i];
        out.indices[i] = (uint32_t)i;
    }
    koksma__mesh_fini(mesh);
    *mesh = out;
}

/* Finds a form of a mesh that is in the scene, or adds it: turned inside out, or with default texture coordinates. */
static int find_twin(koksma__text_place place, int mesh, bool inside_out)
{
    koksma__import *im = place.im;
    const struct koksma__mesh_twins known = im->twins[mesh];
    if ((inside_out ? known.inside_out : known.with_uv) >= 0) {
        return inside_out ? known.inside_out : known.with_uv;
    }
    koksma__import_pass(place, koksma__mesh_copy(&im->scene->meshes[mesh], &im->mesh));
    if (inside_out) {
        koksma__mesh_flip(&im->mesh);
    } else {
        koksma__import_default_uv(place, false);
    }
    /* a file may be larger than what counts as held */
    const int twin = known.of_file ? add_mesh(place, false) : koksma__import_mesh(place);
    if (inside_out) {
        im->twins[mesh].inside_out = twin;
        im->twins[twin].inside_out = mesh;
    } else {
        im->twins[mesh].with_uv = twin;
    }
    return twin;
}

/* ---- Meshes of basic shapes -------------------------------------------------------------------------------- */

/* The point and the normal of a basic shape at (u, v) in [0, 1]^2. */
static void form_point(koksma__form form, double u, double v, double p[3], double n[3])
{
    const double phi = TURN * u, theta = M_PI * (1 - v);
    if (form == KOKSMA__FORM_SPHERE) {
        n[0] = koksma__sin(theta) * koksma__cos(phi), n[1] = koksma__sin(theta) * koksma__sin(phi),
        n[2] = koksma__cos(theta);
        memcpy(p, n, 3 * sizeof *p);
    } else if (form == KOKSMA__FORM_CYLINDER) {
        n[0] = koksma__cos(phi), n[1] = koksma__sin(phi), n[2] = 0;
        p[0] = n[0], p[1] = n[1], p[2] = v;
    } else if (form == KOKSMA__FORM_DISK) {
        n[0] = n[1] = 0, n[2] = 1;
        p[0] = (1 - v) * koksma__cos(phi), p[1] = (1 - v) * koksma__sin(phi), p[2] = 0;
    } else {
        n[0] = n[1] = 0, n[2] = 1;
        p[0] = 2 * u - 1, p[1] = 2 * v - 1, p[2] = 0;
    }
}

/* Turns a point and normal of the square into those of a side of the cube: rotates the coordinates cyclically,
   and reverses one for the sides with negative normals. */
static void to_side(int side, double p[3], double n[3])
{
    const double sign = side % 2 ? 1 : -1, a = sign * p[0], b = p[1];
    const int k = side / 2;
    p[k] = sign, p[(k + 1) % 3] = a, p[(k + 2) % 3] = b;
    n[k] = sign, n[(k + 1) % 3] = n[(k + 2) % 3] = 0;
}

static void make_form(koksma__text_place place, koksma__form form)
{
    koksma__mesh *out = &place.im->mesh;
    const bool flat = form == KOKSMA__FORM_SQUARE || form == KOKSMA__FORM_CUBE;
    const size_t sides = form == KOKSMA__FORM_CUBE ? 6 : 1, columns = flat ? 1 : SIDES;
    const size_t rows = form == KOKSMA__FORM_SPHERE ? RINGS : 1, each = (columns + 1) * (rows + 1);
    koksma__import_pass(place, koksma__mesh_init(sides * each, sides * 2 * columns * rows, true, true, out));
    uint32_t *triangle = out->indices;
    for (size_t i = 0; i < sides * each; i++) {
        const size_t x = i % each % (columns + 1), y = i % each / (columns + 1);
        double p[3], n[3];
        form_point(form, (double)x / (double)columns, (double)y / (double)rows, p, n);
        if (sides > 1) {
            to_side((int)(i / each), p, n);
        }
        for (size_t k = 0; k < 3; k++) {
            out->vertices[3 * i + k] = (float)p[k];
            out->normals[3 * i + k] = (float)n[k];
        }
        out->uvs[2 * i] = (float)x / (float)columns;
        out->uvs[2 * i + 1] = (float)y / (float)rows;
        if (x < columns && y < rows) {
            const uint32_t a = (uint32_t)i, b = a + 1, c = a + (uint32_t)columns + 1,
                           corners[6] = {a, b, c + 1, a, c + 1, c};
            memcpy(triangle, corners, sizeof corners);
            triangle += 6;
        }
    }
}

/* Changes uv from the texture coordinates of form_point to those of Mitsuba, where they differ: on a sphere v is
   counted from +z; on a disk (u, v) are radius and angle; on a cube each side is turned as in Mitsuba. */
static void set_mitsubas_uv(koksma__form form, const float p[3], const float n[3], float uv[2])
{
    const float x = p[0], y = p[1], z = p[2], angle = uv[0];
    if (form == KOKSMA__FORM_SPHERE) {
        uv[1] = 1 - uv[1];
    } else if (form == KOKSMA__FORM_DISK) {
        uv[0] = 1 - uv[1];
        uv[1] = angle;
    } else if (form == KOKSMA__FORM_CUBE) {
        uv[0] = (1 + (n[0] != 0 ? y : n[1] != 0 ? n[1] > 0 ? -x : z : n[2] > 0 ? y : -y)) / 2;
        uv[1] = (1 + (n[0] != 0 ? n[0] > 0 ? -z : z : n[1] > 0 ? -z : x)) / 2;
    }
}

static int find_form(koksma__text_place place, koksma__form form)
{
    koksma__import *im = place.im;
    const koksma__mesh *mesh = &im->mesh;
    if (!im->forms[form]) {
        make_form(place, form);
        for (size_t i = 0; im->rows_down && i < mesh->n_vertices; i++) {
            set_mitsubas_uv(form, mesh->vertices + 3 * i, mesh->normals + 3 * i, mesh->uvs + 2 * i);
        }
        im->forms[form] = koksma__import_mesh(place) + 1;
    }
    return im->forms[form] - 1;
}

/* ---- Placing shapes ---------------------------------------------------------------------------------------- */

/* Whether a material needs texture coordinates. */
static bool is_textured(const koksma__material *m)
{
    return m->image || m->checker || m->maps[KOKSMA__MAP_ALPHA].image || m->maps[KOKSMA__MAP_EMISSION].image;
}

/* The matrix of a shape at time 0 and, if the shape moves, the poses and matrices of its koksma__placement. */
typedef struct placed {
    double matrix[12];
    bool moves;
    koksma__pose poses[2];
    double before[12], after[12];
} placed;

/* Computes the box of a placement, and fails if it is beyond the bounds. */
static void bound(koksma__text_place place, koksma__placement *p, const char *how)
{
    koksma__placement_box(&place.im->scene->meshes[p->mesh], p);
    for (int k = 0; k < 3; k++) {
        koksma__import_fail_if(!(p->low[k] >= -FAR && p->high[k] <= FAR), place, "a mesh %s beyond 1e6", how);
    }
}

static void set_mesh_motion(koksma__text_place place, const placed *at, koksma__placement *p)
{
    koksma__placement end = *p;
    memcpy(p->poses, at->poses, sizeof p->poses);
    memcpy(p->before, at->before, sizeof p->before);
    memcpy(p->after, at->after, sizeof p->after);
    p->steps = koksma__pose_steps(p->poses);
    koksma__placement_at(p, 1, end.matrix);
    bound(place, &end, "moves");
}

static void put_mesh(const koksma__import_item *item, int mesh, const placed *at)
{
    const koksma__text_place place = item->place;
    koksma_scene *scene = place.im->scene;
    koksma__import_surface surface = item->surface;
    koksma__placement *p = NULL;
    if (surface.material >= 0 && !scene->meshes[mesh].uvs && is_textured(&scene->materials[surface.material])) {
        mesh = find_twin(place, mesh, false);
    }
    if (koksma__matrix_mirrors(at->matrix) != surface.turned) {
        mesh = find_twin(place, mesh, true);
    }
    koksma__import_check(place, koksma__scene_add_placement(scene, &p));
    p->mesh = mesh;
    p->material = surface.material;
    p->smooth = scene->meshes[mesh].normals != NULL && !(surface.emits && surface.material < 0);
    memcpy(p->matrix, at->matrix, sizeof p->matrix);
    bound(place, p, "reaches");
    if (at->moves) {
        set_mesh_motion(place, at, p);
    }
    koksma__import_radiance(place.im, surface.radiance);
    koksma__import_unknown_if(surface.hidden, place, "an invisible light of triangles is visible");
    if (surface.emits) {
        koksma__import_check(place, koksma__scene_add_glow(scene, p, surface.radiance));
        scene->lights[p->light].two_sided = surface.two_sided;
    }
}

/* Finds the lengths of a matrix's columns, and whether the columns are perpendicular. */
static bool is_square(const double m[12], double length[3])
{
    double axes[3][3];
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 3; k++) {
            axes[c][k] = m[4 * k + c];
        }
        length[c] = sqrt(koksma__dot(axes[c], axes[c]));
    }
    bool square = length[0] > TINY && length[1] > TINY && length[2] > TINY;
    for (int c = 0; c < 3; c++) {
        const int d = (c + 1) % 3;
        square &= fabs(koksma__dot(axes[c], axes[d])) <= 1e-5 * length[c] * length[d];
    }
    return square;
}

static bool is_close(double a, double b)
{
    return fabs(a - b) <= 1e-5 * fabs(a);
}

const koksma__shape_type *koksma__own_shape_type(const char *name)
{
    size_t i = 0;
    while (strcmp(koksma__shape_types[i]->kind.name, name) != 0) {
        i++;
    }
    return koksma__shape_types[i];
}

/* Whether a motion is one that Koksma's own shapes can have: a shift, a rotation about one axis, a growth that is the
   same in all directions. */
static bool turns_evenly(const placed *at)
{
    const double *a = at->poses[0].stretch, *b = at->poses[1].stretch;
    double largest = 0, length[3];
    int k = 0;
    for (int i = 0; i < 9; i++) {
        k = fabs(a[i]) > largest ? i : k;
        largest = fmax(largest, fabs(a[i]));
    }
    bool even = is_square(at->after, length) && is_close(length[0], length[1]) && is_close(length[0], length[2]);
    for (int i = 0; i < 9; i++) {
        even &= fabs(b[i] - a[i] * (b[k] / a[k])) <= 1e-5 * fabs(b[k]);
    }
    return even;
}

/* Sets the motion of one of Koksma's own shapes, about the point that is the origin of the poses. */
static void set_own_motion(const koksma__import_item *item, const placed *at, koksma__shape *shape)
{
    const double *a = at->poses[0].rotation, *b = at->poses[1].rotation, *from = at->poses[0].translate;
    const double *stretch[2] = {at->poses[0].stretch, at->poses[1].stretch};
    const double w = a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
    double axis[3], square = 0, off[3];
    int largest = 0;
    for (int k = 0; k < 3; k++) { /* the vector part of b times the conjugate of a, on the shorter arc */
        const int i = 1 + (k + 1) % 3, j = 1 + (k + 2) % 3;
        axis[k] = (w < 0 ? -1 : 1) * (a[0] * b[1 + k] - b[0] * a[1 + k] - b[i] * a[j] + b[j] * a[i]);
        square += axis[k] * axis[k];
    }
    for (int i = 1; i < 9; i++) {
        largest = fabs(stretch[0][i]) > fabs(stretch[0][largest]) ? i : largest;
    }
    shape->turn.turns = true;
    shape->turn.scale = stretch[1][largest] / stretch[0][largest];
    shape->turn.angle_rad = 2 * koksma__atan2(sqrt(square), fabs(w));
    const double side = koksma__matrix_mirrors(at->after) ? -1 : 1;
    for (int k = 0; k < 3; k++) {
        const double *row = at->after + 4 * k;
        const double move[3] = {at->poses[1].translate[0] - from[0], at->poses[1].translate[1] - from[1],
                                at->poses[1].translate[2] - from[2]};
        shape->motion[k] = koksma__dot(row, move);
        shape->turn.pivot[k] = koksma__dot(row, from) + row[3];
        shape->turn.axis[k] = square > 0 ? side * koksma__dot(row, axis) : k == 1;
        off[k] = shape->centre[k] - shape->turn.pivot[k];
    }
    koksma__normalise(shape->turn.axis);
    const double reach =
        shape->turn.scale * (sqrt(koksma__dot(off, off)) + koksma__hypot(shape->half[0], shape->half[1]));
    for (int k = 0; k < 3; k++) {
        koksma__import_fail_if(!(fabs(shape->turn.pivot[k] + shape->motion[k]) + reach <= FAR), item->place,
                               "a shape moves beyond 1e6");
    }
}

/* The type of Koksma's own shape for an item; NULL if the matrix, the motion, a texture or the emitting side needs a
   mesh instead. */
static const koksma__shape_type *own_shape(const koksma__import_item *item, const placed *at, double length[3])
{
    const bool square = is_square(at->matrix, length) && !(at->moves && !turns_evenly(at)) &&
                        !(item->surface.emits && item->surface.two_sided);
    const koksma__material *all = item->place.im->scene->materials,
                           *m = item->surface.material < 0 ? NULL : &all[item->surface.material];
    if (!square ||
        (m && (m->see_through || m->maps[KOKSMA__MAP_EMISSION].image || (!item->surface.emits && is_textured(m))))) {
        return NULL;
    }
    switch (item->form) {
    case KOKSMA__FORM_SQUARE:
        return m && item->surface.emits ? NULL : koksma__own_shape_type("rectangle");
    case KOKSMA__FORM_DISK:
        return is_close(length[0], length[1]) ? koksma__own_shape_type("disk") : NULL;
    case KOKSMA__FORM_SPHERE:
        return is_close(length[0], length[1]) && is_close(length[0], length[2]) &&
                       !(item->surface.emits && item->surface.turned)
                   ? koksma__own_shape_type("sphere")
                   : NULL;
    default:
        return NULL;
    }
}

/* Adds a shape of Koksma's own type with this matrix, and its light if it emits. */
static void put_own(const koksma__import_item *item, const koksma__shape_type *type, const placed *at,
                    const double length[3])
{
    koksma__import *im = item->place.im;
    const double *m = at->matrix;
    const bool sphere = type == koksma__own_shape_type("sphere"), disk = type == koksma__own_shape_type("disk");
    const double side =
        item->surface.turned ? -1 : 1; /* u is reversed with the normal, so that the axes remain right-handed */
    koksma__shape shape = {.type = type, .material = item->surface.material, .light = -1}, *added;
    double normal[3];
    for (int k = 0; k < 3; k++) {
        shape.centre[k] = m[4 * k + 3];
        shape.axis_u[k] = m[4 * k] / length[0];
        shape.axis_v[k] = m[4 * k + 1] / length[1];
        normal[k] = side * m[4 * k + 2] / length[2];
        koksma__import_fail_if(!(fabs(shape.centre[k]) + length[k] <= FAR), item->place,
                               "a shape reaches beyond 1e6");
    }
    koksma__cross(shape.axis_u, shape.axis_v, shape.normal);
    for (int k = 0; koksma__dot(shape.normal, normal) < 0 && k < 3; k++) {
        shape.axis_u[k] = -shape.axis_u[k];
    }
    koksma__cross(shape.axis_u, shape.axis_v, shape.normal);
    shape.half[0] = length[0];
    shape.half[1] = disk || sphere ? length[0] : length[1];
    if (at->moves) {
        set_own_motion(item, at, &shape);
    }
    if (item->surface.emits) {
        koksma__light light = {.kind = sphere ? &koksma__light_sphere
                                       : disk ? &koksma__light_disk
                                              : &koksma__light_rectangle,
                               .visible = !item->surface.hidden};
        memcpy(light.centre, shape.centre, sizeof light.centre);
        memcpy(light.axis_u, shape.axis_u, sizeof light.axis_u);
        memcpy(light.axis_v, shape.axis_v, sizeof light.axis_v);
        memcpy(light.normal, shape.normal, sizeof light.normal);
        memcpy(light.half, shape.half, sizeof light.half);
        memcpy(light.radiance, item->surface.radiance, sizeof light.radiance);
        koksma__import_radiance(im, light.radiance);
        const double *l = light.radiance, area = disk ? M_PI * length[0] * length[0] : 4 * length[0] * length[1];
        light.power = (0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2]) * area / M_PI;
        koksma__import_light(item->place, &light);
        if (item->surface.hidden) {
            return;
        }
        shape.light = (int)im->scene->n_lights - 1;
        shape.material = -1;
    }
    koksma__import_check(item->place, koksma__scene_add_shape(im->scene, &shape, &added));
}

/* Whether a surface reflects nothing. */
static bool is_black(const koksma__material *m)
{
    return m->bsdf == &koksma__bsdf_lambert && !m->image && !m->maps[KOKSMA__MAP_EMISSION].image &&
           m->albedo[0][0] + m->albedo[0][1] + m->albedo[0][2] <= 0 && !m->checker;
}

/* Finds the matrices of an item that is placed by the further matrix `outer`, and its motion: by `poses` if they are
   given, otherwise the item's own motion. */
static void place_item(const koksma__import_item *item, const double outer[12], const koksma__pose poses[2],
                       placed *at)
{
    const double *first = outer ? outer : koksma__import_identity;
    koksma__matrix_multiply(first, item->matrix, at->matrix);
    for (int i = 0; i < 12; i++) {
        koksma__import_fail_if(!(fabs(at->matrix[i]) <= 1e9), item->place, "a matrix has an entry beyond 1e9");
    }
    at->moves = poses || item->motion.moves;
    if (at->moves && item->surface.emits) {
        at->moves = false;
        koksma__import_unknown(item->place, "a moving light stays where it is at the start");
    } else if (at->moves) {
        memcpy(at->poses, poses ? poses : item->motion.poses, sizeof at->poses);
        memcpy(at->before, poses ? item->matrix : item->motion.before, sizeof at->before);
        memcpy(at->after, poses ? koksma__import_identity : first, sizeof at->after);
        koksma__import_unknown_if(poses && item->motion.moves, item->place,
                                  "motion within an object whose instance moves is ignored");
    }
}

void koksma__import_put(const koksma__import_item *item, const double outer[12], const koksma__pose poses[2])
{
    const koksma__import_surface *surface = &item->surface;
    placed at;
    double length[3];
    koksma__import_spend(item->place, 64);
    if (surface->material < 0 && !surface->emits) {
        return; /* no surface: light passes through */
    }
    if (surface->emits && surface->material >= 0 && is_black(&item->place.im->scene->materials[surface->material])) {
        koksma__import_item dark = *item;
        dark.surface.material = -1; /* a light that reflects nothing becomes one of Koksma's own lights */
        koksma__import_put(&dark, outer, poses);
        return;
    }
    place_item(item, outer, poses, &at);
    const koksma__shape_type *own = item->form == KOKSMA__FORM_MESH ? NULL : own_shape(item, &at, length);
    if (own) {
        koksma__import_unknown_if(surface->emits && surface->material >= 0, item->place,
                                  "the reflection of a round light is left out");
        put_own(item, own, &at, length);
        return;
    }
    const int mesh = item->form == KOKSMA__FORM_MESH ? item->mesh : find_form(item->place, item->form);
    koksma__import_unknown_if(
        item->form == KOKSMA__FORM_CYLINDER || item->form == KOKSMA__FORM_SPHERE || item->form == KOKSMA__FORM_DISK,
        item->place, "a cylinder, or a stretched or textured round shape, becomes a mesh with %d sides", SIDES);
    if (mesh >= 0) {
        put_mesh(item, mesh, &at);
    }
}
