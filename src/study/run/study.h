/* SPDX-License-Identifier: Apache-2.0 */
/* The open study: its plan, store, scenes and references. */
#ifndef KOKSMA_STUDY_RUN_STUDY_H
#define KOKSMA_STUDY_RUN_STUDY_H

#include <koksma/study.h>

#include "study/run/reference_image.h"
#include "study/store/store.h"

struct koksma__tasks;
struct koksma__task;

/* Where the results of a run go, if not into the store: an audit compares them with it. Every call may come from any
   thread. */
typedef struct koksma__sink {
    void *context;
    koksma_status (*look_up)(void *context, struct koksma__tasks *tasks); /* which jobs are not to be done */
    koksma_status (*put_job)(void *context, const struct koksma__task *task, const koksma__result *results);
    koksma_status (*put_reference)(void *context, const koksma__reference_image *reference,
                                   const koksma__reference_row *row); /* all are made again */
} koksma__sink;

struct koksma_study {
    koksma__plan plan;
    char *folder;
    koksma__store *store;
    bool is_written; /* the store was opened for a run */
    size_t n_scenes;
    koksma__study_scene *scenes;
    size_t n_references;
    koksma__reference_image *references;
    const koksma__sink *sink; /* NULL: the store */
};

/* Opens a scene, unless it is open; the name must stay. Errors: those of koksma_scene_open. */
koksma_status koksma__study_open_scene(koksma_study *study, const char *name);

/* A folder that was opened without a plan is only read until a run needs more. Errors: those of the store. */
koksma_status koksma__study_open_to_write(koksma_study *study);

/* The scene that the plan calls `name`. */
const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name);

#endif
