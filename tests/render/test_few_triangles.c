/* SPDX-License-Identifier: Apache-2.0 */
/* Rays that test all triangles of a scene, beside the intersection by Cramer's rule in double precision (Moeller &
   Trumbore 1997), and on a closed surface, through which no ray may pass. */
#include "core/vector.h"
#include "lanes.h"
#include "render/accel/accel.h"

typedef struct world {
    koksma__batch_faces faces;
    double corners[KOKSMA__MAX_FACES][3][3];
    koksma__rays rays;
    koksma__hits hits;
    koksma__landings on;
    koksma__shadows shadows;
} world;

static void add_face(world *w, const float a[3], const float b[3], const float c[3])
{
    const float *const corners[3] = {a, b, c};
    const int n = w->faces.n++;
    assert_true(koksma__face_of(a, b, c, &w->faces.faces[n]));
    w->faces.faces[n].part = n;
    w->faces.faces[n].triangle = (uint32_t)(1000 + n);
    for (int i = 0; i < 9; i++) {
        w->corners[n][i / 3][i % 3] = (double)corners[i / 3][i % 3];
    }
}

static void add_random_face(world *w)
{
    float c[3][3];
    for (int i = 0; i < 9; i++) {
        c[i / 3][i % 3] = (float)uniform(-2, 2);
    }
    add_face(w, c[0], c[1], c[2]);
}

/* Rays from a point of the box [-reach, reach]^3, as rays, and as shadow rays to hits at t = 0. */
static void aim(world *w, double reach)
{
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        draw_lane(w->rays.o, i, reach);
        draw_lane(w->rays.d, i, 4);
        w->shadows.light[i] = 1;
        w->hits.t[i] = INFINITY;
    }
    memcpy(w->hits.p, w->rays.o, sizeof w->hits.p);
    memcpy(w->shadows.d, w->rays.d, sizeof w->shadows.d);
}

static int trace(const koksma__batch_table *batch, world *w)
{
    batch->shade_faces(&w->faces, w->rays.o, &w->hits, KOKSMA__BLOCK, &w->shadows);
    return batch->meet_faces(&w->faces, w->rays.o, &w->rays, &w->hits, KOKSMA__BLOCK, &w->on);
}

/* Where ray i meets triangle k: t and the weights; returns how far inside the triangle that is, or -1 for t <= 0. */
static double meet(const world *w, int i, int k, double out[3])
{
    const double(*c)[3] = w->corners[k];
    double o[3], d[3], e[3], f[3], s[3], p[3], q[3];
    get_lane(w->rays.o, i, o);
    get_lane(w->rays.d, i, d);
    koksma__subtract(c[1], c[0], e);
    koksma__subtract(c[2], c[0], f);
    koksma__subtract(o, c[0], s);
    koksma__cross(d, f, p);
    koksma__cross(s, e, q);
    const double determinant = koksma__dot(p, e);
    out[0] = koksma__dot(q, f) / determinant;
    out[1] = koksma__dot(p, s) / determinant;
    out[2] = koksma__dot(q, d) / determinant;
    return out[0] > 0 ? fmin(fmin(out[1], out[2]), 1 - out[1] - out[2]) : -1;
}

TEST_CASE(few_triangles_are_met_as_by_cramers_rule)
{
    const double near = 1e-4;
    int met = 0, unclear = 0, lanes = 0;
    for (int round = 0; round < test_repeats(60, 6); round++) {
        static world w;
        w.faces.n = 0;
        for (int k = 0; k < 20; k++) {
            add_random_face(&w);
        }
        aim(&w, 2);
        const int count = trace(koksma__batch(), &w);
        met += count;
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            double nearest = INFINITY, weights[2] = {0, 0};
            int which = -1;
            bool clear = true;
            for (int k = 0; k < w.faces.n; k++) {
                double found[3];
                const double inside = meet(&w, i, k, found);
                clear = clear && fabs(inside) > near && fabs(found[0]) > near && fabs(found[0] - 1) > near &&
                        fabs(found[0] - nearest) > near;
                if (inside > 0 && found[0] < nearest) {
                    nearest = found[0];
                    weights[0] = found[1];
                    weights[1] = found[2];
                    which = k;
                }
            }
            lanes++;
            unclear += !clear;
            if (clear) {
                assert_int_equal(w.on.primitive[i], which);
                assert_true((w.shadows.light[i] == 0) == (nearest < 1));
            }
            if (clear && which >= 0) {
                assert_int_equal(w.on.triangle[i], 1000 + which);
                assert_near((double)w.on.t[i], nearest, 1e-3 * (1 + nearest));
                assert_near((double)w.on.u[i], weights[0], 1e-3);
                assert_near((double)w.on.v[i], weights[1], 1e-3);
            }
        }
    }
    assert_true(met > lanes / 4 && met < lanes);
    assert_true(unclear < lanes / 10);
}

/* A box of random size whose corners are moved at random, far from the origin: from inside, every ray hits it. Rays are
   aimed at its edges and corners, too, where rounding decides. */
TEST_CASE(no_ray_passes_between_two_of_few_triangles)
{
    static const int quads[6][4] = {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1},
                                    {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}};
    for (int round = 0; round < test_repeats(2000, 20); round++) {
        static world w;
        float corners[8][3];
        const double away = uniform(0, 30), size = uniform(0.1, 3);
        w.faces.n = 0;
        for (int c = 0; c < 8; c++) {
            for (int k = 0; k < 3; k++) {
                corners[c][k] = (float)(away + size * ((c >> k & 1) * 2 - 1 + uniform(-0.3, 0.3)));
            }
        }
        for (int q = 0; q < 6; q++) {
            add_face(&w, corners[quads[q][0]], corners[quads[q][1]], corners[quads[q][2]]);
            add_face(&w, corners[quads[q][0]], corners[quads[q][2]], corners[quads[q][3]]);
        }
        aim(&w, 0.2 * size);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const float *a = corners[i % 8], *b = corners[i / 8 % 8];
            const float part = i % 3 ? (float)uniform(0, 1) : 0;
            for (int k = 0; k < 3; k++) {
                w.rays.o[k][i] += (float)away;
                w.rays.d[k][i] = (1 - part) * a[k] + part * b[k] - w.rays.o[k][i];
            }
        }
        assert_int_equal(trace(koksma__batch(), &w), KOKSMA__BLOCK);
    }
}

TEST_CASE(few_triangles_have_the_same_bits_for_every_instruction_set)
{
    static world first, w;
    for (int isa = 0; isa < 4; isa++) {
        const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
        if (!batch) {
            continue;
        }
        counter = 77;
        memset(&w, 0, sizeof w);
        for (int k = 0; k < 12; k++) {
            add_random_face(&w);
        }
        aim(&w, 2);
        trace(batch, &w);
        if (isa == 0) {
            memcpy(&first, &w, sizeof w);
        }
        assert_memory_equal(&w.on, &first.on, sizeof w.on);
        assert_memory_equal(&w.shadows, &first.shadows, sizeof w.shadows);
    }
}

TEST_CASE(a_triangle_without_area_is_no_face)
{
    koksma__batch_face face;
    assert_true(
        !koksma__face_of((const float[]){1, 2, 3}, (const float[]){2, 4, 6}, (const float[]){3, 6, 9}, &face));
}

/* A bundle of part of the triangles changes no bit, whatever stands before and behind it. */
TEST_CASE(bundled_triangles_are_met_alike)
{
    static world w, bundled;
    int met = 0, dark = 0;
    for (int round = 0; round < test_repeats(200, 10); round++) {
        const double offset = round % 3 == 2 ? 1000 : 0;
        const size_t first = (size_t)round % 5, end = first + KOKSMA__BUNDLED_FACES + (size_t)round % 7;
        koksma__batch_bundle box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}, first, end};
        w.faces = (koksma__batch_faces){0};
        for (size_t k = 0; k < 20; k++) {
            const bool in = k >= first && k < end;
            float c[3][3];
            for (int i = 0; i < 9; i++) {
                c[i / 3][i % 3] = (float)(offset + (in ? uniform(-0.5, 0.8) : uniform(-2, 2)));
                box.low[i % 3] = in ? fminf(box.low[i % 3], c[i / 3][i % 3]) : box.low[i % 3];
                box.high[i % 3] = in ? fmaxf(box.high[i % 3], c[i / 3][i % 3]) : box.high[i % 3];
            }
            add_face(&w, c[0], c[1], c[2]);
        }
        aim(&w, 2);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const int face = (int)uniform(0, 20), corner = (int)uniform(0, 3);
            for (int k = 0; k < 3; k++) { /* some to corners, from anywhere */
                w.hits.p[k][i] = w.rays.o[k][i] += (float)offset;
                w.rays.d[k][i] = i % 2 ? w.rays.d[k][i] : (float)w.corners[face][corner][k] - w.rays.o[k][i];
            }
            w.shadows.light[i] = i % 7 ? 1 : 0;
        }
        bundled = w;
        bundled.faces.n_bundles = 1;
        bundled.faces.bundles[0] = box;
        bundled.faces.size = (float)(3 * (offset + 1));
        for (int k = 0; k < 4; k++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[k]);
            if (!batch) {
                continue;
            }
            const int count = trace(batch, &w);
            assert_int_equal(trace(batch, &bundled), count);
            met += count;
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                dark += w.shadows.light[i] == 0;
                assert_int_equal(w.on.primitive[i], bundled.on.primitive[i]);
                assert_true(w.shadows.light[i] == bundled.shadows.light[i]);
                if (w.on.primitive[i] >= 0) {
                    assert_int_equal(w.on.triangle[i], bundled.on.triangle[i]);
                    assert_memory_equal(&w.on.t[i], &bundled.on.t[i], sizeof(float));
                    assert_memory_equal(&w.on.u[i], &bundled.on.u[i], sizeof(float));
                    assert_memory_equal(&w.on.v[i], &bundled.on.v[i], sizeof(float));
                }
            }
        }
    }
    assert_true(met > test_repeats(10000, 500) && dark > test_repeats(10000, 500));
}
