/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every line of lights.def, with parameters drawn from the ranges that it declares. Two ways to integrate over the
 * light as seen from a point are compared, for nine functions g of the direction:
 *
 *     mean of g(w) / pdf over the light's own samples  =  integral of g over the directions whose rays meet the light
 *
 * where rays are traced through the scene, uniform in the cone about the light. With g = pdf that is the integral of
 * the density, with g = 1 the solid angle, with g = radiance x cosine the irradiance; a sample's
 * radiance is its value times its density. The power is that which crosses a sphere around the light. Pictures by all
 * ways of choosing among lights, and by path tracing (which also meets lights by reflected rays), have one mean.
 */
#include "kinds.h"
#include "lanes.h"
#include "render/accel/accel.h"
#include "render/lights/lights.h"
#include "render/vector3.h"

enum { TRIALS = test_repeats(12, 3), SAMPLES = 16384, SIDE = 128, FUNCTIONS = 9, PICTURES = 3 };

#define CAMERA "'camera': {'eye': [4, 1, 4], 'target': [1.2, -2, 1.2], 'fov_deg': 20}"
#define FLOOR                                                                                                        \
    "'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.8}], 'shapes': [{'kind': 'plane', 'centre': [0, "    \
    "-2, 0], 'normal': [0, 1, 0], 'material': 'm'}"

/* A tetrahedron for luminous meshes, which no object of "lights" makes. */
static const char *const tetrahedron = "koksma-test-light.obj";

static bool write_tetrahedron(void)
{
    FILE *file = fopen(tetrahedron, "w");
    assert_non_null(file);
    fputs("v 0 0.5 0\nv 0.5 0 0\nv -0.4 0 0.5\nv -0.3 -0.1 -0.5\nf 1 3 2\nf 1 4 3\nf 1 2 4\nf 2 3 4\n", file);
    return fclose(file) == 0;
}

/* The scene of one light of the kind, on a floor or alone, with more lights after it. NULL: this build can't. */
static koksma_scene *scene_with(const koksma__light_kind *kind, uint64_t stream, bool floor, bool visible,
                                const char *more)
{
    char fields[1024], light[1536], text[4096];
    koksma_scene *scene = NULL;
    kind_fields(&kind->kind, stream, fields, sizeof fields);
    for (const koksma__parameter *p = kind->kind.parameters; p && p->name; p++) {
        const char *asked = visible ? ", 'visible': true" : ", 'visible': false";
        char *at = strstr(fields, ", \"visible\":");
        if (!strcmp(p->name, "visible")) {
            if (at) { /* left out; then as asked */
                const char *rest = strchr(at + 1, ',');
                memmove(at, rest ? rest : "", strlen(rest ? rest : "") + 1);
            }
            strcat(fields, asked);
        }
    }
    for (const char *const *key = kind->kind.keys; key && *key; key++) { /* every third trial another one */
        static const char *const falloffs[] = {"square", "smooth", "angle"};
        if (!strcmp(*key, "falloff")) {
            const size_t used = strlen(fields);
            snprintf(fields + used, sizeof fields - used, ", 'falloff': '%s'%s", falloffs[stream % 3],
                     strstr(fields, "\"edge\"") ? "" : ", 'edge': 0.8");
        }
    }
    snprintf(light, sizeof light, "{'kind': '%s'%s}", kind->kind.name, fields);
    if (kind->kind.is_implied) {
        snprintf(
            text, sizeof text,
            "{" CAMERA "," FLOOR
            ", {'kind': 'mesh', 'file': '%s', 'emission': [3, 2, 1], 'translate': [%g, %g, 0]}], 'lights': [%s]}",
            tetrahedron, draw(stream, 1) - 0.5, draw(stream, 2) - 0.5, *more ? more + 2 : "");
    } else {
        snprintf(text, sizeof text, "{" CAMERA "," FLOOR "], 'lights': [%s%s]}", light, more);
    }
    if (open_text(text, &scene)) {
        if (kind->kind.is_implied && !koksma_mesh_tracer()) {
            return NULL;
        }
        fail_msg("%s: %s", text, koksma_error_text());
    }
    if (!floor) { /* nothing stands between */
        scene->shapes[0].centre[1] = -1e5;
    }
    return scene;
}

/* ---- Integrals over the light ------------------------------------------------------------------------------- */

typedef struct view {
    const koksma__shading_light *light;
    koksma__geometry geometry;
    int number; /* the light's */
    float p[3], n[3];
    float axis[3], u[3], v[3];
    double cosine; /* of the cone about axis that holds the light */
} view;

/* The radiance that comes to p along w from the light, and the density of w; false: none. */
static bool look(const view *v, const float w[3], float radiance[3], float *pdf)
{
    const koksma__shading_light *l = v->light;
    koksma__rays rays;
    koksma__hits hits;
    for (int i = 0; i < KOKSMA__LANE_STEP; i++) {
        set_lane(rays.o, i, v->p);
        set_lane(rays.d, i, w);
        rays.time[i] = 0;
    }
    if (l->kind->radiance) {
        l->kind->radiance(l, w, radiance);
        *pdf = l->kind->pdf(l, v->p, w, 0, w);
        return true;
    }
    v->geometry.closest(&v->geometry, &rays, NULL, KOKSMA__LANE_STEP, &hits);
    if (hits.primitive[0] < 0 || hits.back[0] || v->geometry.light(&v->geometry, hits.primitive[0]) != v->number) {
        return false;
    }
    const float n[3] = {hits.n[0][0], hits.n[1][0], hits.n[2][0]};
    memcpy(radiance, l->radiance, sizeof l->radiance);
    *pdf = l->kind->pdf(l, v->p, w, hits.t[0], n);
    return true;
}

/* The functions of w; the last two are the density, and irradiance by the red of the radiance. */
static void functions(const view *v, const float w[3], const float radiance[3], double pdf, double g[FUNCTIONS])
{
    const double x = (double)koksma__dot3(v->u, w), y = (double)koksma__dot3(v->v, w);
    const double cosine = (double)koksma__dot3(v->n, w);
    g[0] = 1;
    g[1] = x > 0;
    g[2] = y > 0;
    g[3] = x > y;
    g[4] = x * x;
    g[5] = y * y;
    g[6] = fabs(x) + fabs(y);
    g[7] = pdf;
    g[8] = (double)radiance[0] * (cosine > 0 ? cosine : 0);
}

/* Integrals over the directions whose rays meet the light, of a jittered grid in the cone. */
static void by_rays(const view *v, uint64_t stream, double sums[FUNCTIONS], double squares[FUNCTIONS])
{
    const double cells = SIDE * SIDE, whole = 2 * M_PI * (1 - v->cosine);
    memset(sums, 0, FUNCTIONS * sizeof *sums);
    memset(squares, 0, FUNCTIONS * sizeof *squares);
    for (uint64_t i = 0; i < SIDE * SIDE; i++) {
        const double x = ((double)(i % SIDE) + draw(stream, 2 * i)) / SIDE;
        const double turn = 2 * M_PI * ((double)(i / SIDE) + draw(stream, 2 * i + 1)) / SIDE;
        const double z = 1 - x * (1 - v->cosine), r = sqrt(fmax(1 - z * z, 0));
        float w[3], radiance[3], pdf;
        double g[FUNCTIONS];
        for (int k = 0; k < 3; k++) {
            w[k] =
                (float)(r * cos(turn) * (double)v->u[k] + r * sin(turn) * (double)v->v[k] + z * (double)v->axis[k]);
        }
        if (look(v, w, radiance, &pdf)) {
            functions(v, w, radiance, (double)pdf, g);
            for (int j = 0; j < FUNCTIONS; j++) {
                sums[j] += whole * g[j] / cells;
                squares[j] += whole * whole * g[j] * g[j] / cells;
            }
        }
    }
}

/* Returns whether the ray to the position meets the next triangle, because the position is within rounding of an edge. */
static bool check_beam(const view *v, const koksma__beam *beam)
{
    const koksma__shading_light *l = v->light;
    const double length = sqrt((double)koksma__dot3(beam->w, beam->w));
    const double along = (double)koksma__dot3(beam->w, beam->d), away = sqrt((double)koksma__dot3(beam->d, beam->d));
    float radiance[3], pdf = 0;
    assert_that(fabs(length - 1) < 1e-4 && fabs(along - away) < 1e-4 * away, "%s: d and w are not one direction",
                l->kind->kind.name);
    return beam->pdf > 0 && look(v, beam->w, radiance, &pdf) && pdf < 1e4f &&
           !(fabs((double)(pdf - beam->pdf)) <= 0.01 * (double)pdf);
}

static void by_samples(const view *v, uint64_t stream, double sums[FUNCTIONS], double squares[FUNCTIONS])
{
    memset(sums, 0, FUNCTIONS * sizeof *sums);
    memset(squares, 0, FUNCTIONS * sizeof *squares);
    uint64_t edges = 0;
    for (uint64_t i = 0; i < SAMPLES; i++) {
        const float u[2] = {(float)draw(stream, 2 * i) * 0.9999999f, (float)draw(stream, 2 * i + 1) * 0.9999999f};
        koksma__beam beam;
        double g[FUNCTIONS];
        if (!light_sample(v->light, v->p, u, &beam)) {
            continue;
        }
        edges += check_beam(v, &beam);
        const double pdf = (double)beam.pdf;
        const float radiance[3] = {(float)((double)beam.value[0] * pdf), 0, 0};
        functions(v, beam.w, radiance, pdf, g);
        for (int j = 0; j < FUNCTIONS; j++) {
            sums[j] += g[j] / pdf / SAMPLES;
            squares[j] += g[j] * g[j] / (pdf * pdf) / SAMPLES;
        }
    }
    assert_that(edges <= SAMPLES / 10000, "%s: %d of %d samples have another density than pdf() says",
                v->light->kind->kind.name, (int)edges, (int)SAMPLES);
}

/* A point outside of the light, its normal roughly to the light. */
static void set_view(const koksma__lights *lights, int number, uint64_t stream, view *v)
{
    const koksma__shading_light *l = &lights->lights[number];
    float away[3];
    const double distance = (double)l->reach * (1.3 + 2 * draw(stream, 50)) + 0.3;
    v->light = l;
    v->number = number;
    v->cosine = -1;
    draw_unit(stream, 60, away);
    if (l->kind->is_flat && koksma__dot3(away, l->normal) < 0) {
        for (int k = 0; k < 3; k++) {
            away[k] = -away[k];
        }
    }
    for (int k = 0; k < 3; k++) {
        v->p[k] = l->centre[k] + (float)distance * away[k];
        v->axis[k] = -away[k];
        v->n[k] = -away[k] + 0.5f * (float)(draw(stream, 70 + (uint64_t)k) - 0.5);
    }
    koksma__unit3(v->n);
    frame3(v->axis, v->u, v->v);
    if (l->kind->distance == KOKSMA__LIGHT_NEAR) {
        const double sine = 1.001 * (double)l->reach / distance;
        v->cosine = sqrt(1 - sine * sine);
    }
}

static void check_view(const view *v, uint64_t stream)
{
    static const char *const names[FUNCTIONS] = {
        "1", "x > 0", "y > 0", "x > y", "x^2", "y^2", "|x| + |y|", "pdf", "radiance x cosine"};
    double rays[FUNCTIONS], ray_squares[FUNCTIONS], samples[FUNCTIONS], sample_squares[FUNCTIONS];
    by_rays(v, stream, rays, ray_squares);
    by_samples(v, stream + 1, samples, sample_squares);
    for (int j = 0; j < FUNCTIONS; j++) {
        const double a = fmax(ray_squares[j] - rays[j] * rays[j], 0) / (SIDE * SIDE);
        const double b = fmax(sample_squares[j] - samples[j] * samples[j], 0) / SAMPLES;
        assert_that(fabs(rays[j] - samples[j]) <= 5 * sqrt(a + b) + 2e-3 * rays[j] + 1e-7,
                    "%s: the integral of %s is %g by rays and %g by samples (+- %.2g)", v->light->kind->kind.name,
                    names[j], rays[j], samples[j], sqrt(a + b));
    }
}

static void open_geometry(const koksma_scene *scene, koksma__geometry *out)
{
    if (scene->n_placements) {
        assert_ok(koksma__accel_meshes(scene, out));
    } else {
        assert_ok(koksma__accel_shapes(scene, out));
    }
}

TEST_CASE(samples_are_those_of_the_density)
{
    for (size_t k = 0; koksma__light_types[k]; k++) {
        for (uint64_t trial = 0; trial < TRIALS && koksma__light_types[k]->pdf; trial++) {
            koksma_scene *scene = scene_with(koksma__light_types[k], 100 * k + trial, false, true, "");
            koksma__lights lights;
            view v;
            if (!scene) {
                break;
            }
            assert_ok(koksma__lights_init(scene, &lights));
            open_geometry(scene, &v.geometry);
            set_view(&lights, 0, 300 * k + trial, &v);
            check_view(&v, 700 * k + 2 * trial);
            v.geometry.release(&v.geometry);
            koksma__lights_fini(&lights);
            koksma_scene_close(scene);
        }
    }
}

/* ---- Power ---------------------------------------------------------------------------------------------------- */

/* Luminous power over pi^2 of what crosses a sphere about the light; of light from far away, irradiance over pi. */
static double power_of(const koksma__shading_light *l, double scale, uint64_t stream, double *error)
{
    const double radius = scale * (3 * (double)l->reach + 1), area = 4 * M_PI * radius * radius;
    double sum = 0, squares = 0;
    for (uint64_t i = 0; i < SAMPLES; i++) {
        const float u[2] = {(float)draw(stream, 2 * i) * 0.9999999f, (float)draw(stream, 2 * i + 1) * 0.9999999f};
        float out[3], p[3];
        koksma__beam beam;
        draw_unit(stream + 1, i, out);
        for (int k = 0; k < 3; k++) {
            p[k] = l->centre[k] + (float)radius * out[k];
        }
        if (!light_sample(l, p, u, &beam)) {
            continue;
        }
        const double value = (double)koksma__luminance3(beam.value), cosine = -(double)koksma__dot3(out, beam.w);
        const double part = l->kind->distance == KOKSMA__LIGHT_NEAR ? area * value * fmax(cosine, 0) / (M_PI * M_PI)
                            : l->kind->distance == KOKSMA__LIGHT_PARALLEL ? value / M_PI
                                                                          : value / (4 * M_PI);
        sum += part / SAMPLES;
        squares += part * part / SAMPLES;
    }
    *error = sqrt(fmax(squares - sum * sum, 0) / SAMPLES);
    return sum;
}

TEST_CASE(powers_are_what_is_emitted)
{
    for (size_t k = 0; koksma__light_types[k]; k++) {
        for (uint64_t trial = 0; trial < TRIALS; trial++) {
            koksma_scene *scene = scene_with(koksma__light_types[k], 500 + 100 * k + trial, false, false, "");
            koksma__lights lights;
            double error;
            if (!scene) {
                break;
            }
            assert_ok(koksma__lights_init(scene, &lights));
            for (int far = 0; far < 2; far++) { /* the same power crosses every sphere */
                const double power = power_of(&lights.lights[0], far ? 1.7 : 0.8, 900 * k + trial, &error);
                assert_that(fabs(power - (double)lights.lights[0].power) <= 5 * error + 1e-3 * power,
                            "%s: says power %g, emits %g +- %.2g", koksma__light_types[k]->kind.name,
                            (double)lights.lights[0].power, power, error);
            }
            koksma__lights_fini(&lights);
            koksma_scene_close(scene);
        }
    }
}

/* ---- Pictures ------------------------------------------------------------------------------------------------- */

static double picture(const koksma_scene *scene, const char *integrator, koksma_light_selection lights, double *error)
{
    koksma_render_options options = options_of(scene, "random", integrator, 64, 16);
    options.lights = lights;
    options.seed = 5;
    return mean_of(scene, &options, error);
}

TEST_CASE(ways_of_choosing_agree)
{
    static const char *const more = ", {'kind': 'disk', 'centre': [1, 1, 1], 'facing': [1, -2, 1], 'radius': 0.4, "
                                    "'radiance': 1},{'kind': 'point', 'centre': [2, 0, 0], 'intensity': 0.5}";
    for (size_t k = 0; koksma__light_types[k]; k++) {
        for (uint64_t trial = 0; trial < PICTURES; trial++) {
            koksma_scene *scene = scene_with(koksma__light_types[k], 800 + 100 * k + trial, true, true, more);
            if (!scene) {
                break;
            }
            double error, others;
            const double all = picture(scene, "distribution", KOKSMA_LIGHTS_ALL, &error);
            for (int lights = KOKSMA_LIGHTS_ALL; koksma_light_selection_name((koksma_light_selection)lights);
                 lights++) {
                for (int by_path = 0; by_path < 2; by_path++) {
                    const char *integrator = by_path ? "path" : "distribution";
                    const double mean = picture(scene, integrator, (koksma_light_selection)lights, &others);
                    assert_that(fabs(mean - all) <= 5 * sqrt(error * error + others * others) + 1e-5 * all,
                                "%s: %s with lights %s has mean %g, distribution with all %g (+- %.2g)",
                                koksma__light_types[k]->kind.name, integrator,
                                koksma_light_selection_name((koksma_light_selection)lights), mean, all,
                                sqrt(error * error + others * others));
                }
            }
            koksma_scene_close(scene);
        }
    }
}

static int begin(void **state)
{
    (void)state;
    return write_tetrahedron() ? 0 : -1;
}

static int end(void **state)
{
    (void)state;
    return remove(tetrahedron);
}

TEST_GROUP(begin, end)
