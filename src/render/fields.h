/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fields of scene files that materials, lights and shapes declare instead of parsing them. A kind lists its
 * parameters with type, range and destination (koksma__parameter). koksma__parse_fields() reads the parameters, and
 * error messages, `koksma list`, the documents and the tests take names and ranges from this list.
 */
#ifndef KOKSMA_RENDER_FIELDS_H
#define KOKSMA_RENDER_FIELDS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <koksma/render.h>

#include "core/files.h"
#include "core/status.h"
#include "json/json.h"

#define FAR 1e6    /* largest coordinates and lengths */
#define TINY 1e-6  /* lengths up to this count as zero */
#define BRIGHT 1e6 /* luminance */
#define TURN (2 * M_PI)

#define KEYS(...) ((const char *const[]){__VA_ARGS__, NULL})

typedef koksma__json_node field;

typedef enum koksma__parameter_type {
    KOKSMA__NUMBER,    /* a number between low and high; one double */
    KOKSMA__COLOUR,    /* one number (grey) or red, green and blue, each 0 to high; 3 doubles */
    KOKSMA__POINT,     /* coordinates from -1e6 to 1e6; 3 doubles */
    KOKSMA__DIRECTION, /* coordinates from -1e6 to 1e6, normalised to a unit vector; 3 doubles */
    KOKSMA__FLAG,      /* true or false; a bool */
    KOKSMA__RADIUS,    /* a radius above 1e-6, stored in each of 2 doubles */
    KOKSMA__HALF       /* two half sides, both above 1e-6; 2 doubles */
} koksma__parameter_type;

typedef struct koksma__parameter {
    const char *name;
    koksma__parameter_type type;
    bool optional; /* the field may be missing; all its numbers are then `fallback` */
    double low, high;
    double fallback;
    size_t at; /* offset of the destination in koksma__material, koksma__light or koksma__shape */
} koksma__parameter;

/* The members that kinds of materials, lights and shapes have in common. */
typedef struct koksma__kind {
    const char *name;                    /* in scene files */
    const char *title;                   /* one line of description for lists */
    const char *cite;                    /* keys of docs/references.bib, or "-" */
    const koksma__parameter *parameters; /* the last entry has a NULL name; NULL: none */
    /* names of further fields, which the kind's own code reads; the list ends with NULL. NULL: no further fields */
    const char *const *keys;
    const char *example; /* an example of the fields `keys` as JSON, for tests; NULL: none are required */
    /* scene files cannot name this kind: another part of the scene creates it */
    bool is_implied;
} koksma__kind;

/* Fails if `object` has fields that are neither in `common` (ended by NULL) nor fields of the kind; otherwise reads
   the kind's parameters into `to`. Errors: MALFORMED. */
koksma_status koksma__parse_fields(const field *object, const koksma__kind *kind, const char *const *common,
                                   void *to);

/* The index of the kind that the field "kind" names; the array kinds ends at NULL. The error message lists the known
   kinds. */
koksma_status koksma__parse_kind(const field *object, const koksma__kind *const *kinds, size_t *out);

/* Returns text for the end of an error message: which Debian package contains a missing file, or "" if none is
   known. */
const char *koksma__package_hint(const char *path);

/* Reads the image in the file `path`, which the scene file `name` mentions; NULL on failure, with a message that
   names the field f. */
koksma_status koksma__parse_image(koksma_scene *scene, const char *name, const field *f, const char *path,
                                  koksma_image **out);

koksma_status koksma__parse_point(const field *object, const char *key, double out[3]);
koksma_status koksma__parse_direction(const field *object, const char *key, double out[3]);

/* Reads a number (grey) or an array of red, green and blue. A missing field leaves the destination unchanged, unless
   needed is true. */
koksma_status koksma__parse_colour(const field *object, const char *key, bool needed, double max, double out[3]);
koksma_status koksma__parse_colour_value(const field *node, double max, double out[3]);

/* The axes of a flat shape from its normal and the field "up" (default: y; -z for a normal along y). axis_v is "up"
   made perpendicular to the normal, and axis_u = axis_v x normal: to a viewer who faces the front, u points right. A
   floor has u = x, v = -z. */
koksma_status koksma__parse_axes(const field *object, const double normal[3], double axis_u[3], double axis_v[3]);

#endif
