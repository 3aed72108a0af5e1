/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Koksma: sampling patterns, and exact measures of how irregular they are.
 *
 * The whole library in a page: look a pattern up (or parse a spec such as "poisson-disk:d=0.2"), generate
 * points with it, look a measure up, evaluate it.
 *
 *     koksma_points points;
 *     koksma_spec spec;
 *     koksma_value value;
 *     if (koksma_points_init(&points, 16, 2) || koksma_pattern_spec("n-rooks", &spec) ||
 *         koksma_generate(&spec, 7, NULL, &points))
 *         puts(koksma_error_text());
 *     koksma_spec star;
 *     koksma_measure_spec("star", &star);
 *     koksma_evaluate(&star, &points, NULL, &value);
 *     koksma_points_fini(&points);
 *
 * Every function that can fail returns a koksma_status, and leaves a line that names the thing and the reason
 * in koksma_error_text(). Results come through out-pointers, last. Nothing here prints, exits or keeps global
 * state; all functions may be called from several threads at once on different objects.
 * Equal arguments give equal bits, on any number of threads and in any locale: numbers in texts have a point.
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

/* The general meaning of a status: a constant string. */
KOKSMA_API const char *koksma_status_text(koksma_status status);

/* The exit code that the program gives for a status (0, 2, 3, 4 or 130). */
KOKSMA_API int koksma_status_exit_code(koksma_status status);

/* What the last failed call of this thread has to say: one line without a newline that names the thing and the
   reason. Valid until this thread's next failing call. */
KOKSMA_API const char *koksma_error_text(void);

/* The instruction set whose inner loops run in this process: "avx512", "avx2", "baseline" or "ref", the reference
   twins. It is the first of these that the machine has; or the one that KOKSMA_KERNELS names in the environment of
   the first call that computes, unless it names none that the machine has. The first three give the same bits; of a
   few measures "ref" may give other last digits. */
KOKSMA_API const char *koksma_instruction_set(void);

/* The library's version, equal to KOKSMA_VERSION of the header it was built with. */
KOKSMA_API const char *koksma_version(void);

/* ---- Long calls --------------------------------------------------------------------------------------- */

/* How to run a call that may be long. NULL wherever it is taken means: all threads, no limit, no questions. */
typedef struct koksma_run {
    int threads;         /* 0: as many as there are processors */
    double time_limit_s; /* 0: none. A measure that is cut short gives bounds, and says so */
    bool (*keep_going)(void *context, double fraction_done); /* may be NULL; false stops: INTERRUPTED.
                                                                 Called from the calling thread only */
    void *context;
} koksma_run;

/* ---- Points ------------------------------------------------------------------------------------------- */

/* n points of dim coordinates; point i is xs[i*dim] .. xs[i*dim + dim-1]. Generators give coordinates in [0,1);
   measures take the closed [0,1]. */
typedef struct koksma_points {
    size_t n;
    int dim;
    double *xs;
} koksma_points;

enum { KOKSMA_MAX_DIM = 4096 };

/* The most coordinates one set may have: 2 GiB of doubles. Where a size has 32 bits 128 MiB, so that a method's
   buffers, less than 256 bytes for each coordinate, don't overflow it. */
#define KOKSMA_MAX_COORDINATES ((size_t)1 << (sizeof(size_t) > 4 ? 28 : 24))

/* Room for n points of dim coordinates, all zero. n = 0 is an error, as is more than KOKSMA_MAX_COORDINATES.
   Errors: ARGUMENT, DIM, MEMORY. */
KOKSMA_API koksma_status koksma_points_init(koksma_points *points, size_t n, int dim);

/* Frees what init or read allocated; takes a zeroed struct and NULL. */
KOKSMA_API void koksma_points_fini(koksma_points *points);

/* Reads .npy (by content) or text: one point a line, separated by blanks, commas or tabs, `#` comments, an
   optional CSV header. path "-" is standard input. Coordinates outside [0,1], NaN, ragged rows and empty files
   are errors that name file, line and reason. Allocates points. Errors: MISSING, MALFORMED, MEMORY. */
KOKSMA_API koksma_status koksma_points_read(const char *path, koksma_points *points);

/* Writes by the ending of the path: .csv, .npy, anything else text; "-" is text on standard output. Files are
   written whole or not at all. comment (may be NULL) becomes `# ` lines of text files. Numbers are %.17g: they
   read back to the same bits (-0 as 0). One thread; run (may be NULL) is asked whether to go on. Errors: ARGUMENT
   (no points, a coordinate outside [0,1]), DIM, IO, INTERRUPTED. */
KOKSMA_API koksma_status koksma_points_write(const char *path, const koksma_points *points, const char *comment,
                                             const koksma_run *run);

/* The same of numbers that need not be in [0,1], such as points mapped by a warp: any finite ones. Errors: ARGUMENT
   (none, or one that is not finite), IO, INTERRUPTED. */
KOKSMA_API koksma_status koksma_points_write_mapped(const char *path, const koksma_points *points,
                                                    const char *comment, const koksma_run *run);

/* ---- Parameters and specs ----------------------------------------------------------------------------- */

/* A parameter of a pattern or measure; tables of them end at a NULL name. */
typedef struct koksma_param {
    const char *name, *help;
    double fallback, min, max;  /* the default and the closed range; with choices, of their index */
    const char *const *choices; /* NULL, or the words that it takes, ending at NULL; the value is the index */
    bool whole;                 /* only whole numbers */
} koksma_param;

enum { KOKSMA_MAX_PARAMS = 8, KOKSMA_MAX_SPEC = 512 };

/* What a table member's function gets beside its points: its parameters in table order, and how to run. */
typedef struct koksma_args {
    double params[KOKSMA_MAX_PARAMS];
    const char *path;      /* the text after the colon for members that take a file; else NULL */
    const koksma_run *run; /* may be NULL */
} koksma_args;

typedef struct koksma_pattern koksma_pattern;
typedef struct koksma_measure koksma_measure;

/* A member of a table with its parameters: what "poisson-disk:d=0.2" means. Plain data; copy it freely. */
typedef struct koksma_spec {
    const koksma_pattern *pattern; /* exactly one of pattern and measure is not NULL */
    const koksma_measure *measure;
    double params[KOKSMA_MAX_PARAMS];
    char path[KOKSMA_MAX_SPEC]; /* for members that take a file */
    bool shift;                 /* patterns: the points are shifted on the torus by one random vector */
} koksma_spec;

/* Parses "name" or "name:key=value,key=value". Errors (ARGUMENT, UNKNOWN) name the key and what it takes.
   Every pattern takes shift=1 beside its own parameters (for file: as the end ",shift=1"): the random toroidal shift
   of Cranley & Patterson (1976), uniform in [0,1)^dim and the same for all points of a set. An alias becomes the
   pattern that it names. */
KOKSMA_API koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec);
KOKSMA_API koksma_status koksma_measure_spec(const char *text, koksma_spec *spec);

/* The canonical text of a spec: parameters in table order, those at their default left out. This is the key under
   which results are stored; empty for a spec of neither. text has room for KOKSMA_MAX_SPEC characters. */
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
    int min_dim, max_dim;
    unsigned claims;
    const koksma_param *params; /* NULL: none */
    koksma_status (*generate)(uint64_t seed, const koksma_args *args, koksma_points *out);
    bool takes_path;      /* the spec's text after the colon is a file's path */
    const char *alias_of; /* not NULL: another name for that pattern */
    /* NULL, or for a pattern whose parameters can decide how many points there are: allocates them all into out,
       whose dim is set (0: whichever there is). N when they leave the number open. */
    koksma_status (*whole)(uint64_t seed, const koksma_args *args, koksma_points *out);
};

/* Member i of the table, NULL past the end; by name, NULL if unknown. */
KOKSMA_API const koksma_pattern *koksma_pattern_at(size_t i);
KOKSMA_API const koksma_pattern *koksma_pattern_find(const char *name);

/* Fills out->n points of out->dim coordinates. A pattern that can't serve n, dim or its parameters says which would
   do; it never returns fewer points and never runs for ever. run may be NULL.
   Errors: N, DIM, ARGUMENT, IMPOSSIBLE, MEMORY, INTERRUPTED (for file patterns MISSING and MALFORMED). */
KOKSMA_API koksma_status koksma_generate(const koksma_spec *spec, uint64_t seed, const koksma_run *run,
                                         koksma_points *out);

/* All points of a pattern that knows itself how many there are: a file's, a maximal Poisson disk set's by its
   radius. dim = 0: whichever the file has. Allocates out. Errors: those of koksma_generate; N when the pattern
   takes any n. */
KOKSMA_API koksma_status koksma_generate_whole(const koksma_spec *spec, uint64_t seed, const koksma_run *run, int dim,
                                               koksma_points *out);

/* ---- Measures ----------------------------------------------------------------------------------------- */

enum { KOKSMA_WITNESS_DIM = 16 }; /* regions of more dimensions aren't told: their witness is of the kind NONE */

typedef enum koksma_witness_kind {
    KOKSMA_WITNESS_NONE,
    KOKSMA_WITNESS_BOX,        /* sides lo[k] .. hi[k] */
    KOKSMA_WITNESS_HALF_PLANE, /* lo[0] x + lo[1] y <= hi[0]; of dim 3 a half-space: + lo[2] z */
    KOKSMA_WITNESS_DISK        /* centre lo[0], lo[1], radius hi[0] */
} koksma_witness_kind;

/* The region where a supremum is reached, so that anyone can check it by counting: in doubles, boxes by comparing
   coordinates, half-planes by lo[0] x + lo[1] y (+ lo[2] z), disks by a a + b b against hi[0] hi[0], where a = dx -
   round(dx) and likewise b are the way from the centre on the torus. Bounds are rounded so that points on the
   boundary fall on the side that count has them on; volume is that of the region before. Sides of an anchored box
   (star) at 0 are no boundary: points on them are in. */
typedef struct koksma_witness {
    koksma_witness_kind kind;
    int dim;
    bool closed;  /* count takes the points on the boundary in (an excess), or leaves them out (a deficit) */
    size_t count; /* points in the region; |count/n - volume| is the value */
    double volume;
    double lo[KOKSMA_WITNESS_DIM], hi[KOKSMA_WITNESS_DIM];
} koksma_witness;

typedef struct koksma_value {
    double value;          /* the measure; of a root-mean-square measure the root */
    double square;         /* its square where that is the more exact number, else NaN */
    double lower, upper;   /* certified bounds: both equal value when exact */
    double standard_error; /* of a sampled measure (NaN: of one sample), else 0 */
    bool exact;
    koksma_witness witness;
} koksma_value;

/* The regions that a measure looks at; what theory says about decay goes by them. */
typedef enum koksma_family {
    KOKSMA_FAMILY_NONE, /* another kind of number: distances, digital quality */
    KOKSMA_FAMILY_BOXES,
    KOKSMA_FAMILY_EDGES,
    KOKSMA_FAMILY_DISKS
} koksma_family;

/* What kind of number a measure gives. */
typedef enum koksma_answer {
    KOKSMA_ANSWER_EXACT,   /* the value; one that is cut short gives bounds, with exact = false */
    KOKSMA_ANSWER_SAMPLED, /* an estimate, with a standard error */
    KOKSMA_ANSWER_BOUND    /* a lower bound: nothing more is promised */
} koksma_answer;

struct koksma_measure {
    const char *name, *title, *cite, *cost; /* cost: "n log n", "n^2 d" */
    koksma_family family;
    int min_dim, max_dim;
    const koksma_param *params; /* NULL: none */
    koksma_status (*eval)(const koksma_points *points, const koksma_args *args, koksma_value *out);
    koksma_answer answer;
    bool larger_is_better; /* a distance; of all others smaller is more even */
};

KOKSMA_API const koksma_measure *koksma_measure_at(size_t i);
KOKSMA_API const koksma_measure *koksma_measure_find(const char *name);

enum { KOKSMA_MAX_LOCAL_GRID = 4096 };

/* The local discrepancy at x, a corner of dim coordinates in [0,1]: the share of the points in [0, x) less its
   volume, positive where there are too many. Its supremum is the star discrepancy. O(n dim); any threads. Errors:
   ARGUMENT (a NULL, no points, a coordinate outside [0,1]). */
KOKSMA_API koksma_status koksma_local_discrepancy(const koksma_points *points, const double *x, double *out);

/* The same of points of the plane at the corners ((k + 1/2) / side, (j + 1/2) / side), in out[j * side + k]; side is
   1 to KOKSMA_MAX_LOCAL_GRID. O(n + side^2). Errors: ARGUMENT, DIM. */
KOKSMA_API koksma_status koksma_local_discrepancy_grid(const koksma_points *points, size_t side, double *out);

/* Evaluates a measure. Points must lie in the closed unit cube; n >= 1. run may be NULL.
   Errors: ARGUMENT (no spec of a measure, a parameter that it does not take, no points, a coordinate outside [0,1]),
   N (too many for the method), DIM, MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_evaluate(const koksma_spec *spec, const koksma_points *points, const koksma_run *run,
                                         koksma_value *out);

#ifdef __cplusplus
}
#endif

#endif
