/* SPDX-License-Identifier: Apache-2.0 */
/* For tests of loops over lanes: vectors in lanes, random shapes, and a sample of a light at one point, by the loop that
   the renderer uses for blocks of them. */
#ifndef KOKSMA_TEST_LANES_H
#define KOKSMA_TEST_LANES_H

#include "render/lights/lights.h"
#include "render/pipelines/vertices.h"
#include "render/shapes/shapes.h"
#include "render/vector3.h"
#include "rendering.h"

static inline void set_lane(koksma__lanes *to, int i, const float v[3])
{
    for (int k = 0; k < 3; k++) {
        to[k][i] = v[k];
    }
}

/* A vector in the cube from -size to size, or a direction of this length. */
static inline void draw_lane(koksma__lanes *to, int i, double size)
{
    const float v[3] = {(float)uniform(-size, size), (float)uniform(-size, size), (float)uniform(-size, size)};
    set_lane(to, i, v);
}

static inline void draw_direction(koksma__lanes *to, int i, double length)
{
    float v[3];
    unit_vector(v);
    for (int k = 0; k < 3; k++) {
        to[k][i] = (float)length * v[k];
    }
}

static inline void get_lane(const koksma__lanes *from, int i, double out[3])
{
    for (int k = 0; k < 3; k++) {
        out[k] = (double)from[k][i];
    }
}

/* To the last bit, but for their times. */
static inline void assert_same_hits(const koksma__hits *a, const koksma__hits *b)
{
    assert_memory_equal(a, b, offsetof(koksma__hits, time));
    assert_memory_equal(a->back, b->back, sizeof *a - offsetof(koksma__hits, back));
}

/* Shape i of a list near offset in all coordinates: of the kinds that rays meet, in turn, of this normal and material i. */
static inline koksma__shape random_shape(int i, double offset, const float normal[3])
{
    size_t kind = 0;
    koksma__shape s = {.half = {uniform(0.1, 1.2), uniform(0.1, 1.2)}, .material = i, .light = -1};
    const koksma__v3 n = koksma__v3_of(normal), u = koksma__v3_about(n, 1, 0, 0), v = koksma__v3_about(n, 0, 1, 0);
    const double frame[3][3] = {{(double)n.x, (double)n.y, (double)n.z},
                                {(double)u.x, (double)u.y, (double)u.z},
                                {(double)v.x, (double)v.y, (double)v.z}};
    for (int left = i; left >= 0; kind = koksma__shape_types[kind + 1] ? kind + 1 : 0) {
        s.type = koksma__shape_types[kind];
        left -= s.type->hit != NULL;
    }
    memcpy(s.normal, frame[0], sizeof s.normal);
    memcpy(s.axis_u, frame[1], sizeof s.axis_u);
    memcpy(s.axis_v, frame[2], sizeof s.axis_v);
    for (int k = 0; k < 3; k++) {
        s.centre[k] = offset + uniform(-4, 4);
    }
    s.half[0] = s.type == &KOKSMA__SHAPE(plane) ? (double)INFINITY : s.half[0];
    s.half[1] = s.type == &KOKSMA__SHAPE(rectangle) ? s.half[1] : s.half[0];
    return s;
}

static inline bool light_sample(const koksma__shading_light *light, const float p[3], const float u[2],
                                koksma__beam *beam)
{
    static koksma__hits hits;
    static koksma__light_lanes lanes;
    static koksma__beams out;
    static _Alignas(64) koksma__lanes pair[2];
    lanes.lights = light;
    set_lane(hits.p, 0, p);
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
