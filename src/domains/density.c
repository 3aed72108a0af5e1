/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_density: points in the unit square whose density follows an image. A candidate is a uniform point
 * in a pixel that is drawn with probability proportional to its luminance, by bisection in the running sums of the
 * luminance. Where the luminance is p times its mean, there are n p points in a unit of area, whose distances are
 * proportional to 1 / sqrt p: the unit of distance there is 1 / sqrt p.
 */
#include <koksma/density.h>

#include <math.h>
#include <stdlib.h>

#include "core/points.h"
#include "core/random.h"
#include "core/status.h"
#include "domains/choose.h"
#include "domains/density_field.h"
#include "domains/image_density.h"
#include "image/formats.h"
#include "image/image.h"

typedef koksma__image_density density;

static void draw(const void *data, uint64_t seed, uint64_t i, koksma__domain_point *point)
{
    const density *m = data;
    const size_t pixels = m->width * m->height;
    double which[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 0, which);
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 1, point->at);
    point->part = (uint32_t)koksma__domain_find(m->sums, pixels, which[0] * m->sums[pixels - 1]);
}

static void place(const void *data, const koksma__domain_point *point, double *x)
{
    koksma__image_place(data, point, x);
}

static double share(const void *data, size_t part)
{
    return koksma__image_share(data, part);
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

koksma_status koksma_generate_density(const koksma_spec *spec, uint64_t seed, const koksma_image *map,
                                      const koksma_run *run, koksma_points *out)
{
    KOKSMA__REQUIRE(spec, map, out);
    KOKSMA__REQUIRE_RUN(run);
    KOKSMA__FAIL_IF(!out->xs || !out->n, KOKSMA_ARGUMENT, "%s: it takes initialised points", __func__);
    KOKSMA__FAIL_IF(out->dim != 2, KOKSMA_DIM, "points with a density are in 2 dimensions, not %d", out->dim);
    KOKSMA__TRY(koksma__points_fit(out->n, 2));
    KOKSMA__TRY(koksma_image_check_finite(map, "the density"));
    density m = {(size_t)map->width, (size_t)map->height, NULL};
    const size_t pixels = m.width * m.height, bytes = pixels * sizeof *m.sums + out->n * sizeof(koksma__domain_point);
    m.sums = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(m.sums, bytes);
    koksma__domain_point *points = (koksma__domain_point *)(m.sums + pixels);
    const koksma__point_domain domain = {.what = "with a density",
                                         .dim = 2,
                                         .corners = 4,
                                         .torus = true,
                                         .varies = true,
                                         .area = 1,
                                         .unit = 1,
                                         .n_parts = pixels,
                                         .data = &m,
                                         .draw = draw,
                                         .place = place,
                                         .share = share,
                                         .unit_of = unit_of,
                                         .open_field = koksma__density_field_open};
    koksma_status status = sum_up(map, &m);
    status = status ? status : koksma__domain_choose(&domain, spec, seed, out->n, run, points);
    for (size_t i = 0; i < out->n && !status; i++) {
        place(&m, &points[i], out->xs + 2 * i);
    }
    free(m.sums);
    return status;
}
