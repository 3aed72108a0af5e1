/* SPDX-License-Identifier: Apache-2.0 */
/* Shapes that a part of the film is said not to see are met by none of its rays: places all over random parts,
   through random cameras (narrow and wide, far from and almost in the plane of a shape, far from the origin), traced
   with all shapes and with those in sight, to the last bit. Shapes that are said to be clear of shadow rays block none
   of them. */
#include "lanes.h"
#include "render/culling.h"

enum { SHAPES = 6, ROUNDS = test_repeats(300, 20), PARTS = 40, SIDE = 100 };

/* An orthonormal frame, but for rounding. */
static void frame(float n[3], float u[3], float v[3])
{
    unit_vector(n);
    koksma__v3_to(koksma__v3_about(koksma__v3_of(n), 1, 0, 0), u);
    koksma__v3_to(koksma__v3_about(koksma__v3_of(n), 0, 1, 0), v);
}

/* Shapes of every kind of the table in turn; the second is a rectangle. */
static void make_shapes(double offset, koksma__batch_shape list[SHAPES])
{
    for (int i = 0; i < SHAPES; i++) {
        float n[3];
        unit_vector(n);
        const koksma__shape s = random_shape(i, offset, n);
        list[i] = koksma__batch_shape_of(&s, i);
    }
}

/* height: of the eye over the plane of the second shape, a rectangle; 0: anywhere. */
static void make_camera(const koksma__batch_shape *list, double offset, double height, koksma__batch_camera *c)
{
    float forward[3], right[3], down[3];
    const double step = 2 * tan(pow(10, uniform(-2.5, 0.1)) / 2) / SIDE;
    frame(forward, right, down);
    for (int k = 0; k < 3; k++) {
        const double on_plane = (double)list[1].centre[k] + 3 * (double)list[1].axis_u[k];
        c->eye[k] = (float)(height > 0 ? on_plane + height * (double)list[1].normal[k] : offset + uniform(-4, 4));
        const double ahead = height > 0 ? -(double)list[1].axis_u[k] : (double)forward[k];
        c->step_x[k] = (float)(step * (double)(height > 0 ? list[1].axis_v[k] : right[k]));
        c->step_y[k] = (float)(step * (double)(height > 0 ? list[1].normal[k] : down[k]));
        c->base[k] = (float)(ahead - 0.5 * SIDE * ((double)c->step_x[k] + (double)c->step_y[k]));
    }
}

/* Film places: the corners and edges of the part, and inside. */
static void make_places(const double x[2], const double y[2], float xy[2 * KOKSMA__BLOCK])
{
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        const int last = KOKSMA__BLOCK / 8 - 1;
        const double u = i % 8 / 7.0, v = (double)(i / 8) / last;
        const bool edge = i % 8 == 0 || i % 8 == 7 || i / 8 == 0 || i / 8 == last;
        xy[2 * i] = (float)(x[0] + (x[1] - x[0]) * (edge ? u : uniform(0, 1)));
        xy[2 * i + 1] = (float)(y[0] + (y[1] - y[0]) * (edge ? v : uniform(0, 1)));
    }
}

/* The numbers of shapes out of sight, and of those that no ray met. */
typedef struct tally {
    int hidden, missed;
} tally;

static void check_part(const koksma__frustum_cull *sight, const koksma__batch_camera *camera,
                       const koksma__batch_shapes *shapes, tally *sum)
{
    const koksma__batch_table *batch = koksma__batch();
    const double side = pow(2, uniform(-3, 5)), left = uniform(0, SIDE - side), top = uniform(0, SIDE - side);
    const double x[2] = {left, left + side}, y[2] = {top, top + side};
    _Alignas(64) float xy[2 * KOKSMA__BLOCK];
    koksma__rays rays;
    koksma__hits all, some;
    koksma__batch_shape list[SHAPES];
    size_t seen[SHAPES];
    bool met[SHAPES] = {false};
    make_places(x, y, xy);
    batch->camera(camera, xy, KOKSMA__BLOCK, &rays);
    const size_t n = koksma__frustum_cull_shapes(sight, x, y, seen);
    for (size_t i = 0; i < n; i++) {
        list[i] = shapes->shapes[seen[i]];
    }
    const koksma__batch_shapes in_sight = {.n = n, .shapes = list};
    const int hit = batch->closest(shapes, &rays, NULL, KOKSMA__BLOCK, &all);
    assert_int_equal(batch->closest(&in_sight, &rays, NULL, KOKSMA__BLOCK, &some), hit);
    assert_same_hits(&all, &some);
    /* One by one, too: a shape that stands behind another must not be forgotten. */
    for (size_t k = 0; k < SHAPES; k++) {
        const koksma__batch_shapes one = {.n = 1, .shapes = &shapes->shapes[k]};
        met[k] = batch->closest(&one, &rays, NULL, KOKSMA__BLOCK, &some) > 0;
        bool is_seen = false;
        for (size_t i = 0; i < n; i++) {
            is_seen |= seen[i] == k;
        }
        assert_true(is_seen || !met[k]);
        sum->missed += !met[k];
    }
    sum->hidden += SHAPES - (int)n;
}

static void try_worlds(double offset, double height, tally *sum)
{
    for (int round = 0; round < ROUNDS; round++) {
        koksma__batch_shape list[SHAPES];
        koksma__batch_camera camera;
        koksma__frustum_cull *sight;
        make_shapes(offset, list);
        make_camera(list, offset, height, &camera);
        const koksma__batch_shapes shapes = {.n = SHAPES, .shapes = list};
        assert_ok(koksma__frustum_cull_open(&camera, &shapes, SIDE, SIDE, &sight));
        for (int i = 0; i < PARTS; i++) {
            check_part(sight, &camera, &shapes, sum);
        }
        koksma__frustum_cull_close(sight);
    }
}

TEST_CASE(hidden_shapes_are_not_met)
{
    tally near = {0}, far = {0};
    try_worlds(0, 0, &near);
    try_worlds(1000, 0, &far);
    /* and most of what no ray meets is known beforehand */
    assert_true(near.hidden > near.missed * 9 / 10);
    assert_true(far.hidden > far.missed / 2); /* fewer, where a narrow camera stands far from the origin */
}

/* Grazing: where rounding moves places by more than a shape's size. */
TEST_CASE(grazing_shapes_are_not_forgotten)
{
    tally sum = {0};
    for (double height = 1e-1; height > 1e-8; height /= 10) {
        try_worlds(0, height, &sum);
    }
    assert_true(sum.hidden > 0);
}

/* Shadow rays from the hits on one shape to a light, past each other shape alone: one said to be clear blocks none. */
static void check_shadows(const koksma__frustum_cull *sight, const koksma__batch_camera *camera,
                          const koksma__batch_shapes *shapes, double offset, tally *sum)
{
    const koksma__batch_table *batch = koksma__batch();
    const double side = pow(2, uniform(-3, 4)), left = uniform(0, SIDE - side), top = uniform(0, SIDE - side);
    const double x[2] = {left, left + side}, y[2] = {top, top + side};
    _Alignas(64) float xy[2 * KOKSMA__BLOCK];
    float u[3], v[3];
    koksma__batch_light light = {.power = 1};
    koksma__rays rays;
    koksma__hits hits;
    koksma__footprint part;
    const size_t on = (size_t)uniform(0, SHAPES);
    const koksma__batch_shapes own = {.n = 1, .shapes = &shapes->shapes[on]};
    frame(light.normal, u, v);
    for (int k = 0; k < 3; k++) {
        light.corner[k] = (float)(offset + uniform(-6, 6));
        light.edge_x[k] = u[k] * (float)uniform(0, 2);
        light.edge_y[k] = v[k];
    }
    make_places(x, y, xy);
    batch->camera(camera, xy, KOKSMA__BLOCK, &rays);
    if (!batch->closest(&own, &rays, NULL, KOKSMA__BLOCK, &hits) ||
        !koksma__frustum_cull_footprint(sight, on, x, y, &part)) {
        return;
    }
    for (int i = 0; i < 2 * KOKSMA__BLOCK; i++) {
        xy[i] = (float)(i % 8 < 4 ? i / 2 % 2 : uniform(0, 1));
    }
    for (size_t k = 0; k < SHAPES; k++) {
        const koksma__batch_shapes one = {.n = 1, .shapes = &shapes->shapes[k]};
        koksma__shadows before, after;
        if (k == on || !batch->aim(&light, &hits, xy, KOKSMA__BLOCK, &before)) {
            continue;
        }
        after = before;
        batch->occlude(&one, &hits, KOKSMA__BLOCK, &after);
        const bool clear = koksma__shadow_cull_clear(&part, &light, &shapes->shapes[k]);
        const bool same = !memcmp(after.light, before.light, sizeof after.light);
        assert_true(same || !clear);
        sum->hidden += clear;
        sum->missed += same;
    }
}

TEST_CASE(clear_shapes_cast_no_shadow)
{
    static const double offsets[] = {0, 0, 30, 1000};
    for (int o = 0; o < 4; o++) {
        tally sum = {0};
        for (int round = 0; round < 4 * ROUNDS; round++) {
            koksma__batch_shape list[SHAPES];
            koksma__batch_camera camera;
            koksma__frustum_cull *sight;
            make_shapes(offsets[o], list);
            make_camera(list, offsets[o], o == 1 ? pow(10, uniform(-3, 0)) : 0, &camera);
            const koksma__batch_shapes shapes = {.n = SHAPES, .shapes = list};
            assert_ok(koksma__frustum_cull_open(&camera, &shapes, SIDE, SIDE, &sight));
            for (int i = 0; i < PARTS; i++) {
                check_shadows(sight, &camera, &shapes, offsets[o], &sum);
            }
            koksma__frustum_cull_close(sight);
        }
        assert_true(sum.missed > 3 * ROUNDS);
        assert_true(offsets[o] > 100 || sum.hidden > sum.missed / 2); /* most are known to be clear */
    }
}
