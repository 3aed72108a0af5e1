/* SPDX-License-Identifier: Apache-2.0 */
/* Frequency responses of the pixel filters, against their Fourier transforms in closed form. */
#include <math.h>
#include <string.h>

#include <koksma/render.h>

#include "test.h"

/* sin(pi w) / (pi w): the transform of the box of width 1. */
static double sinc(double w)
{
    return w == 0 ? 1 : sin(M_PI * w) / (M_PI * w);
}

/* Harris's window of width 3 is a sum of cosines; each is two shifted boxes in frequency. */
static double window(double w)
{
    static const double a[] = {0.35875, 0.48829, 0.14128, 0.01168};
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        sum += a[k] / 2 * (sinc(3 * w - k) + sinc(3 * w + k));
    }
    return sum / a[0];
}

/* The cubic with B = C = 0, integrated by parts. */
static double cubic(double w)
{
    const double s = sinc(w), q = M_PI * w;
    return w == 0 ? 1 : 3 / (q * q) * (s * s - sinc(2 * w));
}

TEST_CASE(responses_are_the_transforms)
{
    for (int i = 0; i < 40; i++) {
        const double w = 0.171 * i, s = sinc(w);
        assert_near(koksma_filter_response(koksma_filter_find("box"), w), s, 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("tent"), w), s * s, 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("b-spline"), w), s * s * s * s, 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("blackman-harris"), w), window(w), 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("hermite"), w), cubic(w), 1e-9);
    }
}

/* Shifted copies add up to 1 exactly when the transform is 0 at all whole frequencies but 0 (Poisson's formula). */
TEST_CASE(partitions_of_unity_vanish_at_whole_frequencies)
{
    for (size_t i = 0; koksma_filter_at(i); i++) {
        const koksma_filter *filter = koksma_filter_at(i);
        const bool unity = strcmp(filter->name, "gaussian") != 0 && strcmp(filter->name, "blackman-harris") != 0;
        double most = 0;
        assert_near(koksma_filter_response(filter, 0), 1, 1e-15);
        for (int w = 1; w < 6; w++) {
            most = fmax(most, fabs(koksma_filter_response(filter, w)));
            assert_near(koksma_filter_response(filter, -w), koksma_filter_response(filter, w), 1e-15);
        }
        assert_that((most < 1e-9) == unity, "%s: %g at a whole frequency", filter->name, most);
    }
}

/* Of the box: 1 - (2 / pi) (Si(pi) - 2 / pi). The others by a sum over frequencies beyond 1/2, up to where all have
   died away but the box. */
TEST_CASE(leakage_is_the_squared_response_beyond_nyquist)
{
    const double si_pi = 1.851937051982466;
    assert_near(koksma_filter_leakage(koksma_filter_find("box")), 1 - 2 / M_PI * (si_pi - 2 / M_PI), 1e-7);
    for (size_t i = 1; koksma_filter_at(i); i++) {
        const koksma_filter *filter = koksma_filter_at(i);
        double inside = 0, outside = 0;
        for (int k = 0; k < 600; k++) {
            const double h = koksma_filter_response(filter, (k + 0.5) / 100);
            *(k < 50 ? &inside : &outside) += h * h;
        }
        assert_near(koksma_filter_leakage(filter), outside / (inside + outside), 1e-4);
    }
}
