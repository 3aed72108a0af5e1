/* SPDX-License-Identifier: Apache-2.0 */
/* The metrics of one job of a study in closed form: the image is the constant background of an empty scene, and the
   reference is a constant, too, but for two pixels of 2000, which are the 0.1 % that the robust values leave out. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <koksma/study.h>

#include "core/status.h"
#include "image/metrics/metrics.h"
#include "study/run/tasks.h"
#include "test.h"

enum { WIDTH = 50, HEIGHT = 40, PIXELS = WIDTH * HEIGHT };

static const char scene[] =
    "{\"camera\": {\"eye\": [0, 1, 0], \"target\": [0, 1, -1], \"fov_deg\": 20}, \"background\": "
    "0.5, \"ambient\": 1, \"materials\": [], \"shapes\": []}";
static const char plan[] =
    "{\"name\": \"p\", \"title\": \"p\", \"metric\": \"relmse:epsilon=1\", \"metrics\": [\"ldr-flip\", \"smape\"], "
    "\"images\": [{\"id\": \"i\", \"scenes\": [\"even.json\"], \"patterns\": [\"random\"], \"spp\": [1], \"trials\": "
    "1, "
    "\"size\": [50, 40], \"references\": [{\"name\": \"a\", \"pattern\": \"random\", \"spp\": 1}, {\"name\": \"b\", "
    "\"pattern\": \"random\", \"spp\": 2}]}], \"questions\": [{\"id\": \"q\", \"title\": \"q\", \"kind\": \"table\", "
    "\"images\": \"i\", \"metric\": \"relmse:epsilon=0.1\"}]}";

static void write_text(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_true(fputs(text, f) >= 0 && !fclose(f));
}

/* The errors of all pixels but two are e, those of these two are f. */
static void expect(const koksma__result *r, bool root, double e, double f)
{
    const double sum = (PIXELS - 2) * e + 2 * f, mean = sum / PIXELS;
    assert_near(r->values[0], root ? sqrt(mean) : mean, 1e-12);
    assert_near(r->values[1], root ? sqrt(e) : e, 1e-12);
    assert_near(r->values[2], 2 * f / sum, 1e-12);
    assert_true(isnan(r->values[3]));
}

static double relative(double reference, double epsilon)
{
    return (0.5 - reference) * (0.5 - reference) / (reference * reference + epsilon);
}

static double symmetric(double reference)
{
    return fabs(0.5 - reference) / (0.5 + reference + 0.01);
}

TEST_CASE(job_has_all_metrics)
{
    static const char *const metrics[] = {
        "mae", "rmse", "relmse", "smape", "relmse:epsilon=1", "ldr-flip", "relmse:epsilon=0.1"};
    enum { N = sizeof metrics / sizeof *metrics };
    char folder[] = "/tmp/koksma-metrics-XXXXXX";
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
    write_text("even.json", scene);
    write_text("plan.json", plan);
    const char *path = "./plan.json";
    koksma_study *study;
    koksma__tasks tasks;
    assert_ok(koksma_study_open(&(koksma_study_options){.plans = &path, .n_plans = 1}, &study));
    assert_string_equal(study->plan.parts[0].metric, "relmse:epsilon=1");
    assert_string_equal(study->plan.questions[0].metric, "relmse:epsilon=0.1");
    assert_ok(koksma__tasks_open(study, true, &tasks));
    assert_int_equal(tasks.n, 1);
    const koksma__task *t = &tasks.at[0];
    assert_int_equal(t->n_series, 2 + 1 + N);
    for (size_t r = 0; r < study->n_references; r++) { /* the last reference is the one for metrics */
        koksma_image *image = &study->references[r].image;
        assert_ok(koksma_image_init(image, WIDTH, HEIGHT, 1));
        for (int i = 0; i < PIXELS; i++) {
            image->pixels[i] = r == 0 ? 0.125F : i == 7 || i == 1999 ? 8 : 0.25F;
        }
    }
    koksma__result results[2 + 1 + N];
    const koksma_run run = {.threads = 1};
    assert_ok(koksma__task_do(study, t, 0, &run, results));
    assert_near(results[0].values[0], 0.375, 0); /* the rows of images, as before there were metrics */
    assert_near(results[1].values[0], ((PIXELS - 2) * 0.25 + 2 * 7.5) / PIXELS, 1e-15);
    assert_near(results[1].values[3], sqrt(((PIXELS - 2) * 0.0625 + 2 * 56.25) / PIXELS), 1e-15);
    for (size_t m = 0; m < N; m++) {
        char name[KOKSMA__REFERENCE_NAME];
        const koksma__series series = koksma__task_series(t, 3 + m, name);
        assert_string_equal(series.kind, "metric");
        assert_string_equal(series.metric, metrics[m]);
        assert_string_equal(series.what, "b:random@2x1");
    }
    expect(&results[3], false, 0.25, 7.5);
    expect(&results[4], true, 0.0625, 56.25);
    expect(&results[5], false, relative(0.25, 0.01), relative(8, 0.01));
    expect(&results[6], false, symmetric(0.25), symmetric(8));
    expect(&results[7], false, relative(0.25, 1), relative(8, 1));
    assert_true(results[8].values[0] > 0.1 &&
                results[8].values[0] < 1); /* tests/image/test_metrics.c has its values */
    expect(&results[9], false, relative(0.25, 0.1), relative(8, 0.1));
    koksma__tasks_close(&tasks);
    assert_ok(koksma_study_close(study));
    assert_int_equal(remove("even.json") | remove("plan.json") | chdir("/") | rmdir(folder), 0);
}

/* Metrics that are evaluated together are bit for bit those that are evaluated alone, with 1 and 3 channels. */
TEST_CASE(together_as_alone)
{
    static const char *const texts[] = {"smape", "mae", "ldr-flip:ppd=20", "rmse", "relmse", "hdr-flip:ppd=20"};
    enum { N = sizeof texts / sizeof *texts };
    koksma_metric_spec specs[N];
    koksma_metric_value together[N], alone;
    for (int channels = 1; channels <= 3; channels += 2) {
        koksma_image image, reference;
        assert_ok(koksma_image_init(&image, WIDTH, HEIGHT, channels));
        assert_ok(koksma_image_init(&reference, WIDTH, HEIGHT, 3));
        for (int i = 0; i < PIXELS * 3; i++) {
            reference.pixels[i] = (float)(i * 7919 % 1009) / 500;
        }
        for (int i = 0; i < PIXELS * channels; i++) {
            image.pixels[i] = (float)(i * 104729 % 1013) / 600;
        }
        for (size_t m = 0; m < N; m++) {
            assert_ok(koksma_metric_parse(texts[m], &specs[m]));
        }
        assert_ok(koksma__metrics_evaluate(specs, N, &image, &reference, together));
        for (size_t m = 0; m < N; m++) {
            assert_ok(koksma_metric_evaluate(&specs[m], &image, &reference, &alone));
            assert_memory_equal(&together[m].value, &alone.value, sizeof alone.value);
            assert_memory_equal(&together[m].robust, &alone.robust, sizeof alone.robust);
            assert_memory_equal(&together[m].top_share, &alone.top_share, sizeof alone.top_share);
            assert_int_equal(together[m].top, alone.top);
        }
        koksma_image_fini(&image);
        koksma_image_fini(&reference);
    }
}
