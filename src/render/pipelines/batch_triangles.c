/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Computes hit positions on triangles, and offsets the origins of rays that start on triangles. A hit position is
 * computed from the corners, (1 - u - v) a + u b + v c, and not from the ray, so that it is as exact as the corners.
 *
 * The origin of a ray that starts on a triangle is moved along the normal, to the side to which the ray goes, by
 * 2^-20 of the largest coordinate of the triangle. That is 8 to 16 units in the last place of that coordinate, more than
 * the error of a position on the triangle, so the ray hits neither its own triangle nor those that share its edges.
 * (The idea is from Waechter & Binder 2019, but not the size of the offset.)
 */
#include <math.h>

#include "render/pipelines/batch_kernel.h"

#define OFF 0x1p-20f

INLINE float larger(float a, float b)
{
    return a > b ? a : b;
}

/* Computes the unit normal of the triangle in lane i, whose corners are counterclockwise. The edges of the
   triangle are scaled first, because the squared area of a small triangle underflows a float. */
INLINE void normal_of(const koksma__landings *restrict l, int i, float *nx, float *ny, float *nz)
{
    const float ax = l->corners[3][i] - l->corners[0][i], bx = l->corners[6][i] - l->corners[0][i];
    const float ay = l->corners[4][i] - l->corners[1][i], by = l->corners[7][i] - l->corners[1][i];
    const float az = l->corners[5][i] - l->corners[2][i], bz = l->corners[8][i] - l->corners[2][i];
    const float a = larger(larger(fabsf(ax), fabsf(ay)), fabsf(az));
    const float b = larger(larger(fabsf(bx), fabsf(by)), fabsf(bz));
    const float p = 1 / larger(a, 1e-30f), q = 1 / larger(b, 1e-30f);
    const float x = (ay * p) * (bz * q) - (az * p) * (by * q);
    const float y = (az * p) * (bx * q) - (ax * p) * (bz * q);
    const float z = (ax * p) * (by * q) - (ay * p) * (bx * q);
    const float scale = 1 / sqrtf(x * x + y * y + z * z);
    *nx = x * scale;
    *ny = y * scale;
    *nz = z * scale;
}

void BATCH_NAME(land)(const koksma__landings *restrict l, const koksma__rays *restrict r, int n,
                      koksma__hits *restrict h)
{
    for (int i = 0; i < STEP(n); i++) {
        const int hit = l->primitive[i] >= 0;
        const float u = l->u[i], v = l->v[i], w = 1 - u - v;
        const float px = w * l->corners[0][i] + u * l->corners[3][i] + v * l->corners[6][i] + l->shift[0][i];
        const float py = w * l->corners[1][i] + u * l->corners[4][i] + v * l->corners[7][i] + l->shift[1][i];
        const float pz = w * l->corners[2][i] + u * l->corners[5][i] + v * l->corners[8][i] + l->shift[2][i];
        float nx, ny, nz;
        normal_of(l, i, &nx, &ny, &nz);
        const float side = nx * r->dx[i] + ny * r->dy[i] + nz * r->dz[i] > 0 ? -1.0f : 1.0f;
        h->t[i] = hit ? l->t[i] : h->t[i];
        h->px[i] = hit ? px : h->px[i];
        h->py[i] = hit ? py : h->py[i];
        h->pz[i] = hit ? pz : h->pz[i];
        h->nx[i] = hit ? side * nx : h->nx[i];
        h->ny[i] = hit ? side * ny : h->ny[i];
        h->nz[i] = hit ? side * nz : h->nz[i];
        h->u[i] = hit ? 0 : h->u[i];
        h->v[i] = hit ? 0 : h->v[i];
        h->back[i] = hit ? side < 0 : h->back[i];
        h->primitive[i] = hit ? l->primitive[i] : h->primitive[i];
        h->material[i] = hit ? l->material[i] : h->material[i];
    }
}

void BATCH_NAME(step_off)(const koksma__landings *restrict l, const float *restrict dx, const float *restrict dy,
                          const float *restrict dz, int n, float *restrict ox, float *restrict oy, float *restrict oz)
{
    for (int i = 0; i < STEP(n); i++) {
        float nx, ny, nz, largest = 0;
        normal_of(l, i, &nx, &ny, &nz);
        for (int k = 0; k < 9; k++) {
            largest = larger(largest, fabsf(l->corners[k][i]) + fabsf(l->shift[k % 3][i]));
        }
        const float offset = nx * dx[i] + ny * dy[i] + nz * dz[i] < 0 ? -OFF * largest : OFF * largest;
        const int on = l->primitive[i] >= 0;
        ox[i] = on ? ox[i] + offset * nx : ox[i];
        oy[i] = on ? oy[i] + offset * ny : oy[i];
        oz[i] = on ? oz[i] + offset * nz : oz[i];
    }
}
