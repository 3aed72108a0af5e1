/* SPDX-License-Identifier: Apache-2.0 */
/* Groups of uses: sample i takes the coordinates of point i of one set, whatever is asked for before; the picture is
   the same in the mean; texts. Long because all of it needs the same sets and scenes. */
#include <koksma/keys.h>

#include "drawing.h"
#include "patterns/masks/tile_size.h"

enum { N = 16, SIDE = 4, MOST = 1024 };

static koksma_render_options options_for(const char *patterns, int spp)
{
    koksma_render_options options = {.spp = spp, .width = SIDE, .height = SIDE, .seed = 77};
    assert_ok(koksma_pattern_spec("random", &options.pattern));
    assert_ok(koksma_render_patterns(patterns, &options));
    options.integrator = koksma_integrator_find("distribution");
    options.filter = koksma_filter_find("box");
    return options;
}

/* ---- Samples ------------------------------------------------------------------------------------------------ */

static void assert_point(const char *name, const double *x, double a, double b, double c)
{
    assert_that(fabs(x[0] - a) < 1e-6 && fabs(x[1] - b) < 1e-6 && fabs(x[2] - c) < 1e-6,
                "%s: sample (%.7g, %.7g, %.7g) of point (%.7g, %.7g, %.7g)", name, a, b, c, x[0], x[1], x[2]);
}

/* Every pattern of three dimensions that makes a set for one pixel: pixel and time of sample i are point i, in every
   pixel, in whichever order pixels and uses are asked for; and in the order of the names. */
TEST_CASE(samples_are_the_points_of_one_set)
{
    size_t tried = 0;
    for (size_t p = 0; koksma_pattern_at(p); p++) {
        const koksma_pattern *pattern = koksma_pattern_at(p);
        koksma_points points;
        koksma_spec spec;
        if (pattern->operand || pattern->min_dim > 3 || pattern->max_dim < 3) {
            continue;
        }
        assert_ok(koksma_pattern_spec(pattern->name, &spec));
        if (koksma__fit_image(&spec, SIDE)) {
            continue;
        }
        static const int sizes[] = {16, 27, 64, 8};
        for (size_t s = 0; s < 4; s++) {
            char text[2][128];
            const int n = sizes[s];
            assert_ok(koksma_points_init(&points, (size_t)n, 3));
            if (koksma_generate(&spec, 1, NULL, &points)) { /* not for this n */
                koksma_points_fini(&points);
                continue;
            }
            tried++;
            snprintf(text[0], sizeof text[0], "pixel+time=%s", pattern->name);
            snprintf(text[1], sizeof text[1], "time+pixel=%s", pattern->name);
            for (int order = 0; order < 2; order++) {
                const koksma_render_options options = options_for(text[order], n);
                drawing d;
                float place[128], time[128];
                open_drawing(&options, &d);
                for (uint64_t pixel = 0; pixel < test_repeats(4, 2); pixel++) {
                    assert_ok(koksma_generate(&spec, koksma__random_seed(options.seed, pixel, KOKSMA__USE_PIXEL),
                                              NULL, &points));
                    draw(&d, pixel, pixel % 2 ? KOKSMA__USE_TIME : KOKSMA__USE_PIXEL, pixel % 2 ? time : place);
                    draw(&d, pixel + 31, KOKSMA__USE_LENS, pixel % 2 ? place : time);
                    draw(&d, pixel, pixel % 2 ? KOKSMA__USE_PIXEL : KOKSMA__USE_TIME, pixel % 2 ? place : time);
                    for (int i = 0; i < n; i++) {
                        const double x = (double)place[2 * i], y = (double)place[2 * i + 1], t = (double)time[2 * i];
                        assert_point(text[order], points.xs + 3 * i, order ? t : x, order ? x : y, order ? y : t);
                    }
                }
                close_drawing(&d);
            }
            koksma_points_fini(&points);
            break;
        }
    }
    assert_true(tried >= 15);
}

/* Pixels of a wide image have the keys of their places, as by koksma/keys.h: those of a group over two uses, in some
   order of the samples; with native pairing quadruples are counted through the dimensions. */
TEST_CASE(pixels_have_the_keys_of_their_places)
{
    enum { WIDTH = 9, HEIGHT = 3, SPP = 6 };
    koksma_render_options native = options_for("ranking-keys:dims=4", SPP);
    koksma_render_options group = options_for("pixel+light=ranking-keys:dims=4", SPP);
    native.pairing = KOKSMA_PAIRING_NATIVE;
    for (uint64_t p = 0; p < (uint64_t)(WIDTH * HEIGHT); p++) {
        for (int k = 0; k < 2; k++) {
            koksma_render_options options = k ? native : group;
            drawing d;
            float pairs[2][2 * SPP];
            options.width = WIDTH;
            options.height = HEIGHT;
            open_drawing(&options, &d);
            draw(&d, p, KOKSMA__USE_PIXEL, pairs[0]);
            draw(&d, p, k ? KOKSMA__USE_LENS : KOKSMA__USE_LIGHT, pairs[1]);
            const koksma_keys keys = koksma_keys_of_4d(koksma__random_seed(options.seed, 0, KOKSMA__USE_PIXEL),
                                                       (uint32_t)p % WIDTH, (uint32_t)p / WIDTH, 0, SPP);
            for (uint32_t i = 0; i < SPP; i++) {
                bool found = false;
                float xs[4];
                koksma_keys_4f(&keys, i, xs);
                for (int s = 0; s < SPP; s++) {
                    bool same = true;
                    for (int c = 0; c < 4; c++) { /* keys round down, the renderer to the nearest float */
                        same &= fabsf(xs[c] - pairs[c / 2][2 * s + c % 2]) < 1e-6F;
                    }
                    found |= same;
                }
                assert_true(found);
            }
            close_drawing(&d);
        }
    }
}

/* All samples of a square image of a power of two pixels are one net, whichever use: z-sampler's definition. */
TEST_CASE(pixels_share_the_net_of_the_z_sampler)
{
    for (int bounce = 0; bounce < 2; bounce++) {
        const koksma_render_options options = options_for("z-sampler", N);
        drawing d;
        koksma_points all;
        koksma_spec measure;
        koksma_value t;
        assert_ok(koksma_points_init(&all, (size_t)SIDE * SIDE * N, 2));
        assert_ok(koksma_measure_spec("t-value", &measure));
        open_drawing(&options, &d);
        for (uint64_t p = 0; p < (uint64_t)(SIDE * SIDE); p++) {
            float pairs[2 * N];
            draw(&d, p, bounce ? KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LOBE : KOKSMA__USE_LIGHT, pairs);
            for (size_t i = 0; i < (size_t)(2 * N); i++) {
                all.xs[p * 2 * N + i] = (double)pairs[i];
            }
        }
        assert_ok(koksma_evaluate(&measure, &all, NULL, &t));
        assert_true(t.value == 0);
        close_drawing(&d);
        koksma_points_fini(&all);
    }
}

/* Faure's points in three dimensions: the first 27 have one in every elementary box of volume 1/27. That holds only
   for coordinates of one point, and for any order of points. */
static size_t boxes_with_one(const double xyz[][3], size_t n)
{
    size_t good = 0;
    for (int a = 1; a <= 27; a *= 3) {
        for (int b = 1; a * b <= 27; b *= 3) {
            const int c = 27 / (a * b);
            int counts[27] = {0}, one = 0;
            for (size_t i = 0; i < n; i++) { /* floats may round up to a border */
                const int box =
                    ((int)(xyz[i][0] * a + 1e-5) * b + (int)(xyz[i][1] * b + 1e-5)) * c + (int)(xyz[i][2] * c + 1e-5);
                counts[box]++;
            }
            for (int k = 0; k < 27; k++) {
                one += counts[k] == 1;
            }
            good += one == 27;
        }
    }
    return good;
}

TEST_CASE(stratification_in_all_dimensions_is_kept)
{
    static const struct {
        const char *text;
        uint32_t two, one;
        bool kept;
    } cases[] = {
        {"pixel+time=faure", KOKSMA__USE_PIXEL, KOKSMA__USE_TIME, true},
        {"pixel=faure;time=faure", KOKSMA__USE_PIXEL, KOKSMA__USE_TIME, false},
        {"lens+time=faure", KOKSMA__USE_LENS, KOKSMA__USE_TIME, true},
        {"lens+light-choice=faure", KOKSMA__USE_LENS, KOKSMA__USE_LIGHT_CHOICE, true},
        {"lobe+lobe-choice=faure", 2 * KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LOBE,
         2 * KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LOBE_CHOICE, true},
        {"lobe+lobe-choice=faure", KOKSMA__USE_LOBE, KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LOBE_CHOICE, false},
        {"light+light-choice=faure", KOKSMA__USE_LIGHT, KOKSMA__USE_LIGHT_CHOICE, true},
        {"light+light-choice=faure", KOKSMA__USE_LIGHT + 1, KOKSMA__USE_LIGHT_CHOICE, false},
        {"light+time=faure", KOKSMA__USE_LIGHT, KOKSMA__USE_TIME, true},
        {"light+time=faure", KOKSMA__USES_A_BOUNCE + KOKSMA__USE_LIGHT, KOKSMA__USE_TIME, false},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        for (int pairing = 0; pairing < 2; pairing++) {
            koksma_render_options options = options_for(cases[k].text, 27);
            drawing d;
            double xyz[27][3];
            float two[54], one[54];
            options.pairing = pairing ? KOKSMA_PAIRING_ALIGNED : KOKSMA_PAIRING_SHUFFLED;
            open_drawing(&options, &d);
            draw(&d, 3, cases[k].two, two);
            draw(&d, 3, cases[k].one, one);
            for (int i = 0; i < 27; i++) {
                xyz[i][0] = (double)two[2 * i];
                xyz[i][1] = (double)two[2 * i + 1];
                xyz[i][2] = (double)one[2 * i];
            }
            assert_that(!cases[k].kept || boxes_with_one(xyz, 27) == 10, "%s: not one point in every box",
                        cases[k].text);
            assert_that(cases[k].kept || pairing || boxes_with_one(xyz, 27) != 10,
                        "%s: separate sets have one point in every box", cases[k].text);
            close_drawing(&d);
        }
    }
}

/* Two groups of one pattern are paired at random, and differently from pixel to pixel. */
TEST_CASE(groups_are_shuffled_as_a_whole)
{
    koksma_render_options options = options_for("pixel+time=hammersley;lens+light=hammersley", N);
    drawing d;
    float place[2 * N], lens[2][2 * N], light[2][2 * N];
    open_drawing(&options, &d);
    draw(&d, 0, KOKSMA__USE_PIXEL, place);
    for (uint64_t pixel = 0; pixel < 2; pixel++) {
        draw(&d, pixel, KOKSMA__USE_LENS, lens[pixel]);
        draw(&d, pixel, KOKSMA__USE_LIGHT, light[pixel]);
    }
    assert_true(memcmp(lens[0], lens[1], sizeof lens[0]) != 0);
    assert_true(memcmp(lens[0], place, sizeof place) != 0);
    for (int i = 0; i < N; i++) {
        int found = 0;
        for (int k = 0; k < N; k++) { /* the same row in the other pixel */
            found += !memcmp(lens[0] + 2 * i, lens[1] + 2 * k, 8) && !memcmp(light[0] + 2 * i, light[1] + 2 * k, 8);
        }
        assert_int_equal(found, 1);
    }
    close_drawing(&d);
}

/* Over the image: the triples of all pixels are the points of one set of spp x pixels. */
TEST_CASE(over_the_image_too)
{
    static const char *const texts[] = {"pixel+time=hammersley", "pixel+time=scan-time", "pixel+lens=hammersley"};
    for (size_t k = 0; k < 3; k++) {
        koksma_render_options options = options_for(texts[k], N);
        drawing d = {.options = options};
        koksma_points points;
        const int dim = k == 2 ? 4 : 3;
        const size_t n = (size_t)N * SIDE * SIDE;
        const uint32_t other = k == 2 ? KOKSMA__USE_LENS : KOKSMA__USE_TIME;
        const koksma_use_group *group = &options.groups[0];
        static float place[2 * MOST], rest[2 * MOST];
        size_t samples = 0;
        options.scope = KOKSMA_SCOPE_IMAGE;
        assert_ok(koksma__image_samples(&options, &all_uses, NULL, &d.sampler));
        assert_ok(koksma_points_init(&points, n, dim));
        assert_ok(
            koksma_generate(&group->pattern, koksma__random_seed(options.seed, 0, KOKSMA__USE_PIXEL), NULL, &points));
        for (uint64_t pixel = 0; pixel < (uint64_t)SIDE * SIDE; pixel++) {
            draw(&d, pixel, KOKSMA__USE_PIXEL, place);
            draw(&d, pixel, other, rest);
            for (size_t i = 0; i < d.sampler.count(&d.sampler, pixel); i++, samples++) {
                size_t found = 0;
                for (size_t j = 0; j < n; j++) {
                    const double *x = points.xs + j * (size_t)dim;
                    found += fabs(x[0] * SIDE - (double)place[2 * i]) < 1e-6 * SIDE &&
                             fabs(x[1] * SIDE - (double)place[2 * i + 1]) < 1e-6 * SIDE &&
                             fabs(x[2] - (double)rest[2 * i]) < 1e-6 &&
                             (dim == 3 || fabs(x[3] - (double)rest[2 * i + 1]) < 1e-6);
                }
                assert_true(found >= 1);
            }
        }
        assert_int_equal(samples, n);
        koksma_points_fini(&points);
        d.sampler.release(&d.sampler);
    }
}

/* ---- Pictures ------------------------------------------------------------------------------------------------- */

/* A black ball that goes by before white. A ball of radius r at (x, 0, z) before a pinhole covers an ellipse of the
   plane at distance 1 whose area is pi r^2 sqrt((x^2 + z^2 - r^2) / (z^2 - r^2)^3). */
#define MOVING_BALL                                                                                                  \
    "'camera': {'eye': [0, 0, 5], 'target': [0, 0, 0], 'fov_deg': 50}, 'background': 1, 'shapes': [{'kind': "        \
    "'sphere', 'centre': [-1, 0, 0], 'radius': 0.6, 'motion': [2, 0, 0], 'material': 'm'}]"
#define BLACK "{'name': 'm', 'kind': 'lambert', 'albedo': 0}"

static double share_of_white(void)
{
    const double r = 0.6, z = 5, pi = acos(-1), side = 2 * tan(25 * pi / 180);
    double area = 0;
    for (int i = 0; i < 1000; i++) {
        const double x = -1 + 2 * (i + 0.5) / 1000;
        area += pi * r * r * sqrt((x * x + z * z - r * r) / pow(z * z - r * r, 3)) / 1000;
    }
    return 1 - area / (side * side);
}

static const moments *over_seeds(const koksma_scene *scene, koksma_render_options options, const char *method)
{
    static moments m;
    options.width = options.height = 12;
    measure(scene, options, method, 8 * options.spp, test_repeats(40, 10), 0, &m);
    return &m;
}

/* Groups of every kind of pattern show the ball's coverage over time, through both pipelines and over the image. */
TEST_CASE(pictures_are_right_in_the_mean)
{
    static const char *const texts[] = {
        "random;pixel+time=random",
        "random;pixel+time=scan-time",
        "random;pixel+time=poisson-time",
        "random;time+pixel=n-rooks",
        "random;pixel+time=zaremba:shift=1",
        "random;time+pixel=sobol:scramble=owen",
        "random;pixel+time=lattice-rank1:shift=1",
    };
    koksma_scene *lanes = scene_of("{'materials': [" BLACK "], " MOVING_BALL "}");
    koksma_scene *rays =
        scene_of("{'materials': [" BLACK ", {'name': 'x', 'kind': 'mirror', 'reflectance': 1}], " MOVING_BALL "}");
    for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
        koksma_render_options options = options_for(texts[k], N);
        const moments *m = over_seeds(lanes, options, NULL);
        assert_mean(m->image_mean, m->image_error, share_of_white());
        options.scope = KOKSMA_SCOPE_IMAGE;
        m = over_seeds(k % 2 ? lanes : rays, options, NULL);
        assert_mean(m->image_mean, m->image_error, share_of_white());
        options.scope = KOKSMA_SCOPE_PIXEL;
        m = over_seeds(rays, options, k % 2 ? "confidence:threshold=0.01" : NULL);
        assert_mean(m->image_mean, m->image_error + (k % 2 ? 1e-3 : 0),
                    share_of_white()); /* confidence: slightly biased */
    }
    koksma_scene_close(lanes);
    koksma_scene_close(rays);
}

/* ---- Texts and errors -------------------------------------------------------------------------------------------
 */

TEST_CASE(texts_have_a_canonical_form)
{
    static const char *const texts[][2] = {
        {"jittered", "jittered"},
        {"pixel+time=scan-time", "random;pixel+time=scan-time"},
        {"time+pixel=scan-time", "random;time+pixel=scan-time"},
        {"n-rooks ; lens=zaremba:shift=1; pixel+time=sobol:scramble=owen,shift=0",
         "n-rooks;pixel+time=sobol:scramble=owen;lens=zaremba:shift=1"},
        {"roulette+lobe=halton;light+lens=sobol;pixel=jittered",
         "random;pixel=jittered;light+lens=sobol;roulette+lobe=halton"},
        {"file:a;b.txt;time=random", "file:a;b.txt;time=random"},
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        char once[KOKSMA_MAX_PATTERNS_TEXT], twice[KOKSMA_MAX_PATTERNS_TEXT];
        const koksma_render_options options = options_for(texts[i][0], N);
        koksma_render_patterns_text(&options, once);
        assert_string_equal(once, texts[i][1]);
        const koksma_render_options again = options_for(once, N);
        koksma_render_patterns_text(&again, twice);
        assert_string_equal(twice, once);
    }
}

TEST_CASE(texts_that_are_wrong_say_so)
{
    static const struct {
        const char *text;
        koksma_status status;
        const char *said;
    } cases[] = {
        {"pixel+tme=random", KOKSMA_UNKNOWN,
         "pixel+tme=random: no such use; did you mean 'time'? the uses are pixel, lens"},
        {"pixel+=random", KOKSMA_UNKNOWN, "no such use"},
        {"+pixel=random", KOKSMA_UNKNOWN, "no such use"},
        {"pixel+time=rendom", KOKSMA_UNKNOWN, "no pattern 'rendom'"},
        {"pixel+time=", KOKSMA_ARGUMENT, "a name is empty"},
        {"", KOKSMA_ARGUMENT, "a name is empty"},
        {"random;", KOKSMA_UNKNOWN, "no pattern 'random;'"},
        {"random;jittered", KOKSMA_UNKNOWN, "no pattern 'random;jittered'"},
        {"pixel+time+pixel=random", KOKSMA_ARGUMENT, "use pixel occurs twice; a group takes each use once"},
        {"pixel+time=random;time+lens=random", KOKSMA_ARGUMENT, "use time already has a pattern"},
        {"pixel=random;pixel+lens=random", KOKSMA_ARGUMENT, "use pixel already has a pattern"},
        {"pixel+lens=random;lens=random", KOKSMA_ARGUMENT, "use lens already has a pattern"},
        {"pixel=random;pixel=jittered", KOKSMA_ARGUMENT, "a use takes one, alone or in one group"},
        {"pixel+lens=scan-time", KOKSMA_DIM,
         "these uses have 4 dimensions together (pixel 2, lens 2), but the pattern has 3"},
        {"pixel+time=pmj02", KOKSMA_DIM, "have 3 dimensions together (pixel 2, time 1), but the pattern has 2"},
        {"pixel=scan-time", KOKSMA_DIM, "such as pixel+time=PATTERN"},
    };
    koksma_render_options options = options_for("jittered", N);
    const koksma_render_options before = options;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const koksma_status status = koksma_render_patterns(cases[i].text, &options);
        assert_that(status == cases[i].status && strstr(koksma_error_text(), cases[i].said), "'%s': status %d, %s",
                    cases[i].text, status, koksma_error_text());
        assert_memory_equal(&options, &before, sizeof before);
    }
    assert_int_equal(koksma_render_patterns(NULL, &options), KOKSMA_ARGUMENT);
}
