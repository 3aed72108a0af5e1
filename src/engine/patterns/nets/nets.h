/* SPDX-License-Identifier: Apache-2.0 */
/* Digital nets and sequences: digits, matrices, scrambling. Each section is the interface of the file of its name. */
#ifndef KOKSMA_PATTERNS_NETS_NETS_H
#define KOKSMA_PATTERNS_NETS_NETS_H

#include <koksma/koksma.h>

#include <stdint.h>

#include "core/visibility.h"

/* ---- Parts ----------------------------------------------------------------------------------------------- */

/* Digital sequences in base 2 beyond point 2^32. Index i is 2^32 part + rest. Generator matrices are upper triangular:
   their columns 0 to 31 are zero below row 32. The first 32 digits of point i are therefore those of point `rest`, xor
   32 digits that only `part` decides; digits 33 to 53 depend on `part` alone. Points of part 0 have 32 digits. */

enum {
    KOKSMA__DIGITS = 53,     /* binary digits of a coordinate; a matrix has as many columns */
    KOKSMA__LATE_DIGITS = 21 /* binary digits of a coordinate after the first 32 */
};

#define KOKSMA__LATE_MASK (((uint64_t)1 << KOKSMA__LATE_DIGITS) - 1)

/* Generates the points of one part from number args->first < 2^32 of this part. */
typedef koksma_status (*koksma__part)(const void *context, uint64_t part, const koksma_args *args,
                                      koksma_points *out);

/* Returns whether all points of a range have numbers below 2^32. Patterns then generate the range at once, without
   koksma__range_parts, which saves time. */
static inline bool koksma__in_first_part(const koksma_args *args, const koksma_points *out)
{
    return args->first + out->n <= (uint64_t)1 << 32;
}

/* Cuts a range into its parts and calls f for each. */
koksma_status koksma__range_parts(const koksma_args *args, koksma_points *out, koksma__part f, const void *context);

/* Returns the exclusive or of the columns 32 + b of a matrix over the bits b of `part`. A column is a whole number
   whose 53 bits are its entries; the highest bit is the entry of row 1. */
uint64_t koksma__part_sum(const uint64_t columns[KOKSMA__DIGITS], uint64_t part);

/* Returns the first 32 digits of a sum of columns. */
static inline uint32_t koksma__early_digits(uint64_t sum)
{
    return (uint32_t)(sum >> KOKSMA__LATE_DIGITS);
}

/* Returns the column whose entry in row r is bit r of `rows`. Rows after the 53rd are cut off. */
uint64_t koksma__mirror_digits(uint64_t rows);

/* Adds digits 33 to 53 of sums[k] to coordinate k of all points. */
koksma_status koksma__add_late_digits(const koksma_run *run, const uint64_t *sums, koksma_points *out);

/* Computes partners[l - 32] for levels l = 32 .. 52, as koksma__partners does for the levels below 32: for i < 2^l,
   points 2^l + i and i ^ partner have the same first l digits. */
void koksma__late_partners(const uint64_t columns[KOKSMA__DIGITS], uint64_t partners[KOKSMA__LATE_DIGITS]);

/* Returns the least m for which 2^m >= n. */
static inline int koksma__levels_of(uint64_t n)
{
    return n > 1 ? 64 - __builtin_clzll(n - 1) : 0;
}

/* ---- Columns --------------------------------------------------------------------------------------------- */

/* Fills the points of patterns that compute one coordinate (a column) of a block of points at a time. The functions
   allocate no memory, and results are bitwise equal for any number of threads. */

enum { KOKSMA__COLUMN_BLOCK = 512 };

/* Computes coordinate k of points first .. first + count - 1 into xs[0] .. xs[count - 1]. `first` is a multiple of
   KOKSMA__COLUMN_BLOCK and count is at most that; xs has capacity for a whole block. */
typedef void (*koksma__column)(const void *context, int k, uint64_t first, size_t count, double *xs);

/* Computes the coordinates k .. k + some - 1 at once, some <= 8: xs[c][i] is coordinate k + c of point first + i. */
typedef double (*koksma__columns)[KOKSMA__COLUMN_BLOCK];
typedef void (*koksma__block)(const void *context, int k, int some, uint64_t first, size_t count, koksma__columns xs);

/* Fill `out` with points args->first, args->first + 1, ... by calling f for each block of points. */
koksma_status koksma__range_blocks(const koksma_args *args, koksma_points *out, koksma__block f, const void *context);
koksma_status koksma__range_columns(const koksma_args *args, koksma_points *out, koksma__column f,
                                    const void *context);

enum { KOKSMA__DIGITAL_DIM = 16 };

/* Fills `out` with a range of a digital sequence in base 2, dim <= KOKSMA__DIGITAL_DIM, up to point 2^32 - 1:
   coordinate k of point i is 2^-32 times the exclusive or of starts[k] and directions[k][b] for all bits b set in i. */
koksma_status koksma__range_digital(const koksma_args *args, const uint32_t *const *directions,
                                    const uint32_t *starts, koksma_points *out);

/* Returns the exclusive or of directions[b] over all bits b that are set in `first`. */
uint32_t koksma__digital_start(const uint32_t *directions, uint64_t first);

/* The context of koksma__digital_column: the directions of each coordinate, and the word to which the directions are
   added; NULL: 0. */
typedef struct koksma__digital_columns {
    const uint32_t (*directions)[32];
    const uint32_t *starts;
} koksma__digital_columns;

/* A koksma__column of a digital sequence in base 2 of any number of dimensions. */
void koksma__digital_column(const void *context, int k, uint64_t first, size_t count, double *xs);

/* Computes all coordinates of points first .. first + count - 1 of `out`, with `first` a multiple of 32768; `stream`:
   whether to bypass the caches with streaming stores. */
typedef void (*koksma__rows)(const void *context, size_t first, size_t count, bool stream, koksma_points *out);

koksma_status koksma__fill_rows(const koksma_run *run, koksma_points *out, koksma__rows f, const void *context);

/* Returns whether the set is larger than the caches, so that streaming stores should write it. */
bool koksma__is_large(const koksma_points *out);

/* Stores a column as coordinate k of `count` points: out[i*dim + k] = xs[i] for i < count. */
void koksma__store_column(size_t count, const double *xs, int dim, int k, double *out);

/* Stores coordinates k .. k + some - 1 of points first .. first + count - 1; the numbers of coordinate k + c begin at
   columns[c * KOKSMA__COLUMN_BLOCK]. */
void koksma__store_columns(size_t count, int some, const double *columns, size_t first, int k, koksma_points *out);

/* ---- Primes ---------------------------------------------------------------------------------------------- */

/* Prime numbers. */

/* Returns the k-th prime, counted from 0: koksma__prime(0) = 2. k < KOKSMA_MAX_DIM. */
uint32_t koksma__prime(int k);

/* ---- Radical --------------------------------------------------------------------------------------------- */

/*
 * Radical inverses: phi_b(i) has the digits of i in base b, mirrored at the radix point (van der Corput 1935). Every
 * value is the double nearest to the exact fraction numerator / b^m, with one rounding, and does not depend on the
 * number of points.
 */

enum { KOKSMA__RADICAL_TABLE = 1024 };

/* Maps the digit a at position j of i (0: the least significant) to another digit. If a koksma__digit is NULL, digits
   are not mapped. */
typedef uint32_t (*koksma__digit)(const void *context, uint32_t base, int j, uint32_t a);

/* One coordinate. The table has the values of all combinations of the `low_digits` lowest digits, mirrored; the
   contribution of the higher digits is added to an entry. */
typedef struct koksma__radical {
    uint32_t base;
    int digits, low_digits; /* number of digits of the numerator; number of digits of the table's indices */
    uint32_t size;          /* size of the table: base^low_digits, or n if that is less */
    double high_scale;      /* base^(digits - low_digits) */
    double whole;           /* base^digits */
    double tail;            /* the amount, in [0,1), that the mapped infinitely many leading zeros add to the
                            numerator */
    koksma__digit digit;
    const void *context;
    double *table;
} koksma__radical;

/* Coordinates of radical inverses. koksma__radicals_init prepares them for the first `count` prime bases and indices
   below n. This function fails with KOKSMA_N if numerators would not be exact: if n is above the largest power of a
   base up to 2^53 or, with mapped digits, above 2^53 / base. All memory is one block, which koksma__radicals_fini
   frees. */
typedef struct koksma__radicals {
    koksma__radical few[8];
    double room[4 * KOKSMA__RADICAL_TABLE];
    koksma__radical *columns;
    void *memory;
} koksma__radicals;

koksma_status koksma__radicals_init(koksma__radicals *r, int count, uint64_t n, koksma__digit digit,
                                    const void *context);
void koksma__radicals_fini(koksma__radicals *r);

/* Fills `out` with points args->first, args->first + 1, ..., all below n: their coordinates are radical inverses. If
   `offset` is not NULL, coordinate 0 of point i is (i + *offset) / n, and the radical inverses are the others. */
koksma_status koksma__range_radicals(const koksma_args *args, uint64_t n, const double *offset, koksma__digit digit,
                                     const void *context, koksma_points *out);

/* Computes out[i], i < count, the radical inverse of first + i. */
void koksma__radical_column(const koksma__radical *r, uint64_t first, size_t count, double *out);

/* ---- Scramble -------------------------------------------------------------------------------------------- */

/* The parameter `scramble`, first in the list, of patterns that can be scrambled by Owen's method or not at all. */

enum { KOKSMA__SCRAMBLE_NONE, KOKSMA__SCRAMBLE_OWEN };

static const char *const koksma__scrambles[] = {"none", "owen", NULL};

/* where: the bases, as in "in base 2" */
#define KOKSMA__PARAM_SCRAMBLE(where)                                                                                \
    {                                                                                                                \
        "scramble", "scrambling: none, or owen (exact nested scrambling" where ")", 0, 0, 1, koksma__scrambles, true \
    }

/* The member `ranges`: scrambled points are made all at once. */
static inline bool koksma__ranges_unscrambled(const double *params)
{
    return params[0] != KOKSMA__SCRAMBLE_OWEN;
}

/* Returns the upper 64 bits of the product: that of two fractions in units of 2^-64. */
static inline uint64_t koksma__upper_half(uint64_t a, uint64_t b)
{
    const uint64_t al = (uint32_t)a, ah = a >> 32, bl = (uint32_t)b, bh = b >> 32;
    const uint64_t middle = ah * bl + (al * bl >> 32), other = al * bh + (uint32_t)middle;
    return ah * bh + (middle >> 32) + (other >> 32);
}

/* ---- Digit sequence -------------------------------------------------------------------------------------- */

/* Digital sequences in a prime base from upper triangular generator matrices. */

/* Fills the upper triangular matrix of coordinate k: entry [r][c] < base is matrix[r * digits + c]. */
typedef void (*koksma__digit_matrix)(uint32_t base, int k, int digits, uint32_t *matrix);

/* Fills `out` with the range of points that begins at args->first. Let y = C a modulo base, where a are the digits of
   the index, the lowest first. A coordinate is the double nearest to y_0 base^-1 + y_1 base^-2 + ... There are at
   most most_digits digits, with base^most_digits <= 2^53. Errors: N where an index needs more digits, MEMORY,
   INTERRUPTED. */
koksma_status koksma__digit_sequence(const char *name, uint32_t base, int most_digits, koksma__digit_matrix fill,
                                     const koksma_args *args, koksma_points *out);

/* Returns the largest number of digits in this base that fit into 53 bits. */
int koksma__digits_of_double(uint32_t base);

/* Fills the powers of Pascal's matrix: entry [r][c] is C(c,r) k^(c-r). */
void koksma__pascal_matrix(uint32_t base, int k, int digits, uint32_t *matrix);

/* ---- Owen sequence --------------------------------------------------------------------------------------- */

enum { KOKSMA__OWEN_DIGITS = 32 };

/* Computes digits[c] < base, c < level, for coordinate k of a sequence. For r < base^level and d < base, point r and
   point base^level * d + r' have the first `level` digits of coordinate k in common, where digit c of r' is digit c
   of r plus d * digits[c] modulo base. */
typedef void (*koksma__owen_relatives)(const void *context, int k, int level, uint32_t *digits);

/* Fills `out` with a digital sequence in a prime base whose coordinates are (0,1)-sequences, with Owen's nested uniform
   scrambling: every node of the tree of digits has its own permutation, drawn exactly. base <= KOKSMA_MAX_DIM. A point
   does not depend on n. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__owen_sequence(uint64_t seed, uint32_t base, koksma__owen_relatives relatives,
                                    const void *context, const koksma_run *run, koksma_points *out);

/* ---- Owen digits ----------------------------------------------------------------------------------------- */

/* Fills `out` with the Owen-scrambled Halton sequence; the base of coordinate k is the k-th prime. */
koksma_status koksma__owen_digits(uint64_t seed, const koksma_run *run, koksma_points *out);

/* ---- Owen hammersley ------------------------------------------------------------------------------------- */

/* Fills coordinate 0 of a point set whose unscrambled coordinate 0 is i/n, i < n = out->n. With n = 2^m this is Owen's
   exact nested uniform scrambling in base 2, in steps of 2^-32; with other n the coordinate is uniform in
   [i/n, (i+1)/n). In both cases each of these n strata has one point. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__owen_equidistant(uint64_t seed, const koksma_run *run, koksma_points *out);

/* Fills `out` with Owen-scrambled Hammersley points: coordinate 0 is that of koksma__owen_equidistant, coordinate k > 0
   is coordinate k - 1 of koksma__owen_digits. */
koksma_status koksma__owen_hammersley(uint64_t seed, const koksma_run *run, koksma_points *out);

/* ---- Grow ------------------------------------------------------------------------------------------------ */

/*
 * Stochastic generation (Helmer, Christensen & Kensler 2021): a digital sequence in base 2 with exact Owen (nested
 * uniform) scrambling, in O(1) for each coordinate of a point. Point 2^l + i is put at a random position in a stratum
 * of width 2^-l, in the half that does not contain the earlier point number i XOR partner. The low bits of
 * coordinate k of point p come from word p % 4 of koksma__random(seed, purpose, p / 4, k). This is Owen scrambling given
 * that digits 33 to 53 of the first 2^32 points are 0: a coordinate is uniform on the multiples of 2^-32 for those
 * points, and its first 32 digits are uniform for all points.
 */

/* Fills `out` with the first points; partners[32 k + l] is the partner of level l for coordinate k < dim. */
koksma_status koksma__grow(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                           koksma_points *out);

/* A part of the sequence beyond point 2^32 (patterns/nets/nets.h), and the partners of the levels from 32 on:
   late_partners[21 k + l] is that of level 32 + l for coordinate k. */
typedef struct koksma__grow_part {
    uint64_t part;
    const uint64_t *late_partners;
} koksma__grow_part;

/* Fills `out` with points args->first, args->first + 1, ... of a part of the sequence of koksma__grow, up to the end of
   this part. partners has 32 levels unless args->first is 0.
     part  NULL: the first 2^32 points, whose coordinates have 32 digits; all other points have 53 */
koksma_status koksma__grow_range(uint64_t seed, uint32_t purpose, const uint32_t *partners,
                                 const koksma__grow_part *part, const koksma_args *args, koksma_points *out);

/* The partners of pmj02. The generator matrix of its coordinate 0 is the matrix of the Stirling numbers of the first
   kind modulo 2; the matrix of coordinate 1 is the same matrix shifted by a row and a column. */
extern KOKSMA__LAB const uint32_t koksma__pmj02_partners[2 * 32];

/* Computes coordinate 0 of the first n points as 32-bit fractions: v[i] is 2^32 times coordinate 0 of point i.
   partners[l] is the partner for level l < 32. */
koksma_status koksma__grow_column(uint64_t seed, uint32_t purpose, const uint32_t *partners, const koksma_run *run,
                                  size_t n, uint32_t *v);

/* ---- Hash owen ------------------------------------------------------------------------------------------- */

/* Digital sequences scrambled by an Owen hash, for blocks of points. Results are bitwise equal to those of
   koksma_sobol_2d and similar functions of koksma/sampler.h. */

/* Computes index[i], the index of the point at position first + i in the random order for this seed; indices and
   positions are counted from the beginning of the part (patterns/nets/nets.h). Each part has an order of its own;
   the parts are not shuffled. */
void koksma__hash_owen_order(uint64_t seed, uint64_t part, uint64_t first, size_t count, uint32_t *index);

/* Scrambles coordinate k of `count` points. v[i] has the first 32 digits within the part, with the bits reversed, and is
   overwritten; `sum` has the digits that the part adds to all of them (patterns/nets/nets.h), 0 for points below
   2^32; xs[i] receives the scrambled coordinate. Digits 33 to 53 are scrambled such that 21 zeros stay zeros after any
   first 32 digits. */
void koksma__hash_owen_scramble(uint64_t seed, int k, uint64_t sum, size_t count, uint32_t *v, double *xs);

/* Reverses the bits of the 32 direction numbers, because the hash takes words with bits reversed. */
void koksma__mirror_directions(const uint32_t *directions, uint32_t *mirrored);

/* ---- Sobol table ----------------------------------------------------------------------------------------- */

enum { KOKSMA__SOBOL_DIM = 1111 };

/* The sets of direction numbers: Joe & Kuo's, Bratley & Fox's, and our own of tools/make_sobol_groups.c. */
enum { KOKSMA__JOE_KUO, KOKSMA__BRATLEY_FOX, KOKSMA__GROUPS, KOKSMA__SOBOL_SETS };

/* Returns the number of dimensions of a set of direction numbers. */
KOKSMA__LAB int koksma__sobol_dim(int set);

/* Returns the generator matrix of dimension k, counted from 0: word b is column b, whose first row is the highest bit.
   k is below koksma__sobol_dim(set). */
KOKSMA__LAB const uint32_t *koksma__sobol_directions(int k, int set);

/* Returns the primitive polynomial of dimension k > 0 of Joe & Kuo's numbers, those in order by degree and then by value:
   bit d is the coefficient of x^d. */
uint32_t koksma__sobol_polynomial(int k);

/* Computes the whole generator matrix of dimension k for indices below 2^53: bit 52 of columns[b] is row 1. The first 32
   columns are koksma__sobol_directions(k, set), with zeros in rows 33 to 53. */
void koksma__sobol_columns(int k, int set, uint64_t columns[KOKSMA__DIGITS]);

/* Computes partners[l], l < levels, for the digital sequence with these directions, an upper triangular matrix: for
   i < 2^l, points 2^l + i and i ^ partners[l] have the same first l bits. */
KOKSMA__LAB void koksma__partners(const uint32_t *directions, int levels, uint32_t *partners);

#endif
