/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What Ulichney states of the spectra of blue noise (Dithering with Blue Noise, 1988; the void-and-cluster method, 1993,
 * aims at it), counted in void-and-cluster masks, of pixels and of voxels. A mask with a share g of its pixels set has
 *     the principal frequency sqrt(g) cycles a pixel (the cube root of g in space and time), at which the radial mean of
 *     the power has its peak; for g > 1/2 the pixels that are not set are the points: sqrt(1 - g)
 *     little power at lower frequencies, and constant power at higher ones
 *     no direction: with K averaged periodograms the anisotropy, the variance of a ring's powers over the square of their
 *     mean, is -10 log10 K decibels (-10 for his 10 periodograms); at 0 dB a pattern has strong directions
 * Powers are in units of g (1 - g), that of pixels set at random. docs/findings/screen-noise.md has the measured values.
 */
#include <koksma/mask.h>

#include <stdlib.h>
#include <string.h>

#include "test.h"

enum { SIDE = 64, PIXELS = SIDE * SIDE, MASKS = test_repeats(10, 3) };

typedef struct complex_number {
    double re, im;
} complex_number;

/* The discrete Fourier transform along one axis: `count` lines of `side` values that are `step` apart. */
static void transform(complex_number *f, size_t side, size_t step, size_t count)
{
    complex_number roots[SIDE], line[SIDE];
    for (size_t k = 0; k < side; k++) {
        const double angle = -2 * acos(-1) * (double)k / (double)side;
        roots[k] = (complex_number){cos(angle), sin(angle)};
    }
    for (size_t first = 0; first < count; first++) {
        complex_number *at = f + first % step + first / step * step * side;
        for (size_t k = 0; k < side; k++) {
            line[k] = (complex_number){0, 0};
            for (size_t j = 0; j < side; j++) {
                const complex_number x = at[j * step], root = roots[j * k % side];
                line[k].re += x.re * root.re - x.im * root.im;
                line[k].im += x.re * root.im + x.im * root.re;
            }
        }
        for (size_t k = 0; k < side; k++) {
            at[k * step] = line[k];
        }
    }
}

/* Adds the power of the pixels, side^dim of them, whose rank is below `below`, in units of that of random pixels, of which
   a share g is set. */
static void add_power(const uint32_t *ranks, size_t side, int dim, double below, double g, double *power)
{
    size_t n = 1, step = 1;
    for (int k = 0; k < dim; k++) {
        n *= side;
    }
    complex_number *f = malloc(n * sizeof *f);
    assert_non_null(f);
    for (size_t p = 0; p < n; p++) {
        f[p] = (complex_number){ranks[p] < below, 0};
    }
    for (int k = 0; k < dim; k++, step *= side) {
        transform(f, side, step, n / side);
    }
    for (size_t p = 0; p < n; p++) {
        power[p] += (f[p].re * f[p].re + f[p].im * f[p].im) / ((double)n * g * (1 - g));
    }
    free(f);
}

/* The length of a frequency in cycles over the whole mask. */
static double radius_of(size_t p, size_t side, int dim)
{
    double square = 0;
    for (int k = 0; k < dim; k++, p /= side) {
        const double along = (double)(p % side < side - p % side ? p % side : side - p % side);
        square += along * along;
    }
    return sqrt(square);
}

typedef struct ring {
    size_t count;
    double sum, squares;
} ring;

/* Means over rings of a width of one cycle; returns the number of rings that the grid of frequencies does not cut off. */
static size_t rings_of(const double *power, size_t n, size_t side, int dim, ring rings[2 * SIDE])
{
    for (size_t r = 0; r < 2 * SIDE; r++) {
        rings[r] = (ring){0};
    }
    for (size_t p = 1; p < n; p++) {
        ring *at = &rings[(size_t)(radius_of(p, side, dim) + 0.5)];
        at->count++;
        at->sum += power[p];
        at->squares += power[p] * power[p];
    }
    return side / 2;
}

static double low_power(const double *power, size_t n, size_t side, int dim, double below)
{
    double sum = 0;
    size_t count = 0;
    for (size_t p = 1; p < n; p++) {
        if (radius_of(p, side, dim) < below) {
            sum += power[p];
            count++;
        }
    }
    return sum / (double)count;
}

/* The ring of the largest mean, in cycles. */
static size_t peak_of(const ring *rings, size_t last)
{
    size_t peak = 1;
    for (size_t r = 1; r <= last; r++) {
        peak = rings[r].sum / (double)rings[r].count > rings[peak].sum / (double)rings[peak].count ? r : peak;
    }
    return peak;
}

/* Fails unless the powers of each ring from the fifth on differ as those of independent frequencies do. A ring of count
   frequencies has count / 2 independent ones, each an exponential variable averaged over K masks. */
static void assert_isotropic(const ring *rings, size_t last, double g)
{
    double mean = 0, expected = -10 * log10(MASKS);
    for (size_t r = 5; r <= last; r++) {
        const double count = (double)rings[r].count, average = rings[r].sum / count;
        const double variance = (rings[r].squares - count * average * average) / (count - 2);
        const double decibels = 10 * log10(variance / (average * average));
        mean += decibels / (double)(last - 4);
        if (!(decibels < expected + 4.5)) {
            fail_msg("g = %.3f: the anisotropy of ring %zu is %.1f dB, not %.1f", g, r, decibels, expected);
        }
    }
    if (!(fabs(mean - expected) < 1)) {
        fail_msg("g = %.3f: the mean anisotropy is %.1f dB, not %.1f", g, mean, expected);
    }
}

static void masks_have_the_spectrum_of_blue_noise(void **state)
{
    (void)state;
    static const struct {
        double g, low; /* low: mean power below half the principal frequency, at most */
    } shares[] = {{1.0 / 16, 0.12}, {1.0 / 8, 0.09}, {1.0 / 4, 0.11},
                  {1.0 / 2, 0.4},   {7.0 / 8, 0.12}, {15.0 / 16, 0.15}};
    static uint32_t ranks[MASKS][PIXELS];
    static double power[PIXELS];
    for (uint64_t seed = 0; seed < MASKS; seed++) {
        assert_ok(koksma_mask_void_and_cluster(SIDE, seed, NULL, ranks[seed]));
    }
    for (size_t t = 0; t < sizeof shares / sizeof *shares; t++) {
        const double g = shares[t].g, principal = SIDE * sqrt(fmin(g, 1 - g));
        ring rings[2 * SIDE];
        for (size_t p = 0; p < PIXELS; p++) {
            power[p] = 0;
        }
        for (size_t m = 0; m < MASKS; m++) {
            add_power(ranks[m], SIDE, 2, g * PIXELS, g, power);
        }
        const size_t last = rings_of(power, PIXELS, SIDE, 2, rings), peak = peak_of(rings, last);
        assert_isotropic(rings, last, g);
        const double low = low_power(power, PIXELS, SIDE, 2, principal / 2) / MASKS;
        if (!(low < shares[t].low)) {
            fail_msg("g = %.3f: mean power %.3f below half the principal frequency", g, low);
        }
        if (principal < 0.8 * SIDE / 2 && !(fabs((double)peak / principal - 1) < 0.25)) {
            fail_msg("g = %.3f: the peak is at %zu cycles; the principal frequency is %.1f", g, peak, principal);
        }
        for (size_t r = (size_t)(1.5 * principal); r <= last; r++) {
            const double mean = rings[r].sum / (double)rings[r].count / MASKS;
            if (!(mean > 0.7 && mean < 1.4)) {
                fail_msg("g = %.3f: power %.3f at %zu cycles, far above the principal frequency", g, mean, r);
            }
        }
    }
}

/* The shares of three directions in the power below a radius. */
static void shares_of_directions(const double *power, size_t side, double below, double share[3])
{
    double all = 0, along[3] = {0};
    for (size_t p = 1; p < side * side * side; p++) {
        const size_t f[3] = {p % side, p / side % side, p / side / side};
        const double radius = radius_of(p, side, 3);
        for (int k = 0; k < 3 && radius < below; k++) {
            const double cycles = (double)(f[k] < side - f[k] ? f[k] : side - f[k]);
            along[k] += power[p] * cycles * cycles / (radius * radius);
        }
        all += radius < below ? power[p] : 0;
    }
    for (int k = 0; k < 3; k++) {
        share[k] = along[k] / all;
    }
}

/* In space and time the peak is at the cube root of g, and time is a direction like the others. A frame alone has about
   half the low power of white noise, where a mask of pixels has a tenth at most. */
static void masks_in_time_have_the_spectrum_of_blue_noise(void **state)
{
    (void)state;
    enum { EDGE = test_repeats(16, 12), VOXELS = EDGE * EDGE * EDGE };
    static const double shares[] = {1.0 / 16, 1.0 / 8, 1.0 / 4, 7.0 / 8};
    static uint32_t ranks[VOXELS];
    assert_ok(koksma_mask_void_and_cluster_3d(EDGE, EDGE, 3, NULL, ranks));
    for (size_t t = 0; t < sizeof shares / sizeof *shares; t++) {
        const double g = shares[t], principal = EDGE * cbrt(fmin(g, 1 - g));
        const double in_frames = EDGE * sqrt(fmin(g, 1 - g));
        double frames[EDGE * EDGE] = {0}, share[3];
        static double power[VOXELS];
        ring rings[2 * SIDE];
        memset(power, 0, sizeof power);
        add_power(ranks, EDGE, 3, g * VOXELS, g, power);
        const size_t last = rings_of(power, VOXELS, EDGE, 3, rings), peak = peak_of(rings, last);
        const double low = low_power(power, VOXELS, EDGE, 3, principal / 2);
        if (!(low < 0.12 && (principal > (double)last || fabs((double)peak - principal) < 1.5))) {
            fail_msg("g = %.3f: mean power %.3f below half the principal frequency, %.1f; the peak is at %zu", g, low,
                     principal, peak);
        }
        shares_of_directions(power, EDGE, principal, share);
        for (int k = 0; k < 3; k++) {
            if (!(share[k] > 0.25 && share[k] < 0.42)) {
                fail_msg("g = %.3f: direction %d has a share of %.2f of the power", g, k, share[k]);
            }
        }
        for (size_t f = 0; f < EDGE; f++) {
            add_power(ranks + f * EDGE * EDGE, EDGE, 2, g * VOXELS, g, frames);
        }
        const double frame = low_power(frames, EDGE * EDGE, EDGE, 2, in_frames / 2) / EDGE;
        if (!(frame > 0.3 && frame < 0.8)) {
            fail_msg("g = %.3f: frames have %.2f of the low power of white noise", g, frame);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(masks_have_the_spectrum_of_blue_noise),
        cmocka_unit_test(masks_in_time_have_the_spectrum_of_blue_noise),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
