/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_optimise_scene: searches for a point set that gives the image of one scene a small error if every pixel uses
 * it as file:FILE. Long because the four steps, and the checks before them, share the candidates and the open scenes.
 *
 * 1. Weights. In every pixel the radiance is sampled once at 8 x 8 positions and analysed as a two-way layout
 *    (analysis of variance). This gives the variance along x, along y, and of the interaction of both (which includes
 *    the noise of lights and lenses), summed over the pixels.
 *
 * 2. Candidates. koksma_optimise minimises an L2 discrepancy (l2-star, l2-periodic, l2-extreme in turn) of the
 *    projections on x, on y and on the plane. The weight of a projection is its share of the variance, divided by the
 *    discrepancy of random points. The first three candidates have these weights; the others have these weights times
 *    random factors from 1/4 to 4, which lead to other sets of low discrepancy. Each candidate is tried at several
 *    phases, which are shifts on the torus by multiples of a vector of the R2 sequence.
 *
 * 3. Elimination. koksma_rank_patterns renders the scene with all candidates until it is decided which one has the
 *    least error. A candidate is rendered no further once its confidence interval shows a larger error.
 *
 * 4. Evaluation. The chosen set is compared with the listed patterns (options->against), in the scene itself with
 *    other random numbers, and in held-out scenes, which took no part in steps 1 to 3. A gain in the scene itself that
 *    the held-out scenes do not show comes from the fit to that scene, not from better points.
 *
 * The renderer reads the candidates through `set_pattern`, a pattern outside the library's table whose path is the
 * address of a set, so that several searches may run at once.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/study.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "image/image.h"
#include "study/plan/variants.h"

enum { SIDE = 8, MOST_PIXELS = 40 * 30, NAME = 32, MOST_SETS = 1000, MOST_SPP = 4096, SALT_CHOICE = 1, SALT_JUDGE };

static const char *const listed[] = {"n-rooks",
                                     "jittered",
                                     "multi-jittered",
                                     "correlated-multi-jittered",
                                     "sobol",
                                     "sobol:scramble=owen",
                                     "halton:scramble=owen",
                                     "pmj02",
                                     "pmj02bn:levels=4",
                                     "r-sequence:shift=1",
                                     "hammersley",
                                     "hammersley:shift=1",
                                     "fibonacci",
                                     "fibonacci:shift=1",
                                     "zaremba",
                                     "regular",
                                     "best-candidate"};
static const char *const scenes[] = {"ball", "balls", "checker", "checker-45", "cornell", "glossy", "mirror-block"};
enum { N_LISTED = sizeof listed / sizeof *listed, N_SCENES = sizeof scenes / sizeof *scenes, N_HELD_OUT = 6 };

typedef struct search {
    const koksma_scene_search *options;
    size_t n_sets, phases;
    long long max_trials;
    const char *scenes[1 + KOKSMA_MAX_HELD_OUT];   /* the scene, and the held-out scenes */
    koksma_scene *opened[1 + KOKSMA_MAX_HELD_OUT]; /* NULL once the set is judged in it */
    const char *against[KOKSMA_MAX_AGAINST];
    size_t n_held_out, n_against;
    const koksma_run *caller;
    double begin, share; /* of the current step: the fraction of all work before it, and its own */
    double done;         /* the largest fraction reported so far, because a ranking reports 0 again at every round */
    koksma_run run;      /* reports the progress of a step to `caller` */
    bool stopped;        /* whether `caller` has returned false */
    koksma_scene *open;  /* the one of `opened` that is being rendered */
    uint64_t salt;
    koksma_points *sets; /* candidates: n_sets times phases */
    size_t n;            /* number of candidates made */
    size_t chosen;
    koksma_scene_optimum *out;
} search;

/* ---- Progress ---------------------------------------------------------------------------------------------- */

static bool keep_going(void *context, double fraction)
{
    search *s = context;
    s->done = fmax(s->done, s->begin + s->share * fraction);
    s->stopped = s->stopped || !koksma__keep_going(s->caller, s->done);
    return !s->stopped;
}

/* Begins part i of the work, which has n equal parts. */
static void begin_part(search *s, size_t i, size_t n)
{
    s->begin = (double)i / (double)n;
    s->share = 1 / (double)n;
}

/* ---- Patterns and pictures --------------------------------------------------------------------------------- */

/* Generates the set whose address is args->path. Without a path all points are (params[0], params[1]). */
static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    void *address = NULL;
    KOKSMA__FAIL_IF(args->path && *args->path && sscanf(args->path, "%p", &address) != 1, KOKSMA_ARGUMENT,
                    "set:%s: no address", args->path);
    const koksma_points *from = address;
    for (size_t i = 0; i < out->n; i++) {
        for (int k = 0; k < out->dim; k++) {
            out->xs[i * (size_t)out->dim + (size_t)k] =
                from ? from->xs[i % from->n * 2 + (size_t)k] : args->params[k];
        }
    }
    return KOKSMA_OK;
}

static const koksma_param set_params[] = {
    {"x", "of a point", 0, 0, 1, NULL, false}, {"y", "of a point", 0, 0, 1, NULL, false}, {0}};
static const koksma_pattern set_pattern = {.name = "set",
                                           .title = "a candidate",
                                           .cite = "-",
                                           .min_dim = 1,
                                           .max_dim = 2,
                                           .claims = KOKSMA_CLAIM_DETERMINISTIC,
                                           .params = set_params,
                                           .generate = generate};

/* Renders one image for koksma_rank_patterns. Rankings with different salts use different random numbers although
   their seeds are equal. */
static koksma_status render(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                            koksma_image *image)
{
    const search *s = context;
    koksma_render_options o;
    size_t i;
    koksma_status status = KOKSMA_OK;
    koksma_render_options_init(&o, s->open);
    if (sscanf(picture->pattern, "set %zu", &i) == 1) {
        o.pattern = (koksma_spec){.pattern = &set_pattern};
        snprintf(o.pattern.path, sizeof o.pattern.path, "%p", (void *)&s->sets[i]);
    } else {
        status = koksma_render_patterns(picture->pattern, &o);
    }
    o.spp = picture->spp;
    o.width = picture->width;
    o.height = picture->height;
    o.seed = picture->seed | s->salt << 32;
    return status ? status : koksma_render(s->open, &o, run, image);
}

/* Chooses the size of the images: that of the options, or the scene's, halved until it has at most MOST_PIXELS
   pixels. */
static void choose_size(const search *s, int *width, int *height)
{
    koksma_render_options o;
    koksma_render_options_init(&o, s->open);
    const bool given = s->options->width != 0;
    *width = given ? s->options->width : o.width;
    *height = given ? s->options->height : o.height;
    while (!given && (long long)*width * *height > MOST_PIXELS) {
        *width = (*width + 1) / 2;
        *height = (*height + 1) / 2;
    }
}

/* Fails if images of the open scene with different random samples are equal, which leaves no errors to compare. */
static koksma_status check_image(search *s, const char *scene)
{
    koksma_rank_picture picture = {.scene = scene, .pattern = "random", .spp = SIDE * SIDE};
    koksma_image one, other;
    choose_size(s, &picture.width, &picture.height);
    KOKSMA__TRY(render(s, &picture, &s->run, &one));
    picture.seed = 1;
    koksma_status status = render(s, &picture, &s->run, &other);
    if (!status) {
        const size_t bytes = (size_t)one.width * (size_t)one.height * (size_t)one.channels * sizeof *one.pixels;
        status = memcmp(one.pixels, other.pixels, bytes)
                     ? KOKSMA_OK
                     : koksma__fail(KOKSMA_IMPOSSIBLE,
                                    "%s: its image is the same for every seed, as that of a scene without light is: "
                                    "patterns have no error in it",
                                    scene);
        koksma_image_fini(&other);
    }
    koksma_image_fini(&one);
    return status;
}

static koksma_status rank(search *s, const char *const *patterns, size_t n, koksma_rank_row *rows,
                          koksma_ranking *ranking, const char *scene)
{
    koksma_rank_options o = {.scene = scene,
                             .patterns = patterns,
                             .n_patterns = n,
                             .spp = s->options->spp,
                             .max_trials = s->max_trials,
                             .one_size = true,
                             .best_only = true,
                             .full_reference = true,
                             .render = render,
                             .render_context = s,
                             .reference = "jittered"};
    choose_size(s, &o.width, &o.height);
    return koksma_rank_patterns(&o, &s->run, rows, ranking);
}

/* ---- Weights ----------------------------------------------------------------------------------------------- */

/* Adds the variances of a pixel. In a two-way layout without replicates the expected mean square along x is MS_x =
   SIDE var_x + var_xy, and likewise along y. */
static void add_pixel(const double *f, size_t pixels, double *variances)
{
    double rows[SIDE] = {0}, columns[SIDE] = {0}, mean = 0, ms[2] = {0}, rest = 0;
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        columns[i % SIDE] += f[i * pixels] / SIDE;
        rows[i / SIDE] += f[i * pixels] / SIDE;
        mean += f[i * pixels] / (SIDE * SIDE);
    }
    for (size_t i = 0; i < SIDE * SIDE; i++) {
        const double off = f[i * pixels] - columns[i % SIDE] - rows[i / SIDE] + mean;
        rest += off * off / ((SIDE - 1) * (SIDE - 1));
    }
    for (size_t i = 0; i < SIDE; i++) {
        ms[0] += SIDE * (columns[i] - mean) * (columns[i] - mean) / (SIDE - 1);
        ms[1] += SIDE * (rows[i] - mean) * (rows[i] - mean) / (SIDE - 1);
    }
    variances[0] += (ms[0] - rest) / SIDE;
    variances[1] += (ms[1] - rest) / SIDE;
    variances[2] += rest;
}

/* Renders all pixels with sample position i of the SIDE x SIDE positions, and stores their luminances in f, which is
   allocated at the first position. */
static koksma_status sample_position(search *s, koksma_render_options *o, size_t i, double **f, size_t *pixels)
{
    koksma_image image;
    o->patterns[0] = (koksma_spec){.pattern = &set_pattern,
                                   .params = {((double)(i % SIDE) + 0.5) / SIDE, ((double)(i / SIDE) + 0.5) / SIDE}};
    o->seed = s->options->seed * SIDE * SIDE + i;
    KOKSMA__TRY(koksma_render(s->open, o, &s->run, &image));
    *pixels = (size_t)image.width * (size_t)image.height;
    const size_t bytes = SIDE * SIDE * *pixels * sizeof **f;
    *f = *f ? *f : malloc(bytes);
    for (size_t p = 0; p < *pixels && *f; p++) {
        (*f)[i * *pixels + p] = koksma__luminance(&image, p);
    }
    koksma_image_fini(&image);
    return *f ? KOKSMA_OK : koksma__fail_memory(bytes);
}

static koksma_status find_shares(search *s)
{
    koksma_render_options o;
    double *f = NULL, variances[3] = {0}, sum = 0;
    size_t pixels = 0;
    koksma_render_options_init(&o, s->open);
    choose_size(s, &o.width, &o.height);
    o.spp = 1;
    koksma_status status = koksma_pattern_spec("random", &o.pattern);
    for (size_t i = 0; i < SIDE * SIDE && !status; i++) {
        status = sample_position(s, &o, i, &f, &pixels);
    }
    for (size_t p = 0; p < pixels && !status; p++) {
        add_pixel(f + p, pixels, variances);
    }
    free(f);
    /* shares below 0.01 become 0.01, because the samples may have missed a source of variance */
    for (int k = 0; k < 3; k++) {
        sum += fmax(variances[k], 0);
    }
    for (int k = 0; k < 3; k++) {
        s->out->shares[k] = sum > 0 ? fmax(variances[k] / sum, 0.01) : 1.0 / 3;
    }
    return status;
}

/* ---- Candidates -------------------------------------------------------------------------------------------- */

/* For each L2 discrepancy its mean square over sets of n random points, times n: in one dimension, and in the plane. */
static const struct {
    const char *measure;
    double line, plane;
} kernels[] = {
    {"l2-star", 1.0 / 6, 5.0 / 36}, {"l2-periodic", 1.0 / 6, 5.0 / 36}, {"l2-extreme", 1.0 / 12, 1.0 / 48}};

/* Draws three random factors from 1/4 to 4. */
static koksma_status random_factors(uint64_t seed, double factors[3])
{
    koksma_spec spec;
    koksma_points points;
    koksma_status status = koksma_pattern_spec("random", &spec);
    status = status ? status : koksma_points_init(&points, 1, 3);
    if (!status) {
        status = koksma_generate(&spec, seed, NULL, &points);
        for (int k = 0; k < 3; k++) {
            factors[k] = koksma__pow(4, 2 * points.xs[k] - 1);
        }
        koksma_points_fini(&points);
    }
    return status;
}

static koksma_status make_set(const search *s, size_t c, koksma_points *out)
{
    static const uint64_t projections[] = {1, 2, 3};
    const size_t kind = c % 3;
    double weights[3], factors[3] = {1, 1, 1};
    koksma_spec measure, latin;
    koksma_points first = {0};
    koksma_optimum best = {0};
    koksma_status status = koksma_measure_spec(kernels[kind].measure, &measure);
    if (!status && c >= 3) {
        status = random_factors(s->options->seed * 1000 + c, factors);
    }
    for (int k = 0; k < 3; k++) {
        weights[k] = factors[k] * s->out->shares[k] / (k < 2 ? kernels[kind].line : kernels[kind].plane);
    }
    /* from a random set, since candidates that start from one good set would be alike */
    status = status ? status : koksma_points_init(&first, (size_t)s->options->spp, 2);
    status = status ? status : koksma_pattern_spec("latin-hypercube", &latin);
    status = status ? status : koksma_generate(&latin, s->options->seed * 1000 + c, &s->run, &first);
    const koksma_optimise_options o = {.n = (size_t)s->options->spp,
                                       .dim = 2,
                                       .first = &first,
                                       .seed = s->options->seed * 1000 + c,
                                       .steps = 1,
                                       .projections = projections,
                                       .weights = weights,
                                       .n_projections = 3};
    status = status ? status : koksma_optimise(&measure, &o, &s->run, &best);
    if (!status) {
        *out = best.points;
        best.points = (koksma_points){0};
    }
    koksma_optimum_fini(&best);
    koksma_points_fini(&first);
    return status;
}

/* Makes phase p of a set: shifts it by p (1/g, 1/g^2), where g^3 = g + 1 (the R2 sequence of Roberts 2018). */
static koksma_status shift(const koksma_points *from, size_t p, koksma_points *out)
{
    static const double step[] = {0.7548776662466927, 0.5698402909980532};
    KOKSMA__TRY(koksma_points_init(out, from->n, from->dim));
    for (size_t c = 0; c < 2 * from->n; c++) {
        const double x = from->xs[c] + (double)p * step[c % 2], wrapped = x - floor(x);
        out->xs[c] = wrapped < 1 ? wrapped : 0;
    }
    return KOKSMA_OK;
}

/* Copies the chosen candidate to the result, and shows it to the caller. */
static koksma_status show_chosen(search *s)
{
    const koksma_points *set = &s->sets[s->chosen];
    koksma_scene_optimum *out = s->out;
    if (!out->points.xs) {
        KOKSMA__TRY(koksma_points_init(&out->points, set->n, set->dim));
    }
    memcpy(out->points.xs, set->xs, set->n * (size_t)set->dim * sizeof *set->xs);
    out->measure = kernels[s->chosen / s->phases % 3].measure;
    out->phase = s->chosen % s->phases;
    if (!s->options->found) {
        return KOKSMA_OK;
    }
    const char kept = koksma__call_begin();
    return koksma__call_end(kept, s->options->found(s->options->context, out), "koksma_scene_search.found");
}

static koksma_status make_candidates(search *s)
{
    koksma_status status = KOKSMA_OK;
    s->sets = calloc(s->n_sets * s->phases, sizeof *s->sets);
    KOKSMA__REQUIRE_MEMORY(s->sets, s->n_sets * s->phases * sizeof *s->sets);
    for (size_t c = 0; c < s->n_sets && !status; c++) {
        begin_part(s, c, 2 * s->n_sets);
        status = make_set(s, c, &s->sets[s->n]);
        s->n += !status;
        if (!status && c == 0) {
            status = show_chosen(s); /* in case of an interruption before one is chosen */
        }
        for (size_t p = 1; p < s->phases && !status; p++) {
            status = shift(&s->sets[s->n - p], p, &s->sets[s->n]);
            s->n += !status;
        }
    }
    s->out->candidates = s->n;
    return status;
}

/* Ranks the candidates. Counts the eliminated candidates, and chooses the one with the least error. */
static koksma_status choose(search *s)
{
    char *names = calloc(s->n, NAME);
    const char **patterns = calloc(s->n, sizeof *patterns);
    koksma_rank_row *rows = calloc(s->n, sizeof *rows);
    koksma_ranking ranking;
    koksma_status status = names && patterns && rows ? KOKSMA_OK : koksma__fail_memory(s->n * sizeof *rows);
    for (size_t i = 0; i < s->n && !status; i++) {
        snprintf(names + i * NAME, NAME, "set %zu", i);
        patterns[i] = names + i * NAME;
    }
    s->salt = SALT_CHOICE;
    begin_part(s, 2, 4);
    status = status ? status : rank(s, patterns, s->n, rows, &ranking, s->options->scene);
    for (size_t i = 0; i < s->n && !status; i++) {
        s->out->eliminated += rows[i].decision == KOKSMA_RANK_WORSE;
    }
    if (!status) {
        s->chosen = rows[0].pattern;
        s->out->chosen = true;
    }
    KOKSMA__FREE(rows, (void *)patterns, names);
    return status;
}

/* ---- Evaluation -------------------------------------------------------------------------------------------- */

/* Compares the chosen set with the listed patterns in one scene. A ranking's `behind` is a pattern's error divided
   by the error of row 0, minus 1. */
static koksma_status judge(search *s, koksma_scene_gain *g)
{
    const char *patterns[KOKSMA_MAX_AGAINST + 1];
    char name[NAME];
    koksma_rank_row rows[KOKSMA_MAX_AGAINST + 1];
    koksma_ranking ranking;
    snprintf(name, sizeof name, "set %zu", s->chosen);
    patterns[0] = name;
    memcpy(patterns + 1, s->against, s->n_against * sizeof *patterns);
    s->salt = SALT_JUDGE;
    choose_size(s, &g->width, &g->height);
    KOKSMA__TRY(rank(s, patterns, s->n_against + 1, rows, &ranking, g->scene));
    for (size_t i = 0; i <= s->n_against; i++) { /* a set that only some seeds have */
        KOKSMA__FAIL_IF(rows[i].state == KOKSMA_RANK_REFUSED, KOKSMA_IMPOSSIBLE, "%s", rows[i].reason);
    }
    size_t own = 0;
    while (rows[own].pattern != 0) {
        own++;
    }
    const koksma_rank_row *a = &rows[own], *b = &rows[own == 0];
    g->error = a->mean;
    g->coherent = a->coherence.coherent;
    g->trials = a->trials;
    g->best_listed = s->against[b->pattern - 1];
    g->listed_error = b->mean;
    g->settled = ranking.settled;
    g->gain = own ? -a->behind : 1 - 1 / (1 + b->behind);
    g->low = own ? -a->behind_high : 1 - 1 / (1 + b->behind_low);
    g->high = own ? -a->behind_low : 1 - 1 / (1 + b->behind_high);
    return KOKSMA_OK;
}

/* Judges the set in the scene that it is made for, and in the held-out scenes. */
static koksma_status judge_all(search *s)
{
    koksma_scene_optimum *out = s->out;
    for (size_t i = 0; i <= s->n_held_out; i++) {
        koksma_scene_gain *g = &out->gains[i];
        *g = (koksma_scene_gain){.scene = s->scenes[i]};
        begin_part(s, 3 * (s->n_held_out + 1) + i, 4 * (s->n_held_out + 1));
        s->open = s->opened[i];
        KOKSMA__TRY(judge(s, g));
        koksma_scene_close(s->opened[i]);
        s->opened[i] = NULL;
        out->n_gains++;
    }
    const double n = (double)s->n_held_out;
    out->gain = out->low = out->high = n > 0 ? 0 : (double)NAN;
    for (size_t i = 1; i < out->n_gains; i++) {
        out->gain += out->gains[i].gain / n;
        out->low += out->gains[i].low / n;
        out->high += out->gains[i].high / n;
    }
    return KOKSMA_OK;
}

/* ---- The search -------------------------------------------------------------------------------------------- */

/* The canonical text of a listed pattern, which all spellings of its name and parameters share. */
static koksma_status text_of(const char *pattern, char text[KOKSMA_MAX_PATTERNS_TEXT])
{
    koksma_render_options o = {0};
    KOKSMA__TRY(koksma__image_pattern_set(pattern, &o));
    koksma_render_patterns_text(&o, text);
    return KOKSMA_OK;
}

/* Fails if a pattern is listed already: one that counts twice widens the intervals of all. */
static koksma_status check_new_pattern(const search *s, const char *pattern)
{
    char text[KOKSMA_MAX_PATTERNS_TEXT], other[KOKSMA_MAX_PATTERNS_TEXT];
    KOKSMA__TRY(text_of(pattern, text));
    for (size_t i = 0; i < s->n_against; i++) {
        KOKSMA__TRY(text_of(s->against[i], other));
        KOKSMA__FAIL_IF(!strcmp(text, other), KOKSMA_ARGUMENT,
                        "%s: it is listed twice among the patterns to compare with", text);
    }
    return KOKSMA_OK;
}

/* Stores the patterns to compare with: those of the options, each of which must make the points, or, by default, those
   of the table `listed` that do. */
static koksma_status take_against(search *s)
{
    const koksma_scene_search *o = s->options;
    const char *const *texts = o->against ? o->against : listed;
    const size_t n = o->against ? o->n_against : N_LISTED;
    KOKSMA__FAIL_IF(n < 1 || n > KOKSMA_MAX_AGAINST, KOKSMA_ARGUMENT,
                    "n_against = %zu: the patterns to compare with must be 1 to %d", n, KOKSMA_MAX_AGAINST);
    for (size_t i = 0; i < n; i++) {
        KOKSMA__FAIL_IF(!texts[i], KOKSMA_ARGUMENT, "against: text %zu is NULL", i);
        const koksma_status status = koksma__image_pattern_try(texts[i], (size_t)o->spp, &s->run);
        if (!o->against && (status == KOKSMA_N || status == KOKSMA_IMPOSSIBLE)) {
            continue;
        }
        KOKSMA__TRY(status);
        KOKSMA__TRY(check_new_pattern(s, texts[i]));
        s->against[s->n_against++] = texts[i];
    }
    return KOKSMA_OK;
}

static koksma_status check_held_out(const koksma_scene_search *o)
{
    KOKSMA__FAIL_IF(o->held_out && o->n_held_out > KOKSMA_MAX_HELD_OUT, KOKSMA_ARGUMENT,
                    "n_held_out = %zu: the held-out scenes must be at most %d", o->n_held_out, KOKSMA_MAX_HELD_OUT);
    for (size_t i = 0; o->held_out && i < o->n_held_out; i++) {
        KOKSMA__FAIL_IF(!o->held_out[i], KOKSMA_ARGUMENT, "held_out: text %zu is NULL", i);
        KOKSMA__FAIL_IF(!strcmp(o->held_out[i], o->scene), KOKSMA_ARGUMENT,
                        "held_out: '%s' is the scene that the set is optimised for", o->scene);
    }
    return KOKSMA_OK;
}

/* Opens all scenes before the search, which takes long, and of which a scene that is missing would cost the result. The
   held-out scenes are those of the options, or, by default, the first N_HELD_OUT in the table `scenes` that are not the
   scene itself. The scenes must differ: the scene itself would show the gain that it was searched for, and another one
   that counts twice would weigh twice in the mean. */
static koksma_status open_scenes(search *s)
{
    const koksma_scene_search *o = s->options;
    const char *const *texts = o->held_out ? o->held_out : scenes;
    const size_t n = o->held_out ? o->n_held_out : N_SCENES, most = o->held_out ? n : N_HELD_OUT;
    s->scenes[0] = o->scene;
    KOKSMA__TRY(koksma_scene_open(o->scene, &s->opened[0]));
    for (size_t i = 0; i < n && s->n_held_out < most; i++) {
        koksma_scene *scene;
        size_t same = 0;
        KOKSMA__TRY(koksma_scene_open(texts[i], &scene));
        while (same <= s->n_held_out && koksma_scene_hash(s->opened[same]) != koksma_scene_hash(scene)) {
            same++;
        }
        if (same > s->n_held_out) {
            s->scenes[++s->n_held_out] = texts[i];
            s->opened[s->n_held_out] = scene;
            continue;
        }
        koksma_scene_close(scene);
        KOKSMA__FAIL_IF(o->held_out, KOKSMA_ARGUMENT,
                        same ? "%s: as a held-out scene it is listed twice"
                             : "%s: the held-out scene is the one that the set is optimised for",
                        texts[i]);
    }
    for (size_t i = 0; i <= s->n_held_out; i++) {
        s->open = s->opened[i];
        KOKSMA__TRY(check_image(s, s->scenes[i]));
    }
    s->open = s->opened[0];
    return KOKSMA_OK;
}

static koksma_status take_options(search *s)
{
    const koksma_scene_search *o = s->options;
    KOKSMA__FAIL_IF(!o->scene, KOKSMA_ARGUMENT, "scene is NULL");
    KOKSMA__FAIL_IF(o->spp < 1 || o->spp > MOST_SPP, KOKSMA_ARGUMENT,
                    "spp = %d: the samples per pixel must be 1 to %d", o->spp, MOST_SPP);
    KOKSMA__FAIL_IF(o->width < 0 || o->height < 0 || o->width > KOKSMA_MAX_IMAGE_SIDE ||
                        o->height > KOKSMA_MAX_IMAGE_SIDE || !o->width != !o->height,
                    KOKSMA_ARGUMENT, "width x height = %d x %d: both must be 1 to %d pixels, or both 0", o->width,
                    o->height, KOKSMA_MAX_IMAGE_SIDE);
    KOKSMA__FAIL_IF(o->seed > UINT32_MAX, KOKSMA_ARGUMENT, "seed = %llu: it must be below 2^32",
                    (unsigned long long)o->seed);
    KOKSMA__FAIL_IF(o->candidates > MOST_SETS, KOKSMA_ARGUMENT, "candidates = %zu: they must be at most %d",
                    o->candidates, MOST_SETS);
    KOKSMA__FAIL_IF(o->phases > MOST_SETS, KOKSMA_ARGUMENT, "phases = %zu: they must be at most %d", o->phases,
                    MOST_SETS);
    s->n_sets = o->candidates ? o->candidates : 8;
    s->phases = o->phases ? o->phases : 4;
    s->max_trials = o->max_trials ? o->max_trials : 32;
    KOKSMA__FAIL_IF(s->max_trials < 8 || s->max_trials > KOKSMA_MAX_RANK_TRIALS, KOKSMA_ARGUMENT,
                    "max_trials = %lld: it must be 8 to %d", s->max_trials, KOKSMA_MAX_RANK_TRIALS);
    return check_held_out(o);
}

static koksma_status run_search(search *s)
{
    KOKSMA__TRY(open_scenes(s));
    KOKSMA__TRY(take_against(s));
    KOKSMA__TRY(find_shares(s));
    KOKSMA__TRY(make_candidates(s));
    KOKSMA__TRY(choose(s));
    KOKSMA__TRY(show_chosen(s));
    return judge_all(s);
}

koksma_status koksma_optimise_scene(const koksma_scene_search *options, const koksma_run *run,
                                    koksma_scene_optimum *out)
{
    KOKSMA__REQUIRE(options, out);
    KOKSMA__REQUIRE_RUN(run);
    *out = (koksma_scene_optimum){0};
    search s = {.options = options, .caller = run, .out = out};
    s.run = (koksma_run){.threads = run ? run->threads : 0, .keep_going = keep_going, .context = &s};
    KOKSMA__TRY(take_options(&s));
    out->gain = out->low = out->high = (double)NAN;
    const koksma_status status = run_search(&s);
    if (status && status != KOKSMA_INTERRUPTED) {
        koksma_scene_optimum_fini(out);
    }
    for (size_t i = 0; i <= s.n_held_out; i++) {
        koksma_scene_close(s.opened[i]);
    }
    for (size_t i = 0; i < s.n; i++) {
        koksma_points_fini(&s.sets[i]);
    }
    free(s.sets);
    return status;
}

void koksma_scene_optimum_fini(koksma_scene_optimum *best)
{
    if (best) {
        koksma_points_fini(&best->points);
        *best = (koksma_scene_optimum){0};
    }
}
