/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The statistics of a ranking, without any rendering: what may be concluded from the errors of patterns after rounds
 * of 8, 12, 16, 24, 32, ... trials. ranking_decisions.c describes the method and why all decisions hold together.
 */
#ifndef KOKSMA_STUDY_RANKING_RANKING_DECISIONS_H
#define KOKSMA_STUDY_RANKING_RANKING_DECISIONS_H

#include <stdbool.h>
#include <stddef.h>

#include <koksma/study.h>

#include "stats/stats.h"

enum {
    KOKSMA__RANK_REPLICATES = 16, /* number of replicates of the reference */
    KOKSMA__RANK_FIRST_ROUND = 8, /* trials of a pattern after round 0; two rounds double them */
    KOKSMA__RANK_ROUNDS = 27,     /* 8 to 65,536 trials */
    KOKSMA__RANK_NOBODY = 0x7fffffff
};

/* Patterns whose mean errors differ by no more than this factor count as equal. */
#define KOKSMA__RANK_EQUAL 1.02

/* The errors of one pattern's first n trials. */
typedef struct koksma__rank_errors {
    size_t n;
    /* mean and variance of the errors against the whole reference; the variance is the sum of squares divided by n -
       1 */
    double mean, variance;
    double without[KOKSMA__RANK_REPLICATES]; /* mean errors against the reference without replicate r */
    /* means of the fields of koksma_metric_value with these names; no decision uses them */
    double robust, top_share;
} koksma__rank_errors;

typedef enum koksma__rank_verdict {
    KOKSMA__RANK_OPEN,
    KOKSMA__RANK_LESS, /* the first pattern of the pair has the smaller error */
    KOKSMA__RANK_MORE,
    KOKSMA__RANK_SAME, /* the means are within 2 % of each other */
} koksma__rank_verdict;

/* The number of a pattern's trials after a round: 8, 12, 16, 24, 32, 48, ... */
size_t koksma__rank_trials(int round);

/* The probabilities with which each bound of a pair may err after a round: differ, a bound that excludes equality; same,
   a bound that excludes a difference of more than 2 %. */
typedef struct koksma__rank_levels {
    double differ, same;
} koksma__rank_levels;

/* The levels of a pair after a round, of its share of the probability that any decision is wrong. a, b: the errors after
   the round, in arrays that have those after the round before in front of them, unless it is the first. */
koksma__rank_levels koksma__rank_levels_of(double alpha, const koksma__rank_errors *a, const koksma__rank_errors *b,
                                           bool first);

/* koksma__rank_error: the interval of a pattern's mean error, corrected for the reference's own error, whose
   uncertainty widens the interval. koksma__rank_quotient: the interval of the quotient of two mean errors. Each
   bound errs with probability `level`. */
koksma__estimate koksma__rank_error(const koksma__rank_errors *a, double level);
koksma__estimate koksma__rank_quotient(const koksma__rank_errors *a, const koksma__rank_errors *b, double level);

/* The intersection of two simultaneous confidence intervals of one quantity; its value is the second estimate,
   clamped to the intersection. If the intervals are disjoint, the second estimate is returned unchanged. */
koksma__estimate koksma__rank_both(koksma__estimate first, koksma__estimate second);

/* The decision about two patterns whose errors are a and b. */
koksma__rank_verdict koksma__rank_judge(const koksma__rank_errors *a, const koksma__rank_errors *b,
                                        koksma__rank_levels levels);

/* The smallest number of trials of a round that would decide the pair with this share of alpha if its means and variances
   remained unchanged; 0 if none up to KOKSMA_MAX_RANK_TRIALS would, because the reference is too noisy or the difference
   too small. */
size_t koksma__rank_trials_needed(const koksma__rank_errors *a, const koksma__rank_errors *b, double alpha);

/* ---- A whole ranking ------------------------------------------------------------------------------------ */

/* A decision about a pair and the round after which it was taken. */
typedef struct koksma__rank_pair {
    koksma__rank_verdict verdict;
    int round;     /* the round after which it was taken, or the last after which the open pair was judged */
    double alpha;  /* the pair's share of the table's alpha then */
    bool hopeless; /* the pair is open, and no possible number of trials would decide it */
} koksma__rank_pair;

typedef struct koksma__rank_entrant {
    bool out;      /* whether the pattern cannot be ranked, so that its pairs remain undecided */
    bool aside;    /* postponed for now */
    bool coherent; /* the pattern's error is coherent, so that the pattern is not recommended; known after round 0 */
    int n_rounds;  /* number of complete rounds */
    koksma__rank_errors rounds[KOKSMA__RANK_ROUNDS]; /* errors after each complete round */
} koksma__rank_entrant;

typedef struct koksma__rank_table {
    size_t n;
    double alpha; /* the probability that any decision is wrong */
    koksma__rank_entrant *entrants;
    koksma__rank_pair *pairs; /* pair (i, j) at i * n + j */
    /* the pattern decided to be the best, which never changes; KOKSMA__RANK_NOBODY before the decision */
    size_t leader;
    /* the pattern decided to be the best of those whose error is not coherent, or KOKSMA__RANK_NOBODY likewise */
    size_t advised;
} koksma__rank_table;

/* What the rounds of a ranking are to decide: the pattern of smallest error, the best of the patterns whose error is
   not coherent, or the order of every pair. */
typedef enum koksma__rank_goal {
    KOKSMA__RANK_FIND_LEADER,
    KOKSMA__RANK_FIND_ADVISED,
    KOKSMA__RANK_ORDER_ALL, /* reached when no pair needs another round */
} koksma__rank_goal;

/* Errors: MEMORY. koksma__rank_table_fini also accepts a zeroed table. */
koksma_status koksma__rank_table_init(koksma__rank_table *table, size_t n, double alpha);
void koksma__rank_table_fini(koksma__rank_table *table);

/* Takes the decisions that the complete rounds allow. A decision depends on the pair's round and on the number of pairs
   that are open then. Later rounds revoke no decision. A call that `run` (may be
   NULL) ends has taken some of them. Errors: INTERRUPTED. */
koksma_status koksma__rank_decide(koksma__rank_table *table, const koksma_run *run);

/* koksma__rank_pair_alpha: the share that each open pair has of the table's alpha. koksma__rank_error_level: the level of
   the bounds of a pattern's mean error, whose intervals hold together with a probability of about 1 - alpha. */
double koksma__rank_pair_alpha(const koksma__rank_table *table);
double koksma__rank_error_level(const koksma__rank_table *table);

/* The quotient of the errors of i and j after the last round that both completed, clamped to the interval of the
   round that decided the pair, and to 1/1.02 .. 1.02 if they are the same. i and j must each have completed a round. */
koksma__estimate koksma__rank_compare(const koksma__rank_table *table, size_t i, size_t j);

/* The most by which the error of i exceeds that of any other pattern with a complete round, relative to that error, by
   the intervals of koksma__rank_compare after all rounds; 0 if i is decided to be the best of them. incoherent: only
   patterns whose error is not coherent count. Infinite if nothing is known: i does not count or has no complete round, or
   no other has one. The intervals hold together with the decisions, so that this needs no share of alpha (Bechhofer 1954
   calls the difference up to which a choice does not matter the indifference zone). */
double koksma__rank_excess(const koksma__rank_table *table, size_t i, bool incoherent);

/* koksma__rank_matters: whether the goal needs another round of the pair. koksma__rank_reached: whether the goal is
   decided, so that no round is needed. */
bool koksma__rank_matters(const koksma__rank_table *table, size_t i, size_t j, koksma__rank_goal goal);
bool koksma__rank_reached(const koksma__rank_table *table, koksma__rank_goal goal);

/* Whether all pairs of i are decided and no other pattern leaves less error, excluded and postponed patterns apart. */
bool koksma__rank_leads_present(const koksma__rank_table *table, size_t i);

/* Whether pattern i, the best at the requested size, is confirmed by this table of another size. best: the best
   pattern of this table; NOBODY: undecided. */
koksma_rank_check_state koksma__rank_check_best(const koksma__rank_table *table, size_t i, size_t best);

/* 1 + the number of patterns that are decided to leave less error than pattern i. */
size_t koksma__rank_position(const koksma__rank_table *table, size_t i);

/* The errors of pattern i after its last complete round, or NULL if pattern i has no complete round. */
const koksma__rank_errors *koksma__rank_latest(const koksma__rank_table *table, size_t i);

#endif
