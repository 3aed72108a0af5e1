/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Converts pbrt-v4's parameters. Spectra become red, green and blue: rgb values are used as they are, black bodies by
 * their chromaticity, metals by a table of names, and sampled spectra by the CIE 1931 observer (import_spectrum.c), as
 * reflectance, emission or unbounded value, whichever pbrt takes them for; emission has luminance 1, as pbrt scales it.
 * A texture becomes a colour, an image or a checkerboard; textures that combine others become the mean colour.
 * The file is long because all of pbrt's parameters are in one place.
 */
#include "scene/pbrt_values.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "meshes/mesh_loop.h"
#include "render/fields.h"
#include "scene/import_limits.h"
#include "scene/import_shapes.h"
#include "scene/import_spectrum.h"

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

struct koksma__pbrt_texture {
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
                                  const struct koksma__pbrt_texture **out)
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
        const struct koksma__pbrt_texture *texture;
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
    for (size_t k = 0; k < 3; k++) {
        out->rgb[k] = p->numbers[p->n == 3 ? k : 0];
    }
    return KOKSMA_OK;
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
    static const char *const unknown[] = {"power", "illuminance", "portal", "alpha"};
    koksma__import_colour colour;
    KOKSMA__TRY(read_colour(scene, p, name, 1, KOKSMA__EMISSION, false, &colour));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, "a light's texture", KOKSMA__EMISSION, &colour));
    for (int k = 0; k < 3; k++) {
        rgb[k] = colour.rgb[k] * koksma__pbrt_number(p, "scale", 1);
    }
    for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++) {
        const koksma__pbrt_parameter *found = koksma__pbrt_find(p, unknown[i]);
        if (found && !(koksma__pbrt_is(found, "bool") && !strcmp(found->text, "false"))) {
            KOKSMA__TRY(koksma__import_unknown(scene->im, p->place, "a light's '%s' is ignored", unknown[i]));
        }
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
        const double value = colour.rgb[k] * koksma__pbrt_number(p, "scale", 1);
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

/* Reads how an image is mapped: (u, v) are scaled, then moved. The wrap mode "black" is not supported; a warning
   names it as an unused parameter. */
static koksma_status set_mapping(const koksma__pbrt_parameters *p, koksma__mapping *to)
{
    const double scale[2] = {koksma__pbrt_number(p, "uscale", 1), koksma__pbrt_number(p, "vscale", 1)};
    const double move[2] = {koksma__pbrt_number(p, "udelta", 0), koksma__pbrt_number(p, "vdelta", 0)};
    const koksma__pbrt_parameter *wrap = NULL;
    KOKSMA__TRY(koksma__import_check_uv(p->place, scale, 2));
    KOKSMA__TRY(koksma__import_check_uv(p->place, move, 2));
    for (size_t i = 0; i < p->n; i++) {
        wrap = !strcmp(p->items[i].name, "wrap") ? &p->items[i] : wrap;
    }
    if (wrap && !strcmp(wrap->text, "clamp")) {
        koksma__pbrt_find(p, "wrap");
        to->wrap[0] = to->wrap[1] = KOKSMA__WRAP_CLAMP;
    }
    to->nearest = !strcmp(koksma__pbrt_word(p, "filter", ""), "point");
    to->moved = scale[0] != 1 || scale[1] != 1 || move[0] != 0 || move[1] != 0;
    for (int k = 0; k < 2; k++) {
        to->matrix[4 * k] = (float)scale[k];
        to->matrix[3 * k + 2] = (float)move[k];
    }
    return KOKSMA_OK;
}

static koksma_status read_constant(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                                   struct koksma__pbrt_texture *to)
{
    const koksma__pbrt_parameter *value = koksma__pbrt_find(p, "value");
    if (value && !strcmp(value->type, "spectrum") && value->n_texts == 1 && *value->text) {
        snprintf(to->spectrum, sizeof to->spectrum, "%.63s", value->text);
        return KOKSMA_OK;
    }
    return find_texture_colour(scene, p, "value", 1, is_float, &to->colour);
}

/* Reads the product of two textures, of which the second is of type "float". A product has no order: one colour times a
   checkerboard is a checkerboard. */
static koksma_status read_scaled(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                                 koksma__import_colour *c)
{
    koksma__import_colour by;
    KOKSMA__TRY(find_texture_colour(scene, p, "tex", 1, is_float, c));
    KOKSMA__TRY(find_texture_colour(scene, p, "scale", 1, true, &by));
    if (!*c->image && !c->is_checker && (by.is_checker || koksma__import_is_white(c))) {
        const koksma__import_colour first = *c;
        *c = by;
        by = first;
    }
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, "the scale of a texture", KOKSMA__UNBOUNDED, &by));
    for (int k = 0; k < 3; k++) {
        c->rgb[k] *= by.rgb[k];
        c->second[k] *= by.rgb[k];
    }
    return *c->image && !koksma__import_is_white(&by)
               ? koksma__import_unknown(scene->im, p->place, "an image times a colour is replaced by the image alone")
               : KOKSMA_OK;
}

static koksma_status read_checkerboard(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool is_float,
                                       koksma__import_colour *c)
{
    koksma__import_colour second;
    KOKSMA__TRY(find_texture_colour(scene, p, "tex1", 1, is_float, c));
    KOKSMA__TRY(find_texture_colour(scene, p, "tex2", 0, is_float, &second));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, c));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, &second));
    c->is_checker = true;
    memcpy(c->second, second.rgb, sizeof c->second);
    const double u = koksma__pbrt_number(p, "uscale", 1), v = koksma__pbrt_number(p, "vscale", 1);
    KOKSMA__TRY(koksma__import_check_uv(p->place, &u, 1));
    c->period = 1 / fmax(fabs(u), 1e-6); /* turned by 180 degrees, the squares are where they were */
    KOKSMA__TRY(fabs(u) > 1e-6 ? KOKSMA_OK
                               : koksma__import_unknown(scene->im, p->place,
                                                        "a checkerboard's uscale of %g is replaced by 1e-6", u));
    return u != v ? koksma__import_unknown(scene->im, p->place, "a checkerboard's vscale is replaced by uscale")
                  : KOKSMA_OK;
}

static koksma_status read_texture(koksma__pbrt_scene *scene, const char *kind, bool is_float,
                                  const koksma__pbrt_parameters *p, struct koksma__pbrt_texture *to)
{
    koksma__import_colour first, second, *c = &to->colour;
    if (!strcmp(kind, "imagemap")) {
        KOKSMA__TRY(koksma__import_path(scene->im, p->place, koksma__pbrt_word(p, "filename", ""), c->image));
        KOKSMA__TRY(set_mapping(p, &c->mapping));
        c->image_scale = 1;
        return koksma__pbrt_number(p, "scale", 1) != 1
                   ? koksma__import_unknown(scene->im, p->place, "an image's scale is ignored")
                   : KOKSMA_OK;
    }
    if (!strcmp(kind, "constant")) {
        return read_constant(scene, p, is_float, to);
    }
    if (!strcmp(kind, "scale")) {
        return read_scaled(scene, p, is_float, c);
    }
    if (!strcmp(kind, "checkerboard") && koksma__pbrt_whole(p, "dimension", 2) == 2) {
        return read_checkerboard(scene, p, is_float, c);
    }
    KOKSMA__TRY(find_texture_colour(scene, p, "tex1", 0.5, is_float, &first));
    KOKSMA__TRY(find_texture_colour(scene, p, "tex2", 0.5, is_float, &second));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, &first));
    KOKSMA__TRY(koksma__import_mean(scene->im, p->place, WITHIN, KOKSMA__REFLECTANCE, &second));
    mean_of(&first, &second, c->rgb);
    return koksma__import_unknown(scene->im, p->place, "texture '%s' is replaced by one colour", kind);
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
        koksma__import_hold(scene->im, p->place, sizeof(struct koksma__pbrt_texture) + KOKSMA__HELD_WITH_NAME));
    struct koksma__pbrt_texture *to = koksma__add_one(&scene->textures, &scene->n_textures, sizeof *to);
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
    const double both = koksma__pbrt_number(p, name, 0);
    const double u = koksma__pbrt_number(p, u_name, both), v = koksma__pbrt_number(p, v_name, both);
    m->alpha = koksma__pbrt_flag(p, "remaproughness", true) ? sqrt(fmax(u * v, 0)) : fmax(u * v, 0);
    m->alpha = sqrt(m->alpha); /* the geometric mean of the widths along u and v */
    return u != v ? koksma__import_unknown(scene->im, p->place, "anisotropic roughness is replaced by its mean")
                  : KOKSMA_OK;
}

/* pbrt-v4's kinds of materials and the materials that replace them; a material that is only similar gives a warning. */
typedef struct material_kind {
    const char *name;
    int kind;            /* kind of the replacement; -1: light passes through */
    const char *colour;  /* name of the parameter for the diffuse albedo */
    const char *prefix;  /* prefix of the names of the parameters of a metal and of the roughness */
    const char *instead; /* the replacement's name in a warning, or NULL for no warning */
} material_kind;

static const material_kind kinds[] = {
    {"diffuse", KOKSMA__MATTE, "reflectance", "", NULL},
    {"coateddiffuse", KOKSMA__COATED, "reflectance", "", NULL},
    {"conductor", KOKSMA__METAL, NULL, "", NULL},
    {"coatedconductor", KOKSMA__METAL, NULL, "conductor.", "a metal without a coat"},
    {"dielectric", KOKSMA__GLASS, NULL, "", NULL},
    {"thindielectric", -1, NULL, "", "nothing"},
    {"diffusetransmission", KOKSMA__MATTE, "reflectance", "", "matte and opaque"},
    {"subsurface", KOKSMA__COATED, "reflectance", "", "a coated surface"},
    {"hair", KOKSMA__MATTE, "color", "", "matte"},
    {"measured", KOKSMA__MATTE, "reflectance", "", "matte grey"},
    {"interface", -1, NULL, "", NULL},
    {"none", -1, NULL, "", NULL},
    {"", -1, NULL, "", NULL}};

koksma_status koksma__pbrt_material(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                    int *out)
{
    static const material_kind other = {"", KOKSMA__MATTE, "reflectance", "", "matte"};
    const material_kind *found = &other;
    koksma__import_material m = {.ior = 1.5};
    if (!strcmp(type, "mix")) {
        KOKSMA__TRY(koksma__import_unknown(scene->im, p->place, "material 'mix' is replaced by its first material"));
        const koksma__pbrt_parameter *both = koksma__pbrt_find_typed(p, "materials", "string");
        return koksma__pbrt_find_material(scene, p->place, both ? both->text : "", out);
    }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        found = !strcmp(kinds[i].name, type) ? &kinds[i] : found;
    }
    if (found->instead) {
        KOKSMA__TRY(koksma__import_unknown(scene->im, p->place, "material '%s': %s here", type, found->instead));
    }
    if (koksma__pbrt_find(p, "displacement") || koksma__pbrt_find(p, "normalmap")) {
        KOKSMA__TRY(koksma__import_unknown(scene->im, p->place, "displacement and normal maps are ignored"));
    }
    *out = -1;
    if (found->kind < 0) {
        return KOKSMA_OK;
    }
    m.kind = (unsigned)found->kind;
    KOKSMA__TRY(m.kind == KOKSMA__METAL ? metal(scene, p, found->prefix, &m)
                                        : find_colour(scene, p, found->colour ? found->colour : "", 0.5, &m.colour));
    const bool refracts = m.kind == KOKSMA__GLASS || m.kind == KOKSMA__COATED;
    m.ior = refracts ? koksma__pbrt_number(p, "eta", 1.5) : 1.5;
    m.ior = m.ior == 0 ? 1 : m.ior; /* as in pbrt */
    if (m.ior < 0) {
        return koksma__import_fail(p->place, "eta: an index of refraction of %g; it must be above 0", m.ior);
    }
    const koksma__pbrt_parameter *eta = refracts ? koksma__pbrt_find(p, "eta") : NULL;
    if (eta && !koksma__pbrt_is(eta, "float integer")) {
        KOKSMA__TRY(
            koksma__import_unknown(scene->im, p->place, "the spectrum of a glass is replaced by the index 1.5"));
    }
    KOKSMA__TRY(set_alpha(scene, p, found->prefix, &m));
    return koksma__import_add_material(scene->im, p->place, &m, out);
}

koksma_status koksma__pbrt_name_material(koksma__pbrt_scene *scene, const char *name,
                                         const koksma__pbrt_parameters *p)
{
    int material = -1;
    KOKSMA__TRY(koksma__pbrt_material(scene, koksma__pbrt_word(p, "type", ""), p, &material));
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
    const double asked = koksma__pbrt_whole(p, "levels", 3);
    const size_t left = scene->n_divided < MOST_DIVIDED ? MOST_DIVIDED - scene->n_divided : 0;
    int levels = 0;
    if (koksma__mesh_check(mesh)) {
        return KOKSMA_OK; /* koksma__import_mesh() leaves the mesh out, with a warning */
    }
    while (levels < asked && mesh->n_triangles << 2 * (levels + 1) <= left) {
        levels++;
    }
    if (levels < asked) {
        KOKSMA__TRY(
            koksma__import_unknown(scene->im, p->place, "shape 'loopsubdiv' is divided %d times only", levels));
    }
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

static koksma_status triangles(koksma__pbrt_scene *scene, const koksma__pbrt_parameters *p, bool quads, bool divided,
                               int *out)
{
    koksma__mesh mesh = {0};
    const char *const pairs = "point2 float";
    const char *uv = koksma__pbrt_find_typed(p, "uv", pairs)   ? "uv"
                     : koksma__pbrt_find_typed(p, "st", pairs) ? "st"
                                                               : "";
    koksma_status status = fill_mesh(p, uv, quads, &mesh);
    status = status || !divided ? status : divide(scene, p, &mesh);
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

/* Applies a constant alpha to a shape: 1 changes nothing; at 0 no ray meets the shape, but a light still shines. */
static koksma_status take_shape_alpha(koksma__import *im, const koksma__pbrt_parameters *p, koksma__import_item *item,
                                      bool *is_there)
{
    const koksma__pbrt_parameter *alpha = koksma__pbrt_find(p, "alpha");
    const bool is_number = alpha && !strcmp(alpha->type, "float") && alpha->n == 1;
    if (is_number && alpha->numbers[0] <= 0) {
        item->surface.hidden = item->surface.emits;
        item->surface.material = -1;
        *is_there = item->surface.emits;
    } else if (alpha && !(is_number && alpha->numbers[0] >= 1)) {
        return koksma__import_unknown(im, p->place, "a shape's 'alpha' is ignored");
    }
    return KOKSMA_OK;
}

koksma_status koksma__pbrt_shape(koksma__pbrt_scene *scene, const char *type, const koksma__pbrt_parameters *p,
                                 koksma__import_item *item, double matrix[12], bool *is_there)
{
    const double radius = koksma__pbrt_number(p, "radius", 1);
    koksma__import *im = scene->im;
    koksma_status status = KOKSMA_OK;
    item->mesh = -1;
    KOKSMA__TRY(take_shape_alpha(im, p, item, is_there));
    if (!*is_there) {
        return KOKSMA_OK;
    }
    if (!strcmp(type, "sphere") || !strcmp(type, "disk") || !strcmp(type, "cylinder")) {
        const double low = koksma__pbrt_number(p, "zmin", -1), high = koksma__pbrt_number(p, "zmax", 1);
        const bool cylinder = *type == 'c', disk = *type == 'd';
        item->form = cylinder ? KOKSMA__FORM_CYLINDER : disk ? KOKSMA__FORM_DISK : KOKSMA__FORM_SPHERE;
        shape_form(radius,
                   cylinder ? high - low
                   : disk   ? 1
                            : radius,
                   cylinder ? low
                   : disk   ? koksma__pbrt_number(p, "height", 0)
                            : 0,
                   matrix);
        if (koksma__pbrt_number(p, "phimax", 360) < 360 || koksma__pbrt_number(p, "innerradius", 0) > 0 ||
            (!cylinder && !disk && (koksma__pbrt_find(p, "zmin") || koksma__pbrt_find(p, "zmax")))) {
            status = koksma__import_unknown(im, p->place, "a partial %s is replaced by a whole one", type);
        }
        return status;
    }
    if (!strcmp(type, "plymesh")) {
        status = koksma__import_mesh_file(im, p->place, koksma__pbrt_word(p, "filename", ""), -1,
                                          (koksma__mesh_rules){0}, &item->mesh);
    } else if (!strcmp(type, "trianglemesh") || !strcmp(type, "bilinearmesh")) {
        status = triangles(scene, p, *type == 'b', false, &item->mesh);
    } else if (!strcmp(type, "loopsubdiv")) {
        status = triangles(scene, p, false, true, &item->mesh);
    } else {
        status = koksma__import_unknown(im, p->place, "shape '%s' is left out", type);
    }
    *is_there = item->mesh >= 0;
    return status;
}
