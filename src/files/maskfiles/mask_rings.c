/* SPDX-License-Identifier: Apache-2.0 */
/* The radial mean and the anisotropy of a mask's power spectrum (Ulichney 1988), on the torus of its pixels. */
#include <koksma/maskfile.h>

#include <math.h>
#include <stdlib.h>

#include "core/elementary.h"
#include "core/status.h"
#include "image/coherence.h"
#include "masks/masks.h"

enum { MOST_RINGS = 1024 };

/* Adds the power of one number of the pixels. values: room for as many numbers as pixels. */
static koksma_status add_power(const koksma_mask *m, int k, double *values, double *one, double *power)
{
    const size_t pixels = (size_t)m->width * (size_t)m->height, dim = (size_t)m->space->dim;
    const size_t columns = koksma__fourier_columns(m->width);
    for (size_t i = 0; i < pixels; i++) {
        values[i] = (double)m->values[i * dim + (size_t)k];
    }
    KOKSMA__TRY(koksma__fourier_power(m->width, m->height, values, one));
    for (size_t i = 0; i < columns * (size_t)m->height; i++) {
        power[i] += one[i];
    }
    return KOKSMA_OK;
}

/* Returns the ring of a frequency, or `rings` above 1/2 cycle a pixel. */
static int ring_of(const koksma_mask *m, size_t u, size_t v, int rings)
{
    const double y = (double)(2 * v > (size_t)m->height ? (size_t)m->height - v : v) / m->height;
    const double f = koksma__hypot((double)u / m->width, y) * 2 * rings;
    return f < rings ? (int)f : rings;
}

/* Sums over the frequencies; those of inner columns stand for their mirrors, too. sums: for each ring the number, sum and
   sum of squares; the last for those beyond. */
static void sum_rings(const koksma_mask *m, int rings, const double *power, double (*sums)[3])
{
    const size_t columns = koksma__fourier_columns(m->width);
    for (size_t i = 1; i < columns * (size_t)m->height; i++) {
        const size_t u = i % columns, v = i / columns;
        const double twice = u == 0 || 2 * u == (size_t)m->width ? 1 : 2;
        double *sum = sums[ring_of(m, u, v, rings)];
        sum[0] += twice;
        sum[1] += twice * power[i];
        sum[2] += twice * power[i] * power[i];
    }
}

koksma_status koksma_mask_rings(const koksma_mask *mask, int rings, double *power, double *anisotropy)
{
    const koksma_mask *m = mask;
    KOKSMA__REQUIRE(mask, power);
    KOKSMA__REQUIRE(mask->space, mask->values);
    KOKSMA__FAIL_IF(rings < 1 || rings > MOST_RINGS, KOKSMA_ARGUMENT, "mask: %d rings; it takes 1 to %d", rings,
                    MOST_RINGS);
    const koksma_mask_space *space = m->space;
    KOKSMA__TRY(koksma__mask_check(m->width, m->height, &space, m->values));
    const size_t pixels = (size_t)m->width * (size_t)m->height;
    const size_t frequencies = koksma__fourier_columns(m->width) * (size_t)m->height;
    double(*sums)[3] = calloc((size_t)rings + 1, sizeof *sums);
    double *numbers = calloc(pixels + 2 * frequencies, sizeof *numbers), *all = numbers + pixels + frequencies;
    koksma_status status = sums && numbers ? KOKSMA_OK : koksma__fail_memory(pixels * 3 * sizeof *numbers);
    for (int k = 0; k < m->space->dim && !status; k++) {
        status = add_power(m, k, numbers, numbers + pixels, all);
    }
    double count = 0, sum = 0;
    if (!status) {
        sum_rings(m, rings, all, sums);
    }
    for (int r = 0; r <= rings && !status; r++) {
        count += sums[r][0];
        sum += sums[r][1];
    }
    for (int r = 0; r < rings && !status; r++) {
        const double mean = sums[r][1] / sums[r][0], variance = sums[r][2] / sums[r][0] - mean * mean;
        power[r] = mean / (sum / count);
        if (anisotropy) {
            anisotropy[r] = 10 * koksma__log10(variance / (mean * mean));
        }
    }
    free(sums);
    free(numbers);
    return status;
}
