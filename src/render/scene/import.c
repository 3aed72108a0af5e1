/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Functions that the readers of other renderers' scenes share: paths, warnings about unsupported features, materials,
 * lights and the camera; import_shapes.c has the shapes, import_text.c the texts. Every material becomes the nearest
 * kind that Koksma has. Two differences apply and are documented in docs/scenes.md: without an index of refraction a
 * conductor's Fresnel reflectance becomes Schlick's approximation, and surfaces have two sides. Any other difference is
 * reported in a warning with file and line. Long because both formats share all of it.
 */
#include "scene/import.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <unistd.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/elementary.h"
#include "core/vector.h"
#include "image/formats.h"
#include "image/image.h"
#include "render/description_build.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/medium.h"
#include "render/scene_images.h"

enum { MOST_STEPS = 1 << 26 };

const double koksma__import_identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/* ---- Messages -------------------------------------------------------------------------------------------- */

koksma_status koksma__import_try(koksma__import *im, void (*read)(void *reader), void *reader)
{
    jmp_buf here, *const before = im->back;
    im->back = &here;
    im->status = KOKSMA_OK;
    if (!setjmp(here)) {
        read(reader);
    }
    im->back = before;
    return im->status;
}

static _Noreturn void jump_back(koksma__text_place place, koksma_status status)
{
    place.im->status = status;
    longjmp(*place.im->back, 1);
}

void koksma__import_pass(koksma__text_place place, koksma_status status)
{
    if (status) {
        jump_back(place, status);
    }
}

void koksma__import_check(koksma__text_place place, koksma_status status)
{
    char where[KOKSMA__MAX_PATH + 32];
    snprintf(where, sizeof where, "%s:%lu", place.file, place.line);
    koksma__import_pass(place, status ? koksma__fail_in(status, where) : KOKSMA_OK);
}

static _Noreturn void fail(koksma__text_place place, const char *format, va_list arguments)
{
    char text[512];
    koksma__vsnprintf(text, sizeof text, format, arguments);
    jump_back(place, koksma__fail(KOKSMA_MALFORMED, "%s:%lu: %s", place.file, place.line, text));
}

void koksma__import_fail(koksma__text_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    fail(place, format, arguments);
}

void koksma__import_fail_if(bool is_so, koksma__text_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (is_so) {
        fail(place, format, arguments);
    }
    va_end(arguments);
}

void *koksma__import_add(koksma__text_place place, void *array, size_t *n, size_t item_size)
{
    void *added = koksma__add_one(array, n, item_size);
    koksma__import_pass(place, added ? KOKSMA_OK : KOKSMA_MEMORY);
    return added;
}

void koksma__import_put_name(koksma__text_place place, koksma__names *names, const char *name, size_t index)
{
    koksma__import_pass(place, koksma__names_put(names, name, strlen(name), index));
}

void koksma__import_spend(koksma__text_place place, uint64_t steps)
{
    place.im->steps += steps;
    if (place.im->steps > MOST_STEPS) {
        koksma__import_fail(place,
                            "reading the scene up to here takes more than %d steps: objects, instances, textures or "
                            "texts repeat others, or parts are not read, too often",
                            MOST_STEPS);
    }
}

static void add_unknown(koksma__text_place place, const char *format, va_list arguments)
{
    koksma_scene *scene = place.im->scene;
    char text[256];
    koksma__vsnprintf(text, sizeof text, format, arguments);
    koksma__import_spend(place, 16 + scene->n_unknown / 4);
    koksma__import_pass(place, koksma__unknown_put(&scene->unknown, &scene->n_unknown, place.file, place.line, text));
}

void koksma__import_unknown(koksma__text_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    add_unknown(place, format, arguments);
    va_end(arguments);
}

void koksma__import_unknown_if(bool is_so, koksma__text_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (is_so) {
        add_unknown(place, format, arguments);
    }
    va_end(arguments);
}

bool koksma__import_is_full(const koksma__import *im)
{
    return im->scene->n_unknown == KOKSMA__MOST_UNKNOWN;
}

void koksma__import_path(koksma__text_place place, const char *name, char out[KOKSMA__MAX_PATH])
{
    const koksma__import *im = place.im;
    char other[KOKSMA__MAX_PATH];
    koksma__import_spend(place, 128); /* calls of the system */
    koksma__import_fail_if(!*name, place, "the name of a file (filename) is missing or empty");
    bool fits = koksma__path_beside(im->path, name, out);
    for (size_t i = 0; fits && access(out, F_OK) && i < im->n_folders; i++) {
        fits = koksma__path_beside(im->folders[i], name, other);
        if (fits && !access(other, F_OK)) {
            memcpy(out, other, sizeof other);
        }
    }
    koksma__import_fail_if(!fits, place, "the path is too long");
}

/* ---- Colours ---------------------------------------------------------------------------------------------- */

/* Clamps an albedo to [0, 1]. */
static void clamp_albedo(double rgb[3])
{
    for (int k = 0; k < 3; k++) {
        rgb[k] = rgb[k] > 0 ? fmin(rgb[k], 1) : 0;
    }
}

void koksma__import_radiance(koksma__import *im, double rgb[3])
{
    const double largest = fmax(fmax(rgb[0], rgb[1]), rgb[2]);
    im->scene->unread.too_bright += largest > BRIGHT;
    for (int k = 0; k < 3; k++) {
        rgb[k] = rgb[k] > 0 ? largest > BRIGHT ? fmin(rgb[k] / largest, 1) * BRIGHT : rgb[k] : 0;
    }
}

bool koksma__import_metal(const char *name, double rgb[3])
{
    /* reflectance along the normal in daylight, as linear sRGB, which tools/metals.py computes from published optical
       constants */
    static const struct {
        const char *name;
        double rgb[3];
    } metals[] = {{"Au", {1.000, 0.730, 0.365}},
                  {"Ag", {0.989, 0.984, 0.978}},
                  {"Cu", {0.927, 0.624, 0.522}},
                  {"Al", {0.908, 0.916, 0.922}},
                  {"Cr", {0.550, 0.556, 0.554}},
                  {"W", {0.516, 0.496, 0.467}},
                  {"Ni", {0.696, 0.641, 0.563}},
                  {"Ti", {0.618, 0.580, 0.543}},
                  {"CuZn", {0.907, 0.779, 0.424}},
                  {"Ir", {0.745, 0.732, 0.701}},
                  {"none", {1, 1, 1}}};
    for (size_t i = 0; i < sizeof metals / sizeof *metals; i++) {
        if (!strcmp(name, metals[i].name)) {
            memcpy(rgb, metals[i].rgb, sizeof metals[i].rgb);
            return true;
        }
    }
    return false;
}

/* ---- Materials -------------------------------------------------------------------------------------------- */

/* Finishes the reading of an image: one that can't be decoded is left out with a warning, any other error is one of
   the scene. */
static void leave_out(koksma__text_place place, koksma_status status)
{
    if (status && ((status != KOKSMA_MALFORMED && status != KOKSMA_UNSUPPORTED) || koksma__is_refused())) {
        koksma__import_check(place, status);
    }
    koksma__import_unknown_if(status, place, "%s; it is left out", status ? koksma_error_text() : "");
}

/* The image of a colour; NULL if it is left out. */
static koksma_image *find_image(koksma__text_place place, const koksma__import_colour *c)
{
    koksma__image_use use = c->has_use ? c->use : KOKSMA__PLAIN_IMAGE;
    koksma_image *image = NULL;
    use.upside_down = place.im->rows_down;
    leave_out(place, koksma__scene_image(place.im->scene, c->image, &use, &image));
    return image;
}

void koksma__import_mean(koksma__text_place place, const char *what, koksma__spectrum_use use,
                         koksma__import_colour *c)
{
    if (*c->image) {
        koksma__import_spend(place, place.im->scene->n_images / 8);
        c->use.border = false; /* the mean is that of the image */
        const koksma_image *image = find_image(place, c);
        *c->image = 0;
        if (!image) {
            return;
        }
        koksma__scene_image_mean(place.im->scene, image, use == KOKSMA__REFLECTANCE, c->rgb);
        for (int k = 0; k < 3; k++) {
            c->rgb[k] *= c->image_scale;
        }
    } else if (c->is_checker) {
        c->is_checker = false;
        for (int k = 0; k < 3; k++) {
            c->rgb[k] = (c->rgb[k] + c->second[k]) / 2;
        }
    } else {
        return;
    }
    koksma__import_unknown(place, "%s is replaced by its mean colour", what);
}

/* Maps the unit square to the part of an image within its border of one pixel. */
static void map_within_border(const koksma_image *image, koksma__mapping *mapping)
{
    const double sides[2] = {image->width, image->height};
    for (int k = 0; k < 2; k++) {
        float *row = mapping->matrix + 3 * k;
        for (int i = 0; i < 3; i++) {
            row[i] = (float)(((double)row[i] * (sides[k] - 2) + (i == 2)) / sides[k]);
        }
        mapping->wrap[k] = KOKSMA__WRAP_CLAMP;
    }
    mapping->moved = true;
}

static void set_colour(koksma__text_place place, const koksma__import_colour *from, koksma__material *m)
{
    memcpy(m->albedo[0], from->rgb, sizeof from->rgb);
    memcpy(m->albedo[1], from->is_checker ? from->second : from->rgb, sizeof from->rgb);
    clamp_albedo(m->albedo[0]);
    clamp_albedo(m->albedo[1]);
    m->checker = from->is_checker;
    m->period = from->period;
    m->mapping = from->is_checker ? from->mapping : m->mapping;
    m->image = *from->image ? find_image(place, from) : NULL;
    if (m->image) {
        m->mapping = from->mapping;
        if (from->has_use && from->use.border) {
            map_within_border(m->image, &m->mapping);
        }
        koksma__material_mean(place.im->scene, m);
    }
    koksma__import_unknown_if(m->image && from->image_scale != 1, place, "an image's scale is ignored");
}

/* Replaces a coated material by a Phong lobe, which has a dielectric's reflectance along the normal, over a Lambert
   surface, which reflects part of the remaining light. With an image as the colour, only the Lambert surface is
   set. */
static void set_coated(koksma__text_place place, const koksma__import_material *from, koksma__material *m)
{
    set_colour(place, &from->colour, m);
    if (m->image) {
        m->bsdf = &koksma__bsdf_lambert;
        koksma__import_unknown(place, "a coat over an image is ignored");
        return;
    }
    const double ior = fmin(fmax(from->ior, 0.1), 10), ratio = (ior - 1) / (ior + 1), share = ratio * ratio;
    double *reflectance = koksma__material_value(m, "reflectance");
    reflectance[0] = reflectance[1] = reflectance[2] = share;
    *koksma__material_value(m, "exponent") = fmin(2 / fmax(from->alpha * from->alpha, 2e-5), 1e5);
    for (int k = 0; k < 6; k++) {
        m->albedo[k / 3][k % 3] *= 1 - share;
    }
    koksma__import_unknown(place, "a coated surface is replaced by Lambert and a Phong lobe");
}

static bool same_mapping(const koksma__mapping *a, const koksma__mapping *b)
{
    return a->moved == b->moved && a->nearest == b->nearest && !memcmp(a->matrix, b->matrix, sizeof a->matrix) &&
           !memcmp(a->wrap, b->wrap, sizeof a->wrap);
}

static bool same_map(const koksma__map *a, const koksma__map *b)
{
    return a->image == b->image && same_mapping(&a->mapping, &b->mapping);
}

/* Whether two materials, of which an importer has set what this file sets, are the same but for their names. */
static bool same_material(const koksma__material *a, const koksma__material *b)
{
    return a->bsdf == b->bsdf && a->image == b->image && a->checker == b->checker &&
           !memcmp(a->albedo, b->albedo, sizeof a->albedo) && !memcmp(&a->period, &b->period, sizeof a->period) &&
           !memcmp(a->values, b->values, sizeof a->values) && same_mapping(&a->mapping, &b->mapping) &&
           same_map(&a->maps[KOKSMA__MAP_ALPHA], &b->maps[KOKSMA__MAP_ALPHA]) &&
           same_map(&a->maps[KOKSMA__MAP_EMISSION], &b->maps[KOKSMA__MAP_EMISSION]) &&
           a->see_through == b->see_through && !memcmp(&a->alpha, &b->alpha, sizeof a->alpha);
}

/* The material of the scene that is equal to `material`, but for its name, which is added if there is none yet: files
   repeat materials for each shape. */
static int keep_material(koksma__text_place place, const koksma__material *material)
{
    koksma_scene *scene = place.im->scene;
    koksma__import_spend(place, scene->n_materials / 8);
    for (size_t i = 0; i < scene->n_materials; i++) {
        if (same_material(&scene->materials[i], material)) {
            return (int)i;
        }
    }
    koksma__import_fail_if(scene->n_materials == KOKSMA__MAX_MATERIALS, place, "more than %d different materials",
                           KOKSMA__MAX_MATERIALS);
    koksma__material *to = &scene->materials[scene->n_materials];
    *to = *material;
    snprintf(to->name, sizeof to->name, "%zu", scene->n_materials);
    return (int)scene->n_materials++;
}

static void set_roughness(const koksma__import_material *from, double least, koksma__material *m)
{
    *koksma__material_value(m, "roughness") = fmin(fmax(sqrt(from->alpha), least), 1);
}

/* Sets a metal, by its index of refraction or by Schlick's approximation. */
static void set_metal(const koksma__import_material *from, koksma__material *m)
{
    static const koksma__bsdf *const kinds[2][2] = {{&koksma__bsdf_ggx, &koksma__bsdf_mirror},
                                                    {&koksma__bsdf_rough_conductor, &koksma__bsdf_conductor}};
    const bool smooth = from->alpha < 1e-6;
    m->bsdf = kinds[from->has_index][smooth];
    for (int i = 0; i < 3 && from->has_index; i++) {
        koksma__material_value(m, "eta")[i] = fmin(fmax(from->eta[i], 0), FAR);
        koksma__material_value(m, "k")[i] = fmin(fmax(from->k[i], 0), FAR);
    }
    double *colour = koksma__material_value(m, from->has_index ? "tint" : "reflectance");
    memcpy(colour, from->colour.rgb, sizeof from->colour.rgb);
    clamp_albedo(colour);
    if (!smooth) {
        set_roughness(from, 1e-3, m);
    }
}

static void set_glass(const koksma__import_material *from, koksma__material *m)
{
    m->bsdf = from->alpha > 1e-6 ? &koksma__bsdf_rough_dielectric : &koksma__bsdf_dielectric;
    double *tint = koksma__material_value(m, "tint");
    tint[0] = tint[1] = tint[2] = 1;
    *koksma__material_value(m, "ior") = fmin(fmax(from->ior, 1.0001), 10);
    if (from->alpha > 1e-6) {
        set_roughness(from, 0.03, m);
    }
}

int koksma__import_material_of(koksma__text_place place, const koksma__import_material *from)
{
    koksma__material m = {.bsdf = from->kind == KOKSMA__COATED ? &koksma__bsdf_utah : &koksma__bsdf_lambert};
    switch (from->kind) {
    case KOKSMA__METAL:
        set_metal(from, &m);
        break;
    case KOKSMA__GLASS:
        set_glass(from, &m);
        break;
    case KOKSMA__COATED:
        set_coated(place, from, &m);
        break;
    default:
        set_colour(place, &from->colour, &m);
    }
    return keep_material(place, &m);
}

/* ---- Mixtures ---------------------------------------------------------------------------------------------- */

void koksma__import_affine(koksma__import_colour *c, const double scale[3], const double plus[3])
{
    for (int k = 0; k < 3; k++) {
        c->rgb[k] = scale[k] * c->rgb[k] + plus[k];
        c->second[k] = scale[k] * c->second[k] + plus[k];
        c->use.tint[k] *= scale[k];
        c->use.plus[k] = scale[k] * c->use.plus[k] + plus[k];
    }
}

void koksma__import_between(koksma__import_colour *c, const double first[3], const double second[3])
{
    double step[3];
    koksma__subtract(second, first, step);
    koksma__import_affine(c, step, first);
}

/* Blends material b into a; returns false if no single material scatters as both together do. A material's light is
   linear in its albedos and in Schlick's reflectance along the normal, but in no other parameter. */
static bool blend_materials(koksma__material *a, const koksma__material *b, double amount)
{
    const bool same_squares = !a->checker || !b->checker || !memcmp(&a->period, &b->period, sizeof a->period);
    koksma__material with = *b, both = *a;
    const bool reflects =
        a->bsdf == &koksma__bsdf_mirror || a->bsdf == &koksma__bsdf_ggx || a->bsdf == &koksma__bsdf_utah;
    if (a->bsdf != b->bsdf || a->image || b->image || !same_squares) {
        return false;
    }
    double *from = reflects ? koksma__material_value(&with, "reflectance") : NULL;
    double *to = reflects ? koksma__material_value(&both, "reflectance") : NULL;
    for (int k = 0; reflects && k < 3; k++) {
        to[k] += amount * (from[k] - to[k]);
        from[k] = to[k];
    }
    if (memcmp(with.values, both.values, sizeof with.values) != 0) {
        return false;
    }
    *a = both;
    for (int k = 0; k < 6; k++) {
        a->albedo[k / 3][k % 3] += amount * (b->albedo[k / 3][k % 3] - a->albedo[k / 3][k % 3]);
    }
    a->period = b->checker ? b->period : a->period;
    a->checker |= b->checker;
    return true;
}

/* Whether a material is Lambert's with one albedo, which light meets everywhere. */
static bool is_plain(const koksma__material *m)
{
    return m->bsdf == &koksma__bsdf_lambert && !m->image && !m->checker && !m->see_through;
}

/* Reads an image as numbers: Mitsuba takes the luminance of colours; pbrt's reader has set already what it takes. */
static void use_as_number(const koksma__import *im, koksma__import_colour *c)
{
    if (im->rows_down) {
        c->has_use = true;
        c->use = KOKSMA__PLAIN_IMAGE;
        c->use.average = KOKSMA__LUMINANCE;
    }
}

int koksma__import_mix(koksma__text_place place, int first, int second, koksma__import_colour *amount)
{
    const koksma__material *all = place.im->scene->materials;
    const bool both = first >= 0 && second >= 0, varies = *amount->image || amount->is_checker;
    koksma__material mixed = {.bsdf = &koksma__bsdf_lambert};
    if (first == second) {
        return first;
    }
    if (both && varies && is_plain(&all[first]) && is_plain(&all[second])) {
        /* the surface whose albedo goes from the first to the second as the amount goes from 0 to 1 */
        koksma__import_colour c = *amount;
        use_as_number(place.im, &c);
        koksma__import_between(&c, all[first].albedo[0], all[second].albedo[0]);
        set_colour(place, &c, &mixed);
        return keep_material(place, &mixed);
    }
    koksma__import_mean(place, "the amount of a mix", KOKSMA__REFLECTANCE, amount);
    const double share = amount->rgb[0];
    if (share <= 0 || share >= 1) {
        return share <= 0 ? first : second;
    }
    if (both) {
        mixed = all[first];
        if (blend_materials(&mixed, &all[second], share)) {
            return keep_material(place, &mixed);
        }
    }
    koksma__import_unknown(place, "a mix of different materials is replaced by the one with the larger share");
    return share < 0.5 ? first : second;
}

int koksma__import_mask(koksma__text_place place, int material, koksma__import_colour *opacity)
{
    if (material < 0) {
        return -1;
    }
    koksma__material m = place.im->scene->materials[material];
    koksma__map *map = &m.maps[KOKSMA__MAP_ALPHA];
    if (opacity->is_checker || map->image) {
        koksma__import_mean(place, "an opacity", KOKSMA__REFLECTANCE, opacity);
    }
    m.alpha = (m.see_through ? m.alpha : 1) * fmin(fmax(opacity->rgb[0], 0), 1);
    if (*opacity->image) {
        m.alpha = 1;
        use_as_number(place.im, opacity);
        map->image = find_image(place, opacity);
        map->mapping = opacity->mapping;
    }
    m.see_through = m.alpha < 1 || map->image;
    return m.alpha <= 0 ? -1 : keep_material(place, &m);
}

void koksma__import_glow(koksma__text_place place, const koksma__import_colour *radiance,
                         koksma__import_surface *surface)
{
    koksma__material m = {.bsdf = &koksma__bsdf_lambert};
    if (!*radiance->image) {
        return;
    }
    if (surface->material >= 0) {
        m = place.im->scene->materials[surface->material];
    }
    koksma__map *map = &m.maps[KOKSMA__MAP_EMISSION];
    map->image = find_image(place, radiance);
    map->mapping = radiance->mapping;
    for (int k = 0; k < 3; k++) {
        surface->radiance[k] = map->image ? radiance->image_scale : radiance->rgb[k];
    }
    surface->material = map->image ? keep_material(place, &m) : surface->material;
}

/* ---- Lights ------------------------------------------------------------------------------------------------ */

static bool has_environment(const koksma_scene *scene)
{
    bool found = false;
    for (size_t i = 0; i < scene->n_lights; i++) {
        found |= scene->lights[i].kind == &koksma__light_environment;
    }
    return found;
}

void koksma__import_light(koksma__text_place place, const koksma__light *light)
{
    koksma__light *to = NULL;
    for (int k = 0; k < 3; k++) {
        koksma__import_fail_if(!(fabs(light->centre[k]) <= FAR), place, "a light beyond 1e6");
    }
    if (light->kind == &koksma__light_environment && has_environment(place.im->scene)) {
        koksma__import_unknown(place, "the scene has a second environment, which is left out");
        return;
    }
    koksma__import_check(place, koksma__scene_add_light(place.im->scene, &to));
    *to = *light;
    koksma__import_radiance(place.im, to->radiance);
}

/* Checks the matrix by which an environment is turned, or its inverse: with entries that are not too large, except for
   those that move, directions keep a length that is finite and above 0. */
static koksma_status check_turn(const double matrix[12])
{
    for (int i = 0; i < 12; i++) {
        KOKSMA__FAIL_IF(i % 4 < 3 && !(fabs(matrix[i]) <= 1e9), KOKSMA_MALFORMED,
                        "the matrix of an environment, or its inverse, has an entry beyond 1e9");
    }
    return KOKSMA_OK;
}

/* What pbrt-v4 (ImageInfiniteLight) takes for the illuminance of an octahedral map. */
static double map_illuminance(const koksma_image *image)
{
    const size_t width = (size_t)image->width, n = width * (size_t)image->height;
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        const double u = fabs(2 * ((double)(i % width) + 0.5) / image->width - 1);
        const double v = fabs(2 * ((double)(i / width) + 0.5) / image->height - 1);
        const double near = u + v < 1 ? u + v : 1; /* 1: on the horizon or below it */
        sum += (1 - near * near) * koksma__luminance(image, i);
    }
    return 2 * M_PI * sum / (double)n;
}

/* Turns an environment by a matrix and keeps it as that of a light. */
static koksma_status turn_sky(koksma__import *im, const koksma_image *image, const double matrix[12],
                              koksma_image **out)
{
    koksma_image turned = {0};
    double inverse[12];
    KOKSMA__FAIL_IF(!koksma__import_invert(matrix, inverse), KOKSMA_MALFORMED,
                    "the matrix of an environment has no inverse");
    KOKSMA__TRY(check_turn(matrix));
    KOKSMA__TRY(check_turn(inverse));
    koksma_status status = koksma__sky_turn(image, !im->rows_down, inverse, &turned);
    status = status ? status : koksma__scene_image_keep(im->scene, &turned, out);
    koksma_image_fini(&turned);
    return status;
}

void koksma__import_sky(koksma__text_place place, const char *name, double illuminance, const double scale[3],
                        const double matrix[12])
{
    char full[KOKSMA__MAX_PATH];
    koksma_image image = {0};
    koksma__light light = {.kind = &koksma__light_environment, .visible = true};
    if (has_environment(place.im->scene)) { /* the image of a second one, which may be large, is not read */
        koksma__import_light(place, &light);
        return;
    }
    koksma__import_path(place, name, full);
    memcpy(light.radiance, scale, sizeof light.radiance);
    koksma_status status = koksma__image_read(full, KOKSMA__FILE_TEXTURE, KOKSMA__BY_FILE, &image);
    status = status ? status : koksma__image_check(&image, full);
    if (!status) {
        const double own = illuminance > 0 ? map_illuminance(&image) : 0;
        for (int k = 0; own > 0 && k < 3; k++) {
            light.radiance[k] *= illuminance / own;
        }
    }
    const koksma_status turned = status ? KOKSMA_OK : turn_sky(place.im, &image, matrix, &light.image);
    koksma_image_fini(&image);
    leave_out(place, status);
    koksma__import_unknown_if(!status && *koksma_image_remark(), place, "%s", koksma_image_remark());
    koksma__import_check(place, turned);
    koksma__import_light(place, &light);
}

void koksma__import_spot(koksma__text_place place, const double direction[3], double inner_deg, double outer_deg,
                         int falloff, koksma__light *light)
{
    light->kind = &koksma__light_spot;
    memcpy(light->normal, direction, sizeof light->normal);
    koksma__import_fail_if(!koksma__import_normalise(light->normal), place, "a spot without a direction");
    koksma__import_fail_if(!(outer_deg > 0 && outer_deg <= 90), place,
                           "the angle of a spot's cone must be above 0 and at most 90 degrees");
    inner_deg = fmin(fmax(inner_deg, 0), outer_deg);
    light->values[0] = outer_deg; /* angle_deg and edge */
    light->values[1] = 1 - inner_deg / outer_deg;
    light->values[2] = falloff;
}

void koksma__import_check_medium(koksma__text_place place, const char *whose)
{
    if (koksma__medium_check(place.im->scene)) {
        place.im->scene->medium.is_there = false;
        koksma__import_unknown(place, "the %s medium is ignored, because it would absorb all light of distant lights",
                               whose);
    }
}

bool koksma__import_normalise(double v[3])
{
    const double largest = fmax(fmax(fabs(v[0]), fabs(v[1])), fabs(v[2]));
    for (int k = 0; k < 3 && largest > 1e150; k++) { /* so that squares are finite */
        v[k] /= largest;
    }
    return koksma__normalise(v);
}

/* ---- The camera ------------------------------------------------------------------------------------------- */

void koksma__import_apply(const double m[12], const double v[3], double w, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = koksma__dot(m + 4 * k, v) + w * m[4 * k + 3];
    }
}

bool koksma__import_invert(const double m[12], double out[12])
{
    double c[9], determinant = 0;
    for (int i = 0; i < 9; i++) {
        const int r = i / 3, k = i % 3, r1 = (k + 1) % 3, r2 = (k + 2) % 3, k1 = (r + 1) % 3, k2 = (r + 2) % 3;
        c[i] = m[4 * r1 + k1] * m[4 * r2 + k2] - m[4 * r1 + k2] * m[4 * r2 + k1];
    }
    for (int k = 0; k < 3; k++) {
        determinant += m[4 * k] * c[k];
    }
    for (int r = 0; r < 3; r++) {
        out[4 * r + 3] = 0;
        for (int k = 0; k < 3; k++) {
            out[4 * r + k] = c[3 * r + k] / determinant;
            out[4 * r + 3] -= out[4 * r + k] * m[4 * k + 3];
        }
    }
    bool whole = isnormal(determinant);
    for (int i = 0; i < 12; i++) {
        whole &= isfinite(out[i]) != 0;
    }
    return whole;
}

bool koksma__import_rotation(double angle_deg, const double axis[3], double out[12])
{
    double a[3] = {axis[0], axis[1], axis[2]};
    const double angle = angle_deg * TURN / 360, c = koksma__cos(angle), s = koksma__sin(angle);
    if (!koksma__import_normalise(a)) {
        return false;
    }
    for (int r = 0; r < 3; r++) {
        for (int k = 0; k < 3; k++) {
            const int third = 3 - r - k;
            const double turn = r == k ? 0 : (k == (r + 1) % 3 ? -1 : 1) * s * a[third];
            out[4 * r + k] = a[r] * a[k] * (1 - c) + (r == k ? c : 0) + turn;
        }
        out[4 * r + 3] = 0;
    }
    return true;
}

void koksma__import_look_at(koksma__text_place place, const char *name, const double eye[3], const double target[3],
                            const double up[3], double m[12])
{
    double ahead[3], across[3], over[3];
    koksma__subtract(target, eye, ahead);
    koksma__import_fail_if(!koksma__import_normalise(ahead), place,
                           "%s: there is no direction from the eye to its target", name);
    koksma__cross(up, ahead, across);
    koksma__import_fail_if(!koksma__import_normalise(across), place, "%s: up is along the line of sight", name);
    koksma__cross(ahead, across, over);
    for (int k = 0; k < 3; k++) {
        m[4 * k] = across[k], m[4 * k + 1] = over[k], m[4 * k + 2] = ahead[k], m[4 * k + 3] = eye[k];
    }
}

void koksma__import_camera(koksma__text_place place, const double m[12], double right, const koksma__camera *lens)
{
    koksma__camera *c = &place.im->scene->camera;
    *c = *lens;
    c->height *= sqrt(m[1] * m[1] + m[5] * m[5] + m[9] * m[9]);
    c->lens_map = koksma_warp_find("concentric-disk");
    c->shutter[1] = 1;
    for (int k = 0; k < 3; k++) {
        c->eye[k] = m[4 * k + 3];
        c->right[k] = right * m[4 * k];
        c->down[k] = -m[4 * k + 1];
        c->forward[k] = m[4 * k + 2];
        koksma__import_fail_if(!(fabs(c->eye[k]) <= FAR), place, "the camera's position is beyond 1e6");
    }
    koksma__import_fail_if(!koksma__import_normalise(c->right) || !koksma__import_normalise(c->down) ||
                               !koksma__import_normalise(c->forward),
                           place, "the camera's matrix has no inverse");
    c->by_degrees = true;
    koksma__import_fail_if(lens->height > 0 && !(c->height > TINY && c->height <= FAR), place,
                           "the height that the camera shows must be 1e-6 to 1e6");
    koksma__import_fail_if(!(lens->height > 0) && !(c->fov_rad >= 1e-4 && c->fov_rad < 3.13), place,
                           "the camera's angle of view must be above 0 and below 180 degrees");
    koksma__import_fail_if(
        !(c->lens_radius >= 0 && c->lens_radius <= FAR && c->focus_distance > TINY && c->focus_distance <= FAR),
        place, "the lens's radius must be 0 to 1e6, its focus distance 1e-6 to 1e6");
}
