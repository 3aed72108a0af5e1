/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The decisions of a ranking. A pair of patterns is judged after each round by the interval of the quotient of their
 * mean errors. The pair is equal ("same") when the interval lies within 1/1.02 .. 1.02 (two one-sided tests,
 * Schuirmann 1987), different when the interval excludes 1, and undecided otherwise.
 *
 * All decisions of a ranking hold together with probability 1 - alpha. A pair's share of alpha is alpha / m with the
 * number m of pairs that are not decided to be different: what those no longer need goes to the others (Holm 1979; in
 * rounds: Maurer & Bretz 2013). Pairs decided to be the same still count, since each of them could have been decided to be
 * different. The share is spent over the rounds in proportion to the information (Lan & DeMets 1983): after a round with
 * the relative standard error s of the difference, sqrt(S / s) of it is spent, with S = .35 %, at which half-widths are
 * 1 % and nearly all pairs are decided. So each bound that says "different" errs after a round with probability
 *
 *     differ = (alpha / m) / 2  min(1, 1.2 (sqrt(S / s) - sqrt(S / s_before))).
 *
 * Rounds share their trials and pairs their patterns, so that Bonferroni's inequality counts wrong decisions more than
 * once; the factor 1.2, which simulations show to be allowed, makes up for a part of that. A round spends at least 2 %, so
 * that no pair is left without a test. A bound that says "same" errs with probability
 *
 *     same = (alpha / m) / 4.
 *
 * It can be wrong only of means that differ by about 2 % or more, and only in the two or three rounds after which half-
 * widths fit into 2 % and "different" is not yet decided; a wrong order is no longer likely there. The levels depend on
 * no limit of time or trials. tests/study/ranking/test_ranking_power.c simulates them (docs/findings/ranking-decisions.md).
 *
 * Each bound is the lower bound of a contrast theta = x A - y B of the mean errors A and B of independent trials:
 *     theta - bias  -  t(level, nu) sqrt(x^2 s_A^2 / n + y^2 s_B^2 / n + v)  -  |bias|
 * with Welch's and Satterthwaite's degrees of freedom nu. The variance v and the bias that the reference's own error
 * causes are estimated by the jackknife over the k independent replicates of the reference (Efron & Stein 1981):
 * with theta_r the contrast measured against the reference without replicate r, and theta_. the mean of the theta_r,
 *     bias = (k - 1) (theta_. - theta),   v = (k - 1) / k  sum (theta_r - theta_.)^2.
 * If the pattern's error is a smooth function of the reference, the bias is proportional to 1/k and the jackknife
 * removes it. If the pattern's images are exact, the bias is proportional to 1/sqrt k and the jackknife removes half
 * of it: the term |bias| covers the other half. A reference that is too noisy therefore leaves pairs undecided.
 *
 * The bounds of the quotient are the zeros q of the bounds of the contrasts A - q B (Fieller 1954), found by
 * bisection, so they agree with the decisions. Student's t needs nearly normal means, which the errors of images
 * are: an image's error is itself a mean over its pixels.
 */
#include "study/ranking/ranking_decisions.h"

#include <math.h>
#include <stdlib.h>

#include "core/parallel.h"
#include "core/status.h"
#include "stats/stats.h"

/* Relative bound of the rounding error in the difference of two values that are equal in exact arithmetic. */
#define ROUNDING 1e-12

/* A pair is declared hopeless only from 256 trials on: with fewer trials, much of the estimated variance v of the
   reference (see above) is noise of the trials, or that of its earlier stages. */
enum { SURE_ROUND = 10 };

#define SURE_ERROR 0.0035 /* S, 1.2, 2 % and 1/4 of the head of this file */
#define OVERLAP 1.2
#define LEAST_PART 0.02
#define SAME_PART 0.25

/* The run is asked after so many pairs, each of which takes some tens of microseconds. */
enum { ASKED = 1024 };

size_t koksma__rank_trials(int round)
{
    return (size_t)(round % 2 ? 3 * KOKSMA__RANK_FIRST_ROUND / 2 : KOKSMA__RANK_FIRST_ROUND) << (round / 2);
}

/* ---- One contrast --------------------------------------------------------------------------------------- */

typedef struct contrast {
    double value, bias, error, degrees; /* value: the estimate, from which the bias has been subtracted */
} contrast;

static double whole_or_zero(double x, double size)
{
    return fabs(x) <= ROUNDING * size ? 0 : x;
}

/* The contrast x A - y B of the mean errors of a and b; b = NULL: x A. */
static contrast contrast_of(const koksma__rank_errors *a, double x, const koksma__rank_errors *b, double y)
{
    const double k = KOKSMA__RANK_REPLICATES, n_a = (double)a->n, n_b = b ? (double)b->n : 2;
    const double size = x * a->mean + (b ? y * b->mean : 0), theta = x * a->mean - (b ? y * b->mean : 0);
    double without[KOKSMA__RANK_REPLICATES], mean = 0, squares = 0;
    for (int r = 0; r < KOKSMA__RANK_REPLICATES; r++) {
        without[r] = whole_or_zero(x * a->without[r] - (b ? y * b->without[r] : 0) - theta, size);
        mean += without[r] / k;
    }
    for (int r = 0; r < KOKSMA__RANK_REPLICATES; r++) {
        squares += (without[r] - mean) * (without[r] - mean);
    }
    const double bias = (k - 1) * mean, of_reference = (k - 1) / k * squares;
    const double of_a = x * x * a->variance / n_a, of_b = b ? y * y * b->variance / n_b : 0;
    const double variance = of_a + of_b + of_reference;
    const double spread = of_a * of_a / (n_a - 1) + of_b * of_b / (n_b - 1) + of_reference * of_reference / (k - 1);
    return (contrast){.value = whole_or_zero(theta - bias, size),
                      .bias = bias,
                      .error = whole_or_zero(sqrt(variance), size),
                      .degrees = spread > 0 ? variance * variance / spread : (double)INFINITY};
}

static double half_width(const contrast *c, double level)
{
    return (c->error > 0 ? koksma__student_quantile(1 - level, fmin(c->degrees, 1e12)) * c->error : 0) +
           fabs(c->bias);
}

/* Whether the lower bound of the contrast x A - y B is above 0 or, if `zero_too`, not below 0. It is -infinity if a
   pattern has fewer than two trials. */
static bool is_above(const koksma__rank_errors *a, double x, const koksma__rank_errors *b, double y, double level,
                     bool zero_too)
{
    if (a->n < 2 || (b && b->n < 2)) {
        return false;
    }
    const contrast c = contrast_of(a, x, b, y);
    const double excess = c.value - fabs(c.bias);
    return c.error > 0 ? excess > 0 && koksma__student_tail(excess / c.error, fmin(c.degrees, 1e12)) < level
                       : excess > 0 || (zero_too && !(excess < 0));
}

/* ---- Levels --------------------------------------------------------------------------------------------- */

/* The part of a pair's share of alpha that is spent when its errors are a and b. */
static double spent(const koksma__rank_errors *a, const koksma__rank_errors *b)
{
    const double error = contrast_of(a, 1, b, 1).error, sure = SURE_ERROR * (a->mean + b->mean) / 2;
    return error > sure ? sqrt(sure / error) : 1;
}

koksma__rank_levels koksma__rank_levels_of(double alpha, const koksma__rank_errors *a, const koksma__rank_errors *b,
                                           bool first)
{
    const double part = spent(a, b) - (first ? 0 : spent(a - 1, b - 1));
    return (koksma__rank_levels){.differ = alpha / 2 * fmin(OVERLAP * fmax(part, LEAST_PART), 1),
                                 .same = alpha * SAME_PART};
}

/* ---- Intervals and verdicts ----------------------------------------------------------------------------- */

koksma__estimate koksma__rank_error(const koksma__rank_errors *a, double level)
{
    const contrast c = contrast_of(a, 1, NULL, 0);
    const double value = fmax(c.value, 0);
    if (a->n < 2) {
        return (koksma__estimate){value, NAN, NAN};
    }
    const double half = half_width(&c, level);
    return (koksma__estimate){value, fmax(value - half, 0), value + half};
}

/* The largest q for which the lower bound of A - q B is positive; 0 if there is no such q. */
static double least_quotient(const koksma__rank_errors *a, const koksma__rank_errors *b, double level)
{
    double lo = 0, hi = 1;
    if (!is_above(a, 1, b, 0, level, false)) {
        return 0;
    }
    while (is_above(a, 1, b, hi, level, false) && hi < 1e12) {
        lo = hi;
        hi *= 2;
    }
    for (int i = 0; i < 200 && hi - lo > 1e-7 * hi; i++) {
        const double middle = 0.5 * (lo + hi);
        if (is_above(a, 1, b, middle, level, false)) {
            lo = middle;
        } else {
            hi = middle;
        }
    }
    return 0.5 * (lo + hi);
}

koksma__estimate koksma__rank_quotient(const koksma__rank_errors *a, const koksma__rank_errors *b, double level)
{
    const double mean_a = contrast_of(a, 1, NULL, 0).value, mean_b = contrast_of(b, 1, NULL, 0).value;
    const koksma__rank_levels levels = {level, level};
    if (!koksma__compare(mean_a, mean_b) && koksma__rank_judge(a, b, levels) == KOKSMA__RANK_SAME &&
        !(mean_a > 0)) { /* both errors are 0 */
        return (koksma__estimate){1, 1, 1};
    }
    if (a->n < 2 || b->n < 2) {
        return (koksma__estimate){mean_a / mean_b, NAN, NAN};
    }
    const double inverse = least_quotient(b, a, level);
    return (koksma__estimate){mean_a / mean_b, least_quotient(a, b, level),
                              inverse > 0 ? 1 / inverse : (double)INFINITY};
}

koksma__estimate koksma__rank_both(koksma__estimate first, koksma__estimate second)
{
    const double low = fmax(first.low, second.low), high = fmin(first.high, second.high);
    return low <= high ? (koksma__estimate){fmin(fmax(second.value, low), high), low, high} : second;
}

koksma__rank_verdict koksma__rank_judge(const koksma__rank_errors *a, const koksma__rank_errors *b,
                                        koksma__rank_levels levels)
{
    if (is_above(a, KOKSMA__RANK_EQUAL, b, 1, levels.same, true) &&
        is_above(b, KOKSMA__RANK_EQUAL, a, 1, levels.same, true)) {
        return KOKSMA__RANK_SAME;
    }
    return is_above(b, 1, a, 1, levels.differ, false)   ? KOKSMA__RANK_LESS
           : is_above(a, 1, b, 1, levels.differ, false) ? KOKSMA__RANK_MORE
                                                        : KOKSMA__RANK_OPEN;
}

size_t koksma__rank_trials_needed(const koksma__rank_errors *a, const koksma__rank_errors *b, double alpha)
{
    koksma__rank_errors later_a[] = {*a, *a}, later_b[] = {*b, *b}; /* after a round and the next */
    for (int round = 0; round < KOKSMA__RANK_ROUNDS; round++) {
        const size_t n = koksma__rank_trials(round);
        later_a[0].n = later_b[0].n = round ? koksma__rank_trials(round - 1) : n;
        later_a[1].n = later_b[1].n = n;
        if (n >= a->n && koksma__rank_judge(&later_a[1], &later_b[1],
                                            koksma__rank_levels_of(alpha, &later_a[1], &later_b[1], !round))) {
            return n;
        }
    }
    return 0;
}

/* ---- A whole ranking ------------------------------------------------------------------------------------ */

koksma_status koksma__rank_table_init(koksma__rank_table *table, size_t n, double alpha)
{
    *table = (koksma__rank_table){.n = n,
                                  .alpha = alpha,
                                  .entrants = calloc(n, sizeof *table->entrants),
                                  .pairs = calloc(n * n, sizeof *table->pairs),
                                  .leader = KOKSMA__RANK_NOBODY,
                                  .advised = KOKSMA__RANK_NOBODY};
    return table->entrants && table->pairs ? KOKSMA_OK : koksma__fail_memory(n * n * sizeof *table->pairs);
}

void koksma__rank_table_fini(koksma__rank_table *table)
{
    free(table->entrants);
    free(table->pairs);
    *table = (koksma__rank_table){0};
}

const koksma__rank_errors *koksma__rank_latest(const koksma__rank_table *table, size_t i)
{
    const koksma__rank_entrant *e = &table->entrants[i];
    return e->n_rounds ? &e->rounds[e->n_rounds - 1] : NULL;
}

double koksma__rank_pair_alpha(const koksma__rank_table *table)
{
    size_t equal = 0;
    for (size_t i = 0; i < table->n; i++) {
        for (size_t j = i + 1; j < table->n && !table->entrants[i].out; j++) {
            const koksma__rank_verdict verdict = table->pairs[i * table->n + j].verdict;
            equal += !table->entrants[j].out && (verdict == KOKSMA__RANK_OPEN || verdict == KOKSMA__RANK_SAME);
        }
    }
    return table->alpha / (double)(equal ? equal : 1);
}

double koksma__rank_error_level(const koksma__rank_table *table)
{
    return table->alpha / (5 * (double)table->n);
}

static int last_common_round(const koksma__rank_table *table, size_t i, size_t j)
{
    const int a = table->entrants[i].n_rounds, b = table->entrants[j].n_rounds;
    return (a < b ? a : b) - 1;
}

/* Judges an open pair after the last round that both patterns have completed. Returns whether it is decided now. */
static bool judge_pair(koksma__rank_table *table, size_t i, size_t j, double alpha)
{
    koksma__rank_pair *pair = &table->pairs[i * table->n + j], *mirrored = &table->pairs[j * table->n + i];
    const int round = last_common_round(table, i, j);
    if (pair->verdict || round < 0 || table->entrants[i].out || table->entrants[j].out) {
        return false;
    }
    const koksma__rank_errors *a = &table->entrants[i].rounds[round], *b = &table->entrants[j].rounds[round];
    pair->round = round;
    pair->alpha = alpha;
    pair->verdict = koksma__rank_judge(a, b, koksma__rank_levels_of(alpha, a, b, !round));
    pair->hopeless = !pair->verdict && round >= SURE_ROUND && !koksma__rank_trials_needed(a, b, alpha);
    *mirrored = *pair;
    mirrored->verdict = pair->verdict == KOKSMA__RANK_LESS   ? KOKSMA__RANK_MORE
                        : pair->verdict == KOKSMA__RANK_MORE ? KOKSMA__RANK_LESS
                                                             : pair->verdict;
    return pair->verdict;
}

/* The interval of the quotient of a pair's errors after a round. */
static koksma__estimate quotient_after(const koksma__rank_table *table, size_t i, size_t j, int round)
{
    const koksma__rank_errors *a = &table->entrants[i].rounds[round], *b = &table->entrants[j].rounds[round];
    const double alpha = table->pairs[i * table->n + j].alpha;
    return koksma__rank_quotient(a, b, koksma__rank_levels_of(alpha, a, b, !round).differ);
}

koksma__estimate koksma__rank_compare(const koksma__rank_table *table, size_t i, size_t j)
{
    static const koksma__estimate same = {1, 1 / KOKSMA__RANK_EQUAL, KOKSMA__RANK_EQUAL};
    const koksma__rank_pair *pair = &table->pairs[i * table->n + j];
    const int last = last_common_round(table, i, j);
    koksma__estimate e = quotient_after(table, i, j, last);
    if (pair->verdict && pair->round != last) {
        e = koksma__rank_both(quotient_after(table, i, j, pair->round), e);
    }
    return pair->verdict == KOKSMA__RANK_SAME ? koksma__rank_both(same, e) : e;
}

static bool counts_in_excess(const koksma__rank_entrant *e, bool incoherent)
{
    return !e->out && e->n_rounds && !(incoherent && e->coherent);
}

double koksma__rank_excess(const koksma__rank_table *table, size_t i, bool incoherent)
{
    double most = -1;
    for (size_t j = 0; j < table->n && counts_in_excess(&table->entrants[i], incoherent); j++) {
        if (j != i && counts_in_excess(&table->entrants[j], incoherent)) {
            const bool less = table->pairs[i * table->n + j].verdict == KOKSMA__RANK_LESS;
            double high = koksma__rank_compare(table, i, j).high;
            for (int round = last_common_round(table, i, j);
                 !less && round-- > 0;) { /* an early round may spend more */
                high = fmin(high, quotient_after(table, i, j, round).high);
            }
            most = fmax(most, less ? 0 : fmax(high - 1, 0));
        }
    }
    return most < 0 ? (double)INFINITY : most;
}

/* Whether all pairs of i with patterns that count are decided and none of these leaves less error. Excluded patterns don't
   count, nor those that are coherent if `incoherent`, nor those that are postponed if `present`. While a pattern has no
   complete round, its coherence is unknown, and it counts. */
static bool leads_of(const koksma__rank_table *table, size_t i, bool incoherent, bool present)
{
    const koksma__rank_entrant *mine = &table->entrants[i];
    bool leads = mine->n_rounds && !mine->out && !(incoherent && mine->coherent);
    for (size_t j = 0; leads && j < table->n; j++) {
        const koksma__rank_entrant *other = &table->entrants[j];
        const koksma__rank_verdict verdict = table->pairs[i * table->n + j].verdict;
        leads = j == i || other->out || (present && other->aside) ||
                (incoherent && other->n_rounds && other->coherent) || verdict == KOKSMA__RANK_LESS ||
                verdict == KOKSMA__RANK_SAME;
    }
    return leads;
}

bool koksma__rank_leads_present(const koksma__rank_table *table, size_t i)
{
    return leads_of(table, i, false, true);
}

/* The latest round after which a pair of pattern i that counts for the goal was decided. */
static int last_round(const koksma__rank_table *table, size_t i, koksma__rank_goal goal)
{
    int round = 0;
    for (size_t j = 0; j < table->n; j++) {
        const koksma__rank_pair *pair = &table->pairs[i * table->n + j];
        const bool counts = goal == KOKSMA__RANK_FIND_LEADER || !table->entrants[j].coherent;
        round = j != i && counts && pair->verdict && pair->round > round ? pair->round : round;
    }
    return round;
}

/* Finds the leader: the pattern that is decided to be no worse than all others. For the goals that leave out
   patterns with coherent errors, only patterns without them are considered. NOBODY if there is no leader. If several
   equal patterns lead, it is the one that led after the fewest rounds and, among those, the one with the smallest
   mean error after that round. */
static size_t find_leader(const koksma__rank_table *table, koksma__rank_goal goal)
{
    size_t leader = KOKSMA__RANK_NOBODY;
    for (size_t i = 0; i < table->n; i++) {
        if (leads_of(table, i, goal != KOKSMA__RANK_FIND_LEADER, false)) {
            const int round = last_round(table, i, goal),
                      first = leader < table->n ? last_round(table, leader, goal) : round + 1;
            if (round < first || (round == first && table->entrants[i].rounds[round].mean <
                                                        table->entrants[leader].rounds[round].mean)) {
                leader = i;
            }
        }
    }
    return leader;
}

/* Judges the open pairs once. *decided: whether one of them is decided now. */
static koksma_status judge_pairs(koksma__rank_table *table, const koksma_run *run, bool *decided)
{
    const double alpha = koksma__rank_pair_alpha(table);
    *decided = false;
    for (size_t i = 0, pair = 0; i < table->n; i++) {
        for (size_t j = i + 1; j < table->n; j++, pair++) {
            if (pair % ASKED == ASKED - 1) {
                KOKSMA__TRY(koksma__ask(run));
            }
            *decided |= judge_pair(table, i, j, alpha);
        }
    }
    return KOKSMA_OK;
}

koksma_status koksma__rank_decide(koksma__rank_table *table, const koksma_run *run)
{
    bool decided = true;
    while (decided) { /* what these pairs no longer need of alpha may decide others */
        KOKSMA__TRY(judge_pairs(table, run, &decided));
    }
    if (table->leader == KOKSMA__RANK_NOBODY) {
        table->leader = find_leader(table, KOKSMA__RANK_FIND_LEADER);
    }
    if (table->advised == KOKSMA__RANK_NOBODY) {
        table->advised = find_leader(table, KOKSMA__RANK_FIND_ADVISED);
    }
    return KOKSMA_OK;
}

/* Whether pattern i may still be the best: no other pattern that counts for the goal is decided to have a smaller
   error. */
static bool may_lead(const koksma__rank_table *table, size_t i, koksma__rank_goal goal)
{
    bool may = true;
    for (size_t j = 0; may && j < table->n; j++) {
        const koksma__rank_entrant *other = &table->entrants[j];
        const bool counts = !other->out && (goal == KOKSMA__RANK_FIND_LEADER || !other->coherent);
        may = !counts || table->pairs[i * table->n + j].verdict != KOKSMA__RANK_MORE;
    }
    return may;
}

bool koksma__rank_matters(const koksma__rank_table *table, size_t i, size_t j, koksma__rank_goal goal)
{
    const koksma__rank_entrant *a = &table->entrants[i], *b = &table->entrants[j];
    const koksma__rank_pair *pair = &table->pairs[i * table->n + j];
    if (i == j || a->out || b->out || pair->verdict || pair->hopeless) {
        return false;
    }
    return goal == KOKSMA__RANK_ORDER_ALL || ((goal == KOKSMA__RANK_FIND_LEADER || (!a->coherent && !b->coherent)) &&
                                              (may_lead(table, i, goal) || may_lead(table, j, goal)));
}

bool koksma__rank_reached(const koksma__rank_table *table, koksma__rank_goal goal)
{
    return (goal == KOKSMA__RANK_FIND_LEADER && table->leader != KOKSMA__RANK_NOBODY) ||
           (goal == KOKSMA__RANK_FIND_ADVISED && table->advised != KOKSMA__RANK_NOBODY);
}

size_t koksma__rank_position(const koksma__rank_table *table, size_t i)
{
    size_t position = 1;
    for (size_t j = 0; j < table->n; j++) {
        position += !table->entrants[j].out && table->pairs[i * table->n + j].verdict == KOKSMA__RANK_MORE;
    }
    return position;
}

koksma_rank_check_state koksma__rank_check_best(const koksma__rank_table *table, size_t i, size_t best)
{
    return best == KOKSMA__RANK_NOBODY || table->entrants[i].out                         ? KOKSMA_RANK_UNSETTLED
           : best == i || table->pairs[best * table->n + i].verdict == KOKSMA__RANK_SAME ? KOKSMA_RANK_CONFIRMED
                                                                                         : KOKSMA_RANK_OVERTURNED;
}
