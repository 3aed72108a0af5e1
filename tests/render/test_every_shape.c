/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every line of shapes.def that rays meet, with parameters drawn from the ranges that it declares, against the kind's
 * equation F(p) in double precision: a shape is where F = 0 and p is not beyond its edge.
 *
 *   hits      F = 0 there; and no change of F's sign on the surface lies before them, found by walking along the ray
 *             in small steps and halving; rays that meet nothing cross nothing
 *   normals   the gradient of F by central differences, turned towards the ray's origin
 *   bounds    hits lie within half of flat shapes and within the radius of the others
 *   shadows   are where F changes its sign between the two ends
 *   starts    a ray that starts on the shape goes on to the next crossing
 *   motion    a shape that has moved by t motion is met as one that stands there; of the odd trials without `motion`
 *             shapes also rotate about an axis and change size (`to`), and are met as ones that were put there
 *
 * All instruction sets give the same bits, lanes behave alike wherever they stand in a block, and the geometry with
 * Embree gives what that without it gives. Rays that pass an edge or touch a surface within 1e-3 are left out where the
 * answer depends on rounding; a test fails if those are many.
 */
#include "core/vector.h"
#include "kinds.h"
#include "lanes.h"
#include "render/accel/accel.h"

enum { TRIALS = test_repeats(24, 6), STEPS = 2000 };

static const double reach = 8; /* rays start within 3 of the origin, shapes are as small; planes are met later, too */

/* How the shape of a stream turns: about axis `axis` by an angle, to another centre and size. */
typedef struct turn {
    int axis;
    double angle_deg, centre[3], scale;
} turn;

static turn turn_of(uint64_t stream)
{
    turn t = {.axis = (int)(stream / 2 % 3),
              .angle_deg = 340 * draw(stream, 9001) - 170,
              .scale = 0.5 + draw(stream, 9002)};
    for (int k = 0; k < 3; k++) {
        t.centre[k] = 2 * draw(stream, 9003 + (uint64_t)k) - 1;
    }
    return t;
}

static koksma_scene *scene_with(const koksma__shape_type *type, uint64_t stream, const char *more)
{
    char fields[1024], text[4096];
    const turn t = turn_of(stream);
    kind_fields(&type->kind, stream, fields, sizeof fields);
    if (stream % 2 && !strstr(fields, "motion")) {
        const size_t used = strlen(fields);
        snprintf(fields + used, sizeof fields - used,
                 ", 'to': {'centre': [%.17g, %.17g, %.17g], 'rotate_deg': [%.17g, %.17g, %.17g], 'scale': %.17g}",
                 t.centre[0], t.centre[1], t.centre[2], t.axis == 0 ? t.angle_deg : 0, t.axis == 1 ? t.angle_deg : 0,
                 t.axis == 2 ? t.angle_deg : 0, t.scale);
    }
    snprintf(text, sizeof text,
             "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 40}, 'materials': [{'name': 'm', 'kind': "
             "'lambert', 'albedo': 0.5}], 'shapes': [{'kind': '%s', 'material': 'm'%s}%s], 'lights': [{'kind': "
             "'point', 'centre': [0, 9, 0], 'intensity': 1}]}",
             type->kind.name, fields, more);
    return scene_of(text);
}

static void make_rays(const koksma__shape *s, uint64_t stream, koksma__rays *r)
{
    for (uint64_t i = 0; i < KOKSMA__BLOCK; i++) {
        float o[3], to[3];
        draw_unit(stream, 3 * i, o);
        draw_unit(stream, 3 * i + 1, to);
        const double far = 3 * draw(stream, 1000 + i), off = draw(stream, 2000 + i);
        const float length = (float)(0.5 + 2 * draw(stream, 3000 + i));
        r->time[i] = (float)draw(stream, 4000 + i);
        float square = 0;
        for (int k = 0; k < 3; k++) { /* towards a position near the shape */
            r->o[k][i] = (float)far * o[k];
            r->d[k][i] = (float)(s->centre[k] + off * (double)to[k]) - r->o[k][i];
            square += r->d[k][i] * r->d[k][i];
        }
        for (int k = 0; k < 3; k++) {
            r->d[k][i] *= length / sqrtf(square);
        }
    }
}

typedef struct line {
    const koksma__shape *shape; /* at the ray's time, without motion */
    double o[3], d[3];
} line;

static line line_of(const koksma__shape *at, const koksma__rays *r, int i)
{
    line l = {.shape = at};
    get_lane(r->o, i, l.o);
    get_lane(r->d, i, l.d);
    return l;
}

static double value(const line *l, double t, double *beyond)
{
    const double p[3] = {l->o[0] + t * l->d[0], l->o[1] + t * l->d[1], l->o[2] + t * l->d[2]};
    return l->shape->type->equation(l->shape, p, beyond);
}

/* The first t in (low, high) where F changes its sign on the shape, or high; *edge: it is near the shape's edge. */
static double first_crossing(const line *l, double low, double high, bool *edge)
{
    double beyond, before = value(l, low, &beyond);
    *edge = false;
    for (int k = 1; k <= STEPS; k++) {
        double a = low + (high - low) * (k - 1) / STEPS, b = low + (high - low) * k / STEPS;
        const double after = value(l, b, &beyond);
        const bool crosses = before * after < 0;
        for (int halved = 0; crosses && halved < 60; halved++) {
            const double middle = (a + b) / 2, at = value(l, middle, &beyond);
            *(before * at > 0 ? &a : &b) = middle;
        }
        if (crosses && beyond <= 1e-3) {
            *edge = beyond > -1e-3;
            return a;
        }
        before = after;
    }
    return high;
}

/* Length 1; false where the gradient is 0. */
static bool gradient(const koksma__shape *s, const double p[3], double out[3])
{
    for (int k = 0; k < 3; k++) {
        double up[3] = {p[0], p[1], p[2]}, down[3] = {p[0], p[1], p[2]}, beyond;
        up[k] += 1e-5;
        down[k] -= 1e-5;
        out[k] = (s->type->equation(s, up, &beyond) - s->type->equation(s, down, &beyond)) / 2e-5;
    }
    return koksma__normalise(out);
}

/* v turned from axis k + 1 to axis k + 2 by the angle, which is a rotation about axis k. */
static void turn_about(int k, double angle, double v[3])
{
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double a = v[i], b = v[j];
    v[i] = cos(angle) * a - sin(angle) * b;
    v[j] = sin(angle) * a + cos(angle) * b;
}

/* The shape at rest where it is at this time; turn.scale is the factor of its size. stream: that of scene_with. */
static koksma__shape at_time(const koksma__shape *shape, uint64_t stream, double time)
{
    koksma__shape s = *shape;
    const turn t = turn_of(stream);
    s.turn.turns = false;
    s.turn.scale = shape->turn.turns ? 1 + time * (t.scale - 1) : 1;
    for (int k = 0; k < 3; k++) {
        s.centre[k] += time * (shape->turn.turns ? t.centre[k] - s.centre[k] : s.motion[k]);
        s.motion[k] = 0;
    }
    if (shape->turn.turns) {
        const double angle = time * t.angle_deg * M_PI / 180;
        turn_about(t.axis, angle, s.normal);
        turn_about(t.axis, angle, s.axis_u);
        turn_about(t.axis, angle, s.axis_v);
        s.half[0] *= s.turn.scale;
        s.half[1] *= s.turn.scale;
    }
    return s;
}

#define NAME(s) (s)->type->kind.name

/* One lane that hits. */
static void check_hit(const koksma__shape *s, const line *l, const koksma__hits *h, int i)
{
    double p[3], n[3];
    get_lane(h->p, i, p);
    get_lane(h->n, i, n);
    const double length = sqrt(koksma__dot(l->d, l->d)), t = (double)h->t[i];
    double g[3], q[3], beyond, before;
    if (t * length > 50) { /* a plane's far parts, where floats are coarse */
        return;
    }
    assert_true(gradient(s, p, g));
    const double front = koksma__dot(g, l->d) < 0 ? 1 : -1, across = fabs(koksma__dot(g, l->d)) / length;
    for (int k = 0; k < 3; k++) {
        q[k] = p[k] + 1e-4 * g[k];
        assert_that(fabs(p[k] - l->o[k] - t * l->d[k]) < 1e-5 * (1 + t * length),
                    "%s: position %g of the hit isn't on the ray", NAME(s), p[k]);
        assert_that(across <= 0.01 || fabs(n[k] - front * g[k]) < 2e-4 / across,
                    "%s: normal (%g, %g, %g), the gradient is (%g, %g, %g)", NAME(s), n[0], n[1], n[2], front * g[0],
                    front * g[1], front * g[2]);
    }
    /* the distance from the surface: F over the length of its gradient */
    const double off = 1e-4 * s->type->equation(s, p, &beyond) / fabs(s->type->equation(s, q, &before));
    assert_that(fabs(off) < 2e-5 * (1 + t * length) && beyond <= 1e-4,
                "%s: a hit at (%g, %g, %g) is %g off the surface, %g beyond the edge", NAME(s), p[0], p[1], p[2], off,
                beyond);
    assert_that(across <= 0.01 || (h->back[i] != 0) == (front < 0), "%s: a hit of the front says back = %d", NAME(s),
                h->back[i]);
    double e[3];
    koksma__subtract(p, s->centre, e);
    const double u = koksma__dot(e, s->axis_u), v = koksma__dot(e, s->axis_v);
    const double radius = s->type->radius ? s->type->radius(s) : s->half[0];
    if (s->type->is_flat ? fabs(u) > s->half[0] + 1e-4 || fabs(v) > s->half[1] + 1e-4
                         : sqrt(koksma__dot(e, e)) > radius * (1 + 1e-4)) {
        fail_msg("%s: a hit at (%g, %g, %g) is out of its bounds", NAME(s), p[0], p[1], p[2]);
    }
    const double coordinates[2] = {s->type->takes_checker ? u / s->turn.scale : 0,
                                   s->type->takes_checker ? v / s->turn.scale : 0};
    assert_that(fabs(coordinates[0] - (double)h->u[i]) < 1e-4 && fabs(coordinates[1] - (double)h->v[i]) < 1e-4,
                "%s: coordinates (%g, %g), which are (%g, %g)", NAME(s), (double)h->u[i], (double)h->v[i],
                coordinates[0], coordinates[1]);
}

typedef struct tally {
    int rays, hits, unclear;
} tally;

/* from: NULL, or 0 in lanes that start on the shape. */
static void check_closest(const koksma__shape *shape, uint64_t stream, const koksma__rays *r, const int32_t *from,
                          const koksma__hits *h, tally *sum)
{
    for (int i = 0; i < KOKSMA__BLOCK; i++) {
        const koksma__shape s = at_time(shape, stream, (double)r->time[i]);
        const line l = line_of(&s, r, i);
        const double length = sqrt(koksma__dot(l.d, l.d)), high = reach / length;
        const bool hit = h->primitive[i] == 0, on = from && from[i] == 0;
        const double low = on ? 1e-3 : 0;
        bool edge;
        const double t = first_crossing(&l, low, high, &edge), got = hit ? (double)h->t[i] : (double)INFINITY;
        sum->rays++;
        sum->hits += hit;
        if (hit && !(on && got < 2 * low)) {
            check_hit(&s, &l, h, i);
        }
        /* near an edge, or where two crossings are within a step */
        if (edge || (hit && got < t - 1e-3) || (t >= high) != !(got < high)) {
            sum->unclear++;
        }
        assert_that(edge || t >= high || got <= t + 1e-3, "%s: is crossed at t = %g, the hit is at %g", NAME(shape),
                    t, got);
    }
}

TEST_CASE(hits_are_those_of_the_equation)
{
    for (size_t kind = 0; koksma__shape_types[kind]; kind++) {
        tally sum = {0};
        for (uint64_t trial = 0; koksma__shape_types[kind]->hit && trial < TRIALS; trial++) {
            koksma_scene *scene = scene_with(koksma__shape_types[kind], 100 * kind + trial, "");
            const koksma__batch_shape shape = koksma__batch_shape_of(scene->shapes, 0);
            /* alone, and twice in a list: the first of two equal ones is met */
            const koksma__batch_shape list[2] = {shape, koksma__batch_shape_of(scene->shapes, 1)};
            koksma__rays rays;
            koksma__hits one, two;
            memset(&one, 0xff, sizeof one); /* numbers that are none, where a loop forgets to write */
            memset(&two, 0xff, sizeof two);
            make_rays(scene->shapes, 7000 + 100 * kind + trial, &rays);
            koksma__batch()->closest(&(koksma__batch_shapes){.n = 1, .shapes = &shape}, &rays, NULL, KOKSMA__BLOCK,
                                     &one);
            koksma__batch()->closest(&(koksma__batch_shapes){.n = 2, .shapes = list}, &rays, NULL, KOKSMA__BLOCK,
                                     &two);
            check_closest(scene->shapes, 100 * kind + trial, &rays, NULL, &one, &sum);
            assert_memory_equal(one.primitive, two.primitive, sizeof one.primitive);
            check_closest(scene->shapes, 100 * kind + trial, &rays, NULL, &two, &sum);
            koksma_scene_close(scene);
        }
        assert_that(sum.hits >= sum.rays / 10 && sum.unclear <= sum.rays / 50,
                    "%s: %d of %d rays hit, %d are unclear", koksma__shape_kinds[kind]->name, sum.hits, sum.rays,
                    sum.unclear);
    }
}

/* Rays that start where others hit, in any direction. */
TEST_CASE(starts_are_not_met_again)
{
    for (size_t kind = 0; koksma__shape_types[kind]; kind++) {
        tally sum = {0};
        for (uint64_t trial = 0; koksma__shape_types[kind]->hit && trial < TRIALS; trial++) {
            koksma_scene *scene = scene_with(koksma__shape_types[kind], 100 * kind + trial, "");
            const koksma__batch_shape shape = koksma__batch_shape_of(scene->shapes, 0);
            const koksma__batch_shapes list = {.n = 1, .shapes = &shape};
            koksma__rays rays;
            koksma__hits first, next;
            KOKSMA__LANES(int32_t, from);
            make_rays(scene->shapes, 8000 + 100 * kind + trial, &rays);
            koksma__batch()->closest(&list, &rays, NULL, KOKSMA__BLOCK, &first);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                float d[3];
                draw_unit(9000 + kind, 64 * trial + (uint64_t)i, d);
                const bool hit = first.primitive[i] == 0 && first.t[i] < 20;
                for (int k = 0; k < 3; k++) {
                    rays.o[k][i] = hit ? first.p[k][i] : rays.o[k][i];
                }
                set_lane(rays.d, i, d);
                from[i] = hit ? 0 : -1;
            }
            koksma__batch()->closest(&list, &rays, from, KOKSMA__BLOCK, &next);
            check_closest(scene->shapes, 100 * kind + trial, &rays, from, &next, &sum);
            koksma_scene_close(scene);
        }
        assert_that(sum.unclear <= sum.rays / 25, "%s: %d of %d rays are unclear", koksma__shape_kinds[kind]->name,
                    sum.unclear, sum.rays);
    }
}

/* Between a position in space and one beyond the shape; half of them from and to the shape's surface are left out. */
TEST_CASE(shadows_are_those_of_the_equation)
{
    for (size_t kind = 0; koksma__shape_types[kind]; kind++) {
        int dark = 0, rays_in_all = 0, unclear = 0;
        for (uint64_t trial = 0; koksma__shape_types[kind]->hit && trial < TRIALS; trial++) {
            koksma_scene *scene = scene_with(koksma__shape_types[kind], 100 * kind + trial, "");
            koksma__batch_shape shape = koksma__batch_shape_of(scene->shapes, 0);
            KOKSMA__LANES(int32_t, aimed);
            koksma__rays r;
            koksma__hits from = {0};
            koksma__shadows shadows[2] = {{.aimed = NULL}, {.aimed = aimed}};
            make_rays(scene->shapes, 6000 + 100 * kind + trial, &r);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                const float far = 1 + 2 * (float)draw(6500 + kind, 64 * trial + (uint64_t)i);
                from.time[i] = r.time[i];
                from.primitive[i] = -1;
                aimed[i] = i % 2 ? 0 : 1; /* this shape as the light's own surface; another */
                for (int k = 0; k < 2; k++) {
                    for (int c = 0; c < 3; c++) {
                        shadows[k].d[c][i] = r.d[c][i] *= k ? 1 : far;
                    }
                    shadows[k].light[i] = 1;
                }
            }
            const koksma__batch_shapes list = {.n = 1, .shapes = &shape};
            memcpy(from.p, r.o, sizeof from.p);
            koksma__batch()->occlude(&list, &from, KOKSMA__BLOCK, &shadows[0]);
            shape.material = -1;
            koksma__batch()->occlude(&list, &from, KOKSMA__BLOCK, &shadows[1]);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                const koksma__shape s = at_time(scene->shapes, 100 * kind + trial, (double)r.time[i]);
                const line l = line_of(&s, &r, i);
                bool edge;
                const double t = first_crossing(&l, 0, 1.01, &edge);
                rays_in_all++;
                dark += t < 1;
                if (edge || t < 1e-3 || (t > 0.99 && t < 1.005) || (t >= 1 && !(shadows[0].light[i] > 0))) {
                    unclear++;
                    continue;
                }
                const float lit = t < 1 ? 0 : 1;
                assert_that(shadows[0].light[i] == lit && shadows[1].light[i] == (i % 2 ? 1 : lit),
                            "%s: is crossed at t = %g, and leaves %g of the light (%g of its own)", NAME(&s), t,
                            (double)shadows[0].light[i], (double)shadows[1].light[i]);
            }
            koksma_scene_close(scene);
        }
        if (koksma__shape_types[kind]->hit && (dark < rays_in_all / 20 || unclear > rays_in_all / 20)) {
            fail_msg("%s: %d of %d shadow rays are blocked, %d are unclear", koksma__shape_kinds[kind]->name, dark,
                     rays_in_all, unclear);
        }
    }
}

/* Lane i of the block as lane 13 + i; and all lanes as one that hits, which takes another loop. */
static void check_moved_lanes(const koksma_scene *scene, const koksma__rays *rays, const koksma__hits *h)
{
    const koksma__batch_shape two[2] = {koksma__batch_shape_of(scene->shapes, 0),
                                        koksma__batch_shape_of(scene->shapes, 1)};
    koksma__rays turned;
    koksma__hits hit;
    int hitting = 0;
    while (hitting < KOKSMA__BLOCK - 1 && h->primitive[hitting]) {
        hitting++;
    }
    for (int all = 0; all < 2; all++) {
        enum { RAY = sizeof *rays / sizeof rays->time, HIT = offsetof(koksma__hits, time) / sizeof rays->time };
        const koksma__lanes *from = rays->o, *wanted = &h->t;
        koksma__lanes *to = turned.o, *got = &hit.t;
        for (int i = 0; i < RAY * KOKSMA__BLOCK; i++) {
            const int lane = i % KOKSMA__BLOCK;
            to[i / KOKSMA__BLOCK][lane] = from[i / KOKSMA__BLOCK][all ? hitting : (lane + 13) % KOKSMA__BLOCK];
        }
        memset(&hit, 0xff, sizeof hit); /* no numbers, where a loop forgets to write */
        koksma__batch()->closest(&(koksma__batch_shapes){.n = 2, .shapes = two}, &turned, NULL, KOKSMA__BLOCK, &hit);
        for (int i = KOKSMA__BLOCK; i < HIT * KOKSMA__BLOCK; i++) {
            const int lane = i % KOKSMA__BLOCK, k = all ? hitting : (lane + 13) % KOKSMA__BLOCK;
            assert_int_equal(hit.primitive[lane], h->primitive[k]);
            assert_int_equal(hit.back[lane], h->back[k]);
            assert_that(fabsf(got[i / KOKSMA__BLOCK][lane] - wanted[i / KOKSMA__BLOCK][k]) <= 1e-5f,
                        "%s: number %d is %g in one lane and %g in another", NAME(scene->shapes), i / KOKSMA__BLOCK,
                        (double)wanted[i / KOKSMA__BLOCK][k], (double)got[i / KOKSMA__BLOCK][lane]);
        }
    }
}

/* Every instruction set, and a lane moved to another lane of the block. */
TEST_CASE(lanes_are_alike)
{
    for (size_t kind = 0; koksma__shape_types[kind]; kind++) {
        for (uint64_t trial = 0; koksma__shape_types[kind]->hit && trial < TRIALS; trial++) {
            koksma_scene *scene = scene_with(koksma__shape_types[kind], 100 * kind + trial, "");
            const koksma__batch_shape shape = koksma__batch_shape_of(scene->shapes, 0);
            const koksma__batch_shapes list = {.n = 1, .shapes = &shape};
            koksma__rays rays;
            koksma__hits hits[4];
            koksma__shadows shadows[4];
            make_rays(scene->shapes, 5000 + 100 * kind + trial, &rays);
            memset(hits, 0, sizeof hits);
            memset(shadows, 0, sizeof shadows);
            for (int k = 0; k < 4; k++) {
                const koksma__batch_table *batch = koksma__batch_find(isas[k]);
                for (int i = 0; i < KOKSMA__BLOCK; i++) {
                    set_lane(shadows[k].d, i, (const float[3]){rays.d[2][i], rays.d[0][i], rays.d[1][i]});
                    shadows[k].light[i] = 1;
                }
                if (batch) {
                    memcpy(hits[k].time, rays.time, sizeof rays.time);
                    batch->closest(&list, &rays, NULL, KOKSMA__BLOCK, &hits[k]);
                    batch->occlude(&list, &hits[k], KOKSMA__BLOCK, &shadows[k]);
                    assert_memory_equal(&hits[k], &hits[0], sizeof hits[0]);
                    assert_memory_equal(&shadows[k], &shadows[0], sizeof shadows[0]);
                }
            }
            check_moved_lanes(scene, &rays, &hits[0]);
            koksma_scene_close(scene);
        }
    }
}

/* The geometry that Embree makes, with a mesh out of the way; and what a geometry leaves out of shadows (shapes that
   lie beside all others) is dark nowhere between shapes and lights. */
TEST_CASE(geometries_agree)
{
    static const char *const file = "koksma-test-shape.obj";
    test_write(file, "v 900 900 900\nv 901 900 900\nv 900 901 900\nf 1 2 3\n");
    const bool embree = koksma_mesh_tracer() != NULL;
    for (size_t kind = 0; koksma__shape_types[kind]; kind++) {
        for (uint64_t trial = 0; koksma__shape_types[kind]->hit && trial < TRIALS; trial++) {
            koksma_scene *scene =
                scene_with(koksma__shape_types[kind], 100 * kind + trial,
                           embree ? ", {'kind': 'mesh', 'file': 'koksma-test-shape.obj', 'material': 'm'}" : "");
            koksma__geometry plain, both;
            koksma__rays rays;
            koksma__hits a = {0}, b = {0};
            koksma__shadows shadows[3];
            assert_ok(koksma__accel_shapes(scene, &plain));
            assert_ok(embree ? koksma__accel_meshes(scene, &both) : koksma__accel_shapes(scene, &both));
            make_rays(scene->shapes, 4000 + 100 * kind + trial, &rays);
            plain.closest(&plain, &rays, NULL, KOKSMA__BLOCK, &a);
            both.closest(&both, &rays, NULL, KOKSMA__BLOCK, &b);
            assert_memory_equal(a.primitive, b.primitive, sizeof a.primitive);
            assert_memory_equal(a.t, b.t, sizeof a.t);
            assert_memory_equal(a.n, b.n, sizeof a.n);
            assert_memory_equal(a.material, b.material, sizeof a.material);
            memcpy(a.time, rays.time, sizeof a.time);
            memset(shadows, 0, sizeof shadows);
            for (int i = 0; i < KOKSMA__BLOCK; i++) { /* from the shape to the light at (0, 9, 0) */
                for (int k = 0; k < 3; k++) {
                    const bool hit = a.primitive[i] == 0 && a.t[i] < 20;
                    const float to_light[3] = {hit ? -a.p[0][i] : 1, hit ? 9 - a.p[1][i] : 0, hit ? -a.p[2][i] : 0};
                    set_lane(shadows[k].d, i, to_light);
                    shadows[k].light[i] = hit;
                }
            }
            plain.occlude(&plain, &a, KOKSMA__BLOCK, &shadows[0]);
            both.occlude(&both, &a, KOKSMA__BLOCK, &shadows[1]);
            koksma__batch()->occlude(plain.shapes, &a, KOKSMA__BLOCK, &shadows[2]);
            assert_memory_equal(shadows[0].light, shadows[2].light, sizeof shadows[0].light);
            assert_memory_equal(shadows[1].light, shadows[2].light, sizeof shadows[1].light);
            plain.release(&plain);
            both.release(&both);
            koksma_scene_close(scene);
        }
    }
    remove(file);
}
