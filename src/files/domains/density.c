/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_density and koksma_generate_rectangle: points in a rectangle, whose density may follow an image. A
 * candidate is a uniform point in a pixel that is drawn with probability proportional to its luminance, by bisection in
 * the running sums of the luminance. Where the luminance is p times its mean, distances are proportional to 1 / sqrt p:
 * the unit of distance there is 1 / sqrt p. A rectangle without an image is one of equal pixels that are about square.
 *
 * Positions of choose.c are in [0,1)^2; `lengths` makes distances those of the rectangle, in units of its height.
 */
#include <koksma/density.h>

#include <math.h>
#include <stdlib.h>

#include "core/capacity.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/random.h"
#include "core/status.h"
#include "core/vector.h"
#include "domains/domain.h"
#include "image/image.h"
#include "patterns/grids/grids.h"

/* A density on a rectangle, in coordinates of [0,1)^2, that an image gives: it is constant in each pixel, in proportion to
   the luminance of the pixel. Pixels are numbered row by row, the top row first. */
typedef struct density {
    size_t width, height;
    double *sums; /* sums[i]: the summed luminance of pixels 0 to i */
} density;

/* Returns the luminance of a pixel. */
static double share(const void *data, size_t pixel)
{
    const density *m = data;
    return m->sums[pixel] - (pixel ? m->sums[pixel - 1] : 0);
}

static void place(const void *data, const koksma__domain_point *point, double *x)
{
    const density *m = data;
    x[0] = koksma__in_cell((double)(point->part % m->width), point->at[0], (double)m->width);
    x[1] = koksma__in_cell((double)(m->height - 1 - point->part / m->width), point->at[1], (double)m->height);
}

enum { LONGEST = 10000 };

static void draw(const void *data, uint64_t seed, uint64_t i, koksma__domain_point *point)
{
    const density *m = data;
    const size_t pixels = m->width * m->height;
    double which[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 0, which);
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 1, point->at);
    point->part = (uint32_t)koksma__domain_find(m->sums, pixels, which[0] * m->sums[pixels - 1]);
}

static double unit_of(const void *data, size_t part)
{
    const density *m = data;
    const size_t pixels = m->width * m->height;
    return sqrt(m->sums[pixels - 1] / ((double)pixels * share(data, part)));
}

static koksma_status sum_up(const koksma_image *map, density *m)
{
    double sum = 0;
    for (size_t i = 0; i < m->width * m->height; i++) {
        const double value = koksma__luminance(map, i);
        KOKSMA__FAIL_IF(!(value >= 0), KOKSMA_MALFORMED,
                        "the density has a negative value in pixel (%zu, %zu); 0 or more would do", i % m->width,
                        i / m->width);
        m->sums[i] = sum += value;
    }
    KOKSMA__FAIL_IF(!(sum > 0), KOKSMA_MALFORMED, "the density is 0 everywhere");
    return KOKSMA_OK;
}

/* Makes the pixels of a rectangle without an image. */
static void make_even(density *m)
{
    for (size_t i = 0; i < m->width * m->height; i++) {
        m->sums[i] = (double)(i + 1);
    }
}

/* Makes points of a rectangle and writes them to `out`, with the sides `scale`. */
static koksma_status choose(const koksma__point_domain *domain, const koksma_spec *spec, uint64_t seed,
                            const double scale[2], const koksma_run *run, koksma_points *out)
{
    koksma__domain_point *points = NULL;
    koksma_status status = koksma__domain_choose(domain, spec, seed, run, out->n, &points);
    for (size_t i = 0; i < out->n && !status; i++) {
        double *x = out->xs + 2 * i;
        place(domain->data, &points[i], x);
        x[0] *= scale[0];
        x[1] *= scale[1];
    }
    free(points);
    return status;
}

/* Makes points in a rectangle of the sides `size`, with the density `map`, which may be NULL. The coordinates are written
   in units of the sides over `scale`. */
static koksma_status generate(const koksma_spec *spec, uint64_t seed, const double size[2], const koksma_image *map,
                              const double scale[2], const koksma_run *run, koksma_points *out)
{
    const double ratio = size[0] / size[1];
    density m = {1, 1, NULL};
    if (map) {
        m.width = (size_t)map->width;
        m.height = (size_t)map->height;
    } else {
        m.width = (size_t)fmax(round(ratio), 1);
        m.height = (size_t)fmax(round(1 / ratio), 1);
    }
    const size_t pixels = m.width * m.height;
    m.sums = malloc(pixels * sizeof *m.sums);
    KOKSMA__REQUIRE_MEMORY(m.sums, pixels * sizeof *m.sums);
    const koksma__point_domain domain = {.what = map ? "with a density" : "in a rectangle",
                                         .dim = 2,
                                         .lengths = {ratio, 1, 1},
                                         .torus = true,
                                         .varies = map != NULL,
                                         .area = ratio,
                                         .data = &m,
                                         .draw = draw,
                                         .place = place,
                                         .unit_of = unit_of};
    koksma_status status = KOKSMA_OK;
    if (map) {
        status = sum_up(map, &m);
    } else {
        make_even(&m);
    }
    status = status ? status : choose(&domain, spec, seed, scale, run, out);
    free(m.sums);
    return status;
}

/* Checks where the points are to be written. */
static koksma_status check_points(const char *caller, const koksma_points *out)
{
    KOKSMA__FAIL_IF(!out->xs || !out->n, KOKSMA_ARGUMENT, "%s: it takes initialised points", caller);
    KOKSMA__FAIL_IF(out->dim != 2, KOKSMA_DIM, "points in a rectangle or with a density are in 2 dimensions, not %d",
                    out->dim);
    return koksma__points_fit(out->n, 2);
}

koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                      const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, map, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check_points(__func__, out));
    KOKSMA__TRY(koksma_image_check_finite(map, "the density"));
    const double size[2] = {(double)map->width / (double)map->height, 1}, scale[2] = {1, 1};
    return generate(spec, seed, size, map, scale, run, out);
}

koksma_status koksma_generate_rectangle(const koksma_spec *spec, uint64_t seed, double width, double height,
                                        const koksma_image *map, const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__TRY(check_points(__func__, out));
    const double least = fmin(width, height), most = fmax(width, height);
    KOKSMA__FAIL_IF(!(width > 0 && height > 0 && least >= 1e-100 && most <= 1e100 && most <= LONGEST * least),
                    KOKSMA_ARGUMENT,
                    "a rectangle of %g x %g: width and height are above 0, and one is at most %d times the other",
                    width, height, LONGEST);
    KOKSMA__TRY(map ? koksma_image_check_finite(map, "the density") : KOKSMA_OK);
    const double size[2] = {width, height};
    return generate(spec, seed, size, map, size, run, out);
}
