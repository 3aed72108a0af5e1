/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How often rankings decide wrongly and how many trials they take, by simulation: the errors of patterns are drawn from
 * laws with known means and an exact reference, and rounds are run as a contest runs them, until every pair is decided
 * or a pattern has 4,096 trials. As a test it runs few rankings; with their number as its argument it prints the table
 * of docs/findings/ranking-decisions.md instead:
 *
 *     build/release/tests/test_ranking_power 2000
 */
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "study/ranking/ranking_decisions.h"
#include "test.h"

enum { MOST = 10, ROUNDS = 19 };

/* ---- Worlds --------------------------------------------------------------------------------------------------- */

/* A trial's error divided by its mean: 1 + spread z, exp(spread z - spread^2 / 2), or 1 + spread t with Student's t of 3
   degrees. */
typedef enum law { NORMAL, LOG_NORMAL, STUDENT } law;

typedef struct world {
    const char *name;
    law law;
    double spread;
    size_t n;
    double means[MOST];
} world;

static const world worlds[] = {
    {"2 equal, normal, 1/2 %", NORMAL, 0.005, 2, {1, 1}},
    {"2 equal, normal, 2 %", NORMAL, 0.02, 2, {1, 1}},
    {"2 equal, normal, 5 %", NORMAL, 0.05, 2, {1, 1}},
    {"2 equal, normal, 15 %", NORMAL, 0.15, 2, {1, 1}},
    {"2 equal, normal, 50 %", NORMAL, 0.5, 2, {1, 1}},
    {"5 equal, normal, 5 %", NORMAL, 0.05, 5, {1, 1, 1, 1, 1}},
    {"5 equal, normal, 15 %", NORMAL, 0.15, 5, {1, 1, 1, 1, 1}},
    {"10 equal, normal, 5 %", NORMAL, 0.05, 10, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1}},
    {"2 equal, log-normal, 50 %", LOG_NORMAL, 0.5, 2, {1, 1}},
    {"5 equal, log-normal, 30 %", LOG_NORMAL, 0.3, 5, {1, 1, 1, 1, 1}},
    {"3 equal, Student's t, 10 %", STUDENT, 0.1, 3, {1, 1, 1}},
    {"2 at the edge of equal (2 %), normal, 5 %", NORMAL, 0.05, 2, {1, 1.0201}},
    {"2 apart by 5 %, normal, 15 %", NORMAL, 0.15, 2, {1, 1.05}},
    {"2 apart by 20 %, normal, 15 %", NORMAL, 0.15, 2, {1, 1.2}},
    {"2 apart by 20 %, log-normal, 50 %", LOG_NORMAL, 0.5, 2, {1, 1.2}},
    {"5, two of them equal, normal, 15 %", NORMAL, 0.15, 5, {1, 1, 1.1, 1.3, 2}},
    {"5 apart by 3 to 30 %, normal, 10 %", NORMAL, 0.1, 5, {1, 1.03, 1.1, 1.2, 1.3}},
    {"5: two pairs of equals, 2 % apart, normal, 5 %", NORMAL, 0.05, 5, {1, 1, 1.0201, 1.0201, 2}},
    {"6 apart by factors of 1.5, log-normal, 50 %", LOG_NORMAL, 0.5, 6, {1, 1.5, 2.25, 3.4, 5, 7.6}},
};
enum { WORLDS = sizeof worlds / sizeof *worlds };

static double drawn(const world *w, uint64_t ranking, size_t pattern, size_t trial)
{
    double u[2];
    koksma__random_pair(ranking, KOKSMA__PURPOSE_TEST, trial, (uint32_t)pattern, u);
    const double turn = cos(2 * M_PI * u[1]), z = sqrt(-2 * log1p(-u[0])) * turn;
    return w->means[pattern] * (w->law == NORMAL ? 1 + w->spread * z
                                : w->law == LOG_NORMAL
                                    ? exp(w->spread * z - w->spread * w->spread / 2)
                                    : 1 + w->spread * sqrt(3 * (pow(1 - u[0], -2.0 / 3) - 1)) * turn);
}

/* ---- One ranking ----------------------------------------------------------------------------------------------- */

typedef struct outcome {
    bool wrong, open; /* whether a pair is decided wrongly, or not at all */
    bool
        misled; /* whether, stopped after some round, a pattern exceeds the best by more than it is said to, at most */
    bool errors_hold, behind_hold; /* whether all intervals hold the true means, or their quotients to the leader's */
    size_t trials;
} outcome;

static void add_round(const world *w, uint64_t ranking, size_t pattern, koksma__rank_entrant *e)
{
    koksma__rank_errors *now = &e->rounds[e->n_rounds], *before = e->n_rounds ? now - 1 : NULL;
    double squares = before ? before->variance * (double)(before->n - 1) : 0;
    *now = (koksma__rank_errors){.n = before ? before->n : 0, .mean = before ? before->mean : 0};
    for (const size_t end = koksma__rank_trials(e->n_rounds); now->n < end;) {
        const double error = drawn(w, ranking, pattern, now->n), off = error - now->mean;
        now->mean += off / (double)++now->n;
        squares += off * (error - now->mean);
    }
    now->variance = squares / (double)(now->n - 1);
    for (int r = 0; r < KOKSMA__RANK_REPLICATES; r++) {
        now->without[r] = now->mean;
    }
    e->n_rounds++;
}

/* Runs the next round: the earliest that a pattern needs. Returns false if none does. */
static bool run_round(const world *w, uint64_t ranking, koksma__rank_table *table)
{
    bool needs[MOST];
    int round = ROUNDS;
    for (size_t i = 0; i < w->n; i++) {
        needs[i] = !table->entrants[i].n_rounds;
        for (size_t j = 0; j < w->n; j++) {
            needs[i] |= koksma__rank_matters(table, i, j, KOKSMA__RANK_ORDER_ALL);
        }
        round = needs[i] && table->entrants[i].n_rounds < round ? table->entrants[i].n_rounds : round;
    }
    for (size_t i = 0; round < ROUNDS && i < w->n; i++) {
        if (needs[i] && table->entrants[i].n_rounds == round) {
            add_round(w, ranking, i, &table->entrants[i]);
        }
    }
    assert_ok(koksma__rank_decide(table, NULL));
    return round < ROUNDS;
}

static bool is_wrong(koksma__rank_verdict verdict, double quotient)
{
    return (verdict == KOKSMA__RANK_LESS && quotient >= 1) || (verdict == KOKSMA__RANK_MORE && quotient <= 1) ||
           (verdict == KOKSMA__RANK_SAME && fabs(log(quotient)) > log(KOKSMA__RANK_EQUAL));
}

static bool exceeds_what_is_said(const world *w, const koksma__rank_table *table)
{
    bool exceeds = false;
    for (size_t i = 0; i < w->n; i++) { /* the first pattern is the best */
        exceeds |= w->means[i] > w->means[0] * (1 + koksma__rank_excess(table, i, false));
    }
    return exceeds;
}

static outcome rank(const world *w, uint64_t ranking)
{
    koksma__rank_table table;
    outcome out = {.errors_hold = true, .behind_hold = true};
    assert_ok(koksma__rank_table_init(&table, w->n, 0.05));
    for (uint64_t round = 0; run_round(w, ranking, &table); round++) {
        out.misled |= ranking % 4 == 1 && round == ranking / 4 % 6 && exceeds_what_is_said(w, &table);
    }
    for (size_t i = 0; i < w->n; i++) {
        const koksma__estimate e =
            koksma__rank_error(koksma__rank_latest(&table, i), koksma__rank_error_level(&table));
        out.trials += koksma__rank_latest(&table, i)->n;
        out.errors_hold &= e.low <= w->means[i] && w->means[i] <= e.high;
        for (size_t j = i + 1; j < w->n; j++) {
            const double quotient = w->means[i] / w->means[j];
            const koksma__rank_verdict verdict = table.pairs[i * w->n + j].verdict;
            const koksma__estimate q =
                ranking % 10 ? (koksma__estimate){0, 0, INFINITY} : koksma__rank_compare(&table, i, j);
            out.wrong |= is_wrong(verdict, quotient);
            out.open |= verdict == KOKSMA__RANK_OPEN;
            out.behind_hold &= q.low <= quotient && quotient <= q.high;
        }
    }
    koksma__rank_table_fini(&table);
    return out;
}

/* ---- Many rankings ----------------------------------------------------------------------------------------------- */

typedef struct summary {
    double wrong, open, misled, errors_hold, behind_hold,
        trials; /* shares of the rankings; mean number of all trials */
} summary;

static summary summary_of(const world *w, uint64_t rankings)
{
    summary s = {0};
    for (uint64_t r = 0; r < rankings; r++) {
        const outcome o = rank(w, r);
        s.wrong += o.wrong / (double)rankings;
        s.open += o.open / (double)rankings;
        s.misled += 4 * o.misled / (double)rankings;
        s.errors_hold += o.errors_hold / (double)rankings;
        s.behind_hold += o.behind_hold / (double)rankings;
        s.trials += (double)o.trials / (double)rankings;
    }
    return s;
}

/* Of rankings whose patterns are equal by construction, or just not equal, at most 5 % decide anything wrongly: fewer than
   4 standard errors more. The intervals hold as often. */
static void rankings_err_as_often_as_promised(void **state)
{
    (void)state;
    const uint64_t rankings = test_repeats(400, 4);
    const double error = sqrt(0.05 * 0.95 / (double)rankings);
    for (size_t k = 0; k < WORLDS; k++) {
        const world *w = &worlds[k];
        if (w->spread > 0.1) { /* these take long */
            continue;
        }
        const summary s = summary_of(w, rankings);
        assert_that(s.wrong <= 0.05 + 4 * error && s.misled <= 0.05 + 8 * error &&
                        s.errors_hold >= 0.95 - 4 * error && s.behind_hold >= 0.95 - 4 * error,
                    "%s: %.1f %% of rankings decide wrongly, %.1f %% mislead; errors hold in %.1f %%, quotients in "
                    "%.1f %%",
                    w->name, 100 * s.wrong, 100 * s.misled, 100 * s.errors_hold, 100 * s.behind_hold);
    }
}

/* The trials of two patterns on average, in units of what one test of fixed size takes: that of a difference d at 5 % with
   a power of 80 % takes 2 (1.96 + .84)^2 (s / d)^2 of each, that of equality within 2 % at 5 % with a power of 90 %
   2 (1.645 + 1.645)^2 (s / log 1.02)^2 (Schuirmann 1987). A ranking, which tests after every round, takes at most 1.8 times
   as many; bounds of Bonferroni's over 14 rounds and the patterns too take 2.2 times as many. */
static void rankings_take_few_more_trials_than_one_test(void **state)
{
    (void)state;
    static const world two[] = {{"equal", NORMAL, 0.05, 2, {1, 1}}, {"apart by 5 %", NORMAL, 0.15, 2, {1, 1.05}}};
    for (int apart = 0; apart < 2; apart++) {
        const double power = apart ? 1.96 + 0.84 : 1.645 + 1.645, d = apart ? 0.05 : log(1.02);
        const double fixed = 4 * power * power * two[apart].spread * two[apart].spread / (d * d);
        const summary s = summary_of(&two[apart], test_repeats(300, 30));
        assert_that(s.open == 0 && s.trials < test_repeats(1.8, 2.2) * fixed,
                    "%s: %.0f trials on average, a test of fixed size %.0f", two[apart].name, s.trials, fixed);
    }
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        printf("| patterns | wrong | open | errors hold | quotients hold | trials |\n|---|---|---|---|---|---|\n");
        for (size_t k = 0; k < WORLDS; k++) {
            const summary s = summary_of(&worlds[k], strtoull(argv[1], NULL, 10));
            printf("| %s | %.2f | %.1f | %.1f | %.1f | %.0f |\n", worlds[k].name, 100 * s.wrong, 100 * s.open,
                   100 * s.errors_hold, 100 * s.behind_hold, s.trials);
            fflush(stdout);
        }
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rankings_err_as_often_as_promised),
        cmocka_unit_test(rankings_take_few_more_trials_than_one_test),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
