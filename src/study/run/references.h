/* SPDX-License-Identifier: Apache-2.0 */
/* Reference images: their keys, files and pixels. */
#ifndef KOKSMA_STUDY_RUN_REFERENCES_H
#define KOKSMA_STUDY_RUN_REFERENCES_H

#include <koksma/image.h>
#include <koksma/study.h>

#include "study/run/study.h"

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

/* SHA-256 of width, height, channels and the bits of all pixels, row by row from the top: words of 32 bits, lowest byte
   first. */
void koksma__reference_pixels(const koksma_image *image, char text[KOKSMA__SHA256_TEXT]);

/* The mean of all replicates becomes the reference's pixels; *row is what the store has of it. Frees the sums. */
koksma_status koksma__replicates_done(koksma__replicates *sums, koksma__reference_image *reference,
                                      koksma__reference_row *row);

/* As koksma__replicates_done; then writes the reference's file and its row of the store, or hands both to the study's
   sink. */
koksma_status koksma__replicates_finish(koksma__replicates *sums, koksma_study *study,
                                        koksma__reference_image *reference);

/* Reads DIR/references/…, unless the pixels are there. Errors: MALFORMED (also: other pixels than the store's hash
   says), those of koksma_image_read. */
koksma_status koksma__reference_read(const koksma_study *study, koksma__reference_image *reference);

/* Whether the file is there already. */
bool koksma__reference_exists(const koksma_study *study, const koksma__reference_image *reference);

#endif
