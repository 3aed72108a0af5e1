/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A filter's frequency response, and its leakage, the share of the filter's energy beyond the Nyquist frequency. With
 * f even and zero from `radius` on,
 *
 *     H(w) = integral f(x) cos(2 pi w x) dx / integral f,        leakage = 1 - integral over |w| < 1/2 of H^2
 *                                                                                       / integral H^2
 *
 * and by Parseval's theorem integral H^2 = integral f^2 / (integral f)^2. Integrals are computed by two-point Gauss
 * rules on cells of the half line; the points of these rules never lie on an edge of the filter.
 */
#include <math.h>

#include "core/elementary.h"
#include "core/status.h"
#include "render/filters/filters.h"

enum { CELLS = 4096, BANDS = 64 };

static const double gauss = 0.28867513459481287; /* half of 1 / sqrt(3) */

/* Integrals of f, f cos(2 pi w x) and f^2 over the half line. */
typedef struct sums {
    double f, wave, square;
} sums;

static sums integrate(const koksma_filter *filter, double frequency)
{
    const double h = filter->radius / CELLS;
    sums s = {0, 0, 0};
    for (int i = 0; i < CELLS; i++) {
        for (int side = -1; side <= 1; side += 2) {
            const double x = h * (i + 0.5 + side * gauss), f = filter->value(x);
            s.f += f;
            s.wave += f * koksma__cos(2 * M_PI * frequency * x);
            s.square += f * f;
        }
    }
    s.f *= h / 2;
    s.wave *= h / 2;
    s.square *= h / 2;
    return s;
}

double koksma_filter_response(const koksma_filter *filter, double frequency)
{
    KOKSMA__REQUIRE_OR(NAN, filter);
    if (koksma__filter_check(filter)) {
        return NAN;
    }
    const sums s = integrate(filter, frequency);
    return s.wave / s.f;
}

double koksma_filter_leakage(const koksma_filter *filter)
{
    KOKSMA__REQUIRE_OR(NAN, filter);
    if (koksma__filter_check(filter)) {
        return NAN;
    }
    const sums s = integrate(filter, 0);
    /* integral f^2 / (integral f)^2, where both halves of the line count: 2 square / (2 f)^2 */
    const double all = s.square / (2 * s.f * s.f);
    double passed = 0;
    for (int i = 0; i < BANDS; i++) {
        for (int side = -1; side <= 1; side += 2) {
            const double h = koksma_filter_response(filter, 0.5 / BANDS * (i + 0.5 + side * gauss));
            /* the band's width 0.5 / BANDS, times 2 for the negative frequencies, over the 2 points of a band */
            passed += h * h * (0.5 / BANDS);
        }
    }
    return 1 - passed / all;
}
