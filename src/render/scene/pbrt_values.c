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
    KOKSMA__FREE(scene->materials, scene->textures);
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
static void sampled(koksma__text_place place, const double *pairs, size_t n, koksma__spectrum_use use, double rgb[3])
{
    koksma__sampled_spectrum s = {0};
    koksma__import_spend(place, KOKSMA__SPECTRUM_STEPS + n / 2);
    for (size_t i = 0; i + 1 < n; i += 2) {
        koksma__import_fail_if(!koksma__sampled_spectrum_add(&s, pairs[i], pairs[i + 1]), place,
                               "wavelengths of a spectrum must increase");
    }
    koksma__sampled_spectrum_colour(&s, use, rgb);
    const double luminance = 0.2126729 * rgb[0] + 0.7151522 * rgb[1] + 0.0721750 * rgb[2];
    for (int k = 0; use == KOKSMA__EMISSION && k < 3; k++) {
        rgb[k] = luminance > 0 ? rgb[k] / luminance : 0;
    }
}

/* Reads a named spectrum: of a light, the CIE's illuminants A, which is a black body, and D65, which is white here. With
   a warning, "metal-Au-eta" and similar names give the metal's reflectance, others white. */
static void named_spectrum(koksma__text_place place, const char *name, koksma__spectrum_use use, double rgb[3])
{
    char metal[16] = "";
    grey(1, rgb);
    if (use == KOKSMA__EMISSION && !strcmp(name, "stdillum-A")) {
        koksma__black_body_colour(2856, rgb);
    } else if (use != KOKSMA__EMISSION || strcmp(name, "stdillum-D65") != 0) {
        if (!strncmp(name, "metal-", 6)) {
            snprintf(metal, sizeof metal, "%.*s", (int)strcspn(name + 6, "-"), name + 6);
        }
        koksma__import_unknown(place, "spectrum '%s' is replaced by %s", name,
                               koksma__import_metal(metal, rgb) ? "the metal's reflectance" : "white");
    }
}

/* Finds a texture among those of type "float", or else "spectrum". pbrt refuses one of the other type. */
static const struct koksma__pbrt_named_texture *find_texture(koksma__pbrt_scene *scene, koksma__text_place place,
                                                             const koksma__pbrt_parameter *p, bool is_float)
{
    static const char *const types[] = {"spectrum", "float"};
    const size_t length = strlen(p->text);
    size_t i = 0;
    if (!koksma__names_find(&scene->texture_names[is_float], p->text, length, &i)) {
        koksma__import_fail_if(!koksma__names_find(&scene->texture_names[!is_float], p->text, length, &i), place,
                               "%s: no texture '%s'", p->name, p->text);
        koksma__import_unknown(place, "%s: the %s texture '%s' stands for a %s texture", p->name, types[!is_float],
                               p->text, types[is_float]);
    }
    return &scene->textures[i];
}

static void colour_of(koksma__pbrt_scene *scene, koksma__text_place place, const koksma__pbrt_parameter *p,
                      koksma__spectrum_use use, bool is_float, koksma__import_colour *out)
{
    if (!strcmp(p->type, "texture")) {
        const struct koksma__pbrt_named_texture *texture = find_texture(scene, place, p, is_float);
        *out = texture->colour;
        if (*texture->spectrum) {
            named_spectrum(place, texture->spectrum, use, out->rgb);
        }
        return;
    }
    koksma__import_fail_if(!koksma__pbrt_is(p, "float rgb color spectrum blackbody"), place,
                           "%s: a '%s' is not a colour", p->name, p->type);
    if (p->n_texts == 1) {
        named_spectrum(place, p->text, use, out->rgb);
    } else if (!strcmp(p->type, "blackbody") && p->n == 1) {
        /* in pbrt such a light is NaN everywhere */
        koksma__import_fail_if(!(p->numbers[0] > 0), place, "%s: a temperature of %g kelvins; it must be above 0",
                               p->name, p->numbers[0]);
        koksma__black_body_colour(p->numbers[0], out->rgb);
    } else if (!strcmp(p->type, "spectrum") && p->n) {
        sampled(place, p->numbers, p->n, use, out->rgb);
    } else {
        bool beyond = false;
        koksma__import_fail_if(p->n != (koksma__pbrt_is(p, "rgb color") ? 3 : 1), place, "%s: more than one colour",
                               p->name);
        for (size_t k = 0; k < 3; k++) {
            out->rgb[k] = p->numbers[p->n == 3 ? k : 0];
            beyond |= !(out->rgb[k] >= 0 && out->rgb[k] <= 1);
        }
        koksma__import_unknown_if(beyond && use == KOKSMA__REFLECTANCE && !is_float, place,
                                  "%s: a reflectance beyond 0 to 1 is clamped; pbrt refuses it", p->name);
    }
}

/* Reads the colour or texture with this name; without one, it is grey with the value `otherwise`. */
static koksma__import_colour read_colour(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name,
                                         double otherwise, koksma__spectrum_use use, bool is_float)
{
    const koksma__pbrt_parameter *found = koksma__pbrt_find(p, name);
    koksma__import_colour out = {.rgb = {otherwise, otherwise, otherwise}, .period = 1};
    if (found) {
        colour_of(scene, p->place, found, use, is_float, &out);
    }
    return out;
}

/* The one colour with this name, or white, times the parameter "scale" and a factor; `what` may be a texture. */
static void scaled_colour(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name, const char *what,
                          koksma__spectrum_use use, double factor, double rgb[3])
{
    koksma__import_colour colour = read_colour(scene, p, name, 1, use, false);
    koksma__import_mean(p->place, what, use, &colour);
    for (int k = 0; k < 3; k++) {
        rgb[k] = colour.rgb[k] * koksma__pbrt_number(p, "scale") * factor;
    }
}

void koksma__pbrt_emission(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name, double rgb[3])
{
    scaled_colour(scene, p, name, "a light's texture", KOKSMA__EMISSION, scene->exposure, rgb);
}

void koksma__pbrt_coefficient(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name, double rgb[3])
{
    scaled_colour(scene, p, name, "a medium's texture", KOKSMA__UNBOUNDED, 1, rgb);
    for (int k = 0; k < 3; k++) {
        koksma__import_fail_if(!(rgb[k] >= 0), p->place, "%s: a coefficient of %g; it must be 0 or more", name,
                               rgb[k]);
        rgb[k] = fmin(rgb[k], FAR);
    }
}

/* ---- Textures ------------------------------------------------------------------------------------------------ */

/* Textures are not clamped: the same one may be a reflectance, which is clamped where it is used, or eta and k of a
   metal. */
static koksma__import_colour texture_colour(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *name,
                                            double otherwise, bool is_float)
{
    return read_colour(scene, p, name, otherwise, KOKSMA__UNBOUNDED, is_float);
}

static void check_mapping(koksma__pbrt_parameters *p)
{
    const char *mapping = koksma__pbrt_word(p, "mapping");
    koksma__import_unknown_if(*mapping && strcmp(mapping, "uv"), p->place,
                              "a texture's mapping '%.40s' is replaced by 'uv'", mapping);
}

/* Reads how an image is mapped: (u, v) are scaled, then moved; and what lies beyond it. */
static void set_mapping(koksma__pbrt_parameters *p, koksma__import_colour *c)
{
    koksma__mapping *to = &c->mapping;
    const double scale[2] = {koksma__pbrt_number(p, "uscale"), koksma__pbrt_number(p, "vscale")};
    const double move[2] = {koksma__pbrt_number(p, "udelta"), koksma__pbrt_number(p, "vdelta")};
    static const char wraps[] = "clamp repeat black";
    const char *wrap = koksma__pbrt_word(p, "wrap");
    koksma__import_check_uv(p->place, scale, 2);
    koksma__import_check_uv(p->place, move, 2);
    check_mapping(p);
    to->wrap[0] = to->wrap[1] = strcmp(wrap, "clamp") ? KOKSMA__WRAP_REPEAT : KOKSMA__WRAP_CLAMP;
    koksma__import_unknown_if(*wrap && !koksma__lists(wraps, sizeof wraps - 1, ' ', wrap), p->place,
                              "a texture's wrap '%.40s' is replaced by 'repeat'", wrap);
    c->use.border = !strcmp(wrap, "black");
    to->nearest = !strcmp(koksma__pbrt_word(p, "filter"), "point");
    to->moved = scale[0] != 1 || scale[1] != 1 || move[0] != 0 || move[1] != 0;
    for (int k = 0; k < 2; k++) {
        to->matrix[4 * k] = (float)scale[k];
        to->matrix[3 * k + 2] = (float)move[k];
    }
}

/* Reads what the levels of an image mean: only of PNG the encoding can be chosen; JPEG is sRGB; other files hold linear
   numbers. A level v becomes scale v, or 1 - scale v if it is inverted, and at least 0. */
static void set_levels(koksma__pbrt_parameters *p, bool is_float, koksma__import_colour *c)
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
    koksma__import_fail_if(strcmp(encoding, "sRGB") && strcmp(encoding, "linear") &&
                               !(end && !*end && gamma > 0 && gamma < 100),
                           p->place, "encoding: '%.40s' is not sRGB, linear or gamma X", encoding);
    if (png && strcmp(encoding, "sRGB")) {
        c->use.part = KOKSMA__IMAGE_NUMBERS;
        c->use.gamma = gamma;
    }
    for (int k = 0; k < 3; k++) {
        c->use.tint[k] = invert ? -scale : scale;
        c->use.plus[k] = invert;
    }
}

static bool is_one_colour(const koksma__import_colour *c)
{
    return !*c->image && !c->is_checker;
}

/* Blends two textures by an amount that does not vary: exactly if at most one of them is an image, and if checkerboards
   have squares of one size. */
static void blend(koksma__pbrt_parameters *p, double amount, koksma__import_colour *c, koksma__import_colour *other)
{
    if (amount <= 0 || amount >= 1) {
        *c = amount <= 0 ? *c : *other;
        return;
    }
    const bool checkers = c->is_checker && other->is_checker && !memcmp(&c->period, &other->period, sizeof c->period);
    if (!is_one_colour(c) && !is_one_colour(other) && !checkers) {
        koksma__import_mean(p->place, WITHIN, KOKSMA__REFLECTANCE, other);
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
}

/* Reads a mix: (1 - amount) tex1 + amount tex2. With an amount that varies, it is exact between two colours. */
static void read_mix(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, bool is_float, koksma__import_colour *c)
{
    *c = texture_colour(scene, p, "tex1", 0, is_float);
    koksma__import_colour second = texture_colour(scene, p, "tex2", 1, is_float);
    koksma__import_colour amount = texture_colour(scene, p, "amount", 0.5, true);
    if (!is_one_colour(&amount) && is_one_colour(c) && is_one_colour(&second)) {
        const koksma__import_colour first = *c;
        *c = amount;
        koksma__import_between(c, first.rgb, second.rgb);
        return;
    }
    koksma__import_mean(p->place, "the amount of a mix", KOKSMA__REFLECTANCE, &amount);
    blend(p, amount.rgb[0], c, &second);
}

/* Reads the product of two textures, of which the second is of type "float". A product has no order: one colour times a
   checkerboard is a checkerboard. */
static void read_scaled(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, bool is_float,
                        koksma__import_colour *c)
{
    *c = texture_colour(scene, p, "tex", 1, is_float);
    koksma__import_colour by = texture_colour(scene, p, "scale", 1, true);
    if (is_one_colour(c)) {
        const koksma__import_colour first = *c;
        *c = by;
        by = first;
    }
    koksma__import_mean(p->place, "the scale of a texture", KOKSMA__UNBOUNDED, &by);
    const bool is_positive = by.rgb[0] >= 0 && by.rgb[1] >= 0 && by.rgb[2] >= 0; /* as levels of an image stay then */
    if (*c->image && !is_positive) {
        koksma__import_unknown(p->place, "an image times a negative colour is replaced by the image");
    } else {
        koksma__import_affine(c, by.rgb, (const double[3]){0});
    }
}

/* Reads tex1 and tex2 as one colour each. */
static void read_two(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const double otherwise[2], bool is_float,
                     koksma__import_colour out[2])
{
    out[0] = texture_colour(scene, p, "tex1", otherwise[0], is_float);
    out[1] = texture_colour(scene, p, "tex2", otherwise[1], is_float);
    koksma__import_mean(p->place, WITHIN, KOKSMA__REFLECTANCE, &out[0]);
    koksma__import_mean(p->place, WITHIN, KOKSMA__REFLECTANCE, &out[1]);
}

static void read_checkerboard(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, bool is_float,
                              koksma__import_colour *c)
{
    koksma__import_colour two[2];
    read_two(scene, p, (const double[2]){1, 0}, is_float, two);
    *c = two[0];
    memcpy(c->second, two[1].rgb, sizeof c->second);
    c->is_checker = true;
    check_mapping(p);
    const double u = koksma__pbrt_number(p, "uscale"), v = koksma__pbrt_number(p, "vscale");
    koksma__import_check_uv(p->place, &u, 1);
    c->period = 1 / fmax(fabs(u), 1e-6); /* turned by 180 degrees, the squares are where they were */
    koksma__import_unknown_if(!(fabs(u) > 1e-6), p->place, "a checkerboard's uscale of %g is replaced by 1e-6", u);
    koksma__import_unknown_if(u != v, p->place, "a checkerboard's vscale is replaced by uscale");
}

static void read_texture(koksma__pbrt_scene *scene, const char *kind, bool is_float, koksma__pbrt_parameters *p,
                         struct koksma__pbrt_named_texture *to)
{
    koksma__import_colour two[2], *c = &to->colour;
    const koksma__pbrt_parameter *value = !strcmp(kind, "constant") ? koksma__pbrt_find(p, "value") : NULL;
    if (!strcmp(kind, "imagemap")) {
        koksma__import_path(p->place, koksma__pbrt_word(p, "filename"), c->image);
        set_mapping(p, c);
        c->image_scale = 1;
        set_levels(p, is_float, c);
    } else if (!strcmp(kind, "mix")) {
        read_mix(scene, p, is_float, c);
    } else if (value && !strcmp(value->type, "spectrum") && value->n_texts == 1 && *value->text) {
        snprintf(to->spectrum, sizeof to->spectrum, "%.63s", value->text);
    } else if (!strcmp(kind, "constant")) {
        *c = texture_colour(scene, p, "value", 1, is_float);
    } else if (!strcmp(kind, "scale")) {
        read_scaled(scene, p, is_float, c);
    } else if (!strcmp(kind, "checkerboard") && koksma__pbrt_whole(p, "dimension") == 2) {
        read_checkerboard(scene, p, is_float, c);
    } else {
        koksma__import_unknown(p->place, "texture '%s' is replaced by one colour", kind);
        read_two(scene, p, (const double[2]){0.5, 0.5}, is_float, two);
        for (int k = 0; k < 3; k++) {
            c->rgb[k] = (two[0].rgb[k] + two[1].rgb[k]) / 2;
        }
    }
}

void koksma__pbrt_texture(koksma__pbrt_scene *scene, const char *name, const char *type, const char *kind,
                          koksma__pbrt_parameters *p)
{
    const bool is_float = !strcmp(type, "float");
    koksma__import_fail_if(!is_float && strcmp(type, "spectrum") != 0, p->place,
                           "'%s' is not a type of textures; 'float' and 'spectrum' are%s", type,
                           strcmp(type, "color") ? "" : " ('color' of pbrt-v3 is 'spectrum')");
    koksma__import_fail_if(scene->n_textures == MOST_TEXTURES, p->place, "more than %d textures", MOST_TEXTURES);
    koksma__import_hold(p->place, sizeof(struct koksma__pbrt_named_texture) + KOKSMA__HELD_WITH_NAME);
    struct koksma__pbrt_named_texture *to =
        koksma__import_add(p->place, &scene->textures, &scene->n_textures, sizeof *to);
    to->colour.period = 1;
    grey(0.5, to->colour.rgb);
    read_texture(scene, kind, is_float, p, to); /* which has no name yet, so that it can't refer to itself */
    koksma__import_put_name(p->place, &scene->texture_names[is_float], name, scene->n_textures - 1);
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

/* Reads eta or k of a metal; returns false unless it is one colour: not a texture that varies, nor the name of a
   spectrum. */
static bool take_constant(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p,
                          const koksma__pbrt_parameter *from, double rgb[3])
{
    koksma__import_colour colour = {.period = 1};
    if (!from || *spectrum_name(scene, from) || (from->n_texts && strcmp(from->type, "texture") != 0)) {
        return false;
    }
    colour_of(scene, p->place, from, KOKSMA__UNBOUNDED, false, &colour);
    memcpy(rgb, colour.rgb, sizeof colour.rgb);
    return is_one_colour(&colour);
}

/* Sets the reflectance of a metal along the normal, from its refractive index eta and its absorption k. */
static void metal(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, const char *prefix,
                  koksma__import_material *m)
{
    char eta_name[40], k_name[40], of_eta[16], of_k[16];
    snprintf(eta_name, sizeof eta_name, "%seta", prefix);
    snprintf(k_name, sizeof k_name, "%sk", prefix);
    const koksma__pbrt_parameter *eta = koksma__pbrt_find(p, eta_name), *k = koksma__pbrt_find(p, k_name);
    if (koksma__pbrt_find(p, "reflectance")) {
        m->colour = read_colour(scene, p, "reflectance", 1, KOKSMA__REFLECTANCE, false);
        koksma__import_mean(p->place, "a metal's texture", KOKSMA__REFLECTANCE, &m->colour);
        return;
    }
    const char *name = named_metal(scene, eta, "-eta", of_eta), *other = named_metal(scene, k, "-k", of_k);
    double eta_rgb[3] = {0}, k_rgb[3] = {0};
    bool is_constant = take_constant(scene, p, eta, eta_rgb);
    is_constant &= take_constant(scene, p, k, k_rgb);
    for (int i = 0; is_constant && i < 3; i++) {
        const double n = fmin(fmax(eta_rgb[i], 0), FAR), absorbed = fmin(fmax(k_rgb[i], 0), FAR);
        m->colour.rgb[i] = ((n - 1) * (n - 1) + absorbed * absorbed) / ((n + 1) * (n + 1) + absorbed * absorbed);
    }
    if (!is_constant) {
        const bool agree = *name && !strcmp(name, other);
        name = eta && *name ? name : k && *other ? other : agree ? name : "Cr";
        koksma__import_metal(name, m->colour.rgb);
        koksma__import_unknown_if(
            !agree, p->place,
            "eta and k of a metal that are not two colours, or names of one metal, are replaced by those of '%s'",
            name);
    }
}

/* Sets GGX's alpha: the square root of the roughness, or the roughness itself if remaproughness is false. */
static void set_alpha(koksma__pbrt_parameters *p, const char *prefix, koksma__import_material *m)
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
    koksma__import_unknown_if(u != v, p->place, "anisotropic roughness is replaced by its mean");
}

/* Reads a mix, whose surface is of the second material with the probability `amount`. */
static int mix_materials(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p)
{
    const koksma__pbrt_parameter *both = koksma__pbrt_find_typed(p, "materials", "string");
    koksma__import_fail_if(!both || both->n_texts != 2, p->place, "materials: a mix has the names of two materials");
    const int first = koksma__pbrt_find_material(scene, p->place, both->text);
    const int second = koksma__pbrt_find_material(scene, p->place, both->second);
    koksma__import_colour share = texture_colour(scene, p, "amount", 0.5, true);
    return koksma__import_mix(p->place, first, second, &share);
}

int koksma__pbrt_material(koksma__pbrt_scene *scene, const char *type, koksma__pbrt_parameters *p)
{
    const koksma__plugin *found = koksma__plugin_find(&koksma__pbrt_plugins, "Material", *type ? type : "none");
    const char *prefix = strcmp(type, "coatedconductor") ? "" : "conductor.";
    koksma__entry first = koksma__entries_of(found);
    koksma__import_material m = {.kind = (unsigned)found->makes, .ior = 1.5};
    if (!strcmp(type, "mix")) {
        return mix_materials(scene, p);
    }
    koksma__import_unknown_if(found->instead, p->place, "material '%s': %s here%s", type, found->instead,
                              koksma__pbrt_kind_meant("Material", type, (char[KOKSMA__OR_MEANT]){0}));
    koksma__import_unknown_if(koksma__pbrt_find(p, "displacement") || koksma__pbrt_find(p, "normalmap"), p->place,
                              "displacement and normal maps are ignored");
    if (m.kind == KOKSMA__NOTHING) {
        return -1;
    }
    if (m.kind == KOKSMA__METAL) {
        metal(scene, p, prefix, &m);
    } else if (m.kind != KOKSMA__GLASS) { /* the colour comes first in its row */
        char name[40] = "";
        if (koksma__entry_next(&first) && !strncmp(first.type, "colour ", 7)) {
            snprintf(name, sizeof name, "%.*s", (int)first.length, first.name);
        }
        m.colour = read_colour(scene, p, name, 0.5, KOKSMA__REFLECTANCE, false);
    }
    if (m.kind == KOKSMA__GLASS || m.kind == KOKSMA__COATED) {
        m.ior = koksma__pbrt_number(p, "eta");
        m.ior = m.ior == 0 ? 1 : m.ior; /* as in pbrt */
        koksma__import_fail_if(m.ior < 0, p->place, "eta: an index of refraction of %g; it must be above 0", m.ior);
        const koksma__pbrt_parameter *eta = koksma__pbrt_find(p, "eta");
        koksma__import_unknown_if(eta && !koksma__pbrt_is(eta, "float integer"), p->place,
                                  "the spectrum of a glass is replaced by the index 1.5");
    }
    set_alpha(p, prefix, &m);
    return koksma__import_material_of(p->place, &m);
}

void koksma__pbrt_name_material(koksma__pbrt_scene *scene, const char *name, koksma__pbrt_parameters *p)
{
    const int material = koksma__pbrt_material(scene, koksma__pbrt_word(p, "type"), p);
    koksma__import_hold(p->place, sizeof(struct koksma__pbrt_named) + KOKSMA__HELD_WITH_NAME);
    struct koksma__pbrt_named *to = koksma__import_add(p->place, &scene->materials, &scene->n_materials, sizeof *to);
    snprintf(to->name, sizeof to->name, "%s", name);
    to->material = material;
    koksma__import_put_name(p->place, &scene->material_names, to->name, scene->n_materials - 1);
}

int koksma__pbrt_find_material(koksma__pbrt_scene *scene, koksma__text_place place, const char *name)
{
    size_t i = 0;
    koksma__import_fail_if(!koksma__names_find(&scene->material_names, name, strlen(name), &i), place,
                           "material '%s' is not defined before this use", name);
    return scene->materials[i].material;
}

/* ---- Shapes ---------------------------------------------------------------------------------------------------- */

/* Copies the numbers of a parameter, which must exist and have `each` numbers for every vertex. */
static void take_floats(koksma__pbrt_parameters *p, const char *name, size_t each, size_t n, float *to)
{
    const koksma__pbrt_parameter *from = koksma__pbrt_find(p, name);
    koksma__import_fail_if(!from || from->n != each * n, p->place, "%s: %zu numbers for %zu vertices", name,
                           from ? from->n : 0, n);
    for (size_t i = 0; i < from->n; i++) {
        to[i] = (float)from->numbers[i];
    }
}

/* Reads a mesh. A quadrilateral has four indices and becomes two triangles. */
static void fill_mesh(koksma__pbrt_parameters *p, const char *uv, bool quads)
{
    static const size_t corners[6] = {0, 1, 3, 0, 3, 2};
    koksma__mesh *mesh = &p->place.im->mesh;
    const koksma__pbrt_parameter *points = koksma__pbrt_find_typed(p, "P", "point3 point"),
                                 *indices = koksma__pbrt_find_typed(p, "indices", "integer");
    const size_t n = points ? points->n / 3 : 0, each = quads ? 4 : 3, n_indices = indices ? indices->n : each;
    koksma__import_fail_if(!n || (!indices && n != each), p->place,
                           "a mesh needs 'P', and 'indices' if it has more than one face");
    koksma__import_fail_if(n_indices % each, p->place, "indices: %zu numbers, but each face has %zu", n_indices,
                           each);
    const bool normals = koksma__pbrt_find_typed(p, "N", "normal normal3");
    koksma__import_pass(p->place, koksma__mesh_init(n, n_indices / each * (quads ? 2 : 1), normals, *uv != 0, mesh));
    take_floats(p, "P", 3, n, mesh->vertices);
    if (normals) {
        take_floats(p, "N", 3, n, mesh->normals);
    }
    if (*uv) {
        take_floats(p, uv, 2, n, mesh->uvs);
    }
    for (size_t i = 0; i < 3 * mesh->n_triangles; i++) {
        const size_t at = quads ? i / 6 * 4 + corners[i % 6] : i;
        const double index = indices ? indices->numbers[at] : (double)at;
        koksma__import_fail_if(!(index >= 0 && index < (double)n), p->place,
                               "indices: there is no vertex %.15g; the mesh has %zu", index, n);
        mesh->indices[i] = (uint32_t)index;
    }
}

/* Divides a mesh as often as its parameter `levels` says, or less often if the scene would get more than MOST_DIVIDED
   triangles by subdivision. */
static void divide(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p)
{
    koksma__mesh fine = {0}, *mesh = &scene->im->mesh;
    const double asked = koksma__pbrt_whole(p, "levels");
    const size_t left = scene->n_divided < MOST_DIVIDED ? MOST_DIVIDED - scene->n_divided : 0;
    int levels = 0;
    if (koksma__mesh_check(mesh)) {
        return; /* koksma__import_mesh() leaves the mesh out, with a warning */
    }
    while (levels < asked && mesh->n_triangles << 2 * (levels + 1) <= left) {
        levels++;
    }
    koksma__import_unknown_if(levels < asked, p->place, "shape 'loopsubdiv' is divided %d times only", levels);
    scene->n_divided += mesh->n_triangles << 2 * levels;
    const uint64_t passing = ((uint64_t)mesh->n_triangles << 2 * levels) * DIVIDED_BYTES;
    koksma__import_hold(p->place, passing);
    const koksma_status status = koksma__mesh_loop(mesh, levels, &fine);
    scene->im->held -= passing;
    koksma__mesh_fini(mesh);
    *mesh = fine;
    koksma__import_check(p->place, status);
}

/* Whether a surface has an image or a checkerboard. */
static bool is_textured(const koksma__import *im, const koksma__import_surface *surface)
{
    const koksma__material *m = surface->material < 0 ? NULL : &im->scene->materials[surface->material];
    return m && (m->image || m->checker);
}

static int triangles(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, bool quads, bool divided,
                     const koksma__import_surface *surface)
{
    const char *const pairs = "point2 float";
    const char *uv = koksma__pbrt_find_typed(p, "uv", pairs)   ? "uv"
                     : koksma__pbrt_find_typed(p, "st", pairs) ? "st"
                                                               : "";
    fill_mesh(p, uv, quads);
    if (divided) {
        divide(scene, p);
    }
    if ((!*uv || divided) && is_textured(scene->im, surface) && !koksma__mesh_check(&scene->im->mesh)) {
        koksma__import_default_uv(p->place, quads);
    }
    return koksma__import_mesh(p->place);
}

/* Applies alpha to a shape: a constant of 1 changes nothing; at 0 no ray meets the shape, but a light still shines. Returns
   false if the shape is left out. */
static bool take_shape_alpha(koksma__pbrt_scene *scene, koksma__pbrt_parameters *p, koksma__import_item *item)
{
    const koksma__pbrt_parameter *alpha = koksma__pbrt_find(p, "alpha");
    const bool is_number = alpha && !strcmp(alpha->type, "float") && alpha->n == 1;
    koksma__import_surface *surface = &item->surface;
    if (is_number && alpha->numbers[0] <= 0) {
        surface->hidden = surface->emits;
        surface->material = -1;
        return surface->emits;
    }
    if (alpha && !(is_number && alpha->numbers[0] >= 1)) {
        koksma__import_colour opacity = texture_colour(scene, p, "alpha", 1, true);
        koksma__import_unknown_if(surface->emits, p->place, "a light's 'alpha' is ignored");
        surface->material =
            surface->emits ? surface->material : koksma__import_mask(p->place, surface->material, &opacity);
    }
    return true;
}

/* The area of one of pbrt's shapes: of a triangle, or of a patch of a bilinear mesh, in a mesh of which each has a power of
   its own. If they differ, as many emit evenly here as they all have power: the mean area, and a warning. */
static double area_of_faces(koksma__text_place place, const koksma__mesh *mesh, const double placed[12], bool quads)
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
    koksma__import_unknown_if(largest > 1.001 * smallest, place,
                              "a light's power, which pbrt gives to each face, is spread evenly over faces of "
                              "different areas");
    return n ? sum / (double)n : 0;
}

/* Scales a light's radiance so that it has this power. */
static void set_power(koksma__pbrt_scene *scene, const char *type, koksma__pbrt_parameters *p, double power,
                      const double placed[12], koksma__import_item *item)
{
    const double radius = koksma__pbrt_number(p, "radius"), sides = item->surface.two_sided ? 2 : 1;
    const double area =
        item->form == KOKSMA__FORM_MESH
            ? area_of_faces(p->place, &scene->im->scene->meshes[item->mesh], placed, !strcmp(type, "bilinearmesh"))
        : item->form == KOKSMA__FORM_CYLINDER
            ? TURN * radius * (koksma__pbrt_number(p, "zmax") - koksma__pbrt_number(p, "zmin"))
            : (item->form == KOKSMA__FORM_DISK ? M_PI : 2 * TURN) * radius * radius;
    for (int k = 0; k < 3; k++) {
        item->surface.radiance[k] *= area > 0 ? power / (sides * M_PI * area) : 0;
    }
}

/* A sphere, disk or cylinder: `matrix` scales the basic shape by the radius in x and y and by the height in z, and moves it
   along z. */
static void round_shape(const char *type, koksma__pbrt_parameters *p, koksma__import_item *item, double matrix[12])
{
    const double radius = koksma__pbrt_number(p, "radius");
    const double low = koksma__pbrt_number(p, "zmin"), high = koksma__pbrt_number(p, "zmax");
    const bool sphere = *type == 's', disk = *type == 'd';
    item->form = sphere ? KOKSMA__FORM_SPHERE : disk ? KOKSMA__FORM_DISK : KOKSMA__FORM_CYLINDER;
    matrix[0] = matrix[5] = radius;
    matrix[10] = sphere ? radius : disk ? 1 : high - low;
    matrix[11] = sphere ? 0 : disk ? koksma__pbrt_number(p, "height") : low;
    koksma__import_unknown_if(koksma__pbrt_number(p, "phimax") < 360 || koksma__pbrt_number(p, "innerradius") > 0 ||
                                  (sphere && (koksma__pbrt_find(p, "zmin") || koksma__pbrt_find(p, "zmax"))),
                              p->place, "a partial %s is replaced by a whole one", type);
}

bool koksma__pbrt_shape(koksma__pbrt_scene *scene, const char *type, koksma__pbrt_parameters *p, double power,
                        const double placed[12], koksma__import_item *item, double matrix[12])
{
    item->mesh = -1;
    if (!take_shape_alpha(scene, p, item)) {
        return false;
    }
    const bool is_round = !strcmp(type, "sphere") || !strcmp(type, "disk") || !strcmp(type, "cylinder");
    if (is_round) {
        round_shape(type, p, item, matrix);
    } else if (!strcmp(type, "plymesh")) {
        item->mesh =
            koksma__import_mesh_file(p->place, koksma__pbrt_word(p, "filename"), -1, (koksma__mesh_rules){0});
    } else if (!strcmp(type, "trianglemesh") || !strcmp(type, "bilinearmesh") || !strcmp(type, "loopsubdiv")) {
        item->mesh = triangles(scene, p, *type == 'b', *type == 'l', &item->surface);
    } else {
        koksma__import_unknown(p->place, "shape '%s' is left out%s", type,
                               koksma__pbrt_kind_meant("Shape", type, (char[KOKSMA__OR_MEANT]){0}));
    }
    const bool is_there = is_round || item->mesh >= 0;
    if (is_there && item->surface.emits && power > 0) {
        set_power(scene, type, p, power, placed, item);
    }
    return is_there;
}
