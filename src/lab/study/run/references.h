/* SPDX-License-Identifier: Apache-2.0 */
/* Reference images: their keys, files and pixels. */
#ifndef KOKSMA_STUDY_RUN_REFERENCES_H
#define KOKSMA_STUDY_RUN_REFERENCES_H

#include <koksma/image.h>
#include <koksma/study.h>

#include "study/run/study.h"

/* Sums over replicates, added in their order: for the picture the sum of each channel; for its error the mean
   luminance of each pixel and the sum of the squared deviations from that mean. */
typedef struct koksma__replicates {
    double *sum, *luminance, *squares; /* these point into one array, which begins at `sum` */
    size_t pixels, channels;
    long long n;
} koksma__replicates;

/* koksma__replicates_numbers returns the length of the array of sums. koksma__replicates_over uses a given array of n
   numbers for the sums; koksma__replicates_init allocates one and sets it to 0. */
size_t koksma__replicates_numbers(const koksma__replicates *sums);
koksma__replicates koksma__replicates_over(double *numbers, size_t n, size_t pixels);
koksma_status koksma__replicates_init(koksma__replicates *sums, size_t pixels, size_t channels);

/* Adds a replicate; the first call allocates the array if `sums` has none. */
koksma_status koksma__replicates_add(koksma__replicates *sums, const koksma_image *image);

/* The mean of the replicates, and its expected absolute error in luminance (NaN for one replicate). Allocates
   *out. */
koksma_status koksma__replicates_mean(const koksma__replicates *sums, int width, int height, koksma_image *out,
                                      double *error);

/* Writes "name:pattern@SPPxREPLICATES", which names the reference in keys of the store. */
void koksma__reference_name(const koksma__reference *reference, char *text);

/* Finds the index in study->references of reference r of a block, for one variant; adds the reference, without
   pixels, if it is missing. Errors: MEMORY. */
koksma_status koksma__reference_index(koksma_study *study, const koksma__image_block *block,
                                      const koksma__study_scene *scene, const char *variant, size_t r, size_t *index);

/* The key of a reference's row in the store; `name` holds the text that the key points to. */
koksma__series koksma__reference_key(const koksma__reference_image *reference, char name[KOKSMA__REFERENCE_NAME]);

/* The path of the reference's file. */
void koksma__reference_path(const koksma_study *study, const koksma__reference_image *reference, char *path,
                            size_t size);

/* Whether the rows of the reference can be rendered independently of each other. */
koksma_status koksma__reference_rows_stand_alone(const koksma__reference_image *reference, bool *alone);

/* Renders some rows of one replicate of a reference, or all rows if they cannot be rendered independently. Allocates
   *out, with `rows` rows. */
koksma_status koksma__reference_replicate(const koksma__reference_image *reference, long long replicate,
                                          int first_row, int rows, const koksma_run *run, koksma_image *out);

/* SHA-256 of width, height, channels and the bits of all pixels, row by row from the top, as little-endian words of
   32 bits. */
void koksma__reference_pixels(const koksma_image *image, char text[KOKSMA__SHA256_TEXT]);

/* Sets the reference's pixels to the mean of all replicates, and frees the sums; then writes the reference's file and its
   row of the store, or passes both to the study's sink. */
koksma_status koksma__replicates_finish(koksma__replicates *sums, koksma_study *study,
                                        koksma__reference_image *reference);

/* Reads the reference's file in DIR/references unless its pixels are loaded. Errors: MALFORMED (also if the pixels
   do not match the hash in the store), those of koksma_image_read. */
koksma_status koksma__reference_read(const koksma_study *study, koksma__reference_image *reference);

/* Find whether DIR/references, and the reference's file in it, exist. Errors: MALFORMED (DIR/references is a link, or no
   folder), IO (it can't be read). */
koksma_status koksma__references_folder(const koksma_study *study, bool *exists);
koksma_status koksma__reference_find(const koksma_study *study, const koksma__reference_image *reference,
                                     bool *exists);

#endif
