/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The error that a filter leaves of a mask, measured by its definition (koksma/mask.h): the indicators are filtered, test
 * by test, and the variance over the pixels is averaged over the tests. Tests are independent, so each is a block of the
 * parallel loop; their variances are added in order.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "masks/masks.h"

enum { MOST_TESTS = 65536, SEED = 1 };

typedef struct measuring {
    int width, height, dim, tests;
    const float *values;
    const koksma_mask_filter *filter;
    /* of each test: the share of pixels in it; the sums of squares of the filtered indicator, less its mean, over the
       pixels whose filter lies within the mask, and over the others */
    double *shares, *inside, *seam;
} measuring;

/* Computes the half-space of a test: a random direction, by a normally distributed vector, and a random offset. */
static void half_space(const measuring *m, size_t test, double *direction, double *offset)
{
    double u[6], least = (double)INFINITY, most = -(double)INFINITY;
    for (uint32_t lane = 0; lane < 3; lane++) {
        koksma__random_pair(SEED, KOKSMA__PURPOSE_TEST, test, lane, u + 2 * lane);
    }
    for (int k = 0; k < KOKSMA__MASK_DIM; k += 2) {
        const double radius = sqrt(-2 * koksma__log(1 - u[k]));
        koksma__cos_sin(2 * M_PI * u[k + 1], &direction[k], &direction[k + 1]);
        direction[k] *= radius;
        direction[k + 1] *= radius;
    }
    for (size_t p = 0; p < (size_t)m->width * (size_t)m->height; p++) {
        double along = 0;
        for (int k = 0; k < m->dim; k++) {
            along += direction[k] * (double)m->values[p * (size_t)m->dim + (size_t)k];
        }
        least = fmin(least, along);
        most = fmax(most, along);
    }
    *offset = least + u[4] * (most - least);
}

/* Fills `image`, whose rows have `stride` pixels, with the indicator of a test, repeated beyond the right and lower side of
   a torus. Returns the share of pixels inside. */
static double indicate(const measuring *m, size_t test, size_t columns, size_t rows, double *image)
{
    double direction[KOKSMA__MASK_DIM] = {1}, offset = ((double)test + 0.5) / m->tests, inside = 0;
    if (m->dim > 1) {
        half_space(m, test, direction, &offset);
    }
    for (size_t y = 0; y < rows; y++) {
        for (size_t x = 0; x < columns; x++) {
            const size_t p = y % (size_t)m->height * (size_t)m->width + x % (size_t)m->width;
            double along = 0;
            for (int k = 0; k < m->dim; k++) {
                along += direction[k] * (double)m->values[p * (size_t)m->dim + (size_t)k];
            }
            image[y * columns + x] = along < offset ? 1 : 0;
            inside += x < (size_t)m->width && y < (size_t)m->height && along < offset ? 1 : 0;
        }
    }
    return inside / ((double)m->width * m->height);
}

static koksma_status measure_test(void *context, size_t test)
{
    const measuring *m = context;
    const koksma_mask_filter *f = m->filter;
    const size_t width = (size_t)m->width, height = (size_t)m->height, taps = (size_t)f->width;
    const size_t columns = width + taps - 1, rows = height + (size_t)f->height - 1;
    double *image = malloc((columns * rows + width) * sizeof *image), *line = image + columns * rows;
    KOKSMA__REQUIRE_MEMORY(image, (columns * rows + width) * sizeof *image);
    m->shares[test] = indicate(m, test, columns, rows, image);
    for (size_t y = 0; y < height; y++) {
        memset(line, 0, width * sizeof *line);
        for (size_t i = 0; i < taps * (size_t)f->height; i++) {
            const double weight = f->weights[i], *from = image + (y + i / taps) * columns + i % taps;
            for (size_t x = 0; x < width; x++) {
                line[x] += weight * from[x];
            }
        }
        for (size_t x = 0; x < width; x++) {
            const double d = line[x] - m->shares[test];
            const bool wraps = x + taps > width || y + (size_t)f->height > height;
            *(wraps ? &m->seam[test] : &m->inside[test]) += d * d;
        }
    }
    free(image);
    return KOKSMA_OK;
}

typedef struct entry {
    float value;
    uint32_t pixel;
} entry;

static int ascending(const void *a, const void *b)
{
    const float x = ((const entry *)a)->value, y = ((const entry *)b)->value;
    return x < y ? -1 : x > y;
}

/* Makes the mean rank of each value, as a share of the pixels. */
static koksma_status rank(const float *values, size_t n, float *ranks)
{
    entry *sorted = malloc(n * sizeof *sorted);
    KOKSMA__REQUIRE_MEMORY(sorted, n * sizeof *sorted);
    for (size_t p = 0; p < n; p++) {
        sorted[p] = (entry){values[p], (uint32_t)p};
    }
    qsort(sorted, n, sizeof *sorted, ascending);
    for (size_t below = 0, upto; below < n; below = upto) {
        for (upto = below + 1; upto < n && !(sorted[below].value < sorted[upto].value);) {
            upto++;
        }
        for (size_t i = below; i < upto; i++) {
            ranks[sorted[i].pixel] = (float)((double)(below + upto) / 2 / (double)n);
        }
    }
    free(sorted);
    return KOKSMA_OK;
}

/* Computes the sum of squares of the weights on the torus, where those of a filter larger than the mask meet. */
static koksma_status squares_on_torus(const measuring *m, double *squares)
{
    const koksma_mask_filter *f = m->filter;
    const size_t n = (size_t)m->width * (size_t)m->height;
    double *weights = calloc(n, sizeof *weights);
    KOKSMA__REQUIRE_MEMORY(weights, n * sizeof *weights);
    for (int i = 0; i < f->width * f->height; i++) {
        weights[i / f->width % m->height * m->width + i % f->width % m->width] += f->weights[i];
    }
    *squares = 0;
    for (size_t p = 0; p < n; p++) {
        *squares += weights[p] * weights[p];
    }
    free(weights);
    return KOKSMA_OK;
}

static koksma_status measure_all(measuring *m, const koksma_run *run, koksma_mask_quality *out)
{
    KOKSMA__TRY(koksma__parallel(run, (size_t)m->tests, measure_test, m));
    const int free_x = m->width - m->filter->width + 1, free_y = m->height - m->filter->height + 1;
    const double n = (double)m->width * m->height, within = free_x > 0 && free_y > 0 ? (double)free_x * free_y : 0;
    double inside = 0, seam = 0, random = 0, squares = 0;
    KOKSMA__TRY(squares_on_torus(m, &squares));
    for (int t = 0; t < m->tests; t++) {
        inside += m->inside[t] / m->tests;
        seam += m->seam[t] / m->tests;
        random += m->shares[t] * (1 - m->shares[t]) * fmax(n * squares - 1, 0) / (n - 1);
    }
    *out = (koksma_mask_quality){sqrt((inside + seam) / n), sqrt(random / m->tests), sqrt(inside / within),
                                 sqrt(seam / (n - within))};
    return KOKSMA_OK;
}

koksma_status koksma_mask_measure(int width, int height, const koksma_mask_space *space, const float *values,
                                  const koksma_mask_filter *filter, int tests, const koksma_run *run,
                                  koksma_mask_quality *out)
{
    KOKSMA__REQUIRE(values, filter, out);
    KOKSMA__REQUIRE_RUN(run);
    koksma_mask_filter f = *filter;
    KOKSMA__TRY(koksma__mask_check(width, height, &space, values));
    KOKSMA__TRY(koksma_mask_filter_check(&f));
    KOKSMA__FAIL_IF(tests < 1 || tests > MOST_TESTS, KOKSMA_ARGUMENT, "mask: %d tests; it takes 1 to %d", tests,
                    MOST_TESTS);
    const size_t n = (size_t)width * (size_t)height;
    const bool ranked = space->dim == 1 && space->low < 0;
    double *numbers = calloc(3 * (size_t)tests, sizeof *numbers);
    float *ranks = malloc(n * sizeof *ranks);
    koksma_status status = numbers && ranks ? KOKSMA_OK : koksma__fail_memory(n * sizeof *ranks);
    status = status || !ranked ? status : rank(values, n, ranks);
    measuring m = {.width = width,
                   .height = height,
                   .dim = space->dim,
                   .tests = tests,
                   .values = ranked ? ranks : values,
                   .filter = &f,
                   .shares = numbers,
                   .inside = numbers + tests,
                   .seam = numbers + 2 * tests};
    status = status ? status : measure_all(&m, run, out);
    free(numbers);
    free(ranks);
    return status;
}
