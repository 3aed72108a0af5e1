/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Which pattern leaves the least error in a scene. Trials come in rounds of 8, 16, 32, …; after each the patterns are
 * ordered by their mean error and neighbours compared, trial by trial (which are independent). A pair is settled when
 * the interval of its difference excludes 0, or lies within 2 % of the better's mean: equal for all purposes. Looking
 * again and again would make 95 % intervals err too often, so the rounds are judged at 99.5 %: ten looks, and there
 * are no more, keep the chance of a wrong stop of a pair below 5 % (Bonferroni). What is printed are intervals of 95
 * %.
 */
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/quantiles.h"
#include "core/status.h"
#include "study/clocks.h"
#include "study/image_patterns.h"
#include "study/statistics.h"
#include "study/study.h"
#include "study/watch.h"

static const double EQUAL = 0.02;

/* A reference's error adds in squares to those that are measured: 1/10 of them changes them by 1/200. */
static const double REFERENCE_SHARE = 0.1;
enum { FIRST_ROUND = 8, MOST_TRIALS = 4096, REFERENCE_SPP = 1024, LEAST_REPLICATES = 4, MOST_REPLICATES = 64 };

typedef struct ranking {
    const koksma_rank_options *options;
    koksma__study_scene scene;
    char variant[KOKSMA__VARIANT_TEXT]; /* integrator and filter, where they are others than by default */
    koksma_image reference;
    double *errors;            /* pattern p, trial t: errors[p * room + t] */
    size_t room, first, n_now; /* trials of the round in work */
    size_t n;
    size_t *patterns;   /* those that can serve */
    atomic_uchar *done; /* by the job of the round, trial by trial: pattern i % n */
    koksma__watch watch;
} ranking;

static koksma_status render(const ranking *r, const char *pattern, long long spp, uint64_t seed,
                            const koksma_run *run, koksma_image *out)
{
    const koksma__picture picture = {.pattern = pattern,
                                     .variant = r->variant,
                                     .spp = spp,
                                     .width = r->scene.width,
                                     .height = r->scene.height,
                                     .seed = seed};
    return koksma__study_render(&r->scene, &picture, run, out);
}

/* ---- Trials -------------------------------------------------------------------------------------------- */

static koksma_status do_trial(void *context, size_t i)
{
    ranking *r = context;
    const size_t p = i % r->n, trial = r->first + i / r->n;
    const char *pattern = r->options->patterns[r->patterns[p]];
    koksma_image image;
    koksma_image_error error = {0};
    const uint64_t seed = koksma__job_seed("rank|%s|%s|%s%s|%d|%zu", r->scene.name, r->scene.hash, pattern,
                                           r->variant, r->options->spp, trial);
    koksma_status status = render(r, pattern, r->options->spp, seed, &r->watch.job, &image);
    if (!status) {
        status = koksma_image_compare(&image, &r->reference, &error);
        koksma_image_fini(&image);
    }
    r->errors[p * r->room + trial] = error.mean;
    if (!status && trial < FIRST_ROUND) {
        atomic_store(&r->done[trial * r->n + p], 1);
    }
    return status;
}

/* Patterns that can't serve so many samples are known by trying; *reason gets their words. */
static koksma_status try_patterns(ranking *r, koksma_rank_row *rows, size_t *n_refused)
{
    for (size_t p = 0; p < r->options->n_patterns; p++) {
        char text[KOKSMA_MAX_SPEC];
        koksma_status status = koksma__image_pattern_text(r->options->patterns[p], text);
        if (status) {
            return status;
        }
        status = koksma__image_pattern_try(text, (size_t)r->options->spp, &r->watch.run);
        if (status == KOKSMA_INTERRUPTED || status == KOKSMA_MEMORY) {
            return status;
        }
        if (status) {
            koksma_rank_row *row = &rows[r->options->n_patterns - 1 - (*n_refused)++];
            *row = (koksma_rank_row){.pattern = p, .mean = NAN, .low = NAN, .high = NAN, .behind = NAN};
            snprintf(row->reason, sizeof row->reason, "%s", koksma_error_text());
        } else {
            r->patterns[r->n++] = p;
        }
    }
    return r->n ? KOKSMA_OK
                : koksma__fail(KOKSMA_ARGUMENT, "no pattern can serve: %s", rows[r->options->n_patterns - 1].reason);
}

/* The smallest error of one trial of every pattern. */
static koksma_status pilot(ranking *r, double *smallest)
{
    *smallest = INFINITY;
    r->first = 0;
    const koksma_status status = koksma__parallel(&r->watch.run, r->n, do_trial, r);
    for (size_t p = 0; p < r->n; p++) {
        *smallest = fmin(*smallest, r->errors[p * r->room]);
    }
    return status;
}

/* A reference has so many samples a pixel: a square number, for it is jittered. */
static int reference_side(const ranking *r)
{
    int side = 32;
    while (side * side < REFERENCE_SPP || side * side < 4 * r->options->spp) {
        side++;
    }
    return side;
}

/* Independent replicates until their own error is small beside the smallest measured one. */
static koksma_status make_reference(ranking *r, double *error)
{
    koksma__replicates sums = {0};
    koksma_status status = KOKSMA_OK;
    const int side = reference_side(r);
    long long wanted = LEAST_REPLICATES;
    double smallest = INFINITY;
    const double start = koksma__now_s(),
                 budget = r->options->time_limit_s > 0 ? r->options->time_limit_s / 3 : (double)INFINITY;
    do {
        for (; !status && sums.n < wanted;) {
            koksma_image image;
            const uint64_t seed = koksma__job_seed("rank-reference|%s|%s|%lld", r->scene.name, r->scene.hash, sums.n);
            status = render(r, "jittered", (long long)side * side, seed, &r->watch.run, &image);
            if (!status) {
                status = koksma__replicates_add(&sums, &image);
                koksma_image_fini(&image);
            }
        }
        koksma_image_fini(&r->reference);
        status =
            status ? status : koksma__replicates_mean(&sums, r->scene.width, r->scene.height, &r->reference, error);
        status = status ? status : pilot(r, &smallest);
        wanted *= 2;
    } while (!status && *error > REFERENCE_SHARE * smallest && wanted <= MOST_REPLICATES &&
             2 * (koksma__now_s() - start) < budget);
    free(sums.sum);
    return status;
}

/* ---- Judging ------------------------------------------------------------------------------------------- */

static koksma__summary difference(const ranking *r, size_t worse, size_t better, size_t trials)
{
    return koksma__paired(r->errors + worse * r->room, r->errors + better * r->room, trials, 1);
}

/* order[i]: the i-th best of the patterns that serve. */
static void order_patterns(const ranking *r, size_t trials, size_t *order)
{
    for (size_t p = 0; p < r->n; p++) {
        size_t at = p;
        const double mean = koksma__summarize(r->errors + p * r->room, trials, 1).mean;
        while (at > 0 && koksma__summarize(r->errors + order[at - 1] * r->room, trials, 1).mean > mean) {
            order[at] = order[at - 1];
            at--;
        }
        order[at] = p;
    }
}

static bool is_clear(const ranking *r, size_t trials, const size_t *order)
{
    bool clear = true;
    for (size_t i = 0; i + 1 < r->n; i++) {
        const koksma__summary d = difference(r, order[i + 1], order[i], trials);
        const double half = koksma__student_quantile(0.9975, (double)(trials - 1)) * d.sd / sqrt((double)trials);
        const double mean = koksma__summarize(r->errors + order[i] * r->room, trials, 1).mean;
        clear &= d.mean - half > 0 || d.mean + half <= EQUAL * mean;
    }
    return clear;
}

static void fill_rows(const ranking *r, size_t trials, const size_t *order, koksma_rank_row *rows)
{
    size_t leader = 0;
    for (size_t i = 0; i < r->n; i++) {
        const koksma__summary s = koksma__summarize(r->errors + order[i] * r->room, trials, 1);
        const koksma__estimate behind =
            koksma__relative_change(r->errors + order[i] * r->room, r->errors + order[0] * r->room, trials);
        if (i && difference(r, order[i], order[leader], trials).low > 0) {
            leader = i;
        }
        rows[i] = (koksma_rank_row){.pattern = r->patterns[order[i]],
                                    .place = leader + 1,
                                    .mean = s.mean,
                                    .low = s.low,
                                    .high = s.high,
                                    .behind = behind.value,
                                    .behind_low = behind.low,
                                    .behind_high = behind.high};
    }
}

/* The trials that all patterns have, when the time cut the first round short. */
static size_t whole_trials(const ranking *r)
{
    size_t jobs = 0;
    while (jobs < FIRST_ROUND * r->n && atomic_load(&r->done[jobs])) {
        jobs++;
    }
    return jobs / r->n;
}

static koksma_status fail_too_short(const ranking *r)
{
    return koksma__fail(
        KOKSMA_IMPOSSIBLE,
        "%s at %d samples a pixel: %g s are too short for a reference and two pictures of %d x %d pixels "
        "of every pattern",
        r->options->scene, r->options->spp, r->options->time_limit_s, r->scene.width, r->scene.height);
}

/* Rounds until it is clear. A round that the time cut short is left out; of the first what is whole is taken. */
static koksma_status run_rounds(ranking *r, size_t *order, koksma_ranking *out)
{
    koksma_status status = KOKSMA_OK;
    size_t trials = 0;
    for (size_t i = 0; i < FIRST_ROUND * r->n; i++) { /* the pilot's were compared with another reference */
        atomic_store(&r->done[i], 0);
    }
    for (size_t wanted = FIRST_ROUND; !status && !out->clear && wanted <= r->room; wanted *= 2) {
        r->first = trials;
        status = koksma__parallel(&r->watch.run, (wanted - trials) * r->n, do_trial, r);
        if (status == KOKSMA_INTERRUPTED && atomic_load(&r->watch.is_up)) {
            const size_t whole = trials ? trials : whole_trials(r);
            if (whole > 1 && whole > trials) {
                order_patterns(r, whole, order);
            }
            trials = whole;
            out->cut_short = true;
            status = whole > 1 ? KOKSMA_OK : KOKSMA_INTERRUPTED;
            break;
        }
        if (!status) {
            trials = wanted;
            order_patterns(r, trials, order);
            out->clear = is_clear(r, trials, order);
        }
    }
    out->trials = (long long)trials;
    return status;
}

/* ---- What fits into the time --------------------------------------------------------------------------- */

/* How long a picture of at most 4,096 pixels takes. */
static koksma_status probe(const ranking *r, long long spp, double *pixels, double *seconds)
{
    ranking small = *r;
    koksma_image image;
    while ((long long)small.scene.width * small.scene.height > 4096 && small.scene.width > 1) {
        small.scene.width = (small.scene.width + 1) / 2;
        small.scene.height = (small.scene.height + 1) / 2;
    }
    const double start = koksma__now_s();
    const koksma_status status = render(&small, "jittered", spp, 0, &r->watch.run, &image);
    *seconds = koksma__now_s() - start;
    *pixels = (double)small.scene.width * small.scene.height;
    if (!status) {
        koksma_image_fini(&image);
    }
    return status;
}

/* Halves the picture until the least that a ranking takes (the first references, one trial to judge them by, the
   first round) fits into half of the time limit, by what a sample and a picture without samples cost in two small
   ones. */
static koksma_status fit_picture(ranking *r)
{
    double pixels = 0, few_s = 0, many_s = 0;
    const double n = (double)r->n, side = reference_side(r), limit_s = r->options->time_limit_s / 2;
    if (r->options->width || !(limit_s > 0)) {
        return KOKSMA_OK;
    }
    koksma_status status = probe(r, 4, &pixels, &few_s);
    status = status ? status : probe(r, 64, &pixels, &many_s);
    const double sample_s = fmax(many_s - few_s, 0) / (60 * pixels),
                 empty_s = fmax(many_s - 64 * pixels * sample_s, 0);
    const double pictures = LEAST_REPLICATES + (1 + FIRST_ROUND) * n;
    const double samples = LEAST_REPLICATES * side * side + (1 + FIRST_ROUND) * n * r->options->spp;
    while (!status && r->scene.width >= 128 && r->scene.height >= 96 &&
           pictures * empty_s + samples * sample_s * r->scene.width * r->scene.height > limit_s) {
        r->scene.width /= 2;
        r->scene.height /= 2;
    }
    return status;
}

static koksma_status rank_scene(ranking *r, koksma_rank_row *rows, koksma_ranking *out)
{
    const size_t n = r->options->n_patterns;
    size_t n_refused = 0;
    r->room = r->options->max_trials ? (size_t)r->options->max_trials : MOST_TRIALS;
    r->errors = calloc(n, r->room * sizeof *r->errors);
    r->patterns = calloc(2 * n, sizeof *r->patterns);
    r->done = calloc(FIRST_ROUND * n, sizeof *r->done);
    if (!r->errors || !r->patterns || !r->done) {
        return koksma__fail_memory(n * r->room * sizeof *r->errors);
    }
    size_t *order = r->patterns + n;
    koksma_status status = try_patterns(r, rows, &n_refused);
    status = status ? status : fit_picture(r);
    out->width = r->scene.width;
    out->height = r->scene.height;
    status = status ? status : make_reference(r, &out->reference_error);
    status = status ? status : run_rounds(r, order, out);
    if (status == KOKSMA_INTERRUPTED && atomic_load(&r->watch.is_up)) {
        status = fail_too_short(r);
    }
    out->n = r->n;
    if (!status) {
        fill_rows(r, (size_t)out->trials, order, rows);
    }
    return status;
}

koksma_status koksma_rank(const koksma_rank_options *options, const koksma_run *run, koksma_rank_row *rows,
                          koksma_ranking *out)
{
    const double start = koksma__now_s();
    ranking r = {.options = options, .scene = {.name = options->scene}};
    koksma__watch_begin(run, options->time_limit_s, &r.watch);
    *out = (koksma_ranking){0};
    if (!options->n_patterns) {
        return koksma__fail(KOKSMA_ARGUMENT, "a ranking has at least one pattern");
    }
    if (options->max_trials && (options->max_trials < FIRST_ROUND || options->max_trials > KOKSMA_MAX_RANK_TRIALS)) {
        return koksma__fail(KOKSMA_ARGUMENT, "max_trials %lld: a ranking takes %d to %d trials, or 0",
                            options->max_trials, FIRST_ROUND, KOKSMA_MAX_RANK_TRIALS);
    }
    koksma__variant_text(options->integrator, options->filter, r.variant);
    koksma_status status = koksma_scene_open(options->scene, &r.scene.scene);
    if (!status) {
        koksma_render_options defaults;
        koksma_render_options_init(&defaults, r.scene.scene);
        r.scene.width = options->width ? options->width : defaults.width;
        r.scene.height = options->width ? options->height : defaults.height;
        snprintf(r.scene.hash, sizeof r.scene.hash, "%016llx", (unsigned long long)koksma_scene_hash(r.scene.scene));
        status = rank_scene(&r, rows, out);
        koksma_scene_close(r.scene.scene);
    }
    out->seconds = koksma__now_s() - start;
    koksma_image_fini(&r.reference);
    free(r.errors);
    free(r.patterns);
    free(r.done);
    return status;
}
