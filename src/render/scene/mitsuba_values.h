/* SPDX-License-Identifier: Apache-2.0 */
/* The values of Mitsuba's elements: numbers, lists of numbers, flags, points, colours and transforms as text. */
#ifndef KOKSMA_SCENE_MITSUBA_VALUES_H
#define KOKSMA_SCENE_MITSUBA_VALUES_H

#include "scene/import_spectrum.h"
#include "scene/xml.h"

/* All functions fail with MALFORMED and a text that names the file, the line, the element and the value, unless the
   value has the whole form that is described here. */

/* One finite number, with blanks around it; hexadecimal numbers are none. */
koksma_status koksma__mitsuba_number(const koksma__xml_node *n, const char *attribute, double *out);

/* One number, perhaps with this unit behind it; returns false for another text. */
bool koksma__mitsuba_measure(const char *text, const char *unit, double *out);

/* From 0 to `most` numbers, separated by blanks or commas; *count is 0 if the attribute is missing. */
koksma_status koksma__mitsuba_numbers(const koksma__xml_node *n, const char *attribute, size_t most, double *out,
                                      size_t *count);

/* "true" or "false", in upper or lower case. */
koksma_status koksma__mitsuba_flag(const koksma__xml_node *n, bool *out);

/* The attributes x, y and z, each one number, or `value`: three numbers, or one for all three. Of x, y and z all must
   be given, unless `otherwise`, the value of the missing ones, is finite. */
koksma_status koksma__mitsuba_triple(const koksma__xml_node *n, double otherwise, double out[3]);

/* A colour: the attribute `value` with one number, three numbers, "#" and six hexadecimal digits (levels of sRGB), or
   pairs "WAVELENGTH:VALUE, ..." with increasing wavelengths; a black body's temperature in kelvins. */
typedef struct koksma__mitsuba_colour {
    enum { KOKSMA__NO_COLOUR, KOKSMA__ONE_NUMBER, KOKSMA__THREE_NUMBERS, KOKSMA__PAIRS, KOKSMA__BLACK_BODY } form;
    double rgb[3]; /* of one number: three times that; of a black body: its colour */
    koksma__sampled_spectrum pairs;
} koksma__mitsuba_colour;

/* The form is KOKSMA__NO_COLOUR for a spectrum that is in another file. */
koksma_status koksma__mitsuba_colour_read(const koksma__xml_node *n, koksma__mitsuba_colour *out);

/* Samples of a spectrum, two at least: numbers in the `value` of one element, at the increasing wavelengths in that of
   another, or, if that is NULL, at equal distances between two. */
koksma_status koksma__mitsuba_samples(const koksma__xml_node *values, const koksma__xml_node *wavelengths,
                                      double from, double to, koksma__sampled_spectrum *out);

/* Whether the element is of a kind that stands for a number or for a colour. */
bool koksma__mitsuba_is_number(const koksma__xml_node *n);
bool koksma__mitsuba_is_colour(const koksma__xml_node *n);

/* The matrix of an operation in a transform: translate, scale, rotate, lookat, matrix. The last row of a matrix of 16
   numbers must be 0 0 0 1. */
koksma_status koksma__mitsuba_operation(const koksma__xml_node *n, double m[12]);

/* Checks the values of all elements, also of those that nothing reads. */
koksma_status koksma__mitsuba_check(const koksma__xml *xml);

#endif
