/* SPDX-License-Identifier: Apache-2.0 */
/* Adaptive sampling: what it costs, what it may not exceed, bits, and the strata. */
#include <koksma/adaptive.h>

#include "rendering.h"

enum { WIDTH = 26, HEIGHT = 18, PIXELS = WIDTH * HEIGHT };

/* Every method with something that makes it go on. */
static const char *const methods[] = {
    "hierarchical",
    "hierarchical:threshold=0,levels=3,pairing=shuffled",
    "selective:threshold=0,below=2",
    "contrast:threshold=0.1,most=5",
    "confidence:threshold=0.01,most=5",
    "confidence:threshold=0.01,test=chi2,most=5,level=0.99",
};
enum { N_METHODS = sizeof methods / sizeof *methods };

static koksma_adaptive_options adaptive_of(const char *text, double budget)
{
    koksma_adaptive_options adaptive;
    assert_ok(koksma_adaptive_parse(text, &adaptive));
    adaptive.budget = budget;
    return adaptive;
}

static koksma_render_options options_for(const koksma_scene *scene, int spp)
{
    koksma_render_options options;
    koksma_render_options_init(&options, scene);
    options.width = WIDTH;
    options.height = HEIGHT;
    options.spp = spp;
    return options;
}

static koksma_layers render(const koksma_scene *scene, const char *method, double budget, int threads,
                            koksma_adaptive_report *report)
{
    const koksma_run run = {.threads = threads};
    const koksma_render_options options = options_for(scene, 4);
    const koksma_adaptive_options adaptive = adaptive_of(method, budget);
    koksma_layers layers;
    assert_ok(koksma_render_adaptive(scene, &options, &adaptive, &run, &layers, report));
    return layers;
}

TEST_CASE(every_method_is_tried)
{
    for (size_t i = 0; koksma_adaptive_at(i); i++) {
        const char *name = koksma_adaptive_at(i)->name;
        bool tried = false;
        for (size_t m = 0; m < N_METHODS; m++) {
            tried |= !strncmp(methods[m], name, strlen(name));
        }
        assert_that(tried, "no test of %s", name);
    }
}

TEST_CASE(same_bits_for_any_number_of_threads)
{
    koksma_scene *scene = shipped("all");
    for (size_t m = 0; m < 2 * N_METHODS; m++) {
        const double budget = m % 2 ? 0 : 21.5;
        koksma_adaptive_report first, other;
        koksma_layers one = render(scene, methods[m / 2], budget, 1, &first);
        for (int threads = 2; threads <= test_repeats(5, 2); threads += 3) {
            koksma_layers many = render(scene, methods[m / 2], budget, threads, &other);
            assert_memory_equal(one.image.pixels, many.image.pixels, PIXELS * sizeof(float));
            assert_memory_equal(one.samples.pixels, many.samples.pixels, PIXELS * sizeof(float));
            assert_memory_equal(one.variance.pixels, many.variance.pixels, PIXELS * sizeof(float));
            assert_true(one.rays == many.rays);
            assert_memory_equal(&first, &other, sizeof first);
            koksma_layers_fini(&many);
        }
        koksma_layers_fini(&one);
    }
    koksma_scene_close(scene);
}

/* A grey sky: each pixel is exactly it, and costs the first samples. */
TEST_CASE(constant_pictures_cost_the_first_samples)
{
    koksma_scene *scene = scene_of(SKY_ALONE("0.3"));
    for (size_t m = 0; m <= 2 * N_METHODS; m++) {
        const char *method = m < 2 * N_METHODS ? methods[m / 2] : "contrast:threshold=0"; /* no contrast is above 0 */
        koksma_adaptive_report report;
        koksma_layers layers = render(scene, method, m % 2 ? 0 : 50, 2, &report);
        assert_that(report.samples == report.first && layers.rays == report.samples,
                    "%s took %llu samples, %llu of them at first", method, (unsigned long long)report.samples,
                    (unsigned long long)report.first);
        for (int i = 0; i < PIXELS; i++) {
            assert_near((double)layers.image.pixels[i], (double)0.3f, 1e-7);
            assert_true(layers.variance.pixels[i] == 0);
        }
        koksma_layers_fini(&layers);
    }
    koksma_scene_close(scene);
}

/* The most samples that a pixel may have, 4 of them at first, or in a set. */
static double limit_of(const koksma_adaptive_options *a)
{
    if (!a->method->own_samples) {
        return 4 * a->params[1];
    }
    return 4 * pow(4, a->params[0]);
}

TEST_CASE(limits_and_budgets_are_kept)
{
    koksma_scene *scene = shipped("all");
    for (size_t m = 0; m < 2 * N_METHODS; m++) {
        const double budget = m % 2 ? 0 : 16.25;
        const koksma_adaptive_options adaptive = adaptive_of(methods[m / 2], budget);
        koksma_adaptive_report report;
        koksma_layers layers = render(scene, methods[m / 2], budget, 0, &report);
        double sum = 0;
        for (int i = 0; i < PIXELS; i++) {
            assert_true((double)layers.samples.pixels[i] <= limit_of(&adaptive));
            sum += (double)layers.samples.pixels[i];
        }
        assert_true(sum == (double)report.samples);
        assert_true(report.samples > report.first);
        if (budget > 0) {
            assert_true(sum <= budget * PIXELS);
        }
        koksma_layers_fini(&layers);
    }
    koksma_scene_close(scene);
}

/* One pixel is half black, half white, and its edge runs along strata of all levels: a stratum on either side has a
   constant value, so any subdivision gives exactly 1/2. With the edge inside of strata the finest strata bound the
   error: the edge crosses 4 2^levels of them, each of area 1 / (4 2^levels)^2 and wrong by 1 at most. */
TEST_CASE(strata_weigh_their_volume)
{
    static const char *const forms[] = {"hierarchical:threshold=0.5,levels=%d",
                                        "hierarchical:threshold=0.5,levels=%d,pairing=shuffled",
                                        "selective:threshold=0.5,levels=%d"};
    for (int form = 0; form < 3; form++) {
        for (int levels = 0; levels <= 5; levels++) {
            for (int inside = 0; inside < 2; inside++) {
                char text[600], method[80];
                snprintf(
                    text, sizeof text,
                    "{'camera': {'eye': [0, 0, 1], 'target': [0, 0, 0], 'fov_deg': 90},'ambient': 1, 'materials': "
                    "[{'name': 'm', 'kind': 'checker','albedos': [0, 1], 'period': 8, 'phase': [%g, 0.5]}],'shapes': "
                    "[{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 0, 1],'material': 'm'}]}",
                    inside ? 0.01 : 0.0);
                snprintf(method, sizeof method, forms[form], levels);
                koksma_scene *scene = scene_of(text);
                koksma_render_options options = options_of(scene, "random", "distribution", 16, 1);
                const koksma_adaptive_options adaptive = adaptive_of(method, 0);
                koksma_adaptive_report report;
                koksma_layers layers;
                assert_ok(koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, &report));
                /* the picture is 2 wide, the edge at x = -8 phase */
                const double expected = inside ? (1 - 8 * 0.01) / 2 : 0.5;
                const double got = fmin((double)layers.image.pixels[0], 1 - (double)layers.image.pixels[0]);
                assert_near(got, expected, inside ? 1 / (4 * ldexp(1, levels)) : 1e-7);
                assert_true(!levels || report.splits >= 8);
                koksma_layers_fini(&layers);
                koksma_scene_close(scene);
            }
        }
    }
}

/* Figure 5.36: with shuffled strata neighbours are far apart in other uses. */
static double needless(const koksma_scene *scene, const char *method)
{
    koksma_render_options options = options_for(scene, 64);
    koksma_adaptive_options adaptive = adaptive_of(method, 0);
    koksma_adaptive_report report;
    koksma_layers layers;
    adaptive.probes = 16;
    assert_ok(koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, &report));
    assert_true(report.needless <= report.splits && report.splits > 100);
    koksma_layers_fini(&layers);
    return (double)report.needless / (double)report.splits;
}

TEST_CASE(shuffled_strata_are_split_needlessly)
{
    koksma_scene *scene = shipped("ball");
    const double aligned = needless(scene, "hierarchical:levels=1");
    const double shuffled = needless(scene, "hierarchical:levels=1,pairing=shuffled");
    const double selective = needless(scene, "selective:levels=1");
    assert_that(aligned < shuffled - 0.05 && selective < shuffled,
                "needless: aligned %.3f, shuffled %.3f, selective %.3f", aligned, shuffled, selective);
    koksma_scene_close(scene);
}

/* Copies of samples that only fill lanes are no rays. */
TEST_CASE(rays_are_counted_once)
{
    koksma_scene *scene =
        scene_of("{'camera': {'eye': [0, 1, 4], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', "
                 "'kind': 'lambert', 'albedo': 0.9}], 'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': "
                 "[0, 1, 0], 'material': 'm'}], 'lights': [{'kind': 'rectangle', 'centre': [0, 2, 0], 'normal': [0, "
                 "-1, 0], 'half': [1, 1],'radiance': 2}]}");
    for (int spp = 1; spp < 40; spp++) {
        koksma_render_options options = options_of(scene, "random", "distribution", spp, 3);
        koksma_layers layers;
        assert_ok(koksma_render_layers(scene, &options, NULL, &layers));
        assert_int_equal((int)layers.rays, 2 * 9 * spp);
        koksma_layers_fini(&layers);
    }
    koksma_scene_close(scene);
}

/* The strata of a pixel are a partition of the square, with each sample in its own; their values are the pixel. */
TEST_CASE(shown_strata_are_a_partition)
{
    static const char *const forms[] = {"hierarchical:levels=3,threshold=0",
                                        "hierarchical:levels=3,threshold=0,pairing=shuffled",
                                        "selective:levels=2,below=2,threshold=0"};
    koksma_scene *scene = shipped("all");
    for (size_t f = 0; f < 3; f++) {
        const koksma_render_options options = options_for(scene, 16);
        koksma_adaptive_options adaptive = adaptive_of(forms[f], 0);
        koksma_strata strata = {.x = 12, .y = 15};
        koksma_layers layers;
        adaptive.strata = &strata;
        assert_ok(koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, NULL));
        for (size_t k = 0; k < strata.n_spaces; k++) {
            const koksma_space *space = &strata.spaces[k];
            const bool whole = k > 0 && !strncmp(forms[f], "selective", 9); /* only the first is split there */
            double area = 0, sum = 0;
            for (size_t i = 0; i < space->n; i++) {
                const koksma_stratum *s = &space->strata[i];
                area += s->width * s->height;
                sum += s->width * s->height * s->value;
                assert_true(s->at[0] >= s->x - 1e-7 && s->at[0] <= s->x + s->width + 1e-7);
                assert_true(s->at[1] >= s->y - 1e-7 && s->at[1] <= s->y + s->height + 1e-7);
                assert_int_equal(s->level > 0 && whole, 0);
            }
            assert_true(space->n > 16 && space->n_splits == 0);
            if (!whole) {
                assert_near(area, 1, 1e-12);
                assert_near(sum, (double)layers.image.pixels[15 * WIDTH + 12], 1e-6);
            }
        }
        assert_string_equal(strata.spaces[1].name, f < 2 ? "lens" : strata.spaces[1].name);
        assert_true(strata.n_spaces >= 3);
        koksma_strata_fini(&strata);
        koksma_layers_fini(&layers);
    }
    koksma_scene_close(scene);
}

static bool stop_later(void *context, double fraction)
{
    (void)fraction;
    return --*(int *)context > 0;
}

/* Wherever a render is stopped, also between the samples that decide and those that count: a pixel that had samples
   shows them, the others are black. */
TEST_CASE(a_pixel_that_had_samples_is_never_black)
{
    koksma_scene *scene = scene_of(SKY_ALONE("0.3"));
    for (size_t m = 0; m < N_METHODS; m++) {
        int stopped = 0;
        for (int asked = 2; asked < 12; asked++) {
            int left = asked;
            const koksma_run run = {.threads = 1, .keep_going = stop_later, .context = &left};
            const koksma_render_options options = options_for(scene, 4);
            const koksma_adaptive_options adaptive = adaptive_of(methods[m], 50);
            koksma_layers layers;
            const koksma_status status = koksma_render_adaptive(scene, &options, &adaptive, &run, &layers, NULL);
            assert_true(!status || status == KOKSMA_INTERRUPTED);
            stopped += status != KOKSMA_OK;
            for (int i = 0; i < PIXELS; i++) {
                assert_near((double)layers.image.pixels[i], layers.samples.pixels[i] > 0 ? 0.3 : 0, 1e-6);
            }
            koksma_layers_fini(&layers);
        }
        assert_true(stopped > 2);
    }
    koksma_scene_close(scene);
}

static bool stop_within_a_task(void *context, double fraction)
{
    (void)fraction;
    int *looks = context;
    return ++*looks < 3;
}

/* One task of 128 pixels, which a thread asks before and several times within: the picture is left unfinished. */
TEST_CASE(an_interruption_ends_a_task)
{
    koksma_layers layers;
    int looks = 0;
    const koksma_run run = {.threads = 1, .keep_going = stop_within_a_task, .context = &looks};
    const koksma_adaptive_options adaptive = adaptive_of("contrast:threshold=0.05,most=6,first=2", 0);
    koksma_adaptive_report report;
    koksma_scene *scene = shipped("ball");
    koksma_render_options options = options_for(scene, 1 << 12);
    options.width = 16;
    options.height = 8;
    assert_int_equal(koksma_render_adaptive(scene, &options, &adaptive, &run, &layers, &report), KOKSMA_INTERRUPTED);
    assert_true(looks >= 3);
    assert_true(report.samples > 0 && report.samples < 128ull << 12);
    koksma_layers_fini(&layers);
    koksma_scene_close(scene);
}
