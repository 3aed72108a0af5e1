/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures of a study, and the coherence of their errors. The store has no pictures: each is rendered again from the key
 * of its row. Only trials that have a row are rendered, because the time that other trials would take is unknown.
 * Coherences are kept until the report is written, because several sections ask for them.
 *
 * The section has, for every scene of the image blocks, the reference and the first trial of each pattern, from which the
 * page makes maps of the error and compares any two pictures; then the coherence of the error over some trials.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/status.h"
#include "image/coherence.h"
#include "image/formats.h"
#include "image/image.h"
#include "study/report/report.h"
#include "study/run/references.h"

/* The largest size in bytes of all floats in a report, before base64, and the largest number of patterns that are
   shown for a scene. */
enum { MOST_BYTES = 24 << 20, MAX_SHOWN = 24 };

/* The largest number of samples that a report renders for coherences. */
#define MOST_SAMPLES 268435456.0

/* ---- Trials of a task -------------------------------------------------------------------------------------- */

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

/* The number of trials whose errors are averaged. */
static long long averaged(const koksma__task *t)
{
    return t->trials < KOKSMA__SPECTRUM_TRIALS ? t->trials : KOKSMA__SPECTRUM_TRIALS;
}

static koksma__reference_image *reference_of(const koksma__report *r, const koksma__task *t)
{
    return &r->study->references[t->references[t->n_series - 1]];
}

/* Whether the store has the coherence rows of a task's first `trials` trials. */
static bool has_trials(koksma__report *r, const koksma__task *t, long long trials)
{
    char name[KOKSMA__REFERENCE_NAME];
    size_t n = 0;
    const koksma__series series = koksma__task_series(t, t->image->n_references, name);
    free(koksma__read_results(r, &series, trials, &n));
    return (long long)n == trials;
}

/* Whether the pixels of a task's last reference can be read. */
static bool has_reference(koksma__report *r, const koksma__task *t)
{
    bool exists = false;
    return koksma__report_keep(r, koksma__reference_find(r->study, reference_of(r, t), &exists)) && exists;
}

/* Finds the coherence of the errors of a task's first trials together. */
static koksma_coherence_values average(koksma__report *r, const koksma__task *t, const koksma_run *run)
{
    koksma_coherence_values values = {.coherence = NAN, .noise_high = NAN};
    koksma__reference_image *reference = reference_of(r, t);
    koksma_coherence coherence = {0};
    if (!koksma__report_keep(r, koksma__reference_read(r->study, reference)) ||
        !koksma__report_keep(r, koksma_coherence_init(&coherence, t->width, t->height))) {
        return values;
    }
    for (long long trial = 0; trial < averaged(t); trial++) {
        koksma_image image;
        if (!koksma__report_keep(r, r->status ? r->status : render(t, trial, run, &image))) {
            break;
        }
        koksma__report_keep(r, koksma_coherence_add(&coherence, &image, &reference->image));
        koksma_image_fini(&image);
    }
    if (!r->status) {
        koksma_coherence_find(&coherence, &values);
    }
    koksma_coherence_fini(&coherence);
    return values;
}

/* ---- The coherence that the whole report uses -------------------------------------------------------------- */

struct koksma__coherences {
    koksma__tasks tasks;
    struct {
        koksma_coherence_values values;
        bool known;
    } * of;         /* each task */
    double samples; /* rendered so far */
};

static bool open_all(koksma__report *r)
{
    struct koksma__coherences *c = r->coherences = calloc(1, sizeof *c);
    if (c && koksma__report_keep(r, koksma__tasks_open(r->study, true, &c->tasks))) {
        c->of = calloc(c->tasks.n + 1, sizeof *c->of);
    }
    return koksma__report_keep(r, r->status || (c && c->of) ? r->status : koksma__fail_memory(sizeof *c));
}

void koksma__mean_coherence_forget(koksma__report *r)
{
    if (r->coherences) {
        koksma__tasks_close(&r->coherences->tasks);
        KOKSMA__FREE(r->coherences->of, r->coherences);
        r->coherences = NULL;
    }
}

koksma_coherence_values koksma__mean_coherence(koksma__report *r, const koksma__subject *s, const char *pattern,
                                               long long n)
{
    const koksma_coherence_values none = {.coherence = NAN, .noise_high = NAN};
    if (r->status || !(r->coherences || open_all(r))) {
        return none;
    }
    struct koksma__coherences *c = r->coherences;
    size_t i = 0;
    for (; i < c->tasks.n; i++) {
        const koksma__task *t = &c->tasks.at[i];
        if (t->image == s->images && t->n == n && !strcmp(t->scene->name, s->scene) &&
            !strcmp(t->variant, s->variant) && !strcmp(t->pattern, pattern)) {
            break;
        }
    }
    if (i < c->tasks.n && !c->of[i].known) {
        const koksma__task *t = &c->tasks.at[i];
        const double samples = (double)t->width * t->height * (double)t->n * (double)averaged(t);
        koksma__phases phases = {0};
        const koksma_run run = koksma__phase_run(&phases, r->run, 0); /* the fractions of short calls say nothing */
        c->of[i].known = true;
        c->of[i].values = none;
        if (has_trials(r, t, averaged(t)) && has_reference(r, t) && c->samples + samples <= MOST_SAMPLES) {
            c->samples += samples;
            c->of[i].values = average(r, t, &run);
        }
    }
    return i < c->tasks.n ? c->of[i].values : none;
}

/* ---- The section ------------------------------------------------------------------------------------------- */

/* Whether pattern p of a block can make the block's middle number of samples, with which the pictures are rendered. */
static bool is_served(const koksma__image_block *block, size_t p)
{
    return !koksma__is_left_out(&block->left_out, p, block->spp.n, block->spp.n / 2);
}

static size_t first_served(const koksma__image_block *block)
{
    size_t p = 0;
    while (p + 1 < block->patterns.n && !is_served(block, p)) {
        p++;
    }
    return p;
}

/* Whether the store has the first trial of the task for each of the first n patterns of its block. */
static bool are_done(koksma__report *r, const koksma__task *first, size_t n)
{
    bool done = true;
    for (size_t p = 0; done && p < n; p++) {
        const koksma__task task = koksma__task_with(first, first->image->patterns.at[p]);
        done = !is_served(first->image, p) || has_trials(r, &task, 1);
    }
    return done;
}

static void add_pictures(koksma__report *r, koksma__document *d, const koksma__task *first, size_t n, size_t *used)
{
    koksma__doc_pictures(d, first->scene->name, first->width, first->height);
    koksma__doc_picture(d, &reference_of(r, first)->image, "reference");
    for (size_t p = 0; !r->status && p < n; p++) {
        const koksma__task task = koksma__task_with(first, first->image->patterns.at[p]);
        koksma_image image;
        if (is_served(first->image, p) && koksma__report_keep(r, render(&task, 0, r->run, &image))) {
            koksma__doc_picture(d, &image, task.pattern);
            *used += 4 * (size_t)image.width * (size_t)image.height * (size_t)image.channels;
            koksma_image_fini(&image);
        }
    }
}

static void add_scene(koksma__report *r, koksma__document *d, const koksma__task *first, size_t *used,
                      size_t *left_out)
{
    const koksma__texts *patterns = &first->image->patterns;
    const size_t shown = patterns->n < MAX_SHOWN ? patterns->n : MAX_SHOWN;
    if (!has_reference(r, first) || !are_done(r, first, shown)) {
        return;
    }
    if (*used + 4 * (size_t)first->width * (size_t)first->height * (shown + 1) > MOST_BYTES) {
        (*left_out)++;
        return;
    }
    if (!koksma__report_keep(r, koksma__reference_read(r->study, reference_of(r, first)))) {
        return;
    }
    char name[512];
    koksma__case_name(first->scene->name, first->variant, name, sizeof name);
    koksma__doc_section(d, NULL, "%s%s%s, %lld sample%s a pixel, %d x %d pixels",
                        first->image->id ? first->image->id : "", first->image->id ? ": " : "", name, first->n,
                        koksma__plural((double)first->n), first->width, first->height);
    add_pictures(r, d, first, shown, used);
    if (shown < patterns->n) {
        koksma__doc_paragraph(
            d, shown + 1 == patterns->n ? "%zu more pattern is not shown." : "%zu more patterns are not shown.",
            patterns->n - shown);
    }
    koksma__doc_end(d);
}

static void write_pictures(koksma__report *r, koksma__document *d)
{
    koksma__tasks tasks;
    koksma__document scenes = {0};
    size_t used = 0, left_out = 0;
    koksma__report_keep(r, koksma__tasks_open(r->study, true, &tasks));
    for (size_t i = 0; !r->status && i < tasks.n; i++) {
        const koksma__task *t = &tasks.at[i];
        const koksma__image_block *block = t->image;
        if (t->pattern == block->patterns.at[first_served(block)] && t->variant == block->variants.at[0] &&
            t->n == block->spp.at[block->spp.n / 2]) {
            add_scene(r, &scenes, t, &used, &left_out);
        }
    }
    koksma__tasks_close(&tasks);
    if (used) {
        koksma__doc_paragraph(d, "The first trial of every pattern, its absolute error in luminance 8 times as "
                                 "bright, and the reference.");
    }
    koksma__doc_append(d, &scenes);
    if (left_out) {
        koksma__doc_paragraph(d, "The pictures of %zu scene%s are left out: this file would be too large.", left_out,
                              koksma__plural((double)left_out));
    }
}

const koksma__section koksma__section_pictures = {"Pictures", false, write_pictures};
