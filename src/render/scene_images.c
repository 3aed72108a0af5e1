/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Reads the images of a scene. A file is known by its device and inode, an image within a model by its bytes; both are
 * decoded once for each use (part, tint, orientation), however many materials name them, and a failure is remembered
 * as well. All images of a scene together may take MOST bytes or, if that is more, RATIO bytes for each byte of their
 * files: a small file may not take all memory by many names, and a scene whose files are large may have large images.
 * The sum is compared with the limit after each image, so that one image more is in memory at most. Images that fail
 * count like others, with their bytes and the pixels that they claim, although neither stays in memory: many places of
 * a model that begin the same damaged image would otherwise be decoded one after the other without end.
 */
#include "render/scene_images.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/hash.h"
#include "core/status.h"
#include "image/image.h"

enum { RATIO = 256, MOST_MIB = 2048 };
#define MOST ((uint64_t)MOST_MIB << 20)

typedef struct koksma__kept_image {
    koksma_image image;
    bool in_file; /* the image is that of a file; bytes is NULL */
    dev_t device;
    ino_t inode;
    const unsigned char *bytes; /* bytes within a model; NULL for images that the program made */
    size_t size;
    uint64_t counted; /* part of scene->image_bytes */
    koksma__image_use use;
    koksma_status status; /* of reading; `text` is the message, NULL without an error */
    char *text, remark[160];
    bool hashed, has_mean[2];
    uint64_t hash;
    double mean[2][3]; /* of the pixels, of the clamped pixels */
} entry;

/* ---- The list --------------------------------------------------------------------------------------------- */

static bool same_bytes(const entry *a, const entry *b)
{
    return a->in_file == b->in_file && a->device == b->device && a->inode == b->inode && a->bytes == b->bytes &&
           a->size == b->size && (a->in_file || a->bytes);
}

static bool same_use(const koksma__image_use *a, const koksma__image_use *b)
{
    return a->part == b->part && a->upside_down == b->upside_down && !memcmp(a->tint, b->tint, sizeof a->tint) &&
           a->average == b->average && a->border == b->border && !memcmp(a->plus, b->plus, sizeof a->plus) &&
           !memcmp(&a->gamma, &b->gamma, sizeof a->gamma);
}

/* A failure does not depend on the tint. */
static entry *find(const koksma_scene *scene, const entry *wanted)
{
    for (size_t i = 0; i < scene->n_images; i++) {
        entry *e = scene->images[i];
        if (same_bytes(e, wanted) &&
            (e->status ? e->use.part == wanted->use.part : same_use(&e->use, &wanted->use))) {
            return e;
        }
    }
    return NULL;
}

static entry *entry_of(const koksma_scene *scene, const koksma_image *image)
{
    size_t i = 0;
    while (i < scene->n_images && &scene->images[i]->image != image) {
        i++;
    }
    return i < scene->n_images ? scene->images[i] : NULL;
}

/* A place of a scene that may show an image, and how the image's hash enters the scene's: times `times`, plus `plus`. */
typedef struct shown {
    const koksma_image *image; /* or NULL */
    uint64_t times, plus;
} shown;

/* Finds place i: first those of the materials, then those of the lights. Returns false after the last one. */
static bool show(const koksma_scene *scene, size_t i, shown *out)
{
    enum { EACH = 1 + KOKSMA__N_MAPS };
    const size_t m = i / EACH, k = i % EACH, light = i - EACH * scene->n_materials;
    if (m >= scene->n_materials) {
        *out =
            light < scene->n_lights ? (shown){scene->lights[light].image, 1, scene->n_materials + light} : (shown){0};
        return light < scene->n_lights;
    }
    const koksma__material *material = &scene->materials[m];
    *out = k ? (shown){material->maps[k - 1].image, 2 * (1 + m + KOKSMA__MAX_MATERIALS * k) + 1, 0}
             : (shown){material->image, 1, m};
    return true;
}

static bool is_shown(const koksma_scene *scene, const koksma_image *image)
{
    shown s;
    for (size_t i = 0; show(scene, i, &s); i++) {
        if (s.image == image) {
            return true;
        }
    }
    return false;
}

static uint64_t bytes_of(const koksma_image *image)
{
    return (uint64_t)image->width * (uint64_t)image->height * (uint64_t)image->channels * sizeof *image->pixels;
}

/* The bytes that a new entry adds to those of the files: none if they were counted before. */
static uint64_t new_bytes(const koksma_scene *scene, const entry *new)
{
    for (size_t i = 0; i < scene->n_images; i++) {
        const entry *e = scene->images[i];
        const bool overlaps = e->bytes && new->bytes && (uintptr_t)e->bytes < (uintptr_t) new->bytes + new->size &&
                              (uintptr_t) new->bytes < (uintptr_t)e->bytes + e->size;
        if (same_bytes(e, new) || overlaps) {
            return 0;
        }
    }
    return new->size;
}

/* Adds an entry, whose image is moved into the scene. */
static koksma_status add(koksma_scene *scene, entry *from, entry **out)
{
    const uint64_t files = scene->image_file_bytes + new_bytes(scene, from), limit = RATIO * files;
    const uint64_t all = scene->image_bytes + from->counted;
    if (all > (limit > MOST ? limit : MOST)) {
        return koksma__refused(koksma__fail(KOKSMA_MALFORMED,
                                            "the images of the scene take more than %d MiB and more than %d times "
                                            "their files: use fewer or smaller ones",
                                            MOST_MIB, RATIO));
    }
    entry **place = koksma__add_one(&scene->images, &scene->n_images, sizeof *place);
    entry *e = place ? malloc(sizeof *e) : NULL;
    if (!e) {
        scene->n_images -= place != NULL;
        return koksma__fail_memory(sizeof *e);
    }
    *e = *from;
    from->image = (koksma_image){0};
    *place = *out = e;
    scene->image_bytes = all;
    scene->image_file_bytes = files;
    return KOKSMA_OK;
}

koksma_status koksma__scene_image_keep(koksma_scene *scene, koksma_image *from, koksma_image **out)
{
    entry e = {.image = *from, .counted = bytes_of(from)}, *added;
    KOKSMA__TRY(add(scene, &e, &added));
    *from = (koksma_image){0};
    *out = &added->image;
    return KOKSMA_OK;
}

void koksma__scene_image_drop(koksma_scene *scene, const koksma_image *image)
{
    size_t at = 0;
    while (at < scene->n_images && &scene->images[at]->image != image) {
        at++;
    }
    if (at < scene->n_images && !is_shown(scene, image)) {
        scene->image_bytes -= scene->images[at]->counted;
        koksma_image_fini(&scene->images[at]->image);
        KOKSMA__FREE(scene->images[at]->text, scene->images[at]);
        scene->images[at] = scene->images[--scene->n_images];
    }
}

void koksma__scene_images_fini(koksma_scene *scene)
{
    for (size_t i = 0; i < scene->n_images; i++) {
        koksma_image_fini(&scene->images[i]->image);
        KOKSMA__FREE(scene->images[i]->text, scene->images[i]);
    }
    free(scene->images);
}

/* ---- Reading ---------------------------------------------------------------------------------------------- */

static bool is_grey(const double colour[3])
{
    return colour[0] == colour[1] && colour[0] == colour[2];
}

/* Applies gamma, and makes one channel of three. */
static void change_levels(koksma_image *image, const koksma__image_use *use)
{
    const size_t n = (size_t)image->width * (size_t)image->height, channels = (size_t)image->channels;
    for (size_t i = 0; use->gamma > 0 && i < n * channels; i++) {
        image->pixels[i] = (float)koksma__pow(fmax((double)image->pixels[i], 0), use->gamma);
    }
    for (size_t i = 0; use->average && channels == 3 && i < n; i++) {
        const float *from = image->pixels + 3 * i;
        image->pixels[i] =
            (float)(use->average == KOKSMA__LUMINANCE ? koksma__luminance(image, i)
                                                      : ((double)from[0] + (double)from[1] + (double)from[2]) / 3);
    }
    image->channels = use->average ? 1 : image->channels;
}

/* Multiplies the pixels by a colour and adds another; a grey image becomes a colour image if necessary. */
static koksma_status tint(koksma_image *image, const koksma__image_use *use)
{
    const double *colour = use->tint, *plus = use->plus;
    const size_t n = (size_t)image->width * (size_t)image->height;
    const bool adds = plus[0] != 0 || plus[1] != 0 || plus[2] != 0;
    if (is_grey(colour) && colour[0] == 1 && !adds) {
        return KOKSMA_OK;
    }
    koksma_image grey = *image;
    if (grey.channels == 1 && !(is_grey(colour) && is_grey(plus))) {
        const koksma_status status = koksma_image_init(image, grey.width, grey.height, 3);
        for (size_t i = 0; !status && i < 3 * n; i++) {
            image->pixels[i] = grey.pixels[i / 3];
        }
        koksma_image_fini(&grey);
        if (status) {
            return status;
        }
    }
    const size_t channels = (size_t)image->channels;
    for (size_t i = 0; i < n * channels; i++) {
        const double value = (double)image->pixels[i] * colour[i % channels] + plus[i % channels];
        image->pixels[i] = (float)(adds ? fmax(value, 0) : value);
    }
    return KOKSMA_OK;
}

/* Puts a frame around the image whose pixels are what black became. */
static koksma_status add_border(koksma_image *image, const koksma__image_use *use)
{
    const koksma_image inner = *image;
    const size_t width = (size_t)inner.width, channels = (size_t)inner.channels, row = (width + 2) * channels;
    KOKSMA__FAIL_IF(inner.width > KOKSMA_MAX_IMAGE_SIDE - 2 || inner.height > KOKSMA_MAX_IMAGE_SIDE - 2,
                    KOKSMA_MALFORMED, "%d x %d pixels leave no room for a black border", inner.width, inner.height);
    KOKSMA__TRY(koksma_image_init(image, inner.width + 2, inner.height + 2, inner.channels));
    for (size_t i = 0; i < row * ((size_t)inner.height + 2); i++) {
        image->pixels[i] = (float)fmax(use->plus[i % channels], 0);
    }
    for (size_t y = 0; y < (size_t)inner.height; y++) {
        memcpy(image->pixels + (y + 1) * row + channels, inner.pixels + y * width * channels,
               width * channels * sizeof *inner.pixels);
    }
    free(inner.pixels);
    return KOKSMA_OK;
}

static void swap_rows(koksma_image *image)
{
    const size_t row = (size_t)image->width * (size_t)image->channels, height = (size_t)image->height;
    for (size_t y = 0; y < height / 2; y++) {
        float *a = image->pixels + y * row, *b = image->pixels + (height - 1 - y) * row;
        for (size_t i = 0; i < row; i++) {
            const float kept = a[i];
            a[i] = b[i];
            b[i] = kept;
        }
    }
}

static koksma_status decode(entry *e, const char *name, const unsigned char *bytes, size_t size)
{
    koksma_status status = koksma__image_read_part(bytes, size, e->use.part, &e->image);
    if (status) {
        return koksma__fail_in(status, name);
    }
    if (!e->image.pixels) {
        return KOKSMA_OK;
    }
    if (*koksma_image_remark()) {
        snprintf(e->remark, sizeof e->remark, "%s", koksma_image_remark());
    }
    status = koksma__image_check(&e->image, name);
    if (!status) {
        change_levels(&e->image, &e->use);
    }
    status = status ? status : tint(&e->image, &e->use);
    if (!status && e->use.upside_down) {
        swap_rows(&e->image);
    }
    return status || !e->use.border ? status : add_border(&e->image, &e->use);
}

/* Reads the image of the entry, or finds it. Failures that another attempt would repeat are kept. */
static koksma_status read_or_find(koksma_scene *scene, const char *name, entry *new, koksma_image **out)
{
    entry *e = find(scene, new);
    *out = NULL;
    if (!e) {
        unsigned char *read = NULL;
        size_t size = new->size;
        koksma_status status = new->in_file ? koksma__read_file(name, KOKSMA__FILE_TEXTURE, KOKSMA__BY_FILE,
                                                                koksma__image_check_start, &read, &size)
                                            : KOKSMA_OK;
        new->size = size;
        status = status ? status : decode(new, name, new->in_file ? read : new->bytes, size);
        free(read);
        new->counted = bytes_of(&new->image) + (status ? size : 0);
        if (status) {
            koksma_image_fini(&new->image);
        }
        if (status && (koksma__is_refused() || (status != KOKSMA_MALFORMED && status != KOKSMA_UNSUPPORTED))) {
            return status;
        }
        new->status = status;
        new->text = status ? strdup(koksma_error_text()) : NULL;
        status = status && !new->text ? koksma__fail_memory(1) : add(scene, new, &e);
        status = status || !*new->remark
                     ? status
                     : koksma__unknown_put(&scene->unknown, &scene->n_unknown, name, 1, new->remark);
        if (status) {
            free(new->text);
            koksma_image_fini(&new->image);
            return koksma__fail_in(status, name);
        }
    }
    *out = e->status ? NULL : &e->image;
    return e->status ? koksma__fail(e->status, "%s", e->text) : KOKSMA_OK;
}

koksma_status koksma__scene_image(koksma_scene *scene, const char *path, const koksma__image_use *use,
                                  koksma_image **out)
{
    entry new = {.in_file = true, .use = *use};
    struct stat about;
    if (!stat(path, &about)) { /* if it fails, reading says why */
        new.device = about.st_dev;
        new.inode = about.st_ino;
        new.size = (size_t)about.st_size;
    }
    return read_or_find(scene, path, &new, out);
}

koksma_status koksma__scene_image_within(koksma_scene *scene, const char *name, const unsigned char *bytes,
                                         size_t size, const koksma__image_use *use, koksma_image **out)
{
    entry new = {.bytes = bytes, .size = size, .use = *use};
    return read_or_find(scene, name, &new, out);
}

/* ---- What follows from the pixels -------------------------------------------------------------------------- */

void koksma__scene_image_mean(const koksma_scene *scene, const koksma_image *image, bool clamped, double mean[3])
{
    entry *e = entry_of(scene, image);
    const size_t n = (size_t)image->width * (size_t)image->height, channels = (size_t)image->channels;
    for (size_t k = 0; k < 3 && !e->has_mean[clamped]; k++) {
        double sum = 0;
        for (size_t i = 0; i < n; i++) {
            const double value = (double)image->pixels[i * channels + k % channels];
            sum += value > 0 ? fmin(value, clamped ? 1 : INFINITY) : 0;
        }
        e->mean[clamped][k] = sum / (double)n;
    }
    e->has_mean[clamped] = true;
    memcpy(mean, e->mean[clamped], sizeof e->mean[clamped]);
}

static uint64_t hash_of(entry *e)
{
    if (!e->hashed) {
        const koksma_image *m = &e->image;
        const uint64_t parts[4] = {koksma__hash(m->pixels, bytes_of(m)), (uint64_t)m->width, (uint64_t)m->height,
                                   (uint64_t)m->channels};
        e->hash = koksma__hash(parts, sizeof parts);
        e->hashed = true;
    }
    return e->hash;
}

/* The XOR of sums alone would often stay the same when two images are exchanged or change alike: a ^ (a + 1) is 1 for
   every even a. It stays beside the hash of the order, which covers files alone. The bytes of an image within a
   model are in the model's hash. */
uint64_t koksma__scene_images_hash(const koksma_scene *scene)
{
    uint64_t hash = 0, order = 0;
    size_t n = 0;
    shown s;
    for (size_t i = 0; show(scene, i, &s); i++) {
        entry *e = s.image ? entry_of(scene, s.image) : NULL;
        hash ^= e ? hash_of(e) * s.times + s.plus : 0;
        if (e && s.times == 1 && !e->bytes) {
            const uint64_t parts[3] = {order, hash_of(e), i};
            order = koksma__hash(parts, sizeof parts);
            n++;
        }
    }
    hash ^= n > 1 ? order : 0;
    for (size_t i = 0; i < scene->n_images; i++) {
        const bool left = scene->images[i]->image.pixels && !is_shown(scene, &scene->images[i]->image);
        const uint64_t parts[2] = {left ? hash_of(scene->images[i]) : 0, i};
        hash ^= left ? koksma__hash(parts, sizeof parts) : 0;
    }
    return hash;
}
