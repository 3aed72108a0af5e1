/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds the pattern that leaves the least error in a scene. The ranking works in steps:
 *     0. a first look, if it is asked for: two images of each pattern, whose difference tells the error before there is a
 *        reference. They are the first trials of the contest;
 *     1. a contest of all patterns at the requested image size, until the best pattern is decided, and then until the
 *        advised pattern is decided: the best one whose error is not coherent, that is, has no bands or other visible
 *        pattern (koksma_coherence_values in image.h);
 *     2. a contest at half and one at twice the size. Each compares the best three patterns whose error is not
 *        coherent and the best three of all patterns. It runs until the best pattern whose error is not coherent is
 *        decided, and then until the best pattern is decided (only the latter if every error is coherent);
 *     3. the first contest again, until every pair of patterns is decided.
 * A time limit may end the ranking at any point; the rows then report what is known. The speed of the machine affects
 * how many decisions are taken (ranking_contest.c describes the treatment of patterns too slow for the time limit,
 * ranking_decisions.c the statistics). It has no part in their outcome but one: the levels of a decision depend on the
 * rounds and the decisions before it, among which those of a pattern that was put off are missing.
 *
 * Any decision is wrong with a probability of at most 5 %: 4 % for the first contest and 1/2 % for each check.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/elementary.h"
#include "core/status.h"
#include "image/image.h"
#include "study/plan/variants.h"
#include "study/ranking/ranking_contest.h"
#include "study/ranking/ranking_setup.h"

#define ALPHA 0.04
#define CHECK_ALPHA 0.005
enum { CHECKED = 3, NOBODY = KOKSMA__RANK_NOBODY };

/* ---- The rows ---------------------------------------------------------------------------------------------------- */

/*
 * Writes the rows and the results of a ranking from its contest: the order of the rows, what the errors
 * say of each pattern, and how many random samples the best pattern is worth.
 */

static void put_behind(koksma__estimate q, double *behind, double *low, double *high)
{
    const bool known = isfinite(q.low) && isfinite(q.high);
    *behind = q.value - 1;
    *low = known ? q.low - 1 : (double)NAN;
    *high = known ? q.high - 1 : (double)NAN;
}

/* Whether contestant a comes before b in the rows: the leader is first, then contestants follow by position and mean
   error, then those without a complete round, and last those that are excluded. */
static bool is_before(const koksma__contest *c, size_t a, size_t b)
{
    const koksma__rank_errors *mine = koksma__rank_latest(&c->table, a), *other = koksma__rank_latest(&c->table, b);
    const bool a_out = c->table.entrants[a].out, b_out = c->table.entrants[b].out;
    if (a_out || b_out || !mine || !other) {
        return a_out != b_out ? b_out : !a_out && mine && !other;
    }
    const size_t place = koksma__rank_position(&c->table, a), other_place = koksma__rank_position(&c->table, b);
    if (a == c->table.leader || b == c->table.leader) {
        return a == c->table.leader;
    }
    return place != other_place ? place < other_place : mine->mean < other->mean;
}

static koksma_rank_decision decision_of(const koksma__rank_table *table, size_t i, size_t first)
{
    const koksma__rank_verdict verdict = table->pairs[i * table->n + first].verdict;
    return i == first                     ? (table->leader == i ? KOKSMA_RANK_BEST : KOKSMA_RANK_UNDECIDED)
           : verdict == KOKSMA__RANK_MORE ? KOKSMA_RANK_WORSE
           : verdict == KOKSMA__RANK_SAME ? KOKSMA_RANK_EQUAL
                                          : KOKSMA_RANK_UNDECIDED;
}

static void fill_row(const koksma__contest *c, size_t i, size_t first, koksma_rank_row *row)
{
    const koksma__rank_table *table = &c->table;
    const koksma__rank_errors e = koksma__contest_errors(c, i), best = koksma__contest_errors(c, first);
    *row = (koksma_rank_row){
        .pattern = c->contestants[i].pattern, .mean = NAN, .low = NAN, .high = NAN, .robust = NAN, .top_share = NAN};
    row->behind = row->behind_low = row->behind_high = NAN;
    row->biased =
        !c->options->render &&
        (c->options->adaptive || koksma__image_pattern_is_biased(c->options->patterns[c->contestants[i].pattern]));
    row->coherence = c->contestants[i].coherence;
    row->trials = (long long)e.n;
    row->state = table->entrants[i].out        ? KOKSMA_RANK_REFUSED
                 : table->entrants[i].n_rounds ? KOKSMA_RANK_RANKED
                                               : KOKSMA_RANK_TOO_SLOW;
    if (row->state == KOKSMA_RANK_REFUSED) {
        row->trials = 0;
        koksma_coherence_find(&(koksma_coherence){0}, &row->coherence);
        snprintf(row->reason, sizeof row->reason, "%s", c->contestants[i].reason);
        return;
    }
    if (row->state == KOKSMA_RANK_TOO_SLOW) {
        snprintf(row->reason, sizeof row->reason,
                 "too slow: only %zu of its first %d trials were done within the time limit", e.n,
                 KOKSMA__RANK_FIRST_ROUND);
    } else {
        row->position = koksma__rank_position(table, i);
        row->decision = decision_of(table, i, first);
    }
    if (e.n) {
        const koksma__estimate mean = koksma__rank_error(&e, koksma__rank_error_level(table));
        row->mean = mean.value;
        row->low = mean.low;
        row->high = mean.high;
        row->robust = e.robust;
        row->top_share = e.top_share;
    }
    if (e.n && best.n) {
        const koksma__estimate q = i == first ? (koksma__estimate){1, 1, 1}
                                   : row->position
                                       ? koksma__rank_compare(table, i, first)
                                       : koksma__rank_quotient(&e, &best, koksma__rank_error_level(table));
        put_behind(q, &row->behind, &row->behind_low, &row->behind_high);
    }
}

/* Computes how many samples of the pattern random are worth spp samples of the pattern to use: errors of independent
   samples fall as n^-1/2, and so their metric as the power `order` of that. */
static void find_worth(const koksma_rank_options *options, const koksma_rank_row *rows, koksma_ranking *out)
{
    const size_t best = out->use_row;
    const int order = options->metric ? options->metric->metric->order : 1;
    out->random_spp = out->random_spp_low = out->random_spp_high = NAN;
    for (size_t i = 0; i < out->n && order > 0 && rows[best].mean > 0; i++) {
        if (!strcmp(options->patterns[rows[i].pattern], "random")) {
            const koksma_rank_row *b = &rows[best], *r = &rows[i];
            const bool itself = i == best, first = best == 0; /* the first row is compared without an interval */
            const double power = 2.0 / order, low = (1 + r->behind_low) / (first ? 1 : 1 + b->behind_high),
                         high = (1 + r->behind_high) / (first ? 1 : 1 + b->behind_low);
            out->random_spp = options->spp * koksma__pow(r->mean / b->mean, power);
            out->random_spp_low = itself ? options->spp : options->spp * koksma__pow(low, power);
            out->random_spp_high = itself ? options->spp : options->spp * koksma__pow(high, power);
        }
    }
}

/* Finds the pattern to use: what is decided, else what exceeds the best by the least, if that is little, else what has the
   least error so far. order: the contestant in each row. */
static void choose_row(const koksma__rank_table *table, const size_t *order, const koksma_rank_row *rows,
                       bool decided, koksma_ranking *out)
{
    const bool all_coherent = out->n_coherent == out->n;
    size_t least = 0, safest = 0;
    double excess = INFINITY, mean = INFINITY;
    for (size_t k = 0; k < out->n; k++) {
        const bool counts = all_coherent || !rows[k].coherence.coherent;
        const double more = counts ? koksma__rank_excess(table, order[k], !all_coherent) : (double)INFINITY;
        if (counts && rows[k].mean < mean) {
            least = k;
            mean = rows[k].mean;
        }
        if (decided ? k == out->advised_row : more < excess) {
            safest = k;
            excess = more;
        }
    }
    out->use_row = decided || excess <= KOKSMA_RANK_TIE ? safest : all_coherent ? 0 : least;
    out->within = koksma__rank_excess(table, order[out->use_row], !all_coherent);
}

/* Where the errors leave the choice open, makes it by those without the few pixels that err most, if they decide it: the
   error of one such pixel may exceed that of all others, and vary as much. */
static koksma_status choose_without_few(koksma__contest *c, const size_t *order, const koksma_rank_row *rows,
                                        koksma_ranking *out)
{
    koksma_ranking robust = *out;
    if (out->within <= KOKSMA_RANK_TIE) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; i < c->n; i++) {
        const koksma__rank_entrant *e = &c->table.entrants[i];
        koksma__rank_entrant *without = &c->robust.entrants[i];
        without->out = e->out || !e->n_rounds;
        without->coherent = e->coherent;
        without->n_rounds = e->n_rounds;
    }
    KOKSMA__TRY(koksma__rank_decide(&c->robust, NULL));
    choose_row(&c->robust, order, rows, false, &robust);
    if (robust.within <= KOKSMA_RANK_TIE) {
        out->use_row = robust.use_row;
        out->within = robust.within;
        out->without_few = true;
    }
    return KOKSMA_OK;
}

/* Writes a row for each contestant, in their order, and the fields of *out that follow from the rows. Errors: MEMORY. */
static koksma_status fill_rows(koksma__contest *c, koksma_rank_row *rows, koksma_ranking *out)
{
    size_t *order = malloc(c->n * sizeof *order);
    KOKSMA__REQUIRE_MEMORY(order, c->n * sizeof *order);
    out->complete = true;
    for (size_t i = 0; i < c->n; i++) {
        size_t at = i;
        for (; at > 0 && is_before(c, i, order[at - 1]); at--) {
            order[at] = order[at - 1];
        }
        order[at] = i;
    }
    for (size_t k = 0; k < c->n; k++) {
        fill_row(c, order[k], order[0], &rows[k]);
        out->n += rows[k].state == KOKSMA_RANK_RANKED;
        out->n_coherent += rows[k].state == KOKSMA_RANK_RANKED && rows[k].coherence.coherent;
        if (order[k] == c->table.advised) {
            out->advised = true;
            out->advised_row = k;
        }
        out->n_slow += rows[k].state == KOKSMA_RANK_TOO_SLOW;
        out->trials = rows[k].trials > out->trials ? rows[k].trials : out->trials;
        for (size_t j = 0; j < c->n; j++) {
            out->complete &= j == k || c->table.entrants[k].out || c->table.entrants[j].out ||
                             c->table.pairs[k * c->n + j].verdict;
        }
    }
    out->complete &= !out->n_slow;
    out->settled = c->table.leader != NOBODY;
    const bool decided = out->advised || (out->n_coherent == out->n && out->settled);
    choose_row(&c->table, order, rows, decided, out);
    const koksma_status status = decided || out->settled ? KOKSMA_OK : choose_without_few(c, order, rows, out);
    free(order);
    find_worth(c->options, rows, out);
    return status;
}

/* Decides the best of the patterns that have a complete round, if there are several, when the time is up for the
   others. Errors: MEMORY. */
static koksma_status settle_without_slow(koksma__rank_table *table)
{
    size_t ranked = 0;
    for (size_t i = 0; i < table->n; i++) {
        ranked += !table->entrants[i].out && table->entrants[i].n_rounds;
    }
    bool *out = ranked > 1 ? malloc(table->n * sizeof *out) : NULL;
    if (ranked < 2) {
        return KOKSMA_OK;
    }
    KOKSMA__REQUIRE_MEMORY(out, table->n * sizeof *out);
    for (size_t i = 0; i < table->n; i++) {
        out[i] = table->entrants[i].out;
        table->entrants[i].out |= !table->entrants[i].n_rounds;
    }
    const koksma_status status = koksma__rank_decide(table, NULL);
    for (size_t i = 0; i < table->n; i++) {
        table->entrants[i].out = out[i];
    }
    free(out);
    return status;
}

typedef struct ranking {
    const koksma_rank_options *options;
    koksma__study_scene scene;
    char variant
        [KOKSMA__VARIANT_TEXT]; /* integrator, filter and adaptive method where they differ from the defaults */
    koksma__run_control control;
    double start_s;
    koksma__contest contest;
} ranking;

/* ---- Checks at other sizes ------------------------------------------------------------------------------ */

/* The pattern that is checked at other sizes: the advised pattern, or the leader if every pattern's error is
   coherent. NOBODY if that is not decided yet. */
static size_t checked(const koksma__contest *c)
{
    bool all_coherent = true;
    for (size_t i = 0; i < c->n; i++) {
        all_coherent &= c->table.entrants[i].out || c->table.entrants[i].coherent;
    }
    return all_coherent || c->table.leader == NOBODY ? c->table.leader : c->table.advised;
}

/* The mean error of contestant i after the round in which `best` was decided, or after the contestant's last round
   before that. The result is infinite for a contestant that is excluded or has no round, and, if `advised`, for one
   whose error is coherent (unless the error of `best` is coherent, too). */
static double early_mean(const koksma__rank_table *table, size_t i, size_t best, bool advised)
{
    const koksma__rank_entrant *e = &table->entrants[i];
    const int last = table->entrants[best].n_rounds;
    return (advised && e->coherent && !table->entrants[best].coherent) || e->out || !e->n_rounds
               ? (double)INFINITY
               : e->rounds[(e->n_rounds < last ? e->n_rounds : last) - 1].mean;
}

/* Stores `best`, followed by the patterns with the smallest errors, in `first`; returns their number. */
static size_t first_patterns(const koksma__contest *c, size_t best, bool advised, size_t first[CHECKED])
{
    size_t n = 1;
    first[0] = best;
    for (size_t i = 0; i < c->n; i++) {
        const double mean = early_mean(&c->table, i, best, advised);
        if (i == best || isinf(mean)) {
            continue;
        }
        size_t at = n;
        for (; at > 1 && mean < early_mean(&c->table, first[at - 1], best, advised); at--) {
            if (at < CHECKED) {
                first[at] = first[at - 1];
            }
        }
        if (at < CHECKED) {
            first[at] = i;
        }
        n += n < CHECKED;
    }
    return n;
}

/* Stores in `patterns` the best patterns whose error is not coherent, then the best of all patterns, without repeating
   any; returns their number. *leader: the index in `patterns` of the pattern with the least error. */
static size_t checked_patterns(const koksma__contest *c, size_t patterns[2 * CHECKED], size_t *leader)
{
    size_t all[CHECKED];
    size_t n = first_patterns(c, checked(c), true, patterns);
    const size_t n_all = first_patterns(c, c->table.leader, false, all);
    for (size_t k = n_all; k-- > 0;) { /* the last one looked up is all[0], the leader */
        *leader = 0;
        while (*leader < n && patterns[*leader] != all[k]) {
            ++*leader;
        }
        if (*leader == n) {
            patterns[n++] = all[k];
        }
    }
    return n;
}

/* The result of a check of contestant i: whether `best`, the contestant that was decided to be the best at the
   checked size, is i. */
static koksma_rank_check_result conclude(const koksma__contest *c, size_t i, size_t best)
{
    koksma_rank_check_result result = {.state = koksma__rank_check_best(&c->table, i, best)};
    if (result.state == KOKSMA_RANK_CONFIRMED) {
        result.coherent = c->contestants[i].coherence.coherent;
    } else if (result.state == KOKSMA_RANK_OVERTURNED) {
        const koksma__estimate q = koksma__rank_compare(&c->table, i, best);
        result.pattern = c->contestants[best].pattern;
        result.coherent = c->contestants[best].coherence.coherent;
        put_behind(q, &result.behind, &result.behind_low, &result.behind_high);
    }
    return result;
}

/* Checks the advised pattern first and then the leader, because a time limit may end the check in between. If no
   pattern is advised, because every error is coherent, both checks have the same result. */
static koksma_status check_best(koksma__contest *contest, size_t leader, koksma_rank_check *check)
{
    const bool same = contest->asked->table.advised == NOBODY;
    koksma_status status = same ? KOKSMA_OK : koksma__contest_run(contest, KOKSMA__RANK_FIND_ADVISED);
    if (!status && !same) {
        check->advice = conclude(contest, 0, contest->table.advised);
    }
    status = status ? status : koksma__contest_run(contest, KOKSMA__RANK_FIND_LEADER);
    if (!status) {
        check->first = conclude(contest, leader, contest->table.leader);
        check->advice = same ? check->first : check->advice;
    }
    for (size_t i = 0; check->advice.state && i < contest->n; i++) {
        const long long trials = (long long)koksma__contest_errors(contest, i).n;
        check->trials = trials > check->trials ? trials : check->trials;
    }
    return status;
}

static koksma_status check_size(ranking *r, koksma_rank_check *check)
{
    size_t patterns[2 * CHECKED], leader = 0;
    koksma__contest contest;
    koksma__study_scene scene = r->scene;
    const size_t n = checked_patterns(&r->contest, patterns, &leader);
    scene.width = check->width;
    scene.height = check->height;
    if (n < 2 || scene.width < 1 || scene.height < 1 || scene.width > KOKSMA_MAX_IMAGE_SIDE ||
        scene.height > KOKSMA_MAX_IMAGE_SIDE) {
        return KOKSMA_OK;
    }
    koksma_status status =
        koksma__contest_init(&contest, r->options, &scene, r->variant, &r->control, patterns, n, CHECK_ALPHA);
    contest.asked = &r->contest;
    status = status ? status : check_best(&contest, leader, check);
    koksma__contest_fini(&contest);
    if (koksma__rank_leaves_out(status)) { /* the ranking stays */
        *check = (koksma_rank_check){.width = check->width, .height = check->height};
        check->advice.state = check->first.state = KOKSMA_RANK_FAILED;
        status = KOKSMA_OK;
    }
    return status;
}

/* ---- Estimated time to a decision ----------------------------------------------------------------------- */

/* Mean thread seconds of a trial of contestant i; without a complete trial, the thread seconds spent so far. */
static double trial_s(const koksma__contest *c, size_t i)
{
    const size_t n = koksma__contest_errors(c, i).n;
    return 1e-9 * (double)atomic_load(&c->contestants[i].busy_ns) / (double)(n ? n : 1);
}

/* Estimated number of trials that would decide all pairs of the pattern with the smallest error; 0 if by the present
   estimates no possible number would decide a pair. *undecidable: whether these estimates are sure enough to say so. */
static size_t trials_to_lead(const koksma__rank_table *table, bool *undecidable)
{
    size_t best = NOBODY, needed = 0;
    bool decidable = true;
    *undecidable = false;
    for (size_t i = 0; i < table->n; i++) {
        const koksma__rank_errors *e = koksma__rank_latest(table, i);
        if (e && !table->entrants[i].out && koksma__rank_position(table, i) == 1 &&
            (best == NOBODY || e->mean < koksma__rank_latest(table, best)->mean)) {
            best = i;
        }
    }
    for (size_t j = 0; best != NOBODY && j < table->n; j++) {
        const koksma__rank_errors *e = koksma__rank_latest(table, j);
        const koksma__rank_pair *pair = &table->pairs[best * table->n + j];
        if (e && j != best && !table->entrants[j].out && !pair->verdict) {
            const size_t n =
                koksma__rank_trials_needed(koksma__rank_latest(table, best), e, koksma__rank_pair_alpha(table));
            needed = n > needed ? n : needed;
            decidable = decidable && n;
            *undecidable = *undecidable || pair->hopeless;
        }
    }
    return decidable && !*undecidable ? needed : 0;
}

static void estimate_need(const ranking *r, koksma_ranking *out)
{
    const koksma__contest *c = &r->contest;
    const double threads = r->control.run.threads, elapsed_s = koksma__now_s() - r->start_s;
    size_t waiting = 0, open = 0;
    double threads_s = 0;
    for (size_t i = 0; i < c->n; i++) {
        const koksma__rank_entrant *e = &c->table.entrants[i];
        open += !e->out;
        waiting += !e->out && !e->n_rounds;
    }
    const size_t needed = waiting ? KOKSMA__RANK_FIRST_ROUND : trials_to_lead(&c->table, &out->undecidable);
    out->needed_trials = (long long)needed;
    if (!needed) {
        return;
    }
    const koksma__rank_reference *reference = &c->references[0];
    if (reference->made <
        KOKSMA__RANK_REPLICATES) { /* all work is estimated by its number of samples, in references */
        const double one = KOKSMA__RANK_REPLICATES * (double)koksma__rank_reference_spp(r->options->spp, 0);
        const double trial = r->options->spp / one, all = 1 + (double)(needed * open) * trial;
        const double begun =
            reference->pixels ? reference->made + r->control.fraction : 0; /* another renderer tells no fraction */
        const double done = begun / KOKSMA__RANK_REPLICATES + 1e-6 * (double)atomic_load(&c->looked) * trial;
        out->needed_s = done > 0 ? elapsed_s * all / done : 0;
        return;
    }
    for (size_t i = 0; i < c->n; i++) {
        const size_t done = koksma__contest_errors(c, i).n;
        bool more = !c->table.entrants[i].n_rounds;
        for (size_t j = 0; j < c->n; j++) {
            more |= koksma__rank_matters(&c->table, i, j, KOKSMA__RANK_FIND_LEADER);
        }
        if (more && !c->table.entrants[i].out && done < needed) {
            threads_s += (double)(needed - done) * trial_s(c, i);
        }
    }
    out->needed_s = elapsed_s + threads_s / threads;
}

/* ---- The whole ranking ---------------------------------------------------------------------------------- */

static koksma_status nobody_can_serve(const koksma__contest *c)
{
    for (size_t i = 0; i < c->n; i++) {
        if (!c->table.entrants[i].out) {
            return KOKSMA_OK;
        }
    }
    return koksma__fail(KOKSMA_ARGUMENT, "none of the patterns can be ranked: %s", c->contestants[c->n - 1].reason);
}

/* Whether to check the best patterns at other image sizes too, half and twice the size that was asked for. If another
   renderer is used and the options give no size, none are checked, because that renderer may support only one size. */
static bool check_sizes(const koksma_rank_options *options)
{
    return !options->one_size && !options->reference_image && (!options->render || options->width);
}

/* Takes the first look, if it is asked for and the two images of a pattern tell its error. */
static koksma_status look(ranking *r)
{
    const koksma_rank_options *o = r->options;
    if (!o->look || o->render || o->adaptive || o->process || o->reference_image) {
        return KOKSMA_OK;
    }
    double *errors = malloc(o->n_patterns * sizeof *errors);
    KOKSMA__REQUIRE_MEMORY(errors, o->n_patterns * sizeof *errors);
    bool known = false;
    const koksma_status status = koksma__contest_look(&r->contest, errors);
    for (size_t i = 0; !status && i < o->n_patterns; i++) {
        known |= !isnan(errors[i]);
    }
    if (known) {
        o->look(o->look_context, errors);
    }
    free(errors);
    return status;
}

static koksma_status do_sequence(ranking *r, koksma_ranking *out)
{
    koksma__contest *c = &r->contest;
    koksma_status status = koksma__contest_try_patterns(c);
    status = status ? status : nobody_can_serve(c);
    status = status ? status : look(r);
    status = status ? status : koksma__contest_run(c, KOKSMA__RANK_FIND_LEADER);
    status = status ? status : koksma__contest_run(c, KOKSMA__RANK_FIND_ADVISED);
    status = status ? status : nobody_can_serve(c);
    for (int i = 0; !status && check_sizes(r->options) && checked(c) != NOBODY && i < KOKSMA_RANK_CHECKS; i++) {
        status = check_size(r, &out->checks[i]);
    }
    return status ? status : koksma__contest_run(c, KOKSMA__RANK_ORDER_ALL);
}

static koksma_status rank_scene(ranking *r, koksma_rank_row *rows, koksma_ranking *out)
{
    const size_t n = r->options->n_patterns;
    size_t *patterns = malloc(n * sizeof *patterns);
    KOKSMA__REQUIRE_MEMORY(patterns, n * sizeof *patterns);
    for (size_t p = 0; p < n; p++) {
        patterns[p] = p;
    }
    koksma_status status =
        koksma__contest_init(&r->contest, r->options, &r->scene, r->variant, &r->control, patterns, n, ALPHA);
    free(patterns);
    status = status ? status : do_sequence(r, out);
    if (status == KOKSMA_INTERRUPTED && koksma__run_control_time_is_up(&r->control)) {
        out->cut_short = true;
        status = KOKSMA_OK;
    }
    out->reference_error = NAN;
    for (int stage = 0; stage < KOKSMA__RANK_STAGES; stage++) {
        const koksma__rank_reference *reference = &r->contest.references[stage];
        out->reference_error = reference->made == KOKSMA__RANK_REPLICATES ? reference->error : out->reference_error;
    }
    status = status || !out->cut_short ? status : settle_without_slow(&r->contest.table);
    status = status ? status : fill_rows(&r->contest, rows, out);
    if (!status && !out->settled) {
        estimate_need(r, out);
    }
    koksma__contest_fini(&r->contest);
    return status;
}

/* Reports the sizes of the contest and of its checks, before any rendering. */
static void set_sizes(const koksma__study_scene *scene, koksma_ranking *out)
{
    out->width = scene->width;
    out->height = scene->height;
    out->checks[0] = (koksma_rank_check){.width = scene->width / 2, .height = scene->height / 2};
    out->checks[1] = (koksma_rank_check){.width = 2 * scene->width, .height = 2 * scene->height};
}

koksma_status koksma_rank_patterns(const koksma_rank_options *options, const koksma_run *run, koksma_rank_row *rows,
                                   koksma_ranking *out)
{
    KOKSMA__REQUIRE(options, rows, out);
    KOKSMA__REQUIRE(options->scene, options->patterns);
    KOKSMA__REQUIRE_RUN(run);
    ranking r = {.options = options, .start_s = koksma__now_s()};
    koksma__run_control_begin(run, options->time_limit_s, &r.control);
    r.control.by_time = true; /* progress counts time, because the number of rounds is unknown */
    *out = (koksma_ranking){.reference_error = NAN};
    koksma_status status = koksma__rank_open(options, &r.control, &r.scene, r.variant);
    if (!status) {
        set_sizes(&r.scene, out);
        status = rank_scene(&r, rows, out);
    }
    koksma_scene_close(r.scene.scene);
    out->seconds = koksma__now_s() - r.start_s;
    if (status) {
        *out = (koksma_ranking){0};
    }
    return status;
}
