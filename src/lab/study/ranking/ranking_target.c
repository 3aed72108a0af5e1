/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Finds how many samples of each pattern leave a given error in a scene (koksma_rank_to_error).
 *
 * Level k = 0, 1, 2, ... measures the error of 8 images of 4^k samples, or of the next number that the pattern can make,
 * against a reference of 16 images with as many samples, at least 16. The first level whose error is at most the target
 * brackets the number, with the level before. Within the bracket up to 4 steps follow the power law through its ends. The
 * number found is checked by 8 images of other seeds, which took no part in the search, so that the interval of their
 * error knows nothing of the choice. All patterns share the references, which depend on the level only, so that no
 * pattern changes the numbers of another.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/elementary.h"
#include "core/status.h"
#include "study/ranking/ranking_contest.h"
#include "study/ranking/ranking_setup.h"
enum { STEPS = 4, LEVELS = 11, FITTED = 5, MOST_TRIES = 4096 };

#define LEVEL 0.025       /* of each bound of an interval of 95 % */
#define CLOSE_ENOUGH 1.05 /* a bracket this narrow needs no further step */

/* The search for one pattern. */
typedef struct candidate {
    koksma_target_row *row;
    bool open;
    int next;  /* the number of samples of the level; 0: the pattern has none */
    int below; /* the largest number of samples whose error was above the target; 0: none */
    double below_error;
    size_t levels; /* number of levels that were measured */
    double samples[LEVELS], errors[LEVELS];
} candidate;

typedef struct search {
    koksma_rank_options options; /* with the spp of the present level */
    double target;
    koksma__study_scene scene;
    char variant[KOKSMA__VARIANT_TEXT];
    koksma__run_control control;
    koksma__rank_reference reference; /* of the present level */
} search;

/* Measures the error of `spp` samples by 8 images: those of the search, or fresh ones. Sets the row's state if the
   pattern is refused. */
static koksma_status measure(search *s, candidate *p, int spp, bool fresh, koksma__estimate *error)
{
    koksma_rank_options options = s->options;
    koksma__study_scene scene = s->scene;
    koksma__contest contest;
    options.spp = spp;
    if (fresh) {
        snprintf(scene.hash, sizeof scene.hash, "%016llx",
                 (unsigned long long)koksma__job_seed("rank-target|%s", s->scene.hash));
    }
    koksma_status status =
        koksma__contest_init(&contest, &options, &scene, s->variant, &s->control, &p->row->pattern, 1, 2 * LEVEL);
    contest.references[0] = s->reference;
    status = status ? status : koksma__contest_run(&contest, KOKSMA__RANK_FIND_LEADER);
    if (!status && contest.table.entrants[0].out) {
        p->row->state = KOKSMA_TARGET_REFUSED;
        p->open = false;
        snprintf(p->row->reason, sizeof p->row->reason, "%s", contest.contestants[0].reason);
    } else if (!status) {
        const koksma__rank_errors errors = koksma__contest_errors(&contest, 0);
        *error = koksma__rank_error(&errors, LEVEL);
        p->row->trials += (long long)errors.n;
        p->row->coherent = contest.contestants[0].coherence.coherent;
    }
    contest.references[0] = (koksma__rank_reference){0};
    s->options.doubt = NULL; /* the first contest has told */
    koksma__contest_fini(&contest);
    return status;
}

/* Finds the least number of samples from `from` to `to` that the pattern can make; 0 if there is none. Errors: those of a
   pattern whose file or program is wrong, INTERRUPTED, MEMORY. */
static koksma_status find_number(search *s, candidate *p, int from, int to, int *spp)
{
    char text[KOKSMA_MAX_SPEC];
    koksma__variant variant = {0};
    *spp = from <= to ? from : 0;
    if (s->options.render || from > to) {
        return KOKSMA_OK; /* another renderer refuses what it can't make */
    }
    KOKSMA__TRY(koksma__variant_apply(s->variant, false, &variant));
    KOKSMA__TRY(koksma__image_pattern_text(s->options.patterns[p->row->pattern], text));
    for (int n = from; n <= to && n - from < MOST_TRIES; n++) {
        const koksma_status status =
            koksma__image_pattern_try(text, (size_t)koksma__variant_first_spp(&variant, n), &s->control.run);
        if (!status) {
            *spp = n;
            p->row->reason[0] = '\0';
            return KOKSMA_OK;
        }
        if (!koksma__rank_leaves_out(status) || status == KOKSMA_MISSING || status == KOKSMA_MALFORMED ||
            status == KOKSMA_FORBIDDEN) {
            return status;
        }
        if (!p->row->reason[0]) {
            snprintf(p->row->reason, sizeof p->row->reason, "%s", koksma_error_text());
        }
    }
    *spp = 0;
    return KOKSMA_OK;
}

/* The power law of the errors: by the last levels, or with fewer than three of them by the two ends of the bracket. */
static bool fit(const candidate *p, int above, double above_error, koksma_line *line)
{
    const size_t count = p->levels < FITTED ? p->levels : FITTED, first = p->levels - count;
    if (koksma_log_line(count, p->samples + first, p->errors + first, line)) {
        return line->slope < 0;
    }
    *line = (koksma_line){.count = 2, .slope_error = NAN};
    if (p->below && above_error > 0) {
        line->slope = koksma__log(above_error / p->below_error) / koksma__log((double)above / p->below);
    }
    return line->slope < 0;
}

/* Measures the error of the number that was found by fresh images, and how far it is from the target. */
static koksma_status check_number(search *s, candidate *p, int spp, const koksma_line *line)
{
    koksma__estimate error;
    koksma_target_row *row = p->row;
    KOKSMA__TRY(measure(s, p, spp, true, &error));
    if (row->state == KOKSMA_TARGET_REFUSED) {
        return KOKSMA_OK;
    }
    row->state = KOKSMA_TARGET_CHECKED;
    row->reason[0] = '\0'; /* of numbers that the pattern could not make */
    row->spp = spp;
    row->error = error.value;
    row->low = error.low;
    row->high = error.high;
    if (line->slope < 0) {
        row->needed = koksma__reach(line, spp, error.value, s->target).value;
        row->needed_low = koksma__reach(line, spp, error.low, s->target).value;
        row->needed_high = koksma__reach(line, spp, error.high, s->target).value;
    }
    return KOKSMA_OK;
}

/* Narrows the bracket whose upper end, `above` samples, reaches the target, and checks the number found. */
static koksma_status refine(search *s, candidate *p, int above, double above_error)
{
    koksma_line line;
    const bool fitted = fit(p, above, above_error, &line);
    p->row->rate = fitted ? line.slope : (double)NAN;
    p->row->rate_error = fitted ? line.slope_error : (double)NAN;
    for (int i = 0; i < STEPS && p->below && above > CLOSE_ENOUGH * p->below && p->open; i++) {
        const double slope =
            above_error > 0 ? koksma__log(p->below_error / above_error) / koksma__log((double)above / p->below) : 0;
        const double guess = slope > 0 ? above * koksma__exp(koksma__log(above_error / s->target) / slope)
                                       : sqrt((double)above * p->below);
        int spp;
        KOKSMA__TRY(find_number(s, p, (int)fmin(fmax(ceil(guess), p->below + 1), above), above - 1, &spp));
        if (!spp) {
            break;
        }
        koksma__estimate error;
        KOKSMA__TRY(measure(s, p, spp, false, &error));
        if (p->open && error.value <= s->target) {
            above = spp;
            above_error = error.value;
        } else if (p->open) {
            p->below = spp;
            p->below_error = error.value;
        }
    }
    return p->open ? check_number(s, p, above, &line) : KOKSMA_OK;
}

/* Measures the pattern's error at the level's number of samples, and ends its search if that reaches the target. */
static koksma_status try_level(search *s, candidate *p)
{
    koksma__estimate error;
    KOKSMA__TRY(measure(s, p, p->next, false, &error));
    if (!p->open) {
        return KOKSMA_OK;
    }
    p->samples[p->levels] = p->next;
    p->errors[p->levels++] = error.value;
    if (error.value > s->target) {
        p->below = p->next;
        p->below_error = error.value;
        return KOKSMA_OK;
    }
    KOKSMA__TRY(refine(s, p, p->next, error.value));
    p->open = false;
    return KOKSMA_OK;
}

/* Makes the level of numbers from `least` up to, not including, 4 times as many; its reference, if a pattern has one. */
static koksma_status do_level(search *s, candidate *candidates, size_t n, int least)
{
    const int most = least < KOKSMA_MAX_SPP / 4 ? 4 * least - 1 : KOKSMA_MAX_SPP;
    bool any = false;
    for (size_t i = 0; i < n; i++) {
        candidate *p = &candidates[i];
        p->next = 0;
        if (p->open) {
            KOKSMA__TRY(find_number(s, p, least, most, &p->next));
        }
        any = any || p->next;
    }
    if (!any) {
        return KOKSMA_OK;
    }
    s->options.spp = least;
    koksma__rank_reference_fini(&s->reference);
    KOKSMA__TRY(
        koksma__contest_make_reference(&s->options, &s->scene, s->variant, 0, &s->control.run, &s->reference));
    for (size_t i = 0; i < n; i++) {
        if (candidates[i].next) {
            KOKSMA__TRY(try_level(s, &candidates[i]));
        }
    }
    return KOKSMA_OK;
}

static koksma_status run_levels(search *s, candidate *candidates, size_t n)
{
    int least = 1;
    bool open = true;
    for (int level = 0; level < LEVELS && open; level++, least *= 4) {
        KOKSMA__TRY(do_level(s, candidates, n, least));
        open = false;
        for (size_t i = 0; i < n; i++) {
            open = open || candidates[i].open;
        }
    }
    return KOKSMA_OK;
}

/* What is known of a pattern that did not reach the target: the number that its rate leads to. */
static void extrapolate(const search *s, candidate *p)
{
    koksma_target_row *row = p->row;
    koksma_line line;
    if (!p->levels) {
        row->state = row->reason[0] ? KOKSMA_TARGET_REFUSED : KOKSMA_TARGET_UNKNOWN;
        return;
    }
    const size_t last = p->levels - 1;
    row->state = KOKSMA_TARGET_UNKNOWN;
    row->error = p->errors[last];
    if (p->levels > 2 && !row->reason[0] && fit(p, 0, 0, &line)) {
        const koksma__estimate needed = koksma__reach(&line, p->samples[last], p->errors[last], s->target);
        row->state = KOKSMA_TARGET_EXTRAPOLATED;
        row->rate = line.slope;
        row->rate_error = line.slope_error;
        row->needed = needed.value;
        row->needed_low = needed.low;
        row->needed_high = needed.high;
    }
}

/* Orders rows by the number of samples; those without one come last, in the order of the options. */
static int by_samples(const void *a, const void *b)
{
    const koksma_target_row *x = a, *y = b;
    if (x->state != y->state) {
        return x->state < y->state ? -1 : 1;
    }
    const double less = x->state == KOKSMA_TARGET_CHECKED ? x->spp - y->spp : x->needed - y->needed;
    return less < 0 ? -1 : less > 0 ? 1 : (x->pattern > y->pattern) - (x->pattern < y->pattern);
}

static koksma_status search_all(search *s, koksma_target_row *rows, koksma_target_ranking *out)
{
    const size_t n = s->options.n_patterns;
    candidate *candidates = calloc(n, sizeof *candidates);
    KOKSMA__REQUIRE_MEMORY(candidates, n * sizeof *candidates);
    for (size_t i = 0; i < n; i++) {
        rows[i] = (koksma_target_row){.pattern = i, .state = KOKSMA_TARGET_UNKNOWN};
        rows[i].error = rows[i].low = rows[i].high = rows[i].rate = rows[i].rate_error = NAN;
        rows[i].needed = rows[i].needed_low = rows[i].needed_high = NAN;
        candidates[i] = (candidate){.row = &rows[i], .open = true};
    }
    koksma_status status = run_levels(s, candidates, n);
    if (status == KOKSMA_INTERRUPTED && koksma__run_control_time_is_up(&s->control)) {
        out->cut_short = true;
        status = KOKSMA_OK;
    }
    for (size_t i = 0; i < n && !status; i++) {
        if (rows[i].state == KOKSMA_TARGET_UNKNOWN) {
            extrapolate(s, &candidates[i]);
        }
    }
    free(candidates);
    qsort(rows, status ? 0 : n, sizeof *rows, by_samples);
    return status;
}

koksma_status koksma_rank_to_error(const koksma_rank_options *options, double target, const koksma_run *run,
                                   koksma_target_row *rows, koksma_target_ranking *out)
{
    KOKSMA__REQUIRE(options, rows, out);
    KOKSMA__REQUIRE(options->scene, options->patterns);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!(target > 0 && isfinite(target)), KOKSMA_ARGUMENT,
                    "target = %g: the error must be a finite number above 0", target);
    const double start_s = koksma__now_s();
    search s = {.options = *options, .target = target};
    s.options.spp = 1;
    koksma__run_control_begin(run, options->time_limit_s, &s.control);
    s.control.by_time = true;
    *out = (koksma_target_ranking){0};
    koksma_status status = koksma__rank_open(&s.options, &s.control, &s.scene, s.variant);
    if (!status) {
        out->width = s.scene.width;
        out->height = s.scene.height;
        status = search_all(&s, rows, out);
    }
    koksma__rank_reference_fini(&s.reference);
    koksma_scene_close(s.scene.scene);
    out->seconds = koksma__now_s() - start_s;
    if (status) {
        *out = (koksma_target_ranking){0};
    }
    return status;
}
