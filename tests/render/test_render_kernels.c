/* SPDX-License-Identifier: Apache-2.0 */
/* The renderer's loops over lanes: the same bits for every instruction set, and intersections and shadows against
   plain twins in double precision, ray by ray. A twin is asked twice, about shapes a little larger and a little
   smaller; where both answers agree the loop must agree with them. */
#include <string.h>

#include "core/random.h"
#include "core/vector.h"
#include "render/shapes/shapes.h"
#include "scene/scene.h"
#include "test.h"

enum { ROUNDS = 300 };

static const char *const isas[] = {"ref", "baseline", "avx2", "avx512"};

/* Random numbers of a test, by a counter. */
static uint64_t counter;

static double uniform(double low, double high)
{
    double pair[2];
    koksma__random_pair(3, KOKSMA__PURPOSE_TEST, counter++, 0, pair);
    return low + (high - low) * pair[0];
}

static void unit_vector(float v[3])
{
    double w[3], length;
    do {
        w[0] = uniform(-1, 1);
        w[1] = uniform(-1, 1);
        w[2] = uniform(-1, 1);
        length = sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    } while (!(length > 0.1 && length < 1));
    for (int k = 0; k < 3; k++) {
        v[k] = (float)(w[k] / length);
    }
}

static koksma__batch_shape random_shape(int index)
{
    static const koksma__shape_type *const types[] = {&KOKSMA__SHAPE(plane), &KOKSMA__SHAPE(rectangle),
                                                      &KOKSMA__SHAPE(disk), &KOKSMA__SHAPE(sphere)};
    koksma__shape s = {.type = types[index % 4], .material = index};
    float normal[3], other[3];
    unit_vector(normal);
    unit_vector(other);
    for (int k = 0; k < 3; k++) {
        s.centre[k] = uniform(-2, 2);
        s.normal[k] = (double)normal[k];
        s.axis_v[k] = (double)other[k];
    }
    koksma__cross(s.axis_v, s.normal, s.axis_u);
    koksma__normalise(s.axis_u);
    koksma__cross(s.normal, s.axis_u, s.axis_v);
    s.half[0] = index % 4 ? uniform(0.3, 1.2) : (double)INFINITY;
    s.half[1] = index % 4 == 1 ? uniform(0.3, 1.2) : s.half[0];
    return koksma__batch_shape_of(&s, index);
}

static void random_rays(koksma__rays *r)
{
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        float d[3];
        unit_vector(d);
        r->ox[i] = (float)uniform(-4, 4);
        r->oy[i] = (float)uniform(-4, 4);
        r->oz[i] = (float)uniform(-4, 4);
        const float length = (float)uniform(0.5, 3);
        r->dx[i] = length * d[0];
        r->dy[i] = length * d[1];
        r->dz[i] = length * d[2];
    }
}

/* ---- The twins ---------------------------------------------------------------------------------------- */

static double dot(const double a[3], const float b[3])
{
    return a[0] * (double)b[0] + a[1] * (double)b[1] + a[2] * (double)b[2];
}

/* The smallest t in (low, high) where the ray meets shape s grown by a factor; INFINITY for none. on: the ray starts
   on the shape. */
static double meet(const koksma__batch_shape *s, double grown, const double o[3], const double d[3], bool on,
                   double low, double high)
{
    const double e[3] = {o[0] - (double)s->centre[0], o[1] - (double)s->centre[1], o[2] - (double)s->centre[2]};
    if (s->is_flat) {
        const double t = -dot(e, s->normal) / dot(d, s->normal);
        const double q[3] = {e[0] + t * d[0], e[1] + t * d[1], e[2] + t * d[2]};
        const double u = dot(q, s->axis_u), v = dot(q, s->axis_v);
        const bool inside = fabs(u) <= grown * (double)s->half_u && fabs(v) <= grown * (double)s->half_v &&
                            (koksma__shape_types[s->kind] != &KOKSMA__SHAPE(disk) ||
                             u * u + v * v <= grown * grown * (double)s->radius2);
        return !on && inside && t > low && t < high ? t : (double)INFINITY;
    }
    const double a = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], b = e[0] * d[0] + e[1] * d[1] + e[2] * d[2];
    if (on) {
        const double far = -2 * b / a; /* the other root is 0 */
        return far > low && far < high ? far : (double)INFINITY;
    }
    const double c = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] - grown * grown * (double)s->radius2;
    const double rest = b * b - a * c;
    if (!(rest > 0)) {
        return INFINITY;
    }
    const double near = (-b - sqrt(rest)) / a, far = (-b + sqrt(rest)) / a;
    return near > low && near < high ? near : far > low && far < high ? far : (double)INFINITY;
}

static int closest_twin(const koksma__batch_shapes *shapes, double grown, const double o[3], const double d[3],
                        double *t)
{
    int id = -1;
    *t = (double)INFINITY;
    for (size_t k = 0; k < shapes->n; k++) {
        const double at = meet(&shapes->shapes[k], grown, o, d, false, 0, INFINITY);
        if (at < *t) {
            *t = at;
            id = (int)k;
        }
    }
    return id;
}

static bool blocked_twin(const koksma__batch_shapes *shapes, double grown, const double o[3], const double d[3],
                         int on, double slack)
{
    for (size_t k = 0; k < shapes->n; k++) {
        if (meet(&shapes->shapes[k], grown, o, d, (int)k == on, slack, 1 - slack) < (double)INFINITY) {
            return true;
        }
    }
    return false;
}

/* ---- Tests -------------------------------------------------------------------------------------------- */

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
        w->list[k] = random_shape(k);
    }
    w->shapes = (koksma__batch_shapes){5, w->list};
    random_rays(&w->rays);
}

static void closest_equals_twin(void **state)
{
    (void)state;
    const koksma__batch_table *batch = koksma__batch();
    int asked = 0, hit = 0;
    for (uint64_t round = 0; round < ROUNDS; round++) {
        world w;
        make_world(&w, round);
        batch->closest(&w.shapes, &w.rays, NULL, KOKSMA__BLOCK, &w.hits);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const double o[3] = {(double)w.rays.ox[i], (double)w.rays.oy[i], (double)w.rays.oz[i]};
            const double d[3] = {(double)w.rays.dx[i], (double)w.rays.dy[i], (double)w.rays.dz[i]};
            double t_small, t_large, t;
            const int small = closest_twin(&w.shapes, 1 - 1e-4, o, d, &t_small);
            const int large = closest_twin(&w.shapes, 1 + 1e-4, o, d, &t_large);
            if (small != large || (small >= 0 && t_small > 1000)) {
                continue;
            }
            asked++;
            closest_twin(&w.shapes, 1, o, d, &t);
            assert_int_equal(w.hits.primitive[i], small);
            assert_int_equal(w.hits.material[i], small);
            if (small >= 0) {
                hit++;
                /* A place is exact to some 1e-6 of its size; t is worse where the ray grazes. */
                const double length = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
                const double across =
                    fabs((double)w.hits.nx[i] * d[0] + (double)w.hits.ny[i] * d[1] + (double)w.hits.nz[i] * d[2]);
                assert_near((double)w.hits.t[i], t, 3e-6 * (8 + length * t) / across);
                assert_near((double)w.hits.px[i], o[0] + (double)w.hits.t[i] * d[0], 1e-6 * (8 + length * t));
                assert_near((double)w.hits.nx[i] * d[0] + (double)w.hits.ny[i] * d[1] + (double)w.hits.nz[i] * d[2] <
                                0,
                            1, 0);
            }
        }
    }
    assert_true(asked > ROUNDS * KOKSMA__BLOCK * 98 / 100);
    assert_true(hit > asked / 4);
}

static void shadows_equal_twin(void **state)
{
    (void)state;
    const koksma__batch_table *batch = koksma__batch();
    int asked = 0, dark = 0, lanes = 0;
    for (uint64_t round = 0; round < ROUNDS; round++) {
        world w;
        make_world(&w, round);
        batch->closest(&w.shapes, &w.rays, NULL, KOKSMA__BLOCK, &w.hits);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            w.shadows.dx[i] = (float)uniform(-4, 4);
            w.shadows.dy[i] = (float)uniform(-4, 4);
            w.shadows.dz[i] = (float)uniform(-4, 4);
            w.shadows.light[i] = 1;
        }
        batch->occlude(&w.shapes, &w.hits, KOKSMA__BLOCK, &w.shadows);
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const double o[3] = {(double)w.hits.px[i], (double)w.hits.py[i], (double)w.hits.pz[i]};
            const double d[3] = {(double)w.shadows.dx[i], (double)w.shadows.dy[i], (double)w.shadows.dz[i]};
            if (w.hits.primitive[i] < 0 || w.hits.t[i] > 100) {
                continue;
            }
            lanes++;
            const bool small = blocked_twin(&w.shapes, 1 - 1e-3, o, d, w.hits.primitive[i], 1e-3);
            const bool large = blocked_twin(&w.shapes, 1 + 1e-3, o, d, w.hits.primitive[i], -1e-3);
            if (small == large) {
                asked++;
                dark += small;
                assert_near((double)w.shadows.light[i], small ? 0 : 1, 0);
            }
        }
    }
    assert_true(asked > lanes * 95 / 100);
    assert_true(dark > asked / 10 && dark < asked * 9 / 10);
}

static void run_all(const koksma__batch_table *batch, world *w, float out[3][KOKSMA__BLOCK], double *mean, int n)
{
    static const koksma__batch_material materials[] = {{false, {0.5f, 0.5f}, 0, 0, 0, 0, 0, 0},
                                                       {true, {0.1f, 0.9f}, 1.3f, 0.7f, 0.2f, -0.7f, 1.3f, 0.4f},
                                                       {false, {0.7f, 0.7f}, 0, 0, 0, 0, 0, 0},
                                                       {false, {0.2f, 0.2f}, 0, 0, 0, 0, 0, 0},
                                                       {true, {0.3f, 0.6f}, 5, 0, 0, 0, 5, 0}};
    const koksma__batch_light light = {{-1, 3, -1}, {2, 0, 0.1f}, {0, 0.3f, 2}, {0, -1, 0}, 30};
    const koksma__batch_camera camera = {{0, 0, 5}, {-1, 1, -2}, {0.03f, 0, 0.001f}, {0, -0.03f, 0}};
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

static void same_bits_for_every_instruction_set(void **state)
{
    (void)state;
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
static void places_and_shuffles(void **state)
{
    (void)state;
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closest_equals_twin),
        cmocka_unit_test(shadows_equal_twin),
        cmocka_unit_test(same_bits_for_every_instruction_set),
        cmocka_unit_test(places_and_shuffles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
