/* SPDX-License-Identifier: Apache-2.0 */
/* Choosing lights against a plain twin in double precision, and shadows of small spheres: the same bits for every
   instruction set. */
#include "lanes.h"

static void random_lamps(koksma__batch_lights *l)
{
    memset(l, 0, sizeof *l);
    l->n = 5 + (int)uniform(0, 60);
    l->whole = (l->n + KOKSMA__LANE_STEP - 1) / KOKSMA__LANE_STEP * KOKSMA__LANE_STEP;
    for (int i = 0; i < KOKSMA__MAX_BATCH_LIGHTS; i++) {
        float normal[3];
        unit_vector(normal);
        const int kind = (int)uniform(0, 4);
        l->reach[i] = 1;
        if (i >= l->n) {
            continue;
        }
        for (int k = 0; k < 3; k++) {
            l->centre[k][i] = uniform(-3, 3);
            l->normal[k][i] = normal[k];
        }
        l->reach[i] = uniform(0.01, 0.6);
        l->flat[i] = kind == 0;
        l->power[i] = kind < 2 ? uniform(0, 5) : 0;
        l->far[i] = kind == 2 ? uniform(0, 5) : 0;
        l->fixed[i] = kind == 3 ? uniform(0, 1) : 0;
    }
}

/* The definition of batch.h, in double precision. near_edge: within rounding of going out of sight. */
static double twin(const koksma__batch_lights *l, int i, const float p[3], const float n[3], bool *near_edge)
{
    double d[3], m[3];
    for (int k = 0; k < 3; k++) {
        d[k] = (double)l->centre[k][i] - (double)p[k];
        m[k] = (double)l->normal[k][i];
    }
    const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), r = fmax(length, (double)l->reach[i]);
    double up = 0, down = 0, away = 0;
    for (int k = 0; k < 3; k++) {
        up += (double)n[k] * d[k];
        down -= m[k] * d[k];
        away -= m[k] * (double)n[k];
    }
    down = l->flat[i] > 0 ? down : length;
    *near_edge = fabs(up + (double)l->reach[i]) < 1e-5 || fabs(down) < 1e-5 || fabs(away) < 1e-5;
    const bool seen = up + (double)l->reach[i] > 0 && down > 0;
    const double here = (double)l->power[i] * fmax(up / r, 0.05) * fmax(down / r, 0.05) / (r * r);
    return (seen ? here : 0) + (double)l->far[i] * fmax(away, 0) + (double)l->fixed[i];
}

TEST_CASE(estimates_equal_twin)
{
    static koksma__batch_lights lamps;
    for (int round = 0; round < 300; round++) {
        const float p[3] = {uniform(-3, 3), uniform(-3, 3), uniform(-3, 3)};
        float n[3], out[4][KOKSMA__MAX_BATCH_LIGHTS], totals[4];
        unit_vector(n);
        random_lamps(&lamps);
        for (int isa = 0; isa < 4; isa++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
            if (!batch) {
                continue;
            }
            totals[isa] = batch->estimate(&lamps, p, n, out[isa]);
            assert_memory_equal(out[isa], out[0], (size_t)lamps.n * sizeof(float));
            assert_memory_equal(&totals[isa], &totals[0], sizeof(float));
        }
        double sum = 0;
        for (int i = 0; i < lamps.n; i++) {
            bool near_edge;
            const double expected = twin(&lamps, i, p, n, &near_edge);
            sum += (double)out[0][i];
            assert_true(near_edge || fabs((double)out[0][i] - expected) <= 1e-4 * expected + 1e-6);
        }
        assert_near((double)totals[0], sum, 1e-5 * sum + 1e-12);
    }
}

/* Shadow rays that pass a small sphere far away at 0.98 or 1.02 of its radius, or end before it: at distance D floats
   know a place to some D / 10^7. */
TEST_CASE(small_spheres_far_away_shade)
{
    for (int round = 0; round < 300; round++) {
        const koksma__shape unit = {.type = &KOKSMA__SHAPE(sphere), .half = {1, 1}, .material = -1};
        koksma__batch_shape sphere = koksma__batch_shape_of(&unit, 7);
        koksma__hits hits = {0};
        koksma__shadows shadows[4];
        KOKSMA__LANES(int32_t, aimed);
        const float distance = powf(10, uniform(0, 3)), radius = distance * powf(10, uniform(-4.5, -1));
        sphere.radius2 = radius * radius;
        int dark[KOKSMA__BLOCK];
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            float n[3], m[3];
            unit_vector(n);
            unit_vector(m);
            const float along = m[0] * n[0] + m[1] * n[1] + m[2] * n[2], rest = sqrtf(1 - along * along);
            const bool passes = i % 2, stops = i % 8 == 2;
            const float far = stops ? distance * 0.9f - radius : powf(10, uniform(0, 3)) * distance + 2 * radius;
            for (int k = 0; k < 3; k++) {
                const float across = (m[k] - along * n[k]) / rest;
                hits.p[k][i] = (passes ? 1.02f : 0.98f) * radius * across - distance * n[k];
                shadows[0].d[k][i] = far * n[k];
            }
            aimed[i] = i % 8 == 4 ? 7 : i % 8; /* to this light; to another one */
            dark[i] = !passes && !stops && aimed[i] != 7;
            hits.primitive[i] = -1;
        }
        const koksma__batch_shapes shapes = {.n = 1, .shapes = &sphere};
        for (int isa = 0; isa < 4; isa++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
            if (!batch) {
                continue;
            }
            shadows[isa] = shadows[0];
            shadows[isa].aimed = aimed;
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                shadows[isa].light[i] = 1;
            }
            batch->occlude(&shapes, &hits, KOKSMA__BLOCK, &shadows[isa]);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                assert_int_equal(shadows[isa].light[i] == 0, dark[i]);
            }
        }
    }
}
