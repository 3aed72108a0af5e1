/* SPDX-License-Identifier: Apache-2.0 */
/* The boxes of parts and their regions of the image: every pixel that a part covers in a render is in its region, whatever
   moves and through whatever lens, and the region is no larger than the box needs. */
#include <unistd.h>

#include "meshes.h"
#include "rendering.h"

enum { WIDTH = 60, HEIGHT = 40 };

/* One part, alone before black, that is as bright everywhere. */
#define CAMERA(more)                                                                                                 \
    "{\"image\": {\"width\": 60, \"height\": 40}, \"camera\": {\"eye\": [0, 1, 5], \"target\": [0, 1, 0]" more
#define WITH                                                                                                         \
    "}, \"ambient\": 1, \"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 1}], \"shapes\": ["
#define FOV ", \"fov_deg\": 40"
#define ONE(camera, shape) CAMERA(camera) WITH "{\"kind\": " shape ", \"material\": \"m\"}]}"
#define BALL "\"sphere\", \"centre\": [0, 1, 0], \"radius\": 1"
#define SQUARE "\"rectangle\", \"centre\": [0, 1, 0], \"normal\": [0, 0, 1], \"half\": [1, 0.1]"
#define CUBE "\"mesh\", \"file\": \"cube.obj\", \"translate\": [0, 1, 0], \"scale\": 0.5"

/* The first and last column and row in which the scene's picture isn't black, as parts of the image. */
static void lit_region(const koksma_scene *scene, double out[4])
{
    koksma_image image;
    koksma_render_options options = options_of(scene, "random", "distribution", test_repeats(400, 50), 1);
    options.width = WIDTH;
    options.height = HEIGHT;
    out[0] = out[2] = 1;
    out[1] = out[3] = 0;
    assert_ok(koksma_render(scene, &options, NULL, &image));
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        if (image.pixels[i * image.channels] > 0) {
            out[0] = fmin(out[0], (double)(i % WIDTH) / WIDTH);
            out[1] = fmax(out[1], (double)(i % WIDTH + 1) / WIDTH);
            out[2] = fmin(out[2], (double)(i / WIDTH) / HEIGHT);
            out[3] = fmax(out[3], (double)(i / WIDTH + 1) / HEIGHT);
        }
    }
    koksma_image_fini(&image);
}

/* The part is seen, and only in its region; on no side is the region wider than the picture by more than `spare` parts of
   the image. */
static void assert_region(const char *text, double spare)
{
    koksma_scene *scene = scene_of(text);
    koksma_scene_part part;
    double lit[4];
    const double pixel[2] = {1.0 / WIDTH, 1.0 / HEIGHT};
    assert_true(koksma_scene_part_at(scene, 0, &part));
    lit_region(scene, lit);
    if (!part.in_frame || !(lit[0] < lit[1])) {
        fail_msg("%s: %s in frame, %s", text, part.in_frame ? "" : "not", lit[0] < lit[1] ? "seen" : "not seen");
    }
    for (int k = 0; k < 4; k++) {
        const double beyond = k % 2 ? lit[k] - part.frame[k] : part.frame[k] - lit[k];
        if (beyond > pixel[k / 2] || beyond < -spare) {
            fail_msg("%s: side %d: seen to %g, in frame to %g", text, k, lit[k], part.frame[k]);
        }
    }
    koksma_scene_close(scene);
}

/* spare: a ball leaves the corners of its box empty. */
TEST_CASE(pictures_are_in_their_regions)
{
    static const struct {
        const char *text;
        double spare;
    } cases[] = {
        {ONE(FOV, BALL), 0.07},
        {ONE(FOV ", \"motion\": [0, 0, -3]", BALL), 0},
        {ONE(FOV ", \"motion\": [1, -0.5, 0]", BALL), 0.08},
        {ONE(FOV ", \"motion\": [0, 0, -9]", BALL), 0},
        {ONE(FOV, BALL ", \"motion\": [1, 0, 0]"), 0.09},
        {ONE(FOV, BALL ", \"to\": {\"centre\": [0, 1, 2], \"scale\": 1.5}"), 0},
        {ONE(FOV ", \"lens_radius\": 0.5, \"focus_distance\": 2", BALL), 0.2},
        {ONE(FOV ", \"lens_radius\": 0.5, \"focus_distance\": 20, \"lens_blades\": 3", BALL), 0.2},
        {ONE(FOV ", \"lens_radius\": 0.2, \"focus_distance\": 2, \"motion\": [0.5, 0, 0]",
             BALL ", \"motion\": [-0.3, 0, 1]"),
         0.2},
        {ONE(FOV, SQUARE), 0.01},
        {ONE(FOV ", \"lens_radius\": 0.5, \"focus_distance\": 10", SQUARE), 0.03},
        {ONE(FOV, SQUARE ", \"to\": {\"rotate_deg\": [0, 0, 90]}"), 0.03},
        {ONE(FOV, SQUARE ", \"to\": {\"rotate_deg\": [0, 0, 180], \"scale\": 0.5}"), 0.03},
        {ONE(FOV, SQUARE ", \"to\": {\"rotate_deg\": [20, 70, -200], \"centre\": [-1, 1.5, 1], \"scale\": 1.2}"),
         0.25},
        {ONE(FOV ", \"shutter\": [0.5, 0.5]", SQUARE ", \"to\": {\"rotate_deg\": [0, 0, 90]}"), 0.03},
        {ONE(FOV ", \"shutter\": [0, 0.1]", SQUARE ", \"to\": {\"rotate_deg\": [0, 0, 90]}"), 0.03},
        {ONE(FOV ", \"shutter\": [0.5, 1]", BALL ", \"motion\": [2, 0, 0]"), 0.12},
        {ONE(FOV ", \"motion\": [3, 0, 0]", SQUARE ", \"motion\": [3, 0, 0]"), 0.04},
        {ONE(FOV, "\"disk\", \"centre\": [0, 1, 0], \"normal\": [0, 0, 1], \"radius\": 1, \"to\": {\"rotate_deg\": "
                  "[0, 90, 90]}"),
         0.13},
        {ONE(FOV, "\"plane\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0], \"to\": {\"rotate_deg\": [0, 0, 60]}"),
         1},
        {ONE(FOV, "\"plane\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0], \"to\": {\"rotate_deg\": [0, 60, 0]}"),
         1},
        {ONE(", \"orthographic_height\": 4", BALL), 0.01},
        {ONE(", \"orthographic_height\": 4, \"motion\": [1, 0, 0]", BALL ", \"to\": {\"scale\": 0.5}"), 0.05},
        {ONE(", \"orthographic_height\": 4, \"lens_radius\": 0.3, \"focus_distance\": 2", BALL), 0.1},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        assert_region(cases[i].text, cases[i].spare);
    }
}

TEST_CASE(meshes_are_in_their_regions)
{
    need_meshes();
    write_text("cube.obj", "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
                           "f 1 2 3 4\nf 5 6 7 8\nf 1 2 6 5\nf 4 3 7 8\nf 1 4 8 5\nf 2 3 7 6\n");
    assert_region(ONE(FOV, CUBE), 0.01);
    assert_region(ONE(FOV, CUBE ", \"motion\": [1, 0, 0]"), 0.01);
    assert_region(ONE(FOV ", \"shutter\": [0.5, 0.75]", CUBE ", \"motion\": [1, 0, 0]"), 0.01);
    assert_region(ONE(FOV, CUBE ", \"to\": {\"translate\": [1, 1, 0], \"scale\": 0.25}"), 0.01);
    assert_region(ONE(FOV, CUBE ", \"to\": {\"rotate_deg\": [0, 0, 90]}"), 0.05);
    assert_region(
        ONE(FOV, CUBE ", \"to\": {\"rotate_deg\": [30, -80, 170], \"translate\": [0.5, 0, 1], \"scale\": 0.2}"), 0.1);
    assert_region(ONE(FOV ", \"shutter\": [0.4, 0.6]", CUBE ", \"to\": {\"translate\": [1, 1, 0]}"), 0.01);
    assert_region(ONE(FOV ", \"motion\": [1, 0, 0], \"lens_radius\": 0.1, \"focus_distance\": 3",
                      CUBE ", \"to\": {\"translate\": [1, 1, 0], \"rotate_deg\": [0, 0, 45]}"),
                  0.1);
    unlink("cube.obj");
}

/* Boxes have closed forms: a needle that turns by a right angle reaches its length along both axes; while the shutter is
   open for a moment only, the box is that of this moment. */
TEST_CASE(boxes_are_of_all_times)
{
    const struct {
        const char *text;
        double low[2], high[2];
    } cases[] = {
        {ONE(FOV, BALL ", \"motion\": [1, 2, -3]"), {-1, 0}, {2, 4}},
        {ONE(FOV, BALL ", \"to\": {\"centre\": [4, 1, 0], \"scale\": 2}"), {-1, -1}, {6, 3}},
        {ONE(FOV, SQUARE ", \"to\": {\"rotate_deg\": [0, 0, 90]}"), {-1.00499, 1 - 1.00499}, {1.00499, 2.00499}},
        {ONE(FOV ", \"shutter\": [0.5, 0.5]", SQUARE ", \"to\": {\"rotate_deg\": [0, 0, 180]}"), {-0.1, 0}, {0.1, 2}},
        {ONE(FOV ", \"shutter\": [0.25, 0.25]", BALL ", \"motion\": [4, 0, 0]"), {0, 0}, {2, 2}},
        {ONE(FOV ", \"shutter\": [1, 1]", BALL ", \"motion\": [4, 0, 0]"), {3, 0}, {5, 2}},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_scene *scene = scene_of(cases[i].text);
        koksma_scene_part part;
        assert_true(koksma_scene_part_at(scene, 0, &part));
        for (int k = 0; k < 2; k++) {
            const double bulge = strstr(cases[i].text, "rotate") ? 0.003 : 1e-12;
            assert_near(part.low[k], cases[i].low[k], bulge);
            assert_near(part.high[k], cases[i].high[k], bulge);
        }
        koksma_scene_close(scene);
    }
}

/* Parts beside or behind the camera are not seen, unless it moves or its lens is wide. */
TEST_CASE(unseen_parts_are_said_to_be)
{
    const char *const shapes[] = {"\"sphere\", \"centre\": [9, 1, 0], \"radius\": 1",
                                  "\"sphere\", \"centre\": [0, 1, 9], \"radius\": 1"};
    for (int i = 0; i < 2; i++) {
        char text[1024];
        koksma_scene_part part;
        for (int moved = 0; moved < 2; moved++) {
            snprintf(text, sizeof text, CAMERA(FOV "%s") WITH "{\"kind\": %s, \"material\": \"m\"}]}",
                     !moved ? ""
                     : i    ? ", \"motion\": [0, 0, 9]"
                            : ", \"lens_radius\": 5, \"focus_distance\": 1",
                     shapes[i]);
            koksma_scene *scene = scene_of(text);
            assert_true(koksma_scene_part_at(scene, 0, &part));
            assert_int_equal(part.in_frame, moved);
            koksma_scene_close(scene);
        }
    }
}
