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
#include "scene/mitsuba_reader.h"

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

typedef struct reader {
    koksma__import *im;
    const char *bytes;
    size_t size;
    koksma__xml xml;
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
    return koksma__mitsuba_is(n, tag);
}

static const char *type_of(const node *n)
{
    const char *type = koksma__xml_attribute(n, "type");
    return type ? type : "";
}

static bool has_type(const node *n, const char *type)
{
    return !strcmp(type_of(n), type);
}

/* Fails unless a value has the type that it is read as. */
static void need(bool is_right, const node *n, const char *expected)
{
    if (!is_right) {
        const char *name = koksma__xml_attribute(n, "name"), *value = koksma__xml_attribute(n, "value");
        koksma__import_fail(n->place, "%s: <%s> '%.60s' is not %s", name, n->tag, value ? value : "", expected);
    }
}

/* A node that is looked at, which counts as work with its text; NULL for NULL. */
static const node *count(const node *n, uint64_t steps)
{
    if (n) {
        koksma__import_spend(n->place, steps + n->length / 16);
    }
    return n;
}

static const node *first_of(const reader *r, const node *n)
{
    return n->first < 0 ? NULL : count(&r->xml.nodes[n->first], 1);
}

static const node *next_of(const reader *r, const node *n)
{
    return n->next < 0 ? NULL : count(&r->xml.nodes[n->next], 1);
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

/* Says in a warning what becomes of a node, which covers all that it contains. */
#define REPLACE(n, ...) (koksma__xml_mark(n, KOKSMA__XML_COVERED), koksma__import_unknown((n)->place, __VA_ARGS__))

/* What may be meant by the type of an object that the table does not have, or "". */
static const char *type_meant(const reader *r, const node *n, char *text)
{
    const koksma__plugin *row = row_of(r, n);
    *text = '\0';
    return row && *row->kinds != '?'
               ? text
               : koksma__kind_meant(&koksma__mitsuba_plugins, is_texture(n) ? "texture" : n->tag, type_of(n), text);
}
#define TYPE_MEANT(r, n) type_meant(r, n, (char[KOKSMA__OR_MEANT]){0})

/* Takes the properties that have no effect on the pictures that are made here: those of the row with "~", unless they
   have a default, or a list of values, and another value. */
static void pass(const reader *r, const node *n)
{
    for (koksma__entry e = koksma__entries_of(row_of(r, n)); koksma__entry_next(&e);) {
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
    need(!c || value, c, "a text");
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
        need(false, property(r, n, name), "a value that this property can have");
    }
    return (size_t)i;
}

/* The element to which a <ref> or an <alias> leads, or NULL; any other element is itself. */
static const node *target(const reader *r, const node *n)
{
    for (int hops = 0; n && (is(n, "ref") || is(n, "alias")); hops++) {
        const char *id = koksma__xml_attribute(n, "id");
        size_t at = 0;
        const bool found = id && hops < MOST_NESTED && koksma__names_find(&r->identities, id, strlen(id), &at);
        n = count(found ? &r->xml.nodes[at] : NULL, 4);
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
static void find_identities(reader *r)
{
    const node *end = r->xml.nodes + r->xml.n;
    size_t other;
    for (const node *n = r->xml.nodes; n < end; n++) {
        const char *name = koksma__xml_attribute(n, is(n, "alias") ? "as" : "id");
        if (name && !is(n, "ref")) {
            koksma__import_fail_if(koksma__names_find(&r->identities, name, strlen(name), &other), n->place,
                                   "the id '%.60s' is given twice", name);
            koksma__import_put_name(n->place, &r->identities, name, (size_t)(n - r->xml.nodes));
        }
    }
    for (const node *n = r->xml.nodes; n < end; n++) {
        const node *to = target(r, n);
        const char *id = to ? NULL : koksma__xml_attribute(n, "id");
        koksma__import_fail_if(!to, n->place, "%s: no element has the id '%.60s'", n->tag, id ? id : "");
        /* if nothing takes the <ref>, that is named */
        koksma__xml_mark(to, to != n && is_property(to) ? KOKSMA__XML_TAKEN : 0);
    }
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
    if (to && (is(to, "texture") || (koksma__mitsuba_is_colour(to) && !koksma__mitsuba_is_number(to)))) {
        c->marks[0] &= (unsigned char)~KOKSMA__XML_TAKEN; /* it varies, which is not read here */
        return otherwise(r, n, name);
    }
    need(!c || koksma__mitsuba_is_number(c), c, "a number");
    return c ? koksma__mitsuba_number(c, "value") : otherwise(r, n, name);
}

static bool flag(const reader *r, const node *n, const char *name)
{
    const node *c = property(r, n, name);
    need(!c || is(c, "boolean"), c, "true or false");
    return c ? koksma__mitsuba_flag(c) : otherwise(r, n, name) != 0;
}

/* Reads an element of the form <point name x y z> or <point name value="x, y, z">. */
static void point(const reader *r, const node *n, const char *name, double out[3])
{
    const node *c = property(r, n, name);
    need(!c || is(c, "point") || is(c, "vector"), c, "a point or vector");
    if (c) {
        koksma__mitsuba_triple(c, (double)INFINITY, out);
    }
}

/* ---- Transforms -------------------------------------------------------------------------------------------- */

/* Reads a transform, whose first operation is applied first. */
static void transform(const reader *r, const node *n, const char *name, double out[12])
{
    const node *t = property(r, n, name);
    memcpy(out, koksma__import_identity, sizeof koksma__import_identity);
    need(!t || is(t, "animation") || is(t, "transform"), t, "a transform");
    if (t && is(t, "animation")) {
        REPLACE(t, "motion is ignored: the transform of the first time is taken");
        t = first_of(r, t);
    }
    for (const node *c = t ? first_of(r, t) : NULL; c; c = next_of(r, c)) {
        double by[12], product[12];
        koksma__xml_mark(c, KOKSMA__XML_TAKEN);
        koksma__import_spend(c->place, 8);
        koksma__mitsuba_operation(c, by);
        koksma__matrix_multiply(by, out, product);
        memcpy(out, product, sizeof product);
    }
}

/* ---- Colours and textures ----------------------------------------------------------------------------------- */

static void value_of(const node *n, koksma__spectrum_use use, double rgb[3])
{
    if (!koksma__mitsuba_is_colour(n)) {
        rgb[0] = rgb[1] = rgb[2] = 1;
        koksma__import_fail_if(!koksma__xml_attribute(n, "type"), n->place, "<%s> is not a colour", n->tag);
        REPLACE(n, "'%s' is replaced by white where a colour is", n->tag);
        return;
    }
    koksma__import_spend(n->place, is(n, "spectrum") ? KOKSMA__SPECTRUM_STEPS : 0);
    koksma__mitsuba_colour c = koksma__mitsuba_colour_read(n);
    if (c.form == KOKSMA__ONE_NUMBER && use == KOKSMA__EMISSION && is(n, "spectrum")) {
        /* one number stands for the same emission at all wavelengths */
        c.form = KOKSMA__PAIRS;
        (void)(koksma__sampled_spectrum_add(&c.pairs, 360, c.rgb[0]) &&
               koksma__sampled_spectrum_add(&c.pairs, 830, c.rgb[0]));
    }
    if (c.form == KOKSMA__PAIRS) {
        koksma__sampled_spectrum_colour(&c.pairs, use, rgb);
        return;
    }
    const double low = fmin(fmin(c.rgb[0], c.rgb[1]), c.rgb[2]), high = fmax(fmax(c.rgb[0], c.rgb[1]), c.rgb[2]);
    koksma__import_unknown_if(use == KOKSMA__REFLECTANCE && (low < 0 || high > 1), n->place,
                              "a reflectance beyond 0 to 1 is clamped");
    for (int k = 0; k < 3; k++) {
        rgb[k] = c.form == KOKSMA__NO_COLOUR ? 1 : c.rgb[k];
    }
    koksma__import_unknown_if(c.form == KOKSMA__NO_COLOUR, n->place, "a spectrum is replaced by white");
    koksma__import_unknown_if(c.form == KOKSMA__BLACK_BODY, n->place,
                              "a black body is replaced by its colour with luminance 1");
}

static koksma__import_colour colour_for(reader *r, const node *n, const char *name, koksma__spectrum_use use,
                                        int depth);

/* What the samples of a property are. Those of the spectra "d65" and "srgb" are factors of daylight, also in a light;
   in media they are coefficients (an albedo is bounded where it is used). */
static koksma__spectrum_use use_of(const node *n, const char *name)
{
    const bool unbounded =
        is(n, "spectrum") || is(n, "medium") || is(n, "volume") || !strcmp(name, "eta") || !strcmp(name, "k");
    return is(n, "emitter") ? KOKSMA__EMISSION : unbounded ? KOKSMA__UNBOUNDED : KOKSMA__REFLECTANCE;
}

static koksma__import_colour colour(reader *r, const node *n, const char *name)
{
    return colour_for(r, n, name, use_of(n, name), 0);
}

/* Reads a texture's transform of the plane z = 0: the third row and column have no effect. */
static void set_matrix(reader *r, const node *n, koksma__mapping *to)
{
    /* in place of to_uv, Mitsuba 0.6 has four numbers, of which Mitsuba 3 moves by the offsets first */
    static const char *const older[] = {"uscale", "vscale", "uoffset", "voffset"};
    static const float unmoved[6] = {1, 0, 0, 0, 1, 0};
    const node *t = property(r, n, "to_uv");
    double m[12], by[4] = {1, 1, 0, 0}, all[6];
    transform(r, n, "to_uv", m);
    for (size_t i = 0; !t && i < 4; i++) {
        by[i] = number(r, n, older[i]);
    }
    for (int i = 0; i < 6; i++) {
        all[i] = by[i / 3] * (m[i / 3 * 4 + (i % 3 < 2 ? i % 3 : 3)] + (i % 3 == 2 ? by[2 + i / 3] : 0));
        to->matrix[i] = (float)all[i];
    }
    to->moved = memcmp(to->matrix, unmoved, sizeof unmoved) != 0;
    koksma__import_check_uv(t ? t->place : n->place, all, 6);
}

/* Reads how an image is mapped. */
static void set_mapping(reader *r, const node *n, koksma__mapping *to)
{
    /* Mitsuba 0.6 has four values more: it filters by MIP maps unless the file says "nearest" */
    static const koksma__wrap kinds[] = {KOKSMA__WRAP_REPEAT, KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_MIRROR,
                                         KOKSMA__WRAP_CLAMP, KOKSMA__WRAP_CLAMP};
    const size_t wrap = choice(r, n, "wrap_mode"), filter = choice(r, n, "filter_type");
    to->wrap[0] = to->wrap[1] = kinds[wrap];
    to->nearest = filter == 1;
    koksma__import_unknown_if(wrap > 2, n->place, "a texture's wrap mode '%s' is replaced by 'clamp'",
                              text(r, n, "wrap_mode"));
    koksma__import_unknown_if(filter > 1, n->place, "a texture's filter '%s' is replaced by 'bilinear'",
                              text(r, n, "filter_type"));
    set_matrix(r, n, to);
}

/* Fails if an object lacks a property that Mitsuba has no default for. */
static void check_needed(const reader *r, const node *n)
{
    for (koksma__entry e = koksma__entries_of(row_of(r, n)); koksma__entry_next(&e);) {
        koksma__import_fail_if(e.is_needed && !find_property(r, n, &e), n->place, "%s '%s': no '%.*s'", n->tag,
                               type_of(n), (int)e.length, e.name);
    }
}

static void texture(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out, int depth);

/* Reads the spectrum "d65", daylight times a colour or texture. Daylight itself is white, and samples are its factors:
   those of 1 everywhere leave it white, also in a light. */
static void in_daylight(reader *r, const node *n, koksma__import_colour *out, int depth)
{
    const double scale = number(r, n, "scale");
    const node *inner = NULL;
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        if (is_texture(resolve(r, c))) {
            koksma__import_fail_if(inner, c->place, "spectrum 'd65': more than one texture");
            koksma__xml_mark(c, KOKSMA__XML_TAKEN);
            inner = resolve(r, c);
        }
    }
    if (inner) {
        texture(r, inner, KOKSMA__UNBOUNDED, out, depth + 1);
    } else {
        *out = colour_for(r, n, "color", use_of(n, "color"), depth + 1);
    }
    for (int k = 0; k < 3; k++) {
        out->rgb[k] *= scale;
        out->second[k] *= scale;
    }
    out->image_scale *= scale;
}

/* Reads the spectra "regular" and "irregular": samples at equal distances, or at those that are listed. */
static void samples(reader *r, const node *n, bool regular, koksma__spectrum_use use, double rgb[3])
{
    const node *pairs = property(r, n, "value"), *values = property(r, n, "values");
    const node *wavelengths = property(r, n, "wavelengths");
    if (pairs) {
        value_of(resolve(r, pairs), use, rgb);
        return;
    }
    check_needed(r, n);
    koksma__import_spend(n->place, KOKSMA__SPECTRUM_STEPS);
    (void)text(r, n, "values");
    (void)text(r, n, "wavelengths");
    const double from = regular ? number(r, n, "wavelength_min") : 0,
                 to = regular ? number(r, n, "wavelength_max") : 0;
    const koksma__sampled_spectrum s = koksma__mitsuba_samples(values, wavelengths, from, to);
    koksma__sampled_spectrum_colour(&s, use, rgb);
}

static void bitmap(reader *r, const node *n, koksma__import_colour *out)
{
    const char *name = text(r, n, "filename"), *dot = strrchr(name, '.');
    const bool linear = dot && (!strcasecmp(dot, ".exr") || !strcasecmp(dot, ".pfm"));
    koksma__import_unknown_if(flag(r, n, "raw") && !linear, n->place,
                              "a texture's 'raw' is ignored: its levels are sRGB");
    set_mapping(r, n, &out->mapping);
    out->image_scale = 1;
    koksma__import_path(n->place, name, out->image);
}

static void checkerboard(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out, int depth)
{
    const koksma__spectrum_use each = use == KOKSMA__REFLECTANCE ? use : KOKSMA__UNBOUNDED;
    *out = colour_for(r, n, "color0", each, depth + 1);
    koksma__import_colour second = colour_for(r, n, "color1", each, depth + 1);
    koksma__import_mean(n->place, "a texture in a checkerboard", use, out);
    koksma__import_mean(n->place, "a texture in a checkerboard", use, &second);
    set_matrix(r, n, &out->mapping);
    memcpy(out->second, second.rgb, sizeof second.rgb);
    out->is_checker = true;
    out->period = 0.5;
}

/* Reads the object of a texture, or of a spectrum as the RGB variants of Mitsuba do, and sampled ones as the observer sees
   them. */
static void texture(reader *r, const node *n, koksma__spectrum_use use, koksma__import_colour *out, int depth)
{
    const koksma__plugin *row = row_of(r, n);
    double value;
    koksma__import_fail_if(depth > MOST_NESTED, n->place, "textures are nested more than %d deep", MOST_NESTED);
    if (!row) {
        out->rgb[0] = is(n, "spectrum") ? 1 : out->rgb[0];
        out->rgb[1] = out->rgb[2] = out->rgb[0];
        REPLACE(n, "%s '%s' is replaced by %s%s", n->tag, type_of(n), is(n, "spectrum") ? "white" : "grey",
                TYPE_MEANT(r, n));
        return;
    }
    if (row->makes != KOKSMA__REGULAR && row->makes != KOKSMA__IRREGULAR) {
        check_needed(r, n);
    }
    pass(r, n);
    switch (row->makes) {
    case KOKSMA__BITMAP:
        bitmap(r, n, out);
        break;
    case KOKSMA__CHECKERBOARD:
        checkerboard(r, n, use, out, depth);
        break;
    case KOKSMA__D65:
        in_daylight(r, n, out, depth);
        break;
    case KOKSMA__SRGB:
        *out = colour_for(r, n, "color", use_of(n, "color"), depth + 1);
        break;
    case KOKSMA__UNIFORM:
        out->rgb[0] = out->rgb[1] = out->rgb[2] = number(r, n, "value");
        break;
    case KOKSMA__TEMPERATURE:
        value = number(r, n, "temperature");
        koksma__import_fail_if(!(value > 0), n->place, "a temperature of %g kelvins; it must be above 0", value);
        koksma__black_body_colour(value, out->rgb);
        koksma__import_unknown(n->place, "a black body is replaced by %s", row->instead);
        break;
    default:
        samples(r, n, row->makes == KOKSMA__REGULAR, use, out->rgb);
    }
}

/* Reads the colour or texture with this name; without one, it is grey with the row's default. */
static koksma__import_colour colour_for(reader *r, const node *n, const char *name, koksma__spectrum_use use,
                                        int depth)
{
    const node *found = property(r, n, name);
    const double grey = otherwise(r, n, name);
    koksma__import_colour out = {.rgb = {grey, grey, grey}, .period = 1};
    found = found ? resolve(r, found) : NULL;
    if (found && is_texture(found)) {
        texture(r, found, use, &out, depth);
    } else if (found) {
        value_of(found, use, out.rgb);
    }
    return out;
}

/* ---- BSDFs ------------------------------------------------------------------------------------------------- */

/* An index of refraction: a number or the name of a material. One that is not above 0 is a mistake. */
static double index_of(const reader *r, const node *n, const char *name)
{
    const node *c = property(r, n, name);
    double ior;
    if (!c || !is(c, "string") || !koksma__mitsuba_index(text(r, n, name), &ior)) {
        ior = number(r, n, name);
        need(ior > 0, c, "an index of refraction; it must be above 0");
    }
    return ior;
}

/* Reads eta or k of a metal. Returns false if it is not one colour, or a spectrum in a file, which is not read. */
static bool constant(reader *r, const node *n, const char *name, double rgb[3])
{
    const node *found = property(r, n, name), *to = found ? resolve(r, found) : NULL;
    const bool is_object = to && !koksma__mitsuba_is_colour(to) && koksma__xml_attribute(to, "type");
    const bool is_file = to && is(to, "spectrum") && koksma__xml_attribute(to, "filename");
    if (to && is_texture(to) ? !row_of(r, to) || row_of(r, to)->makes < KOKSMA__D65 : is_object || is_file) {
        koksma__xml_mark(found, KOKSMA__XML_COVERED);
        return false;
    }
    const koksma__import_colour c = colour(r, n, name);
    memcpy(rgb, c.rgb, sizeof c.rgb);
    return !*c.image && !c.is_checker;
}

/* A metal has one colour. */
static void mean_of_metal(const node *n, koksma__import_material *m)
{
    if (m->kind == KOKSMA__METAL) {
        koksma__import_mean(n->place, "a metal's texture", KOKSMA__REFLECTANCE, &m->colour);
    }
}

/* Reads what a metal is made of: a name, or eta and k. Those metals whose constants Mitsuba does not have reflect as tables
   of import.c say, by Schlick's approximation. */
static void metal(reader *r, const node *n, koksma__import_material *m)
{
    double rgb[3];
    mean_of_metal(n, m);
    bool is_constant = true;
    const char *given = text(r, n, "material"), *name = *given || property(r, n, "eta") ? given : "none";
    m->has_index = !*name || koksma__mitsuba_conductor(name, m->eta, m->k);
    if (!*name) {
        is_constant = constant(r, n, "eta", m->eta);
        is_constant &= constant(r, n, "k", m->k);
    } else if (!m->has_index && koksma__import_metal(name, rgb)) {
        for (int i = 0; i < 3; i++) {
            m->colour.rgb[i] *= rgb[i];
        }
        koksma__import_unknown_if(strcmp(name, "none") != 0, n->place, "metal '%s' has Schlick's reflectance", name);
        return;
    }
    koksma__import_unknown_if(!m->has_index, n->place, "metal '%s' is replaced by chromium", name);
    koksma__import_unknown_if(m->has_index && !is_constant, n->place,
                              "a metal whose eta or k varies or is in a file is replaced by chromium");
    if (!m->has_index || !is_constant) {
        m->has_index = koksma__mitsuba_conductor("Cr", m->eta, m->k);
    }
}

static int principled(reader *r, const node *n)
{
    koksma__import_material m = {.colour = colour(r, n, "base_color")};
    const double roughness = number(r, n, "roughness");
    m.alpha = roughness * roughness;
    m.ior = index_of(r, n, "eta");
    m.kind = number(r, n, "metallic") > 0.5     ? KOKSMA__METAL
             : number(r, n, "spec_trans") > 0.5 ? KOKSMA__GLASS
                                                : KOKSMA__COATED;
    mean_of_metal(n, &m);
    return koksma__import_material_of(n->place, &m);
}

static int make_bsdf(reader *r, const node *n, int depth);

/* Makes a BSDF that light meets only in part ("mask"), or a blend of two ("blendbsdf"). */
static int blend(reader *r, const node *n, int depth)
{
    const bool masks = row_of(r, n)->makes == KOKSMA__MASK;
    const node *first = find_child(r, first_of(r, n), "bsdf"),
               *second = first ? find_child(r, next_of(r, first), "bsdf") : NULL;
    koksma__import_fail_if(!first || (!masks && !second), n->place, "bsdf '%s': it has %s within it", type_of(n),
                           masks ? "no BSDF" : "less than two BSDFs");
    check_needed(r, n);
    koksma__import_colour share = colour(r, n, masks ? "opacity" : "weight");
    const int material = make_bsdf(r, resolve(r, first), depth + 1);
    return masks ? koksma__import_mask(n->place, material, &share)
                 : koksma__import_mix(n->place, material, make_bsdf(r, resolve(r, second), depth + 1), &share);
}

/* Makes a BSDF that is replaced by the first BSDF inside it; a second one is that of the back of "twosided". */
static int within(reader *r, const node *n, int depth)
{
    const node *inner = depth < MOST_NESTED ? find_child(r, first_of(r, n), "bsdf") : NULL;
    koksma__import_fail_if(!inner, n->place, "bsdf '%s': it has no BSDF within it", type_of(n));
    const node *back = row_of(r, n)->instead ? NULL : find_child(r, next_of(r, inner), "bsdf");
    koksma__import_unknown_if(back && resolve(r, back) != resolve(r, inner), back ? back->place : n->place,
                              "the BSDF of a back is replaced by that of the front");
    return make_bsdf(r, resolve(r, inner), depth + 1);
}

/* Makes a BSDF of the kinds that koksma__import_material has; its colour comes first in its row. */
static int plain_bsdf(reader *r, const node *n)
{
    koksma__entry e = koksma__entries_of(row_of(r, n));
    char name[40];
    koksma__entry_next(&e);
    snprintf(name, sizeof name, "%.*s", (int)e.length, e.name);
    koksma__import_material m = {.kind = (unsigned)row_of(r, n)->makes, .colour = colour(r, n, name)};
    const bool is_white = !*m.colour.image && !m.colour.is_checker && m.colour.rgb[0] == 1 && m.colour.rgb[1] == 1 &&
                          m.colour.rgb[2] == 1;
    /* a tint would colour what it reflects as well */
    koksma__import_unknown_if(m.kind == KOKSMA__GLASS && !is_white, n->place, "a glass's '%s' is ignored", name);
    if (m.kind == KOKSMA__METAL) {
        metal(r, n, &m);
    }
    const double both = number(r, n, "alpha");
    const double u = property(r, n, "alpha_u") ? number(r, n, "alpha_u") : both;
    const double v = property(r, n, "alpha_v") ? number(r, n, "alpha_v") : both;
    m.alpha = sqrt(fmax(u * v, 0));
    if (m.kind == KOKSMA__GLASS || m.kind == KOKSMA__COATED) {
        m.ior = index_of(r, n, "int_ior") / index_of(r, n, "ext_ior");
    }
    koksma__import_unknown_if(!strncmp(type_of(n), "rough", 5) && entry_of(r, n, "distribution", &e) &&
                                  choice(r, n, "distribution") != 1,
                              n->place, "Beckmann's distribution is replaced by GGX");
    koksma__import_unknown_if(u != v, n->place, "anisotropic roughness is replaced by its mean");
    return koksma__import_material_of(n->place, &m);
}

static int make_bsdf(reader *r, const node *n, int depth)
{
    const koksma__plugin *row = row_of(r, n);
    koksma__import_unknown_if(row->instead, n->place, "BSDF '%s' is replaced by %s%s", type_of(n), row->instead,
                              TYPE_MEANT(r, n));
    if (row->instead && (*row->kinds == '?' || row->makes == KOKSMA__NOTHING || row->makes == KOKSMA__WITHIN)) {
        koksma__xml_mark(n, KOKSMA__XML_COVERED);
    }
    pass(r, n);
    switch (row->makes) {
    case KOKSMA__NOTHING:
        return -1;
    case KOKSMA__WITHIN:
        return within(r, n, depth);
    case KOKSMA__MASK:
    case KOKSMA__BLEND:
        koksma__import_fail_if(depth >= MOST_NESTED, n->place, "BSDFs are nested more than %d deep", MOST_NESTED);
        return blend(r, n, depth);
    case KOKSMA__PRINCIPLED:
        return principled(r, n);
    default:
        return plain_bsdf(r, n);
    }
}

/* ---- Shapes ------------------------------------------------------------------------------------------------ */

/* Mitsuba samples no light of weight 0; here all lights are sampled. */
static void weight(reader *r, const node *n)
{
    koksma__import_unknown_if(!(number(r, n, "sampling_weight") > 0), n->place,
                              "a light whose sampling weight is 0 is sampled");
}

/* Reads a light of a surface whose material is known: its radiance may be an image. */
static void area_light(reader *r, const node *n, koksma__import_surface *surface)
{
    weight(r, n);
    koksma__import_colour radiance = colour(r, n, "radiance");
    koksma__import_glow(n->place, &radiance, surface);
    if (!*radiance.image) {
        koksma__import_mean(n->place, "a light's texture", KOKSMA__EMISSION, &radiance);
        memcpy(surface->radiance, radiance.rgb, sizeof radiance.rgb);
    }
    surface->emits = true;
    koksma__import_unknown_if(!has_type(n, "area"), n->place, "a light's direction is ignored");
}

/* Finds a shape's material and emission among its children. */
static koksma__import_surface surface_of(reader *r, const node *n)
{
    bool has_bsdf = false;
    koksma__import_surface out = {.material = -1, .turned = flag(r, n, "flip_normals")};
    EACH_CHILD(r, n, c, "bsdf")
    {
        const node *bsdf = resolve(r, c);
        int *known = &r->materials[bsdf - r->xml.nodes];
        *known = *known == -2 ? make_bsdf(r, bsdf, 0) : *known;
        out.material = *known;
        has_bsdf = true;
    }
    EACH_CHILD(r, n, c, "emitter")
    {
        area_light(r, resolve(r, c), &out);
    }
    if (!has_bsdf && !out.emits) {
        const koksma__import_material grey = {.kind = KOKSMA__MATTE, .colour = {.rgb = {0.5, 0.5, 0.5}, .period = 1}};
        out.material = koksma__import_material_of(n->place, &grey);
    }
    return out;
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
static void form_of(reader *r, const node *n, koksma__import_item *item, double m[12])
{
    const koksma__plugin *row = row_of(r, n);
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
        const double part = has_type(n, "serialized") ? number(r, n, "shape_index") : -1;
        koksma__import_fail_if(has_type(n, "serialized") && !(part >= 0 && part <= 1e9 && part == floor(part)),
                               n->place, "a shape_index of %g: it is a whole number from 0 on", part);
        const koksma__mesh_rules rules = {
            .facets = flag(r, n, "face_normals"), .smooths = true, .flips_v = flag(r, n, "flip_tex_coords")};
        item->mesh = koksma__import_mesh_file(n->place, text(r, n, "filename"), (long)part, rules);
    } else if (item->form == KOKSMA__FORM_MESH) {
        REPLACE(n, "shape '%s' is left out%s", type_of(n), TYPE_MEANT(r, n));
    }
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
static void find_medium(reader *r, const node *root)
{
    const node *child = first_of(r, root);
    while (child && !is(object_of(r, child), "sensor")) {
        child = next_of(r, child);
    }
    r->medium = child ? medium_of(r, object_of(r, child), NULL) : NULL;
    for (child = first_of(r, root); child && !r->filled; child = next_of(r, child)) {
        const node *n = object_of(r, child);
        const bool is_ball = has_type(n, "sphere");
        const node *inside = is(n, "shape") && (is_ball || has_type(n, "cube")) ? medium_of(r, n, "interior") : NULL;
        if (inside && (!r->medium || inside == r->medium) && has_type(inside, "homogeneous")) {
            koksma__import_item item;
            double form[12], to_world[12], m[12];
            form_of(r, n, &item, form);
            transform(r, n, "to_world", to_world);
            koksma__matrix_multiply(to_world, form, m);
            if (set_region(m, is_ball, &r->region)) {
                r->medium = inside;
                r->filled = n;
            }
        }
    }
}

static bool is_glass(const reader *r, int material)
{
    const koksma__bsdf *bsdf = material < 0 ? NULL : r->im->scene->materials[material].bsdf;
    return bsdf == &koksma__bsdf_dielectric || bsdf == &koksma__bsdf_rough_dielectric;
}

/* Warns about the media of a shape that are not read. */
static void name_media(reader *r, const node *n, int material)
{
    const node *inside = medium_of(r, n, "interior"), *outside = medium_of(r, n, "exterior");
    for (int i = 0; i < 2; i++) {
        const node *medium = i ? outside : inside;
        if (medium && medium != r->medium) {
            koksma__xml_mark(medium, KOKSMA__XML_COVERED);
        }
    }
    if (inside && !has_type(inside, "homogeneous")) {
        koksma__import_unknown(inside->place, "media that vary in space are ignored");
    } else if (inside && n != r->filled) {
        koksma__import_unknown(n->place,
                               "a medium in a shape is ignored: only one is read, of the sensor, a cube or a sphere");
    } else if (outside && outside != r->medium) {
        koksma__import_unknown(n->place, "a medium around a shape is ignored: only one is read");
    } else if (outside && !inside && is_glass(r, material)) {
        koksma__import_unknown(n->place, "glass in a medium is filled by the medium");
    }
}

/* Reads a colour of a medium, which is given directly or by a constant volume, of "color" in Mitsuba 2. */
static void medium_colour(reader *r, const node *n, const char *name, double rgb[3])
{
    const node *found = property(r, n, name), *to = found ? resolve(r, found) : NULL;
    const bool in_volume = to && is(to, "volume");
    const double grey = otherwise(r, n, name);
    koksma__import_colour c = {.rgb = {grey, grey, grey}};
    if (in_volume && !has_type(to, "constvolume")) {
        REPLACE(to, "volume '%s' is replaced by %g", type_of(to), grey);
    } else {
        c = in_volume ? colour(r, to, "value") : colour(r, n, name);
        koksma__import_mean(n->place, "a medium's texture", KOKSMA__UNBOUNDED, &c);
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = c.rgb[k] > 0 ? fmin(c.rgb[k], FAR) : 0;
    }
}

static double phase_of(reader *r, const node *n)
{
    double g = 0;
    EACH_CHILD(r, n, c, "phase")
    {
        const node *phase = resolve(r, c);
        if (!row_of(r, phase)) {
            REPLACE(phase, "phase function '%s' is replaced by the isotropic", type_of(phase));
            break;
        }
        g = fmax(-0.999, fmin(number(r, phase, "g"), 0.999));
    }
    return g;
}

/* Sets the scene's medium. Mitsuba gives the extinction and the albedo: their product is the scattering, and the rest
   of the extinction is the absorption. Versions before Mitsuba 2 give scattering and absorption. A scale multiplies
   all coefficients. */
static void read_medium(reader *r, const node *n)
{
    koksma__medium *to = &r->im->scene->medium;
    double a[3], b[3];
    if (!has_type(n, "homogeneous") || property(r, n, "material")) {
        REPLACE(n, "media that vary in space, and media named in place of a material, are ignored");
        return;
    }
    pass(r, n);
    const bool old = property(r, n, "sigma_s") || property(r, n, "sigma_a");
    const double scale = fmin(fmax(number(r, n, "scale"), 0), FAR);
    medium_colour(r, n, old ? "sigma_s" : "albedo", b);
    medium_colour(r, n, old ? "sigma_a" : "sigma_t", a);
    const double g = phase_of(r, n);
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
    koksma__import_check_medium(n->place, "sensor's");
}

static void shape(reader *r, const node *n, const double outer[12], int depth);

/* Adds the shapes of the group to which an instance refers. */
static void instance(reader *r, const node *n, const double outer[12], int depth)
{
    double m[12], matrix[12];
    bool found = false;
    koksma__import_fail_if(depth > MOST_NESTED, n->place, "instances are nested more than %d deep", MOST_NESTED);
    transform(r, n, "to_world", m);
    koksma__matrix_multiply(outer ? outer : koksma__import_identity, m, matrix);
    EACH_CHILD(r, n, c, "shape")
    {
        const node *group = resolve(r, c);
        found = true;
        (void)row_of(r, group); /* it is looked up */
        EACH_CHILD(r, group, part, "shape")
        {
            shape(r, resolve(r, part), matrix, depth + 1);
        }
    }
    koksma__import_fail_if(!found, n->place, "an instance without a reference to a shape group");
}

/* Warns if a shape's normals are turned round to no effect: surfaces that reflect have two sides here, and a sphere of
   glass has its own normals. */
static void name_flip(reader *r, const node *n, const koksma__import_item *item)
{
    const node *bsdf = find_child(r, first_of(r, n), "bsdf");
    const bool none = item->surface.emits || item->surface.material < 0 ||
                      (bsdf && has_type(resolve(r, bsdf), "twosided")) ||
                      (is_glass(r, item->surface.material) && item->form != KOKSMA__FORM_SPHERE);
    koksma__import_unknown_if(item->surface.turned && !none, n->place,
                              "'flip_normals' is ignored: surfaces have two sides");
}

static void shape(reader *r, const node *n, const double outer[12], int depth)
{
    koksma__import_item item = {.place = n->place};
    double form[12], to_world[12];
    if (has_type(n, "shapegroup")) {
        return;
    }
    if (has_type(n, "instance")) {
        instance(r, n, outer, depth);
        return;
    }
    form_of(r, n, &item, form);
    if (item.form == KOKSMA__FORM_MESH && item.mesh < 0) {
        koksma__xml_mark(n, KOKSMA__XML_COVERED);
        return;
    }
    item.surface = surface_of(r, n);
    name_flip(r, n, &item);
    const koksma__mesh *mesh = item.mesh < 0 ? NULL : &r->im->scene->meshes[item.mesh];
    koksma__import_spend(n->place, mesh ? mesh->n_triangles / 16 : 0);
    koksma__import_unknown_if(item.surface.emits && mesh && koksma__mesh_is_curved(mesh), n->place,
                              "a luminous mesh shines from its flat sides, not by its smooth normals");
    name_media(r, n, item.surface.material);
    transform(r, n, "to_world", to_world);
    koksma__matrix_multiply(to_world, form, item.matrix);
    koksma__import_put(&item, outer, NULL);
}

/* ---- Emitters and sensors ------------------------------------------------------------------------------------ */

static void emitter(reader *r, const node *n)
{
    static const char *const colours[] = {[KOKSMA__POINT_LIGHT] = "intensity",
                                          [KOKSMA__SPOT] = "intensity",
                                          [KOKSMA__FAR_LIGHT] = "irradiance",
                                          [KOKSMA__SKY] = "radiance",
                                          [KOKSMA__PICTURE] = "radiance"};
    const koksma__plugin *row = row_of(r, n);
    koksma__light light = {.kind = &koksma__light_point};
    double m[12];
    weight(r, n);
    transform(r, n, "to_world", m);
    koksma__import_colour c = colour(r, n, colours[row->makes]);
    koksma__import_mean(n->place, "a light's texture", KOKSMA__EMISSION, &c);
    if (row->instead) {
        REPLACE(n, "emitter '%s' is replaced by %s%s", type_of(n), row->instead, TYPE_MEANT(r, n));
    }
    memcpy(light.radiance, c.rgb, sizeof c.rgb);
    double along[3] = {m[2], m[6], m[10]};
    for (int k = 0; k < 3 && row->makes <= KOKSMA__SPOT; k++) {
        light.centre[k] = m[4 * k + 3];
    }
    if (row->makes == KOKSMA__PICTURE) {
        const double scale = number(r, n, "scale"), rgb[3] = {scale, scale, scale};
        koksma__import_sky(n->place, text(r, n, "filename"), 0, rgb, m);
        return;
    }
    if (row->makes == KOKSMA__SKY) {
        light.kind = &koksma__light_environment;
        light.visible = true;
    } else if (row->makes == KOKSMA__FAR_LIGHT) {
        light.kind = &koksma__light_directional;
        point(r, n, "direction", along);
        memcpy(light.normal, along, sizeof light.normal);
        koksma__import_fail_if(!koksma__import_normalise(light.normal), n->place,
                               "a directional light without a direction");
    } else {
        point(r, n, "position", light.centre);
    }
    if (row->makes == KOKSMA__SPOT) {
        const double outer = number(r, n, "cutoff_angle");
        const double inner = property(r, n, "beam_width") ? number(r, n, "beam_width") : outer * 3 / 4;
        koksma__import_spot(n->place, along, inner, outer, KOKSMA__FALLOFF_ANGLE, &light);
    }
    koksma__import_light(n->place, &light);
}

/* ---- Sensors and films --------------------------------------------------------------------------------------- */

/* Takes the parameters of an object that chooses how a picture is computed or stored, which the program's own options do
   here, or warns that it has another type. */
static void plain(reader *r, const node *n)
{
    const koksma__plugin *row = row_of(r, n);
    if (!row || row->instead) {
        REPLACE(n, "%s '%s' is ignored%s", n->tag, type_of(n), TYPE_MEANT(r, n));
        return;
    }
    pass(r, n);
    if (is(n, "sampler") && property(r, n, "sample_count")) { /* `koksma rank` takes the number from here */
        const double spp = number(r, n, "sample_count");
        r->im->scene->spp = spp >= 1 && spp <= KOKSMA_MAX_SPP ? (int)spp : 0;
    }
    EACH_CHILD(r, n, c, "sampler")
    {
        plain(r, resolve(r, c));
    }
    EACH_CHILD(r, n, c, "rfilter")
    {
        plain(r, resolve(r, c));
    }
}

/* Reads the objects of a sensor, of which the film has the sides of the picture. */
static void objects_of_sensor(reader *r, const node *n)
{
    double width = 768, height = 576;
    EACH_CHILD(r, n, c, "film")
    {
        const node *film = resolve(r, c);
        width = number(r, film, "width");
        height = number(r, film, "height");
        koksma__import_fail_if(!(width >= 1 && height >= 1 && width <= KOKSMA_MAX_IMAGE_SIDE &&
                                 height <= KOKSMA_MAX_IMAGE_SIDE && width == floor(width) && height == floor(height)),
                               film->place, "a film of %g x %g pixels; each side must be a whole number, 1 to %d",
                               width, height, KOKSMA_MAX_IMAGE_SIDE);
        plain(r, film);
    }
    r->im->scene->width = (int)width;
    r->im->scene->height = (int)height;
    plain(r, n);
}

/* The focal length in mm: a number, or a text that may end in "mm". */
static double focal_length(const reader *r, const node *n)
{
    const node *c = property(r, n, "focal_length");
    double length_mm = 50;
    if (!c || koksma__mitsuba_is_number(c)) {
        return number(r, n, "focal_length");
    }
    need(koksma__mitsuba_measure(text(r, n, "focal_length"), "mm", &length_mm), c, "a length in mm");
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

static void sensor(reader *r, const node *n)
{
    double m[12];
    const bool lens = has_type(n, "thinlens");
    if (r->has_sensor) {
        REPLACE(n, "the scene has a second sensor, which is left out");
        return;
    }
    koksma__import_fail_if(!row_of(r, n), n->place,
                           "sensor '%s' is not read; 'perspective', 'thinlens' and 'orthographic' are", type_of(n));
    r->has_sensor = true;
    objects_of_sensor(r, n);
    const double near = number(r, n, "near_clip"), far = number(r, n, "far_clip");
    koksma__import_fail_if(!(near > 0 && far > near), n->place,
                           "the camera sees from near_clip, above 0, to far_clip: not from %g to %g", near, far);
    transform(r, n, "to_world", m);
    const double width = r->im->scene->width, height = r->im->scene->height;
    koksma__camera camera = {.focus_distance = lens ? number(r, n, "focus_distance") : 1,
                             .lens_radius = lens ? number(r, n, "aperture_radius") : 0,
                             .near_clip = near,
                             .far_clip = far};
    if (has_type(n, "orthographic")) { /* it shows -1 to 1 along x */
        const double x = sqrt(m[0] * m[0] + m[4] * m[4] + m[8] * m[8]),
                     y = sqrt(m[1] * m[1] + m[5] * m[5] + m[9] * m[9]);
        camera.height = 2 * height / width;
        koksma__import_unknown_if(fabs(x - y) > 1e-4 * y, n->place,
                                  "the camera's scale along x is replaced by the scale along y");
    } else {
        camera.fov_rad = height_angle(r, n, width, height);
    }
    koksma__import_camera(n->place, m, -1, &camera);
}

/* ---- Integrators ---------------------------------------------------------------------------------------------- */

/* Reads what an integrator says of the picture: how long paths are, and whether the camera sees lights. All that estimate
   the same light by other means are path tracing here. */
static void integrator(reader *r, const node *n, int depth)
{
    koksma_scene *scene = r->im->scene;
    const node *inner = has_type(n, "aov") ? find_child(r, first_of(r, n), "integrator") : NULL;
    plain(r, n);
    if (!row_of(r, n) || (inner && depth < MOST_NESTED)) { /* the picture is that of the integrator within */
        if (inner) {
            integrator(r, resolve(r, inner), depth + 1);
        }
        return;
    }
    static const char surfaces_only[] = "path direct prb prb_basic ptracer";
    koksma__import_unknown_if(
        r->medium && koksma__lists(surfaces_only, sizeof surfaces_only - 1, ' ', type_of(n)), n->place,
        "the medium is rendered, which Mitsuba's integrator '%s' leaves out; 'volpath' has it", type_of(n));
    const bool direct = has_type(n, "direct");
    const double most = direct ? 2 : number(r, n, "max_depth");
    scene->paths = !direct;
    scene->hides_lights = flag(r, n, "hide_emitters");
    if (most >= 0 && most < 2) {
        koksma__import_unknown(n->place, "a max_depth of %g is replaced by 2", most);
        return;
    }
    /* Mitsuba counts a path's segments, of which one comes from the camera and one from a light; --depth the others */
    scene->path_vertices = 1 + (most < 0 ? KOKSMA_MAX_DEPTH : (int)fmin(most - 2, KOKSMA_MAX_DEPTH));
}

/* ---- The whole scene ---------------------------------------------------------------------------------------- */

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

/* Whether the children of a scene with this tag are read, wherever else they are referred to. */
static bool is_of_scene(const node *n)
{
    static const char tags[] =
        "sensor shape emitter integrator bsdf texture spectrum medium ref alias default include path";
    return koksma__lists(tags, sizeof tags - 1, ' ', n->tag) && (!is(n, "emitter") || !has_type(n, "area"));
}

/* Marks what the table knows of an object that nothing refers to, and of those in it, so that what is misspelt there is
   named, too. */
static void judge(reader *r, const node *n)
{
    const koksma__plugin *row = row_of(r, n);
    if (!row || *row->kinds == '?') {
        REPLACE(n, "%s '%s' is ignored%s", n->tag, type_of(n), TYPE_MEANT(r, n));
        return;
    }
    for (koksma__entry e = koksma__entries_of(row); koksma__entry_next(&e);) {
        const node *c = find_property(r, n, &e);
        koksma__xml_mark(c ? c : n, c ? KOKSMA__XML_TAKEN : 0);
    }
    for (const node *c = first_of(r, n); c; c = next_of(r, c)) {
        const bool is_object = koksma__xml_attribute(resolve(r, c), "type") != NULL;
        koksma__xml_mark(c, is_object && !koksma__xml_attribute(c, "name") ? KOKSMA__XML_TAKEN : 0);
        for (const node *o = is(c, "transform") ? first_of(r, c) : NULL; o; o = next_of(r, o)) {
            koksma__xml_mark(o, KOKSMA__XML_TAKEN);
        }
        if (is_object && !is(c, "ref") && !r->rows[c - r->xml.nodes]) {
            judge(r, c);
        }
    }
}

static void read_root(reader *r)
{
    const node *root = r->xml.n ? r->xml.nodes : NULL;
    koksma__import_fail_if(!root || !is(root, "scene"), (koksma__text_place){r->im, r->im->path, 1},
                           "no <scene>: the file is not a Mitsuba scene");
    find_medium(r, root);
    r->im->scene->paths = true;
    for (const node *c = first_of(r, root); c; c = next_of(r, c)) {
        const node *n = object_of(r, c);
        koksma__xml_mark(c, is_of_scene(c) ? KOKSMA__XML_TAKEN : 0);
        if (is(n, "sensor")) {
            sensor(r, n);
        } else if (is(n, "integrator")) {
            integrator(r, n, 0);
        } else if (is(n, "shape")) {
            shape(r, n, NULL, 0);
        } else if (is(n, "emitter") && !has_type(n, "area")) {
            emitter(r, n);
        }
    }
    koksma__import_fail_if(!r->has_sensor, root->place, "no <sensor>");
    if (r->medium) {
        read_medium(r, r->medium);
    }
    (void)koksma__xml_attribute(root, "version");
    for (const node *n = first_of(r, root); n; n = next_of(r, n)) { /* what nothing has looked up */
        if ((is(n, "bsdf") || is_texture(n) || is(n, "medium") || is(n, "shape")) && !r->rows[n - r->xml.nodes]) {
            judge(r, n);
        }
    }
    koksma__xml_mark(root, KOKSMA__XML_TAKEN);
    koksma__xml_name_unread(r->im, &r->xml, meant_by, r);
}

static void read_scene(void *data)
{
    reader *r = data;
    koksma__xml_read(r->im, r->bytes, r->size, &r->xml);
    r->materials = malloc((r->xml.n + 1) * sizeof *r->materials);
    r->rows = calloc(r->xml.n + 1, sizeof *r->rows);
    koksma__import_pass((koksma__text_place){.im = r->im},
                        r->materials && r->rows ? KOKSMA_OK : koksma__fail_memory(r->xml.n * sizeof *r->materials));
    for (size_t i = 0; i < r->xml.n; i++) {
        r->materials[i] = -2;
    }
    koksma__mitsuba_check(&r->xml);
    find_identities(r);
    read_root(r);
}

koksma_status koksma__mitsuba_read(koksma__import *im, const char *bytes, size_t size)
{
    reader r = {.im = im, .bytes = bytes, .size = size};
    im->rows_down = true;
    const koksma_status status = koksma__import_try(im, read_scene, &r);
    KOKSMA__FREE(r.materials, r.rows);
    koksma__names_fini(&r.identities);
    koksma__xml_fini(&r.xml);
    return status;
}
