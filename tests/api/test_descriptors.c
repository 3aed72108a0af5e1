/* SPDX-License-Identifier: Apache-2.0 */
/* Descriptors and functions of a caller's own: a pattern, measure, warp, filter, integrator, metric or adaptive method
   without a name or a function is refused by name, and a function that fails leaves a status that exists and a text. */
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/optimise.h>
#include <koksma/plot.h>
#include <koksma/study.h>
#include <koksma/warp.h>

#include "test.h"

static void refused(koksma_status status, const char *word)
{
    assert_that(status == KOKSMA_ARGUMENT && strstr(koksma_error_text(), word), "status %d, \"%s\", without \"%s\"",
                (int)status, koksma_error_text(), word);
}

TEST_CASE(patterns_and_measures)
{
    koksma_points p = test_points("jittered", 4, 2, 1);
    koksma_spec pattern, measure;
    koksma_value value;
    assert_ok(koksma_pattern_spec("random", &pattern));
    assert_ok(koksma_measure_spec("star", &measure));
    koksma_spec both = pattern;
    both.measure = measure.measure;
    refused(koksma_generate(&both, 1, NULL, &p), "exactly one");
    both = measure;
    both.pattern = pattern.pattern;
    refused(koksma_evaluate(&both, &p, NULL, &value), "exactly one");
    koksma_pattern own = *pattern.pattern;
    pattern.pattern = &own;
    assert_ok(koksma_generate(&pattern, 1, NULL, &p));
    own.generate = NULL;
    refused(koksma_generate(&pattern, 1, NULL, &p), "no generate");
    own = *koksma_pattern_find("random");
    own.name = NULL;
    refused(koksma_generate(&pattern, 1, NULL, &p), "no name");
    koksma_measure my = *measure.measure;
    measure.measure = &my;
    my.eval = NULL;
    refused(koksma_evaluate(&measure, &p, NULL, &value), "no eval");
    koksma_points_fini(&p);
}

TEST_CASE(warps)
{
    koksma_points p = test_points("jittered", 4, 2, 1), out;
    koksma_warp own = *koksma_warp_find("triangle");
    koksma_scatter_options options = {.warp = &own, .size = 64, .local_discrepancy = true};
    unsigned char *bytes;
    size_t n;
    refused(koksma_plot_scatter(&p, &options, KOKSMA_PLOT_SVG, &bytes, &n), "without a map");
    options.local_discrepancy = false;
    own.map = NULL;
    refused(koksma_warp_points(&own, &p, &out), "no map");
    refused(koksma_plot_scatter(&p, &options, KOKSMA_PLOT_SVG, &bytes, &n), "no map");
    own = *koksma_warp_find("triangle");
    own.dim = -1;
    refused(koksma_warp_points(&own, &p, &out), "2 dimensions if it is plane, else 3");
    koksma_points_fini(&p);
}

TEST_CASE(renderers)
{
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image, copy;
    assert_ok(koksma_scene_open("ball", &scene));
    koksma_render_options_init(&options, scene);
    options.width = options.height = 4;
    options.spp = 1;
    koksma_filter filter = *options.filter;
    options.filter = &filter;
    assert_ok(koksma_render(scene, &options, NULL, &image));
    static const double odd[] = {0, -1, NAN, INFINITY, 1e300};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        filter.radius = odd[i];
        refused(koksma_render(scene, &options, NULL, &copy), "radius");
        assert_true(isnan(koksma_filter_response(&filter, 0.5)) && isnan(koksma_filter_leakage(&filter)));
    }
    filter = *koksma_filter_find("box");
    filter.value = NULL;
    refused(koksma_render(scene, &options, NULL, &copy), "no value");
    assert_true(isnan(koksma_filter_response(&filter, 0.5)) && isnan(koksma_filter_leakage(&filter)));
    options.filter = koksma_filter_find("box");
    koksma_integrator integrator = *options.integrator;
    options.integrator = &integrator;
    integrator.flags = NULL;
    refused(koksma_render(scene, &options, NULL, &copy), "no flags");
    options.integrator = koksma_integrator_find("distribution");
    koksma_adaptive_options adaptive;
    assert_ok(koksma_adaptive_parse("contrast", &adaptive));
    koksma_adaptive method = *adaptive.method;
    adaptive.method = &method;
    method.functions = NULL;
    koksma_layers layers;
    refused(koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, NULL), "no functions");
    koksma_metric_spec spec;
    koksma_metric_value value;
    assert_ok(koksma_metric_parse("rmse", &spec));
    koksma_metric metric = *spec.metric;
    spec.metric = &metric;
    metric.errors = NULL;
    refused(koksma_metric_evaluate(&spec, &image, &image, &value), "no errors");
    koksma_image_fini(&image);
    koksma_scene_close(scene);
}

/* Counts that nobody could have filled. */
TEST_CASE(releases)
{
    koksma_strata strata = {.n_spaces = 5};
    koksma_strata_fini(&strata);
    assert_true(strata.n_spaces == 0);
}

/* ---- Functions that fail ------------------------------------------------------------------------------------- */

static koksma_status answer;

static koksma_status render(void *context, const koksma_rank_picture *picture, const koksma_run *run,
                            koksma_image *image)
{
    (void)context;
    (void)picture;
    (void)run;
    (void)image;
    return answer;
}

static koksma_status eval(const koksma_points *points, const koksma_args *args, koksma_value *out)
{
    (void)points;
    (void)args;
    (void)out;
    return answer;
}

TEST_CASE(functions_that_fail)
{
    static const struct {
        int answer;
        koksma_status status;
        const char *text;
    } cases[] = {{KOKSMA_IO, KOKSMA_IO, " failed: writing failed"},
                 {12345, KOKSMA_ARGUMENT, " returned 12345, which is not a koksma_status"},
                 {-7, KOKSMA_ARGUMENT, " returned -7, which is not a koksma_status"}};
    koksma_points p = test_points("jittered", 4, 2, 1);
    koksma_spec measure, own;
    koksma_value value;
    assert_ok(koksma_measure_spec("l2-star", &measure));
    koksma_measure mine = *measure.measure;
    mine.eval = eval;
    own = measure;
    own.measure = &mine;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        answer = (koksma_status)cases[i].answer;
        refused(koksma_image_check_path("stale"), "stale"); /* the text of an earlier call */
        assert_int_equal(koksma_evaluate(&own, &p, NULL, &value), cases[i].status);
        assert_non_null(strstr(koksma_error_text(), cases[i].text));
        assert_non_null(strstr(koksma_error_text(), "koksma_measure.eval"));
        const char *const patterns[] = {"a", "b"};
        const koksma_rank_options rank = {
            .scene = "s", .patterns = patterns, .n_patterns = 2, .spp = 1, .max_trials = 8, .render = render};
        koksma_rank_row rows[2];
        koksma_ranking ranking;
        const koksma_status status = koksma_rank_patterns(&rank, NULL, rows, &ranking);
        assert_true(status && status < KOKSMA_STATUS_COUNT);
        assert_non_null(strstr(koksma_error_text(), "koksma_rank_options.render"));
    }
    koksma_points_fini(&p);
}
