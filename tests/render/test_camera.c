/* SPDX-License-Identifier: Apache-2.0 */
/* Lens, shutter and layers, against closed forms. */
#include "render/one_image.h"
#include "rendering.h"

/* ---- Lens and shutter ----------------------------------------------------------------------------------- */

enum { LENS_SAMPLES = test_repeats(4096, 1024) };

/* A light that is small and out of focus shows the lens, a disk or a polygon whose corner 0 is at the angle from the right,
   of radius lens (d - f) / d on the plane of focus: evenly lit, its light over the lens's area. */
TEST_CASE(lenses_blur_to_their_shapes)
{
    static const struct {
        const char *lens;
        int blades, angle_deg;
    } cases[] = {{"'lens_map': 'concentric'", 0, 0},
                 {"'lens_map': 'polar'", 0, 0},
                 {"'lens_blades': 3, 'lens_angle_deg': 0", 3, 0},
                 {"'lens_blades': 6, 'lens_angle_deg': 75", 6, 75},
                 {"'lens_blades': 4, 'lens_angle_deg': 25", 4, 25},
                 {"'lens_blades': 5, 'lens_angle_deg': 50", 5, 50}};
    for (size_t c = 0; c < test_repeats(6, 4); c++) {
        const int blades = cases[c].blades;
        const double angle = cases[c].angle_deg * M_PI / 180,
                     area = 0.25 * 0.25 * (blades ? blades / 2.0 * sin(2 * M_PI / blades) : M_PI);
        char text[1024];
        snprintf(
            text, sizeof text,
            "{'camera': {'eye': [0, 0, 0], 'target': [0, 0, -1], 'fov_deg': 53.13010235415598, 'lens_radius': 0.5, "
            "'focus_distance': 2, %s}, 'materials': [], 'shapes': [], 'lights': [{'kind': 'disk', 'centre': [0, 0, "
            "-4], 'normal': [0, 0, 1], 'radius': 0.05, 'radiance': 100, 'visible': true}]}",
            cases[c].lens);
        koksma_scene *scene = scene_of(text);
        koksma_render_options options = options_of(scene, "n-rooks", "distribution", LENS_SAMPLES, 32);
        koksma_image image;
        assert_ok(koksma_render(scene, &options, NULL, &image));
        /* The film shows the plane of focus from -1 to 1: a disk of radius 0.25 is 4 pixels of 16. The light covers
           there, seen from a place of the lens, a disk of radius 0.025: it adds that much to the edge. */
        double inside = 0, total = 0;
        for (int i = 0; i < 32 * 32; i++) {
            const double at[2] = {(i % 32 + 0.5 - 16) / 16, (16 - i / 32 - 0.5) / 16},
                         value = (double)image.pixels[i];
            double beyond = blades ? -1 : hypot(at[0], at[1]) - 0.25;
            for (int k = 0; k < blades; k++) {
                const double normal = angle + (2 * k + 1) * M_PI / blades;
                beyond = fmax(beyond, at[0] * cos(normal) + at[1] * sin(normal) - 0.25 * cos(M_PI / blades));
            }
            total += value;
            if (beyond > 0.025 + 0.75 / 16) {
                assert_true(value == 0);
            } else if (beyond < -0.025 - 0.75 / 16) {
                /* The light's disk over the blur's, by one sample in 100 at least: 5 deviations. */
                assert_near(value / (100 * M_PI * 0.025 * 0.025 / area), 1, 5 / sqrt(LENS_SAMPLES / 100.0));
                inside += value;
            }
        }
        /* All of its light, as through a pinhole: the light is 0.05 x 8 pixels in radius. 24 seeds of 4096
           samples have a deviation of 0.02, that of 2059 hits. */
        assert_near(total / (100 * M_PI * pow(0.05 * 8, 2)), 1, 5 * 0.022 * sqrt(4096.0 / LENS_SAMPLES));
        assert_true(inside > (blades ? 0 : 0.2 * total));
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
}

/* The map from the square to a lens with blades has a constant Jacobian, the polygon's area, by both maps to the disk;
   points lie inside all edges and reach the corners. With four blades and the concentric map it is a similarity. */
TEST_CASE(blades_keep_ratios_of_areas)
{
    for (int blades = 3; blades <= 9; blades++) {
        for (int polar = 0; polar < 2; polar++) {
            const double angle = 0.3 * blades, area = blades / 2.0 * sin(2 * M_PI / blades), h = 1.0 / 512;
            const koksma__camera camera = {.lens_map = koksma_warp_find(polar ? "polar-disk" : "concentric-disk"),
                                           .blades = blades,
                                           .blade_angle_rad = angle};
            double most = 0, off = 0;
            for (uint64_t i = 0; i < 400; i++) {
                double at[2];
                koksma__random_pair(1, 0, i, 0, at);
                at[0] = 0.01 + 0.97 * at[0], at[1] = 0.01 + 0.97 * at[1];
                /* four corners of a small square, filled up to whole lanes */
                float pairs[2 * KOKSMA__LANE_STEP] = {0}, x[KOKSMA__LANE_STEP], y[KOKSMA__LANE_STEP];
                for (int c = 0; c < 4; c++) {
                    pairs[2 * c] = (float)(at[0] + h * (c == 1 || c == 2));
                    pairs[2 * c + 1] = (float)(at[1] + h * (c >= 2));
                }
                koksma__lens_points(&camera, koksma__batch(), pairs, KOKSMA__LANE_STEP, x, y);
                double twice = 0, sides[2];
                for (int c = 0; c < 4; c++) {
                    const int d = (c + 1) % 4;
                    twice += (double)x[c] * (double)y[d] - (double)x[d] * (double)y[c];
                    for (int k = 0; k < blades;
                         k++) { /* the distance beyond the edge k, whose normal is between corners */
                        const double normal = angle + (2 * k + 1) * M_PI / blades;
                        const double beyond =
                            (double)x[c] * cos(normal) - (double)y[c] * sin(normal) - cos(M_PI / blades);
                        assert_true(beyond <= 1e-6);
                    }
                    most = fmax(most, hypot((double)x[c], (double)y[c]));
                }
                /* exact but where the small square straddles a crease of the map */
                off += fabs(fabs(twice / 2) / (h * h) / area - 1) > 0.02;
                sides[0] = hypot((double)x[1] - (double)x[0], (double)y[1] - (double)y[0]);
                sides[1] = hypot((double)x[3] - (double)x[0], (double)y[3] - (double)y[0]);
                if (blades == 4 && !polar) {
                    assert_near(sides[0] / h, sqrt(2), 1e-3);
                    assert_near(sides[1] / h, sqrt(2), 1e-3);
                }
            }
            assert_true(off < 400 * 0.06);
            assert_true(most > 0.9);
        }
    }
}

/* Parallel rays: a black ball of radius 1/2 before a white sky covers pi / 4 of the 4 x 4 that the image shows, wherever it
   is, by every integrator (to ambient occlusion it is white and sees the whole sky). */
TEST_CASE(orthographic_images_have_their_scale)
{
    for (int far = 1; far <= 100; far *= 10) {
        for (size_t i = 0; koksma_integrator_at(i); i++) {
            char text[512];
            snprintf(text, sizeof text,
                     "{'camera': {'eye': [0, 0, 0], 'target': [0, 0, -1], 'orthographic_height': 4}, 'background': "
                     "1, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0}], 'shapes': [{'kind': 'sphere', "
                     "'centre': [0.3, 0.2, %d], 'radius': 0.5, 'material': 'm'}]}",
                     -far);
            koksma_scene *scene = scene_of(text);
            const char *name = koksma_integrator_at(i)->name;
            const bool white = !strcmp(name, "ambient-occlusion");
            koksma_render_options options = options_of(scene, "jittered", name, 16, 64);
            assert_near(mean_of(scene, &options, NULL), white ? 1 : 1 - M_PI / 4 / 16, 3e-4);
            koksma_scene_close(scene);
        }
    }
}

/* A ball of radius 1/2 that moves by 4 covers a place in its path for 1/4 of the time, on the axis. */
TEST_CASE(shutter_sees_the_time)
{
    koksma_scene *scene =
        scene_of("{'camera': {'eye': [0, 0, 50], 'target': [0, 0, 0], 'fov_deg': 0.01, 'shutter': [0, 1]},'ambient': "
                 "1, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 1}], 'shapes': [{'kind': 'sphere', "
                 "'centre': [-2, 0, 0], 'radius': 0.5, 'motion': [4, 0, 0], 'material': 'm'}]}");
    koksma_render_options options = options_of(scene, "jittered", "distribution", 1024, 1);
    assert_near(mean_of(scene, &options, NULL), 0.25, 2.5 / 1024);
    scene->camera.shutter[1] = 0.5; /* it covers the place from 3/8 to 5/8 */
    assert_near(mean_of(scene, &options, NULL), 0.25, 2.5 / 1024);
    scene->camera.shutter[0] = 0.4;
    assert_near(mean_of(scene, &options, NULL), 1, 1e-6);
    koksma_scene_close(scene);
    /* Its shadow moves with it: the floor below is dark for a quarter of the time. */
    scene = scene_of(
        "{'camera': {'eye': [0, 1, 50], 'target': [0, -1, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', 'kind': "
        "'lambert', 'albedo': 1}], 'shapes': [{'kind': 'plane', 'centre': [0, -1, 0], 'normal': [0, 1, 0], "
        "'material': 'm'},{'kind': 'sphere', 'centre': [-2, 2, 0], 'radius': 0.5, 'motion': [4, 0, 0], 'material': "
        "'m'}],'lights': [{'kind': 'directional', 'direction': [0, -1, 0], 'irradiance': 3.141592653589793}]}");
    assert_near(mean_of(scene, &options, NULL), 0.75, 2.5 / 1024);
    koksma_scene_close(scene);
}

/* A million samples in a pixel, of a value that floats can't sum: 2^20 x 0.7 would be 1 % too much. */
TEST_CASE(many_splats_are_summed)
{
    koksma_scene *scene = scene_of(SKY_ALONE("0.7"));
    koksma_render_options options = options_of(scene, "regular", "distribution", 1 << 20, 1);
    options.splat = true;
    assert_near(mean_of(scene, &options, NULL), 0.7, 1e-6);
    koksma_scene_close(scene);
}

/* ---- Layers --------------------------------------------------------------------------------------------- */

TEST_CASE(layers_show_what_is_seen)
{
    koksma_scene *scene =
        scene_of("{'camera': {'eye': [0, 0, 3], 'target': [0, 0, 0], 'fov_deg': 0.01}, 'ambient': 0.5,'materials': "
                 "[{'name': 'm', 'kind': 'lambert', 'albedo': [0.2, 0.4, 0.8]}], 'shapes': [{'kind': 'sphere', "
                 "'centre': [0, 0, 0], 'radius': 1, 'material': 'm'}]}");
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
