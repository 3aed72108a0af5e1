/* SPDX-License-Identifier: Apache-2.0 */
/*
 * koksma_generate_density: points in the unit square whose density follows an image. A candidate is a uniform point
 * in a pixel that is drawn with probability proportional to its luminance, by bisection in the running sums of the
 * luminance. Where the luminance is p times its mean, there are n p points in a unit of area, whose distances are
 * proportional to 1 / sqrt p: this is the unit of distance there.
 */
#include <koksma/density.h>

#include <math.h>
#include <stdlib.h>

#include "core/points_io.h"
#include "core/random.h"
#include "core/status.h"
#include "domains/choose.h"
#include "image/formats.h"
#include "patterns/shared/cells.h"

typedef struct density {
    size_t width, height;
    double *sums; /* entry i: the summed luminance of pixels 0 to i */
} density;

static void draw(const void *data, uint64_t seed, uint64_t i, double *x, double *unit)
{
    const density *m = data;
    const size_t pixels = m->width * m->height;
    double which[2], within[2];
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 0, which);
    koksma__random_pair(seed, KOKSMA__PURPOSE_DART, i, 1, within);
    const size_t pixel = koksma__domain_find(m->sums, pixels, which[0] * m->sums[pixels - 1]);
    const double value = m->sums[pixel] - (pixel ? m->sums[pixel - 1] : 0);
    x[0] = koksma__in_cell((double)(pixel % m->width), within[0], (double)m->width);
    x[1] = koksma__in_cell((double)(m->height - 1 - pixel / m->width), within[1], (double)m->height);
    *unit = sqrt(m->sums[pixels - 1] / ((double)pixels * value));
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
    const size_t bytes = m.width * m.height * sizeof *m.sums + out->n * sizeof(uint64_t);
    m.sums = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(m.sums, bytes);
    uint64_t *chosen = (uint64_t *)(m.sums + m.width * m.height);
    const koksma__point_domain domain = {.what = "with a density",
                                         .dim = 2,
                                         .torus = true,
                                         .varies = true,
                                         .area = 1,
                                         .unit = 1,
                                         .data = &m,
                                         .draw = draw};
    koksma_status status = sum_up(map, &m);
    status = status ? status : koksma__domain_choose(&domain, spec, seed, out->n, run, chosen);
    for (size_t i = 0; i < out->n && !status; i++) {
        double unit;
        draw(&m, seed, chosen[i], out->xs + 2 * i, &unit);
    }
    free(m.sums);
    return status;
}
