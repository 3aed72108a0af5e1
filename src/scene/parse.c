/* SPDX-License-Identifier: Apache-2.0 */
/* Scene files: what docs/scenes.md says, with an error that names line and field for everything else. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "scene/json.h"
#include "scene/scene.h"
#include "scene/vector.h"

#define FAR 1e6    /* coordinates and lengths */
#define TINY 1e-6  /* lengths that count as zero */
#define BRIGHT 1e6 /* luminance */
#define TURN (2 * M_PI)

#define KEYS(...) ((const char *const[]){__VA_ARGS__, NULL})

typedef koksma__json_node field;

/* ---- Directions and frames ----------------------------------------------------------------------------- */

static koksma_status get_point(const field *object, const char *key, double out[3])
{
    return koksma__json_get_numbers(object, key, true, -FAR, FAR, 3, out);
}

static koksma_status get_direction(const field *object, const char *key, double out[3])
{
    koksma_status status = get_point(object, key, out);
    if (!status && !koksma__normalise(out)) {
        return koksma__json_fail(object, "'%s' is a direction of length 0", key);
    }
    return status;
}

/* The axes of a flat shape from its normal and "up" (default: y; -z for a normal along y). axis_v is up made square
   to the normal and axis_u = axis_v x normal: seen against the normal u goes right. A floor has u = x, v = -z. */
static koksma_status get_axes(const field *object, const double normal[3], double axis_u[3], double axis_v[3])
{
    double up[3] = {0, 1, 0};
    if (koksma__json_has(object, "up")) {
        const koksma_status status = get_direction(object, "up", up);
        if (status) {
            return status;
        }
    } else if (fabs(normal[1]) > 0.999999) {
        up[1] = 0;
        up[2] = -1;
    }
    koksma__cross(up, normal, axis_u);
    if (!koksma__normalise(axis_u)) {
        return koksma__json_fail(object, "'up' is along the normal");
    }
    koksma__cross(normal, axis_u, axis_v);
    return KOKSMA_OK;
}

static koksma_status get_half(const field *object, double half[2])
{
    koksma_status status = koksma__json_get_numbers(object, "half", true, 0, FAR, 2, half);
    if (!status && !(half[0] > TINY && half[1] > TINY)) {
        return koksma__json_fail(object, "zero area");
    }
    return status;
}

static koksma_status get_kind(const field *object, const char *kinds, const char **out)
{
    const koksma_status status = koksma__json_get_text(object, "kind", true, out);
    if (!status && (!**out || strchr(*out, ' ') || !strstr(kinds, *out))) {
        return koksma__json_fail(object, "no kind '%s'; known here: %s", *out, kinds);
    }
    return status;
}

/* ---- The parts of a scene ------------------------------------------------------------------------------ */

static koksma_status parse_image(const field *root, koksma_scene *scene)
{
    field image;
    long long width = 128, height = 96;
    koksma_status status = KOKSMA_OK;
    if (koksma__json_has(root, "image")) {
        status = koksma__json_member(root, "image", &image);
        status = status ? status : koksma__json_only(&image, KEYS("width", "height"));
        status = status ? status : koksma__json_get_whole(&image, "width", true, 1, KOKSMA_MAX_IMAGE_SIDE, &width);
        status = status ? status : koksma__json_get_whole(&image, "height", true, 1, KOKSMA_MAX_IMAGE_SIDE, &height);
    }
    scene->width = (int)width;
    scene->height = (int)height;
    return status;
}

static koksma_status parse_camera(const field *root, koksma__camera *camera)
{
    field f;
    double target[3], up[3] = {0, 1, 0}, fov_deg = 0;
    koksma_status status = koksma__json_member(root, "camera", &f);
    status = status ? status : koksma__json_only(&f, KEYS("eye", "target", "up", "fov_deg"));
    status = status ? status : get_point(&f, "eye", camera->eye);
    status = status ? status : get_point(&f, "target", target);
    status = status ? status : koksma__json_get_number(&f, "fov_deg", true, 0.01, 179, &fov_deg);
    if (!status && koksma__json_has(&f, "up")) {
        status = get_direction(&f, "up", up);
    }
    if (status) {
        return status;
    }
    camera->fov_rad = fov_deg * TURN / 360;
    koksma__subtract(target, camera->eye, camera->forward);
    if (!koksma__normalise(camera->forward)) {
        return koksma__json_fail(&f, "'eye' and 'target' are one point");
    }
    koksma__cross(camera->forward, up, camera->right);
    if (!koksma__normalise(camera->right)) {
        return koksma__json_fail(&f, "'up' is along the line of sight");
    }
    koksma__cross(camera->forward, camera->right, camera->down);
    return KOKSMA_OK;
}

static koksma_status parse_checker(const field *f, koksma__material *material)
{
    double angle_deg = 0;
    koksma_status status = koksma__json_only(f, KEYS("name", "kind", "albedos", "period", "phase", "angle_deg"));
    material->checker = true;
    material->period = 1;
    status = status ? status : koksma__json_get_numbers(f, "albedos", true, 0, 1, 2, material->albedo);
    status = status ? status : koksma__json_get_number(f, "period", false, TINY, FAR, &material->period);
    status = status ? status : koksma__json_get_numbers(f, "phase", false, -FAR, FAR, 2, material->phase);
    status = status ? status : koksma__json_get_number(f, "angle_deg", false, -360, 360, &angle_deg);
    material->angle_rad = angle_deg * TURN / 360;
    return status;
}

static koksma_status parse_lambert(const field *f, koksma__material *material)
{
    koksma_status status = koksma__json_only(f, KEYS("name", "kind", "albedo"));
    status = status ? status : koksma__json_get_number(f, "albedo", true, 0, 1, &material->albedo[0]);
    material->albedo[1] = material->albedo[0];
    return status;
}

static int find_material(const koksma_scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->n_materials; i++) {
        if (!strcmp(scene->materials[i].name, name)) {
            return (int)i;
        }
    }
    return -1;
}

static koksma_status parse_material(const field *f, koksma_scene *scene)
{
    const char *kind = "", *name = "";
    koksma__material *material = &scene->materials[scene->n_materials];
    koksma_status status = koksma__json_get_text(f, "name", true, &name);
    if (!status && (!*name || strlen(name) >= sizeof material->name)) {
        return koksma__json_fail(f, "a name has 1 to %zu letters", sizeof material->name - 1);
    }
    if (!status && find_material(scene, name) >= 0) {
        return koksma__json_fail(f, "a second material '%s'", name);
    }
    status = status ? status : get_kind(f, "lambert checker", &kind);
    if (status) {
        return status;
    }
    strcpy(material->name, name);
    scene->n_materials++;
    return !strcmp(kind, "checker") ? parse_checker(f, material) : parse_lambert(f, material);
}

static koksma_status get_radius(const field *f, double half[2])
{
    koksma_status status = koksma__json_get_number(f, "radius", true, 0, FAR, &half[0]);
    half[1] = half[0];
    if (!status && !(half[0] > TINY)) {
        return koksma__json_fail(f, "zero radius");
    }
    return status;
}

static koksma_status get_bounds(const field *f, const koksma_scene *scene, koksma__shape *shape)
{
    switch (shape->kind) {
    case KOKSMA__SHAPE_PLANE:
        shape->half[0] = shape->half[1] = INFINITY;
        return koksma__json_only(f, KEYS("kind", "material", "centre", "normal", "up"));
    case KOKSMA__SHAPE_RECTANGLE:
        if (koksma__json_only(f, KEYS("kind", "material", "centre", "normal", "up", "half"))) {
            return KOKSMA_MALFORMED;
        }
        return get_half(f, shape->half);
    case KOKSMA__SHAPE_SPHERE:
        if (koksma__json_only(f, KEYS("kind", "material", "centre", "radius"))) {
            return KOKSMA_MALFORMED;
        }
        if (scene->materials[shape->material].checker) {
            return koksma__json_fail(f, "a sphere takes no checker");
        }
        return get_radius(f, shape->half);
    case KOKSMA__SHAPE_DISK:
        if (koksma__json_only(f, KEYS("kind", "material", "centre", "normal", "up", "radius"))) {
            return KOKSMA_MALFORMED;
        }
        return get_radius(f, shape->half);
    }
    return KOKSMA_OK;
}

static koksma_status parse_shape(const field *f, koksma_scene *scene)
{
    static const char *const kinds[] = {[KOKSMA__SHAPE_PLANE] = "plane",
                                        [KOKSMA__SHAPE_RECTANGLE] = "rectangle",
                                        [KOKSMA__SHAPE_DISK] = "disk",
                                        [KOKSMA__SHAPE_SPHERE] = "sphere"};
    koksma__shape *shape = &scene->shapes[scene->n_shapes++];
    const char *kind = "", *material = "";
    koksma_status status = get_kind(f, "plane rectangle disk sphere", &kind);
    for (int k = 0; k < 4; k++) {
        shape->kind = strcmp(kinds[k], kind) ? shape->kind : (koksma__shape_kind)k;
    }
    status = status ? status : koksma__json_get_text(f, "material", true, &material);
    shape->material = find_material(scene, material);
    if (!status && shape->material < 0) {
        return koksma__json_fail(f, "no material '%s'", material);
    }
    status = status ? status : get_bounds(f, scene, shape);
    status = status ? status : get_point(f, "centre", shape->centre);
    if (!status && shape->kind != KOKSMA__SHAPE_SPHERE) {
        status = get_direction(f, "normal", shape->normal);
        status = status ? status : get_axes(f, shape->normal, shape->axis_u, shape->axis_v);
    }
    return status;
}

/* "radiance" of the surface, or "strength": what a surface of albedo 1 reflects of it that faces it in the point that
   the light faces, were the light small. towards: from the light to that point; NULL with a "normal". */
static koksma_status parse_power(const field *f, const double *towards, koksma__light *light)
{
    double value = 0;
    const bool by_radiance = koksma__json_has(f, "radiance");
    if (by_radiance == koksma__json_has(f, "strength")) {
        return koksma__json_fail(f, "it takes one of 'radiance' and 'strength'");
    }
    if (!by_radiance && !towards) {
        return koksma__json_fail(f, "'strength' needs 'facing'");
    }
    const koksma_status status =
        koksma__json_get_number(f, by_radiance ? "radiance" : "strength", true, 0, BRIGHT, &value);
    light->power =
        by_radiance ? value * 4 * light->half[0] * light->half[1] / M_PI : value * koksma__dot(towards, towards);
    return status;
}

static koksma_status parse_light(const field *f, koksma_scene *scene)
{
    const char *kind = "";
    koksma__light *light = &scene->lights[scene->n_lights++];
    double target[3] = {0}, towards[3] = {0};
    koksma_status status =
        koksma__json_only(f, KEYS("kind", "centre", "normal", "facing", "up", "half", "radiance", "strength"));
    status = status ? status : get_kind(f, "rectangle", &kind);
    status = status ? status : get_point(f, "centre", light->centre);
    status = status ? status : get_half(f, light->half);
    const bool has_target = koksma__json_has(f, "facing");
    if (!status && has_target == koksma__json_has(f, "normal")) {
        return koksma__json_fail(f, "it takes one of 'facing' and 'normal'");
    }
    status = status       ? status
             : has_target ? get_point(f, "facing", target)
                          : get_direction(f, "normal", light->normal);
    if (!status && has_target) {
        koksma__subtract(target, light->centre, towards);
        memcpy(light->normal, towards, sizeof towards);
        if (!koksma__normalise(light->normal)) {
            return koksma__json_fail(f, "it faces its own centre");
        }
    }
    status = status ? status : get_axes(f, light->normal, light->axis_u, light->axis_v);
    return status ? status : parse_power(f, has_target ? towards : NULL, light);
}

/* ---- The lists ---------------------------------------------------------------------------------------- */

/* Room for a list's items (size bytes each) in *out, and one call of parse for each item. */
static koksma_status parse_list(const field *root, const char *key, size_t max, size_t size, void *out,
                                koksma_status (*parse)(const field *, koksma_scene *), koksma_scene *scene)
{
    field list;
    size_t n = 0;
    koksma_status status = koksma__json_member(root, key, &list);
    status = status ? status : koksma__json_length(&list, max, &n);
    if (status) {
        return status;
    }
    void *items = calloc(n + 1, size);
    if (!items) {
        return koksma__fail_memory(n * size);
    }
    memcpy(out, &items, sizeof items);
    for (size_t i = 0; !status && i < n; i++) {
        const field item = koksma__json_item(&list, i);
        status = parse(&item, scene);
    }
    return status;
}

static koksma_status parse_root(const field *root, koksma_scene *scene)
{
    const char *title = "", *note;
    koksma_status status = koksma__json_only(
        root, KEYS("title", "note", "image", "camera", "background", "ambient", "materials", "shapes", "lights"));
    status = status ? status : koksma__json_get_text(root, "title", false, &title);
    snprintf(scene->title, sizeof scene->title, "%s", title);
    status = status ? status : koksma__json_get_text(root, "note", false, &note);
    status = status ? status : parse_image(root, scene);
    status = status ? status : parse_camera(root, &scene->camera);
    status = status ? status : koksma__json_get_number(root, "background", false, 0, BRIGHT, &scene->background);
    status = status ? status : koksma__json_get_number(root, "ambient", false, 0, BRIGHT, &scene->ambient);
    status = status ? status
                    : parse_list(root, "materials", KOKSMA__MAX_MATERIALS, sizeof *scene->materials,
                                 &scene->materials, parse_material, scene);
    status = status ? status
                    : parse_list(root, "shapes", KOKSMA__MAX_SHAPES, sizeof *scene->shapes, &scene->shapes,
                                 parse_shape, scene);
    if (!status && koksma__json_has(root, "lights")) {
        status =
            parse_list(root, "lights", KOKSMA__MAX_LIGHTS, sizeof *scene->lights, &scene->lights, parse_light, scene);
    }
    return status;
}

koksma_status koksma__scene_parse(const char *name, const char *text, size_t size, koksma_scene *scene)
{
    koksma__json *document;
    koksma_status status = koksma__json_open("scene", name, text, size, &document);
    if (!status) {
        const field root = koksma__json_root(document);
        status = parse_root(&root, scene);
    }
    koksma__json_close(document);
    return status;
}
