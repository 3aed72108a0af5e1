/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The pixel filters, a function and a row each; and the sampling of positions from a filter f: |f| is tabulated in 1024
 * cells of equal width as cumulative sums, which are inverted by binary search. All positions in a cell have the same
 * weight, the mean of f over the cell divided by the mean of |f|, so that the expected weight in each cell is exactly the
 * integral of f. All but gaussian and blackman-harris are partitions of unity.
 */
#include "render/filters/filters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/elementary.h"
#include "core/status.h"

/* ---- The filters ------------------------------------------------------------------------------------------------ */

/* box: 1 within half a pixel. */
static double box(double x)
{
    return fabs(x) <= 0.5 ? 1 : 0;
}

/* tent: a box convolved with a box. */
static double tent(double x)
{
    return fmax(1 - fabs(x), 0);
}

/* hermite: the cubic of Mitchell & Netravali (1988) with B = C = 0, which interpolates like Hermite's cubic with slopes
   of 0. It is separable, symmetric, of width 2, never negative and a partition of unity, as Shirley (1991, section 5.2)
   requires of a pixel filter; the formula of Shirley's own filter is not known. */
static double hermite(double x)
{
    const double a = fabs(x);
    return a < 1 ? 1 - a * a * (3 - 2 * a) : 0;
}

/* gaussian: exp(-x^2 / (2 s^2)) - exp(-r^2 / (2 s^2)) with s = 1/2 and r = 1.5 pixels: lowered so that it is 0 at the
   radius r. */
static double gaussian(double x)
{
    return fmax(koksma__exp(-2 * x * x) - koksma__exp(-4.5), 0);
}

/* mitchell: the cubic of Mitchell & Netravali (1988) with B = C = 1/3, negative from 8/7 to 2. */
static double mitchell(double x)
{
    const double a = fabs(x);
    return a < 1   ? ((7 * a - 12) * a * a + 16.0 / 3) / 6
           : a < 2 ? (((-7.0 / 3 * a + 12) * a - 20) * a + 32.0 / 3) / 6
                   : 0;
}

/* b-spline: the box convolved three times with a box. */
static double b_spline(double x)
{
    const double a = fabs(x);
    return a < 1 ? 2.0 / 3 - a * a * (1 - a / 2) : a < 2 ? (2 - a) * (2 - a) * (2 - a) / 6 : 0;
}

/* blackman-harris: the four-term window of Harris (1978), stretched to a radius of 1.5 pixels. */
static double blackman_harris(double x)
{
    const double turn = M_PI * x / 1.5;
    return fabs(x) < 1.5 ? 0.35875 + 0.48829 * koksma__cos(turn) + 0.14128 * koksma__cos(2 * turn) +
                               0.01168 * koksma__cos(3 * turn)
                         : 0;
}

static const koksma_filter rows[] = {
    {"box", "the mean over the area of the pixel", "shirley1991", 0.5, box},
    {"tent", "a tent of width 2", "shirley1991", 1, tent},
    {"hermite", "Mitchell and Netravali's cubic, B = C = 0: two mirrored smoothsteps, of width 2", "mitchell1988", 1,
     hermite},
    {"gaussian", "a Gaussian of sigma 1/2 pixel, cut off at 1.5 pixels", "cook1986", 1.5, gaussian},
    {"mitchell", "Mitchell and Netravali's cubic, B = C = 1/3; negative beyond 8/7, so use --splat", "mitchell1988",
     2, mitchell},
    {"b-spline", "the cubic B-spline", "mitchell1988", 2, b_spline},
    {"blackman-harris", "the Blackman-Harris window with a radius of 1.5 pixels", "harris1978", 1.5, blackman_harris},
};

const koksma_filter *koksma_filter_at(size_t i)
{
    return i < sizeof rows / sizeof *rows ? &rows[i] : NULL;
}

const koksma_filter *koksma_filter_find(const char *name)
{
    KOKSMA__REQUIRE_OR(NULL, name);
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        if (!strcmp(rows[i].name, name)) {
            return &rows[i];
        }
    }
    return NULL;
}

koksma_status koksma__filter_check(const koksma_filter *filter)
{
    KOKSMA__FAIL_IF(!filter->name || !filter->value, KOKSMA_ARGUMENT,
                    "the filter has no %s: koksma_filter_find has filters", filter->name ? "value" : "name");
    KOKSMA__FAIL_IF(!(filter->radius > 0 && filter->radius <= KOKSMA__MAX_RADIUS), KOKSMA_ARGUMENT,
                    "filter %s: radius = %g: it takes a radius above 0 and up to %d pixels", filter->name,
                    filter->radius, KOKSMA__MAX_RADIUS);
    return KOKSMA_OK;
}

/* ---- Sampling --------------------------------------------------------------------------------------------------- */

enum { CELLS = 1024, PARTS = 16 };

struct koksma__filter_table {
    const koksma_filter *filter;
    bool is_signed;
    double scale;               /* 1 / integral of f */
    double cdf[CELLS + 1];      /* cumulative distribution of |f| at the left edge of each cell */
    double positive[CELLS + 1]; /* cumulative distribution of max(f, 0) */
    float weights[CELLS];       /* the weight of a position in the cell when positions are drawn from |f| */
};

/* Normalises a table of cumulative sums, one for each cell's left edge: divides it by the sum over all cells. */
static void normalise(double *cdf, double sum)
{
    for (int i = 0; i < CELLS; i++) {
        cdf[i] /= sum;
    }
    cdf[CELLS] = 1;
}

koksma_status koksma__filter_open(const koksma_filter *filter, koksma__filter_table **out)
{
    koksma__filter_table *t = malloc(sizeof *t);
    *out = t;
    KOKSMA__REQUIRE_MEMORY(t, sizeof *t);
    const double width = 2 * filter->radius / CELLS;
    double sum = 0, integral = 0, positive = 0;
    t->filter = filter;
    for (int i = 0; i < CELLS; i++) {
        double part = 0, signed_part = 0, positive_part = 0;
        for (int k = 0; k < PARTS; k++) { /* midpoint rule */
            const double f = filter->value(-filter->radius + width * (i + (k + 0.5) / PARTS));
            part += fabs(f);
            signed_part += f;
            positive_part += fmax(f, 0);
        }
        t->cdf[i] = sum;
        t->positive[i] = positive;
        t->weights[i] = (float)(part > 0 ? signed_part / part : 0);
        sum += part;
        integral += signed_part;
        positive += positive_part;
    }
    for (int i = 0; i < CELLS; i++) {
        t->weights[i] *= (float)(sum / integral); /* all weights are 1 if f has one sign */
    }
    t->is_signed = integral < sum;
    normalise(t->cdf, sum);
    normalise(t->positive, positive);
    t->scale = PARTS / (integral * width);
    return KOKSMA_OK;
}

void koksma__filter_close(koksma__filter_table *t)
{
    free(t);
}

bool koksma__filter_is_signed(const koksma__filter_table *t)
{
    return t->is_signed;
}

/* Returns the position below which the cumulative distribution is u, and the cell that contains the position. */
static float invert(const koksma__filter_table *t, const double *cdf, float u, int *cell)
{
    int low = 0, high = CELLS;
    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (cdf[middle] <= (double)u) {
            low = middle;
        } else {
            high = middle;
        }
    }
    const double width = 2 * t->filter->radius / CELLS, share = cdf[low + 1] - cdf[low];
    *cell = low;
    return (float)(-t->filter->radius + width * (low + (share > 0 ? ((double)u - cdf[low]) / share : 0.5)));
}

float koksma__filter_sample(const koksma__filter_table *t, float u, float *weight)
{
    int cell;
    const float x = invert(t, t->cdf, u, &cell);
    *weight = t->weights[cell];
    return x;
}

float koksma__filter_sample_positive(const koksma__filter_table *t, float u)
{
    int cell;
    return invert(t, t->positive, u, &cell);
}

void koksma__filter_balance(float *w, size_t n)
{
    double sum = 0;
    for (size_t i = 0; i < n; i++) {
        sum += (double)w[i];
    }
    const double mean = sum / (double)n, scale = n > 1 ? (double)n / (double)(n - 1) : 0;
    for (size_t i = 0; i < n; i++) {
        w[i] = (float)(1 + ((double)w[i] - mean) * scale);
    }
}

float koksma__filter_value(const koksma__filter_table *t, float x)
{
    const double r = t->filter->radius, at = (double)x;
    return at >= -r && at < r ? (float)(t->scale * t->filter->value(at)) : 0;
}

/* ---- Frequency response ----------------------------------------------------------------------------------------- */

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

enum { SLICES = 4096, BANDS = 64 };

static const double gauss_point = 0.28867513459481287; /* half of 1 / sqrt(3) */

/* Integrals of f, f cos(2 pi w x) and f^2 over the half line. */
typedef struct sums {
    double f, wave, square;
} sums;

static sums integrate(const koksma_filter *filter, double frequency)
{
    const double h = filter->radius / SLICES;
    sums s = {0, 0, 0};
    for (int i = 0; i < SLICES; i++) {
        for (int side = -1; side <= 1; side += 2) {
            const double x = h * (i + 0.5 + side * gauss_point), f = filter->value(x);
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
            const double h = koksma_filter_response(filter, 0.5 / BANDS * (i + 0.5 + side * gauss_point));
            /* the band's width 0.5 / BANDS, times 2 for the negative frequencies, over the 2 points of a band */
            passed += h * h * (0.5 / BANDS);
        }
    }
    return 1 - passed / all;
}
