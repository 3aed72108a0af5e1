/* SPDX-License-Identifier: Apache-2.0 */
/* What commands that measure points share: warps, bounds, and the state of `koksma measure`. */
#ifndef KOKSMA_CLI_MEASURING_H
#define KOKSMA_CLI_MEASURING_H

#include <koksma/series.h>
#include <koksma/warp.h>

#include "cli.h"

/* ---- The option --warp: a map of the unit square by its name ------------------------------------------ */

/* Returns the warp of that name, or NULL after an error that lists all names. */
const koksma_warp *cli_find_warp(const cli_args *args, const char *name);

/* Maps 2-dimensional points by the warp. *points becomes the set of mapped points, of the warp's dimension. */
koksma_status cli_map_points(const koksma_warp *warp, koksma_points *points);

/* ---- Values that are only bounds, because the search for the exact value was cut short ---------------- */

/* Returns whether a value is only a bound although its measure gives exact values, because the search was cut
   short. */
bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value);

/* Prints a line on stderr with the number of values of `what` that are only bounds because a search was cut short.
   Prints nothing if there are none, or with --quiet. */
void cli_tell_cuts(const cli_args *args, const char *what, size_t n_cut);

/* ---- The state of `koksma measure`, and measures over many sets or several sizes ---------------------- */

enum { MAX_MEASURES = 64, MAX_PREFIXES = KOKSMA_MAX_SIZES, MAX_WARPS = 16, MAX_PAIRED_TRIALS = 1000000 };

/* Statistics of the values of a measure at a prefix, and of how much they exceed those of the first source, and how many
   of both are exact. */
typedef struct tallied {
    koksma_tally values, differences;
    size_t n_exact, n_exact_pairs;
} tallied;

/* A measure's values for its fitted slope, the number of trials whose values are exact at all prefixes, and of all sources
   the number of values that are only bounds because the search was cut short. */
typedef struct fitted {
    koksma_joint joint;
    size_t n_whole, n_cut;
} fitted;

/* A value of the first source, with which --paired compares. */
typedef struct paired_value {
    double value;
    bool exact;
} paired_value;

/* The option values of `koksma measure`, and the state of its run. */
typedef struct measuring {
    const cli_args *args;
    koksma_spec measures[MAX_MEASURES];
    size_t n_measures;
    bool all;        /* -m all: leave out measures that do not accept a set */
    bool by_default; /* no -m: leave out such measures, with a note on stderr */
    char note[512];  /* the last such note; it is not printed twice in a row */
    uint64_t seed, trials;
    const koksma_warp *warps[MAX_WARPS], *warp; /* warp: the warp that is being measured, or NULL */
    size_t n_warps;
    size_t prefixes[MAX_PREFIXES], n_prefixes;
    bool powers;    /* --prefixes powers: the prefixes are the powers of two */
    bool residuals; /* rows have a column for the residual error of slopes that are fitted to one set */
    bool by_size;   /* values at several sizes, with a slope */
    bool own_sets;  /* --sizes: generate a new set for each size instead of measuring prefixes of one set */
    double time_limit_s;
    cli_work work;
    size_t n_evaluated;   /* number of evaluations begun, for the progress line */
    tallied *tallies;     /* [prefix][measure] */
    fitted *fits;         /* [measure] */
    bool bounds, sampled; /* whether rows have columns for bounds, and for standard errors */
    bool paired;
    paired_value *firsts; /* [trial][prefix][measure] */
    size_t n_firsts;
    const char *first_source;
    const koksma_warp *first_warp;
} measuring;

bool measuring_open(measuring *j); /* allocates the statistics; false when memory runs out */
void measuring_close(measuring *j);

koksma_status measuring_evaluate(measuring *j, size_t measure, const koksma_points *points, koksma_value *value);
koksma_status measuring_forgive(measuring *j, koksma_status status);

/* Fails, with an error on stderr, if -m names a measure that has no form for points of `dim` dimensions, or none for
   the warp; with -m all and without -m, if this holds for all measures, so that none would be left. The check comes
   before any measure of these points is evaluated. Returns the exit code. */
int measuring_check_dim(measuring *j, int dim);

/* Measures many sets, or several sizes, of a source of *dim dimensions; measuring_trials prints the statistics, too, after
   an interruption those of what was measured. */
int measuring_tally(measuring *j, const char *source, int *dim);
int measuring_trials(measuring *j, const char *source);

#endif
