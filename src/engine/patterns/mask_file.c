/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mask-file: the points of all pixels of a tile, pixel after pixel, by a mask that `koksma mask` or another program made:
 * an .npy file of shape (height, width) or (height, width, numbers). The seed shifts the mask on the torus by whole
 * pixels.
 *
 *     1 number a pixel    the ranks of three copies of the mask, each with its own shift, vary a (0,2)-sequence as in
 *                         mask-offset, for any number of samples a pixel
 *     2 numbers           a number each in [0,1): the pixel's one sample
 *     3 numbers           their ranks vary the sequence
 *
 * A rank is a number's position in the sorted list of all numbers of its kind; equal numbers are in the order of the
 * pixels. The renderer repeats the tile over the image.
 *
 * Sources: Georgiev & Fajardo 2016, Donnelly et al. 2024 (masks for a filter); the sequence is mask-offset's.
 */
#include <koksma/mask.h>

#include <stdlib.h>

#include "core/points_io.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/masks/mask_tile.h"
#include "patterns/patterns.h"

typedef struct mask {
    size_t width, height, numbers;
    float *values;
} mask;

typedef struct entry {
    float value;
    uint32_t pixel;
} entry;

static int compare(const void *left, const void *right)
{
    const entry *a = left, *b = right;
    return a->value < b->value ? -1 : a->value > b->value ? 1 : a->pixel < b->pixel ? -1 : 1;
}

/* Returns the pixel of the mask that a pixel of the tile takes under shift k of a seed. */
static size_t shifted(const mask *m, uint64_t seed, uint32_t k, size_t pixel)
{
    const koksma__words r = koksma__random(seed, KOKSMA__PURPOSE_SHIFT, k, 0);
    const size_t x = (pixel % m->width + koksma__below(r.w[0], (uint32_t)m->width)) % m->width;
    const size_t y = (pixel / m->width + koksma__below(r.w[1], (uint32_t)m->height)) % m->height;
    return y * m->width + x;
}

/* Computes the ranks of the three masks. sorted: room for as many entries as pixels. */
static void rank(const mask *m, uint64_t seed, entry *sorted, uint32_t *ranks)
{
    const size_t pixels = m->width * m->height;
    for (uint32_t k = 0; k < KOKSMA__TILE_MASKS; k++) {
        const size_t number = m->numbers == 1 ? 0 : k;
        uint32_t *own = ranks + k * pixels;
        for (size_t p = 0; p < pixels; p++) {
            sorted[p] =
                (entry){m->values[shifted(m, seed, m->numbers == 1 ? k : 0, p) * m->numbers + number], (uint32_t)p};
        }
        qsort(sorted, pixels, sizeof *sorted, compare);
        for (size_t i = 0; i < pixels; i++) {
            own[sorted[i].pixel] = (uint32_t)i;
        }
    }
}

static koksma_status fill_vectors(const char *path, const mask *m, uint64_t seed, koksma_points *out)
{
    const size_t pixels = m->width * m->height;
    KOKSMA__TRY(koksma__tile_check("mask-file", pixels, true, out));
    for (size_t p = 0; p < pixels; p++) {
        const float *v = m->values + 2 * shifted(m, seed, 0, p);
        KOKSMA__FAIL_IF(!(v[0] >= 0 && v[0] < 1 && v[1] >= 0 && v[1] < 1), KOKSMA_MALFORMED,
                        "mask-file:%s: a pixel has the vector (%.9g, %.9g); samples are in [0,1)", path, (double)v[0],
                        (double)v[1]);
        out->xs[2 * p] = (double)v[0];
        out->xs[2 * p + 1] = (double)v[1];
    }
    return KOKSMA_OK;
}

static koksma_status fill(const mask *m, uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const size_t pixels = m->width * m->height;
    for (size_t i = 0; i < pixels * m->numbers; i++) {
        KOKSMA__FAIL_IF(!(m->values[i] >= -1e30f && m->values[i] <= 1e30f), KOKSMA_MALFORMED,
                        "mask-file:%s: number %zu is not finite", args->path, i);
    }
    if (m->numbers == 2) {
        return fill_vectors(args->path, m, seed, out);
    }
    KOKSMA__TRY(koksma__tile_check("mask-file", pixels, false, out));
    const size_t bytes = pixels * (sizeof(entry) + KOKSMA__TILE_MASKS * sizeof(uint32_t));
    entry *sorted = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(sorted, bytes);
    uint32_t *ranks = (uint32_t *)(sorted + pixels);
    rank(m, seed, sorted, ranks);
    const koksma_status status = koksma__tile_fill(seed, args->run, pixels, ranks, out);
    free(sorted);
    return status;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    size_t shape[3];
    float *values;
    KOKSMA__TRY(koksma__npy_read_mask(args->path, KOKSMA__BY_FILE, KOKSMA_MASK_MAX, shape, &values));
    const mask m = {shape[1], shape[0], shape[2], values};
    const koksma_status status =
        m.numbers == 4
            ? koksma__fail(KOKSMA_MALFORMED, "mask-file:%s: 4 numbers a pixel; 1 to 3 would do", args->path)
            : fill(&m, seed, args, out);
    free(values);
    return status;
}

const koksma_pattern koksma__pattern_mask_file = {
    .name = "mask-file",
    .title = "samples of the pixels of a tile by a mask: mask-file:PATH (.npy of shape (height, width[, numbers]))",
    .cite = "georgiev2016 laine2011 burley2020",
    .min_dim = 2,
    .max_dim = 2,
    .generate = generate,
    .operand = "PATH",
};
