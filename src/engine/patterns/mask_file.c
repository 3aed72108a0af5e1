/* SPDX-License-Identifier: Apache-2.0 */
/*
 * mask-file: the points of all pixels of a tile, pixel after pixel, by a mask that `koksma mask` or another program made:
 * an .npy file of shape (height, width) or (height, width, numbers). The seed shifts the mask on the torus by whole
 * pixels.
 *
 *     1 number a pixel    the ranks of three copies of the mask, each with its own shift, vary a (0,2)-sequence as in
 *                         mask-offset, for any number of samples a pixel
 *     2 numbers           a number each in [0,1): the pixel's one sample
 *     2, some below 0     points of the unit disk (the space disk of koksma_mask_optimise): the pixel's one sample is the
 *                         point of the square that the warp concentric-disk maps there
 *     3 numbers           their ranks vary the sequence
 *     3, all unit vectors with z >= 0 (the space hemisphere): the pixel's one sample is the point that the warp
 *                         cosine-hemisphere maps there, as renderers do for diffuse reflection and ambient occlusion
 *     4 numbers           a number each in [0,1): the pixel's one sample, of four coordinates
 *
 * Unit vectors of the circle and of the whole sphere (the spaces circle and sphere) are refused.
 *
 * A rank is a number's position in the sorted list of all numbers of its kind; equal numbers are in the order of the
 * pixels. The renderer repeats the tile over the image.
 *
 * Sources: Georgiev & Fajardo 2016, Donnelly et al. 2024 (masks for a filter); the sequence is mask-offset's.
 */
#include <koksma/mask.h>

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/point_files.h"
#include "core/random.h"
#include "core/status.h"
#include "patterns/masks/mask_tile.h"
#include "patterns/patterns.h"

typedef struct mask {
    size_t width, height, numbers;
    float *values;
} mask;

/* How far from 1 the square of the length of a unit vector may be: levels of 8 bits are off by 1/256 of the range. */
static const double LENGTH = 0.03;

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

/* Returns whether all pixels have unit vectors. */
static bool are_unit(const mask *m)
{
    bool unit = true;
    for (size_t p = 0; p < m->width * m->height && unit; p++) {
        double square = 0;
        for (size_t k = 0; k < m->numbers; k++) {
            square += (double)m->values[p * m->numbers + k] * (double)m->values[p * m->numbers + k];
        }
        unit = fabs(square - 1) < LENGTH;
    }
    return unit;
}

/* Returns whether the last number of a pixel, or one of the others, is below 0: points of the unit disk, not of the unit
   square; with `last` alone, directions below the horizon. */
static bool are_negative(const mask *m, bool last)
{
    bool negative = false;
    for (size_t i = 0; i < m->numbers * m->width * m->height; i++) {
        negative |= m->values[i] < 0 && (!last || (i + 1) % m->numbers == 0);
    }
    return negative;
}

/* Fails for directions that no map of the square to directions of the renderer gives. */
static koksma_status check_directions(const char *path, const mask *m, bool unit)
{
    KOKSMA__FAIL_IF(unit && m->numbers == 2 && are_negative(m, false), KOKSMA_MALFORMED,
                    "mask-file:%s: directions on the circle are no samples of a square; points of the disk (mask "
                    "--space disk) would do",
                    path);
    KOKSMA__FAIL_IF(unit && m->numbers == 3 && are_negative(m, true), KOKSMA_MALFORMED,
                    "mask-file:%s: directions on the whole sphere are no samples of a square; those of a hemisphere, "
                    "z >= 0 (mask --space hemisphere), would do",
                    path);
    return KOKSMA_OK;
}

/* Makes the point of the square that the concentric map sends to a point of the unit disk (its inverse: a = r and b = r (4
   / pi) angle in the quarter about the x axis, and likewise in the others). */
static void unmap_concentric(double x, double y, double u[2])
{
    const bool wide = fabs(x) > fabs(y);
    const double r = fmin(koksma__hypot(x, y), 1), a = copysign(r, wide ? x : y);
    const double b = r > 0 ? a * (4 / M_PI) * koksma__atan(wide ? y / x : x / y) : 0;
    u[wide ? 0 : 1] = (a + 1) / 2;
    u[wide ? 1 : 0] = (b + 1) / 2;
    for (int k = 0; k < 2; k++) {
        u[k] = fmin(u[k], 1 - 0x1p-24); /* a point on the rim; the largest float below 1 */
    }
}

/* Copies the vectors of the pixels, whose numbers are the sample's. */
static koksma_status copy_vectors(const char *path, const mask *m, uint64_t seed, koksma_points *out)
{
    const size_t pixels = m->width * m->height, dim = m->numbers;
    for (size_t i = 0; i < pixels * dim; i++) {
        const double x = (double)m->values[shifted(m, seed, 0, i / dim) * dim + i % dim];
        KOKSMA__FAIL_IF(!(x >= 0 && x < 1), KOKSMA_MALFORMED,
                        "mask-file:%s: a pixel has the number %.9g; samples are in [0,1)", path, x);
        out->xs[i] = x;
    }
    return KOKSMA_OK;
}

/* Makes the one sample of each pixel of a mask of points or directions. */
static koksma_status fill_vectors(const char *path, const mask *m, uint64_t seed, koksma_points *out)
{
    const size_t pixels = m->width * m->height;
    const bool round = m->numbers == 3 || (m->numbers == 2 && are_negative(m, false));
    KOKSMA__TRY(koksma__tile_check("mask-file", pixels, true, out));
    if (!round) {
        return copy_vectors(path, m, seed, out);
    }
    for (size_t p = 0; p < pixels; p++) {
        const float *v = m->values + m->numbers * shifted(m, seed, 0, p);
        const double x = (double)v[0], y = (double)v[1];
        const double length = m->numbers == 3 ? sqrt(x * x + y * y + (double)v[2] * (double)v[2]) : 1;
        KOKSMA__FAIL_IF(!(x * x + y * y <= length * length * (1 + LENGTH)), KOKSMA_MALFORMED,
                        "mask-file:%s: a pixel has the vector (%.9g, %.9g); samples are in [0,1), points of a disk "
                        "within a radius of 1",
                        path, x, y);
        unmap_concentric(x / length, y / length, out->xs + 2 * p);
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
    const bool unit = (m->numbers == 2 || m->numbers == 3) && are_unit(m);
    const int dim = m->numbers == 4 ? 4 : 2;
    KOKSMA__FAIL_IF(out->dim != dim, KOKSMA_DIM,
                    "mask-file:%s: %zu numbers a pixel are samples of %d dimensions, not %d%s", args->path,
                    m->numbers, dim, out->dim,
                    out->dim == 4 ? "; a mask of 4 numbers (mask --space vector4) would do" : "");
    KOKSMA__TRY(check_directions(args->path, m, unit));
    if (m->numbers == 2 || m->numbers == 4 || unit) {
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
    const koksma_status status = fill(&m, seed, args, out);
    free(values);
    return status;
}

const koksma_pattern koksma__pattern_mask_file = {
    .name = "mask-file",
    .title = "samples of the pixels of a tile by a mask: mask-file:PATH (.npy of shape (height, width[, numbers]))",
    .cite = "georgiev2016 laine2011 burley2020",
    .min_dim = 2,
    .max_dim = 4,
    .generate = generate,
    .revision = 1, /* unit vectors and points of the disk are samples */
    .operand = "PATH",
};
