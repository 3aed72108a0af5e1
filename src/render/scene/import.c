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
#include "render/scene_images.h"

enum { MOST_STEPS = 1 << 26 };

const double koksma__import_identity[12] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};

/* ---- Messages -------------------------------------------------------------------------------------------- */

koksma_status koksma__import_fail(koksma__text_place place, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return koksma__fail(KOKSMA_MALFORMED, "%s:%lu: %s", place.file, place.line, text);
}

koksma_status koksma__import_fail_at(koksma__text_place place, koksma_status status)
{
    char where[KOKSMA__MAX_PATH + 32];
    snprintf(where, sizeof where, "%s:%lu", place.file, place.line);
    return status ? koksma__fail_in(status, where) : KOKSMA_OK;
}

koksma_status koksma__import_spend(koksma__import *im, koksma__text_place place, uint64_t steps)
{
    im->steps += steps;
    return im->steps <= MOST_STEPS
               ? KOKSMA_OK
               : koksma__import_fail(place,
                                     "reading the scene up to here takes more than %d steps: objects, instances, "
                                     "textures or texts repeat others, or parts are not read, too often",
                                     MOST_STEPS);
}

static koksma_status add_unknown(koksma__import *im, koksma__text_place place, const char *format, va_list arguments)
{
    koksma_scene *scene = im->scene;
    char text[256];
    koksma__vsnprintf(text, sizeof text, format, arguments);
    KOKSMA__TRY(koksma__import_spend(im, place, 16 + scene->n_unknown / 4));
    return koksma__unknown_put(&scene->unknown, &scene->n_unknown, place.file, place.line, text);
}

koksma_status koksma__import_unknown(koksma__import *im, koksma__text_place place, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const koksma_status status = add_unknown(im, place, format, arguments);
    va_end(arguments);
    return status;
}

koksma_status koksma__import_unknown_if(bool is_so, koksma__import *im, koksma__text_place place, const char *format,
                                        ...)
{
    va_list arguments;
    va_start(arguments, format);
    const koksma_status status = is_so ? add_unknown(im, place, format, arguments) : KOKSMA_OK;
    va_end(arguments);
    return status;
}

bool koksma__import_is_full(const koksma__import *im)
{
    return im->scene->n_unknown == KOKSMA__MOST_UNKNOWN;
}

/* ---- Files ------------------------------------------------------------------------------------------------ */

koksma_status koksma__import_path(koksma__import *im, koksma__text_place place, const char *name,
                                  char out[KOKSMA__MAX_PATH])
{
    char other[KOKSMA__MAX_PATH];
    KOKSMA__TRY(koksma__import_spend(im, place, 128)); /* calls of the system */
    if (!*name) {
        return koksma__import_fail(place, "the name of a file (filename) is missing or empty");
    }
    bool fits = koksma__path_beside(im->path, name, out);
    for (size_t i = 0; fits && access(out, F_OK) && i < im->n_folders; i++) {
        fits = koksma__path_beside(im->folders[i], name, other);
        if (fits && !access(other, F_OK)) {
            memcpy(out, other, sizeof other);
        }
    }
    return fits ? KOKSMA_OK : koksma__import_fail(place, "the path is too long");
}

koksma_status koksma__import_folder(koksma__import *im, koksma__text_place place, const char *name)
{
    char with_slash[KOKSMA__MAX_PATH];
    if (im->n_folders == sizeof im->folders / sizeof *im->folders) {
        return koksma__import_fail(place, "more than %zu paths", im->n_folders);
    }
    return (size_t)snprintf(with_slash, sizeof with_slash, "%s/", name) < sizeof with_slash &&
                   koksma__path_beside(im->path, with_slash, im->folders[im->n_folders++])
               ? KOKSMA_OK
               : koksma__import_fail(place, "the path is too long");
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

void koksma__import_black_body(double kelvin, double rgb[3])
{
    const double t = fmin(fmax(kelvin, 1667), 25000), i = 1000 / t;
    const double x = t < 4000 ? ((-0.2661239 * i - 0.2343589) * i + 0.8776956) * i + 0.179910
                              : ((-3.0258469 * i + 2.1070379) * i + 0.2226347) * i + 0.240390;
    const double y = t < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                     : t < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    const double xyz[3] = {x / y, 1, (1 - x - y) / y};
    static const double to_rgb[3][3] = {
        {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
    for (int k = 0; k < 3; k++) {
        rgb[k] = fmax(koksma__dot(to_rgb[k], xyz), 0);
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

void koksma__import_fresnel(const double eta[3], const double k[3], double rgb[3])
{
    for (int i = 0; i < 3; i++) {
        const double n = fmin(fmax(eta[i], 0), FAR), absorbed = fmin(fmax(k[i], 0), FAR);
        rgb[i] = ((n - 1) * (n - 1) + absorbed * absorbed) / ((n + 1) * (n + 1) + absorbed * absorbed);
    }
}

/* ---- Materials -------------------------------------------------------------------------------------------- */

/* Finishes the reading of an image: one that can't be decoded is left out with a warning, any other error is one of
   the scene. */
static koksma_status leave_out(koksma__import *im, koksma__text_place place, koksma_status status)
{
    return (status != KOKSMA_MALFORMED && status != KOKSMA_UNSUPPORTED) || koksma__is_refused()
               ? koksma__import_fail_at(place, status)
               : koksma__import_unknown(im, place, "%s; it is left out", koksma_error_text());
}

/* Finds the image of a colour; *out is NULL if it is left out. */
static koksma_status find_image(koksma__import *im, koksma__text_place place, const koksma__import_colour *c,
                                koksma_image **out)
{
    koksma__image_use use = c->has_use ? c->use : KOKSMA__PLAIN_IMAGE;
    use.upside_down = im->rows_down;
    *out = NULL;
    const koksma_status status = koksma__scene_image(im->scene, c->image, &use, out);
    return status ? leave_out(im, place, status) : KOKSMA_OK;
}

koksma_status koksma__import_mean(koksma__import *im, koksma__text_place place, const char *what,
                                  koksma__spectrum_use use, koksma__import_colour *c)
{
    if (*c->image) {
        koksma_image *image;
        KOKSMA__TRY(koksma__import_spend(im, place, im->scene->n_images / 8));
        c->use.border = false; /* the mean is that of the image */
        KOKSMA__TRY(find_image(im, place, c, &image));
        *c->image = 0;
        if (!image) {
            return KOKSMA_OK;
        }
        koksma__scene_image_mean(im->scene, image, use == KOKSMA__REFLECTANCE, c->rgb);
        for (int k = 0; k < 3; k++) {
            c->rgb[k] *= c->image_scale;
        }
    } else if (c->is_checker) {
        c->is_checker = false;
        for (int k = 0; k < 3; k++) {
            c->rgb[k] = (c->rgb[k] + c->second[k]) / 2;
        }
    } else {
        return KOKSMA_OK;
    }
    return koksma__import_unknown(im, place, "%s is replaced by its mean colour", what);
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

static koksma_status set_colour(koksma__import *im, koksma__text_place place, const koksma__import_colour *from,
                                koksma__material *m)
{
    memcpy(m->albedo[0], from->rgb, sizeof from->rgb);
    memcpy(m->albedo[1], from->is_checker ? from->second : from->rgb, sizeof from->rgb);
    clamp_albedo(m->albedo[0]);
    clamp_albedo(m->albedo[1]);
    m->checker = from->is_checker;
    m->period = from->period;
    m->mapping = from->is_checker ? from->mapping : m->mapping;
    KOKSMA__TRY(*from->image ? find_image(im, place, from, &m->image) : KOKSMA_OK);
    if (m->image) {
        m->mapping = from->mapping;
        if (from->has_use && from->use.border) {
            map_within_border(m->image, &m->mapping);
        }
        koksma__material_mean(im->scene, m);
    }
    return koksma__import_unknown_if(m->image && from->image_scale != 1, im, place, "an image's scale is ignored");
}

/* Replaces a coated material by a Phong lobe, which has a dielectric's reflectance along the normal, over a Lambert
   surface, which reflects part of the remaining light. With an image as the colour, only the Lambert surface is
   set. */
static koksma_status set_coated(koksma__import *im, koksma__text_place place, const koksma__import_material *from,
                                koksma__material *m)
{
    KOKSMA__TRY(set_colour(im, place, &from->colour, m));
    if (m->image) {
        m->bsdf = &koksma__bsdf_lambert;
        return koksma__import_unknown(im, place, "a coat over an image is ignored");
    }
    const double ior = fmin(fmax(from->ior, 0.1), 10), ratio = (ior - 1) / (ior + 1), share = ratio * ratio;
    double *reflectance = koksma__material_value(m, "reflectance");
    reflectance[0] = reflectance[1] = reflectance[2] = share;
    *koksma__material_value(m, "exponent") = fmin(2 / fmax(from->alpha * from->alpha, 2e-5), 1e5);
    for (int k = 0; k < 6; k++) {
        m->albedo[k / 3][k % 3] *= 1 - share;
    }
    return koksma__import_unknown(im, place, "a coated surface is replaced by Lambert and a Phong lobe");
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

/* Sets *out to the material of the scene that is equal to `material`, but for its name, which is added if there is none
   yet: files repeat materials for each shape. Error: MALFORMED (too many). */
static koksma_status keep_material(koksma__import *im, koksma__text_place place, const koksma__material *material,
                                   int *out)
{
    koksma_scene *scene = im->scene;
    KOKSMA__TRY(koksma__import_spend(im, place, scene->n_materials / 8));
    for (size_t i = 0; i < scene->n_materials; i++) {
        if (same_material(&scene->materials[i], material)) {
            *out = (int)i;
            return KOKSMA_OK;
        }
    }
    if (scene->n_materials == KOKSMA__MAX_MATERIALS) {
        return koksma__import_fail(place, "more than %d different materials", KOKSMA__MAX_MATERIALS);
    }
    koksma__material *to = &scene->materials[scene->n_materials];
    *to = *material;
    *out = (int)scene->n_materials++;
    snprintf(to->name, sizeof to->name, "%d", *out);
    return KOKSMA_OK;
}

static void set_conductor(const koksma__import_material *from, koksma__material *m)
{
    m->bsdf = from->alpha < 1e-6 ? &koksma__bsdf_conductor : &koksma__bsdf_rough_conductor;
    for (int i = 0; i < 3; i++) {
        koksma__material_value(m, "eta")[i] = fmin(fmax(from->eta[i], 0), FAR);
        koksma__material_value(m, "k")[i] = fmin(fmax(from->k[i], 0), FAR);
    }
    memcpy(koksma__material_value(m, "tint"), from->colour.rgb, sizeof from->colour.rgb);
    clamp_albedo(koksma__material_value(m, "tint"));
    if (m->bsdf == &koksma__bsdf_rough_conductor) {
        *koksma__material_value(m, "roughness") = fmin(fmax(sqrt(from->alpha), 1e-3), 1);
    }
}

/* Sets a material of the nearest kind. */
static koksma_status set_material(koksma__import *im, koksma__text_place place, const koksma__import_material *from,
                                  koksma__material *m)
{
    static const koksma__bsdf *const kinds[] = {[KOKSMA__MATTE] = &koksma__bsdf_lambert,
                                                [KOKSMA__METAL] = &koksma__bsdf_ggx,
                                                [KOKSMA__GLASS] = &koksma__bsdf_dielectric,
                                                [KOKSMA__COATED] = &koksma__bsdf_utah};
    if (from->kind == KOKSMA__METAL && from->has_index) {
        set_conductor(from, m);
        return KOKSMA_OK;
    }
    m->bsdf = from->kind == KOKSMA__METAL && from->alpha < 1e-6   ? &koksma__bsdf_mirror
              : from->kind == KOKSMA__GLASS && from->alpha > 1e-6 ? &koksma__bsdf_rough_dielectric
                                                                  : kinds[from->kind];
    switch (from->kind) {
    case KOKSMA__METAL:
        memcpy(koksma__material_value(m, "reflectance"), from->colour.rgb, sizeof from->colour.rgb);
        clamp_albedo(koksma__material_value(m, "reflectance"));
        if (m->bsdf == &koksma__bsdf_ggx) {
            *koksma__material_value(m, "roughness") = fmin(fmax(sqrt(from->alpha), 1e-3), 1);
        }
        return KOKSMA_OK;
    case KOKSMA__GLASS: {
        double *tint = koksma__material_value(m, "tint");
        tint[0] = tint[1] = tint[2] = 1;
        *koksma__material_value(m, "ior") = fmin(fmax(from->ior, 1.0001), 10);
        if (m->bsdf == &koksma__bsdf_rough_dielectric) {
            *koksma__material_value(m, "roughness") = fmin(fmax(sqrt(from->alpha), 0.03), 1);
        }
        return KOKSMA_OK;
    }
    case KOKSMA__COATED:
        return set_coated(im, place, from, m);
    default:
        return set_colour(im, place, &from->colour, m);
    }
}

koksma_status koksma__import_add_material(koksma__import *im, koksma__text_place place,
                                          const koksma__import_material *from, int *out)
{
    koksma__material m = {0};
    KOKSMA__TRY(set_material(im, place, from, &m));
    return keep_material(im, place, &m, out);
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

/* Makes the Lambert surface whose albedo goes from that of `first` to that of `second` as the image or checkerboard
   `amount` goes from 0 to 1. */
static koksma_status mix_albedos(koksma__import *im, koksma__text_place place, const koksma__material *first,
                                 const koksma__material *second, const koksma__import_colour *amount, int *out)
{
    koksma__material mixed = {.bsdf = &koksma__bsdf_lambert};
    koksma__import_colour c = *amount;
    use_as_number(im, &c);
    koksma__import_between(&c, first->albedo[0], second->albedo[0]);
    KOKSMA__TRY(set_colour(im, place, &c, &mixed));
    return keep_material(im, place, &mixed, out);
}

koksma_status koksma__import_mix(koksma__import *im, koksma__text_place place, int first, int second,
                                 koksma__import_colour *amount, int *out)
{
    const koksma__material *all = im->scene->materials;
    const bool both = first >= 0 && second >= 0, varies = *amount->image || amount->is_checker;
    *out = first;
    if (first == second) {
        return KOKSMA_OK;
    }
    if (both && varies && is_plain(&all[first]) && is_plain(&all[second])) {
        return mix_albedos(im, place, &all[first], &all[second], amount, out);
    }
    KOKSMA__TRY(koksma__import_mean(im, place, "the amount of a mix", KOKSMA__REFLECTANCE, amount));
    const double share = amount->rgb[0];
    if (share <= 0 || share >= 1) {
        *out = share <= 0 ? first : second;
        return KOKSMA_OK;
    }
    if (both) {
        koksma__material mixed = all[first];
        if (blend_materials(&mixed, &all[second], share)) {
            return keep_material(im, place, &mixed, out);
        }
    }
    *out = share < 0.5 ? first : second;
    return koksma__import_unknown(im, place,
                                  "a mix of different materials is replaced by the one with the larger share");
}

koksma_status koksma__import_mask(koksma__import *im, koksma__text_place place, koksma__import_colour *opacity,
                                  int *material)
{
    if (*material < 0) {
        return KOKSMA_OK;
    }
    koksma__material m = im->scene->materials[*material];
    koksma__map *map = &m.maps[KOKSMA__MAP_ALPHA];
    if (opacity->is_checker || map->image) {
        KOKSMA__TRY(koksma__import_mean(im, place, "an opacity", KOKSMA__REFLECTANCE, opacity));
    }
    m.alpha = (m.see_through ? m.alpha : 1) * fmin(fmax(opacity->rgb[0], 0), 1);
    if (*opacity->image) {
        m.alpha = 1;
        use_as_number(im, opacity);
        KOKSMA__TRY(find_image(im, place, opacity, &map->image));
        map->mapping = opacity->mapping;
    }
    m.see_through = m.alpha < 1 || map->image;
    if (m.alpha <= 0) {
        *material = -1;
        return KOKSMA_OK;
    }
    return keep_material(im, place, &m, material);
}

koksma_status koksma__import_glow(koksma__import *im, koksma__text_place place, const koksma__import_colour *radiance,
                                  koksma__import_surface *surface)
{
    koksma__material m = {.bsdf = &koksma__bsdf_lambert};
    if (!*radiance->image) {
        return KOKSMA_OK;
    }
    if (surface->material >= 0) {
        m = im->scene->materials[surface->material];
    }
    koksma__map *map = &m.maps[KOKSMA__MAP_EMISSION];
    KOKSMA__TRY(find_image(im, place, radiance, &map->image));
    map->mapping = radiance->mapping;
    for (int k = 0; k < 3; k++) {
        surface->radiance[k] = map->image ? radiance->image_scale : radiance->rgb[k];
    }
    return map->image ? keep_material(im, place, &m, &surface->material) : KOKSMA_OK;
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

koksma_status koksma__import_light(koksma__import *im, koksma__text_place place, const koksma__light *light)
{
    koksma__light *to = NULL;
    for (int k = 0; k < 3; k++) {
        if (!(fabs(light->centre[k]) <= FAR)) {
            return koksma__import_fail(place, "a light beyond 1e6");
        }
    }
    if (light->kind == &koksma__light_environment && has_environment(im->scene)) {
        return koksma__import_unknown(im, place, "the scene has a second environment, which is left out");
    }
    const koksma_status status = koksma__scene_add_light(im->scene, &to);
    if (status) {
        return koksma__import_fail_at(place, status);
    }
    *to = *light;
    koksma__import_radiance(im, to->radiance);
    return KOKSMA_OK;
}

/* Checks the matrix by which an environment is turned, or its inverse: with entries that are not too large, except for
   those that move, directions keep a length that is finite and above 0. */
static koksma_status check_turn(koksma__text_place place, const double matrix[12])
{
    for (int i = 0; i < 12; i++) {
        if (i % 4 < 3 && !(fabs(matrix[i]) <= 1e9)) {
            return koksma__import_fail(place,
                                       "the matrix of an environment, or its inverse, has an entry beyond 1e9");
        }
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

koksma_status koksma__import_sky(koksma__import *im, koksma__text_place place, const char *name, double illuminance,
                                 const double scale[3], const double matrix[12])
{
    char full[KOKSMA__MAX_PATH];
    koksma_image image = {0}, turned = {0};
    double inverse[12];
    koksma__light light = {.kind = &koksma__light_environment, .visible = true};
    if (has_environment(im->scene)) { /* the image of a second one, which may be large, is not read */
        return koksma__import_light(im, place, &light);
    }
    KOKSMA__TRY(koksma__import_path(im, place, name, full));
    memcpy(light.radiance, scale, sizeof light.radiance);
    koksma_status status = koksma__image_read(full, KOKSMA__FILE_TEXTURE, KOKSMA__BY_FILE, &image);
    status = status ? status : koksma__image_check(&image, full);
    KOKSMA__TRY(koksma__import_unknown_if(!status && *koksma_image_remark(), im, place, "%s", koksma_image_remark()));
    if (status) {
        koksma_image_fini(&image);
        KOKSMA__TRY(leave_out(im, place, status));
        return koksma__import_light(im, place, &light);
    }
    const double own = illuminance > 0 ? map_illuminance(&image) : 0;
    for (int k = 0; own > 0 && k < 3; k++) {
        light.radiance[k] *= illuminance / own;
    }
    status = koksma__import_invert(matrix, inverse)
                 ? check_turn(place, matrix)
                 : koksma__import_fail(place, "the matrix of an environment has no inverse");
    status = status ? status : check_turn(place, inverse);
    status =
        status ? status : koksma__import_fail_at(place, koksma__sky_turn(&image, !im->rows_down, inverse, &turned));
    status =
        status ? status : koksma__import_fail_at(place, koksma__scene_image_keep(im->scene, &turned, &light.image));
    koksma_image_fini(&image);
    koksma_image_fini(&turned);
    return status ? status : koksma__import_light(im, place, &light);
}

koksma_status koksma__import_spot(koksma__text_place place, const double direction[3], double inner_deg,
                                  double outer_deg, int falloff, koksma__light *light)
{
    light->kind = &koksma__light_spot;
    memcpy(light->normal, direction, sizeof light->normal);
    if (!koksma__import_normalise(light->normal)) {
        return koksma__import_fail(place, "a spot without a direction");
    }
    if (!(outer_deg > 0 && outer_deg <= 90)) {
        return koksma__import_fail(place, "the angle of a spot's cone must be above 0 and at most 90 degrees");
    }
    inner_deg = fmin(fmax(inner_deg, 0), outer_deg);
    light->values[0] = outer_deg; /* angle_deg and edge */
    light->values[1] = 1 - inner_deg / outer_deg;
    light->values[2] = falloff;
    return KOKSMA_OK;
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

koksma_status koksma__import_look_at(koksma__text_place place, const char *name, const double eye[3],
                                     const double target[3], const double up[3], double m[12])
{
    double ahead[3], across[3], over[3];
    koksma__subtract(target, eye, ahead);
    if (!koksma__import_normalise(ahead)) {
        return koksma__import_fail(place, "%s: there is no direction from the eye to its target", name);
    }
    koksma__cross(up, ahead, across);
    if (!koksma__import_normalise(across)) {
        return koksma__import_fail(place, "%s: up is along the line of sight", name);
    }
    koksma__cross(ahead, across, over);
    for (int k = 0; k < 3; k++) {
        m[4 * k] = across[k], m[4 * k + 1] = over[k], m[4 * k + 2] = ahead[k], m[4 * k + 3] = eye[k];
    }
    return KOKSMA_OK;
}

koksma_status koksma__import_camera(koksma__import *im, koksma__text_place place, const double m[12], double right,
                                    const koksma__camera *lens)
{
    koksma__camera *c = &im->scene->camera;
    *c = *lens;
    c->height *= sqrt(m[1] * m[1] + m[5] * m[5] + m[9] * m[9]);
    c->lens_map = koksma_warp_find("concentric-disk");
    c->shutter[1] = 1;
    for (int k = 0; k < 3; k++) {
        c->eye[k] = m[4 * k + 3];
        c->right[k] = right * m[4 * k];
        c->down[k] = -m[4 * k + 1];
        c->forward[k] = m[4 * k + 2];
        if (!(fabs(c->eye[k]) <= FAR)) {
            return koksma__import_fail(place, "the camera's position is beyond 1e6");
        }
    }
    if (!koksma__import_normalise(c->right) || !koksma__import_normalise(c->down) ||
        !koksma__import_normalise(c->forward)) {
        return koksma__import_fail(place, "the camera's matrix has no inverse");
    }
    c->by_degrees = true;
    if (lens->height > 0 && !(c->height > TINY && c->height <= FAR)) {
        return koksma__import_fail(place, "the height that the camera shows must be 1e-6 to 1e6");
    }
    if (!(lens->height > 0) && !(c->fov_rad >= 1e-4 && c->fov_rad < 3.13)) {
        return koksma__import_fail(place, "the camera's angle of view must be above 0 and below 180 degrees");
    }
    if (!(c->lens_radius >= 0 && c->lens_radius <= FAR && c->focus_distance > TINY && c->focus_distance <= FAR)) {
        return koksma__import_fail(place, "the lens's radius must be 0 to 1e6, its focus distance 1e-6 to 1e6");
    }
    return KOKSMA_OK;
}
