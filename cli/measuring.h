/* SPDX-License-Identifier: Apache-2.0 */
/* What commands that measure points share: warps, bounds, and the state of `koksma measure`. */
#ifndef KOKSMA_CLI_MEASURING_H
#define KOKSMA_CLI_MEASURING_H

#include <koksma/series.h>
#include <koksma/warp.h>

#include "cli.h"

/* ---- The option --warp: a map of the unit square by its name ------------------------------------------ */

/* Returns the warp of that name, or NULL after an error that lists all names. */
const koksma_warp *cli_find_warp(const cli_arguments *arguments, const char *name);

/* Maps 2-dimensional points by the warp. *points becomes the set of mapped points, of the warp's dimension. */
koksma_status cli_map_points(const koksma_warp *warp, koksma_points *points);

/* ---- Values that are only bounds, because the search for the exact value was cut short ---------------- */

/* Returns whether a value is only a bound although its measure gives exact values, because the search was cut
   short. */
bool cli_is_cut_short(const koksma_spec *measure, const koksma_value *value);

/* Prints a line on stderr with the number of values of `what` that are only bounds because a search was cut short.
   Prints nothing if there are none, or with --quiet. */
void cli_tell_cuts(const cli_arguments *arguments, const char *what, size_t n_cut);

/* ---- `koksma measure --at`: the local discrepancy of points at a corner of a box ---------------------- */

/* Prints a row for each source. Returns the exit code. */
int measure_local(const cli_arguments *arguments);

/* ---- The state of `koksma measure`, and measures over many sets or several sizes ---------------------- */

enum { MAX_MEASURES = 64, MAX_PREFIXES = KOKSMA_MAX_SIZES, MAX_WARPS = 16, MAX_PAIRED_TRIALS = 1000000 };

/* The option values of `koksma measure`, and the state of its run. */
typedef struct measuring {
    const cli_arguments *arguments;
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
    bool own_sets;  /* --sizes: generate a new set for each size instead of measuring prefixes of one set */
    double time_limit_s;
    cli_work work;
    size_t n_evaluated; /* number of evaluations begun, for the progress line */
    cli_rows *rows;
    koksma_tally *tallies; /* [prefix][measure]: statistics of the values */
    size_t *n_exact;       /* [prefix][measure]: number of trials with exact values */
    /* [measure]: number of values of all sources that are only bounds because the search was cut short */
    size_t *n_cut;
    size_t *n_whole;      /* [measure]: number of trials whose values are exact at all prefixes */
    koksma_joint *joints; /* [measure]: values for the fitted slopes */
    bool bounds, sampled; /* whether rows have columns for bounds, and for standard errors */
    /* --paired: firsts has the values of the first source, [trial][prefix][measure]; differences has statistics of
       how much the values of the other sources exceed these */
    bool paired;
    double *firsts;
    bool *first_is_exact;
    koksma_tally *differences;
    size_t *n_exact_pairs;
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

/* Returns whether --prefixes or --sizes asks for values at several sizes, with a slope. */
bool measuring_by_size(const measuring *j);

/* Returns whether slopes of some source are fitted to one set: there is one trial, or the pattern has only one set. */
bool measuring_has_residuals(const measuring *j);

/* Refuses --prefixes for a pattern whose first points are not a set of the pattern. Returns false after an error on
   stderr. */
bool measuring_check_prefixes(const measuring *j);

/* Measures many sets, or several sizes, of a source. After an interruption it prints what was measured. Returns the
   exit code. */
int measuring_trials(measuring *j, const char *source);

#endif
