/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Converts sampled spectra to linear sRGB. XYZ is the sum, over whole nanometres from 360 to 830, of the spectrum
 * times the colour-matching functions of the CIE 1931 observer. These functions are the fit of Wyman, Sloan & Shirley
 * (2013): for spectra like those of the Cornell box, each channel differs from the result of the CIE's tables by at
 * most 1.2 % of the largest channel. D65 is interpolated linearly in a table with steps of 20 nm. Linear sRGB follows
 * by the matrix of IEC 61966-2-1. Mitsuba converts spectra in the same way for its RGB variants: reflectances are
 * multiplied by daylight (D65) and emission is not, so that an emission that is equal at all wavelengths is reddish.
 * Unbounded values, such as refractive indices, are converted as reflectances are, and may be above 1. The functions of
 * each nanometre are computed once, because a scene may have a million spectra.
 */
#include "core/elementary.h"
#include "core/vector.h"
#include "scene/import.h"

#include <math.h>
#include <pthread.h>
#include <string.h>

#define LARGEST 1e30

enum { FIRST = 360, LAST = 830 };

/* A sum of Gaussians, each with its own widths in nm below and above its centre. */
static const struct {
    int function;
    double height, centre, below, above;
} lobes[] = {{0, 1.056, 599.8, 37.9, 31.0}, {0, 0.362, 442.0, 16.0, 26.7}, {0, -0.065, 501.1, 20.4, 26.2},
             {1, 0.821, 568.8, 46.9, 40.5}, {1, 0.286, 530.9, 16.3, 31.1}, {2, 1.217, 437.0, 11.8, 36.0},
             {2, 0.681, 459.0, 26.0, 13.8}};

static void matching(double wavelength, double xyz[3])
{
    xyz[0] = xyz[1] = xyz[2] = 0;
    for (size_t i = 0; i < sizeof lobes / sizeof *lobes; i++) {
        const double off = wavelength - lobes[i].centre, t = off / (off < 0 ? lobes[i].below : lobes[i].above);
        xyz[lobes[i].function] += lobes[i].height * koksma__exp(-0.5 * t * t);
    }
}

static double daylight_at(double wavelength)
{
    static const double d65[] = {49.9755, 82.7549, 93.4318, 104.865, 117.812, 115.923, 109.354,
                                 104.79,  104.405, 100,     95.788,  90.0062, 87.6987, 83.6992,
                                 80.2146, 78.2842, 71.6091, 61.604,  75.087,  46.4182, 63.3828}; /* 380 to 780 nm */
    const double at = (wavelength - 380) / 20;
    const int i = (int)floor(fmin(fmax(at, 0), 19));
    return at < 0 || at > 20 ? 0 : d65[i] + (at - i) * (d65[i + 1] - d65[i]);
}

static pthread_once_t once = PTHREAD_ONCE_INIT;
static double functions[LAST - FIRST + 1][3], lights[LAST - FIRST + 1]; /* matching() and daylight_at() */
static koksma__sampled_spectrum even; /* the sums of a spectrum that is 1 everywhere */

static void add(koksma__sampled_spectrum *s, int wavelength, double value)
{
    for (int k = 0; k < 3; k++) {
        const double seen = value * functions[wavelength - FIRST][k];
        s->seen[k] += seen;
        s->in_light[k] += seen * lights[wavelength - FIRST];
    }
}

static void tabulate(void)
{
    for (int w = FIRST; w <= LAST; w++) {
        matching(w, functions[w - FIRST]);
        lights[w - FIRST] = daylight_at(w);
        add(&even, w, 1);
    }
}

bool koksma__sampled_spectrum_add(koksma__sampled_spectrum *s, double wavelength, double value)
{
    if (!isfinite(wavelength) || !isfinite(value) || (s->n && !(wavelength > s->last[0]))) {
        return false;
    }
    pthread_once(&once, tabulate);
    value = fmin(fmax(value, -LARGEST), LARGEST);
    const double from = s->n ? s->last[0] : wavelength, before = s->n ? s->last[1] : value;
    int w = (int)ceil(fmin(fmax(from, FIRST), LAST + 1));
    w += s->n && w == from; /* the wavelength of the previous sample has been added already */
    for (; w <= LAST && w <= wavelength; w++) {
        const double part = wavelength > from ? (w - from) / (wavelength - from) : 1;
        add(s, w, before + part * (value - before));
    }
    s->last[0] = wavelength;
    s->last[1] = value;
    s->n++;
    return true;
}

static void to_rgb(const double xyz[3], double rgb[3])
{
    static const double matrix[3][3] = {
        {3.2404542, -1.5371385, -0.4985314}, {-0.9692660, 1.8760108, 0.0415560}, {0.0556434, -0.2040259, 1.0572252}};
    for (int k = 0; k < 3; k++) {
        rgb[k] = koksma__dot(matrix[k], xyz);
    }
}

void koksma__black_body_colour(double kelvin, double rgb[3])
{
    const double t = fmin(fmax(kelvin, 1667), 25000), i = 1000 / t;
    const double x = t < 4000 ? ((-0.2661239 * i - 0.2343589) * i + 0.8776956) * i + 0.179910
                              : ((-3.0258469 * i + 2.1070379) * i + 0.2226347) * i + 0.240390;
    const double y = t < 2222   ? ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683
                     : t < 4000 ? ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867
                                : ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    to_rgb((const double[3]){x / y, 1, (1 - x - y) / y}, rgb);
    for (int k = 0; k < 3; k++) {
        rgb[k] = fmax(rgb[k], 0);
    }
}

void koksma__sampled_spectrum_colour(const koksma__sampled_spectrum *s, koksma__spectrum_use use, double rgb[3])
{
    pthread_once(&once, tabulate);
    double white[3] = {even.seen[1], even.seen[1], even.seen[1]};
    to_rgb(use == KOKSMA__EMISSION ? s->seen : s->in_light, rgb);
    if (use != KOKSMA__EMISSION) {
        to_rgb(even.in_light, white);
    }
    for (int k = 0; k < 3; k++) {
        rgb[k] = fmin(fmax(rgb[k] / white[k], 0), use == KOKSMA__REFLECTANCE ? 1 : (double)INFINITY);
    }
}
