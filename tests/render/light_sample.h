/* SPDX-License-Identifier: Apache-2.0 */
/* A sample of a light at one point, by the loop that the renderer uses for blocks of them. */
#ifndef KOKSMA_TEST_LIGHT_SAMPLE_H
#define KOKSMA_TEST_LIGHT_SAMPLE_H

#include "render/lights/lights.h"
#include "render/pipelines/vertices.h"

static inline bool light_sample(const koksma__shading_light *light, const float p[3], const float u[2],
                                koksma__beam *beam)
{
    static koksma__hits hits;
    static koksma__light_lanes lanes;
    static koksma__beams out;
    static _Alignas(64) koksma__lanes pair[2];
    lanes.lights = light;
    hits.px[0] = p[0], hits.py[0] = p[1], hits.pz[0] = p[2];
    pair[0][0] = u[0], pair[1][0] = u[1];
    koksma__batch()->beams(&lanes, &hits, pair, KOKSMA__LANE_STEP, &out);
    for (int k = 0; k < 3; k++) {
        beam->d[k] = out.d[k][0];
        beam->w[k] = out.w[k][0];
        beam->value[k] = out.value[k][0];
    }
    beam->pdf = out.pdf[0];
    return out.lit[0] != 0;
}

#endif
