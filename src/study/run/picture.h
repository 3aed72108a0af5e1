/* SPDX-License-Identifier: Apache-2.0 */
/* The renders of a study: what one depends on, and its seed. */
#ifndef KOKSMA_STUDY_RUN_PICTURE_H
#define KOKSMA_STUDY_RUN_PICTURE_H

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "study/plan/plan.h"
#include "study/plan/variants.h"

/* A scene that the plan uses, by its spelling in the plan. */
typedef struct koksma__study_scene {
    const char *name;
    koksma_scene *scene;
    char hash[24];
    int width, height;
    koksma_rank_renderer render; /* another renderer, or NULL */
    void *render_context;
} koksma__study_scene;

/* The pixels of an image block's pictures of a scene: the block's, or the scene's own. */
void koksma__block_size(const koksma__image_block *block, const koksma__study_scene *scene, int *width, int *height);

/* What a render of a study depends on beside its scene. */
typedef struct koksma__picture {
    const char *pattern, *variant;
    bool of_reference; /* only the options that change the exact image */
    long long spp;
    int width, height;
    uint64_t seed;
} koksma__picture;

/* The options of a render: the picture's pattern, variant, samples, size and seed. */
koksma_status koksma__picture_set(const koksma__study_scene *scene, const koksma__picture *picture,
                                  koksma__variant *variant);

/* Renders. Allocates out. */
koksma_status koksma__study_render(const koksma__study_scene *scene, const koksma__picture *picture,
                                   const koksma_run *run, koksma_image *out);

/* The seed of a job is the hash of its key. */
uint64_t koksma__job_seed(const char *format, ...) KOKSMA_PRINTF(1, 2);

#endif
