/* SPDX-License-Identifier: Apache-2.0 */
/* Renders the first trials of a task again, finds the coherence of their errors together, and keeps it until the report
   is written, because several sections ask for it. */
#include "study/report/mean_coherence.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/run/references.h"

/* The largest number of samples that a report renders for coherences. */
#define MOST_SAMPLES 268435456.0

struct koksma__coherences {
    koksma__tasks tasks;
    koksma_coherence_values *of; /* of each task */
    bool *known;
    double samples; /* rendered so far */
};

static koksma_status open_all(koksma_study *study)
{
    struct koksma__coherences *c = calloc(1, sizeof *c);
    KOKSMA__REQUIRE_MEMORY(c, sizeof *c);
    study->coherences = c;
    KOKSMA__TRY(koksma__tasks_open(study, true, &c->tasks));
    c->of = calloc(c->tasks.n + 1, sizeof *c->of);
    c->known = calloc(c->tasks.n + 1, sizeof *c->known);
    return c->of && c->known ? KOKSMA_OK : koksma__fail_memory(c->tasks.n * sizeof *c->of);
}

void koksma__mean_coherence_forget(koksma_study *study)
{
    if (study->coherences) {
        koksma__tasks_close(&study->coherences->tasks);
        KOKSMA__FREE(study->coherences->of, study->coherences->known, study->coherences);
        study->coherences = NULL;
    }
}

koksma_status koksma__task_picture(const koksma__task *t, long long trial, const koksma_run *run, koksma_image *out)
{
    const koksma__picture picture = {.pattern = t->pattern,
                                     .variant = t->variant,
                                     .spp = t->n,
                                     .width = t->width,
                                     .height = t->height,
                                     .seed = koksma__task_seed(t, trial)};
    return koksma__study_render(t->scene, &picture, run, out);
}

/* Whether the store has the reference and the coherence rows of the first `trials` trials. */
static koksma_status is_done(koksma_study *study, const koksma__task *t, long long trials, bool *done)
{
    char name[KOKSMA__REFERENCE_NAME];
    koksma__result *results = NULL;
    size_t n = 0;
    const koksma__series series = koksma__task_series(t, t->image->n_references, name);
    KOKSMA__TRY(koksma__series_results(study, &series, trials, &results, &n));
    free(results);
    *done = (long long)n == trials;
    return *done ? koksma__reference_find(study, &study->references[t->references[t->n_series - 1]], done)
                 : KOKSMA_OK;
}

static koksma_status find(koksma_study *study, const koksma__task *t, long long trials, koksma_coherence_values *out)
{
    koksma__reference_image *reference = &study->references[t->references[t->n_series - 1]];
    koksma__phases phases = {0};
    const koksma_run run =
        koksma__phase_run(&phases, study->report, 0); /* the fractions of short calls say nothing */
    koksma_coherence coherence = {0};
    koksma_status status = koksma__reference_read(study, reference);
    status = status ? status : koksma_coherence_init(&coherence, t->width, t->height);
    for (long long trial = 0; !status && trial < trials; trial++) {
        koksma_image image;
        status = koksma__task_picture(t, trial, &run, &image);
        if (!status) {
            status = koksma_coherence_add(&coherence, &image, &reference->image);
            koksma_image_fini(&image);
        }
    }
    if (!status) {
        koksma_coherence_find(&coherence, out);
    }
    koksma_coherence_fini(&coherence);
    return status;
}

static bool is_of(const koksma__task *t, const koksma__image_mean *of)
{
    return t->image == of->block && t->n == of->spp && !strcmp(t->scene->name, of->scene) &&
           !strcmp(t->variant, of->variant) && !strcmp(t->pattern, of->pattern);
}

koksma_status koksma__mean_coherence(koksma_study *study, const koksma__image_mean *of, koksma_coherence_values *out)
{
    KOKSMA__TRY(study->coherences ? KOKSMA_OK : open_all(study));
    struct koksma__coherences *c = study->coherences;
    size_t i = 0;
    *out = (koksma_coherence_values){.coherence = NAN, .noise_high = NAN};
    while (i < c->tasks.n && !is_of(&c->tasks.at[i], of)) {
        i++;
    }
    if (i == c->tasks.n) {
        return KOKSMA_OK;
    }
    const koksma__task *t = &c->tasks.at[i];
    const long long trials = t->trials < KOKSMA__SPECTRUM_TRIALS ? t->trials : KOKSMA__SPECTRUM_TRIALS;
    const double samples = (double)t->width * t->height * (double)t->n * (double)trials;
    koksma_status status = KOKSMA_OK;
    if (!c->known[i]) {
        bool done = false;
        c->of[i] = *out;
        status = is_done(study, t, trials, &done);
        if (!status && done && c->samples + samples <= MOST_SAMPLES) {
            c->samples += samples;
            status = find(study, t, trials, &c->of[i]);
        }
        c->known[i] = !status;
    }
    *out = c->of[i];
    return status;
}

void koksma__bands_columns(koksma__document *d)
{
    koksma__doc_head_number(d, "coherence", 3);
    koksma__doc_head_number(d, "noise below", 3);
    koksma__doc_head(d, "in bands");
}

void koksma__bands_cells(koksma__document *d, const koksma_coherence_values *v)
{
    koksma__doc_number(d, v->images ? v->coherence : (double)NAN);
    koksma__doc_number(d, v->images ? v->noise_high : (double)NAN);
    koksma__doc_text(d, !v->images ? "not known" : v->coherent ? "yes" : "no");
}
