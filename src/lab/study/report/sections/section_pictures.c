/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The pictures of a report: for every scene of the image blocks, the reference and the first trial of each pattern,
 * from which the page makes maps of the error and compares any two pictures; then the spectrum of the error and its
 * coherence, averaged over some trials. The store has no pictures: each is rendered again from the key of its row.
 * Only trials that have a row are rendered, because the time that other trials would take is unknown.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/report/error_spectrum.h"
#include "study/report/mean_coherence.h"
#include "study/report/means.h"
#include "study/report/report.h"
#include "study/run/references.h"
#include "study/run/tasks.h"

/* The largest size in bytes of all floats in a report, before base64, and the largest number of patterns that are
   shown for a scene. */
enum { MOST_BYTES = 24 << 20, MAX_SHOWN = 24 };

static bool is_shown(const koksma__report_scope *scope)
{
    return scope->study->plan.n_images > 0;
}

/* Whether pattern p of a block can make the block's middle number of samples, with which the pictures are rendered. */
static bool is_served(const koksma__image_block *block, size_t p)
{
    return !koksma__is_left_out(&block->left_out, p, block->spp.n, block->spp.n / 2);
}

/* The first pattern of a block that can make the block's middle number of samples. */
static size_t first_served(const koksma__image_block *block)
{
    size_t p = 0;
    while (p + 1 < block->patterns.n && !is_served(block, p)) {
        p++;
    }
    return p;
}

/* ---- Spectra of the error ---------------------------------------------------------------------------------- */

/* Adds the mean spectrum of the errors of a task's first trials as a series, and computes their coherence. */
static koksma_status add_spectrum(koksma__document *d, const koksma__task *t, const koksma_image *reference,
                                  const koksma_run *run, koksma_coherence_values *values)
{
    koksma__error_spectrum spectrum = {0};
    koksma_coherence coherence;
    koksma_status status = koksma_coherence_init(&coherence, reference->width, reference->height);
    for (long long trial = 0; !status && trial < t->trials && trial < KOKSMA__SPECTRUM_TRIALS; trial++) {
        koksma_image image;
        status = koksma__task_picture(t, trial, run, &image);
        if (!status) {
            status = koksma__spectrum_add(&spectrum, &image, reference);
            status = status ? status : koksma_coherence_add(&coherence, &image, reference);
            koksma_image_fini(&image);
        }
    }
    koksma_coherence_find(&coherence, values);
    koksma_coherence_fini(&coherence);
    koksma__doc_series_begin(d, t->pattern, KOKSMA__SERIES_LINE);
    for (size_t r = 0; r < spectrum.n; r++) {
        koksma__doc_point(d, ((double)r + 0.5) / (2 * (double)spectrum.n), spectrum.power[r], NAN, NAN);
    }
    koksma__doc_end(d);
    return status;
}

/* Adds the table of coherences, with a row for each of the block's first n patterns. */
static void add_coherence(koksma__document *d, const koksma__task *first, const koksma_coherence_values *values,
                          size_t n)
{
    char name[64];
    snprintf(name, sizeof name, "coherence-%.30s-%lld", first->scene->name, first->n);
    koksma__doc_paragraph(
        d, "Coherence of the error: the peak of its power spectrum over the mean power (of frequencies as high "
           "if that is larger, so that blue noise counts as noise), from the same trials. Part of an error may be "
           "common to all trials (column _in common_). For white noise with an "
           "equally large common part, 95 %% of the coherences lie between the columns _noise from_ and _to_. An "
           "error whose coherence exceeds that of 99.5 %% of such noise is coherent: it has bands or another "
           "pattern, which the eye sees sooner than noise of the same size.");
    koksma__doc_table_begin(d, name);
    koksma__doc_head(d, "pattern");
    koksma__doc_head_interval(d, "coherence", 3);
    koksma__doc_head_number(d, "noise from", 3);
    koksma__doc_head_number(d, "to", 3);
    koksma__doc_head_number(d, "in common", 2);
    koksma__doc_head_number(d, "cycles a pixel", 2);
    koksma__doc_head(d, "error");
    for (size_t p = 0; p < n; p++) {
        const koksma_coherence_values *v = &values[p];
        if (!is_served(first->image, p)) {
            continue;
        }
        koksma__doc_row(d);
        koksma__doc_text(d, first->image->patterns.at[p]);
        koksma__doc_interval(d, (koksma__estimate){v->coherence, v->low, v->high});
        koksma__doc_number(d, v->noise_low);
        koksma__doc_number(d, v->noise_high);
        koksma__doc_number(d, v->common);
        koksma__doc_number(d, hypot(v->frequency_x, v->frequency_y));
        koksma__doc_text(d, v->images == 0 ? "none" : v->coherent ? "coherent" : "noise");
    }
    koksma__doc_table_end(d);
}

static koksma_status add_spectra(koksma__document *d, const koksma__task *first, const koksma_image *reference,
                                 const koksma_run *run)
{
    const koksma__texts *patterns = &first->image->patterns;
    const size_t n = patterns->n < MAX_SHOWN ? patterns->n : MAX_SHOWN;
    koksma_coherence_values values[MAX_SHOWN];
    koksma_status status = KOKSMA_OK;
    char title[512], name[256];
    koksma__case_name(first->scene->name, first->variant, name, sizeof name);
    snprintf(title, sizeof title,
             "Spectrum of the image error: %.200s, %lld sample%s a pixel, mean over rings and %d trial%s", name,
             first->n, koksma__plural((double)first->n),
             first->trials < KOKSMA__SPECTRUM_TRIALS ? (int)first->trials : KOKSMA__SPECTRUM_TRIALS,
             koksma__plural((double)first->trials));
    koksma__doc_chart_begin(d, &(koksma__chart){title, "cycles a pixel", "power", false, true, 0});
    for (size_t p = 0; !status && p < n; p++) {
        const koksma__task task = koksma__task_with(first, patterns->at[p]);
        status = is_served(first->image, p) ? add_spectrum(d, &task, reference, run, &values[p]) : KOKSMA_OK;
    }
    koksma__doc_end(d);
    if (!status) {
        add_coherence(d, first, values, n);
    }
    return status;
}

/* ---- Pictures ---------------------------------------------------------------------------------------------- */

/* Whether the store has the first `trials` trials of the task for each of the first n patterns of its block. */
static koksma_status are_done(koksma_study *study, const koksma__task *first, size_t n, long long trials, bool *done)
{
    koksma_status status = KOKSMA_OK;
    *done = true;
    for (size_t p = 0; !status && *done && p < n; p++) {
        const koksma__task task = koksma__task_with(first, first->image->patterns.at[p]);
        char name[KOKSMA__REFERENCE_NAME];
        koksma__result *results = NULL;
        size_t found = 0;
        if (!is_served(first->image, p)) {
            continue;
        }
        const koksma__series series = koksma__task_series(&task, first->image->n_references, name);
        status = koksma__series_results(study, &series, trials, &results, &found);
        free(results);
        *done = (long long)found == trials;
    }
    return status;
}

/* Adds the pictures of the reference and of the first trial of each of the block's first n patterns. */
static koksma_status add_pictures(koksma__document *d, const koksma__task *first, size_t n,
                                  const koksma_image *reference, const koksma_run *run, size_t *used)
{
    koksma_status status = KOKSMA_OK;
    koksma__doc_pictures_begin(d, first->scene->name, first->width, first->height);
    koksma__doc_picture(d, reference, "reference");
    for (size_t p = 0; !status && p < n; p++) {
        const koksma__task task = koksma__task_with(first, first->image->patterns.at[p]);
        koksma_image image;
        if (!is_served(first->image, p)) {
            continue;
        }
        status = koksma__task_picture(&task, 0, run, &image);
        if (!status) {
            koksma__doc_picture(d, &image, task.pattern);
            *used += 4 * (size_t)image.width * (size_t)image.height * (size_t)image.channels;
            koksma_image_fini(&image);
        }
    }
    koksma__doc_end(d);
    return status;
}

static koksma_status add_scene(const koksma__report_scope *scope, koksma__document *d, const koksma__task *first,
                               size_t *used, size_t *left_out)
{
    koksma_study *study = scope->study;
    const koksma__texts *patterns = &first->image->patterns;
    const size_t shown = patterns->n < MAX_SHOWN ? patterns->n : MAX_SHOWN;
    const long long trials = first->trials < KOKSMA__SPECTRUM_TRIALS ? first->trials : KOKSMA__SPECTRUM_TRIALS;
    koksma__reference_image *reference = &study->references[first->references[first->n_series - 1]];
    bool done;
    koksma_status status = koksma__reference_find(study, reference, &done);
    status = status || !done ? status : are_done(study, first, shown, 1, &done);
    if (status || !done) {
        return status;
    }
    if (*used + 4 * (size_t)first->width * (size_t)first->height * (shown + 1) > MOST_BYTES) {
        (*left_out)++;
        return KOKSMA_OK;
    }
    status = koksma__reference_read(study, reference);
    if (status) {
        return status;
    }
    char name[512];
    koksma__case_name(first->scene->name, first->variant, name, sizeof name);
    koksma__doc_section_begin(d, NULL, false);
    koksma__doc_say(d, "%s, %lld sample%s a pixel, %d x %d pixels", name, first->n, koksma__plural((double)first->n),
                    first->width, first->height);
    koksma__doc_section_body(d);
    status = add_pictures(d, first, shown, &reference->image, study->report, used);
    if (shown < patterns->n) {
        koksma__doc_paragraph(
            d, shown + 1 == patterns->n ? "%zu more pattern is not shown." : "%zu more patterns are not shown.",
            patterns->n - shown);
    }
    status = status ? status : are_done(study, first, shown, trials, &done);
    status = status || !done ? status : add_spectra(d, first, &reference->image, study->report);
    koksma__doc_end(d);
    return status;
}

static koksma_status write(const koksma__report_scope *scope, koksma__document *d)
{
    koksma__tasks tasks;
    koksma__document scenes = {0};
    size_t used = 0, left_out = 0;
    koksma_status status = koksma__tasks_open(scope->study, true, &tasks);
    for (size_t i = 0; !status && i < tasks.n; i++) {
        const koksma__task *t = &tasks.at[i];
        const koksma__image_block *block = t->image;
        if (t->pattern == block->patterns.at[first_served(block)] && t->variant == block->variants.at[0] &&
            t->n == block->spp.at[block->spp.n / 2]) {
            status = add_scene(scope, &scenes, t, &used, &left_out);
        }
    }
    koksma__tasks_close(&tasks);
    if (used) {
        koksma__doc_paragraph(d,
                              "The first trial of every pattern, its absolute error in luminance 8 times as bright, "
                              "and the reference.");
    }
    koksma__doc_append(d, &scenes);
    if (left_out) {
        koksma__doc_paragraph(d, "The pictures of %zu scene%s are left out: this file would be too large.", left_out,
                              koksma__plural((double)left_out));
    }
    return status;
}

const koksma__section koksma__section_pictures = {"Pictures", false, is_shown, write};
