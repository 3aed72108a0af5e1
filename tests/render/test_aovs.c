/* SPDX-License-Identifier: Apache-2.0 */
/* The further images of a render: their sums, closed forms, objects and halves. */
#include <koksma/adaptive.h>

#include "rendering.h"

/* A coloured scene with everything that adds light: seen and unseen lights, sky, ambient light, mirror, glass, gloss. */
#define EVERYTHING(more)                                                                                             \
    "{'camera': {'eye': [0, 1.5, 5], 'target': [0, 0.7, 0], 'fov_deg': 45}, 'background': [0.2, 0.3, 0.4], "         \
    "'ambient': 0.1, " more                                                                                          \
    "'materials': [{'name': 'floor', 'kind': 'checker', 'albedos': [0.2, 0.7], 'period': 1},{'name': 'red', "        \
    "'kind': 'lambert', 'albedo': [0.8, 0.2, 0.1]},{'name': 'mirror', 'kind': 'mirror', 'reflectance': "             \
    "0.8},{'name': 'glass', 'kind': 'dielectric', 'ior': 1.5},{'name': 'gloss', 'kind': 'phong', 'reflectance': "    \
    "0.5, 'exponent': 20}], 'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': [0, 1, 0], 'material': "     \
    "'floor'},{'kind': 'sphere', 'centre': [-1.4, 0.7, 0], 'radius': 0.6, 'material': 'red'},{'kind': 'sphere', "    \
    "'centre': [0, 0.7, 0], 'radius': 0.6, 'material': 'mirror'},{'kind': 'sphere', 'centre': [1.4, 0.7, 0], "       \
    "'radius': 0.6, 'material': 'glass'},{'kind': 'sphere', 'centre': [0, 0.4, 1.5], 'radius': 0.3, 'material': "    \
    "'gloss'}], 'lights': [{'kind': 'sphere', 'centre': [-1, 3, 1], 'radius': 0.3, 'radiance': 9, 'visible': "       \
    "true},{'kind': 'point', 'centre': [2, 2, 3], 'intensity': [3, 4, 2]}]}"

static koksma_layers render_aovs(const koksma_scene *scene, const koksma_render_options *options, const char *names,
                                 koksma_aovs *aovs)
{
    koksma_layers layers;
    assert_ok(koksma_aovs_parse(names, aovs));
    assert_ok(koksma_render_aovs(scene, options, NULL, aovs, &layers));
    return layers;
}

/* The images first .. end - 1 of the list add up to the picture in every pixel and channel. */
static void assert_sum(const koksma_layers *layers, const koksma_aovs *aovs, int first, int end, const char *what)
{
    const size_t n = (size_t)layers->image.width * (size_t)layers->image.height * (size_t)layers->image.channels;
    for (size_t i = 0; i < n; i++) {
        double sum = 0, size = 0;
        const double whole = (double)layers->image.pixels[i];
        for (int a = first; a < end; a++) {
            sum += (double)aovs->images[a].pixels[i];
            size += fabs((double)aovs->images[a].pixels[i]);
        }
        if (!(fabs(sum - whole) <= 2e-6 * (size + fabs(whole)))) {
            fail_msg("%s: pixel %zu: parts %.9g, picture %.9g", what, i, sum, whole);
        }
    }
}

/* Both divisions of the light add up, by every integrator and filter, with and without the clamp, and the picture is
   that of a render without them but for rounding. */
TEST_CASE(parts_add_up)
{
    static const char *const texts[] = {EVERYTHING(""), EVERYTHING("'clamp': 0.5, ")};
    static const char names[] = "direct,indirect,bounce:0,bounce:1,bounce:2,bounce:3,bounce:4,bounce:5,bounce:6";
    for (size_t t = 0; t < 2; t++) {
        koksma_scene *scene = scene_of(texts[t]);
        for (size_t i = 0; koksma_integrator_at(i); i++) {
            for (int filter = 0; filter < 2; filter++) {
                koksma_render_options options = options_of(scene, "n-rooks", koksma_integrator_at(i)->name, 8, 24);
                koksma_aovs aovs;
                koksma_image plain;
                options.depth = 4;
                options.filter = koksma_filter_find(filter ? "mitchell" : "box");
                koksma_layers layers = render_aovs(scene, &options, names, &aovs);
                assert_sum(&layers, &aovs, 0, 2, koksma_integrator_at(i)->name);
                assert_sum(&layers, &aovs, 2, 9, koksma_integrator_at(i)->name);
                assert_ok(koksma_render(scene, &options, NULL, &plain));
                for (size_t k = 0; k < 24 * 24 * (size_t)plain.channels; k++) {
                    assert_near((double)layers.image.pixels[k], (double)plain.pixels[k],
                                1e-5 * (1 + fabs((double)plain.pixels[k])));
                }
                koksma_image_fini(&plain);
                koksma_layers_fini(&layers);
                koksma_aovs_fini(&aovs);
            }
        }
        koksma_scene_close(scene);
    }
}

/* In a diffuse sphere of radius 1 and albedo a with a point light of intensity I in its centre every place gets the
   irradiance I, and light that was reflected r times has the radiance a^r I / pi everywhere. */
TEST_CASE(bounces_follow_the_integrating_sphere)
{
    koksma_scene *scene = scene_of(
        "{'camera': {'eye': [0.3, 0.1, 0.2], 'target': [0, 0, -1], 'fov_deg': 90}, 'materials': [{'name': 'm', "
        "'kind': 'lambert', 'albedo': 0.6}], 'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1, "
        "'material': 'm'}], 'lights': [{'kind': 'point', 'centre': [0, 0, 0], 'intensity': 2}]}");
    koksma_render_options options = options_of(scene, "random", "path-light", 4, 8);
    koksma_aovs aovs;
    options.depth = 3;
    koksma_layers layers =
        render_aovs(scene, &options, "bounce:0,bounce:1,bounce:2,bounce:3,bounce:4,bounce:5,direct,indirect", &aovs);
    for (int r = 0; r <= 5; r++) { /* at depth 3 there are 4 vertices */
        for (size_t i = 0; i < 64; i++) {
            const double expected = r == 0 || r == 5 ? 0 : pow(0.6, r) * 2 / M_PI;
            assert_near((double)aovs.images[r].pixels[i], expected, 1e-5);
        }
    }
    assert_near((double)aovs.images[6].pixels[0], 0.6 * 2 / M_PI, 1e-5);
    assert_near((double)aovs.images[7].pixels[0], (0.36 + 0.216 + 0.1296) * 2 / M_PI, 1e-5);
    koksma_layers_fini(&layers);
    koksma_aovs_fini(&aovs);
    koksma_scene_close(scene);
}

/* Objects are those of koksma_scene_part_at: each pixel's is one whose part of the image covers it, and 0 is the sky.
   Half of a pixel's samples and the other half make the picture. */
TEST_CASE(objects_and_halves)
{
    koksma_scene *scene = scene_of(EVERYTHING(""));
    bool seen[16] = {false};
    for (int spp = 1; spp <= 5; spp += 2) {
        koksma_render_options options = options_of(scene, "n-rooks", "path", spp, 32);
        koksma_aovs aovs;
        options.pairing = KOKSMA_PAIRING_SHUFFLED;
        koksma_layers layers = render_aovs(scene, &options, "id,half", &aovs);
        assert_int_equal(aovs.n, 3);
        assert_string_equal(aovs.names[1], "half:even");
        assert_string_equal(aovs.names[2], "half:odd");
        const int odd = spp / 2, even = spp - odd;
        for (size_t i = 0; i < 32 * 32; i++) {
            const float id = aovs.images[0].pixels[i];
            koksma_scene_part part;
            const double x = (double)(i % 32), y = (double)(i / 32);
            assert_true(id >= 0 && id == floorf(id) && id < 16);
            seen[(size_t)id] = true;
            if (id > 0) {
                assert_true(koksma_scene_part_at(scene, (size_t)id - 1, &part));
                /* the box is that of the scene's own 4 : 3, so only its rows are compared */
                assert_true(part.in_frame && (y + 1) / 32 >= part.frame[2] && y / 32 <= part.frame[3]);
                assert_true(x >= 0);
            } else if (spp == 1) {
                assert_true(layers.depth.pixels[i] == 0);
            }
            for (size_t k = 0; k < 3; k++) {
                const double whole = (double)layers.image.pixels[3 * i + k];
                const double sum =
                    even * (double)aovs.images[1].pixels[3 * i + k] + odd * (double)aovs.images[2].pixels[3 * i + k];
                assert_near(sum / spp, whole, 1e-5 * (1 + whole));
            }
        }
        koksma_layers_fini(&layers);
        koksma_aovs_fini(&aovs);
    }
    for (int id = 0; id <= 5; id++) {
        assert_true(seen[id]);
    }
    koksma_scene_close(scene);
}

/* Renders with method i of adaptive sampling, which stops by a budget, by the strata's threshold, or by both. */
static koksma_layers render_adaptive(const koksma_scene *scene, const koksma_render_options *options, size_t i,
                                     const char *names, koksma_aovs *aovs)
{
    koksma_adaptive_options adaptive;
    koksma_layers layers;
    char text[64];
    snprintf(text, sizeof text, "%s", koksma_adaptive_at(i)->name);
    assert_ok(koksma_adaptive_parse(text, &adaptive));
    assert_ok(koksma_aovs_parse(names, aovs));
    adaptive.budget = 60;
    adaptive.aovs = aovs;
    assert_ok(koksma_render_adaptive(scene, options, &adaptive, NULL, &layers, NULL));
    return layers;
}

/* The halves of samples that all count equally make the picture: of n samples, (n + 1) / 2 are even. */
static void assert_halves(const koksma_layers *layers, const koksma_image *even, const koksma_image *odd)
{
    const size_t channels = (size_t)layers->image.channels;
    for (size_t i = 0; i < channels * (size_t)layers->image.width * (size_t)layers->image.height; i++) {
        const long n = lroundf(layers->samples.pixels[i / channels]), left = n / 2;
        const double sum = (double)(n - left) * (double)even->pixels[i] + (double)left * (double)odd->pixels[i];
        assert_near(sum / (double)n, (double)layers->image.pixels[i], 1e-5 * (1 + (double)layers->image.pixels[i]));
    }
}

/* With every method and both kinds of filters the parts add up to the picture, though samples weigh differently, and halves of samples make it. Two sets of 9 samples: even ones are odd ones of the next set. */
TEST_CASE(adaptive_parts_add_up)
{
    static const char names[] = "direct,half,indirect,id,bounce:0,bounce:1,bounce:2,bounce:3,bounce:4,bounce:5";
    koksma_scene *scene = scene_of(EVERYTHING(""));
    for (size_t i = 0; koksma_adaptive_at(i); i++) {
        for (int filter = 0; filter < 2; filter++) {
            koksma_render_options options = options_of(scene, "n-rooks", "path", 9, 20);
            koksma_aovs aovs;
            options.depth = 4;
            options.filter = koksma_filter_find(filter ? "mitchell" : "box");
            koksma_layers layers = render_adaptive(scene, &options, i, names, &aovs);
            float lo = layers.samples.pixels[0], hi = lo;
            for (size_t k = 0; k < 20 * 20; k++) {
                lo = fminf(lo, layers.samples.pixels[k]);
                hi = fmaxf(hi, layers.samples.pixels[k]);
                assert_true(aovs.images[4].pixels[k] >= 0 && aovs.images[4].pixels[k] <= 6);
            }
            assert_true(hi > lo); /* it was adaptive */
            koksma_aovs two = {.n = 2, .images = {aovs.images[0], aovs.images[3]}};
            assert_sum(&layers, &two, 0, 2, koksma_adaptive_at(i)->name);
            assert_sum(&layers, &aovs, 5, 11, koksma_adaptive_at(i)->name);
            if (!filter && !koksma_adaptive_at(i)->own_samples) {
                assert_halves(&layers, &aovs.images[1], &aovs.images[2]);
            }
            koksma_layers_fini(&layers);
            koksma_aovs_fini(&aovs);
        }
    }
    koksma_scene_close(scene);
}
