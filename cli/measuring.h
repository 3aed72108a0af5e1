/* SPDX-License-Identifier: Apache-2.0 */
/* The state of `koksma measure`, and its evaluation of measures over many sets or several sizes (measuring.c). */
#ifndef KOKSMA_CLI_MEASURING_H
#define KOKSMA_CLI_MEASURING_H

#include <koksma/series.h>
#include <koksma/warp.h>

#include "cli.h"

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
