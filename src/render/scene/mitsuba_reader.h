/* SPDX-License-Identifier: Apache-2.0 */
/* The parts of the reader of Mitsuba's scenes: an XML text as a tree of elements, with included files inserted and $names
   replaced (xml.c), the values of elements (mitsuba_values.c), and the objects (mitsuba.c). */
#ifndef KOKSMA_SCENE_MITSUBA_READER_H
#define KOKSMA_SCENE_MITSUBA_READER_H

#include "scene/import.h"

/* Reads a scene of Mitsuba 3 into an empty scene. Errors: MISSING, MALFORMED, MEMORY; UNSUPPORTED (this build
   lacks expat). */
koksma_status koksma__mitsuba_read(koksma__import *im, const char *text, size_t size);

/* ---- The table of plug-ins ------------------------------------------------------------------------------------------- */

/* What is made of BSDFs beside the kinds of koksma__import_material; of textures and spectra; of emitters. */
enum { KOKSMA__PRINCIPLED = KOKSMA__NOTHING + 1, KOKSMA__MASK, KOKSMA__BLEND, KOKSMA__WITHIN };
enum {
    KOKSMA__BITMAP,
    KOKSMA__CHECKERBOARD,
    KOKSMA__D65,
    KOKSMA__UNIFORM,
    KOKSMA__SRGB,
    KOKSMA__REGULAR,
    KOKSMA__IRREGULAR,
    KOKSMA__TEMPERATURE
};
enum { KOKSMA__POINT_LIGHT, KOKSMA__SPOT, KOKSMA__FAR_LIGHT, KOKSMA__SKY, KOKSMA__PICTURE };

extern const koksma__plugins koksma__mitsuba_plugins;

/* Finds eta and k of a conductor in the RGB variants of Mitsuba, or an index of refraction, by the material's name. */
bool koksma__mitsuba_conductor(const char *name, double eta[3], double k[3]);
bool koksma__mitsuba_index(const char *name, double *out);

/* ---- XML ------------------------------------------------------------------------------------------------------------- */

/* Marks of an element: TAKEN: a reader has taken it for what its parent may contain; COVERED: a warning says already what
   becomes of all that it contains. */
enum { KOKSMA__XML_TAKEN = 1, KOKSMA__XML_COVERED = 2 };

typedef struct koksma__xml_node {
    const char *tag;
    char **
        attributes; /* names and values in turn, ended by NULL; their texts, the tag and `marks` are in the same block */
    unsigned char *marks; /* those of the element; then, for each attribute, whether it was looked up */
    koksma__text_place place;
    size_t length;         /* characters of the attributes */
    int first, last, next; /* first and last child; next child of the same parent; -1: none */
} koksma__xml_node;

typedef struct koksma__xml {
    koksma__xml_node *nodes; /* the first node is the root */
    char **defaults;         /* values of the $names */
    koksma__names default_names;
    size_t n, n_defaults;
} koksma__xml;

/* Parses an XML text. Errors: MALFORMED (not well-formed; a document type declaration, whose entities could grow
   without limit; nested too deep; too many elements; more text made from $names than import_text.h allows),
   UNSUPPORTED (this build lacks expat), MEMORY. Call koksma__xml_fini even after an error. */
void koksma__xml_read(koksma__import *im, const char *text, size_t size, koksma__xml *out);
void koksma__xml_fini(koksma__xml *xml);

/* The value of an attribute, which is marked as looked up; NULL if the node does not have it. */
const char *koksma__xml_attribute(const koksma__xml_node *node, const char *name);

/* Marks a node. */
static inline void koksma__xml_mark(const koksma__xml_node *node, unsigned char marks)
{
    node->marks[0] |= marks;
}

/* Writes what may be meant by an element of `parent` that no reader has taken, as koksma__or_meant(). */
typedef const char *koksma__xml_meant(const void *context, const koksma__xml_node *parent, const koksma__xml_node *n,
                                      char *text);

/* Warns about each element that no reader has taken, and each attribute that none has looked up, in the whole tree but for
   what is covered. */
void koksma__xml_name_unread(koksma__import *im, const koksma__xml *xml, koksma__xml_meant *meant,
                             const void *context);

/* Whether a text has this name of `length` bytes, as it is or in the form of Mitsuba 0.6: a capital is in place of '_'
   (toWorld, intIOR). */
bool koksma__xml_alike(const char *text, const char *name, size_t length);

/* ---- Values ---------------------------------------------------------------------------------------------------------- */

/* All functions fail with a text that names the file, the line, the element and the value, unless the value has the whole
   form that is described here. */

/* One finite number, with blanks around it; hexadecimal numbers are none. */
double koksma__mitsuba_number(const koksma__xml_node *n, const char *attribute);

/* One number, perhaps with this unit behind it; returns false for another text. */
bool koksma__mitsuba_measure(const char *text, const char *unit, double *out);

/* "true" or "false", in upper or lower case. */
bool koksma__mitsuba_flag(const koksma__xml_node *n);

/* The attributes x, y and z, each one number, or `value`: three numbers, or one for all three. Of x, y and z all must
   be given, unless `otherwise`, the value of the missing ones, is finite. */
void koksma__mitsuba_triple(const koksma__xml_node *n, double otherwise, double out[3]);

/* A colour: the attribute `value` with one number, three numbers, "#" and six hexadecimal digits (levels of sRGB), or
   pairs "WAVELENGTH:VALUE, ..." with increasing wavelengths; a black body's temperature in kelvins. */
typedef struct koksma__mitsuba_colour {
    enum { KOKSMA__NO_COLOUR, KOKSMA__ONE_NUMBER, KOKSMA__THREE_NUMBERS, KOKSMA__PAIRS, KOKSMA__BLACK_BODY } form;
    double rgb[3]; /* of one number: three times that; of a black body: its colour */
    koksma__sampled_spectrum pairs;
} koksma__mitsuba_colour;

/* The form is KOKSMA__NO_COLOUR for a spectrum that is in another file. */
koksma__mitsuba_colour koksma__mitsuba_colour_read(const koksma__xml_node *n);

/* Samples of a spectrum, two at least: numbers in the `value` of one element, at the increasing wavelengths in that of
   another, or, if that is NULL, at equal distances between two. */
koksma__sampled_spectrum koksma__mitsuba_samples(const koksma__xml_node *values, const koksma__xml_node *wavelengths,
                                                 double from, double to);

/* Whether the element has this tag. */
bool koksma__mitsuba_is(const koksma__xml_node *n, const char *tag);

/* Whether the element is of a kind that stands for a number or for a colour. */
bool koksma__mitsuba_is_number(const koksma__xml_node *n);
bool koksma__mitsuba_is_colour(const koksma__xml_node *n);

/* The matrix of an operation in a transform: translate, scale, rotate, lookat, matrix. The last row of a matrix of 16
   numbers must be 0 0 0 1. */
void koksma__mitsuba_operation(const koksma__xml_node *n, double m[12]);

/* Checks the values of all elements, also of those that nothing reads. */
void koksma__mitsuba_check(const koksma__xml *xml);

#endif
