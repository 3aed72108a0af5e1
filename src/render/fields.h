/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Fields of scene files that materials, lights and shapes declare instead of parsing them. A kind of any of the three
 * lists its parameters with type, range and destination (koksma__parameter); koksma__parse_fields() reads them, and
 * error messages, `koksma list`, the documents and the tests of all kinds take names and ranges from the same list.
 */
#ifndef KOKSMA_RENDER_FIELDS_H
#define KOKSMA_RENDER_FIELDS_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include <koksma/render.h>

#include "core/read_file.h"
#include "core/status.h"
#include "json/json.h"

#define FAR 1e6    /* coordinates and lengths */
#define TINY 1e-6  /* lengths that count as zero */
#define BRIGHT 1e6 /* luminance */
#define TURN (2 * M_PI)

#define KEYS(...) ((const char *const[]){__VA_ARGS__, NULL})

typedef koksma__json_node field;

typedef enum koksma__parameter_type {
    KOKSMA__NUMBER,    /* low to high; written to one double */
    KOKSMA__COLOUR,    /* one number (grey) or red, green and blue, each 0 to high; 3 doubles */
    KOKSMA__POINT,     /* coordinates within 1e6; 3 doubles */
    KOKSMA__DIRECTION, /* likewise, made a unit vector */
    KOKSMA__FLAG,      /* true or false; a bool */
    KOKSMA__RADIUS,    /* above 1e-6; 2 doubles, equal */
    KOKSMA__HALF       /* half sides, both above 1e-6; 2 doubles */
} koksma__parameter_type;

typedef struct koksma__parameter {
    const char *name;
    koksma__parameter_type type;
    bool optional; /* the field may be absent; all numbers are `fallback` then */
    double low, high;
    double fallback;
    size_t at; /* offset of the destination in koksma__material, koksma__light or koksma__shape */
} koksma__parameter;

/* What the kinds of materials, lights and shapes have in common. */
typedef struct koksma__kind {
    const char *name;                    /* in scene files */
    const char *title;                   /* one line for lists */
    const char *cite;                    /* keys of docs/references.bib, or "-" */
    const koksma__parameter *parameters; /* ends at a NULL name; NULL: none */
    const char *const *keys;             /* further fields, which the kind's own code reads; ends at NULL, or NULL */
    const char *example;                 /* such fields as JSON, for tests; NULL: none are needed */
    bool is_implied;                     /* no "kind" in a file names it: another part of the scene makes it */
} koksma__kind;

/* Fails unless `object` has no other fields than `common` (ends at NULL) and the kind's; then reads the kind's
   parameters into `to`. Errors: MALFORMED. */
koksma_status koksma__parse_fields(const field *object, const koksma__kind *kind, const char *const *common,
                                   void *to);

/* The index of the kind that the field "kind" names; kinds ends at NULL. The error lists the known ones. */
koksma_status koksma__parse_kind(const field *object, const koksma__kind *const *kinds, size_t *out);

/* Which package has a file that is missing, for the end of an error; "" if none is known. */
const char *koksma__package_hint(const char *path);

/* The image in the file `path`, which the scene file `name` names; NULL on failure, whose message names f. */
koksma_status koksma__parse_image(const char *name, const field *f, const char *path, koksma_image **out);

koksma_status koksma__parse_point(const field *object, const char *key, double out[3]);
koksma_status koksma__parse_direction(const field *object, const char *key, double out[3]);

/* A number (grey) or an array of red, green and blue; left alone when it is not there and needed is false. */
koksma_status koksma__parse_colour(const field *object, const char *key, bool needed, double max, double out[3]);
koksma_status koksma__parse_colour_value(const field *node, double max, double out[3]);

/* The axes of a flat shape from its normal and "up" (default: y; -z for a normal along y). axis_v is up made square
   to the normal and axis_u = axis_v x normal: seen against the normal u goes right. A floor has u = x, v = -z. */
koksma_status koksma__parse_axes(const field *object, const double normal[3], double axis_u[3], double axis_v[3]);

#endif
