/* SPDX-License-Identifier: Apache-2.0 */
/* The elementary functions that are not short enough for elementary.h. */
#include "core/elementary.h"

#include <float.h>
#include <stdbool.h>
#include <stddef.h>

#include "core/double_double.h"

#define PI_LOW 0x1.1a62633145c07p-53 /* pi less its double */

/* cos and sin of any x. */
static void both_of(double x, double *c, double *s)
{
    koksma__cos_sin(fabs(x) <= 0x1p20 ? x : fmod(x, 2 * M_PI), c, s);
}

double koksma__sin(double x)
{
    double c, s;
    both_of(x, &c, &s);
    return s;
}

double koksma__cos(double x)
{
    double c, s;
    both_of(x, &c, &s);
    return c;
}

double koksma__tan(double x)
{
    double c, s;
    both_of(x, &c, &s);
    return s / c;
}

/* atan(a) = atan(i/8) + atan((a - i/8) / (1 + a i/8)) with the nearest i/8, for 0 <= a <= 1; for larger a it is pi/2 less
   that of 1/a. The rest is at most 1/15, and Taylor's series up to its 15th power leaves out less than 2^-67 of it. */
double koksma__atan(double x)
{
    static const koksma__dd eighths[] = {{0, 0},
                                         {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                         {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                         {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                         {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                         {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                         {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                         {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                         {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}};
    const double a = fabs(x);
    if (!(a < 0x1p60)) {
        return isnan(x) ? x : copysign(M_PI_2, x);
    }
    const int i = (int)(8 * (a <= 1 ? a : 1 / a) + 0.5);
    const double c = 0.125 * i, t = a <= 1 ? (a - c) / (1 + a * c) : (1 - a * c) / (a + c), z = t * t;
    double series = -1.0 / 15;
    for (int k = 13; k >= 3; k -= 2) {
        series = series * z + (k % 4 == 1 ? 1.0 : -1.0) / k;
    }
    const double rest = eighths[i].lo + t * z * series; /* all but atan(i/8) + t */
    if (a <= 1) {
        const koksma__dd r = i > 0 ? koksma__dd_quick_sum(eighths[i].hi, t) : koksma__dd_quick_sum(t, 0);
        return copysign(r.hi + (r.lo + rest), x);
    }
    const koksma__dd r = koksma__dd_quick_sum(M_PI_2, -eighths[i].hi), q = koksma__dd_quick_sum(r.hi, -t);
    return copysign(q.hi + (q.lo + (r.lo + PI_LOW / 2 - rest)), x);
}

double koksma__atan2(double y, double x)
{
    const double ax = fabs(x), ay = fabs(y);
    if (isnan(x) || isnan(y)) {
        return x + y;
    }
    const double ratio = ax == ay ? ax != 0 : ay < ax ? ay / ax : ax / ay;
    const double angle = koksma__atan(ratio);
    if (ay > ax) {
        return copysign(M_PI_2 + ((signbit(x) ? angle : -angle) + PI_LOW / 2), y);
    }
    return copysign(signbit(x) ? M_PI - (angle - PI_LOW) : angle, y);
}

double koksma__asin(double x)
{
    return koksma__atan2(x, sqrt((1 - x) * (1 + x)));
}

double koksma__acos(double x)
{
    return koksma__atan2(sqrt((1 - x) * (1 + x)), x);
}

/* With u = 1 + x, rounded, log(u) x / (u - 1) is exact but for the errors of log and the quotient (Kahan). */
double koksma__log1p(double x)
{
    const double u = 1 + x;
    return u == 1 || !(u <= DBL_MAX) ? x : u <= 0 ? koksma__log(u) : koksma__log(u) * (x / (u - 1));
}

double koksma__log2(double x)
{
    int e;
    const double m = frexp(x, &e), near = m < M_SQRT1_2 ? 2 * m : m;
    return x > 0 && x <= DBL_MAX ? (m < M_SQRT1_2 ? e - 1 : e) + koksma__log(near) * M_LOG2E : koksma__log(x);
}

double koksma__log10(double x)
{
    const double y = koksma__log(x) * M_LOG10E, whole = floor(y + 0.5);
    return fabs(y - whole) < 1e-12 * fabs(y) && koksma__pow(10, whole) == x ? whole : y;
}

/* exp(x) - 1: Taylor's series where |x| < ln 2 / 2, whose terms from the 14th on are below 2^-60 of the first. */
double koksma__expm1(double x)
{
    if (!(fabs(x) < 0.35)) {
        return koksma__exp(x) - 1;
    }
    double sum = 1.0 / 87178291200;
    static const double factorials[] = {6227020800, 479001600, 39916800, 3628800, 362880, 40320,
                                        5040,       720,       120,      24,      6};
    for (size_t i = 0; i < sizeof factorials / sizeof *factorials; i++) {
        sum = sum * x + 1 / factorials[i];
    }
    return x + x * x * (0.5 + x * sum);
}

double koksma__exp2(double x)
{
    const double k = floor(x + 0.5);
    return fabs(x) < 2000 ? ldexp(koksma__exp((x - k) * M_LN2), (int)k) : x > 0 ? (double)INFINITY : isnan(x) ? x : 0;
}

double koksma__sinh(double x)
{
    const double e = koksma__expm1(fabs(x));
    return copysign(e < DBL_MAX ? 0.5 * (e + e / (e + 1)) : e, x);
}

double koksma__cosh(double x)
{
    const double e = koksma__exp(fabs(x));
    return 0.5 * (e + 1 / e);
}

double koksma__asinh(double x)
{
    const double a = fabs(x);
    return copysign(a < 0x1p28 ? koksma__log1p(a + a * a / (1 + sqrt(1 + a * a))) : koksma__log(a) + M_LN2, x);
}

double koksma__hypot(double x, double y)
{
    int e = 0;
    const double most = fmax(fabs(x), fabs(y));
    if (isinf(x) || isinf(y)) {
        return (double)INFINITY;
    }
    if (isnan(x) || isnan(y) || most == 0) {
        return x + y;
    }
    if (most > 0x1p-400 && most < 0x1p500) {
        return sqrt(x * x + y * y); /* the same bits as below */
    }
    frexp(most, &e);
    const double a = ldexp(x, -e), b = ldexp(y, -e);
    return ldexp(sqrt(a * a + b * b), e);
}

/* log(x) in two parts: with f = (m - 1) / (m + 1), x = 2^e m, it is e ln 2 + 2 f + 2/3 f^3 + 2/5 f^5 + ...; what is
   computed with one part only begins at f^7 2/7 < 2^-19. */
static koksma__dd long_log(double x)
{
    int e;
    double m = frexp(x, &e);
    if (m < 0x1.6a09e667f3bcdp-1) {
        m *= 2;
        e--;
    }
    const koksma__dd above = koksma__dd_quick_sum(fmax(m, 1), fmin(m, 1)); /* m - 1 has no error */
    const double quotient = (m - 1) / above.hi;
    const koksma__dd back = koksma__dd_product(quotient, above.hi);
    const koksma__dd f =
        koksma__dd_quick_sum(quotient, (((m - 1) - back.hi) - back.lo - quotient * above.lo) / above.hi);
    const koksma__dd square = koksma__dd_mul(f, f);
    double rest = 0;
    for (int i = 25; i >= 7; i -= 2) {
        rest = rest * square.hi + 1.0 / i;
    }
    static const koksma__dd fifth = {0x1.999999999999ap-3, -0x1.999999999999ap-57},
                            third = {0x1.5555555555555p-2, 0x1.5555555555555p-56};
    koksma__dd series = koksma__dd_quick_sum(fifth.hi, fifth.lo + rest * square.hi);
    series = koksma__dd_mul(series, square);
    const koksma__dd sum = koksma__dd_quick_sum(third.hi, series.hi);
    series = koksma__dd_mul(koksma__dd_mul(koksma__dd_quick_sum(sum.hi, sum.lo + third.lo + series.lo), square), f);
    const koksma__dd whole = koksma__dd_quick_sum(f.hi, series.hi);
    const koksma__dd of_m = koksma__dd_quick_sum(2 * whole.hi, 2 * (whole.lo + f.lo + series.lo));
    const double high = e * 0x1.62e42fefap-1, low = e * 0x1.cf79abc9e3b3ap-40; /* ln 2; the first product is exact */
    if (e == 0) {
        return of_m;
    }
    const koksma__dd total = koksma__dd_quick_sum(high, of_m.hi);
    const koksma__dd small = koksma__dd_sum(total.lo, low);
    return koksma__dd_quick_sum(total.hi, small.hi + (small.lo + of_m.lo));
}

/* x^n for whole n >= 0, with two parts. */
static koksma__dd whole_power(double x, int n)
{
    koksma__dd power = {1, 0}, square = {x, 0};
    for (; n > 0; n /= 2) {
        power = n % 2 ? koksma__dd_mul(power, square) : power;
        square = n > 1 ? koksma__dd_mul(square, square) : square;
    }
    return power;
}

double koksma__pow(double x, double y)
{
    const bool whole = y == floor(y), odd = whole && fabs(y) < 0x1p53 && fmod(y, 2) != 0;
    if (y == 0 || x == 1) {
        return 1;
    }
    if (isnan(x) || isnan(y) || (x < 0 && !whole)) {
        return (double)NAN;
    }
    const double a = fabs(x), sign = odd && signbit(x) ? -1 : 1;
    if (a == 0 || isinf(a)) {
        return sign * ((a == 0) == (y > 0) ? 0 : (double)INFINITY);
    }
    if (isinf(y)) {
        return a == 1 ? 1 : (a > 1) == (y > 0) ? (double)INFINITY : 0;
    }
    const koksma__dd l = long_log(a);
    const double exponent = y * l.hi;
    if (fabs(exponent) > 800) {
        return exponent > 0 ? sign * (double)INFINITY : sign * 0;
    }
    if (whole && fabs(y) <= 1024 && fabs(exponent) < 660) {
        const koksma__dd power = whole_power(a, (int)fabs(y));
        return sign * (y > 0 ? power.hi : (1 - power.lo / power.hi) / power.hi);
    }
    const koksma__dd p = koksma__dd_product(y, l.hi);
    const double half = koksma__exp(p.hi / 2); /* the whole may be subnormal */
    return sign * (half * (1 + (p.lo + y * l.lo)) * half);
}

double koksma__cbrt(double x)
{
    if (x == 0 || !(fabs(x) <= DBL_MAX)) {
        return x;
    }
    const double a = fabs(x), t = koksma__pow(a, 1.0 / 3), square = t * t;
    return copysign(t - (t - a / square) / 3, x);
}

/* The trapezoidal rule for 1/pi times the integral of x exp(-x^2 - t^2) / (x^2 + t^2), with the residue at t = i x
   (Matta & Reichel 1971); with steps of 1/2 the error is below exp(-39). exp(-x^2) gets the rest of the square. */
double koksma__erfc(double x)
{
    if (!(x >= 0.5)) {
        return 1 - koksma__erf(x);
    }
    if (x > 27) {
        return 0;
    }
    const koksma__dd square = koksma__dd_product(x, x);
    double sum = 0.5 / square.hi;
    for (int k = 13; k >= 1; k--) {
        sum += koksma__exp(-0.25 * k * k) / (0.25 * k * k + square.hi);
    }
    const double residue = x < 2 * M_PI ? 2 / koksma__expm1(4 * M_PI * x) : 0;
    return koksma__exp(-square.hi) * (1 - square.lo) * x * sum / M_PI - residue;
}

/* Stirling's series from 9 on, whose terms after these are below 1e-16; below, the argument is raised by whole steps. */
double koksma__log_gamma(double x)
{
    static const double terms[] = {-3617.0 / 122400, 1.0 / 156,  -691.0 / 360360, 1.0 / 1188,
                                   -1.0 / 1680,      1.0 / 1260, -1.0 / 360,      1.0 / 12};
    double factor = 1, series = 0;
    if (isinf(x)) {
        return x;
    }
    for (; x < 9; x++) {
        factor *= x;
    }
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) {
        series = series / (x * x) + terms[i];
    }
    return (x - 0.5) * koksma__log(x) - x + 0.918938533204672741780 + series / x - koksma__log(factor);
}
