/* SPDX-License-Identifier: Apache-2.0 */
/* Vectors of three floats, passed by value, for formulas that are used both for single rays and in loops over lanes:
   compilers keep the members in registers, which arrays would prevent. */
#ifndef KOKSMA_RENDER_LANES3_H
#define KOKSMA_RENDER_LANES3_H

#include <math.h>

#include "render/elementary.h"

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

#endif
