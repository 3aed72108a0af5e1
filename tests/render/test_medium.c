/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The homogeneous medium against what is known of it: the exponential law, the integral of single scattering by
 * quadrature, white furnaces, and the phase function's definition. Every integrator that renders media is under test.
 */
#include "core/elementary.h"
#include "lanes.h"
#include "render/integrators/integrators.h"
#include "render/medium.h"

#define EYE(fov) "{'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': " fov "}, "
#define LAMBERT "'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.6}], "
#define NOTHING "'materials': [], 'shapes': []"

static bool renders_media(const koksma_integrator *in)
{
    return ((const koksma__integrator_flags *)in->flags)->media;
}

/* ---- Absorption ----------------------------------------------------------------------------------------------- */

/* A medium that only absorbs leaves exp(-sigma_a d) of the light of an emitter, a point and the sky, without noise: d is
   the length inside the box, from the eye to the surface, and again from there to the light. */
TEST_CASE(absorption_is_exponential)
{
    static const double sigma[3] = {0.3, 0.7, 0};
    static const struct {
        const char *what, *box, *scene;
        double light, length;
    } cases[] = {
        {"emitter through a slab", "'low': [-9, -9, 1], 'high': [9, 9, 3]",
         "'materials': [], 'shapes': [], 'lights': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], "
         "'half': [1, 1], 'radiance': 2, 'visible': true}]",
         2, 2},
        {"emitter from inside", "'low': [-9, -9, 1], 'high': [9, 9, 9]",
         "'materials': [], 'shapes': [], 'lights': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1, 'radiance': "
         "2, 'visible': true}]",
         2, 4},
        {"emitter everywhere", "",
         "'materials': [], 'shapes': [], 'lights': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], "
         "'half': [1, 1], 'radiance': 2, 'visible': true}]",
         2, 5},
        {"no medium on the way", "'low': [-9, -9, -3], 'high': [9, 9, -1]",
         "'materials': [], 'shapes': [], 'lights': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], "
         "'half': [1, 1], 'radiance': 2, 'visible': true}]",
         2, 0},
        {"background", "'low': [-9, -9, -7], 'high': [9, 9, -4.5]", "'background': 3, " NOTHING, 3, 2.5},
        {"sky", "'low': [-9, -9, -7], 'high': [9, 9, -4.5]",
         NOTHING ", 'lights': [{'kind': 'environment', 'radiance': 3}]", 3, 2.5},
        {"point", "",
         LAMBERT "'shapes': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], 'half': [1, 1], "
                 "'material': 'm'}], 'lights': [{'kind': 'point', 'centre': [0, 3, 4], 'intensity': 5}]",
         0.6 / M_PI * 5 * (4.0 / 5) / 25, 10},
        {"point through a slab", "'low': [-9, -9, 1], 'high': [9, 9, 2]",
         LAMBERT "'shapes': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], 'half': [1, 1], "
                 "'material': 'm'}], 'lights': [{'kind': 'point', 'centre': [0, 3, 4], 'intensity': 5}]",
         0.6 / M_PI * 5 * (4.0 / 5) / 25, 1 + 5.0 / 4},
        {"directional", "'low': [-50, -9, 0], 'high': [50, 2, 6]",
         LAMBERT "'shapes': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, 0, 1], 'half': [1, 1], "
                 "'material': 'm'}], 'lights': [{'kind': 'directional', 'direction': [0, -3, -4], 'irradiance': 5}]",
         0.6 / M_PI * 5 * 0.8, 5 + 2 / 0.6},
    };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        char text[2048];
        snprintf(text, sizeof text, EYE("0.01") "'medium': {'sigma_a': [%g, %g, %g]%s%s}, %s}", sigma[0], sigma[1],
                 sigma[2], *cases[c].box ? ", " : "", cases[c].box, cases[c].scene);
        koksma_scene *scene = scene_of(text);
        for (size_t i = 0; koksma_integrator_at(i); i++) {
            if (!renders_media(koksma_integrator_at(i))) {
                continue;
            }
            koksma_render_options options = options_of(scene, "random", koksma_integrator_at(i)->name, 1, 4);
            double mean[3], error[3];
            means_of(scene, &options, mean, error);
            for (int k = 0; k < 3; k++) {
                const double expected = cases[c].light * exp(-sigma[k] * cases[c].length);
                assert_that(fabs(mean[k] - expected) <= 1e-5 * expected, "%s by %s, channel %d: %.8g, expected %.8g",
                            cases[c].what, koksma_integrator_at(i)->name, k, mean[k], expected);
            }
        }
        koksma_scene_close(scene);
    }
}

/* ---- Single scattering ---------------------------------------------------------------------------------------- */

static double henyey_greenstein(double g, double cosine)
{
    return (1 - g * g) / (4 * M_PI * pow(1 + g * g - 2 * g * cosine, 1.5));
}

/* The light of a point of intensity 2 at (0, 1, 2), scattered once into the ray from (0, 0, 5) along -z, in the medium
   between z = -3 and z = 4: Simpson's rule in 4,000 steps. */
static double scattered_once(double absorption, double scattering, double g)
{
    const int steps = 4000;
    double sum = 0;
    for (int i = 0; i <= steps; i++) {
        const double s = 7.0 * i / steps, z = 4 - s, to[2] = {1, 2 - z}, distance = hypot(to[0], to[1]);
        const double cosine = to[1] / distance; /* light travels along -to and leaves along +z */
        const double value = scattering * henyey_greenstein(g, -cosine) * 2 / (distance * distance) *
                             exp(-(absorption + scattering) * (s + distance));
        sum += value * (i == 0 || i == steps ? 1 : i % 2 ? 4 : 2);
    }
    return sum * (7.0 / steps) / 3;
}

/* With depth 0 light is scattered once. By every integrator, pairing and scope, for three phase functions, in colour. */
TEST_CASE(single_scattering_is_its_integral)
{
    static const double gs[] = {-0.5, 0, 0.7}, a[3] = {0.05, 0, 0.2}, b[3] = {0.1, 0.3, 0.02};
    static const struct {
        const char *pattern;
        koksma_pairing pairing;
        koksma_scope scope;
    } ways[] = {{"random", KOKSMA_PAIRING_SHUFFLED, KOKSMA_SCOPE_PIXEL},
                {"random", KOKSMA_PAIRING_NATIVE, KOKSMA_SCOPE_PIXEL},
                {"sobol:scramble=owen", KOKSMA_PAIRING_NATIVE, KOKSMA_SCOPE_PIXEL},
                {"random", KOKSMA_PAIRING_SHUFFLED, KOKSMA_SCOPE_IMAGE}};
    for (size_t c = 0; c < 3; c++) {
        char text[1024];
        snprintf(text, sizeof text,
                 EYE("0.01") "'medium': {'sigma_a': [%g, %g, %g], 'sigma_s': [%g, %g, %g], 'g': %g, 'low': [-9, -9, "
                             "-3], 'high': [9, 9, 4]}, " NOTHING
                             ", 'lights': [{'kind': 'point', 'centre': [0, 1, 2], 'intensity': 2}]}",
                 a[0], a[1], a[2], b[0], b[1], b[2], gs[c]);
        koksma_scene *scene = scene_of(text);
        for (size_t i = 0; koksma_integrator_at(i); i++) {
            for (size_t w = 0; renders_media(koksma_integrator_at(i)) && w < 4; w++) {
                koksma_render_options options =
                    options_of(scene, ways[w].pattern, koksma_integrator_at(i)->name, 16, test_repeats(48, 16));
                double mean[3], error[3];
                options.depth = 0;
                options.pairing = ways[w].pairing;
                options.scope = ways[w].scope;
                options.seed = 1 + c;
                means_of(scene, &options, mean, error);
                for (int k = 0; k < 3; k++) {
                    assert_mean(mean[k], error[k], scattered_once(a[k], b[k], gs[c]));
                    assert_true(error[k] < test_repeats(0.05, 0.15) * mean[k]);
                }
            }
        }
        koksma_scene_close(scene);
    }
}

/* For any weights of a path: of the rays of length 3 the mean weight of those that pass is the transmittance, that of
   those that are scattered the part b / (a + b) of the rest, and that before the length 1 likewise; and the sum of the
   path's weights never grows. */
TEST_CASE(samples_are_unbiased_for_any_weights)
{
    static const double a[3] = {0, 0.3, 0.05}, b[3] = {1.5, 0.4, 0};
    static const float betas[][3] = {{1, 1, 1}, {0.9f, 0.05f, 0.4f}, {0, 0, 2}, {1e-6f, 3, 0}, {0, 1, 0.01f}};
    static const float o[3] = {0, 0, 0}, d[3] = {0, 0, 2};
    const int n = test_repeats(1600, 80) * KOKSMA__BLOCK;
    koksma__medium medium;
    koksma__medium_init(&medium, a, b, 0);
    for (size_t c = 0; c < sizeof betas / sizeof *betas; c++) {
        double passed[3] = {0, 0, 0}, scattered[3] = {0, 0, 0}, early[3] = {0, 0, 0};
        for (int first = 0; first < n; first += KOKSMA__BLOCK) {
            static koksma__paths paths;
            static koksma__hits hits;
            _Alignas(64) koksma__lanes u;
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                set_lane(paths.rays.o, i, o);
                set_lane(paths.rays.d, i, d);
                set_lane(paths.beta, i, betas[c]);
                u[i] = ((float)(first + i) + 0.5f) / (float)n;
                hits.t[i] = 1.5f;
                hits.primitive[i] = hits.material[i] = 0;
            }
            koksma__batch()->travel(&medium, u, 7, KOKSMA__BLOCK, &paths, &hits);
            for (int i = 0; i < KOKSMA__BLOCK; i++) {
                const bool scatters = hits.material[i] == 7;
                double before = 0, after[3];
                get_lane(paths.beta, i, after);
                for (int k = 0; k < 3; k++) {
                    const double weight = betas[c][k] > 0 ? after[k] / (double)betas[c][k] / n : 0;
                    (scatters ? scattered : passed)[k] += weight;
                    early[k] += scatters && hits.t[i] < 0.5f ? weight : 0;
                    before += (double)betas[c][k];
                }
                assert_true(after[0] + after[1] + after[2] <= before * (1 + 1e-6));
            }
        }
        for (int k = 0; k < 3; k++) {
            const double all = a[k] + b[k], part = b[k] / all;
            if (betas[c][k] > 1e-3f) {
                assert_near(passed[k], exp(-3 * all), 1e-3);
                assert_near(scattered[k], part * (1 - exp(-3 * all)), 1e-3);
                assert_near(early[k], part * (1 - exp(-all)), 1e-3);
            }
        }
    }
}

/* ---- Many bounces --------------------------------------------------------------------------------------------- */

/* Where nothing absorbs, every path that leaves brings the same light, so that all samples are 1, in each channel's mean
   too: a grey medium around white surfaces exactly, by whatever path. */
TEST_CASE(white_furnaces_are_white)
{
    static const double gs[] = {-0.5, 0, 0.7};
    for (size_t c = 0; c < 3; c++) {
        char text[1024];
        snprintf(text, sizeof text,
                 EYE("30") "'background': 1, 'medium': {'sigma_s': 1.5, 'g': %g, 'low': [-1, -1, -1], 'high': [1, 1, "
                           "1]}, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 1}, {'name': 'g', 'kind': "
                           "'mirror', 'reflectance': 1}], 'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], "
                           "'radius': 0.4, 'material': 'm'}, {'kind': 'sphere', 'centre': [0.6, 0.6, 0], 'radius': "
                           "0.3, 'material': 'g'}]}",
                 gs[c]);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "random", "path", 16, 16);
        koksma_image image;
        options.depth = KOKSMA_MAX_DEPTH;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        for (size_t i = 0; i < 16 * 16; i++) {
            assert_near((double)image.pixels[i], 1, 1e-5);
        }
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
}

/* Between walls that emit 1, on all sides of a medium that scatters differently in each channel, radiance is 1
   everywhere. By light sampling alone the variance is infinite, for the light of a wall's position grows as 1 /
   distance^2. */
TEST_CASE(emitting_enclosures_are_white)
{
    static const double gs[] = {-0.5, 0, 0.7};
    for (size_t c = 0; c < 3; c++) {
        char text[4096], walls[2048] = "";
        for (int side = 0; side < 6; side++) {
            int normal[3] = {0, 0, 0};
            normal[side / 2] = side % 2 ? 1 : -1;
            snprintf(walls + strlen(walls), sizeof walls - strlen(walls),
                     "%s{'kind': 'rectangle', 'centre': [%d, %d, %d], 'normal': [%d, %d, %d], 'half': [6, 6], "
                     "'radiance': 1, 'visible': true}",
                     side ? ", " : "", -6 * normal[0], -6 * normal[1], -6 * normal[2], normal[0], normal[1],
                     normal[2]);
        }
        snprintf(text, sizeof text,
                 EYE("30") "'medium': {'sigma_s': [0.1, 0.2, 0.3], 'g': %g}, 'materials': [{'name': 'm', 'kind': "
                           "'lambert', 'albedo': 1}], 'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': "
                           "1, 'material': 'm'}], 'lights': [%s]}",
                 gs[c], walls);
        koksma_scene *scene = scene_of(text);
        for (size_t i = 0; koksma_integrator_at(i); i++) {
            const koksma__integrator_flags *flags = koksma_integrator_at(i)->flags;
            if (flags->media && flags->weight != KOKSMA__WEIGHT_ONE) {
                koksma_render_options options =
                    options_of(scene, "random", koksma_integrator_at(i)->name, test_repeats(16, 4), 24);
                double mean[3], error[3];
                options.depth = 40;
                means_of(scene, &options, mean, error);
                for (int k = 0; k < 3; k++) {
                    assert_mean(mean[k], error[k] + 1e-4, 1);
                }
            }
        }
        koksma_scene_close(scene);
    }
}

/* ---- The phase function --------------------------------------------------------------------------------------- */

/* By its definition: the integral over the sphere is 1, the mean cosine g, exchanged directions give the same value;
   samples have weight 1, the density that value() says, mean cosine g and no preferred side. */
TEST_CASE(phase_function_is_as_defined)
{
    static const double gs[] = {-0.999, -0.5, -1e-5, 0, 1e-5, 0.3, 0.7, 0.95, 0.999};
    for (size_t c = 0; c < sizeof gs / sizeof *gs; c++) {
        const double none[3] = {0, 0, 0}, one[3] = {1, 1, 1}, g = gs[c];
        koksma__medium medium;
        koksma__medium_init(&medium, none, one, g);
        const koksma__shading_material m = koksma__shading_material_of(&medium.phase);
        koksma__surface s = {.material = &m, .out = {0.36f, -0.48f, 0.8f}}, other = {.material = &m};
        double integral = 0, mean = 0, sampled = 0, side[3] = {0, 0, 0};
        const int steps = test_repeats(200000, 20000), side_n = test_repeats(200, 100);
        for (int i = 0; i < steps; i++) { /* the cosine is 1 - x^3 from the peak on, whose width is 1e-3^2 */
            const double x = (i + 0.5) / steps * cbrt(2), from_peak = x * x * x;
            const double cosine = g < 0 ? from_peak - 1 : 1 - from_peak, dx = 3 * x * x * cbrt(2) / steps;
            const float w[3] = {(float)sqrt(1 - cosine * cosine), 0, (float)cosine};
            const koksma__surface along_z = {.material = &m, .out = {0, 0, -1}};
            float value[3];
            const float pdf = m.bsdf->value(&along_z, w, m.bsdf->lobes, value);
            assert_true(pdf == value[0] && pdf == value[1] && pdf == value[2]);
            integral += 2 * M_PI * (double)pdf * dx;
            mean += 2 * M_PI * (double)pdf * cosine * dx;
        }
        assert_near(integral, 1, fabs(g) > 0.99 ? 0.02 : 1e-4);
        assert_near(mean, g, fabs(g) > 0.99 ? 0.02 : 1e-4);
        for (int i = 0; i < side_n * side_n; i++) {
            const float u[2] = {((float)(i % side_n) + 0.5f) / (float)side_n,
                                ((float)(i / side_n) + 0.5f) / (float)side_n};
            koksma__scatter to;
            float value[3], back[3];
            assert_true(m.bsdf->sample(&s, m.bsdf->lobes, u, 0, &to));
            const float pdf = m.bsdf->value(&s, to.w, m.bsdf->lobes, value);
            double length = 0, cosine = 0;
            for (int k = 0; k < 3; k++) {
                length += (double)to.w[k] * (double)to.w[k];
                cosine -= (double)to.w[k] * (double)s.out[k];
                side[k] += (double)to.w[k] / (side_n * side_n);
                other.out[k] = to.w[k];
                assert_true(to.weight[k] == 1);
            }
            assert_near(length, 1, 1e-5);
            /* near the peak the density changes by the rounding of a direction */
            assert_true(fabs((double)to.pdf - (double)pdf) <= (fabs(g) > 0.9 ? 2 : 1e-3) * (double)pdf);
            assert_true(m.bsdf->value(&other, s.out, m.bsdf->lobes, back) == pdf);
            sampled += cosine / (side_n * side_n);
        }
        assert_near(sampled, g, 2e-3);
        for (int k = 0; k < 3; k++) {
            assert_near(side[k], -g * (double)s.out[k], 2e-3);
        }
    }
}

/* ---- The same bits, and refusals ------------------------------------------------------------------------------ */

/* Integrators without media name those that have them; ambient occlusion depends on shapes alone. */
TEST_CASE(other_integrators_refuse_media)
{
    koksma_scene *scene = scene_of(EYE("30") "'medium': {'sigma_s': 5}, " NOTHING "}");
    size_t refused = 0;
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        const koksma_integrator *in = koksma_integrator_at(i);
        const koksma__integrator_flags *flags = in->flags;
        koksma_render_options options = options_of(scene, "random", in->name, 1, 4);
        koksma_image image;
        if (!flags->media && !flags->replace_scene) {
            assert_int_equal(koksma_render(scene, &options, NULL, &image), KOKSMA_ARGUMENT);
            assert_non_null(strstr(koksma_error_text(), in->name));
            assert_non_null(strstr(koksma_error_text(), "path"));
            refused++;
        } else {
            assert_ok(koksma_render(scene, &options, NULL, &image));
            assert_near((double)image.pixels[0], flags->replace_scene ? 1 : 0, 1e-6);
            koksma_image_fini(&image);
        }
    }
    assert_true(refused > 0);
    koksma_scene_close(scene);
    scene = scene_of(EYE("30") "'medium': {'sigma_s': 5}, " NOTHING "}");
    assert_int_equal(koksma_scene_set_sky(scene, NULL, 1), KOKSMA_MALFORMED);
    koksma_scene_close(scene);
}

static double coefficient(void)
{
    return uniform(0, 1) < 0.3 ? 0 : uniform(0.01, 2);
}

static koksma__medium random_medium(int round)
{
    const bool grey = round % 2;
    const double a = coefficient(), b = coefficient();
    double absorption[3], scattering[3];
    koksma__medium m;
    for (int k = 0; k < 3; k++) {
        absorption[k] = grey ? a : coefficient();
        scattering[k] = round % 5 == 4 ? 0 : grey ? b : coefficient();
    }
    koksma__medium_init(&m, absorption, scattering, 0.2);
    m.in_shape = round % 7 > 4;
    m.is_ball = round % 7 == 6;
    for (int k = 0; k < 3; k++) {
        m.low[k] = round % 3 ? uniform(-2, 0) : -(double)INFINITY;
        m.high[k] = round % 3 ? uniform(0, 2) : (double)INFINITY;
        m.inverse[5 * k] = uniform(0.3, 2);
        m.inverse[4 * k + 3] = uniform(-1, 1);
    }
    return m;
}

/* Blocks of rays in media of all kinds, also along axes and with channels that carry nothing: every instruction set gives
   the same bits, rays scatter inside, and shadow rays keep exp(-(a + b) s) of their light. */
TEST_CASE(blocks_of_rays_travel_alike)
{
    for (int round = 0; round < test_repeats(210, 42); round++) {
        const koksma__medium m = random_medium(round);
        static koksma__paths first, paths[4];
        static koksma__hits met, hits[4];
        static koksma__shadows shadows;
        static _Alignas(64) koksma__lanes u, light[4][3];
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            draw_lane(first.rays.o, i, 3);
            for (int k = 0; k < 3; k++) {
                first.rays.d[k][i] = i % 4 == 3 || k == i % 4 ? (float)uniform(-2, 2) : 0;
                first.beta[k][i] = i % 9 == k || i % 31 == 0 ? 0 : (float)uniform(0, 1);
                light[0][k][i] = light[1][k][i] = light[2][k][i] = light[3][k][i] = 1;
            }
            u[i] = i ? (float)uniform(0, 1) * (1 - 0x1p-24f) : 0;
            met.primitive[i] = i % 3 ? 2 : -1;
            met.t[i] = (float)uniform(0, 4);
            met.material[i] = 1;
        }
        memcpy(met.p, first.rays.o, sizeof met.p);
        memcpy(shadows.d, first.rays.d, sizeof shadows.d);
        for (int k = 0; k < 4; k++) {
            const koksma__batch_table *batch = koksma__batch_find(isas[k]);
            paths[k] = first;
            hits[k] = met;
            if (batch) {
                batch->travel(&m, u, 7, KOKSMA__BLOCK, &paths[k], &hits[k]);
                batch->attenuate(&m, &met, &shadows, KOKSMA__BLOCK, light[k]);
                assert_memory_equal(&paths[k], &paths[0], sizeof *paths);
                assert_memory_equal(&hits[k], &hits[0], sizeof *hits);
                assert_memory_equal(light[k], light[0], sizeof *light);
            }
        }
        for (int i = 0; i < KOKSMA__BLOCK; i++) {
            const float o[3] = {met.p[0][i], met.p[1][i], met.p[2][i]};
            const float d[3] = {shadows.d[0][i], shadows.d[1][i], shadows.d[2][i]};
            const double end = met.primitive[i] < 0 ? (double)INFINITY : (double)met.t[i];
            const koksma__stretch inside = koksma__medium_stretch(&m, o, d, end),
                                  shadow = koksma__medium_stretch(&m, o, d, 1);
            const double far = (double)hits[0].t[i] - inside.first;
            assert_true(hits[0].material[i] != 7 || (far >= -1e-5 && far * inside.speed <= inside.length + 1e-5));
            for (int c = 0; c < 3; c++) {
                assert_true(light[0][c][i] == (float)koksma__exp(-koksma__medium_extinction(&m, c) * shadow.length));
            }
        }
    }
}
