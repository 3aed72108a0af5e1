/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the values of Mitsuba's elements. Each syntax has one function, which refuses a value that it does not
 * understand to its end: a value that is read in part would change the scene without a word. Mitsuba 3 itself is as
 * strict in nearly everything; what earlier versions wrote is read, too: "5000K" and "#ff8000".
 */
#include "scene/mitsuba.h"

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

static bool is(const node *n, const char *tag)
{
    return !strcasecmp(n->tag, tag); /* lookAt was the name in Mitsuba 0.6 */
}

/* Fails with "FILE:LINE: NAME: 'VALUE' is not EXPECTED"; the name is that of the property or the element, and of the
   attribute if that has another name than "value". */
static koksma_status wrong(const node *n, const char *attribute, const char *expected)
{
    const char *name = koksma__xml_attribute(n, "name"), *value = koksma__xml_attribute(n, attribute);
    const char *key = strcmp(attribute, "value") != 0 ? attribute : "";
    name = name ? name : n->tag;
    return value ? koksma__import_fail(n->place, "%s%s%s: '%.60s' is not %s", name, *key ? " " : "", key, value,
                                       expected)
                 : koksma__import_fail(n->place, "%s: no '%s', which is %s", name, attribute, expected);
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

koksma_status koksma__mitsuba_number(const node *n, const char *attribute, double *out)
{
    const char *value = koksma__xml_attribute(n, attribute);
    const bool whole = is(n, "integer");
    *out = 0;
    return value && koksma__mitsuba_measure(value, "", out) && (!whole || *out == floor(*out))
               ? KOKSMA_OK
               : wrong(n, attribute,
                       whole            ? "a whole number"
                       : isfinite(*out) ? "a number"
                                        : "a finite number");
}

/* From 0 to `most` numbers, separated by blanks or commas; *count is 0 if the attribute is missing. */
static koksma_status numbers_of(const node *n, const char *attribute, size_t most, double *out, size_t *count)
{
    const char *at = koksma__xml_attribute(n, attribute);
    *count = 0;
    if (!at) {
        return KOKSMA_OK;
    }
    for (at += strspn(at, SEPARATORS); *at; at += strspn(at, SEPARATORS)) {
        if (*count == most || !take_number(&at, out + *count) || (*at && !strchr(SEPARATORS, *at))) {
            char expected[48];
            snprintf(expected, sizeof expected, "a list of at most %zu finite numbers", most);
            return wrong(n, attribute, expected);
        }
        ++*count;
    }
    return KOKSMA_OK;
}

koksma_status koksma__mitsuba_flag(const node *n, bool *out)
{
    const char *value = koksma__xml_attribute(n, "value");
    *out = value && !strcasecmp(value, "true");
    return value && (*out || !strcasecmp(value, "false")) ? KOKSMA_OK : wrong(n, "value", "true or false");
}

koksma_status koksma__mitsuba_triple(const node *n, double otherwise, double out[3])
{
    static const char *const names[] = {"x", "y", "z"};
    size_t count;
    KOKSMA__TRY(numbers_of(n, "value", 3, out, &count));
    if (koksma__xml_attribute(n, "value")) {
        for (size_t k = count; k < 3; k++) {
            out[k] = out[0];
        }
        return count == 1 || count == 3 ? KOKSMA_OK : wrong(n, "value", "one number or three");
    }
    for (size_t k = 0; k < 3; k++) {
        out[k] = otherwise;
        if (!isfinite(otherwise) || koksma__xml_attribute(n, names[k])) {
            KOKSMA__TRY(koksma__mitsuba_number(n, names[k], out + k));
        }
    }
    return KOKSMA_OK;
}

/* ---- Colours ----------------------------------------------------------------------------------------------- */

static koksma_status read_hexadecimal(const node *n, const char *digits, double rgb[3])
{
    if (strspn(digits, "0123456789abcdefABCDEF") != 6 || digits[6]) {
        return wrong(n, "value", "a colour: # and six hexadecimal digits");
    }
    const unsigned long levels = strtoul(digits, NULL, 16);
    for (int k = 0; k < 3; k++) {
        const double level = (double)(levels >> (16 - 8 * k) & 255) / 255;
        rgb[k] = level <= 0.04045 ? level / 12.92 : koksma__pow((level + 0.055) / 1.055, 2.4);
    }
    return KOKSMA_OK;
}

static koksma_status read_pairs(const node *n, const char *at, koksma__sampled_spectrum *out)
{
    for (at += strspn(at, SEPARATORS); *at; at += strspn(at, SEPARATORS)) {
        double pair[2];
        bool found = take_number(&at, pair) && *at == ':';
        at += found;
        at += strspn(at, BLANKS);
        found = found && take_number(&at, pair + 1) && (!*at || strchr(SEPARATORS, *at));
        if (!found) {
            return wrong(n, "value", "a spectrum: one finite number, or pairs 'WAVELENGTH:VALUE, ...'");
        }
        if (!koksma__sampled_spectrum_add(out, pair[0], pair[1])) {
            return koksma__import_fail(n->place, "wavelengths of a spectrum must increase");
        }
    }
    return KOKSMA_OK;
}

/* Earlier versions of Mitsuba let a temperature end in K. */
static koksma_status read_black_body(const node *n, double rgb[3])
{
    const char *value = koksma__xml_attribute(n, "temperature");
    double kelvins;
    if (!value || !koksma__mitsuba_measure(value, "K", &kelvins) || !(kelvins > 0)) {
        return wrong(n, "temperature", "a temperature in kelvins");
    }
    koksma__import_black_body(kelvins, rgb);
    return KOKSMA_OK;
}

koksma_status koksma__mitsuba_colour_read(const node *n, koksma__mitsuba_colour *out)
{
    const char *value = koksma__xml_attribute(n, "value");
    size_t count;
    *out = (koksma__mitsuba_colour){.form = KOKSMA__NO_COLOUR};
    if (is(n, "blackbody")) {
        out->form = KOKSMA__BLACK_BODY;
        return read_black_body(n, out->rgb);
    }
    if (!value && is(n, "spectrum") && koksma__xml_attribute(n, "filename")) {
        return KOKSMA_OK;
    }
    if (value && *value == '#' && !koksma__mitsuba_is_number(n)) {
        out->form = KOKSMA__THREE_NUMBERS;
        return read_hexadecimal(n, value + 1, out->rgb);
    }
    if (value && strchr(value, ':') && is(n, "spectrum")) {
        out->form = KOKSMA__PAIRS;
        return read_pairs(n, value, &out->pairs);
    }
    if (koksma__mitsuba_is_number(n)) {
        count = 1;
        KOKSMA__TRY(koksma__mitsuba_number(n, "value", out->rgb));
    } else {
        KOKSMA__TRY(numbers_of(n, "value", 3, out->rgb, &count));
    }
    if (count != 1 && count != 3) {
        return wrong(n, "value", "one number or three");
    }
    out->form = count == 1 ? KOKSMA__ONE_NUMBER : KOKSMA__THREE_NUMBERS;
    out->rgb[1] = out->rgb[count == 1 ? 0 : 1];
    out->rgb[2] = out->rgb[count == 1 ? 0 : 2];
    return KOKSMA_OK;
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

koksma_status koksma__mitsuba_samples(const node *values, const node *wavelengths, double from, double to,
                                      koksma__sampled_spectrum *out)
{
    const char *at = koksma__xml_attribute(values, "value");
    const char *where = wavelengths ? koksma__xml_attribute(wavelengths, "value") : "";
    const size_t n = at ? words(at) : 0, n_where = where ? words(where) : 0;
    if (n < 2) {
        return wrong(values, "value", "a list of two numbers or more");
    }
    if (wavelengths && n_where != n) {
        return koksma__import_fail(values->place, "%zu values of a spectrum for %zu wavelengths", n, n_where);
    }
    for (size_t i = 0; i < n; i++) {
        double value, wavelength = from + (to - from) * (double)i / (double)(n - 1);
        if (!take_item(&at, &value)) {
            return wrong(values, "value", "a list of numbers");
        }
        if (wavelengths && !take_item(&where, &wavelength)) {
            return wrong(wavelengths, "value", "a list of numbers");
        }
        if (!koksma__sampled_spectrum_add(out, wavelength, value)) {
            return koksma__import_fail(values->place, "wavelengths of a spectrum must increase");
        }
    }
    return KOKSMA_OK;
}

bool koksma__mitsuba_is_number(const node *n)
{
    return is(n, "float") || is(n, "integer");
}

bool koksma__mitsuba_is_colour(const node *n)
{
    static const char tags[] = "float integer rgb srgb color spectrum blackbody";
    return koksma__lists(tags, sizeof tags - 1, ' ', n->tag);
}

/* ---- Transforms -------------------------------------------------------------------------------------------- */

/* Reads three numbers; `otherwise` if the attribute is missing, or an error if that is NULL. */
static koksma_status read_vector(const node *n, const char *attribute, const double *otherwise, double out[3])
{
    size_t count;
    KOKSMA__TRY(numbers_of(n, attribute, 3, out, &count));
    if (otherwise && !koksma__xml_attribute(n, attribute)) {
        memcpy(out, otherwise, 3 * sizeof *out);
        return KOKSMA_OK;
    }
    return count == 3 ? KOKSMA_OK : wrong(n, attribute, "three numbers");
}

static koksma_status look_at(const node *n, double m[12])
{
    double origin[3], target[3], up[3];
    KOKSMA__TRY(read_vector(n, "origin", NULL, origin));
    KOKSMA__TRY(read_vector(n, "target", NULL, target));
    KOKSMA__TRY(read_vector(n, "up", (const double[3]){0, 1, 0}, up));
    return koksma__import_look_at(n->place, "lookat", origin, target, up, m);
}

static koksma_status matrix(const node *n, double m[12])
{
    double v[16];
    size_t given;
    KOKSMA__TRY(numbers_of(n, "value", 16, v, &given));
    if (given != 16 && given != 9) {
        return koksma__import_fail(n->place, "matrix: %zu numbers; it has 16 or 9", given);
    }
    /* Mitsuba ignores the last row, so that another one can't mean what it says */
    for (int i = 12; given == 16 && i < 16; i++) {
        if (!(fabs(v[i] - (i == 15)) <= 1e-6)) {
            return koksma__import_fail(n->place, "matrix: its last row is %g %g %g %g; it must be 0 0 0 1", v[12],
                                       v[13], v[14], v[15]);
        }
    }
    for (int i = 0; i < 12; i++) {
        m[i] = given == 16 ? v[i] : i % 4 < 3 ? v[i / 4 * 3 + i % 4] : 0;
    }
    return KOKSMA_OK;
}

koksma_status koksma__mitsuba_operation(const node *n, double m[12])
{
    const bool scales = is(n, "scale");
    double v[3], angle;
    memcpy(m, koksma__import_identity, sizeof koksma__import_identity);
    if (is(n, "lookat")) {
        return look_at(n, m);
    }
    if (is(n, "matrix")) {
        return matrix(n, m);
    }
    if (!scales && !is(n, "translate") && !is(n, "rotate")) {
        return koksma__import_fail(n->place, "transform '%s' is not supported", n->tag);
    }
    KOKSMA__TRY(koksma__mitsuba_triple(n, scales, v));
    if (is(n, "rotate")) {
        KOKSMA__TRY(koksma__mitsuba_number(n, "angle", &angle));
        return koksma__import_rotation(angle, v, m)
                   ? KOKSMA_OK
                   : koksma__import_fail(n->place, "rotate: the axis has no direction");
    }
    for (int k = 0; k < 3; k++) {
        m[scales ? 5 * k : 4 * k + 3] = v[k];
    }
    return KOKSMA_OK;
}

/* ---- The whole file ---------------------------------------------------------------------------------------- */

/* Checks an element that has a value; a transform's operations are its children. */
static koksma_status check(const koksma__xml *xml, const node *n)
{
    static const char objects[] =
        "sensor shape bsdf emitter texture film integrator sampler phase medium volume rfilter";
    koksma__mitsuba_colour colour;
    double v[12];
    bool flag;
    if (koksma__lists(objects, sizeof objects - 1, ' ', n->tag) && !koksma__xml_attribute(n, "type")) {
        return koksma__import_fail(n->place, "%s: no type", n->tag);
    }
    if (is(n, "spectrum") && koksma__xml_attribute(n, "type")) { /* an object, whose values are its children */
        return koksma__xml_attribute(n, "value") || koksma__xml_attribute(n, "filename")
                   ? koksma__import_fail(
                         n->place, "a spectrum with a 'type' has its values inside, not in 'value' or 'filename'")
                   : KOKSMA_OK;
    }
    if (is(n, "transform")) {
        for (int c = n->first; c >= 0; c = xml->nodes[c].next) {
            KOKSMA__TRY(koksma__mitsuba_operation(&xml->nodes[c], v));
        }
        return KOKSMA_OK;
    }
    return koksma__mitsuba_is_colour(n)                            ? koksma__mitsuba_colour_read(n, &colour)
           : is(n, "boolean")                                      ? koksma__mitsuba_flag(n, &flag)
           : is(n, "point") || is(n, "vector")                     ? koksma__mitsuba_triple(n, (double)INFINITY, v)
           : is(n, "string") && !koksma__xml_attribute(n, "value") ? wrong(n, "value", "a text")
                                                                   : KOKSMA_OK;
}

koksma_status koksma__mitsuba_check(const koksma__xml *xml)
{
    for (size_t i = 0; i < xml->n; i++) {
        KOKSMA__TRY(check(xml, &xml->nodes[i]));
    }
    return KOKSMA_OK;
}
