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
INLINE float estimate_at(const koksma__batch_lights *restrict l, int i, koksma__v3 p, koksma__v3 n)
{
    const koksma__v3 d = koksma__v3_subtract(AT(l->centre, i), p), normal = AT(l->normal, i);
    const float distance = sqrtf(koksma__v3_dot(d, d)), reach = l->reach[i];
    const float near = distance > reach ? distance : reach, scale = 1 / near;
    const float up = koksma__v3_dot(n, d), facing = -koksma__v3_dot(normal, d);
    const float down = l->flat[i] > 0 ? facing : distance;
    const int apart = (n.x == 0) & (n.y == 0) & (n.z == 0);
    const float cosine = apart ? 1 : up * scale, at_hit = cosine > LEAST ? cosine : LEAST;
    const float at_light = down * scale > LEAST ? down * scale : LEAST;
    const int seen = (up + reach > 0) & (down > 0);
    const float here = l->power[i] * at_hit * at_light * (scale * scale);
    const float away = apart ? 1 : -koksma__v3_dot(normal, n);
    return (seen ? here : 0) + l->far[i] * (away > 0 ? away : 0) + l->fixed[i];
}

float BATCH_NAME(estimate)(const koksma__batch_lights *l, const float p[3], const float normal[3], float *out)
{
    const koksma__v3 at = koksma__v3_of(p), n = koksma__v3_of(normal);
    float sums[KOKSMA__LANE_STEP] = {0};
    for (int start = 0; start < l->whole; start += KOKSMA__LANE_STEP) {
        for (int k = 0; k < KOKSMA__LANE_STEP; k++) {
            out[start + k] = estimate_at(l, start + k, at, n);
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
            const float value = estimate_at(l, k, AT(h->p, i), AT(h->n, i));
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
