/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads scenes of Mitsuba 3 (Jakob et al. 2022), and names of Mitsuba 0.6 and 2 that have changed since. xml.c parses
 * the text into a tree, whose sensors, shapes, emitters and BSDFs are converted here. A BSDF is converted when a
 * shape first refers to it. One homogeneous medium is read, of the sensor, a cube or a sphere; volumes and motion
 * are not read. Of an integrator only the length of paths and whether lights are seen is read; samplers and filters are
 * ignored, because the program's own options choose them. Whatever no function takes or looks up is named at the end
 * (koksma__xml_name_unread). The table of plug-ins (mitsuba_names.c) says
 * which properties there are. Long because all objects share the references and marks of one reader.
 */
#include "scene/mitsuba.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/capacity.h"
#include "core/elementary.h"
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

typedef struct reader {
    koksma__import *im;
    koksma__xml xml;
    mistake *mistake;         /* the first one */
    koksma__names identities; /* the elements that a <ref> finds; an <alias> leads to another by its attribute "id" */
    int *materials; /* index of the material of each node; -2: not converted yet, -1: light passes through */
    const koksma__plugin **rows; /* for each node: its row of the table; or NULL */
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

static const node *first_of(const reader *r, const node *n)
{
    return n->first < 0 ? NULL : count(r, &r->xml.nodes[n->first], 1);
}

static const node *next_of(const reader *r, const node *n)
{
    return n->next < 0 ? NULL : count(r, &r->xml.nodes[n->next], 1);
}

/* Whether elements with this tag are values or objects that a property can be. */
static bool is_property(const node *n)
{
    static const char tags[] =
        "float integer boolean string point vector rgb srgb color spectrum blackbody transform "
        "animation texture bsdf emitter medium volume phase film sampler rfilter shape ref";
    return koksma__lists(tags, sizeof tags - 1, ' ', n->tag);
}

/* Whether an element is an object that stands for a colour; Mitsuba 3 takes its spectra for textures. */
static bool is_texture(const node *n)
{
    return is(n, "texture") || (is(n, "spectrum") && koksma__xml_attribute(n, "type"));
}

/* The row of an object in the table of plug-ins; NULL: its kind is unknown. */
static const koksma__plugin *row_of(const reader *r, const node *n)
{
    const koksma__plugin **known = &r->rows[n - r->xml.nodes];
    if (!*known) {
        *known = koksma__plugin_find(&koksma__mitsuba_plugins, is_texture(n) ? "texture" : n->tag, type_of(n));
    }
    return *known;
}

/* Finds the parameter of an object's row. */
static bool entry_of(const reader *r, const node *n, const char *name, koksma__entry *e)
{
    const koksma__plugin *row = row_of(r, n);
    return row && koksma__row_entry(row, name, e);
}

/* The child element that is the property of this entry, or NULL. */
static const node *find_property(const reader *r, const node *n, const koksma__entry *e)
{
    const char *const names[] = {e->name, e->older};
    const size_t lengths[] = {e->length, e->older_length};
    for (size_t i = 0; i < 2 && names[i]; i++) {
        for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
            const char *has = koksma__xml_attribute(c, "name");
            if (has && koksma__xml_alike(has, names[i], lengths[i]) && is_property(c)) {
                return c;
            }
        }
    }
    return NULL;
}

/* The same by its name in the table, in which it must be; it is marked. */
static const node *property(const reader *r, const node *n, const char *name)
{
    koksma__entry e;
    const node *found = entry_of(r, n, name, &e) ? find_property(r, n, &e) : NULL;
    if (found) {
        koksma__xml_mark(found, KOKSMA__XML_TAKEN);
    }
    return found;
}

/* Warns of what becomes of a node, which covers all that it contains. */
/* What may be meant by the type of an object that the table does not have, or "". */
static const char *type_meant(const reader *r, const node *n, char *text)
{
    const koksma__plugin *row = row_of(r, n);
    *text = '\0';
    return row && *row->kinds != '?'
               ? text
               : koksma__kind_meant(&koksma__mitsuba_plugins, is_texture(n) ? "texture" : n->tag, type_of(n), text);
}

#define REPLACE(r, n, ...)                                                                                           \
    (koksma__xml_mark(n, KOKSMA__XML_COVERED), koksma__import_unknown((r)->im, (n)->place, __VA_ARGS__))

/* Takes the properties that have no effect on the pictures that are made here: those of the row with "~", unless they
   have a default, or a list of values, and another value. */
static void pass(const reader *r, const node *n)
{
    const char *at = row_of(r, n)->parameters;
    koksma__entry e = {.type = NULL};
    while (koksma__entry_next(&at, &e)) {
        const node *c = e.without_effect ? find_property(r, n, &e) : NULL;
        const char *value = c ? koksma__xml_attribute(c, "value") : NULL;
        if (c && (!e.otherwise || (value && !strcasecmp(value, "false"))) &&
            (!e.values || (value && koksma__entry_choice(&e, value) >= 0))) {
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
        }
    }
}

/* The text of a property; "" without one. */
static const char *text(const reader *r, const node *n, const char *name)
{
    const node *c = property(r, n, name);
    const char *value = c && is(c, "string") ? koksma__xml_attribute(c, "value") : NULL;
    if (c && !value) {
        note(r, c, "a text");
    }
    return value ? value : "";
}

/* The place of the text in the closed list of those that are possible; without a text, 0. Mitsuba, too, compares most of
   these texts without case. */
static size_t choice(const reader *r, const node *n, const char *name)
{
    koksma__entry e;
    const char *value = text(r, n, name);
    const int i = *value && entry_of(r, n, name, &e) ? koksma__entry_choice(&e, value) : 0;
    if (i < 0) {
        note(r, property(r, n, name), "a value that this property can have");
    }
    return i < 0 ? 0 : (size_t)i;
}

/* The element to which a <ref> or an <alias> leads, or NULL; any other element is itself. */
static const node *target(const reader *r, const node *n)
{
    for (int hops = 0; n && (is(n, "ref") || is(n, "alias")); hops++) {
        const char *id = koksma__xml_attribute(n, "id");
        size_t at = 0;
        const bool found = id && hops < MOST_NESTED && koksma__names_find(&r->identities, id, strlen(id), &at);
        n = count(r, found ? &r->xml.nodes[at] : NULL, 4);
    }
    return n;
}

/* The same after find_identities(), which has checked that no <ref> leads nowhere. */
static const node *resolve(const reader *r, const node *n)
{
    const node *to = target(r, n);
    return to ? to : n;
}

/* The first child from c on that leads to an element with this tag, which is marked; or NULL. */
static const node *find_child(const reader *r, const node *c, const char *tag)
{
    while (c && !is(resolve(r, c), tag)) {
        c = next_of(r, c);
    }
    if (c) {
        koksma__xml_mark(c, KOKSMA__XML_TAKEN);
    }
    return c;
}

/* Walks over the children c of n that lead to elements with this tag. */
#define EACH_CHILD(r, n, c, tag)                                                                                     \
    for (const node *c = find_child(r, first_of(r, n), tag); c; c = find_child(r, next_of(r, c), tag))

/* Lists the names of all elements, and checks that each name is given once and that each <ref> leads to one. */
static koksma_status find_identities(reader *r)
{
    size_t other;
    for (const node *n = r->xml.nodes; n < r->xml.nodes + r->xml.n; n++) {
        const char *name = koksma__xml_attribute(n, is(n, "alias") ? "as" : "id");
        if (!name || is(n, "ref")) {
            continue;
        }
        if (koksma__names_find(&r->identities, name, strlen(name), &other)) {
            return koksma__import_fail(n->place, "the id '%.60s' is given twice", name);
        }
        KOKSMA__TRY(koksma__names_put(&r->identities, name, strlen(name), (size_t)(n - r->xml.nodes)));
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

/* The default of a property, which its row has. */
static double otherwise(const reader *r, const node *n, const char *name)
{
    koksma__entry e;
    return entry_of(r, n, name, &e) ? koksma__entry_number(&e) : 0;
}

static double number(const reader *r, const node *n, const char *name)
{
    const node *c = property(r, n, name), *to = c ? resolve(r, c) : NULL;
    double x = otherwise(r, n, name);
    if (to && (is(to, "texture") || (koksma__mitsuba_is_colour(to) && !koksma__mitsuba_is_number(to)))) {
        c->marks[0] &= (unsigned char)~KOKSMA__XML_TAKEN; /* it varies, which is not read here */
    } else if (c && (!koksma__mitsuba_is_number(c) || koksma__mitsuba_number(c, "value", &x))) {
        note(r, c, "a number");
    }
    return x;
}

static bool flag(const reader *r, const node *n, const char *name)
{
    const node *c = property(r, n, name);
    bool is_set = otherwise(r, n, name) != 0;
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
    KOKSMA__TRY(koksma__import_unknown_if(use == KOKSMA__REFLECTANCE && (low < 0 || high > 1), r->im, n->place,
                                          "a reflectance beyond 0 to 1 is clamped"));
    for (int k = 0; k < 3; k++) {
        rgb[k] = c.form == KOKSMA__NO_COLOUR ? 1 : c.rgb[k];
    }
    return c.form == KOKSMA__NO_COLOUR ? koksma__import_unknown(r->im, n->place, "a spectrum is replaced by white")
           : c.form == KOKSMA__BLACK_BODY
               ? koksma__import_unknown(r->im, n->place, "a black body is replaced by its colour with luminance 1")
               : KOKSMA_OK;
}

static koksma_status colour(reader *r, const node *n, const char *name, koksma__import_colour *out, int depth);
static koksma_status colour_for(reader *r, const node *n, const char *name, koksma__spectrum_use use,
                                koksma__import_colour *out, int depth);

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
        by[i] = number(r, n, older[i]);
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
    /* Mitsuba 0.6 has four values more: it filters by MIP maps unless the file says "nearest" */
    static const koksma__wrap kinds[] = {KOKSMA__WRAP_REPEAT, KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_MIRROR,
                                         KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_CLAMP};
    const size_t wrap = choice(r, n, "wrap_mode"), filter = choice(r, n, "filter_type");
    to->wrap[0] = to->wrap[1] = kinds[wrap];
    to->nearest = filter == 1;
    KOKSMA__TRY(koksma__import_unknown_if(
        wrap > 2, r->im, n->place, "a texture's wrap mode '%s' is replaced by 'clamp'", text(r, n, "wrap_mode")));
    KOKSMA__TRY(koksma__import_unknown_if(
        filter > 1, r->im, n->place, "a texture's filter '%s' is replaced by 'bilinear'", text(r, n, "filter_type")));
    return set_matrix(r, n, to);
}

/* Fails if an object lacks a property that Mitsuba has no default for. */
static koksma_status check_needed(const reader *r, const node *n)
{
    const char *at = row_of(r, n)->parameters;
    koksma__entry e = {.type = NULL};
    while (koksma__entry_next(&at, &e)) {
        if (e.is_needed && !find_property(r, n, &e)) {
            return koksma__import_fail(n->place, "%s '%s': no '%.*s'", n->tag, type_of(n), (int)e.length, e.name);
        }
    }
    return KOKSMA_OK;
}

static koksma_status texture(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out,
                             int depth);

/* Reads the spectrum "d65", daylight times a colour or texture. Daylight itself is white, and samples are its factors:
   those of 1 everywhere leave it white, also in a light. */
static koksma_status in_daylight(reader *r, const node *n, koksma__import_colour *out, int depth)
{
    const double scale = number(r, n, "scale");
    const node *inner = NULL;
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        if (is_texture(resolve(r, c))) {
            KOKSMA__TRY(inner ? koksma__import_fail(c->place, "spectrum 'd65': more than one texture") : KOKSMA_OK);
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            inner = resolve(r, c);
        }
    }
    KOKSMA__TRY(inner ? texture(r, inner, KOKSMA__UNBOUNDED, out, depth + 1) : colour(r, n, "color", out, depth + 1));
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
    const node *wavelengths = property(r, n, "wavelengths");
    koksma__sampled_spectrum s = {0};
    if (pairs) {
        return value_of(r, resolve(r, pairs), use, rgb);
    }
    KOKSMA__TRY(check_needed(r, n));
    KOKSMA__TRY(koksma__import_spend(r->im, n->place, KOKSMA__SPECTRUM_STEPS));
    (void)text(r, n, "values");
    (void)text(r, n, "wavelengths");
    const double from = regular ? number(r, n, "wavelength_min") : 0,
                 to = regular ? number(r, n, "wavelength_max") : 0;
    KOKSMA__TRY(koksma__mitsuba_samples(values, wavelengths, from, to, &s));
    koksma__sampled_spectrum_colour(&s, use, rgb);
    return KOKSMA_OK;
}

static koksma_status bitmap(reader *r, const node *n, koksma__import_colour *out)
{
    const char *name = text(r, n, "filename"), *dot = strrchr(name, '.');
    const bool linear = dot && (!strcasecmp(dot, ".exr") || !strcasecmp(dot, ".pfm"));
    KOKSMA__TRY(koksma__import_unknown_if(flag(r, n, "raw") && !linear, r->im, n->place,
                                          "a texture's 'raw' is ignored: its levels are sRGB"));
    KOKSMA__TRY(set_mapping(r, n, &out->mapping));
    out->image_scale = 1;
    return koksma__import_path(r->im, n->place, name, out->image);
}

static koksma_status checkerboard(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out,
                                  int depth)
{
    koksma__import_colour second;
    const koksma__spectrum_use each = use == KOKSMA__REFLECTANCE ? use : KOKSMA__UNBOUNDED;
    KOKSMA__TRY(colour_for(r, n, "color0", each, out, depth + 1));
    KOKSMA__TRY(colour_for(r, n, "color1", each, &second, depth + 1));
    KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a texture in a checkerboard", use, out));
    KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a texture in a checkerboard", use, &second));
    KOKSMA__TRY(set_matrix(r, n, &out->mapping));
    memcpy(out->second, second.rgb, sizeof second.rgb);
    out->is_checker = true;
    out->period = 0.5;
    return KOKSMA_OK;
}

/* Reads the object of a texture, or of a spectrum as the RGB variants of Mitsuba do, and sampled ones as the observer sees
   them. */
static koksma_status texture(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out,
                             int depth)
{
    const koksma__plugin *row = row_of(r, n);
    double value;
    if (depth > MOST_NESTED) {
        return koksma__import_fail(n->place, "textures are nested more than %d deep", MOST_NESTED);
    }
    if (!row) {
        out->rgb[0] = is(n, "spectrum") ? 1 : out->rgb[0];
        out->rgb[1] = out->rgb[2] = out->rgb[0];
        return REPLACE(r, n, "%s '%s' is replaced by %s%s", n->tag, type_of(n), is(n, "spectrum") ? "white" : "grey",
                       type_meant(r, n, (char[KOKSMA__OR_MEANT]){0}));
    }
    KOKSMA__TRY(row->makes == KOKSMA__REGULAR || row->makes == KOKSMA__IRREGULAR ? KOKSMA_OK : check_needed(r, n));
    pass(r, n);
    switch (row->makes) {
    case KOKSMA__BITMAP:
        return bitmap(r, n, out);
    case KOKSMA__CHECKERBOARD:
        return checkerboard(r, n, use, out, depth);
    case KOKSMA__D65:
        return in_daylight(r, n, out, depth);
    case KOKSMA__SRGB:
        return colour(r, n, "color", out, depth + 1);
    case KOKSMA__UNIFORM:
        out->rgb[0] = out->rgb[1] = out->rgb[2] = number(r, n, "value");
        return KOKSMA_OK;
    case KOKSMA__TEMPERATURE:
        value = number(r, n, "temperature");
        if (!(value > 0)) {
            return koksma__import_fail(n->place, "a temperature of %g kelvins; it must be above 0", value);
        }
        koksma__import_black_body(value, out->rgb);
        return koksma__import_unknown(r->im, n->place, "a black body is replaced by %s", row->instead);
    default:
        return samples(r, n, row->makes == KOKSMA__REGULAR, use, out->rgb);
    }
}

/* What the samples of a property are. Those of the spectra "d65" and "srgb" are factors of daylight, also in a light;
   in media they are coefficients (an albedo is bounded where it is used). */
static koksma__spectrum_use use_of(const node *n, const char *name)
{
    const bool unbounded =
        is(n, "spectrum") || is(n, "medium") || is(n, "volume") || !strcmp(name, "eta") || !strcmp(name, "k");
    return is(n, "emitter") ? KOKSMA__EMISSION : unbounded ? KOKSMA__UNBOUNDED : KOKSMA__REFLECTANCE;
}

/* Reads the colour or texture with this name; without one, *out is grey with the row's default. */
static koksma_status colour_for(reader *r, const node *n, const char *name, koksma__spectrum_use use,
                                koksma__import_colour *out, int depth)
{
    const node *found = property(r, n, name);
    const double grey = otherwise(r, n, name);
    *out = (koksma__import_colour){.rgb = {grey, grey, grey}, .period = 1};
    if (!found) {
        return KOKSMA_OK;
    }
    found = resolve(r, found);
    return is_texture(found) ? texture(r, found, use, out, depth) : value_of(r, found, use, out->rgb);
}

/* The same, for what the name says. */
static koksma_status colour(reader *r, const node *n, const char *name, koksma__import_colour *out, int depth)
{
    return colour_for(r, n, name, use_of(n, name), out, depth);
}

/* ---- BSDFs ------------------------------------------------------------------------------------------------- */

/* An index of refraction: a number or the name of a material. One that is not above 0 is a mistake. */
static double index_of(const reader *r, const node *n, const char *name)
{
    const node *c = property(r, n, name);
    double ior;
    if (c && is(c, "string") && koksma__mitsuba_index(text(r, n, name), &ior)) {
        return ior;
    }
    ior = number(r, n, name);
    if (!(ior > 0)) {
        note(r, c, "an index of refraction; it must be above 0");
    }
    return ior;
}

/* Reads eta or k of a metal. An object that is not one colour, or a spectrum in a file, is not read and makes *is_constant
   false. */
static koksma_status constant(reader *r, const node *n, const char *name, bool *is_constant, double rgb[3])
{
    const node *found = property(r, n, name), *to = found ? resolve(r, found) : NULL;
    koksma__import_colour c;
    const bool is_object = to && !koksma__mitsuba_is_colour(to) && koksma__xml_attribute(to, "type");
    const bool is_file = to && is(to, "spectrum") && koksma__xml_attribute(to, "filename");
    if (to && is_texture(to) ? !row_of(r, to) || row_of(r, to)->makes < KOKSMA__D65 : is_object || is_file) {
        *is_constant = false;
        koksma__xml_mark(found, KOKSMA__XML_COVERED);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(colour(r, n, name, &c, 0));
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

/* Reads what a metal is made of: a name, or eta and k. Those metals whose constants Mitsuba does not have reflect as tables
   of import.c say, by Schlick's approximation. */
static koksma_status metal(reader *r, const node *n, koksma__import_material *m)
{
    double rgb[3];
    KOKSMA__TRY(mean_of_metal(r, n, m));
    bool is_constant = true;
    const char *given = text(r, n, "material"), *name = *given || property(r, n, "eta") ? given : "none";
    m->has_index = !*name || koksma__mitsuba_conductor(name, m->eta, m->k);
    if (!*name) {
        KOKSMA__TRY(constant(r, n, "eta", &is_constant, m->eta));
        KOKSMA__TRY(constant(r, n, "k", &is_constant, m->k));
    } else if (!m->has_index && koksma__import_metal(name, rgb)) {
        for (int i = 0; i < 3; i++) {
            m->colour.rgb[i] *= rgb[i];
        }
        return koksma__import_unknown_if(strcmp(name, "none") != 0, r->im, n->place,
                                         "metal '%s' has Schlick's reflectance", name);
    }
    if (!m->has_index || !is_constant) {
        KOKSMA__TRY(
            m->has_index
                ? koksma__import_unknown(r->im, n->place,
                                         "a metal whose eta or k varies or is in a file is replaced by chromium")
                : koksma__import_unknown(r->im, n->place, "metal '%s' is replaced by chromium", name));
        m->has_index = koksma__mitsuba_conductor("Cr", m->eta, m->k);
    }
    return KOKSMA_OK;
}

static koksma_status principled(reader *r, const node *n, int *out)
{
    koksma__import_material m = {.ior = 1.5};
    KOKSMA__TRY(colour(r, n, "base_color", &m.colour, 0));
    const double roughness = number(r, n, "roughness");
    m.alpha = roughness * roughness;
    m.ior = index_of(r, n, "eta");
    m.kind = number(r, n, "metallic") > 0.5     ? KOKSMA__METAL
             : number(r, n, "spec_trans") > 0.5 ? KOKSMA__GLASS
                                                : KOKSMA__COATED;
    KOKSMA__TRY(mean_of_metal(r, n, &m));
    return koksma__import_add_material(r->im, n->place, &m, out);
}

static koksma_status make_bsdf(reader *r, const node *n, int depth, int *out);

/* Makes a BSDF that light meets only in part ("mask"), or a blend of two ("blendbsdf"). */
static koksma_status blend(reader *r, const node *n, int depth, int *out)
{
    const bool masks = row_of(r, n)->makes == KOKSMA__MASK;
    const node *first = find_child(r, first_of(r, n), "bsdf"),
               *second = first ? find_child(r, next_of(r, first), "bsdf") : NULL;
    koksma__import_colour share;
    int other = -1;
    if (!first || (!masks && !second)) {
        return koksma__import_fail(n->place, "bsdf '%s': it has %s within it", type_of(n),
                                   masks ? "no BSDF" : "less than two BSDFs");
    }
    KOKSMA__TRY(check_needed(r, n));
    KOKSMA__TRY(colour(r, n, masks ? "opacity" : "weight", &share, 0));
    KOKSMA__TRY(make_bsdf(r, resolve(r, first), depth + 1, out));
    if (masks) {
        return koksma__import_mask(r->im, n->place, &share, out);
    }
    KOKSMA__TRY(make_bsdf(r, resolve(r, second), depth + 1, &other));
    return koksma__import_mix(r->im, n->place, *out, other, &share, out);
}

/* Makes a BSDF that is replaced by the first BSDF inside it; a second one is that of the back of "twosided". */
static koksma_status within(reader *r, const node *n, const node *inner, int depth, int *out)
{
    const node *back = row_of(r, n)->instead ? NULL : find_child(r, next_of(r, inner), "bsdf");
    if (back && resolve(r, back) != resolve(r, inner)) {
        KOKSMA__TRY(
            koksma__import_unknown(r->im, back->place, "the BSDF of a back is replaced by that of the front"));
    }
    return make_bsdf(r, resolve(r, inner), depth + 1, out);
}

/* Makes a BSDF of the kinds that koksma__import_material has; its colour comes first in its row. */
static koksma_status plain_bsdf(reader *r, const node *n, koksma__import_material *m, int *out)
{
    const char *at = row_of(r, n)->parameters, *type = type_of(n);
    char name[40];
    koksma__entry e = {.type = NULL};
    koksma__entry_next(&at, &e);
    snprintf(name, sizeof name, "%.*s", (int)e.length, e.name);
    KOKSMA__TRY(colour(r, n, name, &m->colour, 0));
    if (m->kind == KOKSMA__GLASS &&
        !koksma__import_is_white(&m->colour)) { /* a tint would colour what it reflects as well */
        KOKSMA__TRY(koksma__import_unknown(r->im, n->place, "a glass's '%s' is ignored", name));
    }
    KOKSMA__TRY(m->kind == KOKSMA__METAL ? metal(r, n, m) : KOKSMA_OK);
    const double both = number(r, n, "alpha");
    const double u = property(r, n, "alpha_u") ? number(r, n, "alpha_u") : both;
    const double v = property(r, n, "alpha_v") ? number(r, n, "alpha_v") : both;
    m->alpha = sqrt(fmax(u * v, 0));
    if (m->kind == KOKSMA__GLASS || m->kind == KOKSMA__COATED) {
        m->ior = index_of(r, n, "int_ior") / index_of(r, n, "ext_ior");
    }
    KOKSMA__TRY(koksma__import_unknown_if(!strncmp(type, "rough", 5) && entry_of(r, n, "distribution", &e) &&
                                              choice(r, n, "distribution") != 1,
                                          r->im, n->place, "Beckmann's distribution is replaced by GGX"));
    KOKSMA__TRY(koksma__import_unknown_if(u != v, r->im, n->place, "anisotropic roughness is replaced by its mean"));
    return koksma__import_add_material(r->im, n->place, m, out);
}

static koksma_status make_bsdf(reader *r, const node *n, int depth, int *out)
{
    const koksma__plugin *row = row_of(r, n);
    const bool is_known = *row->kinds != '?', nests = depth < MOST_NESTED;
    const node *inner = row->makes == KOKSMA__WITHIN && nests ? find_child(r, first_of(r, n), "bsdf") : NULL;
    koksma__import_material m = {.kind = (unsigned)row->makes};
    *out = -1;
    KOKSMA__TRY(koksma__import_unknown_if(row->instead, r->im, n->place, "BSDF '%s' is replaced by %s%s", type_of(n),
                                          row->instead, type_meant(r, n, (char[KOKSMA__OR_MEANT]){0})));
    if (row->instead && (!is_known || row->makes == KOKSMA__NOTHING || row->makes == KOKSMA__WITHIN)) {
        koksma__xml_mark(n, KOKSMA__XML_COVERED);
    }
    pass(r, n);
    switch (row->makes) {
    case KOKSMA__NOTHING:
        return KOKSMA_OK;
    case KOKSMA__WITHIN:
        return inner ? within(r, n, inner, depth, out)
                     : koksma__import_fail(n->place, "bsdf '%s': it has no BSDF within it", type_of(n));
    case KOKSMA__MASK:
    case KOKSMA__BLEND:
        return nests ? blend(r, n, depth, out)
                     : koksma__import_fail(n->place, "BSDFs are nested more than %d deep", MOST_NESTED);
    case KOKSMA__PRINCIPLED:
        return principled(r, n, out);
    default:
        return plain_bsdf(r, n, &m, out);
    }
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
    return number(r, n, "sampling_weight") > 0
               ? KOKSMA_OK
               : koksma__import_unknown(r->im, n->place, "a light whose sampling weight is 0 is sampled");
}

/* Reads a light of a surface whose material is known: its radiance may be an image. */
static koksma_status area_light(reader *r, const node *n, koksma__import_surface *surface)
{
    koksma__import_colour radiance;
    KOKSMA__TRY(weight(r, n));
    KOKSMA__TRY(colour(r, n, "radiance", &radiance, 0));
    KOKSMA__TRY(koksma__import_glow(r->im, n->place, &radiance, surface));
    if (!*radiance.image) {
        KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a light's texture", KOKSMA__EMISSION, &radiance));
        memcpy(surface->radiance, radiance.rgb, sizeof radiance.rgb);
    }
    surface->emits = true;
    return koksma__import_unknown_if(strcmp(type_of(n), "area") != 0, r->im, n->place,
                                     "a light's direction is ignored");
}

/* Finds a shape's material and emission among its children. */
static koksma_status surface_of(reader *r, const node *n, koksma__import_surface *out)
{
    bool has_bsdf = false;
    *out = (koksma__import_surface){.material = -1, .turned = flag(r, n, "flip_normals")};
    EACH_CHILD(r, n, c, "bsdf")
    {
        KOKSMA__TRY(find_bsdf(r, resolve(r, c), &out->material));
        has_bsdf = true;
    }
    EACH_CHILD(r, n, c, "emitter")
    {
        KOKSMA__TRY(area_light(r, resolve(r, c), out));
    }
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
    const double radius = number(r, n, "radius");
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
    const koksma__plugin *row = row_of(r, n);
    const bool numbered = !strcmp(type_of(n), "serialized");
    memcpy(m, koksma__import_identity, sizeof koksma__import_identity);
    item->form = row->makes == KOKSMA__N_BASIC_FORMS ? KOKSMA__FORM_MESH : (koksma__form)row->makes;
    item->mesh = -1;
    if (item->form == KOKSMA__FORM_SPHERE) {
        double centre[3] = {0};
        point(r, n, "center", centre);
        m[0] = m[5] = m[10] = number(r, n, "radius");
        m[3] = centre[0], m[7] = centre[1], m[11] = centre[2];
    } else if (item->form == KOKSMA__FORM_CYLINDER) {
        cylinder(r, n, m);
    } else if (row->makes == KOKSMA__FORM_MESH) {
        const double part = numbered ? number(r, n, "shape_index") : -1;
        if (numbered && !(part >= 0 && part <= 1e9 && part == floor(part))) {
            return koksma__import_fail(n->place, "a shape_index of %g: it is a whole number from 0 on", part);
        }
        const koksma__mesh_rules rules = {
            .facets = flag(r, n, "face_normals"), .smooths = true, .flips_v = flag(r, n, "flip_tex_coords")};
        return koksma__import_mesh_file(r->im, n->place, text(r, n, "filename"), (long)part, rules, &item->mesh);
    } else if (item->form == KOKSMA__FORM_MESH) {
        return REPLACE(r, n, "shape '%s' is left out%s", type_of(n), type_meant(r, n, (char[KOKSMA__OR_MEANT]){0}));
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
        if (is(resolve(r, c), "medium") && (!name || (has && koksma__xml_alike(has, name, strlen(name))))) {
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

static bool is_glass(const reader *r, int material)
{
    const koksma__bsdf *bsdf = material < 0 ? NULL : r->im->scene->materials[material].bsdf;
    return bsdf == &koksma__bsdf_dielectric || bsdf == &koksma__bsdf_rough_dielectric;
}

/* Warns about the media of a shape that are not read. */
static koksma_status name_media(reader *r, const node *n, int material)
{
    const node *inside = medium_of(r, n, "interior"), *outside = medium_of(r, n, "exterior");
    for (int i = 0; i < 2; i++) {
        const node *medium = i ? outside : inside;
        if (medium && medium != r->medium) {
            koksma__xml_mark(medium, KOKSMA__XML_COVERED);
        }
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
    return koksma__import_unknown_if(outside && !inside && is_glass(r, material), r->im, n->place,
                                     "glass in a medium is filled by the medium");
}

/* Reads a colour of a medium, which is given directly or by a constant volume, of "color" in Mitsuba 2. */
static koksma_status medium_colour(reader *r, const node *n, const char *name, double rgb[3])
{
    const node *found = property(r, n, name);
    const double grey = otherwise(r, n, name);
    koksma__import_colour c = {.rgb = {grey, grey, grey}};
    found = found ? resolve(r, found) : NULL;
    if (found && is(found, "volume") && strcmp(type_of(found), "constvolume") != 0) {
        KOKSMA__TRY(REPLACE(r, found, "volume '%s' is replaced by %g", type_of(found), grey));
    } else {
        KOKSMA__TRY(found && is(found, "volume") ? colour(r, found, "value", &c, 0) : colour(r, n, name, &c, 0));
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
    EACH_CHILD(r, n, c, "phase")
    {
        const node *phase = resolve(r, c);
        if (!row_of(r, phase)) {
            return REPLACE(r, phase, "phase function '%s' is replaced by the isotropic", type_of(phase));
        }
        *g = fmax(-0.999, fmin(number(r, phase, "g"), 0.999));
    }
    return KOKSMA_OK;
}

/* Sets the scene's medium. Mitsuba gives the extinction and the albedo: their product is the scattering, and the rest
   of the extinction is the absorption. Versions before Mitsuba 2 give scattering and absorption. A scale multiplies
   all coefficients. */
static koksma_status read_medium(reader *r, const node *n)
{
    koksma__medium *to = &r->im->scene->medium;
    double a[3], b[3], g;
    if (strcmp(type_of(n), "homogeneous") != 0 || property(r, n, "material")) {
        return REPLACE(r, n, "media that vary in space, and media named in place of a material, are ignored");
    }
    pass(r, n);
    const bool old = property(r, n, "sigma_s") || property(r, n, "sigma_a");
    const double scale = fmin(fmax(number(r, n, "scale"), 0), FAR);
    KOKSMA__TRY(medium_colour(r, n, old ? "sigma_s" : "albedo", b));
    KOKSMA__TRY(medium_colour(r, n, old ? "sigma_a" : "sigma_t", a));
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
    if (koksma__medium_check(r->im->scene)) {
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
    (void)row_of(r, group);
    EACH_CHILD(r, group, c, "shape")
    {
        KOKSMA__TRY(shape(r, resolve(r, c), matrix, depth + 1));
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
    EACH_CHILD(r, n, c, "shape")
    {
        found = true;
        KOKSMA__TRY(parts_of_group(r, resolve(r, c), matrix, depth));
    }
    return found ? KOKSMA_OK : koksma__import_fail(n->place, "an instance without a reference to a shape group");
}

/* Warns if a shape's normals are turned round to no effect: surfaces that reflect have two sides here, and a sphere of
   glass has its own normals. */
static koksma_status name_flip(reader *r, const node *n, const koksma__import_item *item)
{
    const node *bsdf = find_child(r, first_of(r, n), "bsdf");
    const char *type = bsdf ? type_of(resolve(r, bsdf)) : "";
    const bool none = item->surface.emits || item->surface.material < 0 || !strcmp(type, "twosided") ||
                      (is_glass(r, item->surface.material) && item->form != KOKSMA__FORM_SPHERE);
    return koksma__import_unknown_if(item->surface.turned && !none, r->im, n->place,
                                     "'flip_normals' is ignored: surfaces have two sides");
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
    if (item.form == KOKSMA__FORM_MESH && item.mesh < 0) {
        koksma__xml_mark(n, KOKSMA__XML_COVERED);
        return KOKSMA_OK;
    }
    KOKSMA__TRY(surface_of(r, n, &item.surface));
    KOKSMA__TRY(name_flip(r, n, &item));
    KOKSMA__TRY(
        koksma__import_spend(r->im, n->place, item.mesh < 0 ? 0 : r->im->scene->meshes[item.mesh].n_triangles / 16));
    KOKSMA__TRY(koksma__import_unknown_if(
        item.surface.emits && item.mesh >= 0 && koksma__mesh_is_curved(&r->im->scene->meshes[item.mesh]), r->im,
        n->place, "a luminous mesh shines from its flat sides, not by its smooth normals"));
    KOKSMA__TRY(name_media(r, n, item.surface.material));
    KOKSMA__TRY(transform(r, n, "to_world", to_world));
    koksma__matrix_multiply(to_world, form, item.matrix);
    return koksma__import_put(r->im, &item, outer, NULL);
}

/* ---- Emitters and sensors ------------------------------------------------------------------------------------ */

static koksma_status emitter(reader *r, const node *n)
{
    static const char *const colours[] = {[KOKSMA__POINT_LIGHT] = "intensity",
                                          [KOKSMA__SPOT] = "intensity",
                                          [KOKSMA__FAR_LIGHT] = "irradiance",
                                          [KOKSMA__SKY] = "radiance",
                                          [KOKSMA__PICTURE] = "radiance"};
    const koksma__plugin *row = row_of(r, n);
    koksma__light light = {.kind = &koksma__light_point};
    koksma__import_colour c;
    double m[12];
    KOKSMA__TRY(weight(r, n));
    KOKSMA__TRY(transform(r, n, "to_world", m));
    KOKSMA__TRY(colour(r, n, colours[row->makes], &c, 0));
    KOKSMA__TRY(koksma__import_mean(r->im, n->place, "a light's texture", KOKSMA__EMISSION, &c));
    KOKSMA__TRY(row->instead ? REPLACE(r, n, "emitter '%s' is replaced by %s%s", type_of(n), row->instead,
                                       type_meant(r, n, (char[KOKSMA__OR_MEANT]){0}))
                             : KOKSMA_OK);
    memcpy(light.radiance, c.rgb, sizeof c.rgb);
    double along[3] = {m[2], m[6], m[10]};
    for (int k = 0; k < 3 && row->makes <= KOKSMA__SPOT; k++) {
        light.centre[k] = m[4 * k + 3];
    }
    if (row->makes == KOKSMA__PICTURE) {
        const double scale = number(r, n, "scale"), rgb[3] = {scale, scale, scale};
        return koksma__import_sky(r->im, n->place, text(r, n, "filename"), 0, rgb, m);
    }
    if (row->makes == KOKSMA__SKY) {
        light.kind = &koksma__light_environment;
        light.visible = true;
    } else if (row->makes == KOKSMA__FAR_LIGHT) {
        light.kind = &koksma__light_directional;
        point(r, n, "direction", along);
        memcpy(light.normal, along, sizeof light.normal);
        if (!koksma__import_normalise(light.normal)) {
            return koksma__import_fail(n->place, "a directional light without a direction");
        }
    } else {
        point(r, n, "position", light.centre);
    }
    if (row->makes == KOKSMA__SPOT) {
        const double outer = number(r, n, "cutoff_angle");
        const double inner = property(r, n, "beam_width") ? number(r, n, "beam_width") : outer * 3 / 4;
        KOKSMA__TRY(koksma__import_spot(n->place, along, inner, outer, KOKSMA__FALLOFF_ANGLE, &light));
    }
    return koksma__import_light(r->im, n->place, &light);
}

/* ---- Sensors and films --------------------------------------------------------------------------------------- */

/* Takes the parameters of an object that chooses how a picture is computed or stored, which the program's own options do
   here, or warns that it has another type. */
static koksma_status plain(reader *r, const node *n)
{
    const koksma__plugin *row = row_of(r, n);
    if (!row || row->instead) {
        return REPLACE(r, n, "%s '%s' is ignored%s", n->tag, type_of(n),
                       type_meant(r, n, (char[KOKSMA__OR_MEANT]){0}));
    }
    pass(r, n);
    if (is(n, "sampler") && property(r, n, "sample_count")) { /* `koksma rank` takes the number from here */
        const double count = number(r, n, "sample_count");
        r->im->scene->spp = count >= 1 && count <= KOKSMA_MAX_SPP ? (int)count : 0;
    }
    EACH_CHILD(r, n, c, "sampler")
    {
        KOKSMA__TRY(plain(r, resolve(r, c)));
    }
    EACH_CHILD(r, n, c, "rfilter")
    {
        KOKSMA__TRY(plain(r, resolve(r, c)));
    }
    return KOKSMA_OK;
}

/* Reads the objects of a sensor, of which the film has the sides of the picture. */
static koksma_status objects_of_sensor(reader *r, const node *n)
{
    double width = 768, height = 576;
    EACH_CHILD(r, n, c, "film")
    {
        const node *film = resolve(r, c);
        width = number(r, film, "width");
        height = number(r, film, "height");
        if (!(width >= 1 && height >= 1 && width <= KOKSMA_MAX_IMAGE_SIDE && height <= KOKSMA_MAX_IMAGE_SIDE &&
              width == floor(width) && height == floor(height))) {
            return koksma__import_fail(film->place,
                                       "a film of %g x %g pixels; each side must be a whole number, 1 to %d", width,
                                       height, KOKSMA_MAX_IMAGE_SIDE);
        }
        KOKSMA__TRY(plain(r, film));
    }
    r->im->scene->width = (int)width;
    r->im->scene->height = (int)height;
    return plain(r, n);
}

/* The focal length in mm: a number, or a text that may end in "mm". */
static double focal_length(const reader *r, const node *n)
{
    const node *c = property(r, n, "focal_length");
    double length_mm = 50;
    if (!c || koksma__mitsuba_is_number(c)) {
        return number(r, n, "focal_length");
    }
    if (!koksma__mitsuba_measure(text(r, n, "focal_length"), "mm", &length_mm)) {
        note(r, c, "a length in mm");
    }
    return length_mm;
}

/* The vertical angle of view. */
static double height_angle(const reader *r, const node *n, double width, double height)
{
    const double sides[] = {width, height, koksma__hypot(width, height), fmin(width, height), fmax(width, height)};
    const double side = sides[choice(r, n, "fov_axis")], half = number(r, n, "fov") * TURN / 720;
    if (property(r, n, "fov")) {
        return 2 * koksma__atan(koksma__tan(half) * height / side);
    }
    /* focal_length refers to the diagonal of 35 mm film */
    return 2 * koksma__atan(koksma__hypot(36, 24) / 2 / focal_length(r, n) * height / koksma__hypot(width, height));
}

static koksma_status sensor(reader *r, const node *n)
{
    double m[12];
    const char *type = type_of(n);
    const bool lens = !strcmp(type, "thinlens"), parallel = !strcmp(type, "orthographic");
    if (r->has_sensor) {
        return REPLACE(r, n, "the scene has a second sensor, which is left out");
    }
    if (!row_of(r, n)) {
        return koksma__import_fail(n->place,
                                   "sensor '%s' is not read; 'perspective', 'thinlens' and 'orthographic' are", type);
    }
    r->has_sensor = true;
    KOKSMA__TRY(objects_of_sensor(r, n));
    const double near = number(r, n, "near_clip"), far = number(r, n, "far_clip");
    if (!(near > 0 && far > near)) {
        return koksma__import_fail(
            n->place, "the camera sees from near_clip, above 0, to far_clip: not from %g to %g", near, far);
    }
    KOKSMA__TRY(transform(r, n, "to_world", m));
    const double width = r->im->scene->width, height = r->im->scene->height;
    koksma__camera camera = {.focus_distance = lens ? number(r, n, "focus_distance") : 1,
                             .lens_radius = lens ? number(r, n, "aperture_radius") : 0,
                             .near_clip = near,
                             .far_clip = far};
    if (parallel) { /* an orthographic sensor shows -1 to 1 along x */
        const double x = sqrt(m[0] * m[0] + m[4] * m[4] + m[8] * m[8]),
                     y = sqrt(m[1] * m[1] + m[5] * m[5] + m[9] * m[9]);
        camera.height = 2 * height / width;
        KOKSMA__TRY(koksma__import_unknown_if(fabs(x - y) > 1e-4 * y, r->im, n->place,
                                              "the camera's scale along x is replaced by the scale along y"));
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
    const node *inner = strcmp(type_of(n), "aov") ? NULL : find_child(r, first_of(r, n), "integrator");
    KOKSMA__TRY(plain(r, n));
    if (!row_of(r, n) || (inner && depth < MOST_NESTED)) { /* the picture is that of the integrator within */
        return inner ? integrator(r, resolve(r, inner), depth + 1) : KOKSMA_OK;
    }
    static const char surfaces_only[] = "path direct prb prb_basic ptracer";
    KOKSMA__TRY(koksma__import_unknown_if(
        r->medium && koksma__lists(surfaces_only, sizeof surfaces_only - 1, ' ', type_of(n)), r->im, n->place,
        "the medium is rendered, which Mitsuba's integrator '%s' leaves out; 'volpath' has it", type_of(n)));
    const bool direct = !strcmp(type_of(n), "direct");
    const double most = direct ? 2 : number(r, n, "max_depth");
    scene->paths = !direct;
    scene->hides_lights = flag(r, n, "hide_emitters");
    if (most >= 0 && most < 2) {
        return koksma__import_unknown(r->im, n->place, "a max_depth of %g is replaced by 2", most);
    }
    /* Mitsuba counts a path's segments, of which one comes from the camera and one from a light; --depth the others */
    scene->path_vertices = 1 + (most < 0 ? KOKSMA_MAX_DEPTH : (int)fmin(most - 2, KOKSMA_MAX_DEPTH));
    return KOKSMA_OK;
}

/* What may be meant by an element that is not read: a parameter of the parent's row, or a tag. */
static const char *meant_by(const void *context, const node *parent, const node *n, char *text)
{
    static const char tags[] =
        "scene sensor shape emitter integrator bsdf texture spectrum medium phase volume film sampler "
        "rfilter ref alias default include path transform translate rotate scale lookat matrix "
        "float integer boolean string rgb srgb point vector";
    const reader *r = context;
    const char *name = koksma__xml_attribute(n, "name");
    const koksma__plugin *row = row_of(r, parent);
    koksma__word_list words = {.n = 0};
    koksma__entry e;
    *text = '\0';
    if (name && row && is_property(n)) {
        return koksma__row_entry(row, name, &e) ? text : koksma__parameter_meant(row, name, text);
    }
    if (koksma__lists(tags, sizeof tags - 1, ' ', n->tag)) {
        return text;
    }
    koksma__word_list_add(&words, tags, sizeof tags - 1, " ", "");
    return koksma__or_meant(koksma__word_list_closest(&words, n->tag), text);
}

/* ---- The whole scene ---------------------------------------------------------------------------------------- */

/* Whether the children of a scene with this tag are read, wherever else they are referred to. */
static bool is_of_scene(const node *n)
{
    static const char tags[] =
        "sensor shape emitter integrator bsdf texture spectrum medium ref alias default include path";
    return koksma__lists(tags, sizeof tags - 1, ' ', n->tag) &&
           (!is(n, "emitter") || strcmp(type_of(n), "area") != 0);
}

/* Marks what the table knows of an object that nothing refers to, and of those in it, so that what is misspelt there is
   named, too. */
static koksma_status judge(reader *r, const node *n)
{
    const koksma__plugin *row = row_of(r, n);
    if (!row || *row->kinds == '?') {
        return REPLACE(r, n, "%s '%s' is ignored%s", n->tag, type_of(n),
                       type_meant(r, n, (char[KOKSMA__OR_MEANT]){0}));
    }
    const char *at = row->parameters;
    koksma__entry e = {.type = NULL};
    while (koksma__entry_next(&at, &e)) {
        const node *c = find_property(r, n, &e);
        koksma__xml_mark(c ? c : n, c ? KOKSMA__XML_TAKEN : 0);
    }
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const bool is_object = koksma__xml_attribute(resolve(r, c), "type") != NULL;
        koksma__xml_mark(c, is_object && !koksma__xml_attribute(c, "name") ? KOKSMA__XML_TAKEN : 0);
        for (const node *o = is(c, "transform") ? first_of(r, c) : NULL; o; o = next_of(r, o)) {
            koksma__xml_mark(o, KOKSMA__XML_TAKEN);
        }
        KOKSMA__TRY(is_object && !is(c, "ref") && !r->rows[c - r->xml.nodes] ? judge(r, c) : KOKSMA_OK);
    }
    return KOKSMA_OK;
}

/* Judges the objects of the scene that nothing has looked up. */
static koksma_status judge_unused(reader *r, const node *root)
{
    for (const node *n = first_of(r, root); n; n = next_of(r, n)) {
        const bool is_named = is(n, "bsdf") || is_texture(n) || is(n, "medium") || is(n, "shape");
        KOKSMA__TRY(is_named && !r->rows[n - r->xml.nodes] ? judge(r, n) : KOKSMA_OK);
    }
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
    r->im->scene->paths = true;
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
    KOKSMA__TRY(judge_unused(r, root));
    koksma__xml_mark(root, KOKSMA__XML_TAKEN);
    return koksma__xml_name_unread(r->im, &r->xml, meant_by, r);
}

koksma_status koksma__mitsuba_read(koksma__import *im, const char *bytes, size_t size)
{
    mistake first = {0};
    reader r = {.im = im, .mistake = &first};
    im->rows_down = true;
    koksma_status status = koksma__xml_read(im, bytes, size, &r.xml);
    if (!status) {
        r.materials = malloc((r.xml.n + 1) * sizeof *r.materials);
        r.rows = calloc(r.xml.n + 1, sizeof *r.rows);
        status = r.materials && r.rows ? KOKSMA_OK : koksma__fail_memory(r.xml.n * sizeof *r.materials);
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
    KOKSMA__FREE(r.materials, r.rows);
    koksma__names_fini(&r.identities);
    koksma__xml_fini(&r.xml);
    return status;
}
