/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The jobs of a study. A job is one point set (all its measures) or one render (compared with all references); its
 * seed is a hash of its key, so that rows do not depend on threads, order or interruptions. Jobs whose rows exist are
 * skipped.
 */
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"
#include "study/study.h"

typedef struct job {
    const koksma__discrepancy_block *discrepancy; /* or NULL: */
    const koksma__image_block *image;
    const char *pattern;
    const koksma__study_scene *scene;
    const koksma_image *references; /* of the image block, in its order */
    long long n, trial;             /* points or samples a pixel */
} job;

typedef struct job_list {
    koksma_study *study;
    job *jobs;
    size_t n, room;
    koksma_image *references; /* all blocks' */
    size_t n_references;
} job_list;

static const koksma_run single = {.threads = 1};

/* ---- One job ------------------------------------------------------------------------------------------ */

static koksma__discrepancy_key discrepancy_key(const job *j, const char *measure)
{
    return (koksma__discrepancy_key){j->pattern, measure, j->n, j->discrepancy->dim, j->trial};
}

static koksma_status measure_points(koksma__store *store, const job *j, uint64_t seed, const koksma_points *points)
{
    koksma_status status = KOKSMA_OK;
    for (size_t m = 0; !status && m < j->discrepancy->measures.n; m++) {
        koksma_spec measure;
        koksma_value value;
        status = koksma_measure_spec(j->discrepancy->measures.at[m], &measure);
        if (!status) {
            status = koksma_evaluate(&measure, points, &single, &value);
        }
        const koksma__discrepancy_key key = discrepancy_key(j, j->discrepancy->measures.at[m]);
        if (!status) {
            status = koksma__store_put_discrepancy(store, &key, seed, value.value);
        }
    }
    return status;
}

static koksma_status do_discrepancy(koksma__store *store, const job *j)
{
    koksma_spec pattern;
    koksma_points points;
    const int dim = j->discrepancy->dim;
    const uint64_t seed = koksma__job_seed("discrepancy|%s|%lld|%d|%lld", j->pattern, j->n, dim, j->trial);
    koksma_status status = koksma_pattern_spec(j->pattern, &pattern);
    if (!status) {
        status = koksma_points_init(&points, (size_t)j->n, dim);
    }
    if (status) {
        return status;
    }
    status = koksma_generate(&pattern, seed, &single, &points);
    if (!status) {
        status = measure_points(store, j, seed, &points);
    }
    koksma_points_fini(&points);
    return status;
}

static koksma__image_key image_key(const job *j, const char *reference)
{
    const koksma__study_scene *s = j->scene;
    return (koksma__image_key){s->name, s->hash, j->pattern, reference, j->n, s->width, s->height, j->trial};
}

static koksma_status do_image(koksma__store *store, const job *j)
{
    koksma_image image;
    const uint64_t seed = koksma__job_seed("image|%s|%s|%s|%lld|%dx%d|%lld", j->scene->name, j->scene->hash,
                                           j->pattern, j->n, j->scene->width, j->scene->height, j->trial);
    koksma_status status = koksma__study_render(j->scene, j->pattern, j->n, seed, &single, &image);
    if (status) {
        return status;
    }
    for (size_t r = 0; !status && r < j->image->n_references; r++) {
        char name[KOKSMA__REFERENCE_NAME];
        koksma_image_error error;
        koksma__reference_name(&j->image->references[r], name);
        status = koksma_image_compare(&image, &j->references[r], &error);
        const koksma__image_key key = image_key(j, name);
        if (!status) {
            status = koksma__store_put_image(store, &key, seed, &error);
        }
    }
    koksma_image_fini(&image);
    return status;
}

static koksma_status do_job(void *context, size_t i)
{
    const job_list *list = context;
    const job *j = &list->jobs[i];
    return j->discrepancy ? do_discrepancy(list->study->store, j) : do_image(list->study->store, j);
}

/* ---- The list ------------------------------------------------------------------------------------------ */

static koksma_status is_done(koksma__store *store, const job *j, bool *done)
{
    koksma_status status = KOKSMA_OK;
    *done = true;
    for (size_t m = 0; j->discrepancy && *done && !status && m < j->discrepancy->measures.n; m++) {
        const koksma__discrepancy_key key = discrepancy_key(j, j->discrepancy->measures.at[m]);
        status = koksma__store_has_discrepancy(store, &key, done);
    }
    for (size_t r = 0; j->image && *done && !status && r < j->image->n_references; r++) {
        char name[KOKSMA__REFERENCE_NAME];
        koksma__reference_name(&j->image->references[r], name);
        const koksma__image_key key = image_key(j, name);
        status = koksma__store_has_image(store, &key, done);
    }
    return status;
}

static koksma_status add_job(job_list *list, const job *j, koksma_study_summary *summary)
{
    bool done;
    const koksma_status status = is_done(list->study->store, j, &done);
    summary->jobs++;
    summary->done_before += !status && done;
    if (status || done) {
        return status;
    }
    if (list->n == list->room) {
        const size_t room = list->room ? 2 * list->room : 256;
        job *jobs = realloc(list->jobs, room * sizeof *jobs);
        if (!jobs) {
            return koksma__fail_memory(room * sizeof *jobs);
        }
        list->jobs = jobs;
        list->room = room;
    }
    list->jobs[list->n++] = *j;
    return KOKSMA_OK;
}

static koksma_status list_discrepancies(job_list *list, const koksma__discrepancy_block *b,
                                        koksma_study_summary *summary)
{
    koksma_status status = KOKSMA_OK;
    for (size_t p = 0; p < b->patterns.n; p++) {
        for (size_t i = 0; i < b->n.n; i++) {
            for (long long t = 0; !status && t < b->trials; t++) {
                const job j = {.discrepancy = b, .pattern = b->patterns.at[p], .n = b->n.at[i], .trial = t};
                status = add_job(list, &j, summary);
            }
        }
    }
    return status;
}

static koksma_status list_images(job_list *list, const koksma__image_block *b, const koksma__study_scene *scene,
                                 const koksma_image *references, koksma_study_summary *summary)
{
    koksma_status status = KOKSMA_OK;
    for (size_t p = 0; p < b->patterns.n; p++) {
        for (size_t i = 0; i < b->spp.n; i++) {
            for (long long t = 0; !status && t < b->trials; t++) {
                const job j = {.image = b,
                               .pattern = b->patterns.at[p],
                               .scene = scene,
                               .references = references,
                               .n = b->spp.at[i],
                               .trial = t};
                status = add_job(list, &j, summary);
            }
        }
    }
    return status;
}

/* The reference images of a block and scene; only made when a job needs them. */
static koksma_status get_references(job_list *list, const koksma__image_block *b, const koksma__study_scene *scene,
                                    koksma_image *references, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    for (size_t r = 0; !status && r < b->n_references; r++) {
        status = koksma__reference_image(list->study, scene, &b->references[r], run, &references[r]);
    }
    return status;
}

/* Lists the jobs of the image blocks that are not done, with the references that they need. */
static koksma_status list_image_blocks(job_list *list, const koksma_run *run, koksma_study_summary *summary)
{
    const koksma__plan *plan = &list->study->plan;
    koksma_status status = KOKSMA_OK;
    size_t used = 0;
    for (size_t b = 0; b < plan->n_images; b++) {
        list->n_references += plan->images[b].scenes.n * plan->images[b].n_references;
    }
    list->references = calloc(list->n_references + 1, sizeof *list->references);
    if (!list->references) {
        return koksma__fail_memory(list->n_references * sizeof *list->references);
    }
    for (size_t b = 0; b < plan->n_images; b++) {
        const koksma__image_block *block = &plan->images[b];
        for (size_t s = 0; !status && s < block->scenes.n; s++) {
            const koksma__study_scene *scene = koksma__study_scene_of(list->study, block->scenes.at[s]);
            const size_t before = list->n;
            status = list_images(list, block, scene, list->references + used, summary);
            if (!status && list->n > before) {
                status = get_references(list, block, scene, list->references + used, run);
            }
            used += block->n_references;
        }
    }
    return status;
}

static koksma_status run_discrepancies(job_list *list, const koksma_run *run, koksma_study_summary *summary)
{
    const koksma__plan *plan = &list->study->plan;
    koksma_status status = KOKSMA_OK;
    for (size_t b = 0; !status && b < plan->n_discrepancies; b++) {
        status = list_discrepancies(list, &plan->discrepancies[b], summary);
    }
    if (!status) {
        status = koksma__parallel(run, list->n, do_job, list);
    }
    summary->done_now += status ? 0 : list->n;
    list->n = 0;
    return status;
}

static koksma_status run_images(job_list *list, const koksma_run *run, koksma_study_summary *summary)
{
    koksma_status status = list_image_blocks(list, run, summary);
    if (!status) {
        status = koksma__parallel(run, list->n, do_job, list);
    }
    summary->done_now += status ? 0 : list->n;
    return status;
}

koksma_status koksma_study_run(koksma_study *study, const koksma_run *run, koksma_study_summary *summary)
{
    koksma_study_summary unused;
    job_list list = {.study = study};
    summary = summary ? summary : &unused;
    *summary = (koksma_study_summary){0};
    koksma_status status = run_discrepancies(&list, run, summary);
    if (!status) {
        status = run_images(&list, run, summary);
    }
    for (size_t r = 0; r < list.n_references; r++) {
        koksma_image_fini(&list.references[r]);
    }
    free(list.references);
    free(list.jobs);
    return status;
}
