/* SPDX-License-Identifier: Apache-2.0 */
/* The open study: its plan, store, scenes and references. */
#ifndef KOKSMA_STUDY_RUN_STUDY_H
#define KOKSMA_STUDY_RUN_STUDY_H

#include <koksma/study.h>

#include "study/run/reference_image.h"
#include "study/store/store.h"

struct koksma__tasks;
struct koksma__task;
struct koksma__coherences;

/* Receives the results of a run instead of the store; an audit uses it to compare results with the store. A run with
   a sink renders all references again. Every function may be called on any thread. */
typedef struct koksma__sink {
    void *context;
    /* marks the jobs that need not be done, as if they were done before */
    koksma_status (*look_up)(void *context, struct koksma__tasks *tasks);
    koksma_status (*put_job)(void *context, const struct koksma__task *task, const koksma__result *results);
    koksma_status (*put_reference)(void *context, const koksma__reference_image *reference,
                                   const koksma__reference_row *row);
    /* sets reference->failed; text: the reason why it cannot be rendered */
    void (*fail_reference)(void *context, koksma__reference_image *reference, const char *text);
} koksma__sink;

struct koksma_study {
    koksma__plan plan;
    char *folder;
    koksma__store *store;
    bool is_written;            /* whether the store was opened for a run */
    koksma__plan_totals totals; /* of its plans */
    void *scenes;               /* koksma__study_scene of each name: a tree of tsearch(3) */
    size_t n_references;
    koksma__reference_image *references;
    koksma__texts failed;     /* lines for readers on the jobs that failed alone (failed_jobs.h) */
    const koksma__sink *sink; /* NULL: results go into the store */
    const koksma_run *report; /* of the report that is being written (koksma__report_goes_on); NULL: none is */
    struct koksma__coherences *coherences; /* of the report that is being written (mean_coherence.h) */
};

/* Opens a scene unless it is open already. `name` must remain valid as long as the study. Errors: those of
   koksma_scene_open.  */
koksma_status koksma__study_open_scene(koksma_study *study, const char *name);

/* Adds to the text of an error of a file that the study needs: if the current folder is not that of the study's last run,
   the folder of that run, because relative paths start there. Returns the status. */
koksma_status koksma__study_fail_here(koksma_study *study, koksma_status status);

/* Reopens the store for writing if it is open for reading only, which is the case for a folder that was opened
   without a plan. Errors: those of the store. */
koksma_status koksma__study_open_to_write(koksma_study *study);

/* Forgets what the study knows of the files that patterns name: their hashes, and the images of references. A run and a
   report begin with it, because files may change while a study is open. In an MPI run only rank 0 has hashes. */
void koksma__study_forget_files(koksma_study *study);

/* The open scene with the given name; NULL if there is none. */
const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name);

#endif
