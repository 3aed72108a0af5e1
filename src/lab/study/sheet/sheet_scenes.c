/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Errors of the samplers in scenes, computed by koksma_rank_patterns without a time limit and for one image size, so
 * that the numbers do not depend on the speed of the machine.
 */
#include "study/sheet/sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

/* The maximum number of samples of an image, over all its pixels: 64 samples in each of 160 x 120 pixels. */
enum { MOST_SAMPLES = 64 * 160 * 120 };

/* Chooses the size of a scene's images, the same for all numbers of samples per pixel: 0 x 0, which means the
   size that koksma rank uses, or, above 64 samples per pixel, the scene's size halved until an image has at most
   MOST_SAMPLES. */
static koksma_status choose_size(const koksma__sheet *sheet, const char *name, int *width, int *height)
{
    koksma_scene *scene;
    int spp = 0;
    for (size_t i = 0; i < sheet->n_spp; i++) {
        spp = sheet->spp[i] > spp ? sheet->spp[i] : spp;
    }
    koksma_render_options defaults;
    *width = *height = 0;
    KOKSMA__TRY(koksma_scene_open(name, &scene));
    koksma_render_options_init(&defaults, scene);
    for (int w = defaults.width, h = defaults.height; spp > 64 && w > 1 && h > 1 && !*width;
         w = (w + 1) / 2, h = (h + 1) / 2) {
        if ((long long)spp * w * h <= MOST_SAMPLES) {
            *width = w;
            *height = h;
        }
    }
    koksma_scene_close(scene);
    return KOKSMA_OK;
}

koksma_status koksma__sheet_rank(koksma__sheet *sheet, koksma__document *d)
{
    (void)d;
    const char *patterns[KOKSMA__SHEET_SAMPLERS];
    const size_t n = sheet->n_scenes * sheet->n_spp;
    koksma_status status = KOKSMA_OK;
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        patterns[s] = sheet->samplers[s]->text;
    }
    sheet->rankings = calloc(n + 1, sizeof *sheet->rankings);
    KOKSMA__REQUIRE_MEMORY(sheet->rankings, n * sizeof *sheet->rankings);
    for (size_t i = 0; i < n && !status; i++) {
        koksma__sheet_ranking *r = &sheet->rankings[i];
        const koksma_run run = koksma__sheet_part(sheet, 0.4 / (double)n, 0.06);
        r->scene = sheet->scenes[i / sheet->n_spp];
        r->spp = sheet->spp[i % sheet->n_spp];
        koksma_rank_options options = {.scene = r->scene,
                                       .patterns = patterns,
                                       .n_patterns = sheet->n_samplers,
                                       .spp = r->spp,
                                       .metric = &sheet->metric,
                                       .max_trials = (long long)sheet->max_trials,
                                       .one_size = true};
        status = choose_size(sheet, r->scene, &options.width, &options.height);
        status = status ? status : koksma_rank_patterns(&options, &run, r->rows, &r->ranking);
    }
    return status;
}

/* The ranking, and a row of it, of a scene: number k of its n_spp x n_samplers rows. */
typedef struct ranked {
    const koksma__sheet_ranking *of;
    const koksma_rank_row *row;
    const char *sampler;
} ranked;

static ranked row_of(const koksma__sheet *sheet, size_t scene, size_t k)
{
    const koksma__sheet_ranking *r = &sheet->rankings[scene * sheet->n_spp + k / sheet->n_samplers];
    const koksma_rank_row *row = &r->rows[k % sheet->n_samplers];
    return (ranked){r, row, sheet->samplers[row->pattern]->text};
}

static void put_table(const koksma__sheet *sheet, size_t scene, koksma__document *d)
{
    static const char *const decisions[] = {"undecided", "best", "equal to the first", "worse than the first"};
    koksma__doc_table(d, "scene-%s", sheet->scenes[scene]);
    koksma__doc_columns(d,
                        "n9m samples a pixel#samples;t sampler;i4 error;i2f behind the first#behind;t "
                        "coherent#bands;n3h position;n3h coherence;th decision;n9h images;n4h robust;n3h top share");
    for (size_t k = 0; k < sheet->n_spp * sheet->n_samplers; k++) {
        const ranked at = row_of(sheet, scene, k);
        const koksma_rank_row *row = at.row;
        koksma__doc_row(d, "ntiitnntnnn", (double)at.of->spp, at.sampler,
                        (koksma__estimate){row->mean, row->low, row->high},
                        (koksma__estimate){row->behind, row->behind_low, row->behind_high},
                        !row->coherence.images    ? "–"
                        : row->coherence.coherent ? "yes"
                                                  : "no",
                        row->position ? (double)row->position : (double)NAN,
                        row->coherence.images ? row->coherence.coherence : (double)NAN,
                        row->state == KOKSMA_RANK_RANKED ? decisions[row->decision] : "not ranked",
                        (double)row->trials, row->robust, row->top_share);
    }
}

static void warn_of_few_pixels(const koksma__sheet *sheet, size_t scene, koksma__document *d)
{
    ranked worst = {0};
    size_t few = 0, all = 0;
    for (size_t k = 0; k < sheet->n_spp * sheet->n_samplers; k++) {
        const ranked at = row_of(sheet, scene, k);
        all += at.row->state == KOKSMA_RANK_RANKED;
        few += at.row->top_share >= KOKSMA_FEW_PIXELS;
        if (at.row->top_share >= KOKSMA_FEW_PIXELS && (!worst.row || at.row->top_share > worst.row->top_share)) {
            worst = at;
        }
    }
    if (worst.row) {
        koksma__doc_warning(
            d,
            "Warning: 0.1 %% of the pixels carry most of the error in %zu of %zu rows, and decide the order there. "
            "They carry most with %d samples of %s: %.0f %% of the error; without them `%s` is %.4g instead of %.4g. "
            "A metric that weighs them less, such as `smape`, may give another order.",
            few, all, worst.of->spp, worst.sampler, 100 * worst.row->top_share, sheet->metric_text, worst.row->robust,
            worst.row->mean);
    }
}

static void put_chart(const koksma__sheet *sheet, size_t scene, koksma__document *d)
{
    char title[128];
    snprintf(title, sizeof title, "Error in %s", sheet->scenes[scene]);
    koksma__doc_chart(d, &(koksma__chart){title, "samples a pixel", sheet->metric.metric->title, true, true, -1});
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma__doc_series(d, sheet->samplers[s]->text, NULL, KOKSMA__SERIES_LINE);
        for (size_t k = 0; k < sheet->n_spp * sheet->n_samplers; k++) {
            const ranked at = row_of(sheet, scene, k);
            if (at.row->pattern == s && at.row->state == KOKSMA_RANK_RANKED) {
                koksma__doc_point(d, at.of->spp, at.row->mean, at.row->low, at.row->high);
            }
        }
    }
}

/* Writes the command that gives a scene's numbers. No list of patterns can have a path with a comma. */
static void put_command(const koksma__sheet *sheet, size_t scene, koksma__document *d)
{
    const koksma_ranking *ranking = &sheet->rankings[scene * sheet->n_spp].ranking;
    char patterns[KOKSMA__DOC_COMMAND] = "", word[KOKSMA__DOC_COMMAND], name[KOKSMA__DOC_COMMAND], spp[64] = "";
    for (size_t s = 0; s < sheet->n_samplers; s++) {
        koksma__text_join(patterns, sizeof patterns, ",", sheet->samplers[s]->text);
        if (strchr(sheet->samplers[s]->spec.path, ',')) {
            koksma__doc_paragraph(d,
                                  "No command is given for these numbers: `koksma rank` takes patterns with commas "
                                  "between them, and the name of %s has one.",
                                  sheet->samplers[s]->text);
            return;
        }
    }
    for (size_t k = 0; k < sheet->n_spp; k++) {
        snprintf(word, sizeof word, "%d", sheet->spp[k]);
        koksma__text_join(spp, sizeof spp, ",", word);
    }
    koksma__sheet_word(patterns, word, sizeof word);
    koksma__sheet_word(sheet->scenes[scene], name, sizeof name);
    koksma__doc_commands(d);
    koksma__doc_command(
        d, "koksma rank %s --spp %s --size %dx%d -p %s%s%s --max-trials %zu --one-size --time-limit 1000000000", name,
        spp, ranking->width, ranking->height, word, strcmp(sheet->metric_text, "mae") ? " --metric " : "",
        strcmp(sheet->metric_text, "mae") ? sheet->metric_text : "", sheet->max_trials);
}

koksma_status koksma__sheet_put_rankings(koksma__sheet *sheet, koksma__document *d)
{
    if (!sheet->n_scenes) {
        return KOKSMA_OK;
    }
    koksma__doc_section(d, "scenes", "Errors in scenes");
    if (!sheet->n_spp) {
        koksma__doc_paragraph(d, "No scene was rendered: a pixel needs a set with one point for each of its samples, "
                                 "and the sampler has no set of 4, 16, 64 or any other number of up to 256 points.");
    } else {
        koksma__doc_paragraph(
            d,
            "Error of an image: %s (%s). Samplers are used as in a renderer: one set for each pixel and each use "
            "(lens, light, ...). Behind: the relative difference of the error to that of the first row with as many "
            "samples. Bands: the error has a pattern, which eyes notice more than noise. Intervals and decisions of "
            "a scene hold together with 95 %%; the data have coherence and decisions.",
            sheet->metric_text, sheet->metric.metric->title);
    }
    if (sheet->samplers[0]->sets != SIZE_MAX && sheet->n_spp) {
        koksma__doc_paragraph(
            d,
            "Each pixel and use takes one of the sampler's files of the needed size at random. The sampler has at "
            "least %zu files of each size; if these are few, they repeat over the image and give bands.",
            sheet->samplers[0]->sets);
    }
    for (size_t i = 0; i < sheet->n_scenes && sheet->n_spp; i++) {
        koksma__doc_section(d, NULL, "%s", sheet->scenes[i]);
        if (sheet->n_spp > 1) {
            put_chart(sheet, i, d);
        }
        put_table(sheet, i, d);
        warn_of_few_pixels(sheet, i, d);
        for (size_t k = 0; k < sheet->n_spp * sheet->n_samplers; k++) {
            const ranked at = row_of(sheet, i, k);
            if (at.row->state != KOKSMA_RANK_RANKED) {
                koksma__doc_paragraph(d, "%s at %d samples: %s", at.sampler, at.of->spp, at.row->reason);
            }
        }
        put_command(sheet, i, d);
        koksma__doc_end(d);
    }
    koksma__doc_end(d);
    return KOKSMA_OK;
}
