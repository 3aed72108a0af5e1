/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Elementary functions in floats for loops over lanes: sine and cosine, arc tangent and powers by polynomials, with +
 * - * /, comparisons and conversions only, so that compilers vectorise them and every instruction set gives the same
 * bits. tests/render/test_polynomials.c checks the stated errors against long double.
 *
 * The argument of sine and cosine is in turns (an angle divided by 2 pi): the nearest quarter turn is subtracted
 * without rounding, and minimax polynomials on [-pi/4, pi/4] (Moshier's Cephes library) give the result. The arc
 * tangent is reduced to |x| <= tan(pi/8) by atan x = pi/4 + atan((x - 1) / (x + 1)). The power x^e
 * is 2^(e log2 x), computed in doubles, because e multiplies the error of the logarithm. For the mantissa m of x, ln m =
 * 2 artanh((m - 1) / (m + 1)) by its series; for the part f of e log2 x that rounding to the nearest integer leaves, 2^f
 * by the Taylor series.
 */
#ifndef KOKSMA_RENDER_ELEMENTARY_H
#define KOKSMA_RENDER_ELEMENTARY_H

#include <stdint.h>
#include <string.h>

#define KOKSMA__INLINE static inline __attribute__((always_inline))

/* The largest errors: absolute for sine and cosine; absolute and in turns for the arc tangent; relative for powers
   whose result is above 2^-126. */
#define KOKSMA__SINE_ERROR 1.3e-7
#define KOKSMA__ARC_ERROR 6e-8
#define KOKSMA__POWER_ERROR 7e-8

/* Constants 3 2^22 and 3 2^51 for rounding: added to a number, they leave the nearest integer in the low bits of the
   sum. A conversion to an integer also rounds, but gcc puts it behind a branch if its result may be unused, and then
   does not vectorise the loop. */
#define KOKSMA__SHIFT 12582912.0f
#define KOKSMA__SHIFT_2 6755399441055744.0

/* Sine and cosine of |angle| <= pi/4, in radians. */
KOKSMA__INLINE void koksma__sine_cosine(float angle, float *sine, float *cosine)
{
    const float z = angle * angle;
    *sine = angle + angle * z * (-1.6666654611e-1f + z * (8.3321608736e-3f - z * 1.9515295891e-4f));
    *cosine =
        1 - 0.5f * z + z * z * (4.166664568298827e-2f - z * (1.388731625493765e-3f - z * 2.443315711809948e-5f));
}

/* Sine and cosine of 2 pi turns, |turns| < 2^19. */
KOKSMA__INLINE void koksma__sine_cosine_turns(float turns, float *sine, float *cosine)
{
    const float shifted = 4 * turns + KOKSMA__SHIFT;
    int32_t quarter;
    memcpy(&quarter, &shifted, sizeof quarter);
    quarter -= 0x4b400000;
    const float rest = turns - 0.25f * (float)quarter;
    float s, c;
    koksma__sine_cosine(6.28318530717959f * rest, &s, &c);
    const float x = quarter & 1 ? -s : c, y = quarter & 1 ? c : s;
    *cosine = quarter & 2 ? -x : x;
    *sine = quarter & 2 ? -y : y;
}

/* The angle of (x, y) in turns, from -1/2 to 1/2; 0 at the origin. */
KOKSMA__INLINE float koksma__arc_turns(float y, float x)
{
    const float ax = x < 0 ? -x : x, ay = y < 0 ? -y : y;
    const float low = ax < ay ? ax : ay, high = ax < ay ? ay : ax, part = low / (high > 0 ? high : 1);
    const int far = part > 0.414213562373095f;
    const float t = far ? (part - 1) / (part + 1) : part, z = t * t;
    const float series =
        t + t * z * (-3.33329491539e-1f + z * (1.99777106478e-1f - z * (1.38776856032e-1f - z * 8.05374449538e-2f)));
    const float octant = series * 0.159154943091895f + (far ? 0.125f : 0);
    const float quadrant = ax < ay ? 0.25f - octant : octant, half = x < 0 ? 0.5f - quadrant : quadrant;
    return y < 0 ? -half : half;
}

/* base^exponent, 0 <= base <= 1, 0 <= exponent <= 1e7. A result below 2^-126 is 0, and base 0 counts as 2^-127. */
KOKSMA__INLINE float koksma__power(float base, float exponent)
{
    const int32_t root = 0x3f3504f3; /* the bits of sqrt(1/2) */
    int32_t bits;
    float mantissa, scale;
    memcpy(&bits, &base, sizeof bits);
    const int32_t power = (bits - root) >> 23;
    bits -= power * (1 << 23);
    memcpy(&mantissa, &bits, sizeof bits);
    const double m = (double)mantissa, s = (m - 1) / (m + 1), z = s * s;
    const double series =
        1 + z * (1.0 / 3 + z * (1.0 / 5 + z * (1.0 / 7 + z * (1.0 / 9 + z * (1.0 / 11 + z * (1.0 / 13))))));
    const double t = (double)exponent * ((double)power + 2.88539008177792681 * s * series);
    const double shifted = t + KOKSMA__SHIFT_2;
    int64_t nearest;
    memcpy(&nearest, &shifted, sizeof nearest);
    const int32_t whole = (int32_t)(uint32_t)(uint64_t)nearest;
    const double f = 0.693147180559945309 * (t - (double)whole);
    const double rest =
        1 +
        f * (1 + f * (1.0 / 2 +
                      f * (1.0 / 6 + f * (1.0 / 24 + f * (1.0 / 120 +
                                                          f * (1.0 / 720 + f * (1.0 / 5040 + f * (1.0 / 40320))))))));
    const int32_t biased = whole + 127 > 0 ? whole + 127 : 0;
    bits = biased * (1 << 23);
    memcpy(&scale, &bits, sizeof scale);
    return (float)rest * scale;
}

#endif
