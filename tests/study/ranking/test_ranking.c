/* SPDX-License-Identifier: Apache-2.0 */
/* What a ranking concludes: from invented errors, whose means are known, and from small pictures under a clock that
   cuts the work short at any moment. Long because the two belong together: what cuts may cost is a decision. */
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/study.h>

#include "core/clock.h"
#include "core/random.h"
#include "stats/stats.h"
#include "study/ranking/ranking_contest.h"
#include "study/ranking/ranking_decisions.h"
#include "study/run/study.h"
#include "test.h"

/* ---- Invented errors ------------------------------------------------------------------------------------ */

enum { MOST = 8, PIXELS = 40 };

/* A world: patterns whose pictures have pixels of known error, and a reference with an error of its own. */
typedef struct world {
    size_t n;
    const double *scale; /* the patterns' errors: of a pixel, the absolute value of `scale` times a number */
    double spread;       /* how much trials differ: the numbers' common factor is exp(spread z) */
    double reference;    /* deviation of a replicate's pixel */
    uint64_t seed;
} world;

static double normal(uint64_t seed, uint64_t i, uint64_t j)
{
    double pair[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_TEST, i, (uint32_t)j, pair);
    return sqrt(-2 * log1p(-pair[0])) * cos(6.283185307179586 * pair[1]);
}

/* All errors of pattern p up to n trials, by definition: pixel by pixel, replicate by replicate. The exact picture is
   0, so that the true mean error of pattern p is scale[p] sqrt(2/pi) exp(spread^2 / 2). */
static koksma__rank_errors errors_of(const world *w, size_t p, size_t n)
{
    enum { K = KOKSMA__RANK_REPLICATES };
    static double replicate[PIXELS][K];
    koksma__rank_errors e = {.n = n};
    double squares = 0;
    for (uint64_t x = 0; x < PIXELS; x++) {
        for (uint64_t r = 0; r < K; r++) {
            replicate[x][r] = w->reference > 0 ? w->reference * normal(w->seed, 1000000 + r, (uint64_t)x) : 0;
        }
    }
    for (size_t t = 0; t < n; t++) {
        const uint64_t key = (uint64_t)(p * 65536 + t);
        const double factor = w->scale[p] * exp(w->spread * normal(w->seed, key, PIXELS));
        double errors[1 + K] = {0};
        for (uint64_t x = 0; x < PIXELS; x++) {
            const double y = factor * normal(w->seed, key, x);
            double mean = 0;
            for (int r = 0; r < K; r++) {
                mean += replicate[x][r] / K;
            }
            errors[0] += fabs(y - mean) / PIXELS;
            for (int r = 0; r < K; r++) {
                errors[1 + r] += fabs(y - (K * mean - replicate[x][r]) / (K - 1)) / PIXELS;
            }
        }
        const double off = errors[0] - e.mean;
        e.mean += off / (double)(t + 1);
        squares += off * (errors[0] - e.mean);
        for (int r = 0; r < K; r++) {
            e.without[r] += errors[1 + r] / (double)n;
        }
    }
    e.variance = squares / (double)(n - 1);
    return e;
}

/* Runs `rounds` rounds of a ranking in a world; what is wrongly decided is counted. */
typedef struct outcome {
    size_t wrong, leader, decided;
} outcome;

static outcome rank_world(const world *w, int rounds, double alpha)
{
    koksma__rank_table table;
    outcome out = {0};
    assert_ok(koksma__rank_table_init(&table, w->n, alpha));
    for (int round = 0; round < rounds; round++) {
        for (size_t p = 0; p < w->n; p++) {
            koksma__rank_entrant *e = &table.entrants[p];
            e->rounds[e->n_rounds++] = errors_of(w, p, koksma__rank_trials(round));
        }
        assert_ok(koksma__rank_decide(&table, NULL));
    }
    for (size_t i = 0; i < w->n; i++) {
        for (size_t j = i + 1; j < w->n; j++) {
            const double quotient = w->scale[i] / w->scale[j];
            const koksma__rank_verdict v = table.pairs[i * w->n + j].verdict;
            out.decided += v != KOKSMA__RANK_OPEN;
            out.wrong += (v == KOKSMA__RANK_LESS && quotient >= 1) || (v == KOKSMA__RANK_MORE && quotient <= 1) ||
                         (v == KOKSMA__RANK_SAME && fabs(log(quotient)) > log(KOKSMA__RANK_EQUAL) + 1e-12);
        }
    }
    out.leader = table.leader;
    koksma__rank_table_fini(&table);
    return out;
}

/* Equal means, means at the edge of "equal", and near ties; with a good reference and with one as noisy as the
   patterns themselves. Rankings with any wrong decision are rarer than alpha: of 100 with alpha = 0.2 fewer than 36,
   which 20 expected ones reach with probability 1e-4. */
TEST_CASE(wrong_decisions_are_rare)
{
    static const double equal[] = {1, 1, 1, 1}, edge[] = {1, 1.0201, 1.0201, 1.0201}, ties[] = {1, 1.005, 1.01, 1.03};
    const double *const scales[] = {equal, edge, ties};
    for (size_t s = 0; s < 3; s++) {
        for (int noisy = 0; noisy < 2; noisy++) {
            size_t wrong = 0;
            for (uint64_t seed = 0; seed < 40; seed++) {
                const world w = {.n = 4,
                                 .scale = scales[s],
                                 .spread = noisy ? 0.02 : 0.15,
                                 .reference = noisy ? 1.2 : 0.1,
                                 .seed = seed + 1000 * s};
                wrong += rank_world(&w, 5, 0.2).wrong > 0;
            }
            assert_that(wrong < 18, "case %zu, %s reference: %zu of 40 rankings decide wrongly", s,
                        noisy ? "noisy" : "good", wrong);
        }
    }
}

/* What differs clearly is decided, and the best leads; equal ones are found to be equal. */
TEST_CASE(clear_cases_are_decided)
{
    static const double scale[] = {1.5, 1, 2, 1.25}, equal[] = {1, 1};
    const world w = {.n = 4, .scale = scale, .spread = 0.05, .reference = 0.1, .seed = 3};
    const outcome o = rank_world(&w, 5, 0.04);
    assert_int_equal(o.wrong, 0);
    assert_int_equal(o.decided, 6);
    assert_int_equal(o.leader, 1);
    const world same = {.n = 2, .scale = equal, .spread = 0.005, .reference = 0, .seed = 4};
    assert_int_equal(rank_world(&same, 17, 0.04).decided, 1);
}

/* A reference that is as noisy as what it judges leaves a small difference open, whatever the number of trials. */
TEST_CASE(noisy_references_decide_nothing)
{
    static const double scale[] = {1, 1.03};
    const world w = {.n = 2, .scale = scale, .spread = 0.01, .reference = 4, .seed = 5};
    const koksma__rank_errors a = errors_of(&w, 0, 256), b = errors_of(&w, 1, 256);
    const koksma__rank_levels levels = koksma__rank_levels_of(0.04, &a, &b, true);
    assert_int_equal(koksma__rank_judge(&a, &b, levels), KOKSMA__RANK_OPEN);
    assert_int_equal(koksma__rank_trials_needed(&a, &b, 0.04), 0);
    const koksma__estimate q = koksma__rank_quotient(&a, &b, levels.differ);
    assert_true(q.low < 1 / 1.03 && q.high > 1 / 1.03);
}

/* ---- By hand -------------------------------------------------------------------------------------------- */

static koksma__rank_errors exact(double mean, double sd, size_t n)
{
    koksma__rank_errors e = {.n = n, .mean = mean, .variance = sd * sd};
    for (int r = 0; r < KOKSMA__RANK_REPLICATES; r++) {
        e.without[r] = mean;
    }
    return e;
}

TEST_CASE(intervals_by_hand)
{
    const double level = 0.01;
    const koksma__rank_errors a = exact(2, 0.4, 16), b = exact(1, 0, 16);
    const double half = koksma__student_quantile(0.99, 15) * 0.1; /* only a varies */
    koksma__estimate e = koksma__rank_error(&a, level);
    assert_near(e.value, 2, 1e-15);
    assert_near(e.low, 2 - half, 1e-9);
    assert_near(e.high, 2 + half, 1e-9);
    e = koksma__rank_quotient(&a, &b, level);
    assert_near(e.value, 2, 1e-15);
    assert_near(e.low, 2 - half, 1e-6);
    assert_near(e.high, 2 + half, 1e-6);
    const koksma__rank_levels levels = {level, level};
    assert_int_equal(koksma__rank_judge(&a, &b, levels), KOKSMA__RANK_MORE);
    assert_int_equal(koksma__rank_judge(&b, &a, levels), KOKSMA__RANK_LESS);
}

/* The parts of alpha that a pair's rounds spend: by the root of the information, at most all of it and a fifth, and 2 % a
   round when nothing is left. Each "different" has two bounds. */
TEST_CASE(levels_by_hand)
{
    koksma__rank_errors a[20], b[20];
    double sum = 0;
    for (int round = 0; round < 20; round++) {
        const size_t n = koksma__rank_trials(round);
        a[round] = b[round] = exact(1, 0.1, n);
        const double information = 0.0035 / (0.1 * sqrt(2.0 / (double)n)),
                     before = round ? 0.0035 / (0.1 * sqrt(2.0 / (double)koksma__rank_trials(round - 1))) : 0;
        const double part = fmax(sqrt(fmin(information, 1)) - sqrt(fmin(before, 1)), 0.02);
        const koksma__rank_levels levels = koksma__rank_levels_of(0.05, &a[round], &b[round], !round);
        assert_near(levels.differ, 0.025 * 1.2 * part, 1e-15);
        assert_near(levels.same, 0.0125, 1e-15);
        sum += information < 1 ? 2 * levels.differ : 0;
    }
    assert_true(sum > 0.05 && sum < 1.2 * 0.05);
    const koksma__rank_errors sure = exact(1, 1e-6, 8);
    assert_near(koksma__rank_levels_of(0.05, &sure, &sure, true).differ, 0.025, 0);
    const size_t trials[] = {8, 12, 16, 24, 32, 48, 64};
    for (int round = 0; round < 7; round++) {
        assert_int_equal(koksma__rank_trials(round), trials[round]);
    }
    assert_int_equal(koksma__rank_trials(KOKSMA__RANK_ROUNDS - 1), KOKSMA_MAX_RANK_TRIALS);
}

/* What pairs that are decided to be different no longer need goes to the others. With exact means a pair is decided by
   its difference; the others are alike. */
TEST_CASE(shares_of_decided_pairs_go_to_others)
{
    koksma__rank_table table;
    const double means[] = {1, 1, 1.005, 2};
    assert_ok(koksma__rank_table_init(&table, 4, 0.06));
    assert_near(koksma__rank_pair_alpha(&table), 0.06 / 6, 1e-15);
    for (size_t i = 0; i < 4; i++) {
        table.entrants[i].rounds[table.entrants[i].n_rounds++] = exact(means[i], i == 0 ? 0.4 : 0, 8);
    }
    assert_ok(koksma__rank_decide(&table, NULL));
    assert_int_equal(table.pairs[1 * 4 + 3].verdict, KOKSMA__RANK_LESS);
    assert_int_equal(table.pairs[1 * 4 + 2].verdict, KOKSMA__RANK_SAME);
    assert_int_equal(table.pairs[0 * 4 + 1].verdict, KOKSMA__RANK_OPEN);
    assert_int_equal(table.pairs[0 * 4 + 3].verdict, KOKSMA__RANK_LESS);
    assert_near(koksma__rank_pair_alpha(&table), 0.06 / 3, 1e-15); /* 0 and 1, 0 and 2 are open, 1 and 2 the same */
    assert_near(table.pairs[0 * 4 + 1].alpha, 0.06 / 3, 1e-15);
    const koksma__estimate same = koksma__rank_compare(&table, 2, 1), wide = koksma__rank_compare(&table, 0, 1);
    assert_true(same.low >= 1 / 1.02 && same.high <= 1.02);
    assert_true(wide.low < 0.8 && wide.high > 1.2);
    table.entrants[3].out = true; /* what cannot be ranked has no share, and no decision to lose */
    assert_near(koksma__rank_pair_alpha(&table), 0.06 / 3, 1e-15);
    koksma__rank_table_fini(&table);
}

/* The jackknife removes a bias of b/k and knows the deviation of a mean. */
TEST_CASE(references_by_hand)
{
    enum { K = KOKSMA__RANK_REPLICATES };
    koksma__rank_errors a = exact(1, 0, 8);
    double squares = 0;
    for (int r = 0; r < K;
         r++) { /* the error is 0.84 + 0.16 * 16 / k + the mean of d over the replicates that are in */
        const double d = (r - 7.5) / 100;
        squares += d * d;
        a.without[r] = 0.84 + 0.16 * K / (K - 1) - d / (K - 1);
    }
    const koksma__estimate e = koksma__rank_error(&a, 0.01);
    const double error = sqrt(squares / (K - 1) / K);
    assert_near(e.value, 0.84, 1e-12);
    assert_near(e.high - e.value, koksma__student_quantile(0.99, K - 1) * error + 0.16, 1e-9);
}

TEST_CASE(equal_errors_are_equal)
{
    const koksma__rank_errors zero = exact(0, 0, 8), one = exact(1, 0, 8), more = exact(1.0199, 0, 8),
                              most = exact(1.0201, 0, 8), single = exact(1, NAN, 1);
    const koksma__rank_levels levels = {1e-3, 1e-3};
    assert_int_equal(koksma__rank_judge(&zero, &zero, levels), KOKSMA__RANK_SAME);
    assert_near(koksma__rank_quotient(&zero, &zero, 1e-3).value, 1, 0);
    assert_int_equal(koksma__rank_judge(&one, &one, levels), KOKSMA__RANK_SAME);
    assert_int_equal(koksma__rank_judge(&one, &more, levels), KOKSMA__RANK_SAME);
    assert_int_equal(koksma__rank_judge(&one, &most, levels), KOKSMA__RANK_LESS);
    assert_int_equal(koksma__rank_judge(&one, &single, levels), KOKSMA__RANK_OPEN);
    assert_int_equal(koksma__rank_judge(&zero, &one, levels), KOKSMA__RANK_LESS);
}

/* The number of trials that is foretold is the smallest that decides if nothing changes. */
TEST_CASE(trials_are_foretold)
{
    const koksma__rank_errors a = exact(1, 0.05, 8), b = exact(1.03, 0.05, 8);
    const size_t n = koksma__rank_trials_needed(&a, &b, 0.01);
    koksma__rank_errors rounds_a[16], rounds_b[16];
    assert_true(n > 8 && n <= 256);
    for (int round = 0; koksma__rank_trials(round) <= n; round++) {
        const size_t trials = koksma__rank_trials(round);
        rounds_a[round] = exact(1, 0.05, trials);
        rounds_b[round] = exact(1.03, 0.05, trials);
        const koksma__rank_levels levels = koksma__rank_levels_of(0.01, &rounds_a[round], &rounds_b[round], !round);
        assert_int_equal(koksma__rank_judge(&rounds_a[round], &rounds_b[round], levels),
                         trials < n ? KOKSMA__RANK_OPEN : KOKSMA__RANK_LESS);
    }
}

/* ---- Coherent errors ------------------------------------------------------------------------------------ */

/* Of patterns 0 .. 3 those that are coherent by the bits of `coherent`, with these means, known exactly. */
static void decide(koksma__rank_table *table, const double *means, unsigned coherent, size_t present)
{
    assert_ok(koksma__rank_table_init(table, 4, 0.04));
    for (size_t i = 0; i < present; i++) {
        table->entrants[i].coherent = coherent >> i & 1;
        table->entrants[i].rounds[table->entrants[i].n_rounds++] = exact(means[i], 0, 8);
    }
    assert_ok(koksma__rank_decide(table, NULL));
}

/* For every set of coherent errors, what is advised has the smallest mean of all others, and the leader is the same
   for all of them. */
TEST_CASE(the_best_without_bands_is_advised)
{
    static const double means[] = {3, 1, 4, 2};
    static const size_t order[] = {1, 3, 0, 2};
    koksma__rank_table table;
    for (unsigned coherent = 0; coherent < 16; coherent++) {
        size_t best = 0;
        while (best < 4 && coherent >> order[best] & 1) {
            best++;
        }
        decide(&table, means, coherent, 4);
        assert_int_equal(table.leader, 1);
        assert_int_equal(table.advised, best < 4 ? order[best] : KOKSMA__RANK_NOBODY);
        assert_true(koksma__rank_reached(&table, KOKSMA__RANK_FIND_LEADER));
        assert_int_equal(koksma__rank_reached(&table, KOKSMA__RANK_FIND_ADVISED), best < 4);
        koksma__rank_table_fini(&table);
        decide(&table, means, coherent, 3); /* nothing is known of the last */
        assert_int_equal(table.leader, KOKSMA__RANK_NOBODY);
        assert_int_equal(table.advised, KOKSMA__RANK_NOBODY);
        koksma__rank_table_fini(&table);
    }
}

/* The excess by its definition: the largest of the bounds on quotients, the least of all rounds; better patterns, coherent
   ones and those without a round do not count. */
TEST_CASE(excess_by_hand)
{
    static const double means[] = {1.01, 1, 1.5, 0.5};
    koksma__rank_table table;
    decide(&table, means, 8, 3); /* exact errors: 3 has no round */
    assert_near(koksma__rank_excess(&table, 0, false), 0.01, 1e-6);
    assert_near(koksma__rank_excess(&table, 2, false), 0.5, 1e-6);
    assert_true(isinf(koksma__rank_excess(&table, 3, false)));
    koksma__rank_table_fini(&table);
    decide(&table, means, 8, 4);
    assert_near(koksma__rank_excess(&table, 1, false), 1, 1e-6);
    assert_near(koksma__rank_excess(&table, 2, true), 0.5, 1e-6);
    assert_true(isinf(koksma__rank_excess(&table, 3, true)) && !(koksma__rank_excess(&table, 3, false) > 0));
    koksma__rank_table_fini(&table);
    assert_ok(koksma__rank_table_init(&table, 2, 0.04));
    static const double spreads[] = {0.02, 0.05}; /* the second round knows less */
    for (size_t i = 0; i < 2; i++) {
        for (int r = 0; r < 2; r++) {
            table.entrants[i].rounds[r] = exact(1, spreads[r], koksma__rank_trials(r));
        }
    }
    table.entrants[0].n_rounds = table.entrants[1].n_rounds = 1;
    assert_ok(koksma__rank_decide(&table, NULL));
    const double after_one = koksma__rank_compare(&table, 0, 1).high - 1;
    assert_near(koksma__rank_excess(&table, 0, false), after_one, 1e-12);
    table.entrants[0].n_rounds = table.entrants[1].n_rounds = 2;
    assert_ok(koksma__rank_decide(&table, NULL));
    assert_true(koksma__rank_compare(&table, 0, 1).high - 1 > after_one);
    assert_near(koksma__rank_excess(&table, 0, false), after_one, 1e-12);
    koksma__rank_table_fini(&table);
}

/* Open pairs matter for the advice where neither error is coherent and nothing without bands is better than both. */
TEST_CASE(pairs_that_matter_for_advice)
{
    koksma__rank_table table;
    assert_ok(koksma__rank_table_init(&table, 4, 0.04));
    for (size_t i = 0; i < 4; i++) {
        table.entrants[i].coherent = i == 0;
        table.entrants[i].rounds[table.entrants[i].n_rounds++] = exact(i == 3 ? 9 : 1 + 0.03 * (double)i, 0.1, 8);
    }
    assert_ok(koksma__rank_decide(&table, NULL));
    assert_true(koksma__rank_matters(&table, 0, 1, KOKSMA__RANK_FIND_LEADER));
    assert_true(!koksma__rank_matters(&table, 0, 1, KOKSMA__RANK_FIND_ADVISED));
    assert_true(koksma__rank_matters(&table, 1, 2, KOKSMA__RANK_FIND_ADVISED));
    assert_true(!koksma__rank_matters(&table, 1, 3, KOKSMA__RANK_FIND_ADVISED)); /* decided */
    assert_true(koksma__rank_matters(&table, 0, 1, KOKSMA__RANK_ORDER_ALL));
    koksma__rank_table_fini(&table);
}

/* A table of patterns 0, 1 and 2 at another size, with the same deviation of trials. */
static koksma_rank_check_state check_first(const double means[3], double sd, size_t first, size_t *best)
{
    koksma__rank_table table;
    assert_ok(koksma__rank_table_init(&table, 3, 0.005));
    for (size_t i = 0; i < 3; i++) {
        table.entrants[i].rounds[table.entrants[i].n_rounds++] = exact(means[i], sd, 8);
    }
    assert_ok(koksma__rank_decide(&table, NULL));
    *best = table.leader;
    const koksma_rank_check_state state = koksma__rank_check_best(&table, first, table.leader);
    table.entrants[first].out = true; /* it cannot render that size */
    assert_int_equal(koksma__rank_check_best(&table, first, table.leader), KOKSMA_RANK_UNSETTLED);
    koksma__rank_table_fini(&table);
    return state;
}

static bool ends_at_once(void *context, double fraction)
{
    (void)fraction;
    ++*(size_t *)context;
    return false;
}

/* The pairs of hundreds of patterns take seconds: an end of the run is seen among them, and no leader is named. */
TEST_CASE(decisions_end_with_the_run)
{
    enum { N = 100 };
    size_t asked = 0;
    const koksma_run run = {.keep_going = ends_at_once, .context = &asked};
    koksma__rank_table table;
    assert_ok(koksma__rank_table_init(&table, N, 0.04));
    for (size_t i = 0; i < N; i++) {
        table.entrants[i].rounds[table.entrants[i].n_rounds++] = exact(pow(1.1, (double)i), 0, 8);
    }
    assert_int_equal(koksma__rank_decide(&table, &run), KOKSMA_INTERRUPTED);
    assert_int_equal(asked, 1);
    assert_int_equal(table.leader, KOKSMA__RANK_NOBODY);
    assert_int_equal(table.pairs[(N - 2) * N + N - 1].verdict, KOKSMA__RANK_OPEN);
    assert_ok(koksma__rank_decide(&table, NULL)); /* what is left */
    assert_int_equal(table.leader, 0);
    assert_int_equal(table.pairs[(N - 2) * N + N - 1].verdict, KOKSMA__RANK_LESS);
    koksma__rank_table_fini(&table);
}

/* Pattern 0 is the first at the size asked for. Another size overturns that where another pattern is decided to be
   the first there and 0 is decided not to be: not where they are the same within 2 %, nor where trials vary too much
   to decide. */
TEST_CASE(first_places_at_other_sizes)
{
    static const struct {
        double means[3], sd;
        koksma_rank_check_state state;
        size_t best;
    } rows[] = {
        {{1, 1.3, 1.5}, 0.001, KOKSMA_RANK_CONFIRMED, 0},
        {{1.3, 1, 1.5}, 0.001, KOKSMA_RANK_OVERTURNED, 1},
        {{1.3, 1.1, 1}, 0.001, KOKSMA_RANK_OVERTURNED, 2},
        {{1.03, 1, 1.5}, 0.001, KOKSMA_RANK_OVERTURNED, 1},
        {{1.03, 1, 1.5}, 0.1, KOKSMA_RANK_UNSETTLED, KOKSMA__RANK_NOBODY}, /* 0 and 1 are open */
        {{1.5, 1, 1.03}, 0.1, KOKSMA_RANK_UNSETTLED, KOKSMA__RANK_NOBODY}, /* so is who is the first */
        {{1.01, 1, 1.5}, 0.001, KOKSMA_RANK_CONFIRMED, 1},                 /* the same as the best */
    };
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++) {
        size_t best;
        assert_int_equal(check_first(rows[r].means, rows[r].sd, 0, &best), rows[r].state);
        assert_int_equal(best, rows[r].best);
    }
}

static const char *const banded[] = {"zaremba", "regular", "random", "jittered"};

static const koksma_rank_row *row_of(const koksma_rank_row *rows, size_t pattern)
{
    while (rows->pattern != pattern) {
        rows++;
    }
    return rows;
}

/* In slanted squares Zaremba and regular points make Moire (Mitchell 1992), random and jittered ones don't. However
   many threads and trials there are, the first 8 trials say so with the same bits. */
TEST_CASE(bands_are_found)
{
    koksma_rank_row first[4], rows[4];
    koksma_ranking ranking;
    for (int i = 0; i < 3; i++) {
        const koksma_rank_options options = {.scene = "checker-45",
                                             .patterns = banded,
                                             .n_patterns = 4,
                                             .spp = 4,
                                             .width = 48,
                                             .height = 36,
                                             .max_trials = i == 2 ? 64 : 8,
                                             .one_size = true};
        const koksma_run run = {.threads = i == 1 ? 3 : 1};
        assert_ok(koksma_rank_patterns(&options, &run, i ? rows : first, &ranking));
        for (size_t p = 0; p < 4; p++) {
            const koksma_rank_row *row = row_of(i ? rows : first, p), *other = row_of(first, p);
            assert_int_equal(row->coherence.images, 8);
            assert_int_equal(row->coherence.coherent, p < 2);
            assert_true(p >= 2 || row->coherence.coherence > 20);
            assert_true(row->coherence.coherence == other->coherence.coherence &&
                        row->coherence.p == other->coherence.p);
            assert_true(row->coherence.low == other->coherence.low && row->coherence.high == other->coherence.high);
        }
        assert_int_equal(ranking.n_coherent, 2);
        assert_true(ranking.advised && (i ? rows : first)[ranking.advised_row].pattern == 3);
    }
}

/* A pattern without random numbers has the coherence of a picture that is compared with a reference by hand, but for
   what the references differ by. */
TEST_CASE(coherence_is_that_of_the_pictures)
{
    koksma_rank_row rows[4];
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image, reference;
    koksma_coherence sums;
    koksma_coherence_values values;
    koksma_ranking ranking;
    const koksma_rank_options rank = {.scene = "checker-45",
                                      .patterns = banded,
                                      .n_patterns = 4,
                                      .spp = 4,
                                      .width = 48,
                                      .height = 36,
                                      .max_trials = 8,
                                      .one_size = true};
    assert_ok(koksma_rank_patterns(&rank, NULL, rows, &ranking));
    assert_ok(koksma_scene_open("checker-45", &scene));
    koksma_render_options_init(&options, scene);
    options.width = 48;
    options.height = 36;
    options.spp = 900;
    assert_ok(koksma_pattern_spec("jittered", &options.pattern));
    assert_ok(koksma_render(scene, &options, NULL, &reference));
    options.spp = 4;
    for (size_t p = 0; p < 2; p++) {
        assert_ok(koksma_pattern_spec(banded[p], &options.pattern));
        assert_ok(koksma_render(scene, &options, NULL, &image));
        assert_ok(koksma_coherence_init(&sums, 48, 36));
        assert_ok(koksma_coherence_add(&sums, &image, &reference));
        koksma_coherence_find(&sums, &values);
        /* Its reference is another, of as much noise: 1/15 of the error of 4 samples. */
        assert_near(row_of(rows, p)->coherence.coherence / values.coherence, 1, 0.04);
        koksma_coherence_fini(&sums);
        koksma_image_fini(&image);
    }
    koksma_image_fini(&reference);
    koksma_scene_close(scene);
}

/* Renders trial t of a ranking with an adaptive method, as `koksma render --adaptive` does with that seed. */
static void render_adaptively(const koksma_scene *scene, const char *pattern, size_t t, koksma_image *image)
{
    koksma_render_options options;
    koksma_adaptive_options adaptive;
    koksma_layers layers;
    koksma_render_options_init(&options, scene);
    assert_ok(koksma_render_patterns(pattern, &options));
    assert_ok(koksma_adaptive_parse("contrast", &adaptive));
    options.width = 48;
    options.height = 36;
    options.spp = 4; /* a quarter of the budget */
    adaptive.budget = 16;
    options.seed = koksma__job_seed("rank|%016llx|%s|adaptive=contrast|16|48x36|%zu",
                                    (unsigned long long)koksma_scene_hash(scene), pattern, t);
    assert_ok(koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, NULL));
    *image = layers.image;
    layers.image = (koksma_image){0};
    koksma_layers_fini(&layers);
}

/* The error, robust error and coherence of a pattern with an adaptive method are those of eight images of the method and
   the trials' seeds, against a reference that is not adaptive. The references differ by 1/16 of the error. */
TEST_CASE(adaptive_rankings_are_those_of_the_pictures)
{
    enum { TRIALS = 8 };
    static const char *const patterns[] = {"random", "n-rooks", "regular"};
    koksma_rank_row rows[3];
    koksma_ranking ranking;
    koksma_scene *scene;
    koksma_render_options o;
    koksma_image image, reference;
    koksma_rank_options rank = {.scene = "ball",
                                .patterns = patterns,
                                .n_patterns = 3,
                                .spp = 16,
                                .width = 48,
                                .height = 36,
                                .max_trials = TRIALS,
                                .one_size = true,
                                .adaptive = "contrast"};
    double means[2];
    assert_ok(koksma_rank_patterns(&rank, NULL, rows, &ranking));
    assert_ok(koksma_scene_open("ball", &scene));
    koksma_render_options_init(&o, scene);
    o.width = 48;
    o.height = 36;
    o.spp = 4096;
    assert_ok(koksma_pattern_spec("jittered", &o.pattern));
    assert_ok(koksma_render(scene, &o, NULL, &reference));
    for (size_t p = 0; p < 2; p++) {
        const koksma_rank_row *row = row_of(rows, p);
        koksma_coherence sums;
        koksma_coherence_values values;
        double robust = means[p] = 0;
        assert_ok(koksma_coherence_init(&sums, 48, 36));
        for (size_t t = 0; t < TRIALS; t++) {
            koksma_metric_value value;
            render_adaptively(scene, patterns[p], t, &image);
            assert_ok(koksma_metric_evaluate(&(koksma_metric_spec){koksma_metric_find("mae"), {0}}, &image,
                                             &reference, &value));
            assert_ok(koksma_coherence_add(&sums, &image, &reference));
            means[p] += value.value / TRIALS;
            robust += value.robust / TRIALS;
            koksma_image_fini(&image);
        }
        koksma_coherence_find(&sums, &values);
        assert_true(row->trials == TRIALS && row->biased);
        assert_near(row->mean / means[p], 1, 0.01);
        assert_near(row->robust / robust, 1, 0.04); /* the reference has up to 1/4 of the error, so up to 1/32 more */
        assert_near(row->coherence.coherence / values.coherence, 1, 0.05);
        assert_true(row->coherence.coherent == values.coherent);
        koksma_coherence_fini(&sums);
    }
    assert_true(row_of(rows, (size_t)(means[1] < means[0]))->position == 1);
    /* contrast needs other samples in each round, which regular does not have */
    assert_true(row_of(rows, 2)->state == KOKSMA_RANK_REFUSED && strstr(row_of(rows, 2)->reason, "contrast"));
    rank.adaptive = "hierarchical"; /* places its own samples, so that there is nothing to rank */
    assert_int_equal(koksma_rank_patterns(&rank, NULL, rows, &ranking), KOKSMA_ARGUMENT);
    koksma_image_fini(&reference);
    koksma_scene_close(scene);
}

static void keep_look(void *context, const double *errors)
{
    memcpy(context, errors, 4 * sizeof *errors);
}

/* A first look is near the root mean square error that the ranking finds against its reference; it says nothing of patterns
   that may be biased, and changes no row. */
TEST_CASE(first_look_is_the_error)
{
    static const char *const patterns[] = {"random", "jittered", "regular", "n-rooks"};
    koksma_rank_row looked[4], rows[4];
    koksma_ranking ranking;
    double errors[4] = {-1, -1, -1, -1};
    koksma_metric_spec rmse;
    assert_ok(koksma_metric_parse("rmse", &rmse));
    koksma_rank_options options = {.scene = "ball",
                                   .patterns = patterns,
                                   .n_patterns = 4,
                                   .spp = 16,
                                   .width = 96,
                                   .height = 72,
                                   .metric = &rmse,
                                   .max_trials = 16,
                                   .one_size = true};
    assert_ok(koksma_rank_patterns(&options, NULL, rows, &ranking));
    options.look = keep_look;
    options.look_context = errors;
    assert_ok(koksma_rank_patterns(&options, NULL, looked, &ranking));
    for (size_t p = 0; p < 4; p++) {
        const koksma_rank_row *row = row_of(looked, p), *other = row_of(rows, p);
        assert_true(row->mean == other->mean && row->low == other->low && row->high == other->high);
        assert_true(row->robust == other->robust && row->coherence.coherence == other->coherence.coherence);
        assert_true(row->trials == other->trials && row->position == other->position);
        assert_true(p == 2 ? isnan(errors[p]) : fabs(errors[p] / row->mean - 1) < 0.1);
    }
}

/* ---- Pictures under a test's clock ---------------------------------------------------------------------- */

static atomic_ullong ticks;

static double ticking(void)
{
    return (double)atomic_fetch_add(&ticks, 1);
}

static const char *const three[] = {"random", "jittered", "n-rooks"};

static koksma_rank_options small(void)
{
    return (koksma_rank_options){
        .scene = "ball", .patterns = three, .n_patterns = 3, .spp = 4, .width = 24, .height = 18};
}

static koksma_ranking rank_small(const koksma_rank_options *options, int threads, koksma_rank_row *rows)
{
    koksma_ranking ranking;
    const koksma_run run = {.threads = threads};
    assert_ok(koksma_rank_patterns(options, &run, rows, &ranking));
    return ranking;
}

static void assert_same_or_unchecked(const koksma_rank_check_result *a, const koksma_rank_check_result *whole)
{
    assert_true(!a->state || a->state == whole->state);
    assert_true(a->state != KOKSMA_RANK_OVERTURNED || a->pattern == whole->pattern);
}

/* Wherever the time limit cuts the work, on any number of threads: the same best pattern or none, the same decisions
   or none, and always rows. Limits rise until two of them cut nothing; longer ones would repeat the whole work. */
static void cut_everywhere(koksma_rank_options options, double step)
{
    koksma_rank_row whole[3], rows[3];
    const koksma_ranking all = rank_small(&options, 1, whole);
    size_t settled = 0, cut = 0, uncut = 0, checked = 0;
    assert_true(all.settled && all.complete && !all.cut_short && all.n == 3);
    assert_true(all.checks[0].advice.state && all.checks[1].advice.state);
    assert_true(all.checks[0].first.state && all.checks[1].first.state);
    koksma__set_clock(ticking);
    for (double limit = 1; uncut < 4; limit *= step) {
        assert_true(limit < 1e6);
        for (int threads = 1; threads <= 2; threads++) {
            options.time_limit_s = limit;
            const koksma_ranking r = rank_small(&options, threads, rows);
            cut += r.cut_short;
            uncut += !r.cut_short;
            settled += r.settled;
            assert_true(r.settled || r.needed_trials > 0);
            assert_true(r.width == 24 && r.height == 18 && r.n + r.n_slow == 3);
            /* a pattern that the time did not suffice for is left out of the decision, perhaps the best one */
            const bool kept = row_of(rows, whole[0].pattern)->state == KOKSMA_RANK_RANKED &&
                              row_of(rows, whole[all.advised_row].pattern)->state == KOKSMA_RANK_RANKED;
            assert_true(kept || r.n_slow > 0);
            assert_true(!r.settled || !kept || rows[0].pattern == whole[0].pattern);
            assert_true(!r.settled || rows[0].decision == KOKSMA_RANK_BEST);
            assert_true(!r.advised || !kept || rows[r.advised_row].pattern == whole[all.advised_row].pattern);
            for (int i = 0; i < 2 && kept; i++) {
                checked += r.checks[i].first.state != KOKSMA_RANK_UNCHECKED;
                assert_same_or_unchecked(&r.checks[i].advice, &all.checks[i].advice);
                assert_same_or_unchecked(&r.checks[i].first, &all.checks[i].first);
            }
            for (size_t i = 0; i < 3; i++) {
                const koksma_rank_row *row = &rows[i], *other = row_of(whole, row->pattern);
                assert_true(i >= r.n || row->coherence.coherence == other->coherence.coherence);
                assert_true(i >= r.n || row->coherence.coherent == other->coherence.coherent);
                assert_true((row->state == KOKSMA_RANK_RANKED) == (i < r.n) && (row->position > 0) == (i < r.n));
                assert_true(row->position <= other->position);
                assert_true(!r.settled || !kept || !row->decision || row->decision == other->decision);
                assert_true((row->reason[0] != 0) == (row->state != KOKSMA_RANK_RANKED));
            }
        }
    }
    koksma__set_clock(NULL);
    assert_true(cut >= 4 && settled >= 4 && checked >= 2);
}

/* In the second scene the pattern with the least error is in bands, and another one is advised. */
TEST_CASE(time_limits_only_cut)
{
    static const char *const patterns[] = {"zaremba", "jittered", "random"};
    koksma_rank_options options = small();
    cut_everywhere(options, TEST_FEW ? 5 : 1.5);
    options.scene = "checker-45";
    options.patterns = patterns;
    cut_everywhere(options, 4);
}

static bool stop_at_200(void *context, double fraction)
{
    (void)fraction;
    return ++*(int *)context < 200;
}

static bool stop_at_once(void *context, double fraction)
{
    (void)context;
    (void)fraction;
    return false;
}

/* An interruption is not overtaken by a time limit, also where both come between two looks. */
TEST_CASE(interruptions_come_first)
{
    koksma_rank_row rows[3];
    koksma_ranking ranking;
    koksma_rank_options options = small();
    int asked = 0;
    const koksma_run at_once = {.threads = 1, .keep_going = stop_at_once},
                     later = {.threads = 1, .keep_going = stop_at_200, .context = &asked};
    koksma__set_clock(ticking);
    for (double limit = 1e-3; limit < 100; limit *= 10) {
        options.time_limit_s = limit;
        assert_int_equal(koksma_rank_patterns(&options, &at_once, rows, &ranking), KOKSMA_INTERRUPTED);
    }
    options.time_limit_s = 0;
    assert_int_equal(koksma_rank_patterns(&options, &later, rows, &ranking), KOKSMA_INTERRUPTED);
    koksma__set_clock(NULL);
}

/* Long rows of a picture are no longer than others between two looks. */
static int looks_of(int spp)
{
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image;
    int asked = -1000000;
    assert_ok(koksma_scene_open("ball", &scene));
    koksma_render_options_init(&options, scene);
    options.spp = spp;
    options.width = 64;
    options.height = 2;
    const koksma_run run = {.threads = 1, .keep_going = stop_at_200, .context = &asked};
    assert_ok(koksma_render(scene, &options, &run, &image));
    koksma_image_fini(&image);
    koksma_scene_close(scene);
    return asked + 1000000;
}

TEST_CASE(rows_of_many_samples_are_left)
{
    assert_true(looks_of(1024) >= 2 * 64 * 1024 / (2 * 4096));
}

/* A clock that leaps at two of its calls. */
static unsigned long long first_leap, second_leap;

static double leaping(void)
{
    const unsigned long long call = atomic_fetch_add(&ticks, 1);
    return (double)call + (call >= first_leap ? 6000 : 0) + (call >= second_leap ? 6000 : 0);
}

/* The best of the patterns of `whole`, or of those but the last of `rows`, which has no rank. */
static size_t best_but(const koksma_rank_row *whole, const koksma_rank_row *rows)
{
    return whole[rows && whole[0].pattern == rows[2].pattern].pattern;
}

/* A trial that takes more than its pattern's share puts the pattern off, and the others are ranked without it: their best
   is decided when the time ends before its turn comes again, and all are ranked when it does not, with the same best
   pattern. */
TEST_CASE(slow_patterns_are_put_off)
{
    koksma_rank_row whole[3], rows[3];
    koksma_rank_options options = small();
    static const unsigned long long gaps[] = {145, 190, 1000000};
    size_t left_out = 0, settled = 0, settled_without = 0;
    options.one_size = true;
    rank_small(&options, 1, whole);
    options.time_limit_s = 10000;
    koksma__set_clock(leaping);
    for (unsigned long long call = 30; call < 150; call += test_repeats(4, 8)) {
        for (int g = 0; g < 3; g++) {
            atomic_store(&ticks, 0);
            first_leap = call;
            second_leap = call + gaps[g];
            const koksma_ranking r = rank_small(&options, 1, rows);
            settled += r.settled;
            assert_true(r.n + r.n_slow == 3 &&
                        (!r.settled || rows[0].pattern == best_but(whole, r.n < 3 ? rows : NULL)));
            if (r.n == 2) {
                left_out++;
                settled_without += r.settled;
                assert_true(r.cut_short && !r.complete && (r.settled || (r.needed_trials > 0 && r.needed_s > 0)));
                assert_true(rows[0].position == 1 && rows[2].state == KOKSMA_RANK_TOO_SLOW && rows[2].position == 0);
                assert_true(!rows[1].decision || rows[1].decision == KOKSMA_RANK_WORSE);
            }
        }
    }
    koksma__set_clock(NULL);
    assert_true(left_out >= test_repeats(2, 1) && settled_without >= 1 && settled >= 3);
}

TEST_CASE(patterns_that_cannot_serve)
{
    const char *patterns[] = {"jittered", "n-rooks"};
    koksma_rank_row rows[2];
    koksma_rank_options options = {
        .scene = "ball", .patterns = patterns, .n_patterns = 2, .spp = 7, .width = 8, .height = 6};
    const koksma_ranking r = rank_small(&options, 1, rows);
    assert_true(r.settled && r.complete && r.n == 1 && r.n_slow == 0);
    assert_true(rows[0].pattern == 1 && rows[0].decision == KOKSMA_RANK_BEST);
    assert_true(rows[1].state == KOKSMA_RANK_REFUSED && strstr(rows[1].reason, "jittered"));
}

/* The size is the scene's, or the one asked for, on every machine. */
TEST_CASE(sizes_are_part_of_the_question)
{
    koksma_rank_row rows[3];
    koksma_rank_options options = small();
    options.width = options.height = 0;
    options.scene = "cornell";
    koksma__set_clock(ticking);
    options.time_limit_s = 1e-6;
    const koksma_ranking r = rank_small(&options, 1, rows);
    koksma__set_clock(NULL);
    assert_true(r.width == 128 && r.height == 128 && r.checks[0].width == 64 && r.checks[1].height == 256);
    assert_true(r.cut_short && r.n == 0 && r.n_slow == 3 && isnan(r.reference_error));
}

/* ---- Images with more error in the reference than between the patterns ----------------------------------- */

/* Makes images of the value 10 with normal errors of deviation 1, of pattern "more" 1.03; those of the reference, which
   have 16 times as many samples, have the deviation `context`. */
static koksma_status render_noise(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                  koksma_image *image)
{
    (void)run;
    const double deviation = picture->spp > 1                        ? *(const double *)context
                             : strcmp(picture->pattern, "more") == 0 ? 1.03
                                                                     : 1;
    const koksma_status status = koksma_image_init(image, picture->width, picture->height, 1);
    for (int i = 0; !status && i < picture->width * picture->height; i++) {
        image->pixels[i] = (float)(10 + deviation * normal(picture->seed, 7, (uint64_t)i));
    }
    return status;
}

static koksma_ranking rank_noise(double reference, long long trials)
{
    const char *patterns[] = {"less", "more"};
    koksma_rank_row rows[2];
    const koksma_rank_options options = {.scene = "invented",
                                         .patterns = patterns,
                                         .n_patterns = 2,
                                         .spp = 1,
                                         .width = 8,
                                         .height = 6,
                                         .max_trials = trials,
                                         .one_size = true,
                                         .render = render_noise,
                                         .render_context = &reference};
    return rank_small(&options, 1, rows);
}

/* That no number of trials would decide is said after 256 trials or more, and only where the reference is to blame. */
TEST_CASE(undecidable_only_after_many_trials)
{
    const koksma_ranking few = rank_noise(16, 8), many = rank_noise(16, 1024), good = rank_noise(0.001, 128),
                         more = rank_noise(0.001, 65536);
    assert_true(!few.settled && !few.undecidable && few.trials == 8);
    assert_true(!many.settled && many.undecidable && !many.needed_trials && many.trials >= 256 && many.trials < 1024);
    assert_true(!good.settled && !good.undecidable && good.needed_trials > 128);
    assert_true(more.settled && !more.undecidable && !more.needed_trials && more.trials >= good.needed_trials / 4);
}

/* Images of one value, whose size differs between trials by factors of e^2 and more; the reference is almost
   0. */
static koksma_status render_wild(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                 koksma_image *image)
{
    (void)run;
    const bool reference = !strcmp(picture->pattern, "zero");
    const double size = strlen(picture->pattern) + exp(*(const double *)context * normal(picture->seed, 8, 0));
    const koksma_status status = koksma_image_init(image, picture->width, picture->height, 1);
    for (int i = 0; !status && i < picture->width * picture->height; i++) {
        image->pixels[i] =
            (float)(reference ? 1e-9 * normal(picture->seed, 9, (uint64_t)i) : size * (i % 2 ? 1 : -1));
    }
    return status;
}

/* An interval has both ends or none: where trials vary too much for a quotient there is none, rather than one that begins
   at -100 %. */
TEST_CASE(intervals_have_both_ends)
{
    const char *patterns[] = {"a", "bb", "ccc"};
    size_t none = 0, some = 0;
    for (int k = 0; k < 24; k++) {
        double spread = k % 2 ? 6 : 0.5;
        char scene[8];
        koksma_rank_row rows[3];
        koksma_ranking r;
        snprintf(scene, sizeof scene, "%d", k); /* other seeds */
        const koksma_rank_options options = {.scene = scene,
                                             .patterns = patterns,
                                             .n_patterns = 3,
                                             .spp = 1,
                                             .width = 2,
                                             .height = 2,
                                             .max_trials = 8,
                                             .one_size = true,
                                             .render = render_wild,
                                             .render_context = &spread,
                                             .reference = "zero"};
        assert_ok(koksma_rank_patterns(&options, NULL, rows, &r));
        for (int i = 0; i < 3; i++) {
            assert_true(isfinite(rows[i].behind_low) == isfinite(rows[i].behind_high));
            assert_true(isnan(rows[i].behind_low) == isnan(rows[i].behind_high));
            assert_true(isfinite(rows[i].low) && isfinite(rows[i].high));
            none += isnan(rows[i].behind_low);
            some += rows[i].behind_low < rows[i].behind && rows[i].behind < rows[i].behind_high;
        }
    }
    assert_true(none > 12 && some > 12);
}

/* Images of noise, half as much again for "ccc", in which one pixel in 1,200 has an error that differs between trials by
   factors of e^5 and exceeds all others together; the reference is almost 0. */
static koksma_status render_firefly(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                                    koksma_image *image)
{
    (void)context;
    (void)run;
    const double size = !strcmp(picture->pattern, "zero") ? 1e-9 : !strcmp(picture->pattern, "ccc") ? 1.5 : 1;
    const koksma_status status = koksma_image_init(image, picture->width, picture->height, 1);
    const int n = picture->width * picture->height, hot = (int)(picture->seed % (uint64_t)n);
    for (int i = 0; !status && i < n; i++) {
        image->pixels[i] = (float)(size * normal(picture->seed, 10, (uint64_t)i));
    }
    if (!status && size > 1e-9) {
        image->pixels[hot] = (float)(1e4 * exp(5 * normal(picture->seed, 11, 0)));
    }
    return status;
}

/* Where the error is that of single pixels, a pattern is chosen by the others: one of those with the least noise. */
TEST_CASE(fireflies_leave_a_choice)
{
    const char *patterns[] = {"a", "bb", "ccc"};
    koksma_rank_row rows[3];
    koksma_ranking r;
    const koksma_rank_options options = {.scene = "fireflies",
                                         .patterns = patterns,
                                         .n_patterns = 3,
                                         .spp = 1,
                                         .width = 40,
                                         .height = 30,
                                         .max_trials = 16,
                                         .one_size = true,
                                         .render = render_firefly,
                                         .reference = "zero"};
    assert_ok(koksma_rank_patterns(&options, NULL, rows, &r));
    assert_true(!r.settled && !r.advised && r.without_few);
    assert_true(r.within > 0 && r.within <= KOKSMA_RANK_TIE && rows[r.use_row].pattern != 2);
    assert_true(rows[0].top_share > 0.5 && rows[0].robust < 0.1 * rows[0].mean);
}
