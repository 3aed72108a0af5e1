/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads scene files, as docs/scenes.md describes them: the root object and its lists, in the order that
 * references need (materials before shapes before lights). Every error names file, line and field. The kinds of
 * materials, lights and shapes, their parameters and the allowed values come from the tables in src/render; this file
 * reads the fields that several kinds share, and lists the kinds with their fields.
 */
#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "core/vector.h"
#include "render/description_build.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/medium.h"
#include "render/shapes/shapes.h"

/* Returns `status`; if that is an error, its text begins with the field. */
static koksma_status at_field(const field *f, koksma_status status)
{
    return status ? koksma__json_fail_in(f, status) : KOKSMA_OK;
}

/* The map from the unit square to the lens that has this name; NULL for other names. */
static const koksma_warp *lens_map(const char *name)
{
    return koksma_warp_find(!strcmp(name, "concentric") ? "concentric-disk"
                            : !strcmp(name, "polar")    ? "polar-disk"
                                                        : "");
}

bool koksma__camera_aim(const double eye[3], const double forward[3], const double up[3], double fov_rad,
                        koksma__camera *camera)
{
    memcpy(camera->eye, eye, sizeof camera->eye);
    memcpy(camera->forward, forward, sizeof camera->forward);
    camera->fov_rad = fov_rad;
    camera->focus_distance = 1;
    camera->lens_map = lens_map("concentric");
    camera->shutter[1] = 1;
    if (!koksma__normalise(camera->forward)) {
        return false;
    }
    koksma__cross(camera->forward, up, camera->right);
    if (!koksma__normalise(camera->right)) {
        return false;
    }
    koksma__cross(camera->forward, camera->right, camera->down);
    return true;
}

/* Reads "albedo", or for a checkerboard "albedos" and the size and position of its squares. */
static koksma_status parse_albedo(const field *f, koksma__material *m)
{
    field pair, item;
    size_t n = 0;
    double angle_deg = 0;
    if (!m->checker) {
        KOKSMA__TRY(koksma__parse_colour(f, "albedo", true, 1, m->albedo[0]));
        memcpy(m->albedo[1], m->albedo[0], sizeof m->albedo[0]);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(f, "albedos", &pair));
    KOKSMA__TRY(koksma__json_length(&pair, 2, &n));
    KOKSMA__JSON_FAIL_IF(n != 2, &pair, "it takes 2 albedos");
    for (size_t i = 0; i < 2; i++) {
        item = koksma__json_item(&pair, i);
        KOKSMA__TRY(koksma__parse_colour_value(&item, 1, m->albedo[i]));
    }
    m->period = 1;
    KOKSMA__TRY(koksma__json_get_number(f, "period", false, TINY, FAR, &m->period));
    KOKSMA__TRY(koksma__json_get_numbers(f, "phase", false, -FAR, FAR, 2, m->phase));
    KOKSMA__TRY(koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg));
    m->angle_rad = angle_deg * TURN / 360;
    return KOKSMA_OK;
}

/* Reads "albedo": {"image": FILE} of a Lambert surface; the image's mean colour is used where a single colour is
   needed. */
static koksma_status parse_texture(koksma_scene *scene, const char *name, const field *f, koksma__material *m)
{
    field albedo;
    const char *path = "";
    KOKSMA__TRY(koksma__json_member(f, "albedo", &albedo));
    KOKSMA__TRY(koksma__json_only(&albedo, KEYS("image")));
    KOKSMA__TRY(koksma__json_get_text(&albedo, "image", true, &path));
    KOKSMA__TRY(koksma__parse_image(scene, name, &albedo, path, &m->image));
    koksma__material_mean(scene, m);
    return KOKSMA_OK;
}

/* Reads the diffuse albedo, in one of the forms that the kind of material allows. */
static koksma_status parse_diffuse(koksma_scene *scene, const char *scene_name, const field *f, koksma__material *m)
{
    const unsigned forms = m->bsdf->diffuse;
    if (!forms) {
        return KOKSMA_OK;
    }
    if (forms & KOKSMA__IMAGE && koksma__json_is_object_at(f, "albedo")) {
        return parse_texture(scene, scene_name, f, m);
    }
    m->checker = forms & KOKSMA__CHECKER && (!(forms & KOKSMA__ALBEDO) || koksma__json_has(f, "albedos"));
    return parse_albedo(f, m);
}

static koksma_status read_material(const char *scene_name, const field *f, koksma_scene *scene)
{
    const char *name = "", *problem;
    size_t kind = 0;
    koksma__material *m = &scene->materials[scene->n_materials];
    KOKSMA__TRY(koksma__json_get_text(f, "name", true, &name));
    KOKSMA__JSON_FAIL_IF((!*name || strlen(name) >= sizeof m->name), f, "a name has 1 to %zu letters",
                         sizeof m->name - 1);
    KOKSMA__JSON_FAIL_IF(koksma__find_material(scene, name) >= 0, f, "a second material '%s'", name);
    KOKSMA__TRY(koksma__parse_kind(f, koksma__material_kinds, &kind));
    strcpy(m->name, name);
    m->bsdf = koksma__bsdfs[kind];
    scene->n_materials++;
    KOKSMA__TRY(koksma__parse_fields(f, &m->bsdf->kind, koksma__material_keys(m->bsdf), m));
    KOKSMA__TRY(parse_diffuse(scene, scene_name, f, m));
    KOKSMA__JSON_FAIL_IF(m->bsdf->check && (problem = m->bsdf->check(m)), f, "%s", problem);
    return KOKSMA_OK;
}

/* ---- The camera ----------------------------------------------------------------------------------------- */

/* Reads the camera, which is perspective or orthographic, with a thin lens or without (Potmesil & Chakravarty 1981,
   and Cook, Porter & Carpenter 1984), and the time that its shutter is open. */

enum { MOST_BLADES = 64 };

static koksma_status parse_blades(const field *f, koksma__camera *camera)
{
    long long blades = 0;
    double angle_deg = 0;
    KOKSMA__TRY(koksma__json_get_whole(f, "lens_blades", false, 3, MOST_BLADES, &blades));
    KOKSMA__TRY(koksma__json_get_number(f, "lens_angle_deg", false, -360, 360, &angle_deg));
    KOKSMA__JSON_FAIL_IF(koksma__json_has(f, "lens_angle_deg") && !blades, f,
                         "lens_angle_deg turns the corners of the lens, whose number 'lens_blades' gives");
    KOKSMA__JSON_FAIL_IF(blades && !(camera->lens_radius > 0), f, "lens_blades needs a 'lens_radius'");
    camera->blades = (int)blades;
    camera->blade_angle_rad = angle_deg * TURN / 360;
    return KOKSMA_OK;
}

static koksma_status parse_lens(const field *f, koksma__camera *camera)
{
    const char *map = "concentric";
    KOKSMA__TRY(koksma__json_get_number(f, "lens_radius", false, 0, FAR, &camera->lens_radius));
    KOKSMA__TRY(koksma__json_get_text(f, "lens_map", false, &map));
    camera->focus_distance = 1;
    if (camera->lens_radius > 0 || koksma__json_has(f, "focus_distance")) {
        KOKSMA__TRY(koksma__json_get_number(f, "focus_distance", true, TINY, FAR, &camera->focus_distance));
    }
    camera->lens_map = lens_map(map);
    KOKSMA__JSON_FAIL_IF(!camera->lens_map, f, "no lens_map '%s'; it takes concentric or polar", map);
    return parse_blades(f, camera);
}

static koksma_status parse_shutter(const field *f, koksma__camera *camera)
{
    koksma_status status = KOKSMA_OK;
    camera->shutter[1] = 1;
    if (koksma__json_has(f, "shutter")) {
        status = koksma__json_get_numbers(f, "shutter", true, 0, 1, 2, camera->shutter);
    }
    KOKSMA__JSON_FAIL_IF(!status && camera->shutter[0] > camera->shutter[1], f, "the shutter closes before it opens");
    return !status && koksma__json_has(f, "motion") ? koksma__parse_point(f, "motion", camera->motion) : status;
}

/* Reads what the image shows: the angle of a perspective camera, or the height of an orthographic one. */
static koksma_status parse_view(const field *f, koksma__camera *camera)
{
    static const char key[] = "orthographic_height";
    double fov_deg = 0;
    KOKSMA__JSON_FAIL_IF(koksma__json_has(f, "fov_deg") && koksma__json_has(f, key), f,
                         "it takes one of 'fov_deg' and '%s'", key);
    const koksma_status status = koksma__json_has(f, key)
                                     ? koksma__json_get_number(f, key, true, TINY, FAR, &camera->height)
                                     : koksma__json_get_number(f, "fov_deg", true, 0.01, 179, &fov_deg);
    camera->fov_rad = fov_deg * TURN / 360;
    camera->by_degrees = true;
    return status;
}

static koksma_status parse_camera(const field *root, koksma__camera *camera)
{
    field f;
    double target[3], up[3] = {0, 1, 0};
    KOKSMA__TRY(koksma__json_member(root, "camera", &f));
    KOKSMA__TRY(koksma__json_only(&f, KEYS("eye", "target", "up", "fov_deg", "orthographic_height", "lens_radius",
                                           "focus_distance", "lens_map", "lens_blades", "lens_angle_deg", "shutter",
                                           "motion")));
    KOKSMA__TRY(koksma__parse_point(&f, "eye", camera->eye));
    KOKSMA__TRY(koksma__parse_point(&f, "target", target));
    KOKSMA__TRY(parse_view(&f, camera));
    if (koksma__json_has(&f, "up")) {
        KOKSMA__TRY(koksma__parse_direction(&f, "up", up));
    }
    KOKSMA__TRY(parse_lens(&f, camera));
    KOKSMA__TRY(parse_shutter(&f, camera));
    koksma__subtract(target, camera->eye, camera->forward);
    KOKSMA__JSON_FAIL_IF(!koksma__normalise(camera->forward), &f, "'eye' and 'target' are the same point");
    koksma__cross(camera->forward, up, camera->right);
    KOKSMA__JSON_FAIL_IF(!koksma__normalise(camera->right), &f, "'up' is along the line of sight");
    koksma__cross(camera->forward, camera->right, camera->down);
    return KOKSMA_OK;
}

/* ---- Shapes --------------------------------------------------------------------------------------------- */

/*
 * Reads shapes. The kinds of shapes, their fields and the allowed values come from the table in render/shapes.
 * This file reads the field that all shapes have: "material", or "emission" in its place for some kinds.
 */

static koksma_status refuse_image(const field *f)
{
    char known[256] = "";
    for (size_t i = 0; koksma__shape_types[i]; i++) {
        const size_t used = strlen(known);
        if (koksma__shape_types[i]->takes_image) {
            snprintf(known + used, sizeof known - used, " %s", koksma__shape_types[i]->kind.name);
        }
    }
    return koksma__json_fail(f, "this kind takes no material with an image; these do:%s", known);
}

static const char *material_name(const void *scene, size_t i)
{
    const koksma_scene *s = scene;
    return i < s->n_materials ? s->materials[i].name : NULL;
}

/* Finds the index of the shape's material; it stays -1 for a shape with "emission". */
static koksma_status parse_material(const field *f, const koksma_scene *scene, koksma__shape *shape)
{
    const char *name = "";
    KOKSMA__JSON_FAIL_IF(shape->type->may_emit && koksma__json_has(f, "emission") == koksma__json_has(f, "material"),
                         f, "it takes one of 'material' and 'emission'");
    if (shape->type->may_emit && koksma__json_has(f, "emission")) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma__json_get_text(f, "material", true, &name);
    shape->material = status ? -1 : koksma__find_material(scene, name);
    if (status || shape->material < 0) {
        const char *closest = status ? NULL : koksma_closest_name(name, material_name, scene);
        return status ? status
                      : koksma__json_fail(f, closest ? "no material '%s'; did you mean '%s'?" : "no material '%s'",
                                          name, closest);
    }
    const koksma__material *m = &scene->materials[shape->material];
    KOKSMA__JSON_FAIL_IF(m->checker && !shape->type->takes_checker, f, "a %s takes no material with a checkerboard",
                         shape->type->kind.name);
    return m->image && !shape->type->takes_image ? refuse_image(f) : KOKSMA_OK;
}

static koksma_status parse_shape(const char *scene_name, const field *f, koksma_scene *scene)
{
    size_t kind = 0;
    KOKSMA__TRY(koksma__parse_kind(f, koksma__shape_kinds, &kind));
    koksma__shape shape = {.type = koksma__shape_types[kind], .material = -1, .light = -1}, *added;
    KOKSMA__TRY(koksma__parse_fields(f, &shape.type->kind, KEYS("kind", "material"), &shape));
    KOKSMA__TRY(parse_material(f, scene, &shape));
    if (shape.type->parse) {
        KOKSMA__TRY(shape.type->parse(scene_name, f, scene, &shape));
    }
    return shape.type->hit ? at_field(f, koksma__scene_add_shape(scene, &shape, &added)) : KOKSMA_OK;
}

/* ---- Lights --------------------------------------------------------------------------------------------- */

/* Reads lights. The kinds of lights, their fields and the allowed values come from the table in render/lights. */

static koksma_status parse_light(const char *name, const field *f, koksma_scene *scene)
{
    size_t kind = 0;
    koksma__light *light = NULL;
    KOKSMA__TRY(koksma__parse_kind(f, koksma__light_kinds, &kind));
    KOKSMA__TRY(at_field(f, koksma__scene_add_light(scene, &light)));
    light->kind = koksma__light_types[kind];
    KOKSMA__TRY(koksma__parse_fields(f, &light->kind->kind, KEYS("kind"), light));
    return light->kind->parse ? light->kind->parse(name, f, scene, light) : KOKSMA_OK;
}

static koksma_status parse_image(const field *root, koksma_scene *scene)
{
    field image;
    long long width = 128, height = 96;
    if (koksma__json_has(root, "image")) {
        KOKSMA__TRY(koksma__json_member(root, "image", &image));
        KOKSMA__TRY(koksma__json_only(&image, KEYS("width", "height")));
        KOKSMA__TRY(koksma__json_get_whole(&image, "width", true, 1, KOKSMA_MAX_IMAGE_SIDE, &width));
        KOKSMA__TRY(koksma__json_get_whole(&image, "height", true, 1, KOKSMA_MAX_IMAGE_SIDE, &height));
    }
    scene->width = (int)width;
    scene->height = (int)height;
    return KOKSMA_OK;
}

/* Reads each item of the list `key`. */
static koksma_status parse_list(const char *name, const field *root, const char *key, size_t most,
                                koksma_status (*parse)(const char *name, const field *f, koksma_scene *scene),
                                koksma_scene *scene)
{
    field list, item;
    size_t n = 0;
    KOKSMA__TRY(koksma__json_member(root, key, &list));
    KOKSMA__TRY(koksma__json_length(&list, most, &n));
    for (size_t i = 0; i < n; i++) {
        item = koksma__json_item(&list, i);
        KOKSMA__TRY(parse(name, &item, scene));
    }
    return KOKSMA_OK;
}

static koksma_status parse_lists(const char *name, const field *root, koksma_scene *scene)
{
    KOKSMA__TRY(parse_list(name, root, "materials", KOKSMA__MAX_MATERIALS, read_material, scene));
    KOKSMA__TRY(parse_list(name, root, "shapes", KOKSMA__MAX_SHAPES, parse_shape, scene));
    return koksma__json_has(root, "lights") ? parse_list(name, root, "lights", KOKSMA__MAX_LIGHTS, parse_light, scene)
                                            : KOKSMA_OK;
}

/* ---- The medium ------------------------------------------------------------------------------------------- */

/* A number in the hash of scenes with a medium; it is raised when a change of the code alters their images. */
enum { MEDIUM_REVISION = 1 };

/* Reads the medium. The lights are read before it, because a medium without bounds is an error together with lights
   that are infinitely far away. */
static koksma_status parse_medium(const field *root, koksma_scene *scene)
{
    field f;
    double absorption[3] = {0}, scattering[3] = {0}, g = 0, low[3], high[3];
    if (!koksma__json_has(root, "medium")) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(root, "medium", &f));
    KOKSMA__TRY(koksma__json_only(&f, KEYS("sigma_a", "sigma_s", "g", "low", "high")));
    KOKSMA__TRY(koksma__parse_colour(&f, "sigma_a", false, BRIGHT, absorption));
    KOKSMA__TRY(koksma__parse_colour(&f, "sigma_s", false, BRIGHT, scattering));
    KOKSMA__TRY(koksma__json_get_number(&f, "g", false, -0.999, 0.999, &g));
    bool is_empty = true;
    for (int k = 0; k < 3; k++) {
        is_empty &= absorption[k] == 0 && scattering[k] == 0;
    }
    KOKSMA__JSON_FAIL_IF(is_empty, &f, "'sigma_a' or 'sigma_s' must be above 0");
    koksma__medium_init(&scene->medium, absorption, scattering, g);
    scene->hash += MEDIUM_REVISION;
    if (koksma__json_has(&f, "low") || koksma__json_has(&f, "high")) {
        KOKSMA__TRY(koksma__parse_point(&f, "low", low));
        KOKSMA__TRY(koksma__parse_point(&f, "high", high));
        for (int k = 0; k < 3; k++) {
            KOKSMA__JSON_FAIL_IF(!(high[k] - low[k] > TINY), &f, "'low' must be below 'high' in every coordinate");
            scene->medium.low[k] = low[k];
            scene->medium.high[k] = high[k];
        }
    }
    return at_field(&f, koksma__medium_check(scene));
}

static koksma_status parse_root(const char *name, const field *root, koksma_scene *scene)
{
    const char *title = "", *note;
    KOKSMA__TRY(koksma__scene_begin(scene, ""));
    KOKSMA__TRY(koksma__json_only(root, KEYS("title", "note", "image", "camera", "background", "ambient", "clamp",
                                             "medium", "materials", "shapes", "lights")));
    KOKSMA__TRY(koksma__json_get_text(root, "title", false, &title));
    snprintf(scene->title, sizeof scene->title, "%s", title);
    KOKSMA__TRY(koksma__json_get_text(root, "note", false, &note));
    KOKSMA__TRY(parse_image(root, scene));
    KOKSMA__TRY(parse_camera(root, &scene->camera));
    KOKSMA__TRY(koksma__parse_colour(root, "background", false, BRIGHT, scene->background));
    KOKSMA__TRY(koksma__parse_colour(root, "ambient", false, BRIGHT, scene->ambient));
    KOKSMA__TRY(koksma__json_get_number(root, "clamp", false, TINY, BRIGHT, &scene->clamp));
    KOKSMA__TRY(parse_lists(name, root, scene));
    KOKSMA__TRY(parse_medium(root, scene));
    koksma__scene_finish(scene);
    return KOKSMA_OK;
}

koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene)
{
    koksma__json *document;
    koksma_status status = koksma__json_open("scene", name, text, size, &document);
    if (!status) {
        const field root = koksma__json_root(document);
        status = parse_root(name, &root, scene);
    }
    koksma__json_close(document);
    return status;
}

static void add_fields(koksma_entry *to, const char *const *names)
{
    for (size_t i = 0; names && names[i]; i++) {
        const size_t used = strlen(to->fields);
        snprintf(to->fields + used, sizeof to->fields - used, "%s%s", used ? " " : "", names[i]);
    }
}

bool koksma_scene_kind_at(const char *member, size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, member, out);
    const bool materials = !strcmp(member, "materials"), lights = !strcmp(member, "lights");
    const koksma__kind *const *kinds = materials                   ? koksma__material_kinds
                                       : lights                    ? koksma__light_kinds
                                       : !strcmp(member, "shapes") ? koksma__shape_kinds
                                                                   : NULL;
    for (size_t k = 0, left = i; kinds && kinds[k]; k++) {
        if (kinds[k]->is_implied || left-- > 0) {
            continue;
        }
        *out = (koksma_entry){.name = kinds[k]->name, .title = kinds[k]->title, .cite = kinds[k]->cite};
        add_fields(out, materials ? koksma__material_keys(koksma__bsdfs[k])
                        : lights  ? KEYS("kind")
                                  : KEYS("kind", "material"));
        for (const koksma__parameter *p = kinds[k]->parameters; p && p->name; p++) {
            add_fields(out, KEYS(p->name));
        }
        add_fields(out, kinds[k]->keys);
        return true;
    }
    return false;
}
