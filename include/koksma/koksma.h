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
 *   Errors     A function that can fail returns a koksma_status, KOKSMA_OK (0) for success. "Errors:" in its comment
 *              lists the other statuses that it returns, without the prefix KOKSMA_; every function may also return
 *              ARGUMENT. After an error koksma_error_text() returns one line that names the object and the reason. If
 *              a function of the caller fails, its status is returned; the text is the one that it left by a call of
 *              the library, or else names it. A number that is no status becomes ARGUMENT. After an error each result
 *              is unchanged or zero, unless the function's comment says otherwise; but arrays of the caller's that a
 *              function fills (the coordinates of points that it generates, ranks of masks, values) may be partly
 *              overwritten.
 *   Results    go through out-pointers, which are the last parameters.
 *   Pointers   must not be NULL unless the comment says "may be NULL". For a NULL pointer a function returns
 *              ARGUMENT. A function without a status then returns NULL, NaN, 0 or false, or does nothing, and also
 *              sets koksma_error_text(). The caller must ensure that pointers are valid and that arrays have as
 *              many members as their counts say.
 *   Memory     The caller owns every struct. koksma_NOUN_init, and functions whose comment says "allocates", take
 *              memory that koksma_NOUN_fini frees; koksma_NOUN_close frees what koksma_NOUN_open allocates.
 *              koksma_NOUN_fini and koksma_NOUN_close accept NULL.
 *   Threads    Any function may be called from several threads at once, on different objects. Read-only arguments
 *              may be shared. A function that takes a koksma_run uses up to koksma_run.threads threads; other
 *              functions use one.
 *   Bits       Equal arguments give equal bits for any number of threads, any instruction set of the processor
 *              (koksma_instruction_set) and any locale; numbers in texts have a decimal point.
 *   State      No function prints, exits or keeps state between calls, except that each thread keeps its
 *              koksma_error_text() and koksma_allow_exec(), and the process its instruction set and its plugins
 *              (koksma/plugin.h).
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

#if defined(_WIN32) && defined(KOKSMA_BUILD)
#define KOKSMA_API __declspec(dllexport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define KOKSMA_API __attribute__((visibility("default")))
#else
#define KOKSMA_API
#endif
#if defined(__MINGW32__) && !defined(__clang__)
#define KOKSMA_PRINTF(text, first) __attribute__((__format__(__gnu_printf__, text, first)))
#elif defined(__GNUC__)
#define KOKSMA_PRINTF(text, first) __attribute__((__format__(__printf__, text, first)))
#else
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

/* Returns the general meaning of a status, a constant string such as "a file is malformed". Accepts any value. */
KOKSMA_API const char *koksma_status_text(koksma_status status);

/* Returns the exit code that the program `koksma` uses for a status: 0, 2, 3, 4 or 130. */
KOKSMA_API int koksma_status_exit_code(koksma_status status);

/* Returns the message of this thread's last failed call: one line, without a newline, that names the object and the
   reason. The string is valid until the next failing call of this thread; it is empty if no call has failed. */
KOKSMA_API const char *koksma_error_text(void);

/* A function that returns name i of a table, or NULL past the last name. */
typedef const char *koksma_name_at(const void *table, size_t i);

/* Returns the name in a table that is most similar to a misspelt word, for "did you mean" messages, or NULL if no name
   is similar, or if the word is empty or longer than 64 characters. Upper and lower case are equal.
     name, table  name(table, i) is called for i = 0, 1, ... until it returns NULL; table may be NULL */
KOKSMA_API const char *koksma_closest_name(const char *word, koksma_name_at *name, const void *table);
/* Turns a text into one line of valid UTF-8: control characters and bytes that are not UTF-8, which a file name may
   contain, become \xNN. The library does the same with every error text. size is the capacity of the buffer `text` in
   bytes; a result that does not fit is cut. text may be NULL. */
KOKSMA_API void koksma_text_escape(char *text, size_t size);

/* Returns the instruction set that the inner loops of this process use: "avx512", "avx2", "baseline" or "ref"
   (plain C, for tests). The library uses the first one that the processor supports, unless the environment variable
   KOKSMA_KERNELS names another; the first call that computes reads this variable, and ignores unknown names. "avx512",
   "avx2" and "baseline" give the same bits; "ref" may differ in the last digits of the L2 measures and diaphony. */
KOKSMA_API const char *koksma_instruction_set(void);

/* Returns the version of the library at run time, such as "0.1.0". KOKSMA_VERSION is the version of the header. */
KOKSMA_API const char *koksma_version(void);

/* ---- Long calls --------------------------------------------------------------------------------------- */

/* Threads, time limit and cancellation of a call that may take long. A parameter of this type may be NULL: the call
   then uses all processors and has no time limit and no callback. */
typedef struct koksma_run {
    int threads;         /* largest number of threads to use; 0: one for each processor */
    double time_limit_s; /* time limit in seconds; 0: none. The measures star-lower, extreme, edge, disk and, from 3
                            dimensions on, star then return bounds (koksma_value.exact is false). Other measures and
                            functions ignore it, unless their comments say what it does */
    bool (*keep_going)(void *context, double fraction_done); /* callback that is called from time to time, on the
                                                                calling thread only; if it returns false, the call
                                                                ends with INTERRUPTED. May be NULL */
    void *context;                                           /* passed to keep_going */
} koksma_run;

/* ---- Points ------------------------------------------------------------------------------------------- */

/* n points of dim coordinates each: point i is xs[i * dim] .. xs[i * dim + dim - 1]. Patterns generate coordinates
   in [0,1); measures accept coordinates in [0,1]. */
typedef struct koksma_points {
    size_t n;
    int dim;
    double *xs;
} koksma_points;

enum { KOKSMA_MAX_DIM = 4096 };

/* Largest number of coordinates n * dim of one set: 2^28, which are 2 GiB of doubles, or 2^24 on machines with
   32-bit sizes. No method needs more than 255 bytes for each coordinate, so no buffer size overflows on these
   machines. */
#define KOKSMA_MAX_COORDINATES ((size_t)1 << (sizeof(size_t) > 4 ? 28 : 24))

/* Allocates n points of dim coordinates, all zero.
     points  receives the points; old content is overwritten, not freed
     n       at least 1, with n * dim at most KOKSMA_MAX_COORDINATES
     dim     1 to KOKSMA_MAX_DIM
   Errors: ARGUMENT (n), DIM (dim), MEMORY. */
KOKSMA_API koksma_status koksma_points_init(koksma_points *points, size_t n, int dim);

/* Frees the coordinates and zeroes the struct. points may be NULL, or zeroed. */
KOKSMA_API void koksma_points_fini(koksma_points *points);

/* Reads points from a file; allocates points.
     path  a .npy file, recognised by its content, or text: one point a line, coordinates separated by blanks, tabs or
           commas, `#` starts a comment up to the end of the line, one CSV header line is allowed. "-" is standard input
   Every row needs the same number of coordinates, all in [0,1].
   Errors: MISSING, MALFORMED (names file, line and reason), MEMORY. */
KOKSMA_API koksma_status koksma_points_read(const char *path, koksma_points *points);

/* Reads points like koksma_points_read, but accepts all finite coordinates, such as those that koksma_points_write_mapped
   wrote or that another library scales to [-1,1]. */
KOKSMA_API koksma_status koksma_points_read_mapped(const char *path, koksma_points *points);

/* Writes points to a file, completely or not at all.
     path     its ending selects the format: .csv, .npy, or text for any other ending. "-" writes text to standard
              output
     points   coordinates in [0,1]
     comment  written as lines that start with "# " in text files; may be NULL
   Numbers are printed with 17 significant digits, so that they read back to the same bits (-0 as 0).
   Errors: ARGUMENT (no points, a coordinate outside [0,1]), DIM, IO, INTERRUPTED. */
KOKSMA_API koksma_status koksma_points_write(const char *path, const koksma_points *points, const char *comment,
                                             const koksma_run *run);

/* Writes points like koksma_points_write, but accepts all finite coordinates, such as those of points that a warp
   has mapped. Errors: ARGUMENT (no points, a coordinate that is not finite), IO, INTERRUPTED. */
KOKSMA_API koksma_status koksma_points_write_mapped(const char *path, const koksma_points *points,
                                                    const char *comment, const koksma_run *run);

/* Says what in points looks like a mistake of whoever made them, though it can be measured: a column that is constant,
   counts the rows, has only 0 and 1, sums to 1 or is narrower than chance, equal points (among at most 65,536), rows and
   columns swapped.
     text  receives a line for each remark, as many as fit; "" if there are none
     room  size of text in bytes; 4096 is plenty
   Returns the number of remarks. */
KOKSMA_API size_t koksma_points_oddities(const koksma_points *points, char *text, size_t room);

/* ---- Parameters and specs ----------------------------------------------------------------------------- */

/* A parameter of a pattern or measure. An array of parameters ends at a member whose name is NULL. */
typedef struct koksma_param {
    const char *name, *help;
    double fallback, min, max;  /* default value and closed range. If choices is not NULL, these are indices into
                                   choices */
    const char *const *choices; /* the words that the parameter accepts, ended by NULL; NULL if the parameter is a
                                   number */
    bool whole;                 /* true: the parameter accepts only whole numbers */
} koksma_param;

enum { KOKSMA_MAX_PARAMS = 8, KOKSMA_MAX_MODIFIERS = 8, KOKSMA_MAX_SPEC = 512 };

/* The arguments of the function of a pattern or measure: the parameters in the order of its table, and the
   koksma_run of the call. */
typedef struct koksma_args {
    double params[KOKSMA_MAX_PARAMS];
    const char *path;      /* path of the file of a pattern that reads one; otherwise NULL */
    const koksma_run *run; /* may be NULL */
    /* for a pattern that has ranges: index of the first point to generate, and the size of the whole set (0 for a
       sequence); otherwise both are 0 */
    uint64_t first, n;
} koksma_args;

typedef struct koksma_pattern koksma_pattern;
typedef struct koksma_measure koksma_measure;

/* A pattern or a measure with its parameters: the meaning of a text such as "poisson-disk:d=0.2". Plain data without
   pointers to free; copy it freely. */
typedef struct koksma_spec {
    const koksma_pattern *pattern; /* exactly one of pattern and measure is not NULL */
    const koksma_measure *measure;
    double params[KOKSMA_MAX_PARAMS];
    char path[KOKSMA_MAX_SPEC];             /* path of the file of a pattern that reads one */
    double modifiers[KOKSMA_MAX_MODIFIERS]; /* values of the modifiers of a pattern, in the order of
                                               koksma_modifier_at; 0: not applied */
} koksma_spec;

/* Parses a spec: "name" or "name:key=value,key=value".
   Every pattern also accepts the modifiers, such as shift=1: all points are shifted on the torus by one random vector.
   If the spec has a path, modifiers follow the path, as in "file:set.txt,shift=1". An alias is replaced by the
   pattern that it names.
   Errors: ARGUMENT (a parameter; the message names it and what it accepts), UNKNOWN (the name; the message suggests
   the nearest one). */
KOKSMA_API koksma_status koksma_pattern_spec(const char *text, koksma_spec *spec);
KOKSMA_API koksma_status koksma_measure_spec(const char *text, koksma_spec *spec);

/* Writes the canonical text of a spec: its parameters and modifiers in table order, without those at their
   defaults. Studies store results under this text.
     text  KOKSMA_MAX_SPEC characters; empty if the spec has neither a pattern nor a measure */
KOKSMA_API void koksma_spec_text(const koksma_spec *spec, char *text);

/* ---- Patterns ----------------------------------------------------------------------------------------- */

/* Properties that a pattern claims, KOKSMA_CLAIM_DETERMINISTIC and so on: <koksma/claims.def> has their meanings. They
   hold for the default values of the pattern's own parameters; other values may break them, as columns=2 breaks
   STRATIFIED. The test of a claim runs for every pattern that makes the claim. */
enum {
#define KOKSMA_CLAIM(id, bit, name, meaning) KOKSMA_CLAIM_##id = 1u << (bit),
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
    KOKSMA_CLAIM_NONE = 0
};

struct koksma_pattern {
    const char *name, *title, *cite; /* cite: keys of docs/references.bib, separated by blanks */
    int min_dim, max_dim;            /* smallest and largest dimension that the pattern accepts */
    unsigned claims;
    const koksma_param *params; /* NULL: none */
    koksma_status (*generate)(uint64_t seed, const koksma_args *args, koksma_points *out);
    const char *operand;  /* name of what follows the colon of its spec, such as PATH; NULL: parameters only */
    const char *alias_of; /* name of the pattern for which this entry is an alias (NULL: not an alias) */
    /* For a pattern whose parameters determine the number of points: allocates all points (koksma_generate_whole).
       The caller sets out->dim; 0: any dimension. The function returns N if these parameters do not determine the
       number. NULL for other patterns. */
    koksma_status (*whole)(uint64_t seed, const koksma_args *args, koksma_points *out);
    int revision; /* starts at 0 and increases by 1 with every change of any bit of the points; studies store it
                     with their rows */
    /* Returns whether, with these parameters, each point can be computed from its index alone, so that
       koksma_generate_range works. NULL: the pattern has no ranges. */
    bool (*ranges)(const double *params);
    /* true: the pattern runs the program or library that its operand names, if koksma_allow_exec permits */
    bool runs_code;
};

/* A modifier: a map of the unit cube to itself that every pattern accepts after its own parameters. Several modifiers
   are applied in the order of koksma_modifier_at. In a renderer each pixel has a seed, so a random modifier differs
   between pixels. */
typedef struct koksma_modifier {
    const char *name, *title, *cite;
    double min, max;        /* range of its value, a whole number; the value 0 means not applied */
    bool random;            /* true: the map depends on the seed */
    unsigned claims;        /* claims of a pattern that remain true after the modifier */
    unsigned claims_binary; /* claims of a pattern that remain true after the modifier if n is a power of 2 */
    unsigned gives;         /* claims that are true for the points of any pattern after the modifier */
    /* names, separated by blanks, of the measures whose values the modifier changes only by rounding; "*": all exact
       measures */
    const char *measures;
    const char *keeps; /* description of what the modifier preserves */
} koksma_modifier;

/* Returns modifier i of the table, or NULL if there is none. */
KOKSMA_API const koksma_modifier *koksma_modifier_at(size_t i);

/* Returns pattern i of the table, or the pattern with this name, or NULL if there is none. */
KOKSMA_API const koksma_pattern *koksma_pattern_at(size_t i);
KOKSMA_API const koksma_pattern *koksma_pattern_find(const char *name);

/* Generates out->n points of out->dim coordinates in [0,1).
     spec  a pattern
     seed  any number; the points depend only on spec, seed, n and dim
     out   points initialised by koksma_points_init with the required n and dim
   The function never generates fewer than n points and always ends. Most patterns take O(n dim), blue noise up to
   O(n^2).
   Errors: N, DIM, ARGUMENT (the pattern does not accept this n, dim or parameter; the message says what would work),
   IMPOSSIBLE (no such set exists, or none was found), MEMORY, INTERRUPTED; for patterns with a path MISSING and
   MALFORMED; for patterns that run code also FORBIDDEN and SYSTEM. */
KOKSMA_API koksma_status koksma_generate(const koksma_spec *spec, uint64_t seed, const koksma_run *run,
                                         koksma_points *out);

/* Allows the calling thread, and the threads that its calls start, to run the code that the patterns exec:PROGRAM
   and plugin:LIBRARY name, also if a plan or a scene contains the spec. Without this permission these patterns fail
   with FORBIDDEN.
     seconds  time limit of a program for each set, up to 86400; 0 (the initial value), negative or NaN: run no code
   Returns the previous value of `seconds` of this thread. */
KOKSMA_API double koksma_allow_exec(double seconds);

/* Returns whether a pattern with these parameters gives the same points for every seed: it claims DETERMINISTIC, and
   neither a random modifier, nor a parameter scramble or shuffle, nor {seed} in the path of a file makes it random. A
   mean over the seeds of such a pattern is the value of one set. False for the spec of a measure. */
KOKSMA_API bool koksma_has_one_set(const koksma_spec *spec);

/* Returns whether a pattern with these parameters is unbiased: the pattern or a modifier claims UNBIASED, or a
   parameter scramble or torus, which makes each point uniform, is set. The mean over the points is then right in the
   mean over the seeds, for every integrand. The other patterns are not known to be: what they have of bias is in the
   error of each trial, and no number of trials averages it away. False for the spec of a measure. */
KOKSMA_API bool koksma_is_unbiased(const koksma_spec *spec);

/* Returns whether, for every k <= n, the first k of n points of a pattern are its set of k points: it claims SEQUENCE,
   and has no {n} in the path of a file, which names another file for each n. False for the spec of a measure. */
KOKSMA_API bool koksma_is_sequence(const koksma_spec *spec);

/* Returns whether koksma_generate_range supports a pattern with these parameters. */
KOKSMA_API bool koksma_has_ranges(const koksma_spec *spec);

/* Largest index of a point in a range. Even with KOKSMA_MAX_DIM dimensions the indices of its coordinates fit in 64
   bits. */
#define KOKSMA_MAX_INDEX (((uint64_t)1 << 51) - 1)

/* Generates points first .. first + out->n - 1 of the set of koksma_generate, in the time and memory of out->n
   points.
     spec   a pattern that has ranges (koksma_has_ranges). A sequence (KOKSMA_CLAIM_SEQUENCE) accepts indices up to
            KOKSMA_MAX_INDEX. In many dimensions halton and faure end earlier: at the largest power of their largest
            base that is at most 2^53, because a double has no more digits. Without modifiers, sobol and pmj02 have
            coordinates of 32 binary digits up to point 2^32 - 1, and of 53 from point 2^32 on
     n      number of points of the whole set, whose last index is n - 1. Unused for a sequence
     first  index of the first point to generate, from 0
     out    points initialised by koksma_points_init with the number of points to generate
   Errors: those of koksma_generate; also N for points past the end of the set, and UNSUPPORTED for a pattern without
   ranges. */
KOKSMA_API koksma_status koksma_generate_range(const koksma_spec *spec, uint64_t seed, uint64_t n, uint64_t first,
                                               const koksma_run *run, koksma_points *out);

/* Generates many sets in one call: set s of `sets` is that of koksma_generate with the seed `seed` + s, and is points
   s m .. s m + m - 1 of `out`, m = out->n / sets. Threads share the sets.
     sets  at least 1; divides out->n
   Errors: those of koksma_generate, of the set that failed first. */
KOKSMA_API koksma_status koksma_generate_sets(const koksma_spec *spec, uint64_t seed, size_t sets,
                                              const koksma_run *run, koksma_points *out);

/* Generates n points and writes them as koksma_points_write does. A pattern that has ranges is generated piece by
   piece in a few megabytes of memory for any n; another pattern is generated as one set, so n * dim is at most
   KOKSMA_MAX_COORDINATES.
     first  index of the first point; may be above 0 only for sequences that have ranges
     path, comment  as for koksma_points_write
   Errors: those of koksma_generate_range and of koksma_points_write. */
KOKSMA_API koksma_status koksma_generate_write(const koksma_spec *spec, uint64_t seed, uint64_t first, uint64_t n,
                                               int dim, const char *path, const char *comment, const koksma_run *run);

/* Generates all points of a pattern that determines their number itself, such as a file or a maximal Poisson disk
   set of a given radius. Allocates out.
     dim  number of dimensions; 0: as many as the file has
   Errors: those of koksma_generate; N for a pattern that accepts any n. */
KOKSMA_API koksma_status koksma_generate_whole(const koksma_spec *spec, uint64_t seed, const koksma_run *run, int dim,
                                               koksma_points *out);

/* ---- Measures ----------------------------------------------------------------------------------------- */

enum { KOKSMA_WITNESS_DIM = 16 }; /* a witness with more than 16 dimensions has kind NONE */

typedef enum koksma_witness_kind {
    KOKSMA_WITNESS_NONE,
    KOKSMA_WITNESS_BOX,        /* sides lo[k] .. hi[k] */
    KOKSMA_WITNESS_HALF_PLANE, /* lo[0] x + lo[1] y <= hi[0]; in 3D a half-space: + lo[2] z */
    KOKSMA_WITNESS_DISK        /* centre lo[0], lo[1], radius hi[0] */
} koksma_witness_kind;

/* The region where a measure reaches its supremum. To check it, count the points in the region with doubles:
     box         compare each coordinate with lo and hi. A box of the star discrepancy contains the points on its
                 sides at 0, whether it is closed or not
     half-plane  compare lo[0] x + lo[1] y (+ lo[2] z) with hi[0]
     disk        compare a a + b b with hi[0] hi[0]; (a, b) is the difference from the centre on the torus: with d the
                 plain difference of a coordinate, a = d - round(d)
   The bounds lo and hi are rounded such that the comparison treats points on the boundary as `closed` says; volume
   is that of the region before rounding. */
typedef struct koksma_witness {
    koksma_witness_kind kind;
    int dim;
    bool closed;   /* true: points on the boundary count (an excess); false: they do not (a deficit) */
    size_t count;  /* points in the region; |count / n - volume| is the value of the measure */
    double volume; /* volume of the region, 0 to 1 */
    double lo[KOKSMA_WITNESS_DIM], hi[KOKSMA_WITNESS_DIM];
} koksma_witness;

/* The result of a measure. */
typedef struct koksma_value {
    double value;          /* the measure; for an L2 measure a root: koksma_measure.title says of what */
    double square;         /* square of value, if it is known to more digits than value; otherwise NaN */
    double lower, upper;   /* proven bounds, both equal to `value` if exact is true; NaN for a sampled measure */
    double standard_error; /* standard error of a sampled measure, NaN with one sample; 0 for other measures */
    bool exact;            /* true: value is exact up to rounding */
    koksma_witness witness;
} koksma_value;

/* The kind of regions in which a measure compares the fraction of the points with the volume. The proven rates at
   which measures decrease with n (koksma_rate) depend on this kind. */
typedef enum koksma_family {
    KOKSMA_FAMILY_NONE, /* the measure has no regions: a distance, or the quality of a digital net */
    KOKSMA_FAMILY_BOXES,
    KOKSMA_FAMILY_EDGES,
    KOKSMA_FAMILY_DISKS
} koksma_family;

/* The kind of number that a measure returns. */
typedef enum koksma_answer {
    KOKSMA_ANSWER_EXACT,   /* the exact value; if a time limit ends the computation, proven bounds with exact =
                              false */
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
    bool larger_is_better; /* true for distances; for all other measures a smaller value means more even points */
    int revision;          /* starts at 0 and increases by 1 with every change of any bit of the values */
    bool on_torus;         /* true: shifting all points on the torus does not change the value */
    /* Computes the square of the measure and its n * dim derivatives with respect to the coordinates. At a kink,
       where coordinates coincide, the derivative is a value between the one-sided derivatives. NULL: the measure has
       no derivative, or the library does not implement it. */
    koksma_status (*gradient)(const koksma_points *points, const koksma_args *args, double *square, double *gradient);
};

/* Returns measure i of the table, or the measure with this name, or NULL if there is none. */
KOKSMA_API const koksma_measure *koksma_measure_at(size_t i);
KOKSMA_API const koksma_measure *koksma_measure_find(const char *name);

enum { KOKSMA_MAX_LOCAL_GRID = 4096 };

/* Computes the local discrepancy at a corner x: the fraction of points in [0, x) minus the volume of that box;
   positive where there are too many points. The supremum of its absolute value is the star discrepancy. O(n dim).
     x  points->dim coordinates in [0,1]
   Errors: ARGUMENT (a NULL pointer, no points, a coordinate outside [0,1]). */
KOKSMA_API koksma_status koksma_local_discrepancy(const koksma_points *points, const double *x, double *out);

/* Computes the local discrepancy of 2D points at the centres of side x side cells. O(n + side^2).
     side  1 to KOKSMA_MAX_LOCAL_GRID
     out   side * side numbers: out[j * side + k] is at x = (k + 1/2) / side, y = (j + 1/2) / side
   Errors: ARGUMENT, DIM. */
KOKSMA_API koksma_status koksma_local_discrepancy_grid(const koksma_points *points, size_t side, double *out);

/* Evaluates a measure.
     spec    a measure
     points  at least 1 point in the closed unit cube, in min_dim to max_dim dimensions
   koksma_measure.cost has the cost, and `koksma list measures` prints it.
   Errors: ARGUMENT (no measure, a bad parameter, no points, a coordinate outside [0,1]), N (too many points for the
   method, or a number that the measure does not take, as 1 for distances), DIM, MEMORY, INTERRUPTED. A time limit is
   not an error: see koksma_run. */
KOKSMA_API koksma_status koksma_evaluate(const koksma_spec *spec, const koksma_points *points, const koksma_run *run,
                                         koksma_value *out);

/* Evaluates a measure of many sets in one call: values[s] is koksma_value.value of points s m .. s m + m - 1, m =
   points->n / sets, for s < sets. A time limit is that of each set. Threads share the sets.
     sets  at least 1; divides points->n
   Errors: those of koksma_evaluate, of the set that failed first. */
KOKSMA_API koksma_status koksma_evaluate_sets(const koksma_spec *spec, const koksma_points *points, size_t sets,
                                              const koksma_run *run, double *values);

#ifdef __cplusplus
}
#endif

#endif
