/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Estimates how much light each light may give to a point, by the formula of koksma__batch_lights (batch.h):
 * `estimate` for all lights at one point, `choose` to select one light at each point of a block. An estimate is never
 * 0 for a light that can reach the point: cosines are at least LEAST, because half of a light is above the horizon
 * when its centre is at the horizon. A normal of (0, 0, 0) stands for a point in a medium, where no cosine reduces
 * the light.
 */
#include <math.h>

#include "render/pipelines/batch_kernel.h"

#define LEAST 0.05f /* lower bound of the cosine for a light that is partly above the horizon */

/* Returns the estimate of light i at a point. */
INLINE float estimate_at(const koksma__batch_lights *restrict l, int i, float px, float py, float pz, float nx,
                         float ny, float nz)
{
    const float dx = l->cx[i] - px, dy = l->cy[i] - py, dz = l->cz[i] - pz;
    const float square = dx * dx + dy * dy + dz * dz, distance = sqrtf(square), reach = l->reach[i];
    const float near = distance > reach ? distance : reach, scale = 1 / near;
    const float up = nx * dx + ny * dy + nz * dz;
    const float facing = -(l->nx[i] * dx + l->ny[i] * dy + l->nz[i] * dz);
    const float down = l->flat[i] > 0 ? facing : distance;
    const int apart = (nx == 0) & (ny == 0) & (nz == 0);
    const float cosine = apart ? 1 : up * scale, at_hit = cosine > LEAST ? cosine : LEAST;
    const float at_light = down * scale > LEAST ? down * scale : LEAST;
    const int seen = (up + reach > 0) & (down > 0);
    const float here = l->power[i] * at_hit * at_light * (scale * scale);
    const float away = apart ? 1 : -(l->nx[i] * nx + l->ny[i] * ny + l->nz[i] * nz);
    return (seen ? here : 0) + l->far[i] * (away > 0 ? away : 0) + l->fixed[i];
}

float BATCH_NAME(estimate)(const koksma__batch_lights *l, const float p[3], const float normal[3], float *out)
{
    const float px = p[0], py = p[1], pz = p[2], nx = normal[0], ny = normal[1], nz = normal[2];
    float sums[KOKSMA__LANE_STEP] = {0};
    for (int start = 0; start < l->whole; start += KOKSMA__LANE_STEP) {
        for (int k = 0; k < KOKSMA__LANE_STEP; k++) {
            out[start + k] = estimate_at(l, start + k, px, py, pz, nx, ny, nz);
            sums[k] += out[start + k];
        }
    }
    float total = 0;
    for (int k = 0; k < KOKSMA__LANE_STEP; k++) {
        total += sums[k];
    }
    return total;
}

/* In this kernel each lane is a point. It estimates the contribution of each light to each point, then selects for
   each point the first light at which the cumulative sum of the estimates exceeds u times their total. If rounding
   leaves no such light, it selects the last light with a positive estimate. */
void BATCH_NAME(choose)(const koksma__batch_lights *l, const koksma__hits *restrict h, const float *restrict u, int n,
                        float (*restrict estimates)[KOKSMA__BLOCK], int32_t *restrict light,
                        float *restrict probability)
{
    KOKSMA__LANES(float, total);
    KOKSMA__LANES(float, rest);
    KOKSMA__LANES(int32_t, done);
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        total[i] = 0;
    }
    for (int k = 0; k < l->n; k++) {
        float *restrict row = estimates[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const float value = estimate_at(l, k, h->px[i], h->py[i], h->pz[i], h->nx[i], h->ny[i], h->nz[i]);
            row[i] = value;
            total[i] += value;
        }
    }
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        rest[i] = u[i] * total[i];
        light[i] = -1;
        probability[i] = 1;
        done[i] = 0;
    }
    for (int k = 0; k < l->n; k++) {
        const float *restrict row = estimates[k];
        LANES_APART
        for (int i = 0; i < STEP(n); i++) {
            const float value = row[i];
            const int can = (value > 0) & !done[i];
            light[i] = can ? k : light[i];
            probability[i] = can ? value : probability[i];
            done[i] |= can & (rest[i] < value);
            rest[i] -= value;
        }
    }
    LANES_APART
    for (int i = 0; i < STEP(n); i++) {
        probability[i] = light[i] >= 0 ? probability[i] / total[i] : 1;
    }
}
