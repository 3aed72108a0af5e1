/* SPDX-License-Identifier: Apache-2.0 */
/* What the files of a study share: the open study, its scenes and its references. */
#ifndef KOKSMA_STUDY_RUN_STUDY_H
#define KOKSMA_STUDY_RUN_STUDY_H

#include <koksma/image.h>
#include <koksma/render.h>
#include <koksma/study.h>

#include "study/plan/plan.h"
#include "study/plan/variants.h"
#include "study/store/store.h"

/* A scene that the plan uses, by its spelling in the plan. */
typedef struct koksma__study_scene {
    const char *name;
    koksma_scene *scene;
    char hash[24];
    int width, height;
} koksma__study_scene;

enum { KOKSMA__REFERENCE_NAME = KOKSMA_MAX_SPEC + 128, KOKSMA__PATH = 1200 };

/* A reference image and all that it depends on. */
typedef struct koksma__reference_image {
    const koksma__study_scene *scene;
    const koksma__reference *reference;
    char options[KOKSMA__VARIANT_TEXT];
    int width, height;
    koksma_image image; /* no pixels until it is needed */
} koksma__reference_image;

struct koksma_study {
    koksma__plan plan;
    char *folder;
    koksma__store *store;
    size_t n_scenes;
    koksma__study_scene *scenes;
    size_t n_references;
    koksma__reference_image *references;
};

/* The scene that the plan calls `name`. */
const koksma__study_scene *koksma__study_scene_of(const koksma_study *study, const char *name);

/* The pixels of an image block's pictures of a scene: the block's, or the scene's own. */
void koksma__block_size(const koksma__image_block *block, const koksma__study_scene *scene, int *width, int *height);

/* "name:pattern@spp x replicates": the reference's key in the store. */
void koksma__reference_name(const koksma__reference *reference, char *text);

/* The index in study->references of the reference that a variant of a block is compared with; it is added, without
   pixels, when it is not there. Errors: MEMORY. */
koksma_status koksma__reference_index(koksma_study *study, const koksma__image_block *block,
                                      const koksma__study_scene *scene, const char *variant, size_t r, size_t *index);

/* The key of a reference's standard error in the store; `name` holds its text. */
koksma__series koksma__reference_key(const koksma__reference_image *reference, char name[KOKSMA__REFERENCE_NAME]);

/* Where the reference's file is. */
void koksma__reference_path(const koksma_study *study, const koksma__reference_image *reference, char *path,
                            size_t size);

/* Whether its rows can be rendered one by one. */
koksma_status koksma__reference_rows_stand_alone(const koksma__reference_image *reference, bool *alone);

/* Renders rows of one replicate of a reference; all of them where they don't stand alone. Allocates
   out, as high as `rows`. */
koksma_status koksma__reference_replicate(const koksma__reference_image *reference, long long replicate,
                                          int first_row, int rows, const koksma_run *run, koksma_image *out);

/* Sums of replicates, added in their order: of the channels for the picture; of each pixel the mean luminance and the
   sum of the squares of what differs from it, for its error. */
typedef struct koksma__replicates {
    double *sum, *luminance, *squares; /* one array, which begins at sum */
    size_t pixels, channels;
    long long n;
} koksma__replicates;

/* How long that array is; the sums in an array of n numbers, and in a new one. */
size_t koksma__replicates_numbers(const koksma__replicates *sums);
koksma__replicates koksma__replicates_over(double *numbers, size_t n, size_t pixels);
koksma_status koksma__replicates_init(koksma__replicates *sums, size_t pixels, size_t channels);

/* Adds one; the first makes room where there is none. */
koksma_status koksma__replicates_add(koksma__replicates *sums, const koksma_image *image);

/* Their mean, and its own expected absolute error in luminance. Allocates out. */
koksma_status koksma__replicates_mean(const koksma__replicates *sums, int width, int height, koksma_image *out,
                                      double *error);

/* The mean of all replicates becomes the reference's pixels, its file, and a row of the store. Frees the sums. */
koksma_status koksma__replicates_finish(koksma__replicates *sums, koksma_study *study,
                                        koksma__reference_image *reference);

/* Reads DIR/references/…, unless the pixels are there. */
koksma_status koksma__reference_read(const koksma_study *study, koksma__reference_image *reference);

/* Whether the file is there already. */
bool koksma__reference_exists(const koksma_study *study, const koksma__reference_image *reference);

/* What a render of a study depends on beside its scene. */
typedef struct koksma__picture {
    const char *pattern, *variant;
    bool of_reference; /* only the options that change the exact image */
    long long spp;
    int width, height;
    uint64_t seed;
} koksma__picture;

/* Renders. Allocates out. */
koksma_status koksma__study_render(const koksma__study_scene *scene, const koksma__picture *picture,
                                   const koksma_run *run, koksma_image *out);

/* The seed of a job is the hash of its key. */
uint64_t koksma__job_seed(const char *format, ...) KOKSMA_PRINTF(1, 2);

#endif
