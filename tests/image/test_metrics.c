/* SPDX-License-Identifier: Apache-2.0 */
/* Metrics of the error: what holds for all of the table, the pointwise ones by hand, and FLIP against its closed forms on
   constant images and the values of its authors' implementation (flip-evaluator 1.7) on pictures made here. */
#include <math.h>
#include <string.h>

#include <koksma/image.h>

#include "core/status.h"
#include "test.h"

enum { WIDTH = 61, HEIGHT = 47 };

typedef struct pair {
    koksma_image image, reference;
} pair;

static pair make(int width, int height, int channels)
{
    pair p;
    assert_ok(koksma_image_init(&p.image, width, height, channels));
    assert_ok(koksma_image_init(&p.reference, width, height, channels));
    return p;
}

static void release(pair *p)
{
    koksma_image_fini(&p->image);
    koksma_image_fini(&p->reference);
}

/* Wellons' "lowbias32" hash, as a number in [0, 1). */
static double hash(uint32_t n)
{
    n = (n ^ n >> 16) * 0x7feb352dU;
    n = (n ^ n >> 15) * 0x846ca68bU;
    return (n ^ n >> 16) / 4294967296.0;
}

/* Colourful stripes and noise in [0, 2), and the same with noise of 0.15 at most. */
static pair noisy(void)
{
    pair p = make(WIDTH, HEIGHT, 3);
    for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
        const int c = i % 3, x = i / 3 % WIDTH, y = i / 3 / WIDTH;
        const double at = (x + 1) * (c + 1) % 17 / 16.0 + y / 47.0, value = at * (0.5 + 0.5 * hash((uint32_t)i));
        p.reference.pixels[i] = (float)value;
        p.image.pixels[i] = (float)fmax(value + 0.3 * (hash((uint32_t)i + 1000003) - 0.5), 0);
    }
    return p;
}

static koksma_metric_value evaluate(const char *text, const pair *p)
{
    koksma_metric_spec spec;
    koksma_metric_value value;
    assert_ok(koksma_metric_parse(text, &spec));
    assert_ok(koksma_metric_evaluate(&spec, &p->image, &p->reference, &value));
    return value;
}

static void expect(const char *text, const pair *p, double value, double within)
{
    const double ours = evaluate(text, p).value;
    assert_that(fabs(ours - value) <= within, "%s: %.9g, not %.9g within %g", text, ours, value, within);
}

static void fill(koksma_image *image, double r, double g, double b)
{
    for (int i = 0; i < image->width * image->height * image->channels; i++) {
        image->pixels[i] = (float)(i % image->channels == 0 ? r : i % 3 == 1 ? g : b);
    }
}

/* Of every metric: 0 of equal images, positive of others, larger of a larger error, the same of a grey image with one
   channel and with three, and a canonical text that reads back. */
TEST_CASE(all_metrics_are_errors)
{
    pair p = noisy();
    size_t n = 0;
    for (const koksma_metric *m; (m = koksma_metric_at(n)); n++) {
        const double error = evaluate(m->name, &p).value;
        pair same = {p.reference, p.reference}, more = noisy();
        assert_true(error > 0);
        assert_true(evaluate(m->name, &same).value == 0);
        for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
            more.image.pixels[i] += 3 * (more.image.pixels[i] - more.reference.pixels[i]);
        }
        assert_that(evaluate(m->name, &more).value > 1.2 * error, "%s: no larger of four times the error", m->name);
        release(&more);
        pair one = make(8, 5, 1), three = make(8, 5, 3);
        for (int i = 0; i < 40; i++) {
            one.image.pixels[i] = (float)hash((uint32_t)i);
            one.reference.pixels[i] = (float)hash((uint32_t)i + 99);
            for (int c = 0; c < 3; c++) {
                three.image.pixels[3 * i + c] = one.image.pixels[i];
                three.reference.pixels[3 * i + c] = one.reference.pixels[i];
            }
        }
        expect(m->name, &three, evaluate(m->name, &one).value, 1e-12);
        release(&one);
        release(&three);
        koksma_metric_spec spec;
        char text[KOKSMA_MAX_SPEC];
        assert_ok(koksma_metric_parse(m->name, &spec));
        assert_ptr_equal(spec.metric, m);
        koksma_metric_text(&spec, text);
        assert_string_equal(text, m->name);
    }
    assert_true(n >= 7);
    release(&p);
}

TEST_CASE(pointwise_metrics_are_their_formulas)
{
    pair p = make(2, 1, 3);
    const float image[] = {2, 1, 0, 0, 0.5F, 1}, reference[] = {1, 1, 0, 0.5F, 0.5F, 0};
    memcpy(p.image.pixels, image, sizeof image);
    memcpy(p.reference.pixels, reference, sizeof reference);
    const double e0 = 0.2126, e1 = -0.5 * 0.2126 + 0.0722; /* of the luminances */
    expect("mae", &p, (e0 + fabs(e1)) / 2, 1e-12);
    expect("rmse", &p, sqrt((e0 * e0 + e1 * e1) / 2), 1e-12);
    expect("relmse", &p, (1 / 1.01 + 0.25 / 0.26 + 1 / 0.01) / 6, 1e-9);
    expect("relmse:epsilon=1", &p, (1 / 2.0 + 0.25 / 1.25 + 1) / 6, 1e-12);
    expect("smape", &p, (1 / 3.01 + 0.5 / 0.51 + 1 / 1.01) / 6, 1e-12);
    expect("smape:epsilon=2", &p, (1 / 5.0 + 0.5 / 2.5 + 1 / 3.0) / 6, 1e-12);
    koksma_image_error error;
    assert_ok(koksma_image_compare(&p.image, &p.reference, &error));
    expect("mae", &p, error.mean, 1e-15);
    expect("rmse", &p, error.rmse, 1e-15);
    release(&p);
}

/* A Gaussian of deviation s blurs an impulse to exp(-r^2 / (2 s^2)) / (2 pi s^2), whose squares have the sum
   1 / (4 pi s^2), and leaves a constant up to the edges. */
TEST_CASE(errors_are_blurred_by_gaussians)
{
    const double sd = 1.5;
    pair p = make(41, 31, 1);
    memset(p.image.pixels, 0, 41 * 31 * sizeof(float));
    memset(p.reference.pixels, 0, 41 * 31 * sizeof(float));
    p.image.pixels[15 * 41 + 20] = 2;
    expect("rmse:blur=1.5", &p, 2 * sqrt(1 / (4 * M_PI * sd * sd) / (41 * 31)), 1e-5);
    expect("mae:blur=1.5", &p, 2.0 / (41 * 31), 1e-12);
    koksma_image blurred;
    assert_ok(koksma_image_blur(&p.image, sd, &blurred));
    assert_near((double)blurred.pixels[15 * 41 + 20], 2 / (2 * M_PI * sd * sd), 1e-4);
    assert_near((double)(blurred.pixels[15 * 41 + 21] / blurred.pixels[15 * 41 + 20]), exp(-1 / (2 * sd * sd)), 1e-6);
    koksma_image_fini(&blurred);
    assert_int_equal(koksma_image_blur(&p.image, -1, &blurred), KOKSMA_ARGUMENT);
    for (size_t i = 0; i < 41 * 31; i++) {
        p.image.pixels[i] = 0.25F;
    }
    expect("rmse:blur=20", &p, 0.25, 1e-12);
    release(&p);
}

/* Waves of amplitude A have a mean square of A^2 / 2 at their frequency alone: those below 0.05 cycles a pixel are grain,
   and neither those above nor the mean. */
TEST_CASE(grain_is_the_power_of_coarse_waves)
{
    static const struct {
        int width, height, u, v;
        double below, share;
    } waves[] = {{128, 96, 3, 0, 0.05, 1}, {128, 96, 0, 4, 0.05, 1}, {128, 96, 4, 3, 0.05, 1},
                 {128, 96, 6, 4, 0.05, 0}, {128, 96, 7, 0, 0.05, 0}, {128, 96, 40, 30, 0.05, 0},
                 {61, 47, 2, 1, 0.05, 1},  {61, 47, 2, 2, 0.05, 0},  {61, 47, 12, 9, 0.4, 1},
                 {64, 1, 3, 0, 0.05, 1}};
    for (size_t i = 0; i < sizeof waves / sizeof *waves; i++) {
        pair p = make(waves[i].width, waves[i].height, 1);
        char text[32];
        for (int k = 0; k < waves[i].width * waves[i].height; k++) {
            const double turn = (double)waves[i].u * (k % waves[i].width) / waves[i].width +
                                (double)waves[i].v * (k / waves[i].width) / waves[i].height;
            p.reference.pixels[k] = 1;
            p.image.pixels[k] = (float)(1.25 + 0.5 * cos(2 * M_PI * turn + 1));
        }
        snprintf(text, sizeof text, "grain:below=%g", waves[i].below);
        expect(text, &p, waves[i].share * 0.5 / sqrt(2), 1e-6);
        release(&p);
    }
}

/* 3000 pixels, of error 0.01 and three of 1: the 0.1 % are three, and carry 3 / (3 + 29.97) of the absolute error, and
   3 / (3 + 0.2997) of the squared one; without them all is 0.01. */
TEST_CASE(few_pixels_are_set_apart)
{
    pair p = make(50, 60, 1);
    fill(&p.image, 0.01, 0, 0);
    p.image.pixels[7] = p.image.pixels[1234] = p.image.pixels[2999] = 1;
    koksma_metric_value v = evaluate("mae", &p);
    assert_int_equal(v.top, 3);
    assert_near(v.top_share, 3 / (3 + 29.97), 1e-6);
    assert_near(v.robust, 0.01, 1e-8);
    v = evaluate("rmse", &p);
    assert_near(v.top_share, 3 / (3 + 0.2997), 1e-6);
    assert_near(v.robust, 0.01, 1e-8);
    assert_true(v.top_share > KOKSMA_FEW_PIXELS);
    pair same = {p.reference, p.reference};
    v = evaluate("rmse", &same);
    assert_true(v.top_share == 0 && v.robust == 0 && v.value == 0);
    release(&p);
    pair one = make(1, 1, 1); /* too few pixels to leave any out */
    one.image.pixels[0] = 1;
    v = evaluate("mae", &one);
    assert_true(v.value == 1 && v.top == 0 && v.top_share == 0 && v.robust == 1);
    release(&one);
}

/* Constant images have no features. Of green and blue the error is 1 by definition; of black and white the distance HyAB
   is 100 (L* alone), and that of green and blue to the power 0.7 is 41.2760 (Andersson et al. 2020's own code). */
TEST_CASE(flip_of_constant_images_is_closed)
{
    pair p = make(30, 20, 3);
    fill(&p.image, 0, 1, 0);
    fill(&p.reference, 0, 0, 1);
    expect("ldr-flip", &p, 1, 1e-9);
    fill(&p.image, 0, 0, 0);
    fill(&p.reference, 1, 1, 1);
    const double most = 41.2760, knee = 0.4 * most;
    expect("ldr-flip", &p, 0.95 + 0.05 * (pow(100, 0.7) - knee) / (most - knee), 1e-5);
    expect("ldr-flip:ppd=20", &p, 0.95 + 0.05 * (pow(100, 0.7) - knee) / (most - knee), 1e-5);
    fill(&p.image, 7, -3, 0); /* clamped to (1, 0, 0) */
    fill(&p.reference, 1, 0, -1);
    expect("ldr-flip", &p, 0, 0);
    fill(&p.reference, 0, 0, 0); /* black: no median */
    assert_true(evaluate("hdr-flip", &p).value > 0.5);
    release(&p);
}

/* A caveat where the reference's median is 0, for hdr-flip alone, the only metric that looks at a median. */
TEST_CASE(metrics_warn_where_most_is_black)
{
    const koksma_metric *metric;
    const int blacks[] = {0, WIDTH * HEIGHT / 2, WIDTH * HEIGHT / 2 + 1, WIDTH * HEIGHT};
    for (size_t m = 0; (metric = koksma_metric_at(m)); m++) {
        for (int b = 0; b < 4; b++) {
            pair p = noisy();
            for (int i = 0; i < 3 * WIDTH * HEIGHT; i++) {
                p.reference.pixels[i] = i < 3 * blacks[b] ? 0 : p.reference.pixels[i] + 0.1F;
            }
            assert_int_equal(evaluate(metric->name, &p).caveat != NULL, b > 1 && !strcmp(metric->name, "hdr-flip"));
            release(&p);
        }
    }
}

TEST_CASE(flip_is_that_of_its_authors)
{
    pair p = noisy();
    expect("ldr-flip", &p, 0.1197534353, 2e-6);
    expect("ldr-flip:ppd=30", &p, 0.2275826037, 2e-6);
    for (int scale = 1; scale <= 50; scale += 49) { /* exposures follow the reference */
        pair light = noisy();
        for (int i = 0; i < WIDTH * HEIGHT * 3; i++) {
            light.image.pixels[i] *= light.image.pixels[i] * (float)scale;
            light.reference.pixels[i] *= light.reference.pixels[i] * (float)scale;
        }
        expect("hdr-flip", &light, 0.1524782628, 2e-6);
        expect("hdr-flip:tone-mapper=hable", &light, 0.1342922300, 2e-6);
        expect("hdr-flip:tone-mapper=reinhard", &light, 0.1679494381, 2e-6);
        release(&light);
    }
    release(&p);
}

/* Rows of studies are kept under a metric's revision: who changes a bit of a value raises it, and then these numbers. */
TEST_CASE(bits_go_by_revision)
{
    static const struct {
        const char *name;
        int revision;
        double value, robust, top_share;
    } kept[] = {
        {"mae", 0, 0x1.c9337a9833da7p-5, 0x1.c8b0a9dda49bap-5, 0x1.dba791a91cad3p-10},
        {"rmse", 0, 0x1.0c88e29e1d7b3p-4, 0x1.0c2b26c7eef6cp-4, 0x1.c060324440b1ap-9},
        {"relmse", 0, 0x1.25324a149368dp-5, 0x1.1fcc89720c0a5p-5, 0x1.38d53eb2988e8p-6},
        {"smape", 0, 0x1.3519649b96513p-4, 0x1.3339ad1d65397p-4, 0x1.babf7ed1e853ap-8},
        {"grain", 0, 0x1.fa83d5d72acd6p-8, 0x1.f9ac4875b48c1p-8, 0x1.07455e8f55583p-8},
        {"ldr-flip", 1, 0x1.ea8284ed34d9fp-4, 0x1.e95bd060e2acdp-4, 0x1.8ed653d05c95ep-9},
        {"hdr-flip", 1, 0x1.a8ad895ff267ep-4, 0x1.a6b79cfa83945p-4, 0x1.5c121ec58d69bp-8},
    };
    pair p = noisy();
    for (size_t i = 0; koksma_metric_at(i); i++) {
        size_t k = 0;
        while (k < sizeof kept / sizeof *kept && strcmp(kept[k].name, koksma_metric_at(i)->name) != 0) {
            k++;
        }
        assert_true(k < sizeof kept / sizeof *kept); /* a new metric needs a line above */
        assert_int_equal(koksma_metric_find(kept[k].name)->revision, kept[k].revision);
        const koksma_metric_value v = evaluate(kept[k].name, &p);
        assert_that(v.value == kept[k].value && v.robust == kept[k].robust && v.top_share == kept[k].top_share,
                    "{\"%s\", %d, %a, %a, %a}", kept[k].name, kept[k].revision, v.value, v.robust, v.top_share);
    }
    release(&p);
}

TEST_CASE(wrong_input_is_refused)
{
    koksma_metric_spec spec, empty = {0};
    koksma_metric_value value;
    pair p = make(3, 2, 3), other = make(2, 3, 3);
    assert_int_equal(koksma_metric_parse("relms", &spec), KOKSMA_UNKNOWN);
    assert_non_null(strstr(koksma_error_text(), "relmse"));
    assert_int_equal(koksma_metric_parse("relmse:epsilon=0", &spec), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_metric_parse("mae:epsilon=1", &spec), KOKSMA_ARGUMENT);
    assert_int_equal(koksma_metric_parse("hdr-flip:tone-mapper=filmic", &spec), KOKSMA_ARGUMENT);
    assert_non_null(strstr(koksma_error_text(), "aces, hable, reinhard"));
    assert_int_equal(koksma_metric_evaluate(&empty, &p.image, &p.reference, &value), KOKSMA_ARGUMENT);
    assert_ok(koksma_metric_parse("smape", &spec));
    assert_int_equal(koksma_metric_evaluate(&spec, &p.image, &other.image, &value), KOKSMA_ARGUMENT);
    release(&p);
    release(&other);
}
