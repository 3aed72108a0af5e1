/* SPDX-License-Identifier: Apache-2.0 */
/* A list of shapes in bundles is met as the same list without them, to the last bit, by every instruction set: by rays from
   near and far, along axes, in the planes of shapes, to their edges, from shape to shape, and of two shapes in one
   place. */
#include "lanes.h"
#include "render/accel/accel.h"

enum { SHAPES = 60, ROUNDS = test_repeats(60, 4) };

static void make_shapes(double offset, koksma__batch_shape list[SHAPES])
{
    for (int i = 0; i < SHAPES; i++) {
        float n[3];
        unit_vector(n);
        for (int k = 0; k < 3 && i % 2 == 0; k++) { /* along an axis */
            n[k] = k == i % 3;
        }
        koksma__shape s = random_shape(i, offset, n);
        s.material = i % 9 ? i : -1;
        for (int k = 0; k < 3; k++) {
            s.motion[k] = i % 20 == 19 && !s.type->is_flat ? uniform(-1, 1) : 0;
        }
        list[i] = koksma__batch_shape_of(&s, i);
        if (i % 10 == 9) { /* in the place of one before */
            const int32_t material = list[i].material;
            list[i] = list[i - 5];
            list[i].id = i;
            list[i].material = material;
        }
    }
    koksma__batch_shape *large = &list[SHAPES - 1]; /* alone, behind a rectangle of a bundle in its plane */
    *large = list[SHAPES - 7];
    large->id = SHAPES - 1;
    large->half_u = large->half_v = 40;
}

/* A place on the edge of a shape, or in or near it. */
static void place_on(const koksma__batch_shape *s, float to[3])
{
    static const float edges[] = {-1, 0, 1};
    const bool edge = uniform(0, 1) < 0.5;
    const float half = s->half_u < INFINITY ? s->half_u : 3, other = s->half_v < INFINITY ? s->half_v : 3;
    const float u = edge ? edges[(int)uniform(0, 3)] : (float)uniform(-1.3, 1.3);
    const float v = edge ? edges[(int)uniform(0, 3)] : (float)uniform(-1.3, 1.3);
    for (int k = 0; k < 3; k++) {
        to[k] = s->centre[k] + half * u * s->axis_u[k] + other * v * s->axis_v[k];
    }
}

static void make_rays(const koksma__batch_shape *list, double offset, koksma__rays *r)
{
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        const koksma__batch_shape *s = &list[(int)uniform(0, SHAPES)];
        const double far = i % 4 == 1 ? 300 : 5, lift = pow(10, uniform(-9, -1));
        float o[3], to[3];
        place_on(s, to);
        for (int k = 0; k < 3; k++) {
            o[k] = (float)(offset + uniform(-far, far));
        }
        if (i % 4 == 2) { /* along an axis */
            const int k = (int)uniform(0, 3);
            o[k] = to[k] + (uniform(0, 1) < 0.5 ? -3.0f : 3.0f);
            o[(k + 1) % 3] = to[(k + 1) % 3];
            o[(k + 2) % 3] = to[(k + 2) % 3];
        } else if (i % 4 == 3) { /* almost in the plane of the shape */
            place_on(s, o);
            for (int k = 0; k < 3; k++) {
                o[k] = 2 * o[k] - to[k] + (float)lift * s->normal[k];
            }
        }
        set_lane(r->o, i, o);
        for (int k = 0; k < 3; k++) {
            r->d[k][i] = to[k] - o[k];
        }
        r->time[i] = (float)uniform(0, 1);
    }
}

/* Traces rays, then those on from the hits, then shadow rays from hit to hit, of which `lit` in
   5 carry light; returns how many would be blocked. */
static int check(const koksma__batch_table *batch, const koksma__batch_shapes *plain,
                 const koksma__batch_shapes *bundled, const koksma__rays *rays, int lit)
{
    KOKSMA__LANES(int32_t, aimed);
    koksma__hits a, b, next;
    koksma__rays on = *rays;
    koksma__shadows shadows, dim, bright;
    int blocked = 0;
    assert_int_equal(batch->closest(plain, rays, NULL, KOKSMA__BLOCK, &a),
                     batch->closest(bundled, rays, NULL, KOKSMA__BLOCK, &b));
    assert_same_hits(&a, &b);
    memcpy(on.o, a.p, sizeof on.o);
    assert_int_equal(batch->closest(plain, &on, a.primitive, KOKSMA__BLOCK, &next),
                     batch->closest(bundled, &on, a.primitive, KOKSMA__BLOCK, &b));
    assert_same_hits(&next, &b);
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        const int to = (i * 37 + 11) % KOKSMA__BLOCK;
        for (int k = 0; k < 3; k++) {
            shadows.d[k][i] = a.p[k][to] - a.p[k][i];
        }
        shadows.light[i] = i % 5 < lit ? 1 : 0;
        bright.light[i] = 1;
        aimed[i] = a.primitive[to];
        a.time[i] = rays->time[i];
    }
    shadows.aimed = bright.aimed = aimed;
    memcpy(bright.d, shadows.d, sizeof bright.d);
    dim = shadows;
    batch->occlude(plain, &a, KOKSMA__BLOCK, &bright);
    batch->occlude(plain, &a, KOKSMA__BLOCK, &shadows);
    batch->occlude(bundled, &a, KOKSMA__BLOCK, &dim);
    assert_memory_equal(shadows.light, dim.light, sizeof dim.light);
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        assert_true(shadows.light[i] == (i % 5 < lit ? bright.light[i] : 0));
        blocked += !(bright.light[i] > 0);
    }
    return blocked;
}

TEST_CASE(bundles_change_no_bit)
{
    static const double offsets[] = {0, 20, 1000};
    int blocked = 0;
    for (int round = 0; round < 3 * ROUNDS; round++) {
        koksma__batch_shape list[SHAPES];
        koksma__batch_bundle bundles[SHAPES];
        uint32_t order[SHAPES];
        koksma__batch_shapes plain = {.n = SHAPES, .shapes = list}, bundled = plain;
        koksma__rays rays;
        make_shapes(offsets[round % 3], list);
        assert_ok(koksma__bundle(&bundled, bundles, order));
        assert_true(bundled.n_bundles > 1 && bundled.n_alone < SHAPES / 2);
        make_rays(list, offsets[round % 3], &rays);
        for (int k = 0; k < 4; k++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[k]);
            blocked += batch ? check(batch, &plain, &bundled, &rays, round % 6) : 0;
        }
    }
    assert_true(blocked > 20 * ROUNDS);
}

/* Each shape is in one bundle, within its box, or alone. */
TEST_CASE(bundles_hold_each_shape_once)
{
    koksma__batch_shape list[SHAPES];
    koksma__batch_bundle bundles[SHAPES];
    uint32_t order[SHAPES];
    int times[SHAPES] = {0};
    koksma__batch_shapes to = {.n = SHAPES, .shapes = list};
    make_shapes(0, list);
    assert_ok(koksma__bundle(&to, bundles, order));
    size_t at = to.n_alone;
    for (size_t b = 0; b < to.n_bundles; b++) {
        assert_int_equal(bundles[b].first, at);
        for (at = bundles[b].first; at < bundles[b].end; at++) {
            for (int k = 0; k < 3; k++) {
                const float c = list[order[at]].centre[k];
                assert_true(c >= bundles[b].low[k] && c <= bundles[b].high[k]);
            }
        }
    }
    assert_int_equal(at, SHAPES);
    for (size_t i = 0; i < SHAPES; i++) {
        times[order[i]]++;
    }
    for (int i = 0; i < SHAPES; i++) {
        assert_int_equal(times[i], 1);
    }
}
