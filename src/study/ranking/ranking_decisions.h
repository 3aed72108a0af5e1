/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The statistics of a ranking, without any rendering: what may be concluded from the errors of patterns after rounds
 * of 8, 16, 32, ... trials. ranking_decisions.c says how, and why the conclusions hold together.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_DECISIONS_H
#define KOKSMA_STUDY_RANKING_RANKING_DECISIONS_H

#include <stdbool.h>
#include <stddef.h>

#include <koksma/study.h>

#include "stats/statistics.h"

enum {
    KOKSMA__RANK_REPLICATES = 16, /* of the reference */
    KOKSMA__RANK_FIRST_ROUND = 8, /* trials of a pattern after round 0; each round doubles them */
    KOKSMA__RANK_ROUNDS = 14,     /* 8 to 65,536 trials */
    KOKSMA__RANK_NOBODY = 0x7fffffff
};

/* Patterns whose mean errors differ by no more than this factor are equal for all purposes. */
#define KOKSMA__RANK_EQUAL 1.02

/* The errors of one pattern's first n trials. */
typedef struct koksma__rank_errors {
    size_t n;
    double mean, variance;                   /* against the whole reference; of the trials, with n - 1 */
    double without[KOKSMA__RANK_REPLICATES]; /* means against the reference without replicate r */
    double robust, top_share;                /* means: koksma_metric_value. Nothing is decided by them */
} koksma__rank_errors;

typedef enum koksma__rank_verdict {
    KOKSMA__RANK_OPEN,
    KOKSMA__RANK_LESS, /* the first of the pair leaves less error */
    KOKSMA__RANK_MORE,
    KOKSMA__RANK_SAME, /* the means are within 2 % of each other */
} koksma__rank_verdict;

/* The probability with which each bound of each comparison of n_patterns patterns may err, after each round, so that
   all of them together err with probability alpha at most. */
double koksma__rank_level(double alpha, size_t n_patterns);

/* The interval of a pattern's mean error, its reference's own error removed and accounted for; the interval of the
   quotient of two. Each bound errs with probability `level`. */
koksma__estimate koksma__rank_error(const koksma__rank_errors *a, double level);
koksma__estimate koksma__rank_quotient(const koksma__rank_errors *a, const koksma__rank_errors *b, double level);

/* Of two intervals of one quantity that hold together, the second's value and what both allow; where they exclude
   each other, the second. */
koksma__estimate koksma__rank_both(koksma__estimate first, koksma__estimate second);

koksma__rank_verdict koksma__rank_judge(const koksma__rank_errors *a, const koksma__rank_errors *b, double level);

/* The number of trials, one of 8, 16, 32, ..., from which on the pair would be decided if the means and variances
   stayed as they are; 0: no number of trials would, because the reference is too noisy. */
size_t koksma__rank_trials_needed(const koksma__rank_errors *a, const koksma__rank_errors *b, double level);

/* ---- A whole ranking ------------------------------------------------------------------------------------ */

/* A decision about a pair and the round after which it was taken. */
typedef struct koksma__rank_pair {
    koksma__rank_verdict verdict;
    int round, judged; /* judged: rounds looked at so far */
    bool hopeless;     /* open, and no number of trials would decide it: the reference is too noisy */
} koksma__rank_pair;

typedef struct koksma__rank_entrant {
    bool out;                                        /* cannot be ranked at all: nothing is decided about it */
    bool aside;                                      /* put off for now */
    bool coherent;                                   /* its error is, and it is not advised; known from round 0 on */
    int n_rounds;                                    /* complete */
    koksma__rank_errors rounds[KOKSMA__RANK_ROUNDS]; /* after each of them */
} koksma__rank_entrant;

typedef struct koksma__rank_table {
    size_t n;
    double level;
    koksma__rank_entrant *entrants;
    koksma__rank_pair *pairs; /* pair (i, j) at i * n + j */
    size_t leader;            /* KOKSMA__RANK_NOBODY until it is decided; not revoked */
    size_t advised;           /* the leader of those whose error is not coherent; likewise */
} koksma__rank_table;

/* What the rounds of a ranking are to decide: the pattern of smallest error, the best of those whose error is not
   coherent, or the order of every pair. */
typedef enum koksma__rank_goal {
    KOKSMA__RANK_FIND_LEADER,
    KOKSMA__RANK_FIND_ADVISED,
    KOKSMA__RANK_ORDER_ALL, /* reached when no pair needs another round */
} koksma__rank_goal;

/* Errors: MEMORY. fini takes zeros. */
koksma_status koksma__rank_table_init(koksma__rank_table *table, size_t n, double alpha);
void koksma__rank_table_fini(koksma__rank_table *table);

/* Takes the decisions that the complete rounds allow. Each depends on the pair and the round alone, so that it makes
   no difference in which order rounds were completed, and later rounds revoke nothing. */
void koksma__rank_decide(koksma__rank_table *table);

/* The quotient of the errors of i and j after the last round that both completed, clamped to the interval of the
   round that decided the pair. Both have completed one. */
koksma__estimate koksma__rank_compare(const koksma__rank_table *table, size_t i, size_t j);

/* koksma__rank_matters: whether the goal needs another round of the pair. koksma__rank_reached: whether the goal is
   decided, so that no round is needed. */
bool koksma__rank_matters(const koksma__rank_table *table, size_t i, size_t j, koksma__rank_goal goal);
bool koksma__rank_reached(const koksma__rank_table *table, koksma__rank_goal goal);

/* Whether i is decided against all others that are not out, and none of them leaves less; with `present`, against
   those that are not put off. */
bool koksma__rank_leads(const koksma__rank_table *table, size_t i, bool present);

/* Whether i, the best of some patterns at the size asked for, is the best of them in this table of another size, whose
   best of them is `best` (NOBODY: undecided). */
koksma_rank_check_state koksma__rank_check_best(const koksma__rank_table *table, size_t i, size_t best);

/* 1 + the number of patterns that are decided to leave less error. */
size_t koksma__rank_position(const koksma__rank_table *table, size_t i);

/* The errors after the last complete round; NULL without one. */
const koksma__rank_errors *koksma__rank_latest(const koksma__rank_table *table, size_t i);

#endif
