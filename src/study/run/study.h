/* SPDX-License-Identifier: Apache-2.0 */
/* The open study: its plan, store, scenes and references. */
#ifndef KOKSMA_STUDY_RUN_STUDY_H
#define KOKSMA_STUDY_RUN_STUDY_H

#include <koksma/study.h>

#include "study/run/reference_image.h"
#include "study/store/store.h"

struct koksma_study {
    koksma__plan plan;
    char *folder;
    koksma__store *store;
    bool is_written; /* the store was opened for a run */
    size_t n_scenes;
    koksma__study_scene *scenes;
    size_t n_references;
    koksma__reference_image *references;
};

/* The scene that the plan calls `name`. */
const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name);

#endif
