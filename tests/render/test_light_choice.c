/* SPDX-License-Identifier: Apache-2.0 */
/*
 * One light for many. At a point the probabilities of all lights add to 1 in every selection; the choice of a block of
 * points has these probabilities, which a regular grid of u shows light by light; a light that gives anything can be
 * chosen, so that the mean of contribution / probability is the sum over all lights. `auto` is `one` for paths among
 * more than 8 lights, and `all` elsewhere; its mean is that of all lights.
 */
#include "lanes.h"
#include "render/lights/lights.h"
#include "render/pipelines/batch.h"
#include "render/pipelines/pipelines.h"
#include "rendering.h"

enum { POINTS = test_repeats(40, 8), GRID = test_repeats(4096, 1024) };

static koksma_render_options options_by(const koksma_scene *scene, koksma_light_selection lights)
{
    koksma_render_options options;
    koksma_render_options_init(&options, scene);
    options.integrator = koksma_integrator_find("path");
    options.lights = lights;
    return options;
}

static void random_point(float p[3], float n[3])
{
    float length = 0;
    for (int k = 0; k < 3; k++) {
        p[k] = uniform(-5, 5);
        n[k] = uniform(-1, 1);
        length += n[k] * n[k];
    }
    p[1] = uniform(0, 3.8);
    for (int k = 0; k < 3; k++) {
        n[k] /= sqrtf(length);
    }
}

/* What light l gives a white surface at p through u, without shadows; 0: nothing. */
static double contribution(const koksma__shading_light *l, const float p[3], const float n[3], const float u[2])
{
    koksma__beam beam;
    const bool lit = light_sample(l, p, u, &beam);
    const float cosine = lit ? beam.w[0] * n[0] + beam.w[1] * n[1] + beam.w[2] * n[2] : 0;
    return cosine > 0 ? (double)(cosine * beam.value[0]) : 0;
}

TEST_CASE(probabilities_add_to_one)
{
    koksma_scene *scene = shipped("many-lights");
    for (int selection = KOKSMA_LIGHTS_ONE; selection <= KOKSMA_LIGHTS_AUTO; selection++) {
        const koksma_render_options options = options_by(scene, (koksma_light_selection)selection);
        koksma__frame frame;
        int dark = 0;
        assert_ok(koksma__frame_open(scene, &options, NULL, &frame));
        for (int i = 0; i < POINTS; i++) {
            float p[3], n[3];
            double sum = 0;
            random_point(p, n);
            for (size_t l = 0; l < frame.lights.n; l++) {
                const float probability = koksma__light_probability(&frame, p, n, (int)l);
                sum += (double)probability;
                for (int s = 0; s < 16; s++) {
                    const float u[2] = {uniform(0, 1), uniform(0, 1)};
                    assert_that(contribution(&frame.lights.lights[l], p, n, u) <= 0 || probability > 0,
                                "light %zu gives light and has no probability", l);
                }
            }
            dark += sum == 0; /* none can give any light, as was checked */
            assert_near(sum, sum > 0 ? 1 : 0, 1e-5);
        }
        assert_true(dark < POINTS / 4);
        koksma__frame_close(&frame);
    }
    koksma_scene_close(scene);
}

TEST_CASE(choices_have_their_probabilities)
{
    static _Alignas(64) float estimates[KOKSMA__MAX_BATCH_LIGHTS][KOKSMA__BLOCK];
    koksma_scene *scene = shipped("many-lights");
    const koksma_render_options options = options_by(scene, KOKSMA_LIGHTS_ONE);
    koksma__frame frame;
    assert_ok(koksma__frame_open(scene, &options, NULL, &frame));
    for (int point = 0; point < POINTS; point++) {
        static koksma__hits hits;
        float p[3], n[3];
        double counts[KOKSMA__MAX_BATCH_LIGHTS] = {0}, expected[KOKSMA__MAX_BATCH_LIGHTS], first = 0, sum = 0;
        int none = 0; /* of the choices: all, or no light can give any */
        random_point(p, n);
        for (size_t l = 0; l < frame.lights.n; l++) {
            expected[l] = (double)koksma__light_probability(&frame, p, n, (int)l);
        }
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            set_lane(hits.p, i, p);
            set_lane(hits.n, i, n);
        }
        for (int start = 0; start < GRID; start += KOKSMA__BLOCK) {
            KOKSMA__LANES(float, u);
            KOKSMA__LANES(int32_t, light);
            KOKSMA__LANES(int32_t, first_light);
            KOKSMA__LANES(float, probability);
            KOKSMA__LANES(float, first_probability);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                u[i] = ((float)(start + i) + 0.5f) / GRID;
            }
            for (int isa = 0; isa < 4; isa++) {
                const koksma__batch_table *batch = koksma__batch_find(isas[isa]);
                if (batch) {
                    batch->choose(frame.lights.estimates, &hits, u, KOKSMA__BLOCK, estimates, light, probability);
                    if (isa == 0) {
                        memcpy(first_light, light, sizeof light);
                        memcpy(first_probability, probability, sizeof probability);
                    }
                    assert_memory_equal(light, first_light, sizeof light);
                    assert_memory_equal(probability, first_probability, sizeof probability);
                }
            }
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                assert_true(light[i] >= -1 && light[i] < (int32_t)frame.lights.n);
                if (light[i] < 0) {
                    none++;
                    continue;
                }
                counts[light[i]] += 1.0 / GRID;
                assert_near((double)probability[i], expected[light[i]], 1e-5 * expected[light[i]]);
            }
        }
        for (size_t l = 0; l < frame.lights.n; l++) {
            const float u[2] = {0.5f, 0.5f};
            const double gives = contribution(&frame.lights.lights[l], p, n, u);
            assert_near(counts[l], expected[l], 1.5 / GRID); /* an interval of u: at most one number more or less */
            sum += gives;
            first += expected[l] > 0 ? expected[l] * (gives / expected[l]) : 0;
        }
        assert_near(first, sum, 1e-9 * sum);
        assert_true(none == 0 || (none == GRID && sum == 0));
    }
    koksma__frame_close(&frame);
    koksma_scene_close(scene);
}

TEST_CASE(one_of_many_has_the_mean_of_all)
{
    double errors[2], means[2];
    koksma_scene *scene = shipped("many-lights");
    for (int i = 0; i < 2; i++) {
        koksma_render_options options = options_by(scene, i ? KOKSMA_LIGHTS_AUTO : KOKSMA_LIGHTS_ALL);
        options.width = 32;
        options.height = 24;
        options.spp = i ? test_repeats(64, 8) : test_repeats(8, 1);
        means[i] = mean_over_seeds(scene, options, test_repeats(20, 6), i ? 100 : 0, &errors[i]);
    }
    assert_near(means[1], means[0], 4 * hypot(errors[0], errors[1]));
    assert_true(hypot(errors[0], errors[1]) < test_repeats(2e-3, 2e-2) * means[0]);
    koksma_scene_close(scene);
}

TEST_CASE(automatic_selection)
{
    static const struct {
        const char *scene, *integrator;
        koksma_light_selection expected;
    } rows[] = {{"many-lights", "path", KOKSMA_LIGHTS_ONE},
                {"many-lights", "distribution", KOKSMA_LIGHTS_ALL},
                {"many-lights", "whitted", KOKSMA_LIGHTS_ALL},
                {"cornell", "path", KOKSMA_LIGHTS_ALL},
                {"balls", "path", KOKSMA_LIGHTS_ALL}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        koksma_image images[2];
        koksma_scene *scene = shipped(rows[i].scene);
        for (int k = 0; k < 2; k++) {
            koksma_render_options options = options_by(scene, k ? rows[i].expected : KOKSMA_LIGHTS_AUTO);
            options.integrator = koksma_integrator_find(rows[i].integrator);
            options.width = options.height = 12;
            options.spp = 4;
            assert_ok(koksma_render(scene, &options, NULL, &images[k]));
        }
        assert_memory_equal(images[0].pixels, images[1].pixels, 144 * (size_t)images[0].channels * sizeof(float));
        koksma_image_fini(&images[0]);
        koksma_image_fini(&images[1]);
        koksma_scene_close(scene);
    }
}

/* A small disk overhead and another light, which reflect the same: pi 10^-4 L / pi is intensity / pi, irradiance
   / pi, or the radiance of the sky. By power the disk's is pi A L, a point's 4 pi I and a sphere's 4 pi times that of
   the disk that it shows, which are four times as much; one that is far away has the power of what it reflects. */
TEST_CASE(choices_are_in_proportion)
{
    static const struct {
        const char *light;
        double by_power;
    } cases[] = {
        {"'kind': 'disk', 'centre': [0, 1, 0], 'normal': [0, -1, 0], 'radius': 0.02, 'radiance': 250", 0.5},
        {"'kind': 'rectangle', 'centre': [0, 1, 0], 'normal': [0, -1, 0], 'half': [0.01, 0.01], 'radiance': "
         "785.398163",
         0.5},
        {"'kind': 'point', 'centre': [0, 1, 0], 'intensity': 0.314159265", 0.2},
        {"'kind': 'sphere', 'centre': [0, 1, 0], 'radius': 0.01, 'radiance': 1000", 0.2},
        {"'kind': 'directional', 'direction': [0, -1, 0], 'irradiance': 0.314159265", 0.5},
        {"'kind': 'environment', 'radiance': 0.1", 0.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0.3, 0.5, 0.3], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': "
                 "'m', 'kind': 'lambert', 'albedo': 1}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': "
                 "[0, 1, 0], 'material': 'm'}],'lights': [{'kind': 'disk', 'centre': [0, 1, 0], 'normal': [0, -1, "
                 "0], 'radius': 0.01, 'radiance': 1000}, {%s}]}",
                 cases[i].light);
        koksma_scene *scene = scene_of(text);
        koksma__lights lights;
        assert_ok(koksma__lights_init(scene, &lights));
        const float p[3] = {0, 0, 0}, n[3] = {0, 1, 0};
        float estimates[KOKSMA__MAX_BATCH_LIGHTS];
        koksma__batch()->estimate(lights.estimates, p, n, estimates);
        assert_near((double)estimates[0], 0.1, 1e-5); /* the reflected luminance itself */
        assert_near((double)estimates[1], 0.1, 1e-5);
        assert_near((double)lights.cdf[1], cases[i].by_power, 1e-5);
        koksma__lights_fini(&lights);
        /* and it is what the pictures show */
        koksma_render_options options = options_of(scene, "random", "distribution", 64, 8);
        double error;
        const double mean = mean_of(scene, &options, &error);
        assert_near(mean, 0.2, 4 * error + 1e-3);
        koksma_scene_close(scene);
    }
}
