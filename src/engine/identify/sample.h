/* SPDX-License-Identifier: Apache-2.0 */
/* What the files of koksma_identify share: the points under test, and the digital sequences with which they are
   compared. Each section is the interface of the file of its name. */
#ifndef KOKSMA_IDENTIFY_SAMPLE_H
#define KOKSMA_IDENTIFY_SAMPLE_H

#include <koksma/identify.h>

/* ---- Statements -------------------------------------------------------------------------------------------- */

typedef struct koksma__sample {
    koksma_points points; /* in [0,1], mapped if the file's were not */
    double tolerance;     /* how much a coordinate may differ from the one that it is compared with */
    const koksma_run *run;
    koksma_identities *found;
    double width, largest; /* of the box of the points in the file, which is mapped; the largest number in it */
    bool floats;           /* all numbers are floats, and may be rounded to them */
    double few_digits;     /* tolerance of so few decimals that only sequences as they are can be tested; 0: more */
    bool named;            /* a statement says where the points come from */
    int scramble;          /* the strongest relation to a sequence so far, of koksma__relation */
    size_t before;         /* number of statements before that one, which a stronger one replaces */
} koksma__sample;

/* Coordinate k of point i. */
static inline double koksma__x(const koksma__sample *s, size_t i, size_t k)
{
    return s->points.xs[i * (size_t)s->points.dim + k];
}

/* Adds a statement, whose detail is a format, and notes whether it names the points. Errors: MEMORY. */
koksma_status koksma__say(koksma__sample *s, const char *relation, const char *what, const char *spec, uint64_t first,
                          const char *detail, ...) KOKSMA_PRINTF(6, 7);

/* Returns the distance of a and b on the circle of circumference 1, signed: in [-1/2, 1/2]. */
double koksma__turn(double a);

/* Appends a formatted text to `text` of `size` bytes; what does not fit is cut and ends in "...". */
void koksma__append(char *text, size_t size, const char *format, ...) KOKSMA_PRINTF(3, 4);

/* ---- Numbers --------------------------------------------------------------------------------------------- */

enum { KOKSMA__PRECISIONS = 4 };

/* Maps the points to [0,1] in place if they are outside, and adds a statement of how. */
koksma_status koksma__map_to_cube(koksma__sample *s);

/* Lists the tolerances of the mapped points that are worth trying, the smallest first, from how `points`, which are not
   mapped, were rounded. Returns their number. */
int koksma__precisions(koksma__sample *s, const koksma_points *points, double tolerances[KOKSMA__PRECISIONS]);

/* ---- Sources --------------------------------------------------------------------------------------------- */

/* A digital sequence: coordinate j of point i has numerator / base^digits, whose digits are those of i, mapped. */
typedef struct koksma__source {
    const char *what, *spec;
    int kind, set, dims;
} koksma__source;

typedef struct koksma__coordinate {
    int digits;
    uint32_t base;
    double whole;                          /* base^digits */
    uint64_t powers[54];                   /* base^k */
    const uint32_t *directions;            /* base 2, with generator matrices */
    uint32_t own[32];                      /* where those are not in a table */
    uint32_t *matrix, *inverse;            /* other bases: entry [r][c] at r * digits + c */
    uint64_t pivots[32], combinations[32]; /* base 2: an echelon form of the columns, and the columns in each row */
} koksma__coordinate;

/* Returns source i of the table, or NULL past the last. */
const koksma__source *koksma__source_at(size_t i);

/* Returns how many coordinates a source has for points of dim dimensions. */
int koksma__source_dims(const koksma__source *source, int dim);

/* Prepares the first `count` coordinates of a source for points of dim dimensions. koksma__coordinates_fini frees them,
   also after an error. Errors: MEMORY. */
koksma_status koksma__coordinates_init(const koksma__source *source, int dim, int count, koksma__coordinate **out);
void koksma__coordinates_fini(koksma__coordinate *coordinates, int count);

/* Returns the numerator of point i. */
uint64_t koksma__numerator(const koksma__coordinate *c, uint64_t i);

/* Returns the index whose coordinate is within the tolerance of x, or UINT64_MAX if none is known to be. The caller
   compares koksma__numerator of it. */
uint64_t koksma__index_of(const koksma__coordinate *c, double x, double tolerance);

/* Returns i in the binary code of Gray, and the number whose Gray code is g. */
uint64_t koksma__gray(uint64_t i);
uint64_t koksma__from_gray(uint64_t g);

/* ---- The tests. Each adds statements, and leaves `named` set if one of them names the points --------------- */

koksma_status koksma__identify_plain(koksma__sample *s);       /* plain.c: sequences, in any order and part */
koksma_status koksma__identify_progression(koksma__sample *s); /* progression.c: lattices, recurrences, grids */
koksma_status koksma__identify_scrambled(koksma__sample *s); /* scrambled.c: sequences behind shifts and scrambling */
koksma_status koksma__identify_fixed(koksma__sample *s);     /* ours.c: patterns without random numbers */
koksma_status koksma__identify_seeded(koksma__sample *s);    /* ours.c: patterns with a seed */
koksma_status koksma__identify_structure(koksma__sample *s); /* structure.c: strata, without a source */

enum { KOKSMA__LEAST_SCRAMBLED = 16 }; /* fewer points are nested permutations of everything */

/* ---- Scramble -------------------------------------------------------------------------------------------- */

/* How one coordinate's digits arise from a sequence's, from the strongest relation to the weakest. */
typedef enum koksma__relation {
    KOKSMA__EQUAL,
    KOKSMA__SHIFTED,
    KOKSMA__DIGITAL_SHIFT,
    KOKSMA__DIGIT_PERMUTATION,
    KOKSMA__LINEAR,
    KOKSMA__NESTED,
    KOKSMA__NO_RELATION
} koksma__relation;

/* Finds the strongest relation between coordinate k of the sample and coordinate c of a sequence, of which point i of
   the sample is point indices[i]: with `digits` all but a shift modulo 1, else that or equality. Describes it in
   `text`, 120 bytes: the shift, the permutation, or nothing. Errors: MEMORY. */
koksma_status koksma__relate(const koksma__sample *s, int k, const koksma__coordinate *c, const uint64_t *indices,
                             bool digits, koksma__relation *relation, char text[120]);

#endif
