/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Colours of sampled spectra. A spectrum, linear between its samples and 0 outside of them, is weighted by the CIE 1931
 * colour matching functions in their analytic form (Wyman, Sloan and Shirley 2013) and summed in steps of 5 nm; the sum
 * as XYZ becomes linear sRGB (IEC 61966-2-1). A reflectance is lit by D65 (CIE 15, table of 10 nm), and each channel
 * divided by that of the white surface; an emission is not, and has luminance 1 if the spectrum is 1 everywhere.
 */
#include "scene/import_spectra.h"

#include <math.h>

enum { FIRST = 360, LAST = 780, STEP = 5 };

/* A lobe of the fit, with a width of its own on either side. */
static double lobe(double nm, double centre, double left, double right)
{
    const double t = (nm - centre) / (nm < centre ? left : right);
    return exp(-0.5 * t * t);
}

static void matching(double nm, double xyz[3])
{
    xyz[0] = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
             0.065 * lobe(nm, 501.1, 20.4, 26.2);
    xyz[1] = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    xyz[2] = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
}

/* The relative power of D65, 100 at 560 nm. */
static double standard_daylight(double nm)
{
    static const double table[] = {46.6383, 52.0891, 49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865,
                                   117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802, 104.79,  107.689,
                                   104.405, 104.046, 100,     96.3342, 95.788,  88.6856, 90.0062, 89.5991, 87.6987,
                                   83.2886, 83.6992, 80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349,
                                   61.604,  69.8856, 75.087,  63.5927, 46.4182, 66.8054, 63.3828};
    const double at = (nm - FIRST) / 10;
    const int last = (int)(sizeof table / sizeof *table) - 1, i = at < last ? (int)at : last - 1;
    return table[i] + (at - i) * (table[i + 1] - table[i]);
}

/* The spectrum's value; the pairs of wavelength and value rise in wavelength. */
static double value_at(const double *pairs, size_t n, double nm)
{
    if (n == 1) {
        return pairs[1];
    }
    for (size_t i = 0; i + 1 < n; i++) {
        const double *a = pairs + 2 * i, *b = a + 2;
        if (nm >= a[0] && nm <= b[0]) {
            return b[0] > a[0] ? a[1] + (nm - a[0]) / (b[0] - a[0]) * (b[1] - a[1]) : b[1];
        }
    }
    return 0;
}

void koksma__import_spectrum(const double *pairs, size_t n, bool emits, double rgb[3])
{
    static const double to_rgb[3][3] = {
        {3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.2040, 1.0570}};
    double sum[3] = {0}, white[3] = {0};
    for (int nm = FIRST; nm <= LAST; nm += STEP) {
        double xyz[3];
        const double light = emits ? 1 : standard_daylight(nm), value = value_at(pairs, n, nm);
        matching(nm, xyz);
        for (int k = 0; k < 3; k++) {
            sum[k] += light * value * xyz[k];
            white[k] += light * xyz[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        const double *row = to_rgb[k];
        const double channel = row[0] * sum[0] + row[1] * sum[1] + row[2] * sum[2];
        const double whole = emits ? white[1] : row[0] * white[0] + row[1] * white[1] + row[2] * white[2];
        rgb[k] = fmax(channel / whole, 0);
    }
}
