/* SPDX-License-Identifier: Apache-2.0 */
/* What the files of a study share: the open study, its scenes and its references. */
#ifndef KOKSMA_STUDY_INTERNAL_H
#define KOKSMA_STUDY_INTERNAL_H

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "study/plan.h"
#include "study/store.h"

/* A scene that the plan uses, by its spelling in the plan. */
typedef struct koksma__study_scene {
    const char *name;
    koksma_scene *scene;
    char hash[24];
    int width, height;
} koksma__study_scene;

struct koksma_study {
    koksma__plan plan;
    char *folder;
    koksma__store *store;
    size_t n_scenes;
    koksma__study_scene *scenes;
};

enum { KOKSMA__REFERENCE_NAME = 192 };

/* The scene that the plan calls `name`. */
const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name);

/* "name:pattern@spp x replicates": the reference's key in the store. */
void koksma__reference_name(const koksma__reference *reference, char *text);

/* Reads DIR/references/…, or renders it and writes it there, with its standard error into the store. Allocates out.
 */
koksma_status koksma__reference_image(koksma_study *study, const koksma__study_scene *scene,
                                      const koksma__reference *reference, const koksma_run *run, koksma_image *out);

/* Renders `scene` with a pattern's canonical spec. Allocates out. */
koksma_status koksma__study_render(const koksma__study_scene *scene, const char *pattern, long long spp,
                                   uint64_t seed, const koksma_run *run, koksma_image *out);

/* The seed of a job is the hash of its key. */
uint64_t koksma__job_seed(const char *format, ...) KOKSMA_PRINTF(1, 2);

#endif
