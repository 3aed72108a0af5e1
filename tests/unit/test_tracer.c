/* SPDX-License-Identifier: Apache-2.0 */
/* The general pipeline against closed forms: furnaces, form factors, lens, motion; and each way to sample against the
   others. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "scene/scene.h"
#include "test.h"

static koksma_scene *scene_of(const char *text)
{
    koksma_scene *scene = calloc(1, sizeof *scene);
    assert_non_null(scene);
    if (koksma__scene_parse("test.json", text, strlen(text), scene)) {
        fail_msg("%s", koksma_error_text());
    }
    return scene;
}

static koksma_render_options options_of(const koksma_scene *scene, const char *pattern, const char *integrator,
                                        int spp, int side)
{
    koksma_render_options options;
    koksma_render_options_init(&options, scene);
    assert_ok(koksma_pattern_spec(pattern, &options.pattern));
    options.integrator = koksma_integrator_find(integrator);
    assert_non_null(options.integrator);
    options.spp = spp;
    options.width = options.height = side;
    return options;
}

/* Mean of the image's first channel, and the standard error of it from the pixels, which are independent. */
static double mean_of(const koksma_scene *scene, const koksma_render_options *options, double *error)
{
    koksma_image image;
    double sum = 0, squares = 0;
    assert_ok(koksma_render(scene, options, NULL, &image));
    const size_t n = (size_t)image.width * (size_t)image.height;
    for (size_t i = 0; i < n; i++) {
        sum += (double)image.pixels[i * (size_t)image.channels];
    }
    for (size_t i = 0; i < n; i++) {
        const double off = (double)image.pixels[i * (size_t)image.channels] - sum / (double)n;
        squares += off * off;
    }
    koksma_image_fini(&image);
    if (error) {
        *error = n > 1 ? sqrt(squares / (double)(n - 1) / (double)n) : 0;
    }
    return sum / (double)n;
}

/* Within 4 standard errors and the rounding of floats. */
#define assert_mean(got, error, expected)                                                                            \
    do {                                                                                                             \
        const double got_ = (got), expected_ = (expected);                                                           \
        if (!(fabs(got_ - expected_) <= 4 * (error) + 2e-6 * fabs(expected_))) {                                     \
            fail_msg("%s = %.9g +- %.2g, expected %.9g", #got, got_, (double)(error), expected_);                    \
        }                                                                                                            \
    } while (0)

/* ---- The two pipelines ------------------------------------------------------------------------------------ */

#define BALL_PARTS                                                                                                   \
    "\"camera\": {\"eye\": [0, 2, 6], \"target\": [0, 1, 0], \"fov_deg\": 40}, \"background\": 0.4, \"ambient\": "   \
    "0.16,"                                                                                                          \
    "\"clamp\": 1, \"shapes\": [{\"kind\": \"rectangle\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0],"             \
    "\"half\": [5.5, 5.5], \"material\": \"tiles\"}, {\"kind\": \"sphere\", \"centre\": [0, 1, 0], \"radius\": 1,"   \
    "\"material\": \"ball\"}], \"lights\": [{\"kind\": \"rectangle\", \"centre\": [-2, 7, 3.5], \"facing\": [0, 1, " \
    "0],"                                                                                                            \
    "\"half\": [0.85, 0.85], \"strength\": 1.15}, {\"kind\": \"rectangle\", \"centre\": [4.8, 4.7, 1.7],"            \
    "\"facing\": [0, 1, 0], \"half\": [0.7, 0.7], \"strength\": 0.5}]"
#define BALL_MATERIALS                                                                                               \
    "{\"name\": \"tiles\", \"kind\": \"checker\", \"albedos\": [0.125, 0.875], \"period\": 1},"                      \
    "{\"name\": \"ball\", \"kind\": \"lambert\", \"albedo\": 0.8}"

/* A mirror that nothing is made of sends the same scene through the other pipeline. */
static void pipelines_agree(void **state)
{
    (void)state;
    koksma_scene *lanes = scene_of("{\"materials\": [" BALL_MATERIALS "]," BALL_PARTS "}");
    koksma_scene *rays = scene_of("{\"materials\": [" BALL_MATERIALS
                                  ",{\"name\": \"m\", \"kind\": \"mirror\", \"reflectance\": 1}]," BALL_PARTS "}");
    static const char *const patterns[] = {"random", "n-rooks", "sobol:scramble=owen"};
    for (size_t p = 0; p < 3; p++) {
        koksma_image a, b;
        koksma_render_options options = options_of(lanes, patterns[p], "distribution", 9, 33);
        assert_ok(koksma_render(lanes, &options, NULL, &a));
        assert_ok(koksma_render(rays, &options, NULL, &b));
        for (size_t i = 0; i < 33 * 33; i++) {
            assert_near((double)a.pixels[i], (double)b.pixels[i], 3e-6);
        }
        koksma_image_fini(&a);
        koksma_image_fini(&b);
    }
    koksma_scene_close(lanes);
    koksma_scene_close(rays);
}

/* ---- Furnaces --------------------------------------------------------------------------------------------- */

#define SIGHT "\"camera\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 0], \"fov_deg\": 0.01}"
#define WORLD "\"lights\": [{\"kind\": \"environment\", \"radiance\": 1}]"
#define BALL_OF "\"shapes\": [{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1, \"material\": \"m\"}]"

/* Under light that is the same from everywhere, seen straight on, a convex body shows the share that it reflects.
   That of GGX is (2 pi / 4) times the integral of D(theta / 2) / (1 + lambda(theta)) sin(theta): 1 - ln 2 for a = 1,
   and by quadrature 0.915812 for a = 1/4. */
static void furnace_shows_the_albedo(void **state)
{
    (void)state;
    static const struct {
        const char *material;
        double reflected;
    } cases[] = {
        {"\"kind\": \"lambert\", \"albedo\": 0.7", 0.7},
        {"\"kind\": \"mirror\", \"reflectance\": 0.6", 0.6},
        {"\"kind\": \"dielectric\", \"ior\": 1.5", 1},
        {"\"kind\": \"phong\", \"reflectance\": 0.9, \"exponent\": 200", 0.9},
        {"\"kind\": \"phong\", \"reflectance\": 0.9, \"exponent\": 2", 0.9},
        {"\"kind\": \"ggx\", \"reflectance\": 1, \"roughness\": 0.5", 0.915812},
        {"\"kind\": \"ggx\", \"reflectance\": 1, \"roughness\": 1", 1 - M_LN2},
        {"\"kind\": \"utah\", \"albedo\": 0.4, \"reflectance\": 0.5, \"exponent\": 300", 0.9},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        double error;
        snprintf(text, sizeof text, "{" SIGHT "," WORLD "," BALL_OF ", \"materials\": [{\"name\": \"m\", %s}]}",
                 cases[i].material);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "n-rooks", "path", 256, 24);
        options.depth = 64;
        const double mean = mean_of(scene, &options, &error);
        assert_mean(mean, error, cases[i].reflected);
        assert_true(error < 1e-3);
        koksma_scene_close(scene);
    }
}

/* ---- Form factors ----------------------------------------------------------------------------------------- */

#define PATCH                                                                                                        \
    "\"camera\": {\"eye\": [0, 1, 4], \"target\": [0, 0, 0], \"fov_deg\": 0.01},"                                    \
    "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.9}],"                                    \
    "\"shapes\": [{\"kind\": \"plane\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0], \"material\": \"m\"}]"

/* What a patch of albedo 0.9 reflects under one luminaire. */
static void lights_are_their_form_factors(void **state)
{
    (void)state;
    static const struct {
        const char *light;
        double reflected;
    } cases[] = {
        /* a sphere of radius r overhead at h: (r/h)^2; aslant: times the cosine */
        {"\"kind\": \"sphere\", \"centre\": [0, 3, 0], \"radius\": 1, \"radiance\": 2", 0.9 * 2 / 9},
        {"\"kind\": \"sphere\", \"centre\": [3, 4, 0], \"radius\": 0.5, \"radiance\": 2", 0.9 * 2 * 0.01 * 0.8},
        /* a disk of radius r, parallel, at h: r^2 / (r^2 + h^2) */
        {"\"kind\": \"disk\", \"centre\": [0, 2, 0], \"normal\": [0, -1, 0], \"radius\": 1.5, \"radiance\": 2",
         0.9 * 2 * 2.25 / 6.25},
        {"\"kind\": \"disk\", \"centre\": [0, 2, 0], \"normal\": [0, 1, 0], \"radius\": 1.5, \"radiance\": 2", 0},
        {"\"kind\": \"point\", \"centre\": [3, 4, 0], \"intensity\": 5", 0.9 / M_PI * 5 / 25 * 0.8},
        {"\"kind\": \"directional\", \"direction\": [3, -4, 0], \"irradiance\": 5", 0.9 / M_PI * 5 * 0.8},
        {"\"kind\": \"directional\", \"direction\": [3, 4, 0], \"irradiance\": 5", 0},
        {"\"kind\": \"environment\", \"radiance\": 2", 0.9 * 2},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(text, sizeof text, "{" PATCH ", \"lights\": [{%s}]}", cases[i].light);
        koksma_scene *scene = scene_of(text);
        static const char *const integrators[] = {"distribution", "path"};
        for (size_t k = 0; k < 2; k++) {
            double error;
            koksma_render_options options = options_of(scene, "n-rooks", integrators[k], 64, 16);
            const double mean = mean_of(scene, &options, &error);
            assert_mean(mean, error, cases[i].reflected);
        }
        koksma_scene_close(scene);
    }
}

/* A luminaire that is seen gives the same light, sampled, met by chance, or both, on a diffuse and on a glossy floor.
 */
static void seen_lights_give_the_same(void **state)
{
    (void)state;
    static const char *const materials[] = {
        "\"kind\": \"lambert\", \"albedo\": 0.9", "\"kind\": \"phong\", \"reflectance\": 0.9, \"exponent\": 8",
        "\"kind\": \"utah\", \"albedo\": 0.5, \"reflectance\": 0.4, \"exponent\": 30",
        "\"kind\": \"ggx\", \"reflectance\": 0.9, \"roughness\": 0.4"};
    static const char *const lights[] = {
        "\"kind\": \"sphere\", \"centre\": [0, 2, -3], \"radius\": 0.8, \"radiance\": 3",
        "\"kind\": \"disk\", \"centre\": [0, 2, -3], \"facing\": [0, 0, 0], \"radius\": 0.9, \"radiance\": 3",
        "\"kind\": \"rectangle\", \"centre\": [0, 2, -3], \"facing\": [0, 0, 0], \"half\": [1, 0.6], \"radiance\": "
        "3"};
    for (size_t i = 0; i < 12; i++) {
        double means[2], errors[2];
        for (int seen = 0; seen < 2; seen++) {
            char text[1024];
            snprintf(
                text, sizeof text,
                "{\"camera\": {\"eye\": [0, 3, 4], \"target\": [0, 0, 0], \"fov_deg\": 3},"
                "\"materials\": [{\"name\": \"m\", %s}], \"shapes\": [{\"kind\": \"plane\", \"centre\": [0, 0, 0],"
                "\"normal\": [0, 1, 0], \"material\": \"m\"}], \"lights\": [{%s, \"visible\": %s}]}",
                materials[i / 3], lights[i % 3], seen ? "true" : "false");
            koksma_scene *scene = scene_of(text);
            koksma_render_options options = options_of(scene, "n-rooks", "path", 256, 24);
            options.depth = 1;
            means[seen] = mean_of(scene, &options, &errors[seen]);
            koksma_scene_close(scene);
        }
        assert_true(means[0] > 0.01);
        assert_mean(means[1], hypot(errors[0], errors[1]), means[0]);
    }
}

/* In a closed room of albedo a and area A, a lamp of power P is absorbed by the walls: (1 - a) A times their mean
   irradiance is P, so that the mean radiance is a / (1 - a) P / (pi A). From the middle of a cube each wall fills a
   square picture evenly. Paths of every length count. */
static void paths_of_every_length_count(void **state)
{
    (void)state;
    static const char *const sides[] = {"1, 0, 0", "-1, 0, 0", "0, 1, 0", "0, -1, 0", "0, 0, 1", "0, 0, -1"};
    double sum = 0, squares = 0;
    for (size_t i = 0; i < 6; i++) {
        char text[1024];
        double error;
        snprintf(
            text, sizeof text,
            "{\"camera\": {\"eye\": [0, 0, 0], \"target\": [%s], \"up\": [%s], \"fov_deg\": 90},"
            "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.5}], \"shapes\": ["
            "{\"kind\": \"box\", \"centre\": [0, 0, 0], \"half\": [1, 1, 1], \"material\": \"m\"}], \"lights\": ["
            "{\"kind\": \"rectangle\", \"centre\": [0, 0.5, 0], \"normal\": [0, -1, 0], \"half\": [0.2, 0.2],"
            "\"radiance\": 10}]}",
            sides[i], i / 2 == 1 ? "1, 0, 0" : "0, 1, 0");
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "random", "path", 64, 16);
        options.depth = 64;
        options.seed = i;
        sum += mean_of(scene, &options, &error);
        squares += error * error;
        koksma_scene_close(scene);
    }
    assert_mean(sum / 6, sqrt(squares) / 6, 10 * 0.16 / 24);
}

/* ---- Choosing luminaires ------------------------------------------------------------------------------- */

static void one_light_stands_for_all(void **state)
{
    (void)state;
    koksma_scene *scene = scene_of(
        "{\"camera\": {\"eye\": [0, 3, 4], \"target\": [0, 0, 0], \"fov_deg\": 10},"
        "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.9}],"
        "\"shapes\": [{\"kind\": \"plane\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0], \"material\": \"m\"},"
        "{\"kind\": \"sphere\", \"centre\": [0.5, 0.7, 0], \"radius\": 0.3, \"material\": \"m\"}],"
        "\"lights\": [{\"kind\": \"sphere\", \"centre\": [-2, 2, 0], \"radius\": 0.2, \"radiance\": 30, \"visible\": "
        "true},"
        "{\"kind\": \"rectangle\", \"centre\": [2, 1.5, 0], \"facing\": [0, 0, 0], \"half\": [0.5, 0.5], "
        "\"radiance\": 4},"
        "{\"kind\": \"disk\", \"centre\": [0, 4, -2], \"facing\": [0, 0, 0], \"radius\": 0.5, \"radiance\": 8},"
        "{\"kind\": \"point\", \"centre\": [1, 3, 2], \"intensity\": 2},"
        "{\"kind\": \"directional\", \"direction\": [0, -1, -1], \"irradiance\": 0.5},"
        "{\"kind\": \"environment\", \"radiance\": 0.1}]}");
    static const char *const integrators[] = {"distribution", "path"};
    for (size_t k = 0; k < 2; k++) {
        double error, all_error;
        koksma_render_options options = options_of(scene, "n-rooks", integrators[k], 64, 32);
        const double all = mean_of(scene, &options, &all_error);
        for (int l = KOKSMA_LIGHTS_ONE; koksma_light_selection_name((koksma_light_selection)l); l++) {
            options.lights = (koksma_light_selection)l;
            options.seed = (uint64_t)l;
            const double one = mean_of(scene, &options, &error);
            assert_mean(one, hypot(error, all_error), all);
        }
    }
    koksma_scene_close(scene);
}

/* ---- Lens and shutter ----------------------------------------------------------------------------------- */

/* A lamp that is small and out of focus is a disk of radius lens (d - f) / d on the plane of focus, evenly lit. */
static void lens_blurs_to_a_disk(void **state)
{
    (void)state;
    static const char *const maps[] = {"concentric", "polar"};
    for (size_t m = 0; m < 2; m++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "{\"camera\": {\"eye\": [0, 0, 0], \"target\": [0, 0, -1], \"fov_deg\": 53.13010235415598,"
            "\"lens_radius\": 0.5, \"focus_distance\": 2, \"lens_map\": \"%s\"}, \"materials\": [], \"shapes\": [],"
            "\"lights\": [{\"kind\": \"disk\", \"centre\": [0, 0, -4], \"normal\": [0, 0, 1], \"radius\": 0.05,"
            "\"radiance\": 100, \"visible\": true}]}",
            maps[m]);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "n-rooks", "distribution", 4096, 32);
        koksma_image image;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        /* The film shows the plane of focus from -1 to 1: a disk of radius 0.25 is 4 pixels of 16. The lamp covers
           there, seen from a place of the lens, a disk of radius 0.025: it adds that much to the edge. */
        double inside = 0, total = 0;
        for (int y = 0; y < 32; y++) {
            for (int x = 0; x < 32; x++) {
                const double r = hypot(x + 0.5 - 16, y + 0.5 - 16), value = (double)image.pixels[y * 32 + x];
                total += value;
                if (r > 4 + 0.4 + 0.75) {
                    assert_true(value == 0);
                } else if (r < 4 - 0.4 - 0.75) {
                    inside += value;
                    assert_near(value, 100 * 0.01, 0.45); /* the lamp's disk over the blur's: (0.025 / 0.25)^2 */
                }
            }
        }
        /* All of its light, as through a pinhole: the lamp is 0.05 x 8 pixels in radius. */
        assert_near(total / (100 * M_PI * pow(0.05 * 8, 2)), 1, 0.05);
        assert_true(inside > 0.2 * total);
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
}

/* A ball of radius 1/2 that moves by 4 covers a place in its path for 1/4 of the time, on the axis. */
static void shutter_sees_the_time(void **state)
{
    (void)state;
    koksma_scene *scene = scene_of(
        "{\"camera\": {\"eye\": [0, 0, 50], \"target\": [0, 0, 0], \"fov_deg\": 0.01, \"shutter\": [0, 1]},"
        "\"ambient\": 1, \"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 1}], \"shapes\": ["
        "{\"kind\": \"sphere\", \"centre\": [-2, 0, 0], \"radius\": 0.5, \"motion\": [4, 0, 0], \"material\": "
        "\"m\"}]}");
    koksma_render_options options = options_of(scene, "jittered", "distribution", 1024, 1);
    assert_near(mean_of(scene, &options, NULL), 0.25, 2.5 / 1024);
    scene->camera.shutter[1] = 0.5; /* it covers the place from 3/8 to 5/8 */
    assert_near(mean_of(scene, &options, NULL), 0.25, 2.5 / 1024);
    scene->camera.shutter[0] = 0.4;
    assert_near(mean_of(scene, &options, NULL), 1, 1e-6);
    koksma_scene_close(scene);
    /* Its shadow moves with it: the floor below is dark for a quarter of the time. */
    scene = scene_of(
        "{\"camera\": {\"eye\": [0, 1, 50], \"target\": [0, -1, 0], \"fov_deg\": 0.01},"
        "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 1}], \"shapes\": ["
        "{\"kind\": \"plane\", \"centre\": [0, -1, 0], \"normal\": [0, 1, 0], \"material\": \"m\"},"
        "{\"kind\": \"sphere\", \"centre\": [-2, 2, 0], \"radius\": 0.5, \"motion\": [4, 0, 0], \"material\": "
        "\"m\"}],"
        "\"lights\": [{\"kind\": \"directional\", \"direction\": [0, -1, 0], \"irradiance\": 3.141592653589793}]}");
    assert_near(mean_of(scene, &options, NULL), 0.75, 2.5 / 1024);
    koksma_scene_close(scene);
}

/* ---- Patterns, pairings, scopes, filters -------------------------------------------------------------------- */

static void every_way_of_sampling_has_the_same_mean(void **state)
{
    (void)state;
    koksma_scene *scene;
    assert_ok(koksma_scene_open("all", &scene));
    scene->clamp = INFINITY;
    double base_error, error;
    koksma_render_options options = options_of(scene, "random", "distribution", 256, 24);
    const double base = mean_of(scene, &options, NULL);
    koksma_image image;
    base_error = 0;
    for (int pairing = 0; pairing < 3; pairing++) {
        for (int scope = 0; scope < 2; scope++) {
            /* pixels differ by what they show, so that the spread over seeds is the measure of the error */
            double sum = 0, squares = 0;
            for (uint64_t seed = 1; seed <= 8; seed++) {
                options = options_of(scene, "sobol:scramble=owen", "distribution", 16, 24);
                options.pairing = (koksma_pairing)pairing;
                options.scope = (koksma_scope)scope;
                options.seed = seed;
                assert_ok(koksma_render(scene, &options, NULL, &image));
                double mean = 0;
                for (size_t i = 0; i < 24 * 24; i++) {
                    mean += (double)image.pixels[i] / (24 * 24);
                }
                koksma_image_fini(&image);
                sum += mean;
                squares += mean * mean;
            }
            error = sqrt(fmax(squares / 8 - sum * sum / 64, 0) / 7);
            base_error = 0.0015; /* of 147,456 random samples of standard deviation about 0.3, twice */
            if (fabs(sum / 8 - base) > 4 * error + base_error) {
                fail_msg("pairing %d, scope %d: %.6f +- %.1g, expected %.6f", pairing, scope, sum / 8, error, base);
            }
        }
    }
    koksma_scene_close(scene);
}

/* A constant picture stays constant: splatted exactly, drawn from the filter in the mean. */
static void filters_keep_a_constant(void **state)
{
    (void)state;
    koksma_scene *scene = scene_of("{\"camera\": {\"eye\": [0, 0, 0], \"target\": [0, 0, -1], \"fov_deg\": 40},"
                                   "\"background\": 0.75, \"materials\": [], \"shapes\": []}");
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        koksma_render_options options = options_of(scene, "n-rooks", "distribution", 64, 16);
        double error;
        options.filter = f;
        assert_near(mean_of(scene, &options, &error), 0.75, 0.01);
        options.splat = true;
        koksma_image image;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        for (size_t p = 0; p < 256; p++) {
            assert_near((double)image.pixels[p], 0.75, 1e-5);
        }
        koksma_image_fini(&image);
    }
    koksma_scene_close(scene);
}

/* Filters against their own properties: even, and where they promise it a partition of unity. */
static void filters_are_what_they_say(void **state)
{
    (void)state;
    static const char *const unity[] = {"box", "tent", "hermite", "mitchell", "b-spline"};
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        for (double x = 0; x < f->radius; x += 0.01) {
            assert_true(f->value(x) == f->value(-x));
        }
        assert_true(f->value(f->radius + 1e-9) == 0);
    }
    for (size_t i = 0; i < 5; i++) {
        f = koksma_filter_find(unity[i]);
        for (double x = 0.005; x < 1; x += 0.01) {
            double sum = 0;
            for (int k = -3; k <= 3; k++) {
                sum += f->value(x - 0.5 + k);
            }
            assert_near(sum, 1, 1e-12);
        }
    }
}

/* A half-plane's edge across a pixel: the filtered value is the integral of the filter up to the edge. */
static void filters_weigh_an_edge(void **state)
{
    (void)state;
    koksma_scene *scene =
        scene_of("{\"camera\": {\"eye\": [0, 0, 1], \"target\": [0, 0, 0], \"fov_deg\": 90}, \"ambient\": 1,"
                 "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 1}], \"shapes\": ["
                 "{\"kind\": \"rectangle\", \"centre\": [-4.95, 0, 0], \"normal\": [0, 0, 1], \"half\": [5, 10], "
                 "\"material\": \"m\"}]}");
    const koksma_filter *f;
    for (size_t i = 0; (f = koksma_filter_at(i)); i++) {
        /* 9 pixels over [-1, 1]: the edge at x = 0.05 is 0.225 pixels right of the middle pixel's centre */
        double part = 0, whole = 0;
        for (double x = -2 + 5e-5; x < 2; x += 1e-4) {
            part += x < 0.225 ? f->value(x) : 0;
            whole += f->value(x);
        }
        koksma_render_options options = options_of(scene, "jittered", "distribution", 16384, 9);
        options.filter = f;
        koksma_image image;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        assert_near((double)image.pixels[4 * 9 + 4], part / whole, 2e-3);
        koksma_image_fini(&image);
        options.splat = true;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        assert_near((double)image.pixels[4 * 9 + 4], part / whole, 2e-3);
        koksma_image_fini(&image);
    }
    koksma_scene_close(scene);
}

/* ---- Layers --------------------------------------------------------------------------------------------- */

static void layers_show_what_is_seen(void **state)
{
    (void)state;
    koksma_scene *scene = scene_of(
        "{\"camera\": {\"eye\": [0, 0, 3], \"target\": [0, 0, 0], \"fov_deg\": 0.01}, \"ambient\": 0.5,"
        "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": [0.2, 0.4, 0.8]}], \"shapes\": ["
        "{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1, \"material\": \"m\"}]}");
    koksma_render_options options = options_of(scene, "random", "distribution", 9, 1);
    koksma_layers layers;
    assert_ok(koksma_render_layers(scene, &options, NULL, &layers));
    static const double albedo[3] = {0.2, 0.4, 0.8};
    assert_int_equal(layers.image.channels, 3);
    for (int k = 0; k < 3; k++) {
        assert_near((double)layers.albedo.pixels[k], albedo[k], 1e-6);
        assert_near((double)layers.image.pixels[k], 0.5 * albedo[k], 1e-6);
        assert_near((double)layers.normal.pixels[k], k == 2, 1e-4);
    }
    assert_near((double)layers.depth.pixels[0], 2, 1e-5);
    assert_near((double)layers.samples.pixels[0], 9, 0);
    assert_near((double)layers.variance.pixels[0], 0, 1e-12);
    assert_int_equal(layers.rays, 9);
    koksma_layers_fini(&layers);
    koksma_scene_close(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pipelines_agree),
        cmocka_unit_test(furnace_shows_the_albedo),
        cmocka_unit_test(lights_are_their_form_factors),
        cmocka_unit_test(seen_lights_give_the_same),
        cmocka_unit_test(paths_of_every_length_count),
        cmocka_unit_test(one_light_stands_for_all),
        cmocka_unit_test(lens_blurs_to_a_disk),
        cmocka_unit_test(shutter_sees_the_time),
        cmocka_unit_test(every_way_of_sampling_has_the_same_mean),
        cmocka_unit_test(filters_keep_a_constant),
        cmocka_unit_test(filters_are_what_they_say),
        cmocka_unit_test(filters_weigh_an_edge),
        cmocka_unit_test(layers_show_what_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
