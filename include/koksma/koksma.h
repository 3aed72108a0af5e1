/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Koksma: sampling patterns, and exact measures of how irregular their points are. Part of libkoksma.
 *
 * Look a pattern up by a spec such as "poisson-disk:d=0.2", generate points with it, look a measure up, evaluate it:
 *
 *     koksma_points points;
 *     koksma_spec pattern, star;
 *     koksma_value value;
 *     if (koksma_points_init(&points, 16, 2) || koksma_pattern_spec("n-rooks", &pattern) ||
 *         koksma_generate(&pattern, 7, NULL, &points) || koksma_measure_spec("star", &star) ||
 *         koksma_evaluate(&star, &points, NULL, &value)) {
 *         puts(koksma_error_text());
 *     }
 *     koksma_points_fini(&points);
 *
 * These rules hold for every function of every header of this directory:
 *
 *   Errors     A function that can fail returns a koksma_status, KOKSMA_OK (0) for success. "Errors:" lists the others
 *              that it returns, without the prefix KOKSMA_; any may also return ARGUMENT. koksma_error_text() then
 *              has one line that names the thing and the reason. After an error each result is as before or zero,
 *              unless the function's comment says otherwise.
 *   Results    go through out-pointers, which are the last parameters.
 *   Pointers   must not be NULL unless the comment says "may be NULL". A NULL is ARGUMENT. A function without a
 *              status then returns NULL, NaN, 0 or false, or does nothing, and leaves a text, too. What a pointer
 *              points to, and that an array has as many members as its count says, is for the caller to ensure.
 *   Memory     The caller owns every struct. koksma_NOUN_init, and functions that say "allocates", take memory that
 *              koksma_NOUN_fini frees; koksma_NOUN_open goes with koksma_NOUN_close. Both accept NULL.
 *   Threads    Any function may be called from several threads at once, on different objects. Read-only arguments
 *              may be shared. A function that takes a koksma_run uses the threads that it allows; others use one.
 *   Bits       Equal arguments give equal bits for any number of threads, any instruction set and any locale; numbers
 *              in texts have a decimal point.
 *   Nothing    here prints, exits or keeps state between calls but each thread's koksma_error_text() and
 *              koksma_allow_exec().
 */
#ifndef KOKSMA_KOKSMA_H
#define KOKSMA_KOKSMA_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define KOKSMA_VERSION "0.1.0"

#if defined(__GNUC__)
#define KOKSMA_API __attribute__((visibility("default")))
#define KOKSMA_PRINTF(text, first) __attribute__((__format__(__printf__, text, first)))
#else
#define KOKSMA_API
#define KOKSMA_PRINTF(text, first)
#endif

/* ---- Status ------------------------------------------------------------------------------------------- */

typedef enum koksma_status {
#define KOKSMA_STATUS(name, number, exit_code, text) KOKSMA_##name = (number),
#include <koksma/status.def>
#undef KOKSMA_STATUS
#define KOKSMA_STATUS(name, number, exit_code, text) +1
    KOKSMA_STATUS_COUNT = 0
#include <koksma/status.def>
#undef KOKSMA_STATUS
} koksma_status;

/* Returns the general meaning of a status, a constant string such as "a file is malformed". Takes any value. */
KOKSMA_API const char *koksma_status_text(koksma_status status);

/* Returns the exit code that the program `koksma` uses for a status: 0, 2, 3, 4 or 130. */
KOKSMA_API int koksma_status_exit_code(koksma_status status);

/* Returns the message of this thread's last failed call: one line, without a newline, that names the thing and the
   reason. The string is valid until the next failing call of this thread; before the first it is empty. */
KOKSMA_API const char *koksma_error_text(void);

/* Name i of a table, NULL past its end. */
typedef const char *koksma_name_at(const void *table, size_t i);

/* Returns the name of a table that a misspelt word was most likely meant to be, for "did you mean"; NULL if none is
   near, or word is empty or longer than 64 characters. Case does not count.
     name, table  name(table, i) is called for i = 0, 1, ... until it returns NULL; table may be NULL */
KOKSMA_API const char *koksma_closest_name(const char *word, koksma_name_at *name, const void *table);
/* Makes a text one line of valid UTF-8, as error texts are: control characters and bytes that are no UTF-8 (a file's
   name may hold any) become \xNN. size: bytes that there is room for at text; what no longer fits is cut. text may be
   NULL. */
KOKSMA_API void koksma_text_escape(char *text, size_t size);

/* Returns the instruction set whose inner loops run in this process: "avx512", "avx2", "baseline" or "ref" (plain C,
   for tests). It is the first that the processor has. The environment variable KOKSMA_KERNELS selects another one;
   the first call that computes reads it. The first three give the same bits; "ref" may differ in the last digits of
   a few measures. */
KOKSMA_API const char *koksma_instruction_set(void);

/* Returns the version of the library that runs, such as "0.1.0". KOKSMA_VERSION is that of the header. */
KOKSMA_API const char *koksma_version(void);

/* ---- Long calls --------------------------------------------------------------------------------------- */

/* How to run a call that may take long. A parameter of this type may be NULL: all threads, no limit, no callback. */
typedef struct koksma_run {
    int threads;         /* the most threads to use; 0: one for each processor */
    double time_limit_s; /* seconds; 0: none. A measure that runs out of time returns bounds (koksma_value.exact is
                            false) */
    bool (*keep_going)(void *context, double fraction_done); /* called from time to time, on the calling thread only;
                                                                 returns false to cancel: the call then returns
                                                                 INTERRUPTED. May be NULL */
    void *context;                                           /* passed to keep_going */
} koksma_run;

/* ---- Points ------------------------------------------------------------------------------------------- */

/* n points of dim coordinates each: point i is xs[i * dim] .. xs[i * dim + dim - 1]. Patterns give coordinates in
   [0,1); measures accept [0,1]. */
typedef struct koksma_points {
    size_t n;
    int dim;
    double *xs;
} koksma_points;

enum { KOKSMA_MAX_DIM = 4096 };

/* The most coordinates n * dim of one set: 2^28, which are 2 GiB of doubles. On machines with 32-bit sizes 2^24: no
   method needs more than 255 bytes for each coordinate, so that no buffer size overflows. */
#define KOKSMA_MAX_COORDINATES ((size_t)1 << (sizeof(size_t) > 4 ? 28 : 24))

/* Allocates n points of dim coordinates, all zero.
     points  out; its old content is overwritten, not freed
     n       1 or more, n * dim at most KOKSMA_MAX_COORDINATES
     dim     1 to KOKSMA_MAX_DIM
   Errors: ARGUMENT (n), DIM (dim), MEMORY. */
KOKSMA_API koksma_status koksma_points_init(koksma_points *points, size_t n, int dim);

/* Frees the coordinates and zeroes the struct. points may be NULL, or zeroed. */
KOKSMA_API void koksma_points_fini(koksma_points *points);

/* Reads points from a file; allocates points.
     path  a .npy file, recognised by its content, or text: one point a line, coordinates separated by blanks, tabs or
           commas, `#` starts a comment, one CSV header line is allowed. "-" is standard input
   Every row needs the same number of coordinates, all in [0,1].
   Errors: MISSING, MALFORMED (names file, line and reason), MEMORY. */
KOKSMA_API koksma_status koksma_points_read(const char *path, koksma_points *points);

/* Writes points to a file, completely or not at all.
     path     its ending decides the format: .csv, .npy, anything else is text. "-" is text on standard output
     points   coordinates in [0,1]
     comment  becomes lines that start with "# " in text files; may be NULL
   Numbers are printed with 17 significant digits, so that they read back to the same bits (-0 as 0).
   Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, IO, INTERRUPTED. */
KOKSMA_API koksma_status koksma_points_write(const char *path, const koksma_points *points, const char *comment,
                                             const koksma_run *run);

/* Does the same for points that need not be in [0,1], such as those that a warp has mapped: all coordinates must be
   finite. Errors: ARGUMENT (no points, a coordinate that is not finite), IO, INTERRUPTED. */
KOKSMA_API koksma_status koksma_points_write_mapped(const char *path, const koksma_points *points,
                                                    const char *comment, const koksma_run *run);

/* ---- Parameters and specs ----------------------------------------------------------------------------- */

/* A parameter of a pattern or measure. The arrays of them end at one whose name is NULL. */
typedef struct koksma_param {
    const char *name, *help;
    double fallback, min, max;  /* default and closed range; with choices, of the index of the choice */
    const char *const *choices; /* the words that it accepts, up to a NULL; NULL for a number */
    bool whole;                 /* accepts whole numbers only */
} koksma_param;

enum { KOKSMA_MAX_PARAMS = 8, KOKSMA_MAX_MODIFIERS = 8, KOKSMA_MAX_SPEC = 512 };

/* The arguments of a pattern's or measure's function: its parameters in the order of its table, and how to run. */
typedef struct koksma_args {
    double params[KOKSMA_MAX_PARAMS];
    const char *path;      /* the file, for a pattern that reads one; else NULL */
    const koksma_run *run; /* may be NULL */
    uint64_t first, n; /* of a pattern that has ranges: the index of the first point wanted, and how many points the
                              whole set has, unless it is a sequence; else 0 */
} koksma_args;

typedef struct koksma_pattern koksma_pattern;
typedef struct koksma_measure koksma_measure;

/* A pattern or a measure with its parameters: the meaning of a text such as "poisson-disk:d=0.2". Plain data without
   pointers to free; copy it freely. */
typedef struct koksma_spec {
    const koksma_pattern *pattern; /* exactly one of pattern and measure is not NULL */
    const koksma_measure *measure;
    double params[KOKSMA_MAX_PARAMS];
    char path[KOKSMA_MAX_SPEC];             /* of a pattern that reads a file */
    double modifiers[KOKSMA_MAX_MODIFIERS]; /* of a pattern, in the order of koksma_modifier_at; 0: not applied */
} koksma_spec;

/* Parses a spec: "name" or "name:key=value,key=value".
   Every pattern also accepts the modifiers, such as shift=1: all points are shifted on the torus by one random vector.
   With a file they are the ending of its path, as in "file:set.txt,shift=1". An alias is replaced by the pattern that it
   stands for.
   Errors: ARGUMENT (a parameter; the message names it and what it accepts), UNKNOWN (the name; the message suggests
   the nearest one). */
KOKSMA_API koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec);
KOKSMA_API koksma_status koksma_measure_spec(const char *text, koksma_spec *spec);

/* Writes the canonical text of a spec: parameters and modifiers in table order, without those at their defaults. Results are stored
   under this text.
     text  KOKSMA_MAX_SPEC characters; empty if the spec has neither a pattern nor a measure */
KOKSMA_API void koksma_spec_text(const koksma_spec *spec, char *text);

/* ---- Patterns ----------------------------------------------------------------------------------------- */

/* Properties that a pattern claims, KOKSMA_CLAIM_DETERMINISTIC and so on: <koksma/claims.def> has their meanings.
   Each claim switches on its test for every pattern that makes it. */
enum {
#define KOKSMA_CLAIM(id, bit, name, meaning) KOKSMA_CLAIM_##id = 1u << (bit),
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
};

struct koksma_pattern {
    const char *name, *title, *cite; /* cite: keys of docs/references.bib, separated by blanks */
    int min_dim, max_dim;            /* dimensions that it serves */
    unsigned claims;
    const koksma_param *params; /* NULL: none */
    koksma_status (*generate)(uint64_t seed, const koksma_args *args, koksma_points *out);
    const char *operand;  /* what the text after the colon of its spec is, as PATH; NULL: parameters */
    const char *alias_of; /* this entry is another name of that pattern; NULL: it is not */
    /* Allocates all points of a pattern whose parameters decide how many there are (koksma_generate_whole). out->dim
       is set by the caller; 0: any. Returns N where the parameters leave the number open. NULL for other patterns. */
    koksma_status (*whole)(uint64_t seed, const koksma_args *args, koksma_points *out);
    int revision; /* 0, and one more with every change of any bit of its points: studies keep it with their rows */
    /* Whether a point follows from its index alone with these parameters, so that koksma_generate_range serves it. NULL:
       with none. */
    bool (*ranges)(const double *params);
    bool runs_code; /* it runs what its operand names, after koksma_allow_exec */
};

/* A map of the cube to itself that every pattern accepts behind its own parameters. Several are applied in the order of
   the table. In a renderer each pixel has a seed, so that a random one makes its pixels differ. */
typedef struct koksma_modifier {
    const char *name, *title, *cite;
    double min, max;        /* its value is 0, not applied, or a whole number from min to max */
    bool random;            /* depends on the seed */
    unsigned claims;        /* what a pattern claims and its points still keep */
    unsigned claims_binary; /* the same, where n is a power of 2 */
    unsigned gives;         /* what the points of any pattern keep after it */
    const char
        *measures;     /* names with blanks between them: the measures of which it changes no value but by rounding;
                               "*": all that are exact */
    const char *keeps; /* the same in words */
} koksma_modifier;

/* Returns modifier i of the table; NULL if there is none. */
KOKSMA_API const koksma_modifier *koksma_modifier_at(size_t i);

/* Returns pattern i of the table, or the pattern with this name; NULL if there is none. */
KOKSMA_API const koksma_pattern *koksma_pattern_at(size_t i);
KOKSMA_API const koksma_pattern *koksma_pattern_find(const char *name);

/* Generates out->n points of out->dim coordinates in [0,1).
     spec  a pattern
     seed  any number; the points are a pure function of spec, seed, n and dim
     out   initialised by koksma_points_init with the n and dim that are wanted
   It never gives fewer points and always ends. Costs differ: most patterns take O(n dim), blue noise up to O(n^2).
   Errors: N, DIM, ARGUMENT (the pattern cannot serve this n, dim or parameter; the message says what would work),
   IMPOSSIBLE (no such set exists, or none was found), MEMORY, INTERRUPTED; of a file MISSING and MALFORMED; of a pattern that
   runs code these, FORBIDDEN and SYSTEM. */
KOKSMA_API koksma_status koksma_generate(const koksma_spec *spec, uint64_t seed, const koksma_run *run,
                                         koksma_points *out);

/* Allows the calling thread, and the threads that its calls start, to run what the patterns exec:PROGRAM and
   plugin:LIBRARY name, wherever their spec comes from: a plan and a scene, too. Else they are FORBIDDEN.
     seconds  the longest that a program may take for a set, up to 86400; 0, less or NaN: nothing is run, as at first
   Returns what the thread allowed before. */
KOKSMA_API double koksma_allow_exec(double seconds);

/* Returns whether koksma_generate_range serves a pattern with these parameters. */
KOKSMA_API bool koksma_has_ranges(const koksma_spec *spec);

/* No point of a range has a number above this. With KOKSMA_MAX_DIM its coordinates still have numbers of 64 bits. */
#define KOKSMA_MAX_INDEX (((uint64_t)1 << 51) - 1)

/* Generates points first .. first + out->n - 1 of those that koksma_generate makes, in time and memory for out->n points.
     spec   a pattern that has ranges (koksma_has_ranges). Of a sequence (KOKSMA_CLAIM_SEQUENCE) any points up to
            KOKSMA_MAX_INDEX; sequences of 32-bit words end at 2^32 - 1, and radical inverses in base b at the largest
            power of b up to 2^53
     n      of a set that is no sequence: how many points the whole has; its last is n - 1. Unused for a sequence
     first  the index of the first point wanted, from 0
     out    initialised by koksma_points_init with the number of points that are wanted
   Errors: those of koksma_generate; N also for points past the end, UNSUPPORTED for a pattern without ranges. */
KOKSMA_API koksma_status koksma_generate_range(const koksma_spec *spec, uint64_t seed, uint64_t n, uint64_t first,
                                               const koksma_run *run, koksma_points *out);

/* Generates n points and writes them as koksma_points_write does: of a pattern that has ranges piece by piece, in a few
   megabytes for any n; of others as one set, which n and dim have to fit.
     first  the index of the first point; above 0 for sequences that have ranges
     path, comment  as of koksma_points_write
   Errors: those of koksma_generate_range and of koksma_points_write. */
KOKSMA_API koksma_status koksma_generate_write(const koksma_spec *spec, uint64_t seed, uint64_t first, uint64_t n,
                                               int dim, const char *path, const char *comment, const koksma_run *run);

/* Generates all points of a pattern that decides their number: those of a file, or of a maximal Poisson disk set of a
   given radius. Allocates out.
     dim  dimensions; 0: as many as the file has
   Errors: those of koksma_generate; N for a pattern that accepts any n. */
KOKSMA_API koksma_status koksma_generate_whole(const koksma_spec *spec, uint64_t seed, const koksma_run *run, int dim,
                                               koksma_points *out);

/* ---- Measures ----------------------------------------------------------------------------------------- */

enum { KOKSMA_WITNESS_DIM = 16 }; /* above 16 dimensions the witness has kind NONE */

typedef enum koksma_witness_kind {
    KOKSMA_WITNESS_NONE,
    KOKSMA_WITNESS_BOX,        /* sides lo[k] .. hi[k] */
    KOKSMA_WITNESS_HALF_PLANE, /* lo[0] x + lo[1] y <= hi[0]; in 3D a half-space: + lo[2] z */
    KOKSMA_WITNESS_DISK        /* centre lo[0], lo[1], radius hi[0] */
} koksma_witness_kind;

/* The region where a measure reaches its supremum. Anyone can check it by counting points, in doubles:
     box         compare each coordinate with lo and hi. The sides at 0 of a box of the star discrepancy belong to it
     half-plane  compare lo[0] x + lo[1] y (+ lo[2] z) with hi[0]
     disk        compare a a + b b with hi[0] hi[0]; (a, b) is the difference from the centre on the torus: with d the
                 plain difference of a coordinate, a = d - round(d)
   Bounds are rounded such that points on the boundary are counted as `closed` says; volume is the unrounded one. */
typedef struct koksma_witness {
    koksma_witness_kind kind;
    int dim;
    bool closed;   /* true: points on the boundary count (an excess); false: they do not (a deficit) */
    size_t count;  /* points in the region; |count / n - volume| is the value of the measure */
    double volume; /* of the region, 0 to 1 */
    double lo[KOKSMA_WITNESS_DIM], hi[KOKSMA_WITNESS_DIM];
} koksma_witness;

/* The result of a measure. */
typedef struct koksma_value {
    double value;          /* the measure; for an L2 measure the root of the mean square */
    double square;         /* its square, where that is known to more digits; else NaN */
    double lower, upper;   /* proven bounds; both equal value if exact is true */
    double standard_error; /* of a sampled measure, NaN with one sample; else 0 */
    bool exact;            /* value is exact up to rounding */
    koksma_witness witness;
} koksma_value;

/* The regions over which a measure compares count and volume. Known rates of decay depend on the kind. */
typedef enum koksma_family {
    KOKSMA_FAMILY_NONE, /* no regions: distances, the quality of a digital net */
    KOKSMA_FAMILY_BOXES,
    KOKSMA_FAMILY_EDGES,
    KOKSMA_FAMILY_DISKS
} koksma_family;

/* What kind of number a measure gives. */
typedef enum koksma_answer {
    KOKSMA_ANSWER_EXACT,   /* the value; after a time limit proven bounds, with exact = false */
    KOKSMA_ANSWER_SAMPLED, /* an estimate with a standard error */
    KOKSMA_ANSWER_BOUND    /* a lower bound only */
} koksma_answer;

struct koksma_measure {
    const char *name, *title, *cite, *cost; /* cost: "n log n", "n^2 d" */
    koksma_family family;
    int min_dim, max_dim;
    const koksma_param *params; /* NULL: none */
    koksma_status (*eval)(const koksma_points *points, const koksma_args *args, koksma_value *out);
    koksma_answer answer;
    bool larger_is_better; /* a distance; for all other measures smaller means more even */
    int revision;          /* 0, and one more with every change of any bit of its values, as of a pattern */
    bool on_torus;         /* shifting all points on the torus does not change it */
    /* The square of the measure and its n * dim derivatives by the coordinates, for args->run as eval; where two points
       or a point and a plane coincide at which it has a kink, a value between those of the sides. NULL: it has no
       derivative, or none is known. */
    koksma_status (*gradient)(const koksma_points *points, const koksma_args *args, double *square, double *gradient);
};

/* Returns measure i of the table, or the measure with this name; NULL if there is none. */
KOKSMA_API const koksma_measure *koksma_measure_at(size_t i);
KOKSMA_API const koksma_measure *koksma_measure_find(const char *name);

enum { KOKSMA_MAX_LOCAL_GRID = 4096 };

/* Computes the local discrepancy at a corner x: the fraction of points in [0, x) minus the volume of that box;
   positive where there are too many points. The supremum of its absolute value is the star discrepancy. O(n dim).
     x  points->dim coordinates in [0,1]
   Errors: ARGUMENT (a NULL, no points, a coordinate outside [0,1]). */
KOKSMA_API koksma_status koksma_local_discrepancy(const koksma_points *points, const double *x, double *out);

/* Computes the local discrepancy of 2D points at the centres of side x side cells. O(n + side^2).
     side  1 to KOKSMA_MAX_LOCAL_GRID
     out   side * side numbers: out[j * side + k] is at x = (k + 1/2) / side, y = (j + 1/2) / side
   Errors: ARGUMENT, DIM. */
KOKSMA_API koksma_status koksma_local_discrepancy_grid(const koksma_points *points, size_t side, double *out);

/* Evaluates a measure.
     spec    a measure
     points  1 or more points in the closed unit cube, of min_dim to max_dim dimensions
   Costs are in koksma_measure.cost and printed by `koksma list measures`.
   Errors: ARGUMENT (no measure, a bad parameter, no points, a coordinate outside [0,1]), N (too many points for the
   method), DIM, MEMORY, INTERRUPTED. A time limit is no error: see koksma_run. */
KOKSMA_API koksma_status koksma_evaluate(const koksma_spec *spec, const koksma_points *points, const koksma_run *run,
                                         koksma_value *out);

#ifdef __cplusplus
}
#endif

#endif
