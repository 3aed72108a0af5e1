/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Power spectra and correlations of masks on the torus of their pixels, by discrete Fourier transforms in O(n log n), and
 * histograms.
 *
 * The correlation c of two masks has the transform C = conj(A) B. Its even real part R and odd imaginary part I add up to
 * a real array Z, and n c(d) is the sum of the real and the imaginary part of the transform of Z at d (Hartley 1942), so
 * the forward transform of real arrays does all.
 */
#include <koksma/maskfile.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"
#include "image/fourier.h"
#include "masks/masks.h"

enum { MOST_RINGS = 1024, MOST_BINS = 1 << 16 };

static koksma_status check(const koksma_mask *m)
{
    KOKSMA__REQUIRE(m->space, m->values);
    const koksma_mask_space *space = m->space;
    return koksma__mask_check(m->width, m->height, &space, m->values);
}

static size_t pixels_of(const koksma_mask *m)
{
    return (size_t)m->width * (size_t)m->height;
}

/* Transforms number k of the pixels, less its mean, and returns the sum of its squares. values: room for as many numbers as
   pixels. */
static koksma_status transform(const koksma_mask *m, int k, double *values, double *complex, double *squares)
{
    const size_t pixels = pixels_of(m), dim = (size_t)m->space->dim;
    double mean = 0;
    *squares = 0;
    for (size_t i = 0; i < pixels; i++) {
        mean += (double)m->values[i * dim + (size_t)k] / (double)pixels;
    }
    for (size_t i = 0; i < pixels; i++) {
        values[i] = (double)m->values[i * dim + (size_t)k] - mean;
        *squares += values[i] * values[i];
    }
    return koksma__fourier_transform(m->width, m->height, values, complex);
}

/* Returns the number at frequency or offset (u, v) of a transform, whose other columns mirror those that are stored. */
static const double *entry(const koksma_mask *m, const double *complex, size_t u, size_t v, bool *mirrored)
{
    const size_t width = (size_t)m->width, height = (size_t)m->height, columns = koksma__fourier_columns(m->width);
    *mirrored = u >= columns;
    return complex + 2 * (*mirrored ? (height - v) % height * columns + width - u : v * columns + u);
}

koksma_status koksma_mask_power(const koksma_mask *mask, double *power)
{
    const koksma_mask *m = mask;
    KOKSMA__REQUIRE(mask, power);
    KOKSMA__TRY(check(m));
    const size_t pixels = pixels_of(m), frequencies = koksma__fourier_columns(m->width) * (size_t)m->height;
    double *values = malloc((pixels + 2 * frequencies) * sizeof *values), *complex = values + pixels, sum = 0;
    koksma_status status = values ? KOKSMA_OK : koksma__fail_memory((pixels + 2 * frequencies) * sizeof *values);
    memset(power, 0, pixels * sizeof *power);
    for (int k = 0; k < m->space->dim && !status; k++) {
        double squares;
        status = transform(m, k, values, complex, &squares);
        for (size_t i = 1; i < pixels && !status; i++) {
            bool mirrored;
            const double *c = entry(m, complex, i % (size_t)m->width, i / (size_t)m->width, &mirrored);
            power[i] += c[0] * c[0] + c[1] * c[1];
            sum += c[0] * c[0] + c[1] * c[1];
        }
    }
    free(values);
    KOKSMA__TRY(status);
    KOKSMA__FAIL_IF(!(sum > 0), KOKSMA_ARGUMENT, "mask: all pixels are equal: there is no spectrum");
    for (size_t i = 0; i < pixels; i++) {
        power[i] *= (double)(pixels - 1) / sum;
    }
    return KOKSMA_OK;
}

/* Returns the ring of a frequency, or `rings` above 1/2 cycle a pixel. */
static int ring_of(const koksma_mask *m, size_t u, size_t v, int rings)
{
    const double x = (double)(2 * u > (size_t)m->width ? (size_t)m->width - u : u) / m->width;
    const double y = (double)(2 * v > (size_t)m->height ? (size_t)m->height - v : v) / m->height;
    const double f = koksma__hypot(x, y) * 2 * rings;
    return f < rings ? (int)f : rings;
}

koksma_status koksma_mask_rings(const koksma_mask *mask, int rings, double *power, double *anisotropy)
{
    KOKSMA__REQUIRE(mask, power);
    KOKSMA__FAIL_IF(rings < 1 || rings > MOST_RINGS, KOKSMA_ARGUMENT, "mask: %d rings; it takes 1 to %d", rings,
                    MOST_RINGS);
    KOKSMA__TRY(check(mask));
    const size_t pixels = pixels_of(mask), bytes = pixels * sizeof(double) + (size_t)(rings + 1) * 3 * sizeof(double);
    double *all = calloc(1, bytes);
    KOKSMA__REQUIRE_MEMORY(all, bytes);
    double(*sums)[3] = (double(*)[3])(void *)(all + pixels); /* number, sum and sum of squares of each ring */
    const koksma_status status = koksma_mask_power(mask, all);
    for (size_t i = 1; i < pixels && !status; i++) {
        double *sum = sums[ring_of(mask, i % (size_t)mask->width, i / (size_t)mask->width, rings)];
        sum[0] += 1;
        sum[1] += all[i];
        sum[2] += all[i] * all[i];
    }
    for (int r = 0; r < rings && !status; r++) {
        const double mean = sums[r][1] / sums[r][0], variance = sums[r][2] / sums[r][0] - mean * mean;
        power[r] = mean;
        if (anisotropy) {
            anisotropy[r] = 10 * koksma__log10(variance / (mean * mean));
        }
    }
    free(all);
    return status;
}

/* Adds conj(A) B of one number of the pixels to Z; from and to: room for the transforms; squares: sums of squares. */
static koksma_status add_product(const koksma_mask *a, const koksma_mask *b, int k, double *values, double *from,
                                 double *to, double *z, double squares[2])
{
    const size_t width = (size_t)a->width;
    double one, other;
    KOKSMA__TRY(transform(a, k, values, from, &one));
    KOKSMA__TRY(transform(b, k, values, to, &other));
    squares[0] += one;
    squares[1] += other;
    for (size_t i = 0; i < pixels_of(a); i++) {
        bool mirrored;
        const double *p = entry(a, from, i % width, i / width, &mirrored);
        const double *q = entry(a, to, i % width, i / width, &mirrored);
        const double imaginary = p[0] * q[1] - p[1] * q[0];
        z[i] += p[0] * q[0] + p[1] * q[1] + (mirrored ? -imaginary : imaginary);
    }
    return KOKSMA_OK;
}

koksma_status koksma_mask_correlation(const koksma_mask *mask, const koksma_mask *other, double *out)
{
    KOKSMA__REQUIRE(mask, other, out);
    KOKSMA__TRY(check(mask));
    KOKSMA__TRY(check(other));
    KOKSMA__FAIL_IF(
        mask->width != other->width || mask->height != other->height || mask->space->dim != other->space->dim,
        KOKSMA_ARGUMENT, "masks of %d x %d pixels with %d numbers and of %d x %d with %d have no correlation",
        mask->width, mask->height, mask->space->dim, other->width, other->height, other->space->dim);
    const size_t pixels = pixels_of(mask), frequencies = koksma__fourier_columns(mask->width) * (size_t)mask->height;
    const size_t count = 2 * pixels + 4 * frequencies;
    double *values = calloc(count, sizeof *values), *z = values + pixels, *from = z + pixels, squares[2] = {0, 0};
    koksma_status status = values ? KOKSMA_OK : koksma__fail_memory(count * sizeof *values);
    for (int k = 0; k < mask->space->dim && !status; k++) {
        status = add_product(mask, other, k, values, from, from + 2 * frequencies, z, squares);
    }
    status = status ? status : koksma__fourier_transform(mask->width, mask->height, z, from);
    if (!status && !(squares[0] > 0 && squares[1] > 0)) {
        status = koksma__fail(KOKSMA_ARGUMENT, "mask: all pixels are equal: there is no correlation");
    }
    for (size_t i = 0; i < pixels && !status; i++) {
        bool mirrored;
        const double *c = entry(mask, from, i % (size_t)mask->width, i / (size_t)mask->width, &mirrored);
        out[i] = (c[0] + (mirrored ? -c[1] : c[1])) / ((double)pixels * sqrt(squares[0]) * sqrt(squares[1]));
    }
    free(values);
    return status;
}

koksma_status koksma_mask_histogram(const koksma_mask *mask, int bins, size_t *counts)
{
    KOKSMA__REQUIRE(mask, counts);
    KOKSMA__FAIL_IF(bins < 1 || bins > MOST_BINS, KOKSMA_ARGUMENT, "mask: %d bins; it takes 1 to %d", bins,
                    MOST_BINS);
    KOKSMA__TRY(check(mask));
    const koksma_mask_space *space = mask->space;
    const size_t dim = (size_t)space->dim;
    memset(counts, 0, dim * (size_t)bins * sizeof *counts);
    for (size_t i = 0; i < pixels_of(mask) * dim; i++) {
        const double share = ((double)mask->values[i] - space->low) / (space->high - space->low);
        counts[i % dim * (size_t)bins + (size_t)fmin(share * bins, bins - 1)]++;
    }
    return KOKSMA_OK;
}
