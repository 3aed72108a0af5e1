/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The verdict of a datasheet: where the sampler is best, where it is beaten, and how certain that is. A measure
 * is won if the sampler is better than every other one at the largest n, lost if another one is better, equal if
 * it is better than or equal to every other one, and otherwise undecided. The ranking of a scene at the largest
 * number of samples per pixel decides whether the scene is won or lost. Whether the sampler is biased comes first; a biased
 * one wins nothing.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/verify.h>

#include "core/status.h"
#include "study/sheet/sheet.h"

/* ---- Bias -------------------------------------------------------------------------------------------------------- */

/*
 * Whether the sampler is unbiased over its sets (koksma_verify_sets): the first that a datasheet tells, since the errors of
 * a biased sampler do not fall with more sets, whatever the means of measures say about single sets. The boxes are tested
 * with up to SETS sets of the largest size up to POINTS. Of a sampler without different sets, or with fewer than the test
 * takes, nothing is known.
 */

enum { SETS = 128, POINTS = 64, PROPERTY = 0 /* unbiased, the first finding */ };

static bool all_equal(const koksma_points *sets, size_t count)
{
    bool equal = true;
    for (size_t i = 1; i < count; i++) {
        equal = equal && !memcmp(sets[i].xs, sets->xs, sets->n * (size_t)sets->dim * sizeof *sets->xs);
    }
    return equal;
}

static koksma_status test(koksma__sheet_bias *bias, const koksma_points *sets, size_t count, const koksma_run *run)
{
    koksma_findings findings = {0};
    if (all_equal(sets, count)) {
        return KOKSMA_OK;
    }
    const koksma_status status = koksma_verify_sets(sets, count, run, &findings);
    if (!status) {
        const koksma_finding *found = &findings.items[PROPERTY];
        bias->sets = count;
        bias->biased = !found->holds;
        memcpy(bias->detail, found->detail, sizeof bias->detail);
    }
    koksma_findings_fini(&findings);
    return status;
}

koksma_status koksma__sheet_look_for_bias(koksma__sheet *sheet, koksma__document *d)
{
    (void)d;
    const koksma__sheet_sampler *sampler = sheet->samplers[0];
    const size_t count = koksma__sheet_trials(sampler, SETS);
    sheet->bias.n = koksma__sheet_size(sheet, POINTS);
    if (count < KOKSMA_VERIFY_SETS) {
        return KOKSMA_OK;
    }
    const koksma_run run = koksma__sheet_part(sheet, 0.01, 1), one_set = koksma__sheet_one_set(sheet);
    koksma_points *sets = calloc(count, sizeof *sets);
    KOKSMA__REQUIRE_MEMORY(sets, count * sizeof *sets);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < count && !status; i++) {
        status = koksma__sheet_points(sampler, sheet->bias.n, 2, i, &one_set, &sets[i]);
    }
    status = status ? status : test(&sheet->bias, sets, count, &run);
    for (size_t i = 0; i < count; i++) {
        koksma_points_fini(&sets[i]);
    }
    free(sets);
    return status;
}

static void put_bias(const koksma__sheet *sheet, koksma__document *d)
{
    const koksma__sheet_bias *bias = &sheet->bias;
    const koksma__sheet_sampler *sampler = sheet->samplers[0];
    if (bias->biased) {
        koksma__doc_paragraph(d,
                              "*Biased*: over %zu sets of %zu points the mean share of the points in a box is not "
                              "its volume (%s). No number of sets averages this error away, so that this sheet calls "
                              "the sampler best in nothing, and its gains are no gains.",
                              bias->sets, bias->n, bias->detail);
    } else if (bias->sets) {
        koksma__doc_paragraph(d,
                              "Unbiased, as far as %zu sets of %zu points show: the mean share of the points agrees "
                              "with the volume in every box that `koksma verify --seeds` tests.",
                              bias->sets, bias->n);
    } else {
        koksma__doc_paragraph(
            d, "Whether the sampler is unbiased is not known: that takes %d different sets, one for each seed.",
            KOKSMA_VERIFY_SETS);
    }
    if (bias->sets) {
        koksma__doc_commands(d);
        koksma__doc_command(d, "koksma verify %s --seeds %zu --seed %llu",
                            koksma__sheet_source(sampler, bias->n, 2).text, bias->sets,
                            (unsigned long long)sampler->seed);
    }
}

/* The outcome of comparing the sampler with all others by one measure or in one scene. */
typedef enum outcome { OPEN, WON, LOST, EQUAL } outcome;

typedef struct score {
    size_t n[4], tests;
    outcome of[KOKSMA__SHEET_MEASURES];
    size_t winner[KOKSMA__SHEET_MEASURES]; /* if result is LOST: the best of the samplers that are better */
} score;

static outcome judge_measure(const koksma__sheet_values *v, size_t m, size_t tests, size_t *winner)
{
    const size_t last = v->n_sizes - 1;
    size_t won = 0, equal = 0;
    bool lost = false;
    for (size_t s = 1; s < v->n_samplers; s++) {
        const int sign = koksma__sheet_compare(v, 0, s, m, last, tests);
        won += sign > 0;
        equal += koksma__sheet_equal(v, 0, s, m, last);
        if (sign < 0) {
            const double sense = v->measures[m].spec.measure->larger_is_better ? -1 : 1;
            const bool better = !lost || sense * koksma__sheet_tally(v, s, m, last)->mean <
                                             sense * koksma__sheet_tally(v, *winner, m, last)->mean;
            *winner = better ? s : *winner;
            lost = true;
        }
    }
    return lost ? LOST : won == v->n_samplers - 1 ? WON : won + equal == v->n_samplers - 1 ? EQUAL : OPEN;
}

static score score_measures(const koksma__sheet_values *v)
{
    score result = {.tests = v->n_measures * (v->n_samplers - 1)};
    for (size_t m = 0; m < v->n_measures; m++) {
        result.of[m] = judge_measure(v, m, result.tests, &result.winner[m]);
        result.n[result.of[m]]++;
    }
    return result;
}

/* Finds the sampler's row in a ranking and what the ranking decides about it. */
static outcome judge_scene(const koksma__sheet_ranking *r, const koksma_rank_row **row)
{
    *row = NULL;
    for (size_t i = 0; i < r->ranking.n; i++) {
        *row = r->rows[i].pattern == 0 ? &r->rows[i] : *row;
    }
    if (!*row) {
        return OPEN;
    }
    return (*row)->decision == KOKSMA_RANK_BEST    ? WON
           : (*row)->decision == KOKSMA_RANK_WORSE ? LOST
           : (*row)->decision == KOKSMA_RANK_EQUAL ? EQUAL
                                                   : OPEN;
}

static void say_count(koksma__document *d, size_t measures, size_t of_measures, size_t scenes, size_t of_scenes)
{
    koksma__doc_say(d, "%zu of %zu measures", measures, of_measures);
    if (of_scenes) {
        koksma__doc_say(d, " and %zu of %zu scenes", scenes, of_scenes);
    }
}

/* Writes a list item with the measures that have this outcome (for the outcome LOST, only the measures by which
   sampler `winner` is the best); writes nothing if there are none. */
static void put_measures(const koksma__sheet_values *v, const score *result, outcome which, size_t winner,
                         const char *head, koksma__document *d)
{
    const size_t last = v->n_sizes - 1;
    bool first = true;
    for (size_t m = 0; m < v->n_measures; m++) {
        if (result->of[m] != which || (which == LOST && result->winner[m] != winner)) {
            continue;
        }
        if (first) {
            koksma__doc_item(d, "*%s", head);
            koksma__doc_say(d, which == LOST ? " %s*: " : "*: ", v->samplers[winner]->text);
        }
        koksma__doc_say(d, first ? "%s" : ", %s", v->measures[m].name);
        if (which == LOST) {
            koksma__doc_say(d, " (%.3g beside %.3g)", koksma__sheet_tally(v, winner, m, last)->mean,
                            koksma__sheet_tally(v, 0, m, last)->mean);
        }
        first = false;
    }
}

static void put_scenes(const koksma__sheet *sheet, koksma__document *d)
{
    for (size_t i = 0; i < sheet->n_scenes && sheet->n_spp; i++) {
        const koksma__sheet_ranking *r = &sheet->rankings[(i + 1) * sheet->n_spp - 1];
        const koksma_rank_row *row;
        const outcome o = judge_scene(r, &row);
        koksma__doc_item(d, "Scene %s at %d samples a pixel: ", r->scene, r->spp);
        if (!row) {
            koksma__doc_say(d, "not ranked");
        } else if (sheet->bias.biased && o != LOST) {
            koksma__doc_say(d, "not compared, because the sampler is biased");
        } else if (o == WON) {
            koksma__doc_say(d, "the least error");
            if (r->ranking.n > 1) {
                koksma__doc_say(d, "; the next, %s, leaves %.0f %% more (%.0f to %.0f)",
                                sheet->samplers[r->rows[1].pattern]->text, 100 * r->rows[1].behind,
                                100 * r->rows[1].behind_low, 100 * r->rows[1].behind_high);
            }
        } else if (o == LOST) {
            koksma__doc_say(d, "%.0f %% more error (%.0f to %.0f) than %s", 100 * row->behind, 100 * row->behind_low,
                            100 * row->behind_high, sheet->samplers[r->rows[0].pattern]->text);
        } else if (o == EQUAL) {
            koksma__doc_say(d, "equal within 2 %% to %s", sheet->samplers[r->rows[0].pattern]->text);
        } else {
            koksma__doc_say(d, "undecided after %lld images of each sampler", r->ranking.trials);
        }
        if (row && row->coherence.coherent) {
            koksma__doc_say(d, "; its error has a pattern, not noise alone");
        }
    }
}

koksma_status koksma__sheet_verdict(koksma__sheet *sheet, koksma__document *d)
{
    const koksma__sheet_values *v = &sheet->plane;
    const score s = score_measures(v);
    size_t scenes[4] = {0}, of_scenes = sheet->n_spp ? sheet->n_scenes : 0;
    const koksma_rank_row *row;
    for (size_t i = 0; i < of_scenes; i++) {
        scenes[judge_scene(&sheet->rankings[(i + 1) * sheet->n_spp - 1], &row)]++;
    }
    koksma__doc_section(d, "verdict", "Verdict");
    put_bias(sheet, d);
    if (sheet->n_samplers == 1) {
        koksma__doc_paragraph(d, "This sheet compares %s with no other sampler.", sheet->samplers[0]->text);
        koksma__doc_end(d);
        return KOKSMA_OK;
    }
    if (sheet->bias.biased) {
        koksma__doc_paragraph(d, "It is beaten in *");
    } else {
        koksma__doc_paragraph(d, "`%s` is better than every other sampler here in *", sheet->samplers[0]->text);
        say_count(d, s.n[WON], v->n_measures, scenes[WON], of_scenes);
        koksma__doc_say(d, "*. It is beaten in *");
    }
    say_count(d, s.n[LOST], v->n_measures, scenes[LOST], of_scenes);
    koksma__doc_say(d, "*");
    if (!sheet->bias.biased && (s.n[WON] + s.n[LOST] < v->n_measures || scenes[WON] + scenes[LOST] < of_scenes)) {
        koksma__doc_say(d, "; in the rest it is equal to the best, or not decided");
    }
    koksma__doc_say(d, ".");
    koksma__doc_list(d, NULL, false);
    if (!sheet->bias.biased) {
        put_measures(v, &s, WON, 0, "Best", d);
        put_measures(v, &s, EQUAL, 0, "Equal to the best", d);
    }
    for (size_t k = 1; k < v->n_samplers; k++) {
        put_measures(v, &s, LOST, k, "Beaten by", d);
    }
    put_measures(v, &s, OPEN, 0, "Not decided", d);
    put_scenes(sheet, d);
    koksma__doc_paragraph(d,
                          "How sure: measures at n = %zu over %zu set%s of the sampler; all %zu comparisons hold "
                          "together with 95 %% (Welch, Bonferroni).",
                          v->sizes[v->n_sizes - 1], v->trials[0], v->trials[0] == 1 ? "" : "s", s.tests);
    bool exact = false;
    for (size_t k = 0; k < v->n_samplers; k++) {
        exact |= v->samplers[k]->same;
    }
    if (exact) {
        koksma__doc_say(d, " Values of a deterministic sampler, which has one set, are exact.");
    }
    if (of_scenes) {
        koksma__doc_say(d, " Decisions of each scene hold together with 95 %%.");
    }
    koksma__doc_end(d);
    return KOKSMA_OK;
}
