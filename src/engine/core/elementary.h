/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The elementary functions with the same bits on every machine. A libm's results differ in the last bits between systems
 * (glibc's depend on whether there is a fused multiply-add). These functions use only additions, multiplications,
 * divisions, square roots, and functions of libm without an error (floor, fmod, frexp, ldexp), which IEEE 754 makes the
 * same everywhere. tests/core/test_elementary.c has the largest errors, in units in the last place: 1 to 5, erfc 20.
 */
#ifndef KOKSMA_CORE_ELEMENTARY_H
#define KOKSMA_CORE_ELEMENTARY_H

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "core/visibility.h"

/* As in C's math.h. */
KOKSMA__LAB double koksma__sin(double x); /* beyond 2^20 the error is that of an ulp of x */
KOKSMA__LAB double koksma__cos(double x);
KOKSMA__LAB double koksma__tan(double x);
KOKSMA__LAB double koksma__asin(double x);
KOKSMA__LAB double koksma__acos(double x);
KOKSMA__LAB double koksma__atan(double x);
KOKSMA__LAB double koksma__atan2(double y, double x);
KOKSMA__LAB double koksma__exp2(double x); /* exact for whole x */
KOKSMA__LAB double koksma__expm1(double x);
KOKSMA__LAB double koksma__log1p(double x);
KOKSMA__LAB double koksma__log2(double x);  /* exact for powers of 2 */
KOKSMA__LAB double koksma__log10(double x); /* exact for powers of 10 that are doubles */
KOKSMA__LAB double koksma__pow(double x, double y);
KOKSMA__LAB double koksma__cbrt(double x);
KOKSMA__LAB double koksma__hypot(double x, double y);
KOKSMA__LAB double koksma__sinh(double x);
KOKSMA__LAB double koksma__cosh(double x);
KOKSMA__LAB double koksma__asinh(double x);
KOKSMA__LAB double koksma__erfc(double x);

/* log gamma(x) for x > 0; the error is below 4e-15 max(1, the value). */
KOKSMA__LAB double koksma__log_gamma(double x);

/* 2^k, -1022 <= k <= 1023. */
static inline double koksma__power_of_two(int k)
{
    const uint64_t bits = (uint64_t)(k + 1023) << 52;
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* exp(x) = 2^k exp(r), x = k ln 2 + r, |r| <= ln 2 / 2, with ln 2 in two parts (Cody & Waite 1980) and Taylor's
   series up to r^13, which leaves out less than 5e-18. The result is the nearest double in 98 of 100 cases, otherwise
   a neighbour of it. Below x = -708, where results would lose digits, it is 0. */
static inline double koksma__exp(double x)
{
    if (!(x >= -708)) {
        return isnan(x) ? x : 0;
    }
    if (x > 709) {
        return (double)INFINITY;
    }
    const double k = floor(x * 0x1.71547652b82fep+0 + 0.5); /* 1 / ln 2 */
    const double high = x - k * 0x1.62e42feep-1, low = -k * 0x1.a39ef35793c76p-33, r = high + low;
    double sum = 1.0 / 6227020800;
    sum = sum * r + 1.0 / 479001600;
    sum = sum * r + 1.0 / 39916800;
    sum = sum * r + 1.0 / 3628800;
    sum = sum * r + 1.0 / 362880;
    sum = sum * r + 1.0 / 40320;
    sum = sum * r + 1.0 / 5040;
    sum = sum * r + 1.0 / 720;
    sum = sum * r + 1.0 / 120;
    sum = sum * r + 1.0 / 24;
    sum = sum * r + 1.0 / 6;
    sum = sum * r + 1.0 / 2;
    const double first = 1 + high, lost = high - (first - 1); /* 1 + high = first + lost */
    return (first + (lost + (low + sum * (r * r)))) * koksma__power_of_two((int)k);
}

/* log(x) = e ln 2 + 2 artanh((m - 1) / (m + 1)), x = 2^e m, m from sqrt(1/2) to sqrt(2): the series
   of artanh in odd powers up to the 23rd, whose remainder is less than 1e-18 of the sum. The error is at most two
   units in the last place. */
static inline double koksma__log_scaled(double x, int by) /* of x 2^by; x is a positive normal number */
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    const uint64_t half = (bits & 0xfffffffffffffu) | 0x3fe0000000000000u; /* the bits of x 2^-e, from 1/2 to 1 */
    double m;
    memcpy(&m, &half, sizeof m);
    const int low = m < 0x1.6a09e667f3bcdp-1;
    const double e = (double)((int)(bits >> 52) - 1022 - low + by);
    m = low ? 2 * m : m;
    const double f = (m - 1) / (m + 1), square = f * f;
    double sum = 1.0 / 23;
    sum = sum * square + 1.0 / 21;
    sum = sum * square + 1.0 / 19;
    sum = sum * square + 1.0 / 17;
    sum = sum * square + 1.0 / 15;
    sum = sum * square + 1.0 / 13;
    sum = sum * square + 1.0 / 11;
    sum = sum * square + 1.0 / 9;
    sum = sum * square + 1.0 / 7;
    sum = sum * square + 1.0 / 5;
    sum = sum * square + 1.0 / 3;
    return e * 0x1.62e42feep-1 + (2 * f + (2 * f * square * sum + e * 0x1.a39ef35793c76p-33));
}

static inline double koksma__log(double x)
{
    if (!(x > 0 && x <= DBL_MAX)) {
        return x == 0 ? -(double)INFINITY : x > 0 ? x : (double)NAN;
    }
    return x < DBL_MIN ? koksma__log_scaled(x * 0x1p54, -54) : koksma__log_scaled(x, 0);
}

/* cos(r + rest) and sin(r + rest) for |r| <= pi/4 and `rest` below its last digit: Taylor's series up to r^18, which leave
   out less than 3e-19. */
static inline void koksma__cos_sin_near(double r, double rest, double *cosine, double *sine)
{
    const double z = r * r;
    double s = 1.0 / 355687428096000, c = -1.0 / 6402373705728000;
    s = s * z - 1.0 / 1307674368000, c = c * z + 1.0 / 20922789888000;
    s = s * z + 1.0 / 6227020800, c = c * z - 1.0 / 87178291200;
    s = s * z - 1.0 / 39916800, c = c * z + 1.0 / 479001600;
    s = s * z + 1.0 / 362880, c = c * z - 1.0 / 3628800;
    s = s * z - 1.0 / 5040, c = c * z + 1.0 / 40320;
    s = s * z + 1.0 / 120, c = c * z - 1.0 / 720;
    s = s * z - 1.0 / 6, c = c * z + 1.0 / 24;
    const double half = 0.5 * z, one = 1 - half;
    *sine = r + (rest + s * z * r);
    *cosine = one + (((1 - one) - half) + (c * z * z - r * rest));
}

/* cos(x) and sin(x) for |x| <= 2^20: x = k pi/2 + r with pi/2 in three parts (Cody & Waite 1980), |r| <= pi/4. r has a low
   part, so that the results are off by less than one unit in the last place. */
static inline void koksma__cos_sin(double x, double *cosine, double *sine)
{
    const double k = floor(x * 0x1.45f306dc9c883p-1 + 0.5); /* 2 / pi */
    const double high = x - k * 0x1.921fb544p+0, middle = k * 0x1.0b4611a6p-34, near = high - middle;
    const double low = k * 0x1.3198a2e037073p-69 - ((high - near) - middle);
    const double r = near - low, rest = (near - r) - low;
    double c, s;
    koksma__cos_sin_near(r, rest, &c, &s);
    const int quarter = (int)k & 3;
    *cosine = quarter == 0 ? c : quarter == 1 ? -s : quarter == 2 ? -c : s;
    *sine = quarter == 0 ? s : quarter == 1 ? c : quarter == 2 ? -s : -c;
}

/* erf(x) = 2/sqrt(pi) exp(-x^2) sum over i of 2^i x^(2i+1) / (1 3 .. (2i+1)) for |x| < 2; for larger |x| it is 1 -
   erfc(|x|) with the sign of x, with erfc computed by Laplace's continued fraction (Abramowitz & Stegun 1964, 7.1.6
   and 7.1.14). Relative error below 2e-15. */
static inline double koksma__erf(double x)
{
    const double a = fabs(x), square = a * a;
    if (!(a < 6)) {
        return isnan(x) ? x : copysign(1, x);
    }
    if (a < 2) {
        double term = x, sum = x;
        for (int i = 1; fabs(term) > 0x1p-55 * fabs(sum); i++) {
            term *= 2 * square / (2 * i + 1);
            sum += term;
        }
        return 0x1.20dd750429b6dp+0 * koksma__exp(-square) * sum; /* 2 / sqrt(pi) */
    }
    double fraction = a;
    for (int i = 60; i >= 1; i--) {
        fraction = a + 0.5 * i / fraction;
    }
    return copysign(1 - 0x1.20dd750429b6dp-1 * koksma__exp(-square) / fraction, x);
}

/* Giles's polynomials (2012) for inverse erf, for w = -ln(1 - x^2) below 6.25, below 16, and above; each from its highest
   power down, filled up by zeros. */
enum { KOKSMA__INVERSE_ERF_TERMS = 23 };

static inline const double *koksma__inverse_erf_terms(int part)
{
    static const double terms[3][KOKSMA__INVERSE_ERF_TERMS] = {
        {-3.6444120640178196996e-21, -1.685059138182016589e-19,  1.2858480715256400167e-18,
         1.115787767802518096e-17,   -1.333171662854620906e-16,  2.0972767875968561637e-17,
         6.6376381343583238325e-15,  -4.0545662729752068639e-14, -8.1519341976054721522e-14,
         2.6335093153082322977e-12,  -1.2975133253453532498e-11, -5.4154120542946279317e-11,
         1.051212273321532285e-09,   -4.1126339803469836976e-09, -2.9070369957882005086e-08,
         4.2347877827932403518e-07,  -1.3654692000834678645e-06, -1.3882523362786468719e-05,
         0.0001867342080340571352,   -0.00074070253416626697512, -0.0060336708714301490533,
         0.24015818242558961693,     1.6536545626831027356},
        {0,
         0,
         0,
         0,
         2.2137376921775787049e-09,
         9.0756561938885390979e-08,
         -2.7517406297064545428e-07,
         1.8239629214389227755e-08,
         1.5027403968909827627e-06,
         -4.013867526981545969e-06,
         2.9234449089955446044e-06,
         1.2475304481671778723e-05,
         -4.7318229009055733981e-05,
         6.8284851459573175448e-05,
         2.4031110387097893999e-05,
         -0.0003550375203628474796,
         0.00095328937973738049703,
         -0.0016882755560235047313,
         0.0024914420961078508066,
         -0.0037512085075692412107,
         0.005370914553590063617,
         1.0052589676941592334,
         3.0838856104922207635},
        {0,
         0,
         0,
         0,
         0,
         0,
         -2.7109920616438573243e-11,
         -2.5556418169965252055e-10,
         1.5076572693500548083e-09,
         -3.7894654401267369937e-09,
         7.6157012080783393804e-09,
         -1.4960026627149240478e-08,
         2.9147953450901080826e-08,
         -6.7711997758452339498e-08,
         2.2900482228026654717e-07,
         -9.9298272942317002539e-07,
         4.5260625972231537039e-06,
         -1.9681778105531670567e-05,
         7.5995277030017761139e-05,
         -0.00021503011930044477347,
         -0.00013871931833623122026,
         1.0103004648645343977,
         4.8499064014085844221}};
    return terms[part];
}

/* Returns t with erf(t) = x, for |x| <= 1: x times a polynomial of Giles (2012). For x = 1 it returns 6, because
   koksma__erf is 1 above 6. The kernel truncated_normals has the same steps in lanes. */
static inline double koksma__inverse_erf(double x)
{
    if (!(fabs(x) < 1)) {
        return x * 6;
    }
    const double w = -koksma__log((1 - x) * (1 + x));
    const int part = w < 6.25 ? 0 : w < 16 ? 1 : 2;
    const double *terms = koksma__inverse_erf_terms(part);
    const double z = part ? sqrt(w) - (part == 1 ? 3.25 : 5) : w - 3.125;
    double t = terms[0];
    for (int i = 1; i < KOKSMA__INVERSE_ERF_TERMS; i++) {
        t = t * z + terms[i];
    }
    return t * x;
}

#endif
