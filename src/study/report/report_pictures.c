/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures: of every scene of the image blocks the first trial of each pattern, beside the reference, with maps of
 * the error and its spectrum. They are shown as they are for readers and printers, and as floats for the comparer
 * (report.js). The picture is the one whose error stands in the store: it is made again from its key.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/report/answers.h"
#include "study/report/error_spectrum.h"
#include "study/report/report.h"
#include "study/report/report_chart.h"
#include "study/report/report_script.h"
#include "study/report/report_table.h"
#include "study/run/references.h"
#include "study/run/tasks.h"

/* What the floats of one file may take before their base64, and how much brighter an error is shown. */
enum { MOST_BYTES = 24 << 20, GAIN = 8, MAX_SHOWN = 24 };

/* Trials whose errors' spectra are averaged, for their rings and for the coherence. */
enum { SPECTRUM_TRIALS = 8 };

typedef struct budget {
    size_t used, left_out; /* left_out: scenes that would take too much */
    bool shown;
} budget;

static koksma_status add_thumbnail(koksma__html *h, const koksma_image *image, const koksma_image *reference,
                                   const char *name, const char *scene)
{
    char alt[512];
    koksma_image map = {0};
    const int scale = image->width <= 96 ? 2 : 1;
    koksma__html_add(h, "<figure>");
    snprintf(alt, sizeof alt, "%.150s, %.250s", scene, name);
    koksma_status status = koksma__html_image(h, image, scale, alt);
    if (!status && reference) {
        status = koksma_image_difference(image, reference, &map);
        for (size_t i = 0; !status && i < (size_t)map.width * (size_t)map.height; i++) {
            map.pixels[i] *= (float)GAIN;
        }
        snprintf(alt, sizeof alt, "absolute error of %.150s, %.250s, %d times as bright", scene, name, GAIN);
        status = status ? status : koksma__html_image(h, &map, scale, alt);
        koksma_image_fini(&map);
    }
    koksma__html_add(h, "<figcaption>");
    koksma__html_text(h, name);
    koksma__html_add(h, "</figcaption></figure>\n");
    return status;
}

static void add_floats(koksma__html *h, const koksma_image *image, const char *name, bool first)
{
    const size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    koksma__html_add(h, "%s<template data-name=\"", first ? "" : "\n");
    koksma__html_text(h, name);
    koksma__html_add(h, "\" data-channels=\"%d\">", image->channels);
    koksma__html_base64(h, (const unsigned char *)image->pixels, count * sizeof *image->pixels);
    koksma__html_add(h, "</template>");
}

/* The picture of a trial of a task. */
static koksma_status render(const koksma__task *t, long long trial, const koksma_run *run, koksma_image *out)
{
    const koksma__picture picture = {.pattern = t->pattern,
                                     .variant = t->variant,
                                     .spp = t->n,
                                     .width = t->width,
                                     .height = t->height,
                                     .seed = koksma__task_seed(t, trial)};
    return koksma__study_render(t->scene, &picture, run, out);
}

/* The mean spectrum of the first trials' errors, and its peak. */
static koksma_status find_spectrum(const koksma__task *t, const koksma_image *reference, const koksma_run *run,
                                   koksma__chart_series *to, koksma_coherence_values *values)
{
    koksma__error_spectrum spectrum = {0};
    koksma_coherence coherence;
    koksma_status status = koksma_coherence_init(&coherence, reference->width, reference->height);
    for (long long trial = 0; !status && trial < t->trials && trial < SPECTRUM_TRIALS; trial++) {
        koksma_image image;
        status = render(t, trial, run, &image);
        if (!status) {
            status = koksma__spectrum_add(&spectrum, &image, reference);
            status = status ? status : koksma_coherence_add(&coherence, &image, reference);
            koksma_image_fini(&image);
        }
    }
    koksma_coherence_find(&coherence, values);
    koksma_coherence_fini(&coherence);
    *to = (koksma__chart_series){.line = true, .n = spectrum.n};
    snprintf(to->label, sizeof to->label, "%s", t->pattern);
    for (size_t r = 0; r < spectrum.n; r++) {
        to->x[r] = ((double)r + 0.5) / (2 * (double)spectrum.n);
        to->y[r] = to->low[r] = to->high[r] = spectrum.power[r];
    }
    return status;
}

/* A row for each of the block's first n patterns. */
static void add_coherence(koksma__html *h, const koksma__task *first, const koksma_coherence_values *values, size_t n)
{
    koksma__grid grid;
    char name[sizeof grid.name];
    snprintf(name, sizeof name, "coherence-%.30s-%lld", first->scene->name, first->n);
    koksma__html_add(
        h, "<p>Coherence of the error: the peak of its power spectrum over the mean power, from the same "
           "trials. 95 %% of white-noise errors, with as large a part in common among the trials, have one "
           "in the interval beside it. Above what 99.5 %% of them have, the error is coherent: it has bands "
           "or another pattern, which are seen sooner than noise of the same size.</p>\n");
    koksma__grid_open(&grid, h, name);
    koksma__grid_head(&grid, "pattern");
    koksma__grid_head_interval(&grid, "coherence");
    koksma__grid_head(&grid, "noise from");
    koksma__grid_head(&grid, "to");
    koksma__grid_head(&grid, "in common");
    koksma__grid_head(&grid, "cycles a pixel");
    koksma__grid_head(&grid, "error");
    for (size_t p = 0; p < n; p++) {
        const koksma_coherence_values *v = &values[p];
        koksma__grid_row(&grid);
        koksma__grid_text(&grid, first->image->patterns.at[p]);
        koksma__grid_interval(&grid, (koksma__estimate){v->coherence, v->low, v->high}, 3);
        koksma__grid_number(&grid, v->noise_low, 3);
        koksma__grid_number(&grid, v->noise_high, 3);
        koksma__grid_number(&grid, v->common, 2);
        koksma__grid_number(&grid, hypot(v->frequency_x, v->frequency_y), 2);
        koksma__grid_text(&grid, v->images == 0 ? "none" : v->coherent ? "coherent" : "noise");
    }
    koksma__grid_close(&grid);
}

static koksma_status add_spectra(koksma__html *h, const koksma__task *first, const koksma_image *reference,
                                 const koksma_run *run)
{
    const koksma__texts *patterns = &first->image->patterns;
    const size_t n = patterns->n < MAX_SHOWN ? patterns->n : MAX_SHOWN;
    koksma__chart_series *series = calloc(KOKSMA__CHART_SERIES, sizeof *series);
    koksma_coherence_values values[MAX_SHOWN];
    koksma_status status = series ? KOKSMA_OK : koksma__fail_memory(KOKSMA__CHART_SERIES * sizeof *series);
    for (size_t p = 0; !status && p < n; p++) {
        koksma__task task = *first;
        task.pattern = patterns->at[p];
        status = find_spectrum(&task, reference, run, &series[p], &values[p]);
    }
    if (!status) {
        char title[512];
        char name[256];
        koksma__case_name(first->scene->name, first->variant, name, sizeof name);
        snprintf(title, sizeof title,
                 "Spectrum of the image error: %.200s, %lld samples a pixel, mean over rings and %d trials", name,
                 first->n, first->trials < SPECTRUM_TRIALS ? (int)first->trials : SPECTRUM_TRIALS);
        const koksma__chart chart = {title, "cycles a pixel", "power", false, true, n, series, patterns->n - n};
        koksma__html_chart(h, &chart);
        add_coherence(h, first, values, n);
    }
    free(series);
    return status;
}

/* Whether the first trials of the task with each of `n` patterns are in the store: a report renders nothing again
   that the study has not come to, since nobody knows how long that would take. */
static koksma_status are_done(koksma_study *study, const koksma__task *first, size_t n, long long trials, bool *done)
{
    koksma_status status = KOKSMA_OK;
    *done = true;
    for (size_t p = 0; !status && *done && p < n; p++) {
        koksma__task task = *first;
        char name[KOKSMA__REFERENCE_NAME];
        koksma__result *results = NULL;
        long long id;
        size_t found = 0;
        task.pattern = first->image->patterns.at[p];
        const koksma__series series = koksma__task_series(&task, task.n_series - 1, name);
        status = koksma__store_series(study->store, &series, false, &id);
        status = status ? status : koksma__store_results(study->store, id, trials, &results, &found);
        free(results);
        *done = (long long)found == trials;
    }
    return status;
}

static koksma_status add_scene(koksma_study *study, koksma__html *h, const koksma__task *first, budget *b,
                               const koksma_run *run)
{
    const koksma__image_block *block = first->image;
    const size_t shown = block->patterns.n < MAX_SHOWN ? block->patterns.n : MAX_SHOWN;
    const size_t pixels = (size_t)first->width * (size_t)first->height;
    koksma__reference_image *reference = &study->references[first->references[first->n_series - 1]];
    bool done = koksma__reference_exists(study, reference);
    koksma_status status = done ? are_done(study, first, shown, 1, &done) : KOKSMA_OK;
    if (status || !done) {
        return status;
    }
    if (b->used + 4 * pixels * (shown + 1) > MOST_BYTES) {
        b->left_out++;
        return KOKSMA_OK;
    }
    status = koksma__reference_read(study, reference);
    koksma__html floats = {0};
    if (!b->shown) {
        koksma__html_add(
            h,
            "<h2 id=\"pictures\">Pictures</h2>\n<p>The first trial of every pattern, its absolute error in "
            "luminance %d times as bright, and the reference.</p>\n",
            GAIN);
        b->shown = true;
    }
    char name[512];
    koksma__case_name(first->scene->name, first->variant, name, sizeof name);
    koksma__html_add(h, "<h3>");
    koksma__html_text(h, name);
    koksma__html_add(h, ", %lld samples a pixel, %d x %d pixels</h3>\n<div class=\"figures\">\n", first->n,
                     first->width, first->height);
    if (!status) {
        status = add_thumbnail(h, &reference->image, NULL, "reference", first->scene->name);
        add_floats(&floats, &reference->image, "reference", true);
    }
    for (size_t p = 0; !status && p < shown; p++) {
        koksma__task task = *first;
        koksma_image image;
        task.pattern = block->patterns.at[p];
        status = render(&task, 0, run, &image);
        if (!status) {
            status = add_thumbnail(h, &image, &reference->image, task.pattern, task.scene->name);
            add_floats(&floats, &image, task.pattern, false);
            b->used += 4 * pixels * (size_t)image.channels;
            koksma_image_fini(&image);
        }
    }
    koksma__html_add(h, "</div>\n");
    if (shown < block->patterns.n) {
        koksma__html_add(h, "<p>%zu more patterns are not shown.</p>\n", block->patterns.n - shown);
    }
    koksma__html_add(h, "<div class=\"comparer\" data-width=\"%d\" data-height=\"%d\" data-name=\"", first->width,
                     first->height);
    koksma__html_text(h, first->scene->name);
    koksma__html_add(h, "\">%s</div>\n", floats.text ? floats.text : "");
    h->failed |= floats.failed;
    free(floats.text);
    const long long trials = first->trials < SPECTRUM_TRIALS ? first->trials : SPECTRUM_TRIALS;
    status = status ? status : are_done(study, first, shown, trials, &done);
    return status || !done ? status : add_spectra(h, first, &reference->image, run);
}

koksma_status koksma__report_pictures(koksma_study *study, koksma__html *h, const koksma_run *run)
{
    koksma__tasks tasks;
    budget b = {0};
    koksma_status status = koksma__tasks_open(study, true, &tasks);
    for (size_t i = 0; !status && i < tasks.n; i++) {
        const koksma__task *t = &tasks.at[i];
        const koksma__image_block *block = t->image;
        if (t->pattern == block->patterns.at[0] && t->variant == block->variants.at[0] &&
            t->n == block->spp.at[block->spp.n / 2]) {
            status = add_scene(study, h, t, &b, run);
        }
    }
    if (!status && b.left_out) {
        koksma__html_add(h, "<p>The pictures of %zu scenes are left out: this file would be too large.</p>\n",
                         b.left_out);
    }
    if (!status && b.shown) {
        koksma__html_add(h, "<script>\n%s</script>\n", koksma__report_js);
    }
    koksma__tasks_close(&tasks);
    return status;
}
