/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_MEASURING_H
#define KOKSMA_CLI_MEASURING_H

#include <koksma/series.h>
#include <koksma/warp.h>

#include "cli.h"

enum { MAX_MEASURES = 64, MAX_PREFIXES = KOKSMA_MAX_SIZES, MAX_WARPS = 16, MAX_PAIRED_TRIALS = 1000000 };

/* The options of `measure`, and its progress. */
typedef struct measuring {
    const cli_arguments *arguments;
    koksma_spec measures[MAX_MEASURES];
    size_t n_measures;
    bool all; /* -m all: measures that can't serve a set are left out */
    uint64_t seed, trials;
    const koksma_warp *warps[MAX_WARPS], *warp; /* warp: the one in use, or NULL */
    size_t n_warps;
    size_t prefixes[MAX_PREFIXES], n_prefixes;
    bool powers;   /* prefixes are the powers of two */
    bool own_sets; /* --sizes: of patterns not prefixes, but a set of each size */
    double time_limit_s;
    cli_work work;
    size_t n_evaluated; /* values that were looked for, for the progress */
    cli_rows *rows;
    koksma_tally *tallies; /* [prefix][measure] */
    size_t *n_exact;       /* likewise: of how many trials the value is exact */
    size_t *n_cut;         /* [measure]: values of all sources that are bounds, as the search was cut short */
    size_t *n_whole;       /* [measure]: trials whose values are exact at all prefixes */
    koksma_joint *joints;  /* [measure] */
    bool bounds, sampled;  /* rows have the columns of bounds, of standard errors */
    /* --paired: the first source's values by trial, [prefix][measure] each, and tallies of what others have more */
    bool paired;
    double *firsts;
    bool *first_is_exact;
    koksma_tally *differences;
    size_t *n_exact_pairs;
    size_t n_firsts;
    const char *first_source;
    const koksma_warp *first_warp;
} measuring;

bool measuring_open(measuring *j); /* room for tallies; false when memory runs out */
void measuring_close(measuring *j);

koksma_status measuring_evaluate(measuring *j, size_t measure, const koksma_points *points, koksma_value *value);
koksma_status measuring_forgive(const measuring *j, koksma_status status);

/* Whether values are wanted at several sizes, with a slope. */
bool measuring_by_size(const measuring *j);

/* Refuses --prefixes of a pattern whose first points are no set of it; false after an error on stderr. */
bool measuring_check_prefixes(const measuring *j);

/* Many sets, or several sizes: what was done is printed even if it was cut short. Returns the exit code. */
int measuring_trials(measuring *j, const char *source);

#endif
