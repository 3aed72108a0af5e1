/* SPDX-License-Identifier: Apache-2.0 */
/* The renders of a study: the parameters that a render depends on, and its seed. */
#ifndef KOKSMA_STUDY_RUN_PICTURE_H
#define KOKSMA_STUDY_RUN_PICTURE_H

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "study/plan/plan.h"
#include "study/plan/variants.h"

/* A scene that the plan uses; `name` is its spelling in the plan. */
typedef struct koksma__study_scene {
    const char *name;
    koksma_scene *scene;
    char hash[24];
    int width, height;
    koksma_rank_renderer render; /* a function that calls another renderer, or NULL for this library's */
    void *render_context;
} koksma__study_scene;

/* The width and height of an image block's pictures: those of the block if it states them, otherwise the scene's. */
void koksma__block_size(const koksma__image_block *block, const koksma__study_scene *scene, int *width, int *height);

/* The parameters of a render of a study, except its scene. */
typedef struct koksma__picture {
    const char *pattern, *variant;
    bool of_reference; /* apply only the options of the variant that change the exact image */
    long long spp;
    int width, height;
    uint64_t seed;
} koksma__picture;

/* Sets *variant to the options for rendering the picture: those of the scene, changed as picture->variant says, with
   the picture's pattern, samples, size and seed. */
koksma_status koksma__picture_set(const koksma__study_scene *scene, const koksma__picture *picture,
                                  koksma__variant *variant);

/* Renders a picture. Allocates *out. */
koksma_status koksma__study_render(const koksma__study_scene *scene, const koksma__picture *picture,
                                   const koksma_run *run, koksma_image *out);

/* The seed of a job: the hash of its key, a formatted text. */
uint64_t koksma__job_seed(const char *format, ...) KOKSMA_PRINTF(1, 2);

#endif
