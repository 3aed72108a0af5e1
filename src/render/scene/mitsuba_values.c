/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the values of Mitsuba's elements. Each syntax has one function, which refuses a value that it does not
 * understand to its end: a value that is read in part would change the scene without a word. Mitsuba 3 itself is as
 * strict in nearly everything; what earlier versions wrote is read, too: "5000K" and "#ff8000".
 */
#include "scene/mitsuba_reader.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/status.h"
#include "core/vector.h"

#define BLANKS " \t\r\n"
#define SEPARATORS BLANKS ","

typedef koksma__xml_node node;

bool koksma__mitsuba_is(const node *n, const char *tag)
{
    return !strcasecmp(n->tag, tag); /* lookAt was the name in Mitsuba 0.6 */
}

/* Fails with "FILE:LINE: NAME: 'VALUE' is not EXPECTED", unless `is_right`; the name is that of the property or the
   element, and of the attribute if that has another name than "value". */
static void need(bool is_right, const node *n, const char *attribute, const char *expected)
{
    if (is_right) {
        return;
    }
    const char *name = koksma__xml_attribute(n, "name"), *value = koksma__xml_attribute(n, attribute);
    const char *key = strcmp(attribute, "value") != 0 ? attribute : "";
    name = name ? name : n->tag;
    koksma__import_fail_if(!value, n->place, "%s: no '%s', which is %s", name, attribute, expected);
    koksma__import_fail(n->place, "%s%s%s: '%.60s' is not %s", name, *key ? " " : "", key, value, expected);
}

/* Reads the finite number at `*at` and moves *at behind it; returns false if there is none. */
static bool take_number(const char **at, double *out)
{
    const char *digits = *at + (**at == '-' || **at == '+');
    *out = 0;
    char *end;
    if (strchr(BLANKS, *digits) || !strncasecmp(digits, "0x", 2)) {
        return false;
    }
    *out = koksma__strtod(*at, &end);
    const bool found = end != *at && isfinite(*out);
    *at = end;
    return found;
}

bool koksma__mitsuba_measure(const char *text, const char *unit, double *out)
{
    text += strspn(text, BLANKS);
    if (!take_number(&text, out)) {
        return false;
    }
    text += strncmp(text, unit, strlen(unit)) != 0 ? 0 : strlen(unit);
    return !text[strspn(text, BLANKS)];
}

double koksma__mitsuba_number(const node *n, const char *attribute)
{
    const char *value = koksma__xml_attribute(n, attribute);
    const bool whole = koksma__mitsuba_is(n, "integer");
    double number = 0;
    const bool is_right = value && koksma__mitsuba_measure(value, "", &number) && (!whole || number == floor(number));
    need(is_right, n, attribute, whole ? "a whole number" : isfinite(number) ? "a number" : "a finite number");
    return number;
}

/* From 0 to `most` numbers, separated by blanks or commas; returns how many. */
static size_t numbers_of(const node *n, const char *attribute, size_t most, double *out)
{
    const char *at = koksma__xml_attribute(n, attribute);
    size_t count = 0;
    for (at = at ? at : ""; at += strspn(at, SEPARATORS), *at; count++) {
        if (count == most || !take_number(&at, out + count) || (*at && !strchr(SEPARATORS, *at))) {
            char expected[48];
            snprintf(expected, sizeof expected, "a list of at most %zu finite numbers", most);
            need(false, n, attribute, expected);
        }
    }
    return count;
}

bool koksma__mitsuba_flag(const node *n)
{
    const char *value = koksma__xml_attribute(n, "value");
    const bool is_set = value && !strcasecmp(value, "true");
    need(is_set || (value && !strcasecmp(value, "false")), n, "value", "true or false");
    return is_set;
}

void koksma__mitsuba_triple(const node *n, double otherwise, double out[3])
{
    static const char *const names[] = {"x", "y", "z"};
    const size_t count = numbers_of(n, "value", 3, out);
    const bool given = koksma__xml_attribute(n, "value") != NULL;
    need(!given || count == 1 || count == 3, n, "value", "one number or three");
    for (size_t k = 0; k < 3; k++) {
        if (!given) {
            out[k] = !isfinite(otherwise) || koksma__xml_attribute(n, names[k]) ? koksma__mitsuba_number(n, names[k])
                                                                                : otherwise;
        } else if (k >= count) {
            out[k] = out[0];
        }
    }
}

/* ---- Colours ----------------------------------------------------------------------------------------------- */

static void read_hexadecimal(const node *n, const char *digits, double rgb[3])
{
    need(strspn(digits, "0123456789abcdefABCDEF") == 6 && !digits[6], n, "value",
         "a colour: # and six hexadecimal digits");
    const unsigned long levels = strtoul(digits, NULL, 16);
    for (int k = 0; k < 3; k++) {
        const double level = (double)(levels >> (16 - 8 * k) & 255) / 255;
        rgb[k] = level <= 0.04045 ? level / 12.92 : koksma__pow((level + 0.055) / 1.055, 2.4);
    }
}

static void add_sample(koksma__text_place place, double wavelength, double value, koksma__sampled_spectrum *to)
{
    koksma__import_fail_if(!koksma__sampled_spectrum_add(to, wavelength, value), place,
                           "wavelengths of a spectrum must increase");
}

static void read_pairs(const node *n, const char *at, koksma__sampled_spectrum *out)
{
    for (at += strspn(at, SEPARATORS); *at; at += strspn(at, SEPARATORS)) {
        double pair[2];
        bool found = take_number(&at, pair) && *at == ':';
        at += found;
        at += strspn(at, BLANKS);
        found = found && take_number(&at, pair + 1) && (!*at || strchr(SEPARATORS, *at));
        need(found, n, "value", "a spectrum: one finite number, or pairs 'WAVELENGTH:VALUE, ...'");
        add_sample(n->place, pair[0], pair[1], out);
    }
}

koksma__mitsuba_colour koksma__mitsuba_colour_read(const node *n)
{
    const char *value = koksma__xml_attribute(n, "value");
    const bool is_number = koksma__mitsuba_is_number(n), is_spectrum = koksma__mitsuba_is(n, "spectrum");
    koksma__mitsuba_colour out = {.form = KOKSMA__NO_COLOUR};
    if (koksma__mitsuba_is(n, "blackbody")) { /* earlier versions of Mitsuba let a temperature end in K */
        const char *text = koksma__xml_attribute(n, "temperature");
        double kelvins = 0;
        need(text && koksma__mitsuba_measure(text, "K", &kelvins) && kelvins > 0, n, "temperature",
             "a temperature in kelvins");
        out.form = KOKSMA__BLACK_BODY;
        koksma__black_body_colour(kelvins, out.rgb);
    } else if (value && *value == '#' && !is_number) {
        out.form = KOKSMA__THREE_NUMBERS;
        read_hexadecimal(n, value + 1, out.rgb);
    } else if (value && strchr(value, ':') && is_spectrum) {
        out.form = KOKSMA__PAIRS;
        read_pairs(n, value, &out.pairs);
    } else if (value || !is_spectrum || !koksma__xml_attribute(n, "filename")) {
        const size_t count = is_number ? 1 : numbers_of(n, "value", 3, out.rgb);
        out.rgb[0] = is_number ? koksma__mitsuba_number(n, "value") : out.rgb[0];
        need(count == 1 || count == 3, n, "value", "one number or three");
        out.form = count == 1 ? KOKSMA__ONE_NUMBER : KOKSMA__THREE_NUMBERS;
        out.rgb[1] = out.rgb[count == 1 ? 0 : 1];
        out.rgb[2] = out.rgb[count == 1 ? 0 : 2];
    }
    return out;
}

/* How many words a list has. */
static size_t words(const char *at)
{
    size_t n = 0;
    for (at += strspn(at, SEPARATORS); *at; at += strspn(at, SEPARATORS)) {
        at += strcspn(at, SEPARATORS);
        n++;
    }
    return n;
}

/* Reads the next number of a list. */
static bool take_item(const char **at, double *out)
{
    *at += strspn(*at, SEPARATORS);
    return take_number(at, out) && (!**at || strchr(SEPARATORS, **at));
}

koksma__sampled_spectrum koksma__mitsuba_samples(const node *values, const node *wavelengths, double from, double to)
{
    koksma__sampled_spectrum out = {0};
    const char *at = koksma__xml_attribute(values, "value");
    const char *where = wavelengths ? koksma__xml_attribute(wavelengths, "value") : "";
    const size_t n = at ? words(at) : 0, n_where = where ? words(where) : 0;
    need(n >= 2, values, "value", "a list of two numbers or more");
    koksma__import_fail_if(wavelengths && n_where != n, values->place, "%zu values of a spectrum for %zu wavelengths",
                           n, n_where);
    for (size_t i = 0; i < n; i++) {
        double value, wavelength = from + (to - from) * (double)i / (double)(n - 1);
        need(take_item(&at, &value), values, "value", "a list of numbers");
        need(!wavelengths || take_item(&where, &wavelength), wavelengths, "value", "a list of numbers");
        add_sample(values->place, wavelength, value, &out);
    }
    return out;
}

bool koksma__mitsuba_is_number(const node *n)
{
    return koksma__mitsuba_is(n, "float") || koksma__mitsuba_is(n, "integer");
}

bool koksma__mitsuba_is_colour(const node *n)
{
    static const char tags[] = "float integer rgb srgb color spectrum blackbody";
    return koksma__lists(tags, sizeof tags - 1, ' ', n->tag);
}

/* ---- Transforms -------------------------------------------------------------------------------------------- */

static void look_at(const node *n, double m[12])
{
    static const char *const names[] = {"origin", "target", "up"};
    double v[3][3] = {{0}, {0}, {0, 1, 0}};
    for (int i = 0; i < 3; i++) {
        const size_t count = numbers_of(n, names[i], 3, v[i]);
        need(count == 3 || (i == 2 && !koksma__xml_attribute(n, names[i])), n, names[i], "three numbers");
    }
    koksma__import_look_at(n->place, "lookat", v[0], v[1], v[2], m);
}

static void matrix(const node *n, double m[12])
{
    double v[16];
    const size_t given = numbers_of(n, "value", 16, v);
    koksma__import_fail_if(given != 16 && given != 9, n->place, "matrix: %zu numbers; it has 16 or 9", given);
    /* Mitsuba ignores the last row, so that another one can't mean what it says */
    for (int i = 12; given == 16 && i < 16; i++) {
        koksma__import_fail_if(!(fabs(v[i] - (i == 15)) <= 1e-6), n->place,
                               "matrix: its last row is %g %g %g %g; it must be 0 0 0 1", v[12], v[13], v[14], v[15]);
    }
    for (int i = 0; i < 12; i++) {
        m[i] = given == 16 ? v[i] : i % 4 < 3 ? v[i / 4 * 3 + i % 4] : 0;
    }
}

void koksma__mitsuba_operation(const node *n, double m[12])
{
    const bool scales = koksma__mitsuba_is(n, "scale"), turns = koksma__mitsuba_is(n, "rotate");
    double v[3];
    memcpy(m, koksma__import_identity, sizeof koksma__import_identity);
    if (koksma__mitsuba_is(n, "lookat")) {
        look_at(n, m);
        return;
    }
    if (koksma__mitsuba_is(n, "matrix")) {
        matrix(n, m);
        return;
    }
    koksma__import_fail_if(!scales && !turns && !koksma__mitsuba_is(n, "translate"), n->place,
                           "transform '%s' is not supported", n->tag);
    koksma__mitsuba_triple(n, scales, v);
    koksma__import_fail_if(turns && !koksma__import_rotation(koksma__mitsuba_number(n, "angle"), v, m), n->place,
                           "rotate: the axis has no direction");
    for (int k = 0; k < 3 && !turns; k++) {
        m[scales ? 5 * k : 4 * k + 3] = v[k];
    }
}

/* ---- The whole file ---------------------------------------------------------------------------------------- */

/* Checks an element that has a value; a transform's operations are its children. */
static void check(const koksma__xml *xml, const node *n)
{
    static const char objects[] =
        "sensor shape bsdf emitter texture film integrator sampler phase medium volume rfilter";
    double v[12];
    koksma__import_fail_if(koksma__lists(objects, sizeof objects - 1, ' ', n->tag) &&
                               !koksma__xml_attribute(n, "type"),
                           n->place, "%s: no type", n->tag);
    if (koksma__mitsuba_is(n, "spectrum") && koksma__xml_attribute(n, "type")) { /* its values are its children */
        koksma__import_fail_if(koksma__xml_attribute(n, "value") || koksma__xml_attribute(n, "filename"), n->place,
                               "a spectrum with a 'type' has its values inside, not in 'value' or 'filename'");
    } else if (koksma__mitsuba_is(n, "transform")) {
        for (int c = n->first; c >= 0; c = xml->nodes[c].next) {
            koksma__mitsuba_operation(&xml->nodes[c], v);
        }
    } else if (koksma__mitsuba_is_colour(n)) {
        koksma__mitsuba_colour_read(n);
    } else if (koksma__mitsuba_is(n, "boolean")) {
        koksma__mitsuba_flag(n);
    } else if (koksma__mitsuba_is(n, "point") || koksma__mitsuba_is(n, "vector")) {
        koksma__mitsuba_triple(n, (double)INFINITY, v);
    } else if (koksma__mitsuba_is(n, "string")) {
        need(koksma__xml_attribute(n, "value"), n, "value", "a text");
    }
}

void koksma__mitsuba_check(const koksma__xml *xml)
{
    for (size_t i = 0; i < xml->n; i++) {
        check(xml, &xml->nodes[i]);
    }
}
