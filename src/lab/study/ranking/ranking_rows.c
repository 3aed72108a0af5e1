/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Writes the rows and the results of a ranking from its contest (ranking_rows.h): the order of the rows, what the errors
 * say of each pattern, and how many random samples the best pattern is worth.
 */
#include "study/ranking/ranking_rows.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "study/plan/variants.h"

enum { NOBODY = KOKSMA__RANK_NOBODY };

void koksma__rank_put_behind(koksma__estimate q, double *behind, double *low, double *high)
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
        koksma__rank_put_behind(q, &row->behind, &row->behind_low, &row->behind_high);
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

/* The row of the advised pattern, or else of the best whose error is not coherent, or of the first. */
static size_t row_to_use(const koksma_rank_row *rows, const koksma_ranking *ranking)
{
    size_t best = ranking->n;
    for (size_t i = 0; i < ranking->n; i++) {
        if (!rows[i].coherence.coherent && (best == ranking->n || rows[i].mean < rows[best].mean)) {
            best = i;
        }
    }
    return ranking->advised ? ranking->advised_row : best < ranking->n ? best : 0;
}

koksma_status koksma__rank_fill_rows(const koksma__contest *c, koksma_rank_row *rows, koksma_ranking *out)
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
    free(order);
    out->use_row = row_to_use(rows, out);
    find_worth(c->options, rows, out);
    return KOKSMA_OK;
}

koksma_status koksma__rank_settle_without_slow(koksma__rank_table *table)
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
