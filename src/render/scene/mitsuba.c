/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads scenes of Mitsuba 3 (Jakob et al. 2022), and names of Mitsuba 0.6 and 2 that have changed since. xml.c parses
 * the text into a tree, whose sensors, shapes, emitters and BSDFs are converted here. A BSDF is converted when a
 * shape first refers to it. One homogeneous medium is read, of the sensor, a cube or a sphere; volumes and motion
 * are not read. Of an integrator only the length of paths and whether lights are seen is read; samplers and filters are
 * ignored, because the program's own options choose them. Whatever no function takes or looks up is named at the end
 * (koksma__xml_name_unread). The file is long because all of Mitsuba's names are in one place.
 */
#include "scene/mitsuba.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/capacity.h"
#include "core/vector.h"
#include "render/fields.h"
#include "render/lights/lights.h"
#include "render/materials/materials.h"
#include "render/medium.h"

enum { MOST_NESTED = 16 };

typedef koksma__xml_node node;

/* A value of another type than it is read as, or a node that is looked at when the scene has taken too many steps. */
typedef struct mistake {
    const node *at;       /* or NULL */
    const char *expected; /* NULL: too many steps */
} mistake;

/* The name by which a <ref> finds an element. */
typedef struct identity {
    const char *name;
    const node *at; /* an <alias> has the element's name in its attribute "id" */
} identity;

typedef struct reader {
    koksma__import *im;
    koksma__xml xml;
    mistake *mistake;     /* the first one */
    identity *identities; /* sorted by name */
    size_t n_identities;
    int *materials; /* index of the material of each node; -2: not converted yet, -1: light passes through */
    bool *looked;   /* for each node: whether its properties were looked up */
    bool has_sensor;
    const node *medium, *filled; /* the only medium that is read, and the cube or sphere that it fills; or NULL */
    koksma__medium region;       /* where `filled` is, if it is not NULL */
} reader;

/* ---- Properties -------------------------------------------------------------------------------------------- */

static bool is(const node *n, const char *tag)
{
    return !strcasecmp(n->tag, tag); /* lookAt was the name in Mitsuba 0.6 */
}

static const char *type_of(const node *n)
{
    const char *type = koksma__xml_attribute(n, "type");
    return type ? type : "";
}

/* Notes that a value has another type than it is read as. The first one is the error in which reading ends. */
static void note(const reader *r, const node *n, const char *expected)
{
    if (!r->mistake->at) {
        *r->mistake = (mistake){n, expected};
    }
}

/* A node that is looked at, which counts as work with its text; NULL for NULL. A scene that has taken too many steps has
   no more nodes, so that all loops over them end. */
static const node *count(const reader *r, const node *n, uint64_t steps)
{
    if (n && koksma__import_spend(r->im, n->place, steps + n->length / 16)) {
        note(r, n, NULL);
        return NULL;
    }
    return n;
}

static const node *look_at(const reader *r, int i)
{
    return i < 0 ? NULL : count(r, &r->xml.nodes[i], 1);
}

static const node *first_of(const reader *r, const node *n)
{
    return look_at(r, n->first);
}

static const node *next_of(const reader *r, const node *n)
{
    return look_at(r, n->next);
}

/* Whether elements with this tag are values or objects that a property can be. */
static bool is_property(const node *n)
{
    static const char *const tags[] = {"float",     "integer", "boolean", "string",   "point",     "vector",
                                       "rgb",       "srgb",    "color",   "spectrum", "blackbody", "transform",
                                       "animation", "texture", "bsdf",    "emitter",  "medium",    "volume",
                                       "phase",     "film",    "sampler", "rfilter",  "shape",     "ref"};
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        if (is(n, tags[i])) {
            return true;
        }
    }
    return false;
}

/* The child element whose attribute "name" is `name`, or NULL. */
static const node *property(const reader *r, const node *n, const char *name)
{
    r->looked[n - r->xml.nodes] = true;
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const char *has = koksma__xml_attribute(c, "name");
        if (has && koksma__xml_alike(has, name) && is_property(c)) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            return c;
        }
    }
    return NULL;
}

/* Warns of what becomes of a node, which covers all that it contains. */
#define REPLACE(r, n, ...)                                                                                           \
    (koksma__xml_mark(n, KOKSMA__XML_COVERED), koksma__import_unknown((r)->im, (n)->place, __VA_ARGS__))

/* Takes the properties of this list of names, which have no effect on the pictures that are made here. */
static void pass(const reader *r, const node *n, const char *names)
{
    char name[64];
    for (int length; sscanf(names, "%63s%n", name, &length) == 1; names += length) {
        property(r, n, name);
    }
}

static const char *text(const reader *r, const node *n, const char *name, const char *otherwise)
{
    const node *c = property(r, n, name);
    const char *value = c && is(c, "string") ? koksma__xml_attribute(c, "value") : NULL;
    if (c && !value) {
        note(r, c, "a text");
    }
    return value ? value : otherwise;
}

/* The index of the text in the list of those that are possible, which ends with NULL; without a text, 0. Mitsuba, too,
   compares most of these texts without case. */
static size_t choice(const reader *r, const node *n, const char *name, const char *const *all)
{
    const char *value = text(r, n, name, all[0]);
    size_t i = 0;
    while (all[i] && strcasecmp(all[i], value) != 0) {
        i++;
    }
    if (!all[i]) {
        note(r, property(r, n, name), "a value that this property can have");
    }
    return all[i] ? i : 0;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const identity *)a)->name, ((const identity *)b)->name);
}

/* The element to which a <ref> or an <alias> leads, or NULL; any other element is itself. */
static const node *target(const reader *r, const node *n)
{
    for (int hops = 0; n && (is(n, "ref") || is(n, "alias")); hops++) {
        const identity wanted = {koksma__xml_attribute(n, "id"), NULL};
        const identity *found = wanted.name && hops < MOST_NESTED
                                    ? bsearch(&wanted, r->identities, r->n_identities, sizeof wanted, by_name)
                                    : NULL;
        n = count(r, found ? found->at : NULL, 4);
    }
    return n;
}

/* The same after find_identities(), which has checked that no <ref> leads nowhere. */
static const node *resolve(const reader *r, const node *n)
{
    const node *to = target(r, n);
    return to ? to : n;
}

/* Lists the names of all elements, and checks that each name is given once and that each <ref> leads to one. */
static koksma_status find_identities(reader *r)
{
    r->identities = calloc(r->xml.n + 1, sizeof *r->identities);
    KOKSMA__REQUIRE_MEMORY(r->identities, (r->xml.n + 1) * sizeof *r->identities);
    for (const node *n = r->xml.nodes; n < r->xml.nodes + r->xml.n; n++) {
        const char *name = koksma__xml_attribute(n, is(n, "alias") ? "as" : "id");
        if (name && !is(n, "ref")) {
            r->identities[r->n_identities++] = (identity){name, n};
        }
    }
    qsort(r->identities, r->n_identities, sizeof *r->identities, by_name);
    for (size_t i = 1; i < r->n_identities; i++) {
        const identity *a = &r->identities[i - 1], *b = a + 1;
        if (!by_name(a, b)) {
            return koksma__import_fail((a->at > b->at ? a : b)->at->place, "the id '%.60s' is given twice", a->name);
        }
    }
    for (const node *n = r->xml.nodes; n < r->xml.nodes + r->xml.n; n++) {
        const node *to = target(r, n);
        if (!to) {
            const char *id = koksma__xml_attribute(n, "id");
            return koksma__import_fail(n->place, "%s: no element has the id '%.60s'", n->tag, id ? id : "");
        }
        koksma__xml_mark(to, to != n && is_property(to) ? KOKSMA__XML_TAKEN
                                                        : 0); /* if nothing takes the <ref>, that is named */
    }
    return KOKSMA_OK;
}

static double number(const reader *r, const node *n, const char *name, double otherwise)
{
    const node *c = property(r, n, name), *to = c ? resolve(r, c) : NULL;
    double x = otherwise;
    if (to && (is(to, "texture") || (koksma__mitsuba_is_colour(to) && !koksma__mitsuba_is_number(to)))) {
        c->marks[0] &= (unsigned char)~KOKSMA__XML_TAKEN; /* it varies, which is not read here */
    } else if (c && (!koksma__mitsuba_is_number(c) || koksma__mitsuba_number(c, "value", &x))) {
        note(r, c, "a number");
    }
    return x;
}

static bool flag(const reader *r, const node *n, const char *name, bool otherwise)
{
    const node *c = property(r, n, name);
    bool is_set = otherwise;
    if (c && (!is(c, "boolean") || koksma__mitsuba_flag(c, &is_set))) {
        note(r, c, "true or false");
    }
    return is_set;
}

/* Reads an element of the form <point name x y z> or <point name value="x, y, z">. */
static void point(const reader *r, const node *n, const char *name, double out[3])
{
    const node *c = property(r, n, name);
    if (c && ((!is(c, "point") && !is(c, "vector")) || koksma__mitsuba_triple(c, (double)INFINITY, out))) {
        note(r, c, "a point or vector");
    }
}

/* ---- Transforms -------------------------------------------------------------------------------------------- */

/* Reads a transform, whose first operation is applied first. */
static koksma_status transform(const reader *r, const node *n, const char *name, double out[12])
{
    const node *t = property(r, n, name);
    memcpy(out, koksma__import_identity, sizeof koksma__import_identity);
    if (t && !is(t, "animation") && !is(t, "transform")) {
        note(r, t, "a transform");
    }
    if (t && is(t, "animation")) {
        KOKSMA__TRY(REPLACE(r, t, "motion is ignored: the transform of the first time is taken"));
        t = first_of(r, t);
    }
    for (const node *c = t ? first_of(r, t) : NULL; c; c = next_of(r, c)) {
        double by[12], product[12];
        koksma__xml_mark(c, KOKSMA__XML_TAKEN);
        KOKSMA__TRY(koksma__import_spend(r->im, c->place, 8));
        KOKSMA__TRY(koksma__mitsuba_operation(c, by));
        koksma__matrix_multiply(by, out, product);
        memcpy(out, product, sizeof product);
    }
    return KOKSMA_OK;
}

/* ---- Colours and textures ----------------------------------------------------------------------------------- */

static koksma_status value_of(reader *r, const node *n, koksma__spectrum_use use, double rgb[3])
{
    koksma__mitsuba_colour c;
    if (!koksma__mitsuba_is_colour(n)) {
        rgb[0] = rgb[1] = rgb[2] = 1;
        return koksma__xml_attribute(n, "type") ? REPLACE(r, n, "'%s' is replaced by white where a colour is", n->tag)
                                                : koksma__import_fail(n->place, "<%s> is not a colour", n->tag);
    }
    KOKSMA__TRY(koksma__import_spend(r->im, n->place, is(n, "spectrum") ? KOKSMA__SPECTRUM_STEPS : 0));
    KOKSMA__TRY(koksma__mitsuba_colour_read(n, &c));
    if (c.form == KOKSMA__ONE_NUMBER && use == KOKSMA__EMISSION && is(n, "spectrum")) {
        /* one number stands for the same emission at all wavelengths */
        c.form = KOKSMA__PAIRS;
        (void)(koksma__sampled_spectrum_add(&c.pairs, 360, c.rgb[0]) &&
               koksma__sampled_spectrum_add(&c.pairs, 830, c.rgb[0]));
    }
    if (c.form == KOKSMA__PAIRS) {
        koksma__sampled_spectrum_colour(&c.pairs, use, rgb);
        return KOKSMA_OK;
    }
    const double low = fmin(fmin(c.rgb[0], c.rgb[1]), c.rgb[2]), high = fmax(fmax(c.rgb[0], c.rgb[1]), c.rgb[2]);
    KOKSMA__TRY(use == KOKSMA__REFLECTANCE && (low < 0 || high > 1)
                    ? koksma__import_unknown(r->im, n->place, "a reflectance beyond 0 to 1 is clamped")
                    : KOKSMA_OK);
    for (int k = 0; k < 3; k++) {
        rgb[k] = c.form == KOKSMA__NO_COLOUR ? 1 : c.rgb[k];
    }
    return c.form == KOKSMA__NO_COLOUR ? koksma__import_unknown(r->im, n->place, "a spectrum is replaced by white")
           : c.form == KOKSMA__BLACK_BODY
               ? koksma__import_unknown(r->im, n->place, "a black body is replaced by its colour with luminance 1")
               : KOKSMA_OK;
}

static koksma_status colour(reader *r, const node *n, const char *name, double otherwise, koksma__import_colour *out,
                            int depth);
static koksma_status colour_for(reader *r, const node *n, const char *name, double otherwise,
                                koksma__spectrum_use use, koksma__import_colour *out, int depth);

/* Reads a texture's transform of the plane z = 0: the third row and column have no effect. */
static koksma_status set_matrix(reader *r, const node *n, koksma__mapping *to)
{
    /* in place of to_uv, Mitsuba 0.6 has four numbers, of which Mitsuba 3 moves by the offsets first */
    static const char *const older[] = {"uscale", "vscale", "uoffset", "voffset"};
    static const float unmoved[6] = {1, 0, 0, 0, 1, 0};
    const node *t = property(r, n, "to_uv");
    double m[12], by[4] = {1, 1, 0, 0}, all[6];
    KOKSMA__TRY(transform(r, n, "to_uv", m));
    for (size_t i = 0; !t && i < 4; i++) {
        by[i] = number(r, n, older[i], by[i]);
    }
    for (int i = 0; i < 6; i++) {
        all[i] = by[i / 3] * (m[i / 3 * 4 + (i % 3 < 2 ? i % 3 : 3)] + (i % 3 == 2 ? by[2 + i / 3] : 0));
        to->matrix[i] = (float)all[i];
    }
    to->moved = memcmp(to->matrix, unmoved, sizeof unmoved) != 0;
    return koksma__import_check_uv(t ? t->place : n->place, all, 6);
}

/* Reads how an image is mapped. */
static koksma_status set_mapping(reader *r, const node *n, koksma__mapping *to)
{
    /* Mitsuba 0.6 has four more: it filters by MIP maps unless the file says "nearest" */
    static const char *const wraps[] = {"repeat", "clamp", "mirror", "zero", "one", NULL};
    static const char *const filters[] = {"bilinear", "nearest", "trilinear", "ewa", NULL};
    static const koksma__wrap kinds[] = {KOKSMA__WRAP_REPEAT, KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_MIRROR,
                                         KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_CLAMP};
    const size_t wrap = choice(r, n, "wrap_mode", wraps), filter = choice(r, n, "filter_type", filters);
    to->wrap[0] = to->wrap[1] = kinds[wrap];
    to->nearest = filter == 1;
    if (wrap > 2) {
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "a texture's wrap mode '%s' is replaced by 'clamp'",
                                           wraps[wrap]));
    }
    if (filter > 1) {
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "a texture's filter '%s' is replaced by 'bilinear'",
                                           filters[filter]));
    }
    return set_matrix(r, n, to);
}

/* Fails if an object lacks a property that Mitsuba has no default for. */
static koksma_status needed(const reader *r, const node *n, const char *name)
{
    return property(r, n, name) ? KOKSMA_OK
                                : koksma__import_fail(n->place, "%s '%s': no '%s'", n->tag, type_of(n), name);
}

/* Whether an element is an object that stands for a colour; Mitsuba 3 takes its spectra for textures. */
static bool is_texture(const node *n)
{
    return is(n, "texture") || (is(n, "spectrum") && koksma__xml_attribute(n, "type"));
}

static koksma_status texture(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out,
                             int depth);

/* Reads the spectrum "d65", daylight times a colour or texture. Daylight itself is white, and samples are its factors:
   those of 1 everywhere leave it white, also in a light. */
static koksma_status in_daylight(reader *r, const node *n, koksma__import_colour *out, int depth)
{
    const double scale = number(r, n, "scale", 1);
    const node *inner = NULL;
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        if (is_texture(resolve(r, c))) {
            KOKSMA__TRY(inner ? koksma__import_fail(c->place, "spectrum 'd65': more than one texture") : KOKSMA_OK);
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            inner = resolve(r, c);
        }
    }
    KOKSMA__TRY(inner ? texture(r, inner, KOKSMA__UNBOUNDED, out, depth + 1)
                      : colour(r, n, "color", 1, out, depth + 1));
    for (int k = 0; k < 3; k++) {
        out->rgb[k] *= scale;
        out->second[k] *= scale;
    }
    out->image_scale *= scale;
    return KOKSMA_OK;
}

/* Reads the spectra "regular" and "irregular": samples at equal distances, or at those that are listed. */
static koksma_status samples(reader *r, const node *n, bool regular, koksma__spectrum_use use, double rgb[3])
{
    const node *pairs = property(r, n, "value"), *values = property(r, n, "values");
    koksma__sampled_spectrum s = {0};
    if (pairs) {
        return value_of(r, resolve(r, pairs), use, rgb);
    }
    KOKSMA__TRY(values ? KOKSMA_OK : needed(r, n, "values"));
    KOKSMA__TRY(koksma__import_spend(r->im, n->place, KOKSMA__SPECTRUM_STEPS));
    const bool older = property(r, n, "lambda_min") && property(r, n, "lambda_max"); /* Mitsuba 2 */
    const char *const low = older ? "lambda_min" : "wavelength_min", *high = older ? "lambda_max" : "wavelength_max";
    KOKSMA__TRY(needed(r, n, regular ? low : "wavelengths"));
    KOKSMA__TRY(regular ? needed(r, n, high) : KOKSMA_OK);
    (void)text(r, n, "values", "");
    if (regular) {
        const double from = number(r, n, low, 360), to = number(r, n, high, 830);
        KOKSMA__TRY(koksma__mitsuba_samples(values, NULL, from, to, &s));
    } else {
        (void)text(r, n, "wavelengths", "");
        KOKSMA__TRY(koksma__mitsuba_samples(values, property(r, n, "wavelengths"), 0, 0, &s));
    }
    koksma__sampled_spectrum_colour(&s, use, rgb);
    return KOKSMA_OK;
}

typedef enum spectrum_kind {
    D65,
    COLOUR_IN_D65, /* the name of "d65" with a colour in Mitsuba 2 */
    UNIFORM,
    SRGB,
    REGULAR,
    IRREGULAR,
    BLACK_BODY,
    NO_SPECTRUM
} spectrum_kind;

/* The kind of spectrum that an object is; NO_SPECTRUM: none that is read. */
static spectrum_kind kind_of_spectrum(const node *n)
{
    static const char *const all[] = {"d65", "srgb_d65", "uniform", "srgb", "regular", "irregular", "blackbody"};
    int kind = 0;
    while (kind < NO_SPECTRUM && strcmp(all[kind], type_of(n)) != 0) {
        kind++;
    }
    return (spectrum_kind)kind;
}

/* Reads the object of a spectrum as the RGB variants of Mitsuba do, and sampled ones as the observer sees them; *known
   tells whether there is such a kind. */
static koksma_status spectrum(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out,
                              int depth, bool *known)
{
    const spectrum_kind kind = kind_of_spectrum(n);
    *known = kind != NO_SPECTRUM;
    if (!*known) {
        return KOKSMA_OK;
    }
    switch (kind) {
    case COLOUR_IN_D65:
        KOKSMA__TRY(needed(r, n, "color"));
        return in_daylight(r, n, out, depth);
    case D65:
        return in_daylight(r, n, out, depth);
    case UNIFORM:
        KOKSMA__TRY(needed(r, n, "value"));
        /* the range of wavelengths only tells where Mitsuba samples */
        property(r, n, "wavelength_min");
        property(r, n, "wavelength_max");
        out->rgb[0] = out->rgb[1] = out->rgb[2] = number(r, n, "value", 1);
        return KOKSMA_OK;
    case SRGB:
        KOKSMA__TRY(needed(r, n, "color"));
        property(r, n, "unbounded");
        return colour(r, n, "color", 1, out, depth + 1);
    case BLACK_BODY: {
        KOKSMA__TRY(needed(r, n, "temperature"));
        const double kelvins = number(r, n, "temperature", 6500);
        if (!(kelvins > 0)) {
            return koksma__import_fail(n->place, "a temperature of %g kelvins; it must be above 0", kelvins);
        }
        koksma__import_black_body(kelvins, out->rgb);
        return koksma__import_unknown(r->im, n->place, "a black body is replaced by its colour with luminance 1");
    }
    default:
        return samples(r, n, kind == REGULAR, use, out->rgb);
    }
}

static koksma_status texture(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out,
                             int depth)
{
    const char *type = type_of(n);
    bool known;
    if (depth > MOST_NESTED) {
        return koksma__import_fail(n->place, "textures are nested more than %d deep", MOST_NESTED);
    }
    if (!strcmp(type, "bitmap")) {
        const char *name = text(r, n, "filename", ""), *dot = strrchr(name, '.');
        const bool linear = dot && (!strcasecmp(dot, ".exr") || !strcasecmp(dot, ".pfm"));
        KOKSMA__TRY(flag(r, n, "raw", false) && !linear
                        ? koksma__import_unknown(r->im, n->place, "a texture's 'raw' is ignored: its levels are sRGB")
                        : KOKSMA_OK);
        KOKSMA__TRY(set_mapping(r, n, &out->mapping));
        out->image_scale = 1;
        return koksma__import_path(r->im, n->place, name, out->image);
    }
    if (!strcmp(type, "checkerboard")) {
        koksma__import_colour second;
        const koksma__spectrum_use each = use == KOKSMA__REFLECTANCE ? use : KOKSMA__UNBOUNDED;
        KOKSMA__TRY(colour_for(r, n, "color0", 0.4, each, out, depth + 1));
        KOKSMA__TRY(colour_for(r, n, "color1", 0.2, each, &second, depth + 1));
        KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a texture in a checkerboard", use, out));
        KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a texture in a checkerboard", use, &second));
        KOKSMA__TRY(set_matrix(r, n, &out->mapping));
        memcpy(out->second, second.rgb, sizeof second.rgb);
        out->is_checker = true;
        out->period = 0.5;
        return KOKSMA_OK;
    }
    KOKSMA__TRY(spectrum(r, n, use, out, depth, &known));
    if (!known && is(n, "spectrum")) {
        out->rgb[0] = out->rgb[1] = out->rgb[2] = 1;
        return REPLACE(r, n, "spectrum '%s' is replaced by white", type);
    }
    return known ? KOKSMA_OK : REPLACE(r, n, "texture '%s' is replaced by grey", type);
}

/* What the samples of a property are. Those of the spectra "d65" and "srgb" are factors of daylight, also in a light;
   in media they are coefficients (an albedo is bounded where it is used). */
static koksma__spectrum_use use_of(const node *n, const char *name)
{
    const bool unbounded =
        is(n, "spectrum") || is(n, "medium") || is(n, "volume") || !strcmp(name, "eta") || !strcmp(name, "k");
    return is(n, "emitter") ? KOKSMA__EMISSION : unbounded ? KOKSMA__UNBOUNDED : KOKSMA__REFLECTANCE;
}

/* Reads the colour or texture with this name; without one, *out is grey with the value `otherwise`. */
static koksma_status colour_for(reader *r, const node *n, const char *name, double otherwise,
                                koksma__spectrum_use use, koksma__import_colour *out, int depth)
{
    const node *found = property(r, n, name);
    *out = (koksma__import_colour){.rgb = {otherwise, otherwise, otherwise}, .period = 1};
    if (!found) {
        return KOKSMA_OK;
    }
    found = resolve(r, found);
    return is_texture(found) ? texture(r, found, use, out, depth) : value_of(r, found, use, out->rgb);
}

/* The same, for what the name says. */
static koksma_status colour(reader *r, const node *n, const char *name, double otherwise, koksma__import_colour *out,
                            int depth)
{
    return colour_for(r, n, name, otherwise, use_of(n, name), out, depth);
}

/* ---- BSDFs ------------------------------------------------------------------------------------------------- */

/* Mitsuba's kinds of BSDFs and the materials that replace them; a material that is only similar gives a warning. */
typedef struct bsdf_kind {
    const char *name;
    int kind;           /* kind of the replacement; -1: light passes through */
    const char *colour; /* name of the BSDF's parameter for the diffuse albedo or the reflectance */
    double otherwise, alpha;
    const char *instead; /* the replacement's name in a warning, or NULL for no warning */
} bsdf_kind;

static const bsdf_kind kinds[] = {{"diffuse", KOKSMA__MATTE, "reflectance", 0.5, 0, NULL},
                                  {"roughdiffuse", KOKSMA__MATTE, "reflectance", 0.5, 0, "Lambert"},
                                  {"conductor", KOKSMA__METAL, "specular_reflectance", 1, 0, NULL},
                                  {"roughconductor", KOKSMA__METAL, "specular_reflectance", 1, 0.1, NULL},
                                  {"dielectric", KOKSMA__GLASS, "specular_transmittance", 1, 0, NULL},
                                  {"roughdielectric", KOKSMA__GLASS, "specular_transmittance", 1, 0.1, NULL},
                                  {"plastic", KOKSMA__COATED, "diffuse_reflectance", 0.5, 0, NULL},
                                  {"roughplastic", KOKSMA__COATED, "diffuse_reflectance", 0.5, 0.1, NULL},
                                  {"pplastic", KOKSMA__COATED, "diffuse_reflectance", 0.5, 0.1, "unpolarised"},
                                  {"polarizer", -1, "", 0, 0, "nothing"},
                                  {"phong", KOKSMA__MATTE, "diffuse_reflectance", 0.5, 0, "its diffuse part"},
                                  {"thindielectric", -1, "", 0, 0, "nothing"},
                                  {"null", -1, "", 0, 0, NULL}};

/* BSDFs that contain others: each is replaced by the first BSDF inside it; a second one is that of the back. */
static const struct {
    const char *name;
    bool is_exact;
} wrappers[] = {{"twosided", true},
                {"bumpmap", false},
                {"normalmap", false},
                {"coating", false},
                {"mixturebsdf", false},
                /* of Mitsuba 0.6 */
                {"bump", false},
                {"roughcoating", false}};

/* An index of refraction: a number or the name of a material. One that is not above 0 is a mistake. */
static double index_of(const reader *r, const node *n, const char *name, double otherwise)
{
    static const struct {
        const char *name;
        double ior;
    } known[] = {{"vacuum", 1},        {"helium", 1.000036},        {"hydrogen", 1.000132},
                 {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
                 {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
                 {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
                 {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
                 {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
                 {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
                 {"pet", 1.575},       {"diamond", 2.419}};
    const node *c = property(r, n, name);
    const char *value = c && is(c, "string") ? text(r, n, name, "") : NULL;
    for (size_t i = 0; value && i < sizeof known / sizeof *known; i++) {
        if (!strcasecmp(known[i].name, value)) {
            return known[i].ior;
        }
    }
    const double ior = number(r, n, name, otherwise);
    if (!(ior > 0)) {
        note(r, c, "an index of refraction; it must be above 0");
    }
    return ior;
}

/* Reads eta or k of a metal. An object that is not one colour, or a spectrum in a file, is not read and makes *is_constant
   false. */
static koksma_status constant(reader *r, const node *n, const char *name, double otherwise, bool *is_constant,
                              double rgb[3])
{
    const node *found = property(r, n, name), *to = found ? resolve(r, found) : NULL;
    koksma__import_colour c = {.rgb = {otherwise, otherwise, otherwise}};
    const bool is_object = to && !koksma__mitsuba_is_colour(to) && koksma__xml_attribute(to, "type");
    const bool is_file = to && is(to, "spectrum") && koksma__xml_attribute(to, "filename");
    if (to && is_texture(to) ? kind_of_spectrum(to) == NO_SPECTRUM : is_object || is_file) {
        *is_constant = false;
        koksma__xml_mark(found, KOKSMA__XML_COVERED);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(colour(r, n, name, otherwise, &c, 0));
    *is_constant &= !*c.image && !c.is_checker;
    memcpy(rgb, c.rgb, sizeof c.rgb);
    return KOKSMA_OK;
}

/* A metal has one colour. */
static koksma_status mean_of_metal(reader *r, const node *n, koksma__import_material *m)
{
    return m->kind == KOKSMA__METAL
               ? koksma__import_mean(r->im, n->place, "a metal's texture", KOKSMA__REFLECTANCE, &m->colour)
               : KOKSMA_OK;
}

/* Finds eta and k of a conductor in the RGB variants of Mitsuba 3.9.1, which are
   mi.traverse(mi.load_dict({'type': 'conductor', 'material': NAME})). */
static bool find_conductor(const char *name, double eta[3], double k[3])
{
    static const struct {
        const char *name;
        double eta[3], k[3];
    } all[] = {
        {"a-C", {2.944, 2.227, 1.968}, {0.8875, 0.7993, 0.8153}},
        {"Ag", {0.1553, 0.1167, 0.1384}, {4.828, 3.122, 2.147}},
        {"Al", {1.658, 0.8804, 0.5212}, {9.224, 6.27, 4.837}},
        {"AlAs", {3.605, 3.233, 2.216}, {0.0006794, 0, 0.007513}},
        {"AlSb", {0, 4.139, 4.669}, {0, 0.09401, 1.301}},
        {"Au", {0.143, 0.3753, 1.442}, {3.983, 2.386, 1.603}},
        {"Be", {4.185, 3.185, 2.784}, {3.835, 3.01, 2.869}},
        {"Cr", {4.37, 2.917, 1.655}, {5.207, 4.231, 3.755}},
        {"CsI", {2.145, 1.702, 1.662}, {0, 0, 0}},
        {"Cu", {0.201, 0.9237, 1.102}, {3.913, 2.453, 2.142}},
        {"Cu2O", {3.552, 2.95, 2.752}, {0.1142, 0.1939, 0.6061}},
        {"CuO", {3.248, 2.448, 2.21}, {0.5211, 0.57, 0.7222}},
        {"d-C", {2.709, 2.319, 2.229}, {0, 0, 0}},
        {"Hg", {2.399, 1.44, 0.9096}, {6.328, 4.372, 3.422}},
        {"HgTe", {4.779, 3.231, 2.66}, {1.632, 1.581, 1.729}},
        {"Ir", {3.086, 2.082, 1.618}, {5.592, 4.067, 3.267}},
        {"K", {0.06404, 0.04641, 0.03818}, {2.104, 1.349, 0.9131}},
        {"Li", {0.2658, 0.1956, 0.2209}, {3.54, 2.311, 1.669}},
        {"MgO", {2.09, 1.651, 1.595}, {0, 0, 0}},
        {"Mo", {4.484, 3.525, 2.776}, {4.111, 3.421, 3.151}},
        {"Nb", {3.42, 2.79, 2.396}, {3.441, 2.738, 2.58}},
        {"Rh", {2.586, 1.86, 1.554}, {6.782, 4.703, 3.976}},
        {"Se", {4.058, 2.843, 2.821}, {0.754, 0.6384, 0.5218}},
        {"SiC", {3.172, 2.526, 2.479}, {0, 0, 1.019e-05}},
        {"SnTe", {4.524, 1.982, 1.282}, {0, 0, 0}},
        {"Ta", {2.063, 2.393, 2.628}, {2.408, 1.741, 1.947}},
        {"Te", {7.39, 4.482, 2.637}, {3.256, 3.527, 3.292}},
        {"ThF4", {1.831, 1.442, 1.388}, {0, 0, 0}},
        {"TiC", {3.701, 2.837, 2.582}, {3.266, 2.352, 2.173}},
        {"TiN", {1.648, 1.151, 1.38}, {3.368, 1.943, 1.102}},
        {"TiO2", {3.457, 2.802, 2.905}, {0.0001053, 0, 0.0006529}},
        {"VC", {3.658, 2.753, 2.533}, {3.068, 2.199, 1.963}},
        {"VN", {2.866, 2.119, 1.94}, {3.032, 2.056, 1.616}},
        {"W", {4.371, 3.3, 2.998}, {3.501, 2.605, 2.273}},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        if (!strcmp(all[i].name, name)) {
            memcpy(eta, all[i].eta, sizeof all[i].eta);
            memcpy(k, all[i].k, sizeof all[i].k);
            return true;
        }
    }
    return false;
}

/* Reads what a metal is made of: a name, or eta and k. Those metals whose constants Mitsuba does not have reflect as tables
   of import.c say, by Schlick's approximation. */
static koksma_status metal(reader *r, const node *n, koksma__import_material *m)
{
    double rgb[3];
    KOKSMA__TRY(mean_of_metal(r, n, m));
    bool is_constant = true;
    const char *name = text(r, n, "material", property(r, n, "eta") ? "" : "none");
    m->has_index = !*name || find_conductor(name, m->eta, m->k);
    if (!*name) {
        KOKSMA__TRY(constant(r, n, "eta", 0, &is_constant, m->eta));
        KOKSMA__TRY(constant(r, n, "k", 1, &is_constant, m->k));
    } else if (!m->has_index && koksma__import_metal(name, rgb)) {
        for (int i = 0; i < 3; i++) {
            m->colour.rgb[i] *= rgb[i];
        }
        return strcmp(name, "none") != 0
                   ? koksma__import_unknown(r->im, n->place, "metal '%s' has Schlick's reflectance", name)
                   : KOKSMA_OK;
    }
    if (!m->has_index || !is_constant) {
        KOKSMA__TRY(
            m->has_index
                ? koksma__import_unknown(r->im, n->place,
                                         "a metal whose eta or k varies or is in a file is replaced by chromium")
                : koksma__import_unknown(r->im, n->place, "metal '%s' is replaced by chromium", name));
        m->has_index = find_conductor("Cr", m->eta, m->k);
    }
    return KOKSMA_OK;
}

static koksma_status principled(reader *r, const node *n, int *out)
{
    koksma__import_material m = {.ior = 1.5};
    KOKSMA__TRY(
        koksma__import_unknown(r->im, n->place, "BSDF 'principled' is replaced by metal, glass or a coated surface"));
    KOKSMA__TRY(colour(r, n, "base_color", 0.5, &m.colour, 0));
    const double roughness = number(r, n, "roughness", 0.5);
    m.alpha = roughness * roughness;
    m.ior = index_of(r, n, "eta", 1.5);
    m.kind = number(r, n, "metallic", 0) > 0.5     ? KOKSMA__METAL
             : number(r, n, "spec_trans", 0) > 0.5 ? KOKSMA__GLASS
                                                   : KOKSMA__COATED;
    KOKSMA__TRY(mean_of_metal(r, n, &m));
    return koksma__import_add_material(r->im, n->place, &m, out);
}

/* The first child from c on that leads to a BSDF, or NULL. */
static const node *find_inner(const reader *r, const node *c)
{
    while (c && !is(resolve(r, c), "bsdf")) {
        c = next_of(r, c);
    }
    if (c) {
        koksma__xml_mark(c, KOKSMA__XML_TAKEN);
    }
    return c;
}

static koksma_status make_bsdf(reader *r, const node *n, int depth, int *out);

/* Makes a BSDF that light meets only in part ("mask"), or a blend of two ("blendbsdf"). */
static koksma_status blend(reader *r, const node *n, int depth, int *out)
{
    const bool masks = strcmp(type_of(n), "blendbsdf") != 0;
    const node *first = find_inner(r, first_of(r, n)), *second = first ? find_inner(r, next_of(r, first)) : NULL;
    koksma__import_colour share;
    int other = -1;
    if (!first || (!masks && !second)) {
        return koksma__import_fail(n->place, "bsdf '%s': it has %s within it", type_of(n),
                                   masks ? "no BSDF" : "less than two BSDFs");
    }
    KOKSMA__TRY(masks ? KOKSMA_OK : needed(r, n, "weight"));
    KOKSMA__TRY(colour(r, n, masks ? "opacity" : "weight", 0.5, &share, 0));
    KOKSMA__TRY(make_bsdf(r, resolve(r, first), depth + 1, out));
    if (masks) {
        return koksma__import_mask(r->im, n->place, &share, out);
    }
    KOKSMA__TRY(make_bsdf(r, resolve(r, second), depth + 1, &other));
    return koksma__import_mix(r->im, n->place, *out, other, &share, out);
}

static koksma_status make_bsdf(reader *r, const node *n, int depth, int *out)
{
    static const bsdf_kind other = {"", KOKSMA__MATTE, "reflectance", 0.5, 0, "Lambert"};
    static const char *const distributions[] = {"beckmann", "ggx", "phong", "as", NULL};
    const char *type = type_of(n);
    const bsdf_kind *found = &other;
    koksma__import_material m = {0};
    for (size_t i = 0; i < sizeof wrappers / sizeof *wrappers; i++) {
        const bool wraps = !strcmp(wrappers[i].name, type) && depth < MOST_NESTED;
        const node *inner = wraps ? find_inner(r, first_of(r, n)) : NULL;
        if (inner) {
            const node *back = wrappers[i].is_exact ? find_inner(r, next_of(r, inner)) : NULL;
            KOKSMA__TRY(wrappers[i].is_exact ? KOKSMA_OK
                                             : REPLACE(r, n, "BSDF '%s' is replaced by the BSDF within it", type));
            KOKSMA__TRY(back && resolve(r, back) != resolve(r, inner)
                            ? koksma__import_unknown(r->im, back->place,
                                                     "the BSDF of a back is replaced by that of the front")
                            : KOKSMA_OK);
            return make_bsdf(r, resolve(r, inner), depth + 1, out);
        }
    }
    if (!strcmp(type, "principled")) {
        return principled(r, n, out);
    }
    if ((!strcmp(type, "mask") || !strcmp(type, "blendbsdf")) && depth < MOST_NESTED) {
        return blend(r, n, depth, out);
    }
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        found = !strcmp(kinds[i].name, type) ? &kinds[i] : found;
    }
    if (found->instead) {
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "BSDF '%s': %s here", type, found->instead));
    }
    if (found == &other || found->kind < 0) {
        koksma__xml_mark(n, found->instead ? KOKSMA__XML_COVERED : 0);
    }
    *out = -1;
    if (found->kind < 0) {
        return KOKSMA_OK;
    }
    m.kind = (unsigned)found->kind;
    const char *name = found->colour, *older = "diffuse_reflectance"; /* Mitsuba 0.6 has both names */
    name = m.kind == KOKSMA__MATTE && !property(r, n, name) && property(r, n, older) ? older : name;
    KOKSMA__TRY(colour(r, n, name, found->otherwise, &m.colour, 0));
    if (m.kind == KOKSMA__GLASS &&
        !koksma__import_is_white(&m.colour)) { /* a tint would colour what it reflects as well */
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "a glass's '%s' is ignored", found->colour));
    }
    KOKSMA__TRY(m.kind == KOKSMA__METAL ? metal(r, n, &m) : KOKSMA_OK);
    const double both = number(r, n, "alpha", found->alpha);
    const double u = number(r, n, "alpha_u", both), v = number(r, n, "alpha_v", both);
    m.alpha = sqrt(fmax(u * v, 0));
    m.ior = index_of(r, n, "int_ior", m.kind == KOKSMA__COATED ? 1.49 : 1.5046) / index_of(r, n, "ext_ior", 1.000277);
    if (!strncmp(type, "rough", 5) && m.kind != KOKSMA__MATTE && m.kind != KOKSMA__COATED &&
        choice(r, n, "distribution", distributions) != 1) {
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "Beckmann's distribution is replaced by GGX"));
    }
    if (u != v) {
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "anisotropic roughness is replaced by its mean"));
    }
    return koksma__import_add_material(r->im, n->place, &m, out);
}

static koksma_status find_bsdf(reader *r, const node *n, int *out)
{
    int *known = &r->materials[n - r->xml.nodes];
    KOKSMA__TRY(*known == -2 ? make_bsdf(r, n, 0, known) : KOKSMA_OK);
    *out = *known;
    return KOKSMA_OK;
}

/* ---- Shapes ------------------------------------------------------------------------------------------------ */

/* Mitsuba samples no light of weight 0; here all lights are sampled. */
static koksma_status weight(reader *r, const node *n)
{
    return number(r, n, "sampling_weight", 1) > 0
               ? KOKSMA_OK
               : koksma__import_unknown(r->im, n->place, "a light whose sampling weight is 0 is sampled");
}

/* Reads a light of a surface whose material is known: its radiance may be an image. */
static koksma_status area_light(reader *r, const node *n, koksma__import_surface *surface)
{
    koksma__import_colour radiance;
    KOKSMA__TRY(weight(r, n));
    KOKSMA__TRY(colour(r, n, "radiance", 1, &radiance, 0));
    KOKSMA__TRY(koksma__import_glow(r->im, n->place, &radiance, surface));
    if (!*radiance.image) {
        KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a light's texture", KOKSMA__EMISSION, &radiance));
        memcpy(surface->radiance, radiance.rgb, sizeof radiance.rgb);
    }
    surface->emits = true;
    return strcmp(type_of(n), "area") != 0 ? koksma__import_unknown(r->im, n->place, "a light's direction is ignored")
                                           : KOKSMA_OK;
}

/* Finds a shape's material and emission among its children. */
static koksma_status surface_of(reader *r, const node *n, koksma__import_surface *out)
{
    const node *light = NULL;
    bool has_bsdf = false;
    *out = (koksma__import_surface){.material = -1, .turned = flag(r, n, "flip_normals", false)};
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const node *to = resolve(r, c);
        if (is(to, "bsdf") || is(to, "emitter")) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
        }
        if (is(to, "bsdf")) {
            KOKSMA__TRY(find_bsdf(r, to, &out->material));
            has_bsdf = true;
        }
        light = is(to, "emitter") ? to : light;
    }
    KOKSMA__TRY(light ? area_light(r, light, out) : KOKSMA_OK);
    if (!has_bsdf && !out->emits) {
        const koksma__import_material grey = {.kind = KOKSMA__MATTE, .colour = {.rgb = {0.5, 0.5, 0.5}, .period = 1}};
        KOKSMA__TRY(koksma__import_add_material(r->im, n->place, &grey, &out->material));
    }
    return KOKSMA_OK;
}

/* The matrix that places the unit cylinder between p0 and p1. */
static void cylinder(const reader *r, const node *n, double m[12])
{
    double from[3] = {0}, to[3] = {0, 0, 1}, axis[3], side[3], over[3];
    const double radius = number(r, n, "radius", 1);
    point(r, n, "p0", from);
    point(r, n, "p1", to);
    koksma__subtract(to, from, axis);
    const double x[3] = {fabs(axis[0]) <= fabs(axis[1]), fabs(axis[0]) > fabs(axis[1]), 0};
    koksma__cross(x, axis, side);
    koksma__normalise(side);
    koksma__cross(axis, side, over);
    koksma__normalise(over);
    for (int k = 0; k < 3; k++) {
        m[4 * k] = radius * side[k], m[4 * k + 1] = radius * over[k], m[4 * k + 2] = axis[k], m[4 * k + 3] = from[k];
    }
}

/* Finds the basic shape or the mesh for a <shape>, and the matrix that gives it its size. */
static koksma_status form_of(reader *r, const node *n, koksma__import_item *item, double m[12])
{
    static const struct {
        const char *type;
        koksma__form form;
    } forms[] = {{"sphere", KOKSMA__FORM_SPHERE},
                 {"rectangle", KOKSMA__FORM_SQUARE},
                 {"disk", KOKSMA__FORM_DISK},
                 {"cube", KOKSMA__FORM_CUBE},
                 {"cylinder", KOKSMA__FORM_CYLINDER}};
    const char *type = type_of(n);
    const bool numbered = !strcmp(type, "serialized");
    memcpy(m, koksma__import_identity, sizeof koksma__import_identity);
    item->form = KOKSMA__FORM_MESH;
    item->mesh = -1;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++) {
        item->form = !strcmp(forms[i].type, type) ? forms[i].form : item->form;
    }
    if (item->form == KOKSMA__FORM_SPHERE) {
        double centre[3] = {0};
        point(r, n, "center", centre);
        m[0] = m[5] = m[10] = number(r, n, "radius", 1);
        m[3] = centre[0], m[7] = centre[1], m[11] = centre[2];
    } else if (item->form == KOKSMA__FORM_CYLINDER) {
        cylinder(r, n, m);
    } else if (item->form == KOKSMA__FORM_MESH && (!strcmp(type, "obj") || !strcmp(type, "ply") || numbered)) {
        const double part = numbered ? number(r, n, "shape_index", 0) : -1;
        if (numbered && !(part >= 0 && part <= 1e9 && part == floor(part))) {
            return koksma__import_fail(n->place, "a shape_index of %g: it is a whole number from 0 on", part);
        }
        const koksma__mesh_rules rules = {.facets = flag(r, n, "face_normals", false),
                                          .smooths = true,
                                          .flips_v = flag(r, n, "flip_tex_coords", !strcmp(type, "obj"))};
        return koksma__import_mesh_file(r->im, n->place, text(r, n, "filename", ""), (long)part, rules, &item->mesh);
    } else if (item->form == KOKSMA__FORM_MESH) {
        return REPLACE(r, n, "shape '%s' is left out", type);
    }
    return KOKSMA_OK;
}

/* ---- Media -------------------------------------------------------------------------------------------------- */

/* The medium of a sensor or shape: the child whose name is `name`, or, if `name` is NULL, the first child that is a
   medium; NULL if there is none. */
static const node *medium_of(const reader *r, const node *n, const char *name)
{
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const char *has = koksma__xml_attribute(c, "name");
        if (is(resolve(r, c), "medium") && (!name || (has && koksma__xml_alike(has, name)))) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            return resolve(r, c);
        }
    }
    return NULL;
}

/* The object that a child of the scene adds: a <ref> is one more of what it names, an <alias> only names it. */
static const node *object_of(const reader *r, const node *c)
{
    return is(c, "alias") ? c : resolve(r, c);
}

/* Sets the region of a medium to the cube or the ball under a matrix; returns false if it is too large, too thin or has no
   inverse. A cube along the axes is a box. */
static bool set_region(const double m[12], bool is_ball, koksma__medium *to)
{
    bool along_axes = !is_ball, fits = true;
    for (int k = 0; k < 3; k++) {
        const double *row = m + 4 * k, size = fabs(row[0]) + fabs(row[1]) + fabs(row[2]);
        const double largest = fmax(fmax(fabs(row[0]), fabs(row[1])), fabs(row[2]));
        to->low[k] = row[3] - size;
        to->high[k] = row[3] + size;
        along_axes &= size - largest <= 1e-6 * size;
        fits &= size > TINY && fabs(to->low[k]) <= FAR && fabs(to->high[k]) <= FAR;
    }
    to->in_shape = !along_axes;
    to->is_ball = is_ball;
    return fits && koksma__import_invert(m, to->inverse);
}

/* Finds the only medium to read. If the first sensor has a medium, it is that one, bounded by the first cube or sphere
   whose interior it fills, or without bounds if there is none. Otherwise it is the first homogeneous medium in a cube or
   sphere. */
static koksma_status find_medium(reader *r, const node *root)
{
    const node *child = first_of(r, root);
    while (child && !is(object_of(r, child), "sensor")) {
        child = next_of(r, child);
    }
    r->medium = child ? medium_of(r, object_of(r, child), NULL) : NULL;
    for (child = first_of(r, root); child && !r->filled; child = next_of(r, child)) {
        const node *n = object_of(r, child);
        const bool is_ball = !strcmp(type_of(n), "sphere");
        const node *inside =
            is(n, "shape") && (is_ball || !strcmp(type_of(n), "cube")) ? medium_of(r, n, "interior") : NULL;
        if (inside && (!r->medium || inside == r->medium) && !strcmp(type_of(inside), "homogeneous")) {
            koksma__import_item item;
            double form[12], to_world[12], m[12];
            KOKSMA__TRY(form_of(r, n, &item, form));
            KOKSMA__TRY(transform(r, n, "to_world", to_world));
            koksma__matrix_multiply(to_world, form, m);
            if (set_region(m, is_ball, &r->region)) {
                r->medium = inside;
                r->filled = n;
            }
        }
    }
    return KOKSMA_OK;
}

/* A medium that is not the one to read is covered by the warning of name_media(). */
static void cover_medium(const reader *r, const node *medium)
{
    if (medium && medium != r->medium) {
        koksma__xml_mark(medium, KOKSMA__XML_COVERED);
    }
}

static bool is_glass(const reader *r, int material)
{
    const koksma__bsdf *bsdf = material < 0 ? NULL : r->im->scene->materials[material].bsdf;
    return bsdf == &koksma__bsdf_dielectric || bsdf == &koksma__bsdf_rough_dielectric;
}

/* Warns about the media of a shape that are not read. */
static koksma_status name_media(reader *r, const node *n, int material)
{
    const node *inside = medium_of(r, n, "interior"), *outside = medium_of(r, n, "exterior");
    cover_medium(r, inside);
    cover_medium(r, outside);
    if (r->im->only_checks) {
        return KOKSMA_OK;
    }
    if (inside && strcmp(type_of(inside), "homogeneous") != 0) {
        return koksma__import_unknown(r->im, inside->place, "media that vary in space are ignored");
    }
    if (inside && n != r->filled) {
        return koksma__import_unknown(
            r->im, n->place, "a medium in a shape is ignored: only one is read, of the sensor, a cube or a sphere");
    }
    if (outside && outside != r->medium) {
        return koksma__import_unknown(r->im, n->place, "a medium around a shape is ignored: only one is read");
    }
    return outside && !inside && is_glass(r, material)
               ? koksma__import_unknown(r->im, n->place, "glass in a medium is filled by the medium")
               : KOKSMA_OK;
}

/* Reads a colour of a medium, which is given directly or by a constant volume, of "color" in Mitsuba 2. */
static koksma_status medium_colour(reader *r, const node *n, const char *name, double otherwise, double rgb[3])
{
    const node *found = property(r, n, name);
    koksma__import_colour c = {.rgb = {otherwise, otherwise, otherwise}};
    found = found ? resolve(r, found) : NULL;
    if (found && is(found, "volume") && strcmp(type_of(found), "constvolume") != 0) {
        KOKSMA__TRY(REPLACE(r, found, "volume '%s' is replaced by %g", type_of(found), otherwise));
    } else {
        KOKSMA__TRY(found && is(found, "volume")
                        ? colour(r, found, property(r, found, "color") ? "color" : "value", 1, &c, 0)
                        : colour(r, n, name, otherwise, &c, 0));
        KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a medium's texture", KOKSMA__UNBOUNDED, &c));
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = c.rgb[k] > 0 ? fmin(c.rgb[k], FAR) : 0;
    }
    return KOKSMA_OK;
}

static koksma_status phase_of(reader *r, const node *n, double *g)
{
    *g = 0;
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const node *phase = resolve(r, c);
        if (is(phase, "phase")) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
        }
        if (is(phase, "phase") && !strcmp(type_of(phase), "hg")) {
            *g = fmax(-0.999, fmin(number(r, phase, "g", 0.8), 0.999));
        } else if (is(phase, "phase") && strcmp(type_of(phase), "isotropic") != 0) {
            return REPLACE(r, phase, "phase function '%s' is replaced by the isotropic", type_of(phase));
        }
    }
    return KOKSMA_OK;
}

/* Sets the scene's medium. Mitsuba gives the extinction and the albedo: their product is the scattering, and the rest
   of the extinction is the absorption. Versions before Mitsuba 2 give scattering and absorption. A scale multiplies
   all coefficients. */
static koksma_status read_medium(reader *r, const node *n)
{
    koksma__medium medium = {0}, *to = r->im->only_checks ? &medium : &r->im->scene->medium;
    double a[3], b[3], g;
    if (strcmp(type_of(n), "homogeneous") != 0 || property(r, n, "material")) {
        return REPLACE(r, n, "media that vary in space, and media named in place of a material, are ignored");
    }
    pass(r, n, "sample_emitters sampling_density");
    const bool old = property(r, n, "sigma_s") || property(r, n, "sigma_a");
    const double scale = fmin(fmax(number(r, n, "scale", 1), 0), FAR);
    KOKSMA__TRY(medium_colour(r, n, old ? "sigma_s" : "albedo", old ? 0 : 0.75, b));
    KOKSMA__TRY(medium_colour(r, n, old ? "sigma_a" : "sigma_t", old ? 0 : 1, a));
    KOKSMA__TRY(phase_of(r, n, &g));
    for (int k = 0; k < 3; k++) {
        const double extinction = scale * (old ? a[k] + b[k] : a[k]);
        b[k] = old ? scale * b[k] : extinction * fmin(b[k], 1);
        a[k] = extinction - b[k];
    }
    koksma__medium_init(to, a, b, g);
    if (r->filled) {
        memcpy(to->low, r->region.low, sizeof to->low);
        memcpy(to->high, r->region.high, sizeof to->high);
        memcpy(to->inverse, r->region.inverse, sizeof to->inverse);
        to->in_shape = r->region.in_shape;
        to->is_ball = r->region.is_ball;
    }
    if (!r->im->only_checks && koksma__medium_check(r->im->scene)) {
        to->is_there = false;
        return koksma__import_unknown(
            r->im, n->place, "the sensor's medium is ignored, because it would absorb all light of distant lights");
    }
    return KOKSMA_OK;
}

static koksma_status shape(reader *r, const node *n, const double outer[12], int depth);

/* Adds the shapes of a group. */
static koksma_status parts_of_group(reader *r, const node *group, const double matrix[12], int depth)
{
    r->looked[group - r->xml.nodes] = true;
    for (const node *c = first_of(r, group); c; c = next_of(r, c)) {
        const node *part = resolve(r, c);
        if (is(part, "shape")) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            KOKSMA__TRY(shape(r, part, matrix, depth + 1));
        }
    }
    return KOKSMA_OK;
}

/* Adds the shapes of the group to which an instance refers. */
static koksma_status instance(reader *r, const node *n, const double outer[12], int depth)
{
    double m[12], matrix[12];
    bool found = false;
    if (depth > MOST_NESTED) {
        return koksma__import_fail(n->place, "instances are nested more than %d deep", MOST_NESTED);
    }
    KOKSMA__TRY(transform(r, n, "to_world", m));
    koksma__matrix_multiply(outer ? outer : koksma__import_identity, m, matrix);
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const node *group = resolve(r, c);
        if (is(group, "shape")) {
            found = true;
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            KOKSMA__TRY(parts_of_group(r, group, matrix, depth));
        }
    }
    return found ? KOKSMA_OK : koksma__import_fail(n->place, "an instance without a reference to a shape group");
}

/* Warns if a shape's normals are turned round to no effect: surfaces that reflect have two sides here, and a sphere of
   glass has its own normals. */
static koksma_status name_flip(reader *r, const node *n, const koksma__import_item *item)
{
    const node *bsdf = find_inner(r, first_of(r, n));
    const char *type = bsdf ? type_of(resolve(r, bsdf)) : "";
    const bool none = item->surface.emits || item->surface.material < 0 || !strcmp(type, "twosided") ||
                      (is_glass(r, item->surface.material) && item->form != KOKSMA__FORM_SPHERE);
    return item->surface.turned && !none
               ? koksma__import_unknown(r->im, n->place, "'flip_normals' is ignored: surfaces have two sides")
               : KOKSMA_OK;
}

static koksma_status shape(reader *r, const node *n, const double outer[12], int depth)
{
    koksma__import_item item = {.place = n->place};
    double form[12], to_world[12];
    if (!strcmp(type_of(n), "shapegroup")) {
        return KOKSMA_OK;
    }
    if (!strcmp(type_of(n), "instance")) {
        return instance(r, n, outer, depth);
    }
    KOKSMA__TRY(form_of(r, n, &item, form));
    if (item.form == KOKSMA__FORM_MESH && item.mesh < 0 && !r->im->only_checks) {
        koksma__xml_mark(n, KOKSMA__XML_COVERED);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(surface_of(r, n, &item.surface));
    KOKSMA__TRY(name_flip(r, n, &item));
    KOKSMA__TRY(
        koksma__import_spend(r->im, n->place, item.mesh < 0 ? 0 : r->im->scene->meshes[item.mesh].n_triangles / 16));
    KOKSMA__TRY(item.surface.emits && item.mesh >= 0 && koksma__mesh_is_curved(&r->im->scene->meshes[item.mesh])
                    ? koksma__import_unknown(r->im, n->place,
                                             "a luminous mesh shines from its flat sides, not by its smooth normals")
                    : KOKSMA_OK);
    KOKSMA__TRY(name_media(r, n, item.surface.material));
    KOKSMA__TRY(transform(r, n, "to_world", to_world));
    koksma__matrix_multiply(to_world, form, item.matrix);
    return koksma__import_put(r->im, &item, outer, NULL);
}

/* ---- Emitters and sensors ------------------------------------------------------------------------------------ */

static koksma_status emitter(reader *r, const node *n)
{
    koksma__light light = {.kind = &koksma__light_point};
    koksma__import_colour c;
    double m[12], along[3] = {0, 0, 1};
    const char *type = type_of(n);
    const bool far = !strcmp(type, "directional"), around = !strcmp(type, "constant");
    KOKSMA__TRY(weight(r, n));
    KOKSMA__TRY(transform(r, n, "to_world", m));
    KOKSMA__TRY(colour(r, n, around ? "radiance" : far ? "irradiance" : "intensity", 1, &c, 0));
    KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a light's texture", KOKSMA__EMISSION, &c));
    memcpy(light.radiance, c.rgb, sizeof c.rgb);
    if (!strcmp(type, "envmap")) {
        const double scale = number(r, n, "scale", 1), rgb[3] = {scale, scale, scale};
        return koksma__import_sky(r->im, n->place, text(r, n, "filename", ""), false, rgb, m);
    }
    if (around || !strcmp(type, "sunsky") || !strcmp(type, "sky") || !strcmp(type, "sun")) {
        light.kind = &koksma__light_environment;
        light.visible = true;
        KOKSMA__TRY(around ? KOKSMA_OK : REPLACE(r, n, "emitter '%s' is replaced by a white sky", type));
    } else if (far) {
        light.kind = &koksma__light_directional;
        point(r, n, "direction", along);
        for (int k = 0; k < 3; k++) {
            light.normal[k] = property(r, n, "direction") ? along[k] : m[4 * k + 2];
        }
        if (!koksma__import_normalise(light.normal)) {
            return koksma__import_fail(n->place, "a directional light without a direction");
        }
    } else {
        for (int k = 0; k < 3; k++) {
            light.centre[k] = m[4 * k + 3];
        }
        point(r, n, "position", light.centre);
        if (!strcmp(type, "spot")) {
            const double outer = number(r, n, "cutoff_angle", 20);
            const node *picture = property(r, n, "texture");
            KOKSMA__TRY(picture ? REPLACE(r, picture, "a spot's texture is ignored") : KOKSMA_OK);
            for (int k = 0; k < 3; k++) {
                along[k] = m[4 * k + 2];
            }
            KOKSMA__TRY(koksma__import_spot(n->place, along, number(r, n, "beam_width", outer * 3 / 4), outer,
                                            KOKSMA__FALLOFF_ANGLE, &light));
        } else if (strcmp(type, "point") != 0) {
            KOKSMA__TRY(REPLACE(r, n, "emitter '%s' is replaced by a point light equal in all directions", type));
        }
    }
    return koksma__import_light(r->im, n->place, &light);
}

/* Objects that choose how a picture is computed or stored, which the program's own options do here, with the names of
   those of their parameters that have no effect on what the picture shows. Those of Mitsuba 0.6 are here, too. */
typedef struct plain_object {
    const char *tag, *type, *parameters;
} plain_object;

#define FILM "file_format pixel_format component_format compensate banner high_quality_edges attach_log"
#define PATHS "rr_depth block_size samples_per_pass timeout"

static const plain_object plain_objects[] = {
    {"sampler", "independent", "sample_count seed"},
    {"sampler", "stratified", "sample_count seed jitter"},
    {"sampler", "multijitter", "sample_count seed jitter"},
    {"sampler", "orthogonal", "sample_count seed jitter strength"},
    {"sampler", "ldsampler", "sample_count seed dimension"},
    {"sampler", "halton", "sample_count scramble"},
    {"sampler", "hammersley", "sample_count scramble"},
    {"sampler", "sobol", "sample_count scramble"},
    {"rfilter", "box", "radius"},
    {"rfilter", "tent", "radius"},
    {"rfilter", "gaussian", "radius stddev"},
    {"rfilter", "mitchell", "a b c"},
    {"rfilter", "catmullrom", ""},
    {"rfilter", "lanczos", "lobes"},
    {"film", "hdrfilm", FILM},
    {"film", "tiledhdrfilm", FILM},
    {"film", "ldrfilm", FILM},
    {"integrator", "path", PATHS},
    {"integrator", "volpath", PATHS},
    {"integrator", "volpathmis", PATHS " use_spectral_mis"},
    {"integrator", "volpath_simple", PATHS},
    {"integrator", "prb", PATHS},
    {"integrator", "prb_basic", PATHS},
    {"integrator", "prbvolpath", PATHS},
    {"integrator", "ptracer", PATHS},
    {"integrator", "bdpt", PATHS " light_image sample_direct"},
    {"integrator", "pssmlt", PATHS " bidirectional direct_samples luminance_samples two_stage p_large"},
    {"integrator", "direct", "emitter_samples bsdf_samples shading_samples block_size samples_per_pass timeout"}};

/* Takes the parameters of such an object; returns false, with a warning, if it has another type. */
static bool plain(reader *r, const node *n, koksma_status *status)
{
    for (size_t i = 0; i < sizeof plain_objects / sizeof *plain_objects; i++) {
        const plain_object *known = &plain_objects[i];
        if (is(n, known->tag) && !strcmp(type_of(n), known->type)) {
            pass(r, n, known->parameters);
            return true;
        }
    }
    *status = REPLACE(r, n, "%s '%s' is ignored", n->tag, type_of(n));
    return false;
}

/* Takes the children of an object that are samplers or filters. */
static koksma_status plain_children(reader *r, const node *n)
{
    koksma_status status = KOKSMA_OK;
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const node *to = resolve(r, c);
        if (is(to, "sampler") || is(to, "rfilter")) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            plain(r, to, &status);
            KOKSMA__TRY(status);
        }
    }
    return KOKSMA_OK;
}

/* Reads the sides of a film. */
static koksma_status film(reader *r, const node *n, double *width, double *height)
{
    static const char *const formats[] = {
        "rgb", "rgba", "xyz", "xyza", "spectrum", "spectrumalpha", "luminance", "luminancealpha", "luminance_alpha",
        NULL};
    koksma_status status = KOKSMA_OK;
    *width = number(r, n, "width", *width);
    *height = number(r, n, "height", *height);
    if (!(*width >= 1 && *height >= 1 && *width <= KOKSMA_MAX_IMAGE_SIDE && *height <= KOKSMA_MAX_IMAGE_SIDE &&
          *width == floor(*width) && *height == floor(*height))) {
        return koksma__import_fail(n->place, "a film of %g x %g pixels; each side must be a whole number, 1 to %d",
                                   *width, *height, KOKSMA_MAX_IMAGE_SIDE);
    }
    if (!plain(r, n, &status)) {
        return status;
    }
    static const char *const crops[] = {"crop_width", "crop_height", "crop_offset_x", "crop_offset_y"};
    bool crops_it = false;
    for (size_t i = 0; i < sizeof crops / sizeof *crops; i++) {
        crops_it |= property(r, n, crops[i]) != NULL;
    }
    KOKSMA__TRY(crops_it ? koksma__import_unknown(r->im, n->place, "a film's crop is ignored") : KOKSMA_OK);
    KOKSMA__TRY(choice(r, n, "pixel_format", formats) > 5
                    ? koksma__import_unknown(r->im, n->place, "a film's 'luminance' is ignored: it has colours")
                    : KOKSMA_OK);
    KOKSMA__TRY(flag(r, n, "sample_border", false)
                    ? koksma__import_unknown(r->im, n->place, "a film's 'sample_border' is ignored")
                    : KOKSMA_OK);
    return plain_children(r, n);
}

/* Reads the objects of a sensor. */
static koksma_status objects_of_sensor(reader *r, const node *n)
{
    double width = 768, height = 576;
    for (const node *child = first_of(r, n); child; child = next_of(r, child)) {
        const node *c = resolve(r, child);
        if (is(c, "film")) {
            koksma__xml_mark(child, KOKSMA__XML_TAKEN);
            KOKSMA__TRY(film(r, c, &width, &height));
        }
    }
    r->im->scene->width = (int)width;
    r->im->scene->height = (int)height;
    return plain_children(r, n);
}

/* The focal length in mm: a number, or a text that may end in "mm". */
static double focal_length(const reader *r, const node *n)
{
    const node *c = property(r, n, "focal_length");
    double length_mm = 50;
    if (!c || koksma__mitsuba_is_number(c)) {
        return number(r, n, "focal_length", length_mm);
    }
    if (!koksma__mitsuba_measure(text(r, n, "focal_length", ""), "mm", &length_mm)) {
        note(r, c, "a length in mm");
    }
    return length_mm;
}

/* The vertical angle of view. */
static double height_angle(const reader *r, const node *n, double width, double height)
{
    static const char *const axes[] = {"x", "y", "diagonal", "smaller", "larger", NULL};
    const double sides[] = {width, height, hypot(width, height), fmin(width, height), fmax(width, height)};
    const double side = sides[choice(r, n, "fov_axis", axes)], half = number(r, n, "fov", 0) * TURN / 720;
    if (property(r, n, "fov")) {
        return 2 * atan(tan(half) * height / side);
    }
    /* focal_length refers to the diagonal of 35 mm film */
    return 2 * atan(hypot(36, 24) / 2 / focal_length(r, n) * height / hypot(width, height));
}

static koksma_status sensor(reader *r, const node *n)
{
    double m[12];
    const char *type = type_of(n);
    const bool lens = !strcmp(type, "thinlens");
    if (r->has_sensor) {
        return REPLACE(r, n, "the scene has a second sensor, which is left out");
    }
    const bool parallel = !strcmp(type, "orthographic");
    if (!lens && !parallel && strcmp(type, "perspective") != 0) {
        return koksma__import_fail(n->place,
                                   "sensor '%s' is not read; 'perspective', 'thinlens' and 'orthographic' are", type);
    }
    r->has_sensor = true;
    KOKSMA__TRY(objects_of_sensor(r, n));
    const double near = number(r, n, "near_clip", 0.01), far = number(r, n, "far_clip", 1e4);
    if (!(near > 0 && far > near)) {
        return koksma__import_fail(
            n->place, "the camera sees from near_clip, above 0, to far_clip: not from %g to %g", near, far);
    }
    pass(r, n, lens ? "shutter_open shutter_close" : "shutter_open shutter_close focus_distance");
    KOKSMA__TRY(transform(r, n, "to_world", m));
    const double width = r->im->scene->width, height = r->im->scene->height;
    koksma__camera camera = {.focus_distance = lens ? number(r, n, "focus_distance", 1) : 1,
                             .lens_radius = lens ? number(r, n, "aperture_radius", 0) : 0,
                             .near_clip = near,
                             .far_clip = far};
    if (parallel) { /* an orthographic sensor shows -1 to 1 along x */
        const double x = sqrt(m[0] * m[0] + m[4] * m[4] + m[8] * m[8]),
                     y = sqrt(m[1] * m[1] + m[5] * m[5] + m[9] * m[9]);
        camera.height = 2 * height / width;
        if (fabs(x - y) > 1e-4 * y) {
            KOKSMA__TRY(koksma__import_unknown(r->im, n->place,
                                               "the camera's scale along x is replaced by the scale along y"));
        }
    } else {
        camera.fov_rad = height_angle(r, n, width, height);
    }
    return koksma__import_camera(r->im, n->place, m, -1, &camera);
}

/* ---- Integrators ---------------------------------------------------------------------------------------------- */

/* Reads what an integrator says of the picture: how long paths are, and whether the camera sees lights. All that estimate
   the same light by other means are path tracing here. */
static koksma_status integrator(reader *r, const node *n, int depth)
{
    koksma_scene *scene = r->im->scene;
    koksma_status status = KOKSMA_OK;
    if (!strcmp(type_of(n), "aov") && depth < MOST_NESTED) { /* the picture is that of the integrator within */
        pass(r, n, "aovs");
        for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
            if (is(resolve(r, c), "integrator")) {
                koksma__xml_mark(c, KOKSMA__XML_TAKEN);
                return integrator(r, resolve(r, c), depth + 1);
            }
        }
    }
    if (!plain(r, n, &status)) {
        return status;
    }
    const bool direct = !strcmp(type_of(n), "direct");
    const double most = direct ? 2 : number(r, n, "max_depth", -1);
    scene->hides_lights = flag(r, n, "hide_emitters", false);
    KOKSMA__TRY(flag(r, n, "strict_normals", false)
                    ? koksma__import_unknown(r->im, n->place, "'strict_normals' is ignored")
                    : KOKSMA_OK);
    if (most >= 0 && most < 2) {
        return koksma__import_unknown(r->im, n->place, "a max_depth of %g is replaced by 2", most);
    }
    /* Mitsuba counts a path's segments, of which one comes from the camera and one from a light; --depth the others */
    scene->path_vertices = 1 + (most < 0 ? KOKSMA_MAX_DEPTH : (int)fmin(most - 2, KOKSMA_MAX_DEPTH));
    return KOKSMA_OK;
}

/* ---- The whole scene ---------------------------------------------------------------------------------------- */

/* Whether the children of a scene with this tag are read, wherever else they are referred to. */
static bool is_of_scene(const node *n)
{
    static const char *const tags[] = {"sensor", "shape", "emitter", "integrator", "bsdf",    "texture", "spectrum",
                                       "medium", "ref",   "alias",   "default",    "include", "path"};
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++) {
        if (is(n, tags[i])) {
            return !is(n, "emitter") || strcmp(type_of(n), "area") != 0;
        }
    }
    return false;
}

/* Reads the objects that nothing refers to, so that what is wrong in them is an error and what is unknown in them a
   warning. */
static koksma_status check_unused(reader *r, const node *root)
{
    double rgb[3];
    int material;
    koksma__import_colour c = {0};
    r->im->only_checks = true;
    for (const node *n = first_of(r, root); n; n = next_of(r, n)) {
        if (r->looked[n - r->xml.nodes]) {
            continue;
        }
        KOKSMA__TRY(is(n, "bsdf")       ? make_bsdf(r, n, 0, &material)
                    : is_texture(n)     ? texture(r, n, KOKSMA__UNBOUNDED, &c, 0)
                    : is(n, "spectrum") ? value_of(r, n, KOKSMA__UNBOUNDED, rgb)
                    : is(n, "shape") && !strcmp(type_of(n), "shapegroup")
                        ? parts_of_group(r, n, koksma__import_identity, 0)
                    : is(n, "medium") ? read_medium(r, n)
                                      : KOKSMA_OK);
    }
    r->im->only_checks = false;
    return KOKSMA_OK;
}

static koksma_status read_root(reader *r)
{
    const node *root = r->xml.n ? r->xml.nodes : NULL;
    if (!root || !is(root, "scene")) {
        return koksma__import_fail((koksma__text_place){r->im->path, 1},
                                   "no <scene>: the file is not a Mitsuba scene");
    }
    KOKSMA__TRY(find_medium(r, root));
    for (const node *c = first_of(r, root); c; c = next_of(r, c)) {
        const node *n = object_of(r, c);
        koksma__xml_mark(c, is_of_scene(c) ? KOKSMA__XML_TAKEN : 0);
        KOKSMA__TRY(is(n, "sensor")                                       ? sensor(r, n)
                    : is(n, "integrator")                                 ? integrator(r, n, 0)
                    : is(n, "shape")                                      ? shape(r, n, NULL, 0)
                    : is(n, "emitter") && strcmp(type_of(n), "area") != 0 ? emitter(r, n)
                                                                          : KOKSMA_OK);
    }
    KOKSMA__TRY(r->has_sensor ? (r->medium ? read_medium(r, r->medium) : KOKSMA_OK)
                              : koksma__import_fail(root->place, "no <sensor>"));
    (void)koksma__xml_attribute(root, "version");
    KOKSMA__TRY(check_unused(r, root));
    koksma__xml_mark(root, KOKSMA__XML_TAKEN);
    return koksma__xml_name_unread(r->im, &r->xml);
}

koksma_status koksma__mitsuba_read(koksma__import *im, const char *bytes, size_t size)
{
    mistake first = {0};
    reader r = {.im = im, .mistake = &first};
    im->rows_down = true;
    koksma_status status = koksma__xml_read(im, bytes, size, &r.xml);
    if (!status) {
        r.materials = malloc((r.xml.n + 1) * sizeof *r.materials);
        r.looked = calloc(r.xml.n + 1, sizeof *r.looked);
        status = r.materials && r.looked ? KOKSMA_OK : koksma__fail_memory(r.xml.n * sizeof *r.materials);
        for (size_t i = 0; r.materials && i < r.xml.n; i++) {
            r.materials[i] = -2;
        }
    }
    status = status ? status : koksma__mitsuba_check(&r.xml);
    status = status ? status : find_identities(&r);
    status = status ? status : read_root(&r);
    if (first.at && status != KOKSMA_MEMORY) {
        const char *name = koksma__xml_attribute(first.at, "name"), *value = koksma__xml_attribute(first.at, "value");
        status = first.expected ? koksma__import_fail(first.at->place, "%s: <%s> '%.60s' is not %s", name,
                                                      first.at->tag, value ? value : "", first.expected)
                                : koksma__import_spend(im, first.at->place, 0);
    }
    KOKSMA__FREE(r.materials, r.looked, r.identities);
    koksma__xml_fini(&r.xml);
    return status;
}
