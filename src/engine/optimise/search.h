/* SPDX-License-Identifier: Apache-2.0 */
/* What the searches share. Each section is the interface of the file of its name; that of methods is what every method
   may use. */
#ifndef KOKSMA_OPTIMISE_SEARCH_H
#define KOKSMA_OPTIMISE_SEARCH_H

#include <koksma/optimise.h>

#include "core/random.h"
#include "core/visibility.h"
#include "measures/l2/l2.h"
#include "measures/measures.h"

/* ---- Methods --------------------------------------------------------------------------------------------- */

#define METHOD(name) extern const koksma_method koksma__method_##name;
#include "optimise/methods.def"
#undef METHOD

/* The random numbers of one search, drawn one after the other. At first all members but the seed are 0. */
typedef struct koksma__stream {
    uint64_t seed, used;
    koksma__words words;
} koksma__stream;

static inline uint32_t koksma__next(koksma__stream *s)
{
    if (s->used % 4 == 0) {
        s->words = koksma__random(s->seed, KOKSMA__PURPOSE_SEARCH, s->used / 4, 0);
    }
    return s->words.w[s->used++ % 4];
}

/* koksma__next_unit returns a double in [0,1) with 32 random bits, koksma__next_below a random integer below n. */
static inline double koksma__next_unit(koksma__stream *s)
{
    return koksma__next(s) * 0x1p-32;
}

static inline uint32_t koksma__next_below(koksma__stream *s, size_t n)
{
    return koksma__below(koksma__next(s), (uint32_t)n);
}

/* ---- Value ----------------------------------------------------------------------------------------------- */

/* The value that a search minimises: a measure, or the mean of a measure over the prefixes of a sequence and over
   projections. */

/* Checks the projections and weights. Errors: DIM (projections of more than 64 coordinates), ARGUMENT (a projection
   without a coordinate or with a coordinate that the points do not have; a weight outside 1e-100 to 1e100). */
koksma_status koksma__search_check(const koksma_optimise_options *options);

/* Whether the value that a search minimises is a mean over the first points of the set. */
static inline bool koksma__search_of_prefixes(const koksma_optimise_options *o)
{
    return o->keep == KOKSMA_KEEP_SEQUENCE || o->keep == KOKSMA_KEEP_PREFIXES;
}

/* Computes the value of these points that a search minimises and reports (koksma_optimum.value). Errors: those of
   koksma_evaluate, ARGUMENT (a value of 0 in a geometric mean). */
koksma_status koksma__search_value(const koksma_spec *measure, const koksma_optimise_options *options,
                                   const koksma_points *points, const koksma_run *run, double *value);

/* Computes the square of the value and its derivatives with respect to the coordinates. Must not be called for
   sequences or for measures without a gradient. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__search_square(const koksma_spec *measure, const koksma_optimise_options *options,
                                    const koksma_points *points, const koksma_run *run, double *square,
                                    double *gradient);

/* ---- Descent --------------------------------------------------------------------------------------------- */

/* L-BFGS for functions of the coordinates of points, and the starting points of such descents. */

enum { KOKSMA__MEMORY = 10, KOKSMA__ITERATIONS = 300 };

/* Computes a function of points: its value, and its derivatives with respect to the coordinates. */
typedef koksma_status (*koksma__function)(const void *context, const koksma_points *points, double *value,
                                          double *gradient);

typedef struct koksma__descent {
    koksma_points points; /* x */
    koksma__function function;
    const void *context;
    const koksma_run *run; /* asked before each call of the function */
    bool bounded;
    size_t count;                       /* number of coordinates of all points */
    double *low, *gradient, *direction; /* low: lower ends of the coordinates' intervals */
    double *before, *gradient_before;
    double *steps, *changes; /* the last KOKSMA__MEMORY differences between successive x, and between successive
                                gradients */
    double length, products[KOKSMA__MEMORY], work, cost,
        budget;  /* work done so far, work of one gradient, limit of work; the unit is one coordinate read */
    size_t kept; /* number of steps so far */
    double goal; /* a descent that is unlikely to reach this value ends early */
} koksma__descent;

/* Allocates a descent for sets of the size of `points`; with keep=net each coordinate stays in its interval of length
   1/n. If `bounded` is false, coordinates are on the torus. `cost` is the work of one call of the function. Errors:
   MEMORY. */
koksma_status koksma__descent_init(koksma__descent *d, const koksma_points *points, koksma_keep keep, bool bounded,
                                   double cost);
void koksma__descent_fini(koksma__descent *d);

/* Sets the points from which a descent starts: a changed copy of the best set, or new points. Errors: those of the
   function, INTERRUPTED. */
koksma_status koksma__descent_start(koksma__descent *d, const koksma_points *best, koksma_keep keep,
                                    koksma__stream *random);

/* Sets the points {i a + s} (fractional parts) with random vectors a and s; in half of the calls the first coordinate
   is i / n + s. */
void koksma__descent_kronecker(koksma__descent *d, koksma__stream *random);

/* Descends from d->points in at most the given number of iterations. On return, also after INTERRUPTED, d->points has the
   best points found, and *least their value (infinite: not even the first was computed). Errors: those of the
   function, INTERRUPTED. */
koksma_status koksma__descend(koksma__descent *d, int iterations, double *least);

/* ---- Radial power ---------------------------------------------------------------------------------------- */

/* The distance between the radial power of a point set and a target curve. */

/* The measure that a search for a target power minimises, in place of one from the table of measures. */
/* How many of the eight searches of a step are made: all, but fewer in tests with sanitizers. */
extern size_t koksma__searches_made;

extern const koksma_measure koksma__measure_radial_power;

/* The largest power of a target: its square and sums of such squares are in the range of doubles. */
#define KOKSMA__MOST_POWER 1e100

/* Fails unless the options of a search for a target power are valid. Errors: ARGUMENT, DIM. */
koksma_status koksma__radial_power_check(const koksma_optimise_options *options);

/* Returns the work of one gradient, as the number of points times the number of frequencies. */
double koksma__radial_power_cost(const koksma_optimise_options *options);

/* Computes the square of the distance, and its derivatives with respect to the coordinates if `gradient` is not NULL.
   Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__radial_power_square(const koksma_optimise_options *options, const koksma_points *points,
                                          const koksma_run *run, double *square, double *gradient);

/* ---- Sequence -------------------------------------------------------------------------------------------- */

/* Digital sequences in base 2, given by their first points; a search with KOKSMA_KEEP_SEQUENCE changes only their
   generator matrices. */

/* The number of binary digits of a coordinate. */
enum { KOKSMA__SEQUENCE_DIGITS = 53 };

/* Checks that the points begin a digital sequence. Errors: N (not 2^m points, m >= 1), ARGUMENT (they are not the
   first points of a digital sequence). */
koksma_status koksma__sequence_check(const koksma_points *points);

/* ---- Start ----------------------------------------------------------------------------------------------- */

/* The sets from which a search without a first set can start: those of the listed patterns. */

/* Receives one set; NULL: run->keep_going has returned false while it was made. An error ends the walk. */
typedef koksma_status (*koksma__start_function)(void *context, const koksma_points *points);

/* Generates the set of the pattern that has the structure which the search preserves, and is made for any n. Errors:
   those of koksma_generate. */
koksma_status koksma__search_default(const koksma_optimise_options *options, const koksma_run *run,
                                     koksma_points *points);

/* Calls f with the set of each listed pattern that makes such sets with the structure which the search preserves: those
   of deterministic patterns, or those of random ones. Errors: MEMORY, INTERRUPTED, those of f. */
KOKSMA__LAB koksma_status koksma__search_starts(const koksma_spec *measure, const koksma_optimise_options *options,
                                                bool random, const koksma_run *run, koksma__start_function f,
                                                void *context);

/* ---- Swaps ----------------------------------------------------------------------------------------------- */

/* Swaps of one coordinate of two points, and the change of an L2 discrepancy of boxes by one, from stored kernels. */

typedef struct koksma__swaps {
    const koksma__l2_row *row;
    size_t n, dim, stride;
    double *kernels;        /* K_k(i, j) at (k n + i) stride + j; the columns from n on are 0 */
    double *linear;         /* a_k of point i at k n + i */
    double *products;       /* two rows: R_p and R_q */
    double *before;         /* capacity for a set that the caller wants to restore */
    uint32_t *order, *rank; /* for each axis: the points in order, and the rank of each point */
    koksma__stream random;
    void *memory;
} koksma__swaps;

/* The largest n^2 dim whose kernels are stored. */
enum { KOKSMA__MOST_KERNELS = 1 << 21 };

/* Allocates for sets of the size of `points`; free(s->memory) releases. Errors: MEMORY. */
koksma_status koksma__swaps_init(koksma__swaps *s, const koksma__l2_row *row, const koksma_points *points,
                                 uint64_t seed);

/* Computes orders, kernels and integrals of the points. Errors: MEMORY. */
koksma_status koksma__swaps_prepare(koksma__swaps *s, const double *xs);

/* Returns the change of n^2 times the squared discrepancy when points p and q swap coordinate k. */
double koksma__swaps_change(const koksma__swaps *s, size_t k, size_t p, size_t q);

/* Swaps coordinate k of points p and q, and updates orders, kernels and integrals. */
void koksma__swaps_swap(koksma__swaps *s, double *xs, size_t k, size_t p, size_t q);

#endif
