/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Vectors of three floats, and elementary functions in floats, for single rays and for loops over lanes.
 *
 * The elementary functions are sine and cosine, arc tangent and powers by polynomials, with + - * /, comparisons and
 * conversions only, so that compilers vectorise them and every instruction set gives the same bits.
 * tests/render/test_polynomials.c checks the stated errors against long double.
 *
 * The argument of sine and cosine is in turns (an angle divided by 2 pi): the nearest quarter turn is subtracted
 * without rounding, and minimax polynomials on [-pi/4, pi/4] (Moshier's Cephes library) give the result. The arc
 * tangent is reduced to |x| <= tan(pi/8) by atan x = pi/4 + atan((x - 1) / (x + 1)). The power x^e
 * is 2^(e log2 x), computed in doubles, because e multiplies the error of the logarithm. For the mantissa m of x, ln m =
 * 2 artanh((m - 1) / (m + 1)) by its series; for the part f of e log2 x that rounding to the nearest integer leaves, 2^f
 * by the Taylor series.
 */
#ifndef KOKSMA_RENDER_VECTOR3_H
#define KOKSMA_RENDER_VECTOR3_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

/* ---- Elementary functions --------------------------------------------------------------------------------------- */

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

/* ---- Vectors by value ------------------------------------------------------------------------------------------- */

/* Vectors of three floats, passed by value, for formulas that are used both for single rays and in loops over lanes:
   compilers keep the members in registers, which arrays would prevent. */

typedef struct koksma__v3 {
    float x, y, z;
} koksma__v3;

KOKSMA__INLINE koksma__v3 koksma__v3_of(const float v[3])
{
    return (koksma__v3){v[0], v[1], v[2]};
}

KOKSMA__INLINE void koksma__v3_to(koksma__v3 v, float out[3])
{
    out[0] = v.x;
    out[1] = v.y;
    out[2] = v.z;
}

KOKSMA__INLINE float koksma__v3_dot(koksma__v3 a, koksma__v3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

KOKSMA__INLINE float koksma__v3_luminance(koksma__v3 a)
{
    return 0.2126f * a.x + 0.7152f * a.y + 0.0722f * a.z;
}

KOKSMA__INLINE koksma__v3 koksma__v3_scale(koksma__v3 a, float s)
{
    return (koksma__v3){s * a.x, s * a.y, s * a.z};
}

KOKSMA__INLINE koksma__v3 koksma__v3_add(koksma__v3 a, koksma__v3 b)
{
    return (koksma__v3){a.x + b.x, a.y + b.y, a.z + b.z};
}

KOKSMA__INLINE koksma__v3 koksma__v3_subtract(koksma__v3 a, koksma__v3 b)
{
    return (koksma__v3){a.x - b.x, a.y - b.y, a.z - b.z};
}

/* The products of the coordinates. */
KOKSMA__INLINE koksma__v3 koksma__v3_times(koksma__v3 a, koksma__v3 b)
{
    return (koksma__v3){a.x * b.x, a.y * b.y, a.z * b.z};
}

KOKSMA__INLINE koksma__v3 koksma__v3_cross(koksma__v3 a, koksma__v3 b)
{
    return (koksma__v3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

KOKSMA__INLINE koksma__v3 koksma__v3_unit(koksma__v3 a)
{
    return koksma__v3_scale(a, 1 / sqrtf(koksma__v3_dot(a, a)));
}

/* The mirror image of the direction w (towards the eye) at the unit normal n. */
KOKSMA__INLINE koksma__v3 koksma__v3_mirror(koksma__v3 w, koksma__v3 n)
{
    return koksma__v3_subtract(koksma__v3_scale(n, 2 * koksma__v3_dot(w, n)), w);
}

/* x u + y v + z n, where u, v and the unit vector n form an orthonormal frame (Duff et al. 2017). */
KOKSMA__INLINE koksma__v3 koksma__v3_about(koksma__v3 n, float x, float y, float z)
{
    const float sign = n.z < 0 ? -1.0f : 1.0f, a = -1 / (sign + n.z), b = n.x * n.y * a;
    const koksma__v3 u = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, v = {b, sign + n.y * n.y * a, -n.y};
    return (koksma__v3){x * u.x + y * v.x + z * n.x, x * u.y + y * v.y + z * n.y, x * u.z + y * v.z + z * n.z};
}

/* Shirley & Chiu's concentric map of the unit square to the unit disk, which preserves area: a point of [-1,1]^2 with
   side a > |b| is mapped to radius a, angle (pi/4) b/a. */
KOKSMA__INLINE void koksma__concentric(float u, float v, float *x, float *y)
{
    const float a = 2 * u - 1, b = 2 * v - 1, aa = a < 0 ? -a : a, bb = b < 0 ? -b : b;
    const int wide = aa > bb;
    const float radius = wide ? a : b, part = wide ? b : a;
    float sine, cosine;
    koksma__sine_cosine(0.785398163397448f * (part / (radius == 0 ? 1 : radius)), &sine, &cosine);
    *x = radius * (wide ? cosine : sine);
    *y = radius * (wide ? sine : cosine);
}

/* A direction about n with density cosine / pi: the concentric map, lifted (Malley's method). */
KOKSMA__INLINE koksma__v3 koksma__v3_cosine_direction(koksma__v3 n, float u, float v)
{
    float x, y;
    koksma__concentric(u, v, &x, &y);
    const float rest = 1 - x * x - y * y;
    return koksma__v3_about(n, x, y, sqrtf(rest > 0 ? rest : 0));
}

/* ---- Vectors as arrays ------------------------------------------------------------------------------------------ */

/* Vectors of three floats, for code that handles one ray at a time. */

#define KOKSMA__PI_F 3.14159265358979f

static inline float koksma__dot3(const float a[3], const float b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline void koksma__unit3(float v[3])
{
    const float scale = 1 / sqrtf(koksma__dot3(v, v));
    for (int k = 0; k < 3; k++) {
        v[k] *= scale;
    }
}

static inline float koksma__max3(const float v[3])
{
    const float m = v[0] > v[1] ? v[0] : v[1];
    return m > v[2] ? m : v[2];
}

static inline float koksma__luminance3(const float v[3])
{
    return koksma__v3_luminance(koksma__v3_of(v));
}

static inline float koksma__sample_luminance(const float *rgb, size_t channels)
{
    return channels == 1 ? rgb[0] : koksma__luminance3(rgb);
}

/* The mirror image of the direction w (towards the eye) at the unit normal n. */
static inline void koksma__mirror3(const float w[3], const float n[3], float out[3])
{
    const float twice = 2 * koksma__dot3(w, n);
    for (int k = 0; k < 3; k++) {
        out[k] = twice * n[k] - w[k];
    }
}

#endif
