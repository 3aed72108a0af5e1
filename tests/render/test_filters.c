/* SPDX-License-Identifier: Apache-2.0 */
/* Every pixel filter, with samples drawn from it or splatted, against what a filter does to a ramp, which has every
   constant; and their frequency responses, against their Fourier transforms in closed form. */
#include <koksma/adaptive.h>

#include "rendering.h"

#include "render/one_image.h"
#include "render/pipelines/pipelines.h"
#include "render/samples/samples.h"

enum { SIDE = 16, EDGE = 3 /* beyond which splatted pixels have all their samples */ };

/* ---- Ramps -------------------------------------------------------------------------------------------------- */

/* The picture of samples whose value is their x on the film; no scene has such a surface. */
static void film_of_ramp(const koksma_scene *scene, const koksma_render_options *options, float *pixels)
{
    koksma__frame frame;
    koksma__film film;
    koksma_layers layers = {0};
    koksma__task_scratch room;
    koksma__group group;
    assert_ok(koksma__frame_open(scene, options, NULL, &frame));
    assert_ok(koksma__film_init(&frame, false, 1, &layers, &film));
    assert_ok(koksma__task_scratch_init(&frame, &koksma__pipeline_wavefront,
                                        koksma__whole_lanes((size_t)options->spp + KOKSMA__BLOCK), false, &room));
    assert_ok(koksma__film_open_task(&frame, &film, 0, 0, SIDE));
    for (size_t pixel = 0; pixel < SIDE * SIDE; pixel += group.count) {
        koksma__group_fill(&frame, pixel, pixel / SIDE * SIDE + SIDE, &group);
        assert_ok(koksma__group_draw(&frame, &group, KOKSMA__USE_PIXEL, true, &room.draw, room.values.film));
        koksma__film_place(&frame, &group, true, &room.values);
        for (size_t i = 0; i < group.start[group.count]; i++) {
            room.values.rgb[i] = room.values.film[2 * i];
        }
        koksma__film_add(&frame, &film, 0, &group, &room.values);
    }
    koksma__film_close_task(&frame, &film, 0);
    assert_ok(koksma__film_finish(&frame, &film, true));
    memcpy(pixels, layers.image.pixels, SIDE * SIDE * sizeof *pixels);
    koksma__task_scratch_fini(&room);
    koksma__film_fini(&film);
    koksma__frame_close(&frame);
    koksma_layers_fini(&layers);
}

/* Filters are even, and so a ramp keeps its value at the pixel's middle: where the samples are even about it, too,
   with 4 of them already; in the mean over seeds with any samples. */
TEST_CASE(filters_keep_a_ramp)
{
    enum { SEEDS = 8 };
    static const char *const patterns[] = {"regular", "random", "n-rooks", "sobol:scramble=owen"};
    static const int spps[] = {4, 16, 64};
    koksma_scene *scene = scene_of(SKY_ALONE("1"));
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        for (size_t c = 0; c < 24; c++) {
            const char *pattern = patterns[c % 4];
            koksma_render_options options = options_of(scene, pattern, "distribution", spps[c / 4 % 3], SIDE);
            double sum = 0, squares = 0;
            float pixels[SIDE * SIDE];
            options.filter = f;
            options.splat = c >= 12;
            for (options.seed = 0; options.seed < (c % 4 ? SEEDS : 1); options.seed++) {
                double off = 0;
                film_of_ramp(scene, &options, pixels);
                for (int y = EDGE; y < SIDE - EDGE; y++) {
                    for (int x = EDGE; x < SIDE - EDGE; x++) {
                        const double wrong = (double)pixels[y * SIDE + x] - (x + 0.5);
                        assert_that(c % 4 != 0 || fabs(wrong) <= 1e-4,
                                    "%s, %d samples%s: a ramp is off by %.2g pixels", f->name, options.spp,
                                    options.splat ? ", splatted" : "", wrong);
                        off += wrong / ((SIDE - 2 * EDGE) * (SIDE - 2 * EDGE));
                    }
                }
                sum += off;
                squares += off * off;
            }
            const double mean = sum / SEEDS, error = sqrt(fmax(squares / SEEDS - mean * mean, 0) / (SEEDS - 1));
            if (c % 4 && fabs(mean) > 7 * error + 1e-6) {
                fail_msg("%s, %s, %d samples%s: a ramp is off by %.2g +- %.1g pixels", f->name, pattern, options.spp,
                         options.splat ? ", splatted" : "", mean, error);
            }
        }
    }
    koksma_scene_close(scene);
}

/* ---- Edges -------------------------------------------------------------------------------------------------- */

/* Few independent samples drawn from a filter leave no bias: the mean of many pictures of an edge is the filter's
   integral up to it, also in the lobes, where most pictures have no sample. */
TEST_CASE(few_draws_have_no_bias)
{
    enum { SEEDS = test_repeats(100, 20), HEIGHT = 9 };
    koksma_scene *scene =
        scene_of("{'camera': {'eye': [0, 0, 1], 'target': [0, 0, 0], 'fov_deg': 90}, 'ambient': 1,'materials': "
                 "[{'name': 'm', 'kind': 'lambert', 'albedo': 1}], 'shapes': [{'kind': 'rectangle', 'centre': [-5, "
                 "0, 0], 'normal': [0, 0, 1], 'half': [5, 90], 'material': 'm'}]}");
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        for (int spp = 2; spp <= 8; spp *= 2) { /* the edge is in the middle of column 4 */
            koksma_render_options options = options_of(scene, "random", "distribution", spp, HEIGHT);
            double sum[9] = {0}, squares[9] = {0};
            options.filter = f;
            for (options.seed = 0; options.seed < SEEDS; options.seed++) {
                koksma_image image;
                assert_ok(koksma_render(scene, &options, NULL, &image));
                for (int p = 0; p < 9 * HEIGHT; p++) {
                    sum[p % 9] += (double)image.pixels[p];
                    squares[p % 9] += (double)image.pixels[p] * (double)image.pixels[p];
                }
                koksma_image_fini(&image);
            }
            for (int x = 0; x < 9; x++) {
                const double n = SEEDS * HEIGHT, mean = sum[x] / n;
                const double error = sqrt(fmax(squares[x] / n - mean * mean, 0) / n);
                double part = 0, whole = 0;
                for (double at = -2 + 5e-4; at < 2; at += 1e-3) {
                    part += x + at < 4 ? f->value(at) : 0;
                    whole += f->value(at);
                }
                assert_that(fabs(mean - part / whole) <= 4.5 * error + 2e-3,
                            "%s, %d samples, column %d: %.5f +- %.5f, expected %.5f", f->name, spp, x, mean, error,
                            part / whole);
            }
        }
    }
    koksma_scene_close(scene);
}

/* ---- Adaptive sampling -------------------------------------------------------------------------------------- */

/* A method that asks for nothing more has the picture and the variance of as many samples without it: weights are
   balanced over all samples that a pixel has. */
TEST_CASE(rounds_weigh_as_one_picture)
{
    koksma_scene *scene = shipped("balls");
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        koksma_render_options options = options_of(scene, "jittered", "distribution", 9, 24);
        koksma_adaptive_options adaptive;
        koksma_layers layers, rounds;
        options.filter = f;
        assert_ok(koksma_adaptive_parse("contrast:threshold=1e6", &adaptive));
        assert_ok(koksma_render_layers(scene, &options, NULL, &layers));
        assert_ok(koksma_render_adaptive(scene, &options, &adaptive, NULL, &rounds, NULL));
        for (size_t p = 0; p < 24 * 24; p++) {
            const double variance = (double)layers.variance.pixels[p];
            for (size_t k = 0; k < 3; k++) {
                assert_near((double)rounds.image.pixels[3 * p + k], (double)layers.image.pixels[3 * p + k], 2e-6);
            }
            assert_near((double)rounds.variance.pixels[p], variance, 1e-5 * variance + 1e-9);
        }
        koksma_layers_fini(&layers);
        koksma_layers_fini(&rounds);
    }
    koksma_scene_close(scene);
}

/* ---- Frequency responses ------------------------------------------------------------------------------------- */

/* Filters are even, and 0 beyond their radius. */
TEST_CASE(filters_are_what_they_say)
{
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        for (double x = 0; x < f->radius; x += 0.01) {
            assert_true(f->value(x) == f->value(-x));
        }
        assert_true(f->value(f->radius + 1e-9) == 0);
    }
}

/* sin(pi w) / (pi w): the transform of the box of width 1. */
static double sinc(double w)
{
    return w == 0 ? 1 : sin(M_PI * w) / (M_PI * w);
}

/* Harris's window of width 3 is a sum of cosines; each is two shifted boxes in frequency. */
static double window(double w)
{
    static const double a[] = {0.35875, 0.48829, 0.14128, 0.01168};
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        sum += a[k] / 2 * (sinc(3 * w - k) + sinc(3 * w + k));
    }
    return sum / a[0];
}

/* The cubic with B = C = 0, integrated by parts. */
static double cubic(double w)
{
    const double s = sinc(w), q = M_PI * w;
    return w == 0 ? 1 : 3 / (q * q) * (s * s - sinc(2 * w));
}

TEST_CASE(responses_are_the_transforms)
{
    for (int i = 0; i < 40; i++) {
        const double w = 0.171 * i, s = sinc(w);
        assert_near(koksma_filter_response(koksma_filter_find("box"), w), s, 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("tent"), w), s * s, 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("b-spline"), w), s * s * s * s, 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("blackman-harris"), w), window(w), 1e-9);
        assert_near(koksma_filter_response(koksma_filter_find("hermite"), w), cubic(w), 1e-9);
    }
}

/* Shifted copies add up to 1 exactly when the transform is 0 at all whole frequencies but 0 (Poisson's formula). */
TEST_CASE(partitions_of_unity_vanish_at_whole_frequencies)
{
    for (size_t i = 0; koksma_filter_at(i); i++) {
        const koksma_filter *filter = koksma_filter_at(i);
        const bool unity = strcmp(filter->name, "gaussian") != 0 && strcmp(filter->name, "blackman-harris") != 0;
        double most = 0;
        assert_near(koksma_filter_response(filter, 0), 1, 1e-15);
        for (int w = 1; w < 6; w++) {
            most = fmax(most, fabs(koksma_filter_response(filter, w)));
            assert_near(koksma_filter_response(filter, -w), koksma_filter_response(filter, w), 1e-15);
        }
        assert_that((most < 1e-9) == unity, "%s: %g at a whole frequency", filter->name, most);
    }
}

/* Of the box: 1 - (2 / pi) (Si(pi) - 2 / pi). The others by a sum over frequencies beyond 1/2, up to where all have
   died away but the box. */
TEST_CASE(leakage_is_the_squared_response_beyond_nyquist)
{
    const double si_pi = 1.851937051982466;
    assert_near(koksma_filter_leakage(koksma_filter_find("box")), 1 - 2 / M_PI * (si_pi - 2 / M_PI), 1e-7);
    for (size_t i = 1; koksma_filter_at(i); i++) {
        const koksma_filter *filter = koksma_filter_at(i);
        double inside = 0, outside = 0;
        for (int k = 0; k < 600; k++) {
            const double h = koksma_filter_response(filter, (k + 0.5) / 100);
            *(k < 50 ? &inside : &outside) += h * h;
        }
        assert_near(koksma_filter_leakage(filter), outside / (inside + outside), 1e-4);
    }
}
