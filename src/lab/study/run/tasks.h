/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The jobs of a study. A task is a set of jobs that differ only in their trial: a pattern's point sets of one size
 * with all their measures, or renders of one scene with their errors. A job is one trial of a task. The jobs are
 * ordered by trial first: all tasks do one trial before any does the next, so that a run that is cut short has some
 * results for every task.
 */
#ifndef KOKSMA_STUDY_RUN_TASKS_H
#define KOKSMA_STUDY_RUN_TASKS_H

#include "study/plan/variants.h"
#include "study/run/study.h"

typedef struct koksma__task {
    const koksma__discrepancy_block *discrepancy; /* NULL for an image */
    const koksma__image_block *image;             /* NULL for a discrepancy */
    const char *pattern;
    const char *variant; /* the variant of an image; for a discrepancy, the warp or "" */
    const koksma__study_scene *scene;
    long long n, trials; /* n: points, or samples per pixel */
    int width, height;
    /* the hash of the common beginning of the texts from which the jobs' seeds are made (core/hash.h) */
    uint64_t key;
    size_t place;          /* index of the task in the plan's order */
    const char **measures; /* of a set of points: what each result measures; else NULL */
    /* Number of results of a job: one per measure that accepts n points; or, for an image, its error against each
       reference, then the coherence of its error against the last reference, then that error by each metric. */
    size_t n_series;
    uint64_t *seeds; /* of a family of files (file_names.h): the seed in the name of each trial's file; else NULL */
    size_t *references;    /* for an image: indices into study->references, one per result */
    long long *series;     /* ids of the series in the store, set by koksma__tasks_look_up; 0: none */
    unsigned char *done;   /* one bit per trial, which tells whether the trial was done before this run */
    long long done_before; /* number of trials done before this run */
} koksma__task;

/* Consecutive rounds (one trial of each task) in which the same tasks have trials left. */
typedef struct koksma__rounds {
    size_t first_job;
    long long first_trial;
    size_t tasks;
} koksma__rounds;

typedef struct koksma__tasks {
    koksma_study *study;
    size_t n, n_jobs;
    long long wanted; /* total number of jobs of the tasks that were added so far */
    koksma__task *at; /* sorted by descending number of trials */
    size_t n_rounds;
    koksma__rounds *rounds;
} koksma__tasks;

/* Whether the pattern is deterministic: all its trials give the same point set, so that one trial is enough. */
bool koksma__has_one_set(const char *pattern);

/* Lists all tasks of one kind in the plan. Errors: ARGUMENT (more than 2^30 jobs of the kind; both kinds together have
   too many tasks, series or references), MEMORY. */
koksma_status koksma__tasks_open(koksma_study *study, bool images, koksma__tasks *tasks);
void koksma__tasks_close(koksma__tasks *tasks);

/* Whether tasks of one kind have jobs or, for images, the study has references that an audit renders. All ranks of an
   MPI run get the same answer. */
bool koksma__tasks_have_work(const koksma__tasks *tasks, bool images);

/* Finds the series of all tasks in the store, creates those that it lacks if `add`, until `run` (which may be
   NULL) stops, and finds which trials are done. */
koksma_status koksma__tasks_look_up(koksma__tasks *tasks, bool add, const koksma_run *run);

/* koksma__tasks_job finds the task and trial of job i < n_jobs. koksma__task_is_done tells whether a trial was done
   before this run. */
const koksma__task *koksma__tasks_job(const koksma__tasks *tasks, size_t i, long long *trial);
bool koksma__task_is_done(const koksma__task *task, long long trial);

/* The key of result k of a task's jobs; `name` holds a text that the key points to. */
koksma__series koksma__task_series(const koksma__task *task, size_t k, char name[KOKSMA__REFERENCE_NAME]);

/* The seed of a job: a hash of its key, or the number in the name of the job's file. */
uint64_t koksma__task_seed(const koksma__task *task, long long trial);

/* The same task with another pattern, and so with other seeds; it shares the lists of `task`, and is not closed. */
koksma__task koksma__task_with(const koksma__task *task, const char *pattern);

/* Writes the name of a job, such as "discrepancies[0], poisson-disk:d=0.116, n = 64, trial 417". */
enum { KOKSMA__JOB_NAME = KOKSMA_MAX_SPEC + KOKSMA__VARIANT_TEXT + 128 };
void koksma__task_name(const koksma_study *study, const koksma__task *task, long long trial,
                       char name[KOKSMA__JOB_NAME]);

/* Does one job, which gives n_series results. The pixels of the references must be loaded. Errors: INTERRUPTED, if
   `run` stops the job; MEMORY; those of generating, measuring and rendering, whose text begins with the job's block,
   pattern, n and trial. */
koksma_status koksma__task_do(const koksma_study *study, const koksma__task *task, long long trial,
                              const koksma_run *run, koksma__result *results);

/* Puts the results of a job into the store, or passes them to the study's sink. */
koksma_status koksma__task_put(const koksma_study *study, const koksma__task *task, const koksma__result *results);

/* Whether a job has no result because its pattern has no set, or its measure no value, of its parameters or its number of
   points. */
bool koksma__is_impossible(koksma_status status);

/* Whether a failure is caused by the machine or the caller, not by one job; the run then ends. */
bool koksma__ends_all(koksma_status status);

/* Whether the other jobs continue after a job has failed with this status: they do if the job is impossible and, in
   an audit, after any failure that does not end all jobs. */
bool koksma__task_failed_alone(const koksma_study *study, koksma_status status);

#endif
