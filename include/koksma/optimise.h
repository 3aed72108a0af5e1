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
 * Work proceeds in steps of a fixed amount: equal measure, n, dim, first, keep, seed and number of steps give equal
 * bits, for any number of threads.
 */
#ifndef KOKSMA_OPTIMISE_H
#define KOKSMA_OPTIMISE_H

#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What the search must keep of the first set. */
typedef enum koksma_keep {
    KOKSMA_KEEP_NONE,
    KOKSMA_KEEP_LATIN, /* along each axis the coordinates stay those of the first set, in another order */
    KOKSMA_KEEP_NET,   /* each coordinate stays in its interval of length 1/n, with which a (t,m,s)-net of n = b^m
                          points stays one */
    KOKSMA_KEEP_SEQUENCE /* the points stay the first n = 2^m of a digital sequence in base 2. The value is the geometric
                            mean of the measure over the first 2, 4, ..., n points in each of the projections */
} koksma_keep;

/* The best set so far. */
typedef struct koksma_optimum {
    koksma_points points;
    double value;       /* of the measure, by koksma_evaluate; with KOKSMA_KEEP_SEQUENCE its mean */
    double lower;       /* no n points of so many dimensions have a smaller value; NaN where none is known */
    uint64_t steps;     /* done */
    uint64_t last_gain; /* the step that found these points; 0: they are the first set */
    const char *method; /* of the search, as `koksma list methods` names it */
} koksma_optimum;

/* Several processes that share the work of one search: each calls koksma_optimise with equal arguments, and all get the
   set that one alone gets. */
typedef struct koksma_processes {
    int size, rank; /* processes; which one this is, from 0 */
    /* Gives every process what each of them has: of `count` pieces of so many bytes, piece i is that of process
       i % size. All call it at the same points of their work. */
    koksma_status (*exchange)(void *context, void *pieces, size_t count, size_t bytes);
    /* Called after the last exchange of a search that ends without an error. May be NULL */
    void (*done)(void *context);
    void *context;
} koksma_processes;

typedef struct koksma_optimise_options {
    size_t n; /* 1 or more */
    int dim;
    const koksma_points *first; /* the first set, n points of dim; NULL: n Latin hypercube points, with
                                  KOKSMA_KEEP_NET and KOKSMA_KEEP_SEQUENCE the first n of the Sobol' sequence */
    koksma_keep keep;
    uint64_t seed;
    uint64_t steps; /* 0: until the time limit, or until progress returns false */
    bool (*progress)(void *context, const koksma_optimum *best); /* called with the first set, and after each step, on
                                                          the calling thread; returns false to stop. May be NULL */
    void *context;                                               /* passed to progress */
    /* Measure the points in projections, each on some of the first 64 coordinates: on k if bit k is set. The value is the root
       of the weighted mean of the squares of the measure; with KOKSMA_KEEP_SEQUENCE the weighted geometric mean. NULL: in
       all coordinates together */
    const uint64_t *projections;
    const double *weights; /* of the projections, above 0; NULL: all 1 */
    size_t n_projections;
    const koksma_processes *processes; /* NULL: this process does all of the work */
} koksma_optimise_options;

/* A method of search: one line of `koksma list methods`. */
typedef struct koksma_method {
    const char *name, *title, *cite;
    /* How well it serves such a search; 0: it cannot. Of all methods the one with the largest number does it. */
    int (*serves)(const koksma_spec *measure, const koksma_optimise_options *options);
    /* Replaces points, the best so far, whose value is given, by another candidate. A pure function of its arguments and
       of n, dim, keep and the projections of the options; several threads call it at once. */
    koksma_status (*search)(const koksma_spec *measure, const koksma_optimise_options *options, uint64_t seed,
                            double value, koksma_points *points);
} koksma_method;

/* Returns method i of the table, or the method with this name; NULL if there is none. */
KOKSMA_API const koksma_method *koksma_method_at(size_t i);
KOKSMA_API const koksma_method *koksma_method_find(const char *name);

/* Searches for points with a small value of a measure (a large one of a distance). Allocates out.
     measure  any measure that is exact
     run      its time limit ends the search after the step in which it passes; at least one step is done
   Errors: ARGUMENT (of options or the measure), N, DIM, MEMORY; INTERRUPTED by run->keep_going, after which out holds
   the best set. */
KOKSMA_API koksma_status koksma_optimise(const koksma_spec *measure, const koksma_optimise_options *options,
                                         const koksma_run *run, koksma_optimum *out);

/* Writes the generator matrices of a digital sequence, whose first 2^m points are given, as the pattern net-file reads
   them. Errors: N (not 2^m points), ARGUMENT (other points), IO.
     path     "-" is standard output
     comment  lines for the top of the file; NULL: none */
KOKSMA_API koksma_status koksma_net_write(const char *path, const koksma_points *points, const char *comment);

/* A set of points that the pattern `record` has. */
typedef struct koksma_record {
    const char *measure;
    size_t n;
    int dim;
    double value;       /* of the set */
    double published;   /* the best published value that was at hand, to the digits published; 0: none was */
    const char *source; /* of it: a key of docs/references.bib, or "-" */
} koksma_record;

/* Returns record i, in order of measure and n; NULL past the end. */
KOKSMA_API const koksma_record *koksma_record_at(size_t i);

/* Frees the points and zeroes the struct. best may be NULL, or zeroed. */
KOKSMA_API void koksma_optimum_fini(koksma_optimum *best);

#ifdef __cplusplus
}
#endif

#endif
