/* SPDX-License-Identifier: Apache-2.0 */
/* What a ranking begins with (ranking_setup.h): its options are checked, the scene is opened, and the size of the images is
   chosen. */
#include "study/ranking/ranking_setup.h"

#include <stdio.h>
#include <string.h>

#include "core/hash.h"
#include "core/status.h"
#include "image/image.h"
#include "study/ranking/ranking_contest.h"

enum { MOST_PIXELS = 160 * 120, MOST_IN_MEDIUM = 80 * 60 };

/* Chooses the size of the pictures that this library renders: by default, the scene's size, halved until the picture
   has at most MOST_PIXELS pixels, or in a medium, whose pixels take several times as long, MOST_IN_MEDIUM. */
static void choose_size(const koksma_rank_options *options, koksma__study_scene *scene)
{
    koksma_render_options defaults;
    koksma_render_options_init(&defaults, scene->scene);
    const int most = koksma_scene_count(scene->scene).media ? MOST_IN_MEDIUM : MOST_PIXELS;
    scene->width = options->width ? options->width : defaults.width;
    scene->height = options->width ? options->height : defaults.height;
    while (!options->width && (long long)scene->width * scene->height > most) {
        scene->width = (scene->width + 1) / 2;
        scene->height = (scene->height + 1) / 2;
    }
}

/* Finds the size of another renderer's pictures: that of the options, or the size of a picture rendered for this
   purpose, by the first pattern that can render it. It has 1 sample per pixel, or if no pattern has 1, spp. */
static koksma_status ask_size(const koksma_rank_options *options, koksma__run_control *control,
                              koksma__study_scene *scene)
{
    const size_t n = options->n_patterns, tries = options->spp > 1 ? 2 * n : n;
    koksma_status status = KOKSMA_ARGUMENT;
    scene->width = options->width;
    scene->height = options->height;
    if (options->width) {
        return KOKSMA_OK;
    }
    for (size_t i = 0; i < tries && koksma__rank_leaves_out(status); i++) {
        const koksma__picture picture = {.pattern = options->patterns[i % n], .spp = i < n ? 1 : options->spp};
        koksma_image image;
        status = koksma__study_render(scene, &picture, &control->run, &image);
        if (!status) {
            scene->width = image.width;
            scene->height = image.height;
            koksma_image_fini(&image);
        }
    }
    return status == KOKSMA_INTERRUPTED && koksma__run_control_time_is_up(control)
               ? koksma__fail(KOKSMA_ARGUMENT, "the picture that shows the size takes longer than the time limit")
               : status;
}

/* The seeds of all images depend on the scene's hash, which the ranking's seed changes. */
static void set_hash(koksma__study_scene *scene, uint64_t hash, uint64_t seed)
{
    snprintf(scene->hash, sizeof scene->hash, "%016llx", (unsigned long long)hash);
    if (seed) {
        const uint64_t other = koksma__job_seed("rank|%s|%llu", scene->hash, (unsigned long long)seed);
        snprintf(scene->hash, sizeof scene->hash, "%016llx", (unsigned long long)other);
    }
}

static koksma_status open_scene(const koksma_rank_options *options, koksma__run_control *control,
                                koksma__study_scene *scene)
{
    if (options->render) {
        const uint64_t hash = koksma__hash(scene->name, strlen(scene->name));
        set_hash(scene, hash, options->seed);
        return ask_size(options, control, scene);
    }
    KOKSMA__TRY(koksma_scene_open(options->scene, &scene->scene));
    set_hash(scene, koksma_scene_hash(scene->scene), options->seed);
    choose_size(options, scene);
    return KOKSMA_OK;
}

/* The patterns of a method that places its own samples would all be the same. */
static koksma_status check_adaptive(const koksma_rank_options *options)
{
    koksma_adaptive_options adaptive;
    KOKSMA__FAIL_IF(options->render, KOKSMA_ARGUMENT, "adaptive: another renderer has its own adaptive sampling");
    KOKSMA__TRY(koksma_adaptive_parse(options->adaptive, &adaptive));
    KOKSMA__FAIL_IF(adaptive.method->own_samples && options->n_patterns > 1, KOKSMA_ARGUMENT,
                    "adaptive: %s places its own samples, whatever the pattern is: rank one pattern, or choose a "
                    "method that uses patterns, such as contrast",
                    adaptive.method->name);
    return KOKSMA_OK;
}

static koksma_status check(const koksma_rank_options *options)
{
    koksma_status status =
        koksma__array_check("options->patterns", options->patterns, options->n_patterns, sizeof(koksma_rank_row));
    for (size_t i = 0; i < options->n_patterns && !status; i++) {
        status =
            options->patterns[i] ? KOKSMA_OK : koksma__fail(KOKSMA_ARGUMENT, "options->patterns[%zu] is NULL", i);
    }
    KOKSMA__FAIL_IF(!status && !options->n_patterns, KOKSMA_ARGUMENT,
                    "n_patterns = 0: a ranking needs at least one pattern");
    KOKSMA__FAIL_IF(!status && (options->spp < 1 || options->spp > KOKSMA_MAX_SPP), KOKSMA_ARGUMENT,
                    "spp = %d: the samples per pixel must be 1 to %d", options->spp, KOKSMA_MAX_SPP);
    if (!status && options->width) {
        status = koksma__image_check_shape(options->width, options->height, 1);
    }
    if (!status && options->metric) {
        status = koksma__metric_spec_check(options->metric);
    }
    status = status || !options->adaptive ? status : check_adaptive(options);
    KOKSMA__FAIL_IF(!status && !(options->time_limit_s >= 0), KOKSMA_ARGUMENT,
                    "time_limit_s = %g: it must be 0 (no limit) or a number of seconds", options->time_limit_s);
    KOKSMA__FAIL_IF(
        !status && options->max_trials &&
            (options->max_trials < KOKSMA__RANK_FIRST_ROUND || options->max_trials > KOKSMA_MAX_RANK_TRIALS),
        KOKSMA_ARGUMENT, "max_trials = %lld: it must be 0 (the default) or %d to %d trials", options->max_trials,
        KOKSMA__RANK_FIRST_ROUND, KOKSMA_MAX_RANK_TRIALS);
    return status;
}

/* Writes the canonical text of the settings of all images. scene: NULL for another renderer. */
static koksma_status write_variant(const koksma_rank_options *options, const koksma_scene *scene,
                                   char out[KOKSMA__VARIANT_TEXT])
{
    char text[KOKSMA__VARIANT_TEXT];
    const char *more = options->variant ? options->variant : "";
    koksma_render_options defaults = {.integrator = options->integrator};
    if (scene && !options->integrator) {
        koksma_render_options_init(&defaults, scene);
    }
    KOKSMA__TRY(koksma__variant_check_names(more));
    const int length = snprintf(text, sizeof text, "integrator=%s;filter=%s;adaptive=%s;%s",
                                defaults.integrator ? defaults.integrator->name : "distribution",
                                options->filter ? options->filter->name : "box",
                                options->adaptive ? options->adaptive : "none", more);
    KOKSMA__FAIL_IF(length >= (int)sizeof text, KOKSMA_ARGUMENT, "options->variant: longer than %zu characters",
                    sizeof text / 2);
    return koksma__variant_canonical(text, out);
}

koksma_status koksma__rank_open(const koksma_rank_options *options, koksma__run_control *control,
                                koksma__study_scene *scene, char variant[KOKSMA__VARIANT_TEXT])
{
    *scene = (koksma__study_scene){
        .name = options->scene, .render = options->render, .render_context = options->render_context};
    KOKSMA__TRY(check(options));
    KOKSMA__TRY(open_scene(options, control, scene));
    return write_variant(options, scene->scene, variant);
}
