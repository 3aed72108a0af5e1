/* SPDX-License-Identifier: Apache-2.0 */
/* The renderer's loops over lanes: the same bits for every instruction set, and lists of shapes as their shapes one by
   one. */
#include "lanes.h"

enum { ROUNDS = 300 };

typedef struct world {
    koksma__batch_shape list[5];
    koksma__batch_shapes shapes;
    koksma__rays rays;
    koksma__hits hits;
    koksma__shadows shadows;
} world;

static void make_world(world *w, uint64_t round)
{
    memset(w, 0, sizeof *w);
    counter = round << 20;
    for (int k = 0; k < 5; k++) {
        float n[3];
        unit_vector(n);
        const koksma__shape s = random_shape(k, 0, n);
        w->list[k] = koksma__batch_shape_of(&s, k);
    }
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        draw_lane(w->rays.o, i, 4);
        draw_direction(w->rays.d, i, uniform(0.5, 3));
    }
    w->shapes = (koksma__batch_shapes){.n = 5, .shapes = w->list};
}

/* A ray's hit with many shapes is the nearest of those with each of them, and a shadow ray is dark where one of them
   blocks it, to the last bit. test_every_shape checks each against its equation. */
TEST_CASE(lists_are_as_their_shapes_one_by_one)
{
    const koksma__batch_table *batch = koksma__batch();
    int lanes = 0, hit = 0, dark = 0;
    for (uint64_t round = 0; round < ROUNDS; round++) {
        world w;
        koksma__hits nearest = {0};
        float lit[KOKSMA__BLOCK];
        make_world(&w, round);
        batch->closest(&w.shapes, &w.rays, NULL, KOKSMA__BLOCK, &w.hits);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            draw_lane(w.shadows.d, i, 4);
            w.shadows.light[i] = lit[i] = 1;
            nearest.primitive[i] = nearest.material[i] = -1;
            nearest.t[i] = INFINITY;
        }
        for (int k = 0; k < 5; k++) {
            const koksma__batch_shapes one = {.n = 1, .shapes = &w.list[k]};
            koksma__shadows shadows = w.shadows;
            koksma__hits hits;
            batch->closest(&one, &w.rays, NULL, KOKSMA__BLOCK, &hits);
            batch->occlude(&one, &w.hits, KOKSMA__BLOCK, &shadows);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                lit[i] *= shadows.light[i];
                if (hits.primitive[i] == k && hits.t[i] < nearest.t[i]) {
                    nearest.t[i] = hits.t[i];
                    nearest.n[0][i] = hits.n[0][i];
                    nearest.p[0][i] = hits.p[0][i];
                    nearest.primitive[i] = nearest.material[i] = k;
                }
            }
        }
        batch->occlude(&w.shapes, &w.hits, KOKSMA__BLOCK, &w.shadows);
        assert_memory_equal(w.shadows.light, lit, sizeof lit);
        assert_memory_equal(w.hits.primitive, nearest.primitive, sizeof nearest.primitive);
        assert_memory_equal(w.hits.material, nearest.material, sizeof nearest.material);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const bool met = w.hits.primitive[i] >= 0;
            assert_true(!met || (w.hits.t[i] == nearest.t[i] && w.hits.n[0][i] == nearest.n[0][i]));
            assert_true(!met || w.hits.p[0][i] == nearest.p[0][i]);
            lanes++;
            hit += met;
            dark += lit[i] == 0;
        }
    }
    assert_true(hit > lanes / 4);
    assert_true(dark > lanes / 10 && dark < lanes * 9 / 10);
}

static void run_all(const koksma__batch_table *batch, world *w, float out[3][KOKSMA__BLOCK], double *mean, int n)
{
    static const koksma__batch_material materials[] = {{false, {0.5f, 0.5f}, 0, 0, 0, 0, 0, 0},
                                                       {true, {0.1f, 0.9f}, 1.3f, 0.7f, 0.2f, -0.7f, 1.3f, 0.4f},
                                                       {false, {0.7f, 0.7f}, 0, 0, 0, 0, 0, 0},
                                                       {false, {0.2f, 0.2f}, 0, 0, 0, 0, 0, 0},
                                                       {true, {0.3f, 0.6f}, 5, 0, 0, 0, 5, 0}};
    const koksma__batch_light light = {{-1, 3, -1}, {2, 0, 0.1f}, {0, 0.3f, 2}, {0, -1, 0}, 30};
    const koksma__batch_camera camera = {
        .eye = {0, 0, 5}, .base = {-1, 1, -2}, .step_x = {0.03f, 0, 0.001f}, .step_y = {0, -0.03f, 0}};
    double xs[2 * KOKSMA__BLOCK];
    uint32_t words[KOKSMA__BLOCK];
    float places[2 * KOKSMA__BLOCK], shuffled[2 * KOKSMA__BLOCK];
    float sums[KOKSMA__BLOCK];
    koksma__shadows unblocked;
    const float offset[2] = {7, 11};
    for (int i = 0; i < 2 * KOKSMA__BLOCK; i++) {
        xs[i] = uniform(0, 1);
        words[i / 2] = (uint32_t)(4294967295.0 * xs[i]);
    }
    xs[0] = 1 - 0x1p-53; /* rounds to 1 as a float */
    batch->place(xs, KOKSMA__BLOCK, offset, places);
    batch->shuffle(places, words, KOKSMA__BLOCK, shuffled);
    batch->camera(&camera, shuffled, n, &w->rays);
    batch->closest(&w->shapes, &w->rays, NULL, n, &w->hits);
    batch->albedo(materials, &w->hits, n, out[0]);
    const int lit = batch->aim(&light, &w->hits, places, n, &w->shadows);
    for (int i = 0; i < n; i++) {
        sums[i] = 0.1f;
        out[1][i] = 0.1f + w->shadows.light[i];
    }
    assert_int_equal(batch->light(&light, &w->hits, places, n, &unblocked, sums), lit);
    assert_memory_equal(unblocked.light, w->shadows.light, (size_t)n * sizeof *sums);
    assert_memory_equal(sums, out[1], (size_t)n * sizeof *sums);
    batch->occlude(&w->shapes, &w->hits, n, &w->shadows);
    for (int i = 0; i < n; i++) {
        out[1][i] = 0.1f;
    }
    batch->add(&w->shadows, n, out[1]);
    batch->shade(&w->hits, out[0], out[1], 0.3f, 1, n, out[2]);
    *mean = batch->mean(out[2], (size_t)n - 3);
}

TEST_CASE(same_bits_for_every_instruction_set)
{
    for (uint64_t round = 0; round < 60; round++) {
        static world first;
        float first_out[3][KOKSMA__BLOCK] = {{0}};
        double first_mean = 0;
        for (size_t isa = 0; isa < 4; isa++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
            static world w;
            float out[3][KOKSMA__BLOCK] = {{0}};
            double mean = 0;
            if (!batch) {
                continue;
            }
            make_world(&w, round);
            w.shapes.shapes = isa ? first.shapes.shapes : w.list;
            run_all(batch, &w, out, &mean, 16 * (1 + (int)(round % 4)));
            if (isa == 0) {
                memcpy(&first, &w, sizeof w);
                first.shapes.shapes = first.list;
                memcpy(first_out, out, sizeof out);
                first_mean = mean;
            } else {
                assert_memory_equal(&w.rays, &first.rays, sizeof w.rays);
                assert_memory_equal(&w.hits, &first.hits, sizeof w.hits);
                assert_memory_equal(&w.shadows, &first.shadows, sizeof w.shadows);
                assert_memory_equal(out, first_out, sizeof out);
                assert_memory_equal(&mean, &first_mean, sizeof mean);
            }
        }
    }
}

/* A point is never outside its pixel, even where 1 - 2^-53 rounds up; a shuffle loses no pair. */
TEST_CASE(places_and_shuffles)
{
    enum { N = 101 };
    double xs[2 * N];
    uint32_t words[N];
    float places[2 * N], shuffled[2 * N];
    bool seen[N] = {false};
    const float zero[2] = {0, 0};
    for (int i = 0; i < N; i++) {
        xs[2 * i] = i / 128.0;
        xs[2 * i + 1] = 1 - 0x1p-53;
        words[i] = koksma__random(4, KOKSMA__PURPOSE_TEST, (uint64_t)i, 0).w[0];
    }
    koksma__batch()->place(xs, N, zero, places);
    koksma__batch()->shuffle(places, words, N, shuffled);
    int moved = 0;
    for (int i = 0; i < N; i++) {
        const int from = (int)(shuffled[2 * i] * 128);
        assert_true(from >= 0 && from < N && !seen[from]);
        assert_true(shuffled[2 * i + 1] < 1);
        seen[from] = true;
        moved += from != i;
    }
    assert_true(moved > N / 2);
}
