/* SPDX-License-Identifier: Apache-2.0 */
/*
 * `koksma optimise --scene SCENE -n SPP`: searches for a point set that gives the image of one scene a small error if
 * every pixel uses it as file:FILE.
 *
 * 1. Weights. In every pixel the radiance is sampled once at 8 x 8 positions and analysed as a two-way layout (analysis
 * of variance). This gives the variance along x, along y, and of the interaction of both (which includes the noise of
 * lights and lenses), summed over the pixels.
 *
 * 2. Candidates. koksma_optimise minimises an L2 discrepancy (l2-star, l2-periodic, l2-extreme in turn) of the
 * projections on x, on y and on the plane. The weight of a projection is its share of the variance, divided
 *    by the discrepancy of random points. The first three candidates have these weights; the others have these
 *    weights times random factors from 1/4 to 4, because many sets have the same low discrepancy. Each candidate
 *    comes in several phases: shifted on the torus by multiples of a vector of the R2 sequence.
 *
 * 3. Elimination. koksma_rank_patterns renders the scene with all candidates until it is decided which one has the
 *    least error. A candidate is rendered no further once its confidence interval shows a larger error.
 *
 * 4. Evaluation. The chosen set is compared with the listed patterns (--against), in the scene itself with other random
 *    numbers, and in held-out scenes, which took no part in steps 1 to 3. A gain that only the first scene shows is due
 *    to chance, not to better points.
 */
#include "optimise_scene.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/study.h>

#include "source.h"

enum {
    SIDE = 8,
    MOST_PATTERNS = 64,
    MOST_SCENES = 16,
    MOST_PIXELS = 40 * 30,
    NAME = 32,
    SALT_CHOICE = 1,
    SALT_JUDGE
};

static const char listed[] =
    "n-rooks,jittered,multi-jittered,correlated-multi-jittered,sobol,sobol:scramble=owen,"
    "halton:scramble=owen,pmj02,pmj02bn:levels=4,r-sequence:shift=1,hammersley,hammersley:shift=1,"
    "fibonacci,fibonacci:shift=1,zaremba,regular,best-candidate";
static const char scenes[] = "ball,balls,checker,checker-45,cornell,glossy,mirror-block";

/* The candidate sets. The renderer reads the candidates through set_pattern below, which is a pattern outside the
   library's table. */
static koksma_points *sets;

typedef struct scene_job {
    const cli_arguments *arguments;
    cli_work work;
    const char *scene;
    koksma_scene *open; /* the scene that is being rendered */
    uint64_t seed, salt, n_sets, phases, max_trials;
    int spp, width, height;
    double shares[3]; /* shares of the variance: along x, along y, and of their interaction */
    size_t n;         /* number of candidates: sets times phases */
    size_t chosen, eliminated;
    bool settled;
    char held_out[MOST_SCENES][KOKSMA_MAX_SPEC], names[MOST_PATTERNS][KOKSMA_MAX_SPEC];
    const char *patterns[MOST_PATTERNS];
    size_t n_held_out, n_patterns;
} scene_job;

/* The error of the set compared with the best listed pattern, in one scene. */
typedef struct verdict {
    const char *scene, *role;
    koksma_rank_row own, other;
    double gain, low, high; /* the gain: 1 - (error of the set / error of the best listed pattern), with its interval
                               */
    bool settled;
    int width, height;
} verdict;

/* ---- Patterns and pictures --------------------------------------------------------------------------------- */

/* Generates the candidate set params[0]. If params[0] < 0, all points are (params[1], params[2]). */
static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    (void)seed;
    const koksma_points *from = args->params[0] < 0 ? NULL : &sets[(size_t)args->params[0]];
    for (size_t i = 0; i < out->n; i++) {
        for (int k = 0; k < out->dim; k++) {
            out->xs[i * (size_t)out->dim + (size_t)k] =
                from ? from->xs[i % from->n * 2 + (size_t)k] : args->params[1 + k];
        }
    }
    return KOKSMA_OK;
}

static const koksma_param set_params[] = {{"set", "which", 0, -1, 1e6, NULL, true},
                                          {"x", "of a point", 0, 0, 1, NULL, false},
                                          {"y", "of a point", 0, 0, 1, NULL, false},
                                          {0}};
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
    const scene_job *j = context;
    koksma_render_options o;
    size_t i;
    koksma_status status = KOKSMA_OK;
    koksma_render_options_init(&o, j->open);
    if (sscanf(picture->pattern, "set %zu", &i) == 1) {
        o.pattern = (koksma_spec){.pattern = &set_pattern, .params = {(double)i}};
    } else {
        status = koksma_render_patterns(picture->pattern, &o);
    }
    o.spp = picture->spp;
    o.width = picture->width;
    o.height = picture->height;
    o.seed = picture->seed | j->salt << 32;
    return status ? status : koksma_render(j->open, &o, run, image);
}

/* Chooses the size of the images: that of --size, or the scene's, halved until it has at most MOST_PIXELS pixels. */
static void choose_size(const scene_job *j, int *width, int *height)
{
    koksma_render_options o;
    koksma_render_options_init(&o, j->open);
    *width = j->width ? j->width : o.width;
    *height = j->width ? j->height : o.height;
    while (!j->width && (long long)*width * *height > MOST_PIXELS) {
        *width = (*width + 1) / 2;
        *height = (*height + 1) / 2;
    }
}

static koksma_status rank(scene_job *j, const char *const *patterns, size_t n, koksma_rank_row *rows,
                          koksma_ranking *ranking, const char *scene)
{
    koksma_rank_options o = {.scene = scene,
                             .patterns = patterns,
                             .n_patterns = n,
                             .spp = j->spp,
                             .max_trials = (long long)j->max_trials,
                             .one_size = true,
                             .best_only = true,
                             .render = render,
                             .render_context = j,
                             .reference = "jittered"};
    choose_size(j, &o.width, &o.height);
    return koksma_rank_patterns(&o, &j->work.run, rows, ranking);
}

/* ---- Weights ----------------------------------------------------------------------------------------------- */

static double luminance(const koksma_image *image, size_t p)
{
    const float *v = image->pixels + p * (size_t)image->channels;
    return image->channels == 1 ? (double)v[0]
                                : 0.2126 * (double)v[0] + 0.7152 * (double)v[1] + 0.0722 * (double)v[2];
}

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

static koksma_status find_shares(scene_job *j)
{
    koksma_render_options o;
    double *f = NULL, variances[3] = {0}, sum = 0;
    size_t pixels = 0;
    koksma_render_options_init(&o, j->open);
    choose_size(j, &o.width, &o.height);
    o.spp = 1;
    koksma_status status = koksma_pattern_spec("random", &o.pattern);
    for (size_t i = 0; i < SIDE * SIDE && !status; i++) {
        koksma_image image;
        o.patterns[0] =
            (koksma_spec){.pattern = &set_pattern,
                          .params = {-1, ((double)(i % SIDE) + 0.5) / SIDE, ((double)(i / SIDE) + 0.5) / SIDE}};
        o.seed = j->seed * SIDE * SIDE + i;
        status = koksma_render(j->open, &o, &j->work.run, &image);
        if (!status) {
            pixels = (size_t)image.width * (size_t)image.height;
            f = f ? f : malloc(SIDE * SIDE * pixels * sizeof *f);
            for (size_t p = 0; p < pixels && f; p++) {
                f[i * pixels + p] = luminance(&image, p);
            }
            koksma_image_fini(&image);
            status = f ? KOKSMA_OK : KOKSMA_MEMORY;
        }
    }
    for (size_t p = 0; p < pixels && !status; p++) {
        add_pixel(f + p, pixels, variances);
    }
    free(f);
    /* shares below 0.01 become 0.01, because the samples may have missed the variance */
    for (int k = 0; k < 3; k++) {
        sum += fmax(variances[k], 0);
    }
    for (int k = 0; k < 3; k++) {
        j->shares[k] = sum > 0 ? fmax(variances[k] / sum, 0.01) : 1.0 / 3;
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
            factors[k] = pow(4, 2 * points.xs[k] - 1);
        }
        koksma_points_fini(&points);
    }
    return status;
}

static koksma_status make_set(const scene_job *j, size_t c, koksma_points *out)
{
    static const uint64_t projections[] = {1, 2, 3};
    const size_t kind = c % 3;
    double weights[3], factors[3] = {1, 1, 1};
    koksma_spec measure;
    koksma_optimum best = {0};
    koksma_status status = koksma_measure_spec(kernels[kind].measure, &measure);
    if (!status && c >= 3) {
        status = random_factors(j->seed * 1000 + c, factors);
    }
    for (int k = 0; k < 3; k++) {
        weights[k] = factors[k] * j->shares[k] / (k < 2 ? kernels[kind].line : kernels[kind].plane);
    }
    const koksma_optimise_options o = {.n = (size_t)j->spp,
                                       .dim = 2,
                                       .seed = j->seed * 1000 + c,
                                       .steps = 1,
                                       .projections = projections,
                                       .weights = weights,
                                       .n_projections = 3};
    status = status ? status : koksma_optimise(&measure, &o, &j->work.run, &best);
    if (!status) {
        *out = best.points;
        best.points = (koksma_points){0};
    }
    koksma_optimum_fini(&best);
    return status;
}

/* Makes phase p of a set: shifts it by p (1/g, 1/g^2), where g^3 = g + 1 (the R2 sequence of Roberts 2018). */
static koksma_status shift(const koksma_points *from, size_t p, koksma_points *out)
{
    static const double step[] = {0.7548776662466927, 0.5698402909980532};
    const koksma_status status = koksma_points_init(out, from->n, from->dim);
    for (size_t c = 0; c < 2 * from->n && !status; c++) {
        const double x = from->xs[c] + (double)p * step[c % 2], wrapped = x - floor(x);
        out->xs[c] = wrapped < 1 ? wrapped : 0;
    }
    return status;
}

static koksma_status make_candidates(scene_job *j)
{
    koksma_status status = KOKSMA_OK;
    sets = calloc(j->n_sets * j->phases, sizeof *sets);
    if (!sets) {
        return KOKSMA_MEMORY;
    }
    for (size_t c = 0; c < j->n_sets && !status; c++) {
        cli_work_part(&j->work, c, 2 * j->n_sets);
        status = make_set(j, c, &sets[j->n++]);
        for (size_t p = 1; p < j->phases && !status; p++) {
            status = shift(&sets[j->n - p], p, &sets[j->n]);
            j->n += !status;
        }
    }
    return status;
}

/* Ranks the candidates. Counts the eliminated candidates, and chooses the one with the least error. */
static koksma_status choose(scene_job *j)
{
    char *names = calloc(j->n, NAME);
    const char **patterns = calloc(j->n, sizeof *patterns);
    koksma_rank_row *rows = calloc(j->n, sizeof *rows);
    koksma_ranking ranking;
    koksma_status status = names && patterns && rows ? KOKSMA_OK : KOKSMA_MEMORY;
    for (size_t i = 0; i < j->n && !status; i++) {
        snprintf(names + i * NAME, NAME, "set %zu", i);
        patterns[i] = names + i * NAME;
    }
    j->salt = SALT_CHOICE;
    cli_work_part(&j->work, 2, 4);
    status = status ? status : rank(j, patterns, j->n, rows, &ranking, j->scene);
    for (size_t i = 0; i < j->n && !status; i++) {
        j->eliminated += rows[i].decision == KOKSMA_RANK_WORSE;
    }
    if (!status) {
        j->chosen = rows[0].pattern;
        j->settled = ranking.settled;
    }
    free(rows);
    free((void *)patterns);
    free(names);
    return status;
}

/* ---- Evaluation -------------------------------------------------------------------------------------------- */

/* Compares the chosen set with the listed patterns in one scene. In a ranking, 1 + behind is the error of a pattern
   divided by that of row 0. */
static koksma_status judge(scene_job *j, verdict *v)
{
    const char *patterns[MOST_PATTERNS + 1];
    char name[NAME];
    koksma_rank_row rows[MOST_PATTERNS + 1];
    koksma_ranking ranking;
    snprintf(name, sizeof name, "set %zu", j->chosen);
    patterns[0] = name;
    memcpy(patterns + 1, j->patterns, j->n_patterns * sizeof *patterns);
    j->salt = SALT_JUDGE;
    choose_size(j, &v->width, &v->height);
    const koksma_status status = rank(j, patterns, j->n_patterns + 1, rows, &ranking, v->scene);
    size_t own = 0;
    while (!status && rows[own].pattern != 0) {
        own++;
    }
    if (!status) {
        const koksma_rank_row *a = &rows[own], *b = &rows[own == 0];
        v->own = *a;
        v->other = *b;
        v->settled = ranking.settled;
        v->gain = own ? -a->behind : 1 - 1 / (1 + b->behind);
        v->low = own ? -a->behind_high : 1 - 1 / (1 + b->behind_low);
        v->high = own ? -a->behind_low : 1 - (b->behind_high == b->behind_high ? 1 / (1 + b->behind_high) : 0);
    }
    return status;
}

static void put_verdict(const scene_job *j, cli_rows *rows, const verdict *v, double home)
{
    const bool scene = v->own.trials > 0;
    cli_row_text(rows, "scene", v->scene);
    cli_row_text(rows, "role", v->role);
    cli_row_number(rows, "error", scene ? v->own.mean : (double)NAN);
    cli_row_text(rows, "best_listed", scene ? j->patterns[v->other.pattern - 1] : "-");
    cli_row_number(rows, "listed_error", scene ? v->other.mean : (double)NAN);
    cli_row_number(rows, "gain", v->gain);
    cli_row_number(rows, "gain_low", v->low);
    cli_row_number(rows, "gain_high", v->high);
    cli_row_number(rows, "shrinks_by", home - v->gain);
    if (cli_flag(j->arguments, "json")) {
        cli_row_whole(rows, "spp", (uint64_t)j->spp);
        cli_row_whole(rows, "width", (uint64_t)v->width);
        cli_row_whole(rows, "height", (uint64_t)v->height);
        cli_row_whole(rows, "trials", (uint64_t)v->own.trials);
        cli_row_flag(rows, "coherent", v->own.coherence.coherent);
        cli_row_flag(rows, "settled", v->settled);
        cli_row_number(rows, "share_x", j->shares[0]);
        cli_row_number(rows, "share_y", j->shares[1]);
        cli_row_number(rows, "share_xy", j->shares[2]);
        cli_row_whole(rows, "candidates", j->n);
        cli_row_whole(rows, "eliminated", j->eliminated);
        cli_row_text(rows, "measure", kernels[j->chosen / j->phases % 3].measure);
        cli_row_whole(rows, "phase", j->chosen % j->phases);
        cli_row_whole(rows, "seed", j->seed);
        cli_row_text(rows, "version", koksma_version());
    }
    cli_row_end(rows);
}

/* Prints a row for the optimised scene, for each held-out scene, and for the mean over the held-out scenes. *home:
   the gain in the optimised scene. *mean: the mean gain in the held-out scenes. */
static koksma_status judge_all(scene_job *j, cli_rows *rows, double *home, verdict *mean)
{
    *mean = (verdict){.scene = "-", .role = "mean of held-out"};
    for (size_t i = 0; i <= j->n_held_out; i++) {
        verdict v = {.scene = i ? j->held_out[i - 1] : j->scene, .role = i ? "held-out" : "optimised"};
        cli_work_part(&j->work, 3 * (j->n_held_out + 1) + i, 4 * (j->n_held_out + 1));
        if (i) {
            koksma_scene_close(j->open);
            j->open = NULL;
            const koksma_status opened = koksma_scene_open(v.scene, &j->open);
            if (opened) {
                return opened;
            }
        }
        const koksma_status status = judge(j, &v);
        if (status) {
            return status;
        }
        *home = i ? *home : v.gain;
        put_verdict(j, rows, &v, *home);
        mean->gain += i ? v.gain / (double)j->n_held_out : 0;
        mean->low += i ? v.low / (double)j->n_held_out : 0;
        mean->high += i ? v.high / (double)j->n_held_out : 0;
    }
    put_verdict(j, rows, mean, *home);
    return KOKSMA_OK;
}

/* ---- The command ------------------------------------------------------------------------------------------- */

static koksma_status write_set(const scene_job *j)
{
    char comment[KOKSMA_MAX_SPEC + 256];
    snprintf(comment, sizeof comment,
             "optimised for the scene %.400s, %d samples a pixel\nmeasure %s\nphase %zu\nseed %llu\nkoksma %s",
             j->scene, j->spp, kernels[j->chosen / j->phases % 3].measure, (size_t)(j->chosen % j->phases),
             (unsigned long long)j->seed, koksma_version());
    return koksma_points_write(cli_text(j->arguments, "output", NULL), &sets[j->chosen], comment, NULL);
}

static bool parse_lists(scene_job *j)
{
    const char *patterns = cli_text(j->arguments, "against", listed);
    const char *held_out = cli_text(j->arguments, "held-out", NULL);
    while (j->n_patterns < MOST_PATTERNS && cli_pattern_item(patterns, j->n_patterns, j->names[j->n_patterns])) {
        koksma_render_options o = {0};
        if (koksma_render_patterns(j->names[j->n_patterns], &o)) {
            cli_usage_error(j->arguments, "%s", koksma_error_text());
            return false;
        }
        j->patterns[j->n_patterns] = j->names[j->n_patterns];
        j->n_patterns++;
    }
    for (size_t i = 0; j->n_held_out < (held_out ? MOST_SCENES : 6) &&
                       cli_list_item(held_out ? held_out : scenes, i, j->held_out[j->n_held_out], KOKSMA_MAX_SPEC);
         i++) {
        if (!strcmp(j->held_out[j->n_held_out], j->scene)) {
            if (held_out) {
                cli_usage_error(j->arguments, "--held-out: '%s' is the scene that the set is optimised for",
                                j->scene);
                return false;
            }
            continue;
        }
        j->n_held_out++;
    }
    return true;
}

static bool parse(scene_job *j)
{
    static const char *const unused[] = {"dim", "from", "keep", "projections", "weights", "steps", "time-limit"};
    const cli_arguments *arguments = j->arguments;
    uint64_t spp;
    for (size_t i = 0; i < sizeof unused / sizeof *unused; i++) {
        if (cli_text(arguments, unused[i], NULL)) {
            cli_usage_error(arguments, "--%s has no effect with --scene", unused[i]);
            return false;
        }
    }
    if (arguments->n_operands) {
        cli_usage_error(arguments, "'%s': with --scene it takes no measure", arguments->operands[0]);
        return false;
    }
    if (!cli_text(arguments, "n", NULL) || !cli_text(arguments, "output", NULL)) {
        cli_usage_error(arguments, "%s, is missing",
                        cli_text(arguments, "n", NULL) ? "-o FILE, the file for the set"
                                                       : "-n SPP, the samples per pixel");
        return false;
    }
    if (!cli_whole(arguments, "n", 0, 1, 4096, &spp) || !cli_whole(arguments, "seed", 0, 0, UINT32_MAX, &j->seed) ||
        !cli_whole(arguments, "candidates", 8, 1, 1000, &j->n_sets) ||
        !cli_whole(arguments, "phases", 4, 1, 1000, &j->phases) ||
        !cli_whole(arguments, "max-trials", 32, 8, KOKSMA_MAX_RANK_TRIALS, &j->max_trials) ||
        !cli_size(arguments, &j->width, &j->height) || !parse_lists(j)) {
        return false;
    }
    j->spp = (int)spp;
    return cli_work_begin(arguments, "optimising for a scene", &j->work);
}

static int report(scene_job *j, koksma_status *status)
{
    cli_rows *rows = cli_rows_open(cli_flag(j->arguments, "json"));
    verdict mean;
    double home = 0;
    *status = judge_all(j, rows, &home, &mean);
    cli_work_end();
    if (!*status && j->n_held_out && !cli_flag(j->arguments, "quiet")) {
        cli_say("optimise",
                "%zu of %zu candidates eliminated; gain over the best listed pattern: %.1f %% in %s, %.1f %% on "
                "average in %zu held-out scenes, which is %.1f percentage points less",
                j->eliminated, j->n, 100 * home, j->scene, 100 * mean.gain, j->n_held_out, 100 * (home - mean.gain));
    }
    const int code = cli_rows_close(rows);
    return code ? code : (j->n_held_out ? mean.gain : home) > 0 ? CLI_YES : CLI_NO;
}

int cli_optimise_scene(const cli_arguments *arguments)
{
    scene_job *j = calloc(1, sizeof *j);
    if (!j) {
        return cli_no_memory();
    }
    j->arguments = arguments;
    j->scene = cli_text(arguments, "scene", NULL);
    if (!parse(j)) {
        free(j);
        return CLI_USAGE;
    }
    int code = CLI_YES;
    koksma_status status = koksma_scene_open(j->scene, &j->open);
    status = status ? status : find_shares(j);
    status = status ? status : make_candidates(j);
    /* writes the first candidate, in case of an interruption before one is chosen */
    status = status ? status : write_set(j);
    status = status ? status : choose(j);
    status = status ? status : write_set(j);
    code = status ? code : report(j, &status);
    cli_work_end();
    code = status == KOKSMA_MEMORY ? cli_no_memory() : status ? cli_fail(arguments, status) : code;
    koksma_scene_close(j->open);
    for (size_t i = 0; i < j->n; i++) {
        koksma_points_fini(&sets[i]);
    }
    free(sets);
    free(j);
    return code;
}
