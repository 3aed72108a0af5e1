/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The values of masks. New values of one number are (i + 1/2) / n, or their images under the inverse of a distribution;
 * those of more numbers are the points of a rank-1 lattice in [0,1)^axes (multipliers as in lattice-rank1), mapped by a
 * warp that preserves ratios of areas.
 *
 * The search swaps values that are close, so they are sorted: numbers by size, vectors by their position on a Z-order
 * curve, which neighbours in space share but for few exceptions, and those that share their position by their numbers.
 * Equal values are in the order of their pixels.
 */
#include <koksma/warp.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/random.h"
#include "core/status.h"
#include "masks/masks.h"
#include "patterns/lattices/lattices.h"

/* ---- Spaces ---------------------------------------------------------------------------------------------- */

static void map_tent(const double *u, double *v)
{
    *v = *u < 0.5 ? sqrt(2 * *u) - 1 : 1 - sqrt(2 - 2 * *u);
}

static void map_gaussian(const double *u, double *v)
{
    *v = sqrt(2.0) * koksma__inverse_erf(2 * *u - 1);
}

static void map_circle(const double *u, double *v)
{
    koksma__cos_sin(2 * M_PI * *u, &v[0], &v[1]);
}

/* A space, how many coordinates a point of the unit cube has that gives a value, and the map: of a warp, of this file, or
   none. */
typedef struct space {
    koksma_mask_space face;
    int axes;
    const char *warp;
    void (*map)(const double *u, double *v);
} space;

static const space spaces[] = {
    {{"scalar", "one number, uniform", 1, 0, 1}, 1, NULL, NULL},
    {{"tent", "one number of the density 1 - |v|", 1, -1, 1}, 1, NULL, map_tent},
    {{"gaussian", "one number, normally distributed with variance 1", 1, -6, 6}, 1, NULL, map_gaussian},
    {{"vector2", "two numbers, uniform in the square", 2, 0, 1}, 2, NULL, NULL},
    {{"vector3", "three numbers, uniform in the cube", 3, 0, 1}, 3, NULL, NULL},
    {{"vector4", "four numbers, uniform in the cube of four dimensions", 4, 0, 1}, 4, NULL, NULL},
    {{"disk", "points of the unit disk, uniform", 2, -1, 1}, 2, "concentric-disk", NULL},
    {{"circle", "unit vectors of the plane, uniform", 2, -1, 1}, 1, NULL, map_circle},
    {{"sphere", "unit vectors, uniform on the sphere", 3, -1, 1}, 2, "sphere", NULL},
    {{"hemisphere", "unit vectors with z >= 0, of density z / pi", 3, -1, 1}, 2, "cosine-hemisphere", NULL},
};

const koksma_mask_space *koksma_mask_space_at(size_t i)
{
    return i < sizeof spaces / sizeof *spaces ? &spaces[i].face : NULL;
}

const koksma_mask_space *koksma_mask_space_find(const char *name)
{
    KOKSMA__REQUIRE_OR(NULL, name);
    for (size_t i = 0; i < sizeof spaces / sizeof *spaces; i++) {
        if (!strcmp(spaces[i].face.name, name)) {
            return &spaces[i].face;
        }
    }
    return NULL;
}

koksma_status koksma__mask_check(int width, int height, const koksma_mask_space **face, const float *numbers)
{
    KOKSMA__FAIL_IF(width < KOKSMA_MASK_MIN || width > KOKSMA_MASK_MAX || height < KOKSMA_MASK_MIN ||
                        height > KOKSMA_MASK_MAX,
                    KOKSMA_ARGUMENT, "mask: a size of %d x %d; sides are %d to %d pixels", width, height,
                    KOKSMA_MASK_MIN, KOKSMA_MASK_MAX);
    *face = *face ? *face : &spaces[0].face;
    size_t row = 0;
    while (koksma_mask_space_at(row) && koksma_mask_space_at(row) != *face) {
        row++;
    }
    KOKSMA__FAIL_IF(!koksma_mask_space_at(row), KOKSMA_ARGUMENT,
                    "mask: the space is no member of the table; koksma_mask_space_find has them");
    const size_t count = numbers ? (size_t)width * (size_t)height * (size_t)(*face)->dim : 0;
    for (size_t i = 0; i < count; i++) {
        const double x = (double)numbers[i];
        const size_t pixel = i / (size_t)(*face)->dim;
        KOKSMA__FAIL_IF(!(x >= (*face)->low && x <= (*face)->high), KOKSMA_ARGUMENT,
                        "mask: pixel (%zu, %zu) has the number %.9g; those of %s are %g to %g", pixel % (size_t)width,
                        pixel / (size_t)width, x, (*face)->name, (*face)->low, (*face)->high);
    }
    return KOKSMA_OK;
}

/* ---- Order ----------------------------------------------------------------------------------------------- */

typedef struct sorted {
    uint64_t key;
    const float *numbers;
    uint32_t dim, i;
} sorted;

static int compare(const void *left, const void *right)
{
    const sorted *a = left, *b = right;
    for (uint32_t k = 0; a->key == b->key && k < a->dim; k++) {
        if (a->numbers[k] < b->numbers[k] || b->numbers[k] < a->numbers[k]) {
            return a->numbers[k] < b->numbers[k] ? -1 : 1;
        }
    }
    return a->key != b->key ? (a->key < b->key ? -1 : 1) : a->i < b->i ? -1 : 1;
}

/* Interleaves the leading binary digits of the numbers: 32 of each of 1 or 2, 21 of 3, 16 of 4. */
static uint64_t key_of(const koksma_mask_space *face, const float *numbers)
{
    static const int digits[] = {0, 32, 32, 21, 16};
    const int dim = face->dim;
    uint64_t key = 0, whole[KOKSMA__MASK_DIM];
    for (int k = 0; k < dim; k++) {
        const double u = ((double)numbers[k] - face->low) / (face->high - face->low);
        whole[k] = (uint64_t)fmin(ldexp(u, digits[dim]), ldexp(1, digits[dim]) - 1);
    }
    for (int d = digits[dim] - 1; d >= 0; d--) {
        for (int k = 0; k < dim; k++) {
            key = key << 1 | (whole[k] >> d & 1);
        }
    }
    return key;
}

/* Sorts the numbers of the pixels; v->value becomes the position of each pixel's. */
static koksma_status sort(const koksma_mask_space *face, const float *numbers, koksma__mask_values *v)
{
    const size_t dim = (size_t)face->dim;
    sorted *order = malloc(v->n * sizeof *order);
    KOKSMA__REQUIRE_MEMORY(order, v->n * sizeof *order);
    for (size_t i = 0; i < v->n; i++) {
        order[i] = (sorted){key_of(face, numbers + dim * i), numbers + dim * i, (uint32_t)dim, (uint32_t)i};
    }
    qsort(order, v->n, sizeof *order, compare);
    for (size_t i = 0; i < v->n; i++) {
        memcpy(v->numbers + dim * i, numbers + dim * order[i].i, dim * sizeof *numbers);
        v->value[order[i].i] = (uint32_t)i;
    }
    free(order);
    return KOKSMA_OK;
}

/* ---- New values ------------------------------------------------------------------------------------------ */

static koksma_status make(const koksma_mask_options *o, const koksma_run *run, size_t n, float *numbers)
{
    const space *s = (const space *)(const void *)o->space;
    const koksma_warp *warp = s->warp ? koksma_warp_find(s->warp) : NULL;
    uint64_t z[KOKSMA__MASK_DIM] = {1};
    if (s->axes > 1) {
        KOKSMA__TRY(koksma__lattice_find(run, n, s->axes, 0, NULL, 0, z));
    }
    for (size_t i = 0; i < n; i++) {
        double u[KOKSMA__MASK_DIM], v[KOKSMA__MASK_DIM];
        for (int k = 0; k < s->axes; k++) {
            u[k] = v[k] = ((double)(i * z[k] % n) + 0.5) / (double)n;
        }
        if (o->levels) {
            const size_t levels = (size_t)o->levels;
            v[0] = u[0] = ((double)(i * levels / n) + 0.5) / (double)levels;
        }
        if (warp) {
            warp->map(u, v);
        } else if (s->map) {
            s->map(u, v);
        }
        for (int k = 0; k < s->face.dim; k++) {
            numbers[i * (size_t)s->face.dim + (size_t)k] = (float)v[k];
        }
    }
    return KOKSMA_OK;
}

static koksma_status fill(const koksma_mask_options *o, const koksma_run *run, koksma__mask_values *v)
{
    const size_t dim = (size_t)o->space->dim;
    if (o->from) {
        KOKSMA__TRY(sort(o->space, o->from, v));
    } else {
        float *numbers = malloc(v->n * dim * sizeof *numbers);
        KOKSMA__REQUIRE_MEMORY(numbers, v->n * dim * sizeof *numbers);
        koksma_status status = make(o, run, v->n, numbers);
        status = status ? status : sort(o->space, numbers, v);
        free(numbers);
        KOKSMA__TRY(status);
        koksma__random_permutation(o->seed, 0, (uint32_t)v->n, v->value);
    }
    const bool mapped = dim == 1 && o->space != &spaces[0].face; /* a distribution is searched by ranks */
    for (size_t i = 0; i < v->n * dim; i++) {
        v->search[i] = mapped ? (float)(((double)i + 0.5) / (double)v->n) : v->numbers[i];
    }
    return KOKSMA_OK;
}

koksma_status koksma__mask_values_init(const koksma_mask_options *o, const koksma_run *run, koksma__mask_values *v)
{
    *v = (koksma__mask_values){.n = (size_t)o->width * (size_t)o->height, .dim = o->space->dim};
    const size_t count = v->n * (size_t)v->dim;
    v->search = malloc(count * sizeof *v->search);
    v->numbers = malloc(count * sizeof *v->numbers);
    v->value = malloc(v->n * sizeof *v->value);
    return v->search && v->numbers && v->value ? fill(o, run, v) : koksma__fail_memory(3 * count * sizeof *v->search);
}

void koksma__mask_values_fini(koksma__mask_values *v)
{
    free(v->search);
    free(v->numbers);
    free(v->value);
    *v = (koksma__mask_values){0};
}
