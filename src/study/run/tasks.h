/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The jobs of a study. A task is everything that differs only in the trial: a pattern's point sets of one size with
 * all their measures, or renders of one scene with their errors. A job is one trial of a task. The order of
 * the jobs goes over all tasks before it goes to the next trial, so that a run that is cut short has something
 * everywhere.
 */
#ifndef KOKSMA_STUDY_RUN_TASKS_H
#define KOKSMA_STUDY_RUN_TASKS_H

#include "study/run/study.h"

typedef struct koksma__task {
    const koksma__discrepancy_block *discrepancy; /* or NULL: */
    const koksma__image_block *image;
    const char *pattern;
    const char *variant; /* of an image; of a discrepancy the warp, or "" */
    const koksma__study_scene *scene;
    long long n, trials; /* n: points or samples a pixel */
    int width, height;
    size_t place;          /* in the plan */
    size_t n_series;       /* a job's results: one a measure; or the error against each reference, and its coherence
                              against the last */
    size_t *references;    /* of an image: indices into study->references */
    long long *series;     /* ids in the store, by koksma__tasks_look_up */
    unsigned char *done;   /* a bit a trial */
    long long done_before; /* trials */
} koksma__task;

/* A run of rounds in which the same tasks have trials left. */
typedef struct koksma__rounds {
    size_t first_job;
    long long first_trial;
    size_t tasks;
} koksma__rounds;

typedef struct koksma__tasks {
    koksma_study *study;
    size_t n, n_jobs;
    long long wanted; /* jobs of the tasks so far */
    koksma__task *at; /* those with the most trials first */
    size_t n_rounds;
    koksma__rounds *rounds;
} koksma__tasks;

/* All sets of a deterministic pattern are one set. */
bool koksma__has_one_set(const char *pattern);

/* All tasks of the plan of one kind. Errors: ARGUMENT (more than 2^30 jobs), MEMORY. */
koksma_status koksma__tasks_open(koksma_study *study, bool images, koksma__tasks *tasks);
void koksma__tasks_close(koksma__tasks *tasks);

/* Finds or makes the series of all tasks in the store, and which trials are done. */
koksma_status koksma__tasks_look_up(koksma__tasks *tasks);

/* Job i < n_jobs. */
const koksma__task *koksma__tasks_job(const koksma__tasks *tasks, size_t i, long long *trial);
bool koksma__task_is_done(const koksma__task *task, long long trial);

/* The key of result k of a task's jobs; `name` holds a text of it. */
koksma__series koksma__task_series(const koksma__task *task, size_t k, char name[KOKSMA__REFERENCE_NAME]);

uint64_t koksma__task_seed(const koksma__task *task, long long trial);

/* Does one job: n_series results. The references must have their pixels. Errors: INTERRUPTED, when `run` says so;
   MEMORY; what generating, measuring and rendering say, with the job's block, pattern, number and trial before it. */
koksma_status koksma__task_do(const koksma_study *study, const koksma__task *task, long long trial,
                              const koksma_run *run, koksma__result *results);

/* Puts the results of a job into the store, or where else they go. */
koksma_status koksma__task_put(const koksma_study *study, const koksma__task *task, const koksma__result *results);

/* Whether a failure is of the machine or the caller, and not of one job. */
bool koksma__ends_all(koksma_status status);

/* Whether the other jobs go on when one has failed so: it is impossible; in an audit also for another reason of its
   own. */
bool koksma__task_failed_alone(const koksma_study *study, koksma_status status);

#endif
