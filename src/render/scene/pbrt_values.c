/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Converts pbrt-v4's parameters. Spectra become red, green and blue: rgb values are used as they are, black bodies by
 * their chromaticity, metals by a table of names, and sampled spectra by the CIE 1931 observer (import_spectrum.c), as
 * reflectance, emission or unbounded value, whichever pbrt takes them for; emission has luminance 1, as pbrt scales it.
 * A texture becomes a colour, an image or a checkerboard; textures that combine others become the mean colour.
 * The file is long because all of pbrt's parameters are in one place.
 */
#include "scene/pbrt.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "meshes/mesh.h"
#include "render/fields.h"
#include "render/materials/materials.h"

enum {
    MOST_DIVIDED = 1 << 21, /* largest number of triangles that subdivision may make in a scene */
    DIVIDED_BYTES = 80,     /* what subdivision takes in passing for each of them */
    MOST_TEXTURES = 1 << 16 /* each takes 5 KB, for the path of its image */
};

#define WITHIN "a texture within another"

struct koksma__pbrt_named {
    char name[256];
    int material;
};

struct koksma__pbrt_named_texture {
    char spectrum[64]; /* its value, if that is the name of a spectrum: what it means depends on the texture's use */
    koksma__import_colour colour;
};

void koksma__pbrt_scene_fini(koksma__pbrt_scene *scene)
{
    for (size_t i = 0; i < scene->n_texts; i++) {
        free(scene->texts[i]);
    }
    KOKSMA__FREE(scene->texts, scene->materials, scene->textures);
    koksma__names_fini(&scene->material_names);
    koksma__names_fini(&scene->texture_names[0]);
    koksma__names_fini(&scene->texture_names[1]);
}

/* ---- Colours ------------------------------------------------------------------------------------------------ */

static void grey(double value, double rgb[3])
{
    rgb[0] = rgb[1] = rgb[2] = value;
}

/* Converts pairs of wavelength and value to a colour; an emission is divided by its luminance, as in pbrt. */
static koksma_status sampled(koksma__import *im, koksma__text_place place, const double *pairs, size_t n,
                             koksma__spectrum_use use, double rgb[3])
{
    koksma__sampled_spectrum s = {0};
    KOKSMA__TRY(koksma__import_spend(im, place, KOKSMA__SPECTRUM_STEPS + n / 2));
    for (size_t i = 0; i + 1 < n; i += 2) {
        if (!koksma__sampled_spectrum_add(&s, pairs[i], pairs[i + 1])) {
            return koksma__import_fail(place, "wavelengths of a spectrum must increase");
        }
    }
    koksma__sampled_spectrum_colour(&s, use, rgb);
    if (use != KOKSMA__EMISSION) {
        return KOKSMA_OK;
    }
    const double luminance = 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
    for (int k = 0; k < 3; k++) {
        rgb[k] = luminance > 0 ? rgb[k] / luminance : 0;
    }
    return KOKSMA_OK;
}

/* Reads a named spectrum: of a light, the CIE's illuminants A, which is a black body, and D65, which is white here. With
   a warning, "metal-Au-eta" and similar names give the metal's reflectance, others white. */
static koksma_status named_spectrum(koksma__pbrt_scene *scene, koksma__text_place place, const char *name,
                                    koksma__spectrum_use use, double rgb[3])
{
    char metal[16] = "";
    grey(1, rgb);
    if (use == KOKSMA__EMISSION && !strcmp(name, "stdillum-A")) {
        koksma__import_black_body(2856, rgb);
        return KOKSMA_OK;
    }
    if (use == KOKSMA__EMISSION && !strcmp(name, "stdillum-D65")) {
        return KOKSMA_OK;
    }
    if (!strncmp(name, "metal-", 6)) {
        snprintf(metal, sizeof metal, "%.*s", (int)strcspn(name + 6, "-"), name + 6);
    }
    return koksma__import_unknown(scene->im, place, "spectrum '%s' is replaced by %s", name,
                                  koksma__import_metal(metal, rgb) ? "the metal's reflectance" : "white");
}

/* Finds a texture among those of type "float", or else "spectrum". pbrt refuses one of the other type. */
static koksma_status find_texture(koksma__pbrt_scene *scene, koksma__text_place place,
                                  const koksma__pbrt_parameter *p, bool is_float,
                                  const struct koksma__pbrt_named_texture **out)
{
    static const char *const types[] = {"spectrum", "float"};
    size_t i;
    if (!koksma__names_find(&scene->texture_names[is_float], p->text, strlen(p->text), &i)) {
        if (!koksma__names_find(&scene->texture_names[!is_float], p->text, strlen(p->text), &i)) {
            return koksma__import_fail(place, "%s: no texture '%s'", p->name, p->text);
        }
        KOKSMA__TRY(koksma__import_unknown(scene->im, place, "%s: the %s texture '%s' stands for a %s texture",
                                           p->name, types[!is_float], p->text, types[is_float]));
    }
    *out = &scene->textures[i];
    return KOKSMA_OK;
}

static koksma_status colour_of(koksma__pbrt_scene *scene, koksma__text_place place, const koksma__pbrt_parameter *p,
                               koksma__spectrum_use use, bool is_float, koksma__import_colour *out)
{
    if (!strcmp(p->type, "texture")) {
        const struct koksma__pbrt_named_texture *texture = NULL;
        KOKSMA__TRY(find_texture(scene, place, p, is_float, &texture));
        *out = texture->colour;
        return *texture->spectrum ? named_spectrum(scene, place, texture->spectrum, use, out->rgb) : KOKSMA_OK;
    }
    *out->image = 0;
    out->is_checker = false;
    if (!koksma__pbrt_is(p, "float rgb color spectrum blackbody")) {
        return koksma__import_fail(place, "%s: a '%s' is not a colour", p->name, p->type);
    }
    if (p->n_texts == 1) {
        return named_spectrum(scene, place, p->text, use, out->rgb);
    }
    if (!strcmp(p->type, "blackbody") && p->n == 1) {
        if (!(p->numbers[0] > 0)) { /* in pbrt such a light is NaN everywhere */
            return koksma__import_fail(place, "%s: a temperature of %g kelvins; it must be above 0", p->name,
                                       p->numbers[0]);
        }
        koksma__import_black_body(p->numbers[0], out->rgb);
        return KOKSMA_OK;
    }
    if (!strcmp(p->type, "spectrum") && p->n) {
        return sampled(scene->im, place, p->numbers, p->n, use, out->rgb);
    }
    if (p->n != (koksma__pbrt_is(p, "rgb color") ? 3 : 1)) {
        return koksma__import_fail(place, "%s: more than one colour", p->name);
    }
    bool beyond = false;
    for (size_t k = 0; k < 3; k++) {
        out->rgb[k] = p->numbers[p->n == 3 ? k : 0];
        beyond |= !(out->rgb[k] >= 0 && out->rgb[k] <= 1);
    }
    return koksma__import_unknown_if(beyond && use == KOKSMA__REFLECTANCE && !is_float, scene->im, place,
                                     "%s: a reflectance beyond 0 to 1 is clamped; pbrt refuses it", p->name);
}

/* Reads the colour or texture with this name; without one, *out is grey with the value `otherwise`. */
static koksma_status read_colour(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *name,
                                 double otherwise, koksma__spectrum_use use, bool is_float,
                                 koksma__import_colour *out)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find(p, name);
    *out = (koksma__import_colour){.period = 1};
    grey(otherwise, out->rgb);
    return found ? colour_of(scene, p->place, found, use, is_float, out) : KOKSMA_OK;
}

static koksma_status find_colour(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *name,
                                 double otherwise, koksma__import_colour *out)
{
    return read_colour(scene, p, name, otherwise, KOKSMA__REFLECTANCE, false, out);
}

koksma_status koksma__pbrt_emission(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *name,
                                    double rgb[3])
{
    koksma__import_colour colour;
    KOKSMA__TRY(read_colour(scene, p, name, 1, KOKSMA__EMISSION, false, &colour));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, "a light's texture", KOKSMA__EMISSION, &colour));
    for (int k = 0; k < 3; k++) {
        rgb[k] = colour.rgb[k] * koksma__pbrt_number(p, "scale") * scene->exposure;
    }
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_coefficient(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *name,
                                       double rgb[3])
{
    koksma__import_colour colour;
    KOKSMA__TRY(read_colour(scene, p, name, 1, KOKSMA__UNBOUNDED, false, &colour));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, "a medium's texture", KOKSMA__UNBOUNDED, &colour));
    for (int k = 0; k < 3; k++) {
        const double value = colour.rgb[k] * koksma__pbrt_number(p, "scale");
        if (!(value >= 0)) {
            return koksma__import_fail(p->place, "%s: a coefficient of %g; it must be 0 or more", name, value);
        }
        rgb[k] = fmin(value, FAR);
    }
    return KOKSMA_OK;
}

/* ---- Textures ------------------------------------------------------------------------------------------------ */

/* Textures are not clamped: the same one may be a reflectance, which is clamped where it is used, or eta and k of a
   metal. */
static koksma_status find_texture_colour(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p,
                                         const char *name, double otherwise, bool is_float,
                                         koksma__import_colour *out)
{
    return read_colour(scene, p, name, otherwise, KOKSMA__UNBOUNDED, is_float, out);
}

static void mean_of(const koksma__import_colour *a, const koksma__import_colour *b, double rgb[3])
{
    for (int k = 0; k < 3; k++) {
        rgb[k] = (a->rgb[k] + b->rgb[k]) / 2;
    }
}

static koksma_status check_mapping(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p)
{
    const char *mapping = koksma__pbrt_word(p, "mapping");
    return koksma__import_unknown_if(*mapping && strcmp(mapping, "uv"), scene->im, p->place,
                                     "a texture's mapping '%.40s' is replaced by 'uv'", mapping);
}

/* Reads how an image is mapped: (u, v) are scaled, then moved; and what lies beyond it. */
static koksma_status set_mapping(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p,
                                 koksma__import_colour *c)
{
    koksma__mapping *to = &c->mapping;
    const double scale[2] = {koksma__pbrt_number(p, "uscale"), koksma__pbrt_number(p, "vscale")};
    const double move[2] = {koksma__pbrt_number(p, "udelta"), koksma__pbrt_number(p, "vdelta")};
    const char *wrap = koksma__pbrt_word(p, "wrap");
    KOKSMA__TRY(koksma__import_check_uv(p->place, scale, 2));
    KOKSMA__TRY(koksma__import_check_uv(p->place, move, 2));
    KOKSMA__TRY(check_mapping(scene, p));
    if (!strcmp(wrap, "clamp")) {
        to->wrap[0] = to->wrap[1] = KOKSMA__WRAP_CLAMP;
    } else if (*wrap && strcmp(wrap, "repeat") && strcmp(wrap, "black")) {
        KOKSMA__TRY(
            koksma__import_unknown(scene->im, p->place, "a texture's wrap '%.40s' is replaced by 'repeat'", wrap));
    }
    c->use.border = !strcmp(wrap, "black");
    to->nearest = !strcmp(koksma__pbrt_word(p, "filter"), "point");
    to->moved = scale[0] != 1 || scale[1] != 1 || move[0] != 0 || move[1] != 0;
    for (int k = 0; k < 2; k++) {
        to->matrix[4 * k] = (float)scale[k];
        to->matrix[3 * k + 2] = (float)move[k];
    }
    return KOKSMA_OK;
}

static koksma_status read_constant(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                                   struct koksma__pbrt_named_texture *to)
{
    const koksma__pbrt_parameter *value = koksma__pbrt_find(p, "value");
    if (value && !strcmp(value->type, "spectrum") && value->n_texts == 1 && *value->text) {
        snprintf(to->spectrum, sizeof to->spectrum, "%.63s", value->text);
        return KOKSMA_OK;
    }
    return find_texture_colour(scene, p, "value", 1, is_float, &to->colour);
}

/* Reads what the levels of an image mean: only of PNG the encoding can be chosen; JPEG is sRGB; other files hold linear
   numbers. A level v becomes scale v, or 1 - scale v if it is inverted, and at least 0. */
static koksma_status set_levels(const koksma__pbrt_parameters *p, bool is_float, koksma__import_colour *c)
{
    const char *given = koksma__pbrt_word(p, "encoding"), *encoding = *given ? given : "sRGB",
               *dot = strrchr(c->image, '.');
    const double scale = koksma__pbrt_number(p, "scale");
    const bool invert = koksma__pbrt_flag(p, "invert"), png = dot && !strcasecmp(dot, ".png");
    c->has_use = true;
    c->use.part = KOKSMA__IMAGE_SRGB;
    c->use.average = is_float ? KOKSMA__MEAN : KOKSMA__NO_AVERAGE;
    char *end = NULL;
    const double gamma = strncmp(encoding, "gamma ", 6) ? 0 : koksma__strtod(encoding + 6, &end);
    if (strcmp(encoding, "sRGB") && strcmp(encoding, "linear") && !(end && !*end && gamma > 0 && gamma < 100)) {
        return koksma__import_fail(p->place, "encoding: '%.40s' is not sRGB, linear or gamma X", encoding);
    }
    if (png && strcmp(encoding, "sRGB")) {
        c->use.part = KOKSMA__IMAGE_NUMBERS;
        c->use.gamma = gamma;
    }
    for (int k = 0; k < 3; k++) {
        c->use.tint[k] = invert ? -scale : scale;
        c->use.plus[k] = invert;
    }
    return KOKSMA_OK;
}

/* Whether levels of an image that are at least 0 stay so when they are multiplied by a colour. */
static bool is_positive(const double rgb[3])
{
    return rgb[0] >= 0 && rgb[1] >= 0 && rgb[2] >= 0;
}

static bool is_one_colour(const koksma__import_colour *c)
{
    return !*c->image && !c->is_checker;
}

/* Blends two textures by an amount that does not vary: exactly if at most one of them is an image, and if checkerboards
   have squares of one size. */
static koksma_status blend(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, double amount,
                           koksma__import_colour *c, koksma__import_colour *other)
{
    if (amount <= 0 || amount >= 1) {
        *c = amount <= 0 ? *c : *other;
        return KOKSMA_OK;
    }
    const bool checkers = c->is_checker && other->is_checker && !memcmp(&c->period, &other->period, sizeof c->period);
    if (!is_one_colour(c) && !is_one_colour(other) && !checkers) {
        KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, other));
    }
    if (!is_one_colour(other) && is_one_colour(c)) { /* the same the other way round */
        const koksma__import_colour first = *c;
        *c = *other;
        *other = first;
        amount = 1 - amount;
    }
    const double keep[3] = {1 - amount, 1 - amount, 1 - amount};
    double more[3], second[3];
    for (int k = 0; k < 3; k++) {
        more[k] = amount * other->rgb[k];
        second[k] = c->second[k];
    }
    koksma__import_affine(c, keep, more);
    for (int k = 0; other->is_checker && k < 3; k++) {
        c->second[k] = keep[k] * second[k] + amount * other->second[k];
    }
    return KOKSMA_OK;
}

/* Reads a mix: (1 - amount) tex1 + amount tex2. With an amount that varies, it is exact between two colours. */
static koksma_status read_mix(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                              koksma__import_colour *c)
{
    koksma__import_colour second, amount;
    KOKSMA__TRY(find_texture_colour(scene, p, "tex1", 0, is_float, c));
    KOKSMA__TRY(find_texture_colour(scene, p, "tex2", 1, is_float, &second));
    KOKSMA__TRY(find_texture_colour(scene, p, "amount", 0.5, true, &amount));
    if (!is_one_colour(&amount) && is_one_colour(c) && is_one_colour(&second)) {
        const koksma__import_colour first = *c;
        *c = amount;
        koksma__import_between(c, first.rgb, second.rgb);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, "the amount of a mix", KOKSMA__REFLECTANCE, &amount));
    return blend(scene, p, amount.rgb[0], c, &second);
}

/* Reads the product of two textures, of which the second is of type "float". A product has no order: one colour times a
   checkerboard is a checkerboard. */
static koksma_status read_scaled(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                                 koksma__import_colour *c)
{
    koksma__import_colour by;
    KOKSMA__TRY(find_texture_colour(scene, p, "tex", 1, is_float, c));
    KOKSMA__TRY(find_texture_colour(scene, p, "scale", 1, true, &by));
    if (is_one_colour(c)) {
        const koksma__import_colour first = *c;
        *c = by;
        by = first;
    }
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, "the scale of a texture", KOKSMA__UNBOUNDED, &by));
    if (*c->image && !is_positive(by.rgb)) {
        return koksma__import_unknown(scene->im, p->place,
                                      "an image times a negative colour is replaced by the image");
    }
    koksma__import_affine(c, by.rgb, (const double[3]){0});
    return KOKSMA_OK;
}

static koksma_status read_checkerboard(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                                       koksma__import_colour *c)
{
    koksma__import_colour second;
    KOKSMA__TRY(find_texture_colour(scene, p, "tex1", 1, is_float, c));
    KOKSMA__TRY(find_texture_colour(scene, p, "tex2", 0, is_float, &second));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, c));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, &second));
    KOKSMA__TRY(check_mapping(scene, p));
    c->is_checker = true;
    memcpy(c->second, second.rgb, sizeof c->second);
    const double u = koksma__pbrt_number(p, "uscale"), v = koksma__pbrt_number(p, "vscale");
    KOKSMA__TRY(koksma__import_check_uv(p->place, &u, 1));
    c->period = 1 / fmax(fabs(u), 1e-6); /* turned by 180 degrees, the squares are where they were */
    KOKSMA__TRY(fabs(u) > 1e-6 ? KOKSMA_OK
                               : koksma__import_unknown(scene->im, p->place,
                                                        "a checkerboard's uscale of %g is replaced by 1e-6", u));
    return koksma__import_unknown_if(u != v, scene->im, p->place, "a checkerboard's vscale is replaced by uscale");
}

static koksma_status read_texture(koksma__pbrt_scene *scene, const char *kind, bool is_float,
                                  const koksma__pbrt_parameters *p, struct koksma__pbrt_named_texture *to)
{
    koksma__import_colour first, second, *c = &to->colour;
    if (!strcmp(kind, "imagemap")) {
        KOKSMA__TRY(koksma__import_path(scene->im, p->place, koksma__pbrt_word(p, "filename"), c->image));
        KOKSMA__TRY(set_mapping(scene, p, c));
        c->image_scale = 1;
        return set_levels(p, is_float, c);
    }
    if (!strcmp(kind, "mix")) {
        return read_mix(scene, p, is_float, c);
    }
    if (!strcmp(kind, "constant")) {
        return read_constant(scene, p, is_float, to);
    }
    if (!strcmp(kind, "scale")) {
        return read_scaled(scene, p, is_float, c);
    }
    if (!strcmp(kind, "checkerboard") && koksma__pbrt_whole(p, "dimension") == 2) {
        return read_checkerboard(scene, p, is_float, c);
    }
    KOKSMA__TRY(koksma__import_unknown(scene->im, p->place, "texture '%s' is replaced by one colour", kind));
    KOKSMA__TRY(find_texture_colour(scene, p, "tex1", 0.5, is_float, &first));
    KOKSMA__TRY(find_texture_colour(scene, p, "tex2", 0.5, is_float, &second));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, &first));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, &second));
    mean_of(&first, &second, c->rgb);
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_texture(koksma__pbrt_scene *scene, const char *name, const char *type, const char *kind,
                                   const koksma__pbrt_parameters *p)
{
    const bool is_float = !strcmp(type, "float");
    if (!is_float && strcmp(type, "spectrum") != 0) {
        return koksma__import_fail(p->place, "'%s' is not a type of textures; 'float' and 'spectrum' are%s", type,
                                   strcmp(type, "color") ? "" : " ('color' of pbrt-v3 is 'spectrum')");
    }
    if (scene->n_textures == MOST_TEXTURES) {
        return koksma__import_fail(p->place, "more than %d textures", MOST_TEXTURES);
    }
    KOKSMA__TRY(
        koksma__import_hold(scene->im, p->place, sizeof(struct koksma__pbrt_named_texture) + KOKSMA__HELD_WITH_NAME));
    struct koksma__pbrt_named_texture *to = koksma__add_one(&scene->textures, &scene->n_textures, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    /* the texture is hidden until it is complete, so that its own parameters can't refer to it */
    scene->n_textures--;
    to->colour.period = 1;
    grey(0.5, to->colour.rgb);
    KOKSMA__TRY(read_texture(scene, kind, is_float, p, to));
    KOKSMA__TRY(koksma__names_put(&scene->texture_names[is_float], name, strlen(name), scene->n_textures));
    scene->n_textures++;
    return KOKSMA_OK;
}

/* ---- Materials ------------------------------------------------------------------------------------------------ */

/* The name of the spectrum that is the value of a parameter or of its texture; "" if it is something else. */
static const char *spectrum_name(const koksma__pbrt_scene *scene, const koksma__pbrt_parameter *p)
{
    size_t i;
    if (!strcmp(p->type, "texture")) {
        const bool found = koksma__names_find(&scene->texture_names[0], p->text, strlen(p->text), &i);
        return found ? scene->textures[i].spectrum : "";
    }
    return !strcmp(p->type, "spectrum") && p->n_texts == 1 ? p->text : "";
}

/* The metal whose eta or k (`suffix`) a parameter names, as "metal-Au-eta" does; a missing one is copper's, as in pbrt.
   "": the parameter is something else. */
static const char *named_metal(const koksma__pbrt_scene *scene, const koksma__pbrt_parameter *p, const char *suffix,
                               char name[16])
{
    double rgb[3];
    *name = 0;
    if (!p) {
        return "Cu";
    }
    const char *text = spectrum_name(scene, p);
    if (!strncmp(text, "metal-", 6)) {
        const size_t length = strcspn(text + 6, "-");
        snprintf(name, 16, "%.*s", (int)length, text + 6);
        if (strcmp(text + 6 + length, suffix) != 0 || !koksma__import_metal(name, rgb)) {
            *name = 0;
        }
    }
    return name;
}

/* Reads eta or k of a metal, if it is one colour: not a texture that varies, nor the name of a spectrum. */
static koksma_status take_constant(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p,
                                   const koksma__pbrt_parameter *from, bool *is_constant, double rgb[3])
{
    koksma__import_colour colour = {.period = 1};
    if (!from || *spectrum_name(scene, from) || (from->n_texts && strcmp(from->type, "texture") != 0)) {
        *is_constant = false;
        return KOKSMA_OK;
    }
    KOKSMA__TRY(colour_of(scene, p->place, from, KOKSMA__UNBOUNDED, false, &colour));
    *is_constant &= !*colour.image && !colour.is_checker;
    memcpy(rgb, colour.rgb, sizeof colour.rgb);
    return KOKSMA_OK;
}

static koksma_status metal(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *prefix,
                           koksma__import_material *m)
{
    char eta_name[40], k_name[40], of_eta[16], of_k[16];
    snprintf(eta_name, sizeof eta_name, "%seta", prefix);
    snprintf(k_name, sizeof k_name, "%sk", prefix);
    const koksma__pbrt_parameter *eta = koksma__pbrt_find(p, eta_name), *k = koksma__pbrt_find(p, k_name);
    m->kind = KOKSMA__METAL;
    if (koksma__pbrt_find(p, "reflectance")) {
        KOKSMA__TRY(find_colour(scene, p, "reflectance", 1, &m->colour));
        return koksma__import_mean(scene->im, p->place, "a metal's texture", KOKSMA__REFLECTANCE, &m->colour);
    }
    const char *name = named_metal(scene, eta, "-eta", of_eta), *other = named_metal(scene, k, "-k", of_k);
    double eta_rgb[3] = {0}, k_rgb[3] = {0};
    bool is_constant = true;
    KOKSMA__TRY(take_constant(scene, p, eta, &is_constant, eta_rgb));
    KOKSMA__TRY(take_constant(scene, p, k, &is_constant, k_rgb));
    if (is_constant) {
        koksma__import_fresnel(eta_rgb, k_rgb, m->colour.rgb);
        return KOKSMA_OK;
    }
    const bool agree = *name && !strcmp(name, other);
    name = eta && *name ? name : k && *other ? other : agree ? name : "Cr";
    koksma__import_metal(name, m->colour.rgb);
    return agree ? KOKSMA_OK
                 : koksma__import_unknown(scene->im, p->place,
                                          "eta and k of a metal that are not two colours, or names of one metal, are "
                                          "replaced by those of '%s'",
                                          name);
}

/* Sets GGX's alpha: the square root of the roughness, or the roughness itself if remaproughness is false. */
static koksma_status set_alpha(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, const char *prefix,
                               koksma__import_material *m)
{
    char name[40], u_name[40], v_name[40];
    snprintf(name, sizeof name, "%sroughness", prefix);
    snprintf(u_name, sizeof u_name, "%suroughness", prefix);
    snprintf(v_name, sizeof v_name, "%svroughness", prefix);
    const double both = koksma__pbrt_number(p, name);
    const double u = koksma__pbrt_find(p, u_name) ? koksma__pbrt_number(p, u_name) : both;
    const double v = koksma__pbrt_find(p, v_name) ? koksma__pbrt_number(p, v_name) : both;
    m->alpha = koksma__pbrt_flag(p, "remaproughness") ? sqrt(fmax(u * v, 0)) : fmax(u * v, 0);
    m->alpha = sqrt(m->alpha); /* the geometric mean of the widths along u and v */
    return koksma__import_unknown_if(u != v, scene->im, p->place, "anisotropic roughness is replaced by its mean");
}

/* Reads a mix, whose surface is of the second material with the probability `amount`. */
static koksma_status mix_materials(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, int *out)
{
    const koksma__pbrt_parameter *both = koksma__pbrt_find_typed(p, "materials", "string");
    koksma__import_colour share;
    int second = 0;
    if (!both || both->n_texts != 2) {
        return koksma__import_fail(p->place, "materials: a mix has the names of two materials");
    }
    KOKSMA__TRY(koksma__pbrt_find_material(scene, p->place, both->text, out));
    KOKSMA__TRY(koksma__pbrt_find_material(scene, p->place, both->second, &second));
    KOKSMA__TRY(find_texture_colour(scene, p, "amount", 0.5, true, &share));
    return koksma__import_mix(scene->im, p->place, *out, second, &share, out);
}

koksma_status koksma__pbrt_material(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                    int *out)
{
    const koksma__plugin *found = koksma__plugin_find(&koksma__pbrt_plugins, "Material", *type ? type : "none");
    const char *prefix = strcmp(type, "coatedconductor") ? "" : "conductor.", *row = found->parameters;
    char name[40] = "";
    koksma__entry first = {.type = NULL};
    koksma__import_material m = {.ior = 1.5};
    if (!strcmp(type, "mix")) {
        return mix_materials(scene, p, out);
    }
    KOKSMA__TRY(koksma__import_unknown_if(found->instead, scene->im, p->place, "material '%s': %s here%s", type,
                                          found->instead,
                                          koksma__pbrt_kind_meant("Material", type, (char[KOKSMA__OR_MEANT]){0})));
    KOKSMA__TRY(koksma__import_unknown_if(koksma__pbrt_find(p, "displacement") || koksma__pbrt_find(p, "normalmap"),
                                          scene->im, p->place, "displacement and normal maps are ignored"));
    *out = -1;
    if (found->makes == KOKSMA__NOTHING) {
        return KOKSMA_OK;
    }
    m.kind = (unsigned)found->makes;
    if (koksma__entry_next(&row, &first) &&
        !strncmp(first.type, "colour ", 7)) { /* the colour comes first in its row */
        snprintf(name, sizeof name, "%.*s", (int)first.length, first.name);
    }
    KOKSMA__TRY(m.kind == KOKSMA__METAL   ? metal(scene, p, prefix, &m)
                : m.kind == KOKSMA__GLASS ? KOKSMA_OK
                                          : find_colour(scene, p, name, 0.5, &m.colour));
    const bool refracts = m.kind == KOKSMA__GLASS || m.kind == KOKSMA__COATED;
    m.ior = refracts ? koksma__pbrt_number(p, "eta") : 1.5;
    m.ior = m.ior == 0 ? 1 : m.ior; /* as in pbrt */
    if (m.ior < 0) {
        return koksma__import_fail(p->place, "eta: an index of refraction of %g; it must be above 0", m.ior);
    }
    const koksma__pbrt_parameter *eta = refracts ? koksma__pbrt_find(p, "eta") : NULL;
    KOKSMA__TRY(koksma__import_unknown_if(eta && !koksma__pbrt_is(eta, "float integer"), scene->im, p->place,
                                          "the spectrum of a glass is replaced by the index 1.5"));
    KOKSMA__TRY(set_alpha(scene, p, prefix, &m));
    return koksma__import_add_material(scene->im, p->place, &m, out);
}

koksma_status koksma__pbrt_name_material(koksma__pbrt_scene *scene, const char *name,
                                         const koksma__pbrt_parameters *p)
{
    int material = -1;
    KOKSMA__TRY(koksma__pbrt_material(scene, koksma__pbrt_word(p, "type"), p, &material));
    KOKSMA__TRY(koksma__import_hold(scene->im, p->place, sizeof(struct koksma__pbrt_named) + KOKSMA__HELD_WITH_NAME));
    struct koksma__pbrt_named *to = koksma__add_one(&scene->materials, &scene->n_materials, sizeof *to);
    KOKSMA__TRY(to ? KOKSMA_OK : KOKSMA_MEMORY);
    snprintf(to->name, sizeof to->name, "%s", name);
    to->material = material;
    return koksma__names_put(&scene->material_names, to->name, strlen(to->name), scene->n_materials - 1);
}

koksma_status koksma__pbrt_find_material(koksma__pbrt_scene *scene, koksma__text_place place, const char *name,
                                         int *out)
{
    size_t i;
    if (koksma__names_find(&scene->material_names, name, strlen(name), &i)) {
        *out = scene->materials[i].material;
        return KOKSMA_OK;
    }
    return koksma__import_fail(place, "material '%s' is not defined before this use", name);
}

/* ---- Shapes ---------------------------------------------------------------------------------------------------- */

/* Copies the numbers of a parameter, which must exist and have `each` numbers for every vertex. */
static koksma_status take_floats(const koksma__pbrt_parameters *p, const char *name, size_t each, size_t n, float *to)
{
    const koksma__pbrt_parameter *from = koksma__pbrt_find(p, name);
    if (!from || from->n != each * n) {
        return koksma__import_fail(p->place, "%s: %zu numbers for %zu vertices", name, from ? from->n : 0, n);
    }
    for (size_t i = 0; i < from->n; i++) {
        to[i] = (float)from->numbers[i];
    }
    return KOKSMA_OK;
}

/* Reads the triangles of a mesh from its vertex indices; a quadrilateral has four indices and becomes two
   triangles. */
static koksma_status take_indices(const koksma__pbrt_parameters *p, const koksma__pbrt_parameter *indices, bool quads,
                                  koksma__mesh *mesh)
{
    static const size_t corners[6] = {0, 1, 3, 0, 3, 2};
    for (size_t i = 0; i < 3 * mesh->n_triangles; i++) {
        const size_t at = quads ? i / 6 * 4 + corners[i % 6] : i;
        const double index = indices ? indices->numbers[at] : (double)at;
        if (!(index >= 0 && index < (double)mesh->n_vertices)) {
            return koksma__import_fail(p->place, "indices: there is no vertex %.15g; the mesh has %zu", index,
                                       mesh->n_vertices);
        }
        mesh->indices[i] = (uint32_t)index;
    }
    return KOKSMA_OK;
}

static koksma_status fill_mesh(const koksma__pbrt_parameters *p, const char *uv, bool quads, koksma__mesh *mesh)
{
    const koksma__pbrt_parameter *points = koksma__pbrt_find_typed(p, "P", "point3 point"),
                                 *indices = koksma__pbrt_find_typed(p, "indices", "integer");
    const size_t n = points ? points->n / 3 : 0, each = quads ? 4 : 3;
    if (!n || (!indices && n != each)) {
        return koksma__import_fail(p->place, "a mesh needs 'P', and 'indices' if it has more than one face");
    }
    if (indices && indices->n % each) {
        return koksma__import_fail(p->place, "indices: %zu numbers, but each face has %zu", indices->n, each);
    }
    const size_t faces = indices ? indices->n / each : 1;
    const bool normals = koksma__pbrt_find_typed(p, "N", "normal normal3");
    KOKSMA__TRY(koksma__mesh_init(n, faces * (quads ? 2 : 1), normals, *uv != 0, mesh));
    KOKSMA__TRY(take_floats(p, "P", 3, n, mesh->vertices));
    KOKSMA__TRY(normals ? take_floats(p, "N", 3, n, mesh->normals) : KOKSMA_OK);
    KOKSMA__TRY(*uv ? take_floats(p, uv, 2, n, mesh->uvs) : KOKSMA_OK);
    return take_indices(p, indices, quads, mesh);
}

/* Divides a mesh as often as its parameter `levels` says, or less often if the scene would get more than MOST_DIVIDED
   triangles by subdivision. */
static koksma_status divide(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, koksma__mesh *mesh)
{
    koksma__mesh fine = {0};
    const double asked = koksma__pbrt_whole(p, "levels");
    const size_t left = scene->n_divided < MOST_DIVIDED ? MOST_DIVIDED - scene->n_divided : 0;
    int levels = 0;
    if (koksma__mesh_check(mesh)) {
        return KOKSMA_OK; /* koksma__import_mesh() leaves the mesh out, with a warning */
    }
    while (levels < asked && mesh->n_triangles << 2 * (levels + 1) <= left) {
        levels++;
    }
    KOKSMA__TRY(koksma__import_unknown_if(levels < asked, scene->im, p->place,
                                          "shape 'loopsubdiv' is divided %d times only", levels));
    scene->n_divided += mesh->n_triangles << 2 * levels;
    const uint64_t passing = ((uint64_t)mesh->n_triangles << 2 * levels) * DIVIDED_BYTES;
    KOKSMA__TRY(koksma__import_hold(scene->im, p->place, passing));
    const koksma_status status = koksma__mesh_loop(mesh, levels, &fine);
    scene->im->held -= passing;
    if (status) {
        koksma__mesh_fini(&fine);
        return koksma__import_fail_at(p->place, status);
    }
    koksma__mesh_fini(mesh);
    *mesh = fine;
    return KOKSMA_OK;
}

/* Whether a surface has an image or a checkerboard. */
static bool is_textured(const koksma__import *im, const koksma__import_surface *surface)
{
    const koksma__material *m = surface->material < 0 ? NULL : &im->scene->materials[surface->material];
    return m && (m->image || m->checker);
}

static koksma_status triangles(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool quads, bool divided,
                               const koksma__import_surface *surface, int *out)
{
    koksma__mesh mesh = {0};
    const char *const pairs = "point2 float";
    const char *uv = koksma__pbrt_find_typed(p, "uv", pairs)   ? "uv"
                     : koksma__pbrt_find_typed(p, "st", pairs) ? "st"
                                                               : "";
    koksma_status status = fill_mesh(p, uv, quads, &mesh);
    status = status || !divided ? status : divide(scene, p, &mesh);
    if (!status && (!*uv || divided) && is_textured(scene->im, surface) && !koksma__mesh_check(&mesh)) {
        status = koksma__import_default_uv(&mesh, quads, false);
    }
    if (status) {
        koksma__mesh_fini(&mesh);
        return status;
    }
    return koksma__import_mesh(scene->im, p->place, &mesh, out);
}

/* Sets the matrix that scales a basic shape by the radius in x and y and by the height in z, and moves it along
   z. */
static void shape_form(double radius, double height, double z, double m[12])
{
    m[0] = m[5] = radius;
    m[10] = height;
    m[11] = z;
}

/* Applies alpha to a shape: a constant of 1 changes nothing; at 0 no ray meets the shape, but a light still shines. */
static koksma_status take_shape_alpha(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p,
                                      koksma__import_item *item, bool *is_there)
{
    const koksma__pbrt_parameter *alpha = koksma__pbrt_find(p, "alpha");
    const bool is_number = alpha && !strcmp(alpha->type, "float") && alpha->n == 1;
    koksma__import_colour opacity;
    if (is_number && alpha->numbers[0] <= 0) {
        item->surface.hidden = item->surface.emits;
        item->surface.material = -1;
        *is_there = item->surface.emits;
    } else if (alpha && !(is_number && alpha->numbers[0] >= 1)) {
        KOKSMA__TRY(find_texture_colour(scene, p, "alpha", 1, true, &opacity));
        return item->surface.emits ? koksma__import_unknown(scene->im, p->place, "a light's 'alpha' is ignored")
                                   : koksma__import_mask(scene->im, p->place, &opacity, &item->surface.material);
    }
    return KOKSMA_OK;
}

/* The area of one of pbrt's shapes: of a triangle, or of a patch of a bilinear mesh, in a mesh of which each has a power of
   its own. If they differ, as many emit evenly here as they all have power: the mean area, and a warning. */
static koksma_status area_of_faces(koksma__pbrt_scene *scene, koksma__text_place place, const koksma__mesh *mesh,
                                   const double placed[12], bool quads, double *out)
{
    const size_t each = quads ? 2 : 1, n = mesh->n_triangles / each;
    double smallest = INFINITY, largest = 0, sum = 0;
    for (size_t i = 0; i < n; i++) {
        double area = 0;
        float corners[9];
        for (size_t k = 0; k < each; k++) {
            area += koksma__placed_triangle(mesh, placed, each * i + k, corners);
        }
        smallest = fmin(smallest, area);
        largest = fmax(largest, area);
        sum += area;
    }
    *out = n ? sum / (double)n : 0;
    return koksma__import_unknown_if(largest > 1.001 * smallest, scene->im, place,
                                     "a light's power, which pbrt gives to each face, is spread evenly over faces of "
                                     "different areas");
}

/* Scales a light's radiance so that it has this power. */
static koksma_status set_power(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                               double power, const double placed[12], koksma__import_item *item)
{
    const double radius = koksma__pbrt_number(p, "radius");
    double area = 0;
    if (item->form == KOKSMA__FORM_MESH) {
        KOKSMA__TRY(area_of_faces(scene, p->place, &scene->im->scene->meshes[item->mesh], placed,
                                  !strcmp(type, "bilinearmesh"), &area));
    } else if (item->form == KOKSMA__FORM_CYLINDER) {
        area = TURN * radius * (koksma__pbrt_number(p, "zmax") - koksma__pbrt_number(p, "zmin"));
    } else {
        area = (item->form == KOKSMA__FORM_DISK ? M_PI : 2 * TURN) * radius * radius;
    }
    for (int k = 0; k < 3; k++) {
        const double sides = item->surface.two_sided ? 2 : 1;
        item->surface.radiance[k] *= area > 0 ? power / (sides * M_PI * area) : 0;
    }
    return KOKSMA_OK;
}

static koksma_status make_shape(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                koksma__import_item *item, double matrix[12], bool *is_there)
{
    const double radius = koksma__pbrt_number(p, "radius");
    koksma__import *im = scene->im;
    koksma_status status = KOKSMA_OK;
    item->mesh = -1;
    KOKSMA__TRY(take_shape_alpha(scene, p, item, is_there));
    if (!*is_there) {
        return KOKSMA_OK;
    }
    if (!strcmp(type, "sphere") || !strcmp(type, "disk") || !strcmp(type, "cylinder")) {
        const double low = koksma__pbrt_number(p, "zmin"), high = koksma__pbrt_number(p, "zmax");
        const bool cylinder = *type == 'c', disk = *type == 'd';
        item->form = cylinder ? KOKSMA__FORM_CYLINDER : disk ? KOKSMA__FORM_DISK : KOKSMA__FORM_SPHERE;
        shape_form(radius,
                   cylinder ? high - low
                   : disk   ? 1
                            : radius,
                   cylinder ? low
                   : disk   ? koksma__pbrt_number(p, "height")
                            : 0,
                   matrix);
        if (koksma__pbrt_number(p, "phimax") < 360 || koksma__pbrt_number(p, "innerradius") > 0 ||
            (!cylinder && !disk && (koksma__pbrt_find(p, "zmin") || koksma__pbrt_find(p, "zmax")))) {
            status = koksma__import_unknown(im, p->place, "a partial %s is replaced by a whole one", type);
        }
        return status;
    }
    if (!strcmp(type, "plymesh")) {
        status = koksma__import_mesh_file(im, p->place, koksma__pbrt_word(p, "filename"), -1, (koksma__mesh_rules){0},
                                          &item->mesh);
    } else if (!strcmp(type, "trianglemesh") || !strcmp(type, "bilinearmesh")) {
        status = triangles(scene, p, *type == 'b', false, &item->surface, &item->mesh);
    } else if (!strcmp(type, "loopsubdiv")) {
        status = triangles(scene, p, false, true, &item->surface, &item->mesh);
    } else {
        status = koksma__import_unknown(im, p->place, "shape '%s' is left out%s", type,
                                        koksma__pbrt_kind_meant("Shape", type, (char[KOKSMA__OR_MEANT]){0}));
    }
    *is_there = item->mesh >= 0;
    return status;
}

koksma_status koksma__pbrt_shape(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                 double power, const double placed[12], koksma__import_item *item, double matrix[12],
                                 bool *is_there)
{
    KOKSMA__TRY(make_shape(scene, type, p, item, matrix, is_there));
    return *is_there && item->surface.emits && power > 0 ? set_power(scene, type, p, power, placed, item) : KOKSMA_OK;
}
