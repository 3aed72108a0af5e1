/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Search for point sets with a small value of a measure. Part of libkoksma.
 *
 *     koksma_optimum best;
 *     koksma_optimise_options options = {.n = 16, .dim = 2, .steps = 20};
 *     if (!koksma_measure_spec("star", &star) && !koksma_optimise(&star, &options, NULL, &best)) {
 *         printf("%g after %llu steps\n", best.value, (unsigned long long)best.steps);
 *     }
 *     koksma_optimum_fini(&best);
 *
 * The search proceeds in steps of a fixed amount of work. Equal measure, n, dim, first set, keep, seed and number
 * of steps give bit-identical results for any number of threads.
 */
#ifndef KOKSMA_OPTIMISE_H
#define KOKSMA_OPTIMISE_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The property of the first set that the search must preserve. */
typedef enum koksma_keep {
    KOKSMA_KEEP_NONE,
    KOKSMA_KEEP_LATIN,    /* on each axis the search only permutes the coordinates of the first set */
    KOKSMA_KEEP_NET,      /* each coordinate stays in its interval of length 1/n, so that a (t,m,s)-net of n = b^m
                            points remains a net */
    KOKSMA_KEEP_SEQUENCE, /* the points remain the first n = 2^m points of a digital sequence in base 2. The search
                             minimises the geometric mean of the measure over the first 2, 4, ..., n points in each
                             of the projections */
    KOKSMA_KEEP_PREFIXES /* no structure, but the search minimises the geometric mean of the measure over the first 8,
                             9, ..., n points (n if there are fewer), as for a sequence of any number of points */
} koksma_keep;

/* The best point set that a search has found so far. */
typedef struct koksma_optimum {
    koksma_points points;
    double value;   /* value of the measure by koksma_evaluate; with KOKSMA_KEEP_SEQUENCE and KOKSMA_KEEP_PREFIXES
                           the geometric mean that the search minimises */
    double lower;   /* lower bound of the measure over all sets of n points in this dimension, or NaN if no bound
                           is known */
    uint64_t steps; /* number of steps done */
    uint64_t
        last_gain; /* number of the step that found these points; 0: they are the first set; steps + 1: a step that
                           the time limit or keep_going ended found them, and no number of steps gives them again */
    const char *method; /* name of the search method, as in `koksma list methods` */
} koksma_optimum;

typedef struct koksma_optimise_options {
    size_t n; /* 1 or more */
    int dim;
    const koksma_points *first; /* the first set, n points of dim coordinates. If it is NULL, the search starts from
                                   the best of the sets that the listed patterns make with default parameters and
                                   this seed, if they have the structure to keep; so no result is worse than a listed
                                   pattern. KOKSMA_KEEP_LATIN also tries these sets with coordinates (i + 1/2)/n */
    koksma_keep keep;
    uint64_t seed;
    uint64_t steps; /* number of steps; 0: search until the time limit passes or progress returns false */
    bool (*progress)(void *context, const koksma_optimum *best); /* callback that is called with the first set and
                                                                    after each step, on the calling thread; it
                                                                    returns false to stop. May be NULL */
    void *context;                                               /* passed to progress */
    /* Projections in which to measure the points, each a bit mask of the first 64 coordinates: it contains
       coordinate k if bit k is set. The value is the root of the weighted mean of the squared measure over the
       projections, or with KOKSMA_KEEP_SEQUENCE the weighted geometric mean. NULL: measure the points in all
       coordinates */
    const uint64_t *projections;
    const double *weights; /* n_projections weights from 1e-100 to 1e100 (NULL: all weights are 1) */
    size_t n_projections;
    /* NULL, or a target spectrum for 2D points: power[r - 1], from 0 to 1e100, is the wanted mean power in ring r = 1
       .. rings (koksma_spectrum_rings). With a target the search ignores the measure. It minimises the root mean square
       difference between the spectrum of the points and the target, with weight r for ring r. With KOKSMA_KEEP_NONE
       and no first set it starts from a set of gaussian-blue-noise */
    const double *power;
    int rings; /* length of power; must be 0 if power is NULL */
} koksma_optimise_options;

/* A method of search: one line of `koksma list methods`. */
typedef struct koksma_method {
    const char *name, *title, *cite;
    /* Returns a number that is larger the better the method suits this search; 0: it cannot do this search.
       koksma_optimise uses the method that returns the largest number. */
    int (*serves)(const koksma_spec *measure, const koksma_optimise_options *options);
    /* Replaces `points`, the best set so far with the given value, by another candidate. The result depends only on
       the arguments (of the options: n, dim, keep and the projections); several threads call the function at
       once. It asks run->keep_going often, on the thread that called it, and fails with INTERRUPTED if that returns
       false; `points` then has the best set that it has found so far, or is as before. */
    koksma_status (*search)(const koksma_spec *measure, const koksma_optimise_options *options, uint64_t seed,
                            double value, const koksma_run *run, koksma_points *points);
} koksma_method;

/* Returns method i of the table, or the method with this name, or NULL if there is none. */
KOKSMA_API const koksma_method *koksma_method_at(size_t i);
KOKSMA_API const koksma_method *koksma_method_find(const char *name);

/* Searches for points with a small value of a measure (a large value if the measure is a distance). Allocates out.
     measure  a measure whose answer is KOKSMA_ANSWER_EXACT, or NULL if options->power is set
     run      the time limit and keep_going end the search within a step; out then has the best set found so far, also
              in that step. A Latin hypercube (with KOKSMA_KEEP_NET and KOKSMA_KEEP_SEQUENCE Sobol' points) or the
              given first set is made and measured in up to ten times the limit, or 10 s
   Errors: ARGUMENT (a bad option or measure), N (also: the first set takes longer than that), DIM, MEMORY, INTERRUPTED
   (run->keep_going returned false; out then has the best set so far, or is zeroed if the first set had not been made and
   measured). */
KOKSMA_API koksma_status koksma_optimise(const koksma_spec *measure, const koksma_optimise_options *options,
                                         const koksma_run *run, koksma_optimum *out);

/* Computes a target for options->power: the mean power that n points should have in the rings of frequencies 1 ..
   rings.
     text   "step" (0 below the frequency sqrt(n / pi), else 1), "gaussian" (1 - exp(-pi f^2 / n)), a pattern (the
            mean of 16 sets), or a file of lines with a frequency in units of sqrt(n) and a power up to 1e100
     rings  1 to KOKSMA_SPECTRUM_MAX_HALF
     power  receives rings numbers
   Errors: ARGUMENT, N, MISSING, MALFORMED, MEMORY, INTERRUPTED, and those of koksma_generate. */
KOKSMA_API koksma_status koksma_radial_power(const char *text, size_t n, int rings, const koksma_run *run,
                                             double *power);

/* Computes the generator matrices of a digital sequence from its first 2^m points and writes them to a file for the
   pattern net-file. Errors: N (the number of points is not a power of two), ARGUMENT (the points are not those of a
   digital sequence), IO.
     path     "-" is standard output
     comment  comment lines for the top of the file; may be NULL */
KOKSMA_API koksma_status koksma_net_write(const char *path, const koksma_points *points, const char *comment);

/* A point set of the pattern `record`, which stores the best sets known. */
typedef struct koksma_record {
    const char *measure;
    size_t n;
    int dim;
    double value;       /* value of the measure for this set */
    double published;   /* best published value that we know, with its published digits; 0: we know none */
    const char *source; /* source of the published value: a key of docs/references.bib, or "-" */
    uint64_t
        seed; /* `koksma optimise MEASURE -n N -d DIM --from latin-hypercube --seed SEED --steps STEPS` makes the set */
    uint64_t steps; /* 0: an earlier version of the search made the set, and no command reproduces it */
} koksma_record;

/* Returns record i, sorted by measure and n, or NULL past the last record. */
KOKSMA_API const koksma_record *koksma_record_at(size_t i);

/* Frees the points and zeroes the struct. best may be NULL, or zeroed. */
KOKSMA_API void koksma_optimum_fini(koksma_optimum *best);

#ifdef __cplusplus
}
#endif

#endif
