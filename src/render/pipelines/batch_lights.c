/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How much each light may give to one point, all lights in lanes: the estimate of batch.h, which never is 0 where
 * anything can come. Cosines are at least LEAST, because a light whose centre is at the horizon is half above it.
 */
#include <math.h>

#include "render/pipelines/batch_kernel.h"

#define LEAST 0.05f /* of a cosine where any position of a light is above the horizon */

float BATCH_NAME(estimate)(const koksma__batch_lights *l, const float p[3], const float normal[3], float *out)
{
    const float px = p[0], py = p[1], pz = p[2], nx = normal[0], ny = normal[1], nz = normal[2];
    float sums[KOKSMA__LANE_STEP] = {0};
    for (int start = 0; start < l->whole; start += KOKSMA__LANE_STEP) {
        for (int k = 0; k < KOKSMA__LANE_STEP; k++) {
            const int i = start + k;
            const float dx = l->cx[i] - px, dy = l->cy[i] - py, dz = l->cz[i] - pz;
            const float square = dx * dx + dy * dy + dz * dz, distance = sqrtf(square), reach = l->reach[i];
            const float near = distance > reach ? distance : reach, scale = 1 / near;
            const float up = nx * dx + ny * dy + nz * dz;
            const float facing = -(l->nx[i] * dx + l->ny[i] * dy + l->nz[i] * dz);
            const float down = l->flat[i] > 0 ? facing : distance;
            const float at_hit = up * scale > LEAST ? up * scale : LEAST;
            const float at_light = down * scale > LEAST ? down * scale : LEAST;
            const int seen = (up + reach > 0) & (down > 0);
            const float here = l->power[i] * at_hit * at_light * (scale * scale);
            const float away = -(l->nx[i] * nx + l->ny[i] * ny + l->nz[i] * nz);
            const float value = (seen ? here : 0) + l->far[i] * (away > 0 ? away : 0) + l->fixed[i];
            out[i] = value;
            sums[k] += value;
        }
    }
    float total = 0;
    for (int k = 0; k < KOKSMA__LANE_STEP; k++) {
        total += sums[k];
    }
    return total;
}
