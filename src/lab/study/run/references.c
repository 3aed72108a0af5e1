/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reference images. Shirley (1991) used 400 jittered samples per pixel. A reference distorts the errors that are
 * measured against it unless its own error is far below them. So a plan may ask for the mean of many independent
 * renders (replicates), whose spread also gives an estimate of the reference's own error. A finished reference is a
 * file in DIR/references, named by the hash of everything it depends on, and a row of the store.
 */
#include "study/run/references.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/capacity.h"
#include "core/files.h"
#include "core/hash.h"
#include "core/status.h"
#include "image/formats.h"
#include "image/image.h"
#include "render/one_image.h"
#include "study/plan/made_by.h"
#include "study/run/study.h"

void koksma__reference_name(const koksma__reference *reference, char *text)
{
    snprintf(text, KOKSMA__REFERENCE_NAME, "%s:%s@%lldx%lld", reference->name, reference->pattern, reference->spp,
             reference->replicates);
}

static uint64_t hash_of(const koksma__reference_image *reference, const char *name)
{
    const int size[2] = {reference->width, reference->height};
    uint64_t hash = koksma__hash_more(KOKSMA__HASH_START, size, sizeof size);
    hash = koksma__hash_more(hash, reference->options, strlen(reference->options) + 1);
    hash = koksma__hash_more(hash, reference->scene->name, strlen(reference->scene->name) + 1);
    return koksma__hash_end(koksma__hash_more(hash, name, strlen(name)));
}

static bool is_same(const koksma__reference_image *at, const koksma__reference_image *wanted, const char *name)
{
    char other[KOKSMA__REFERENCE_NAME];
    if (at->hash != wanted->hash || at->scene != wanted->scene || at->width != wanted->width ||
        at->height != wanted->height || strcmp(at->options, wanted->options) != 0) {
        return false;
    }
    koksma__reference_name(at->reference, other);
    return !strcmp(name, other);
}

/* A plan may have thousands of references, and as many images for each. The bits of a reference's hash, from the lowest,
   lead from references[0] through the indices `next` down to it, or to where it is added; 0: none. */
koksma_status koksma__reference_index(koksma_study *study, const koksma__image_block *block,
                                      const koksma__study_scene *scene, const char *variant, size_t r, size_t *index)
{
    koksma__reference_image wanted = {.scene = scene, .reference = &block->references[r]};
    char name[KOKSMA__REFERENCE_NAME];
    koksma__block_size(block, scene, &wanted.width, &wanted.height);
    koksma__variant_of_reference(variant, wanted.options);
    koksma__reference_name(wanted.reference, name);
    wanted.hash = hash_of(&wanted, name);
    uint64_t bits = wanted.hash;
    size_t *link = NULL;
    for (*index = 0; *index < study->n_references && !is_same(&study->references[*index], &wanted, name);
         bits >>= 1) {
        link = &study->references[*index].next[bits & 1];
        *index = *link ? *link : study->n_references;
    }
    if (*index < study->n_references) {
        return KOKSMA_OK;
    }
    if (link) {
        *link = *index;
    }
    koksma__reference_image *added = koksma__add_one(&study->references, &study->n_references, sizeof *added);
    if (added) {
        *added = wanted;
    }
    return added ? KOKSMA_OK : KOKSMA_MEMORY;
}

koksma__series koksma__reference_key(const koksma__reference_image *reference, char name[KOKSMA__REFERENCE_NAME])
{
    koksma__reference_name(reference->reference, name);
    return (koksma__series){.kind = "image",
                            .scene = reference->scene->name,
                            .scene_hash = reference->scene->hash,
                            .options = reference->options,
                            .pattern = "",
                            .what = name,
                            .width = reference->width,
                            .height = reference->height};
}

static koksma__picture picture_of(const koksma__reference_image *reference, long long replicate)
{
    const koksma__reference *r = reference->reference;
    return (koksma__picture){.pattern = r->pattern,
                             .variant = reference->options,
                             .of_reference = true,
                             .spp = r->spp,
                             .width = reference->width,
                             .height = reference->height,
                             .seed = koksma__job_seed("reference|%s|%s|%s|%lld|%lld", reference->scene->name,
                                                      reference->scene->hash, r->pattern, r->spp, replicate)};
}

koksma_status koksma__reference_rows_stand_alone(const koksma__reference_image *reference, bool *alone)
{
    koksma__variant variant;
    const koksma__picture picture = picture_of(reference, 0);
    const koksma_status status = koksma__picture_set(reference->scene, &picture, &variant);
    *alone = !status && koksma__rows_stand_alone(&variant.render);
    return status;
}

/* References are never rendered adaptively (variants.c), so that this function can call the renderer's interface for
   single rows. */
koksma_status koksma__reference_replicate(const koksma__reference_image *reference, long long replicate,
                                          int first_row, int rows, const koksma_run *run, koksma_image *out)
{
    koksma__variant variant;
    const koksma__picture picture = picture_of(reference, replicate);
    const koksma_status status = koksma__picture_set(reference->scene, &picture, &variant);
    return status ? status : koksma__render_rows(reference->scene->scene, &variant.render, first_row, rows, run, out);
}

static bool writes_exr(void)
{
    const char *left_out = NULL, *name;
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)) && strcmp(name, "exr") != 0; i++) {
    }
    return name && !left_out;
}

/* The file's name is a hash of everything that the picture and its own error depend on. "luminance" in the hashed
   text separates these files from older ones, whose error was not of luminance. Its format is that of the file that is
   there; of a new one PFM without OpenEXR, whose pixels are the same. */
void koksma__reference_path(const koksma_study *study, const koksma__reference_image *reference, char *path,
                            size_t size)
{
    char name[KOKSMA__REFERENCE_NAME], hash[KOKSMA__HASH_TEXT];
    koksma__reference_name(reference->reference, name);
    koksma__hash_with_points(NULL, reference->scene->hash, &(koksma__row_texts){true, "", name}, hash);
    const uint64_t key = koksma__job_seed("luminance|%s|%s|%s|%s|%dx%d|%s", reference->scene->name, hash, name,
                                          reference->options, reference->width, reference->height, koksma_version());
    static const char *const ends[] = {"exr", "pfm"};
    struct stat info;
    for (int i = 0; i < 2; i++) {
        snprintf(path, size, "%s/references/%016llx.%s", study->folder, (unsigned long long)key, ends[i]);
        if (!stat(path, &info)) {
            return;
        }
    }
    snprintf(path, size, "%s/references/%016llx.%s", study->folder, (unsigned long long)key, ends[!writes_exr()]);
}

koksma_status koksma__references_folder(const koksma_study *study, bool *exists)
{
    char path[KOKSMA__PATH];
    struct stat info;
    snprintf(path, sizeof path, "%s/references", study->folder);
    *exists = !lstat(path, &info);
    KOKSMA__FAIL_IF(!*exists && errno != ENOENT, KOKSMA_IO, "%s: %s", path, strerror(errno));
    KOKSMA__FAIL_IF(*exists && !S_ISDIR(info.st_mode), KOKSMA_MALFORMED,
                    "%s: not a folder; a link is not followed here", path);
    return KOKSMA_OK;
}

koksma_status koksma__reference_find(const koksma_study *study, const koksma__reference_image *reference,
                                     bool *exists)
{
    char path[KOKSMA__PATH];
    struct stat info;
    KOKSMA__TRY(koksma__references_folder(study, exists));
    if (*exists) {
        koksma__reference_path(study, reference, path, sizeof path);
        *exists = !stat(path, &info);
        KOKSMA__FAIL_IF(!*exists && errno != ENOENT, KOKSMA_IO, "%s: can't be read: %s", path, strerror(errno));
    }
    return KOKSMA_OK;
}

void koksma__reference_pixels(const koksma_image *image, char text[KOKSMA__SHA256_TEXT])
{
    const uint32_t shape[3] = {(uint32_t)image->width, (uint32_t)image->height, (uint32_t)image->channels};
    const size_t n = (size_t)shape[0] * shape[1] * shape[2];
    koksma__sha256 hash;
    koksma__sha256_init(&hash);
    for (size_t i = 0; i < 3 + n; i++) {
        uint32_t word;
        memcpy(&word, i < 3 ? (const void *)&shape[i] : &image->pixels[i - 3], sizeof word);
        const unsigned char bytes[4] = {(unsigned char)word, (unsigned char)(word >> 8), (unsigned char)(word >> 16),
                                        (unsigned char)(word >> 24)};
        koksma__sha256_add(&hash, bytes, sizeof bytes);
    }
    koksma__sha256_finish(&hash, text);
}

/* Sets the reference's pixels to the mean of all replicates, and fills *row for the store. Frees the sums. */
static koksma_status make_pixels(koksma__replicates *s, koksma__reference_image *reference,
                                 koksma__reference_row *row)
{
    const koksma_status status =
        koksma__replicates_mean(s, reference->width, reference->height, &reference->image, &row->standard_error);
    if (!status) {
        koksma__reference_pixels(&reference->image, row->pixels);
    }
    free(s->sum);
    *s = (koksma__replicates){0};
    return status;
}

/* Writes the picture last, so that the store has a row for every picture file. */
koksma_status koksma__replicates_finish(koksma__replicates *s, koksma_study *study,
                                        koksma__reference_image *reference)
{
    char path[KOKSMA__PATH], name[KOKSMA__REFERENCE_NAME];
    koksma__reference_row row;
    koksma_status status;
    if (study->sink) {
        status = make_pixels(s, reference, &row);
        return status ? status : study->sink->put_reference(study->sink->context, reference, &row);
    }
    snprintf(path, sizeof path, "%s/references", study->folder);
    status = koksma__atomic_folder(path);
    status = status ? status : make_pixels(s, reference, &row);
    const koksma__series key = koksma__reference_key(reference, name);
    status = status ? status : koksma__store_put_reference(study->store, &key, &row);
    status = status ? status : koksma__store_commit(study->store);
    koksma__reference_path(study, reference, path, sizeof path);
    return status ? status
                  : koksma__image_write_in(study->folder, path + strlen(study->folder) + 1, &reference->image, name);
}

koksma_status koksma__reference_read(const koksma_study *study, koksma__reference_image *reference)
{
    char path[KOKSMA__PATH], name[KOKSMA__REFERENCE_NAME], pixels[KOKSMA__SHA256_TEXT];
    koksma__reference_row row;
    if (reference->image.pixels) {
        return KOKSMA_OK;
    }
    const koksma__series key = koksma__reference_key(reference, name);
    koksma__reference_path(study, reference, path, sizeof path);
    koksma_status status = koksma__store_reference(study->store, &key, &row);
    status = status ? status : koksma__image_read(path, KOKSMA__FILE_IMAGE, KOKSMA__BY_FILE, &reference->image);
    if (status || !row.pixels[0]) {
        return status;
    }
    koksma__reference_pixels(&reference->image, pixels);
    if (strcmp(pixels, row.pixels) != 0) {
        koksma_image_fini(&reference->image);
        reference->image = (koksma_image){0};
        status = koksma__fail(KOKSMA_MALFORMED,
                              "%s: the hash of its pixels shows that the study did not render them; remove the file, "
                              "and 'koksma study run' renders it again",
                              path);
    }
    return status;
}

/* ---- Sums of renders ----------------------------------------------------------------------------------- */

/* The mean of many independent renders, and its expected error. For k replicates with the sample standard deviation
   s of a pixel's luminance, a normal error of standard deviation s / sqrt k has the mean absolute value sqrt(2/pi) s
   / sqrt k. The mean of this value over the pixels is the expected absolute error of the picture itself (in
   luminance, like all errors of images: image/image.c). Squared deviations are updated by Welford's method (1962),
   so that equal replicates have a deviation of exactly 0. */

size_t koksma__replicates_numbers(const koksma__replicates *s)
{
    return s->pixels * (s->channels + 2);
}

koksma__replicates koksma__replicates_over(double *numbers, size_t n, size_t pixels)
{
    double *luminance = numbers + (n - 2 * pixels);
    return (koksma__replicates){.sum = numbers,
                                .luminance = luminance,
                                .squares = luminance + pixels,
                                .pixels = pixels,
                                .channels = n / pixels - 2};
}

koksma_status koksma__replicates_init(koksma__replicates *s, size_t pixels, size_t channels)
{
    const size_t n = koksma__replicates_numbers(&(koksma__replicates){.pixels = pixels, .channels = channels});
    double *zeros = calloc(n, sizeof *zeros);
    KOKSMA__REQUIRE_MEMORY(zeros, n * sizeof *zeros);
    *s = koksma__replicates_over(zeros, n, pixels);
    return KOKSMA_OK;
}

koksma_status koksma__replicates_add(koksma__replicates *s, const koksma_image *image)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    KOKSMA__TRY(s->sum ? KOKSMA_OK : koksma__replicates_init(s, pixels, (size_t)image->channels));
    s->n++;
    for (size_t i = 0; i < pixels * s->channels; i++) {
        s->sum[i] += (double)image->pixels[i];
    }
    for (size_t p = 0; p < pixels; p++) {
        const double y = koksma__luminance(image, p), off = y - s->luminance[p];
        s->luminance[p] += off / (double)s->n;
        s->squares[p] += off * (y - s->luminance[p]);
    }
    return KOKSMA_OK;
}

static double standard_error(const koksma__replicates *s)
{
    const double k = (double)s->n;
    double total = 0;
    for (size_t p = 0; p < s->pixels; p++) {
        total += sqrt(2 / M_PI * s->squares[p] / (k - 1) / k);
    }
    return s->n < 2 ? (double)NAN : total / (double)s->pixels;
}

koksma_status koksma__replicates_mean(const koksma__replicates *s, int width, int height, koksma_image *out,
                                      double *error)
{
    const koksma_status status = koksma_image_init(out, width, height, (int)s->channels);
    for (size_t i = 0; !status && i < s->pixels * s->channels; i++) {
        out->pixels[i] = (float)(s->sum[i] / (double)s->n);
    }
    *error = standard_error(s);
    return status;
}
