/* SPDX-License-Identifier: Apache-2.0 */
/* Scene files: the shipped ones open; a bad one gives one line with file, line, field and reason. */
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "scene/scene.h"
#include "test.h"

#define CAMERA "\"camera\": {\"eye\": [0, 1, 5], \"target\": [0, 0, 0], \"fov_deg\": 40},\n"
#define MATERIALS "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.5}],\n"
#define SPHERE "{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1, \"material\": \"m\"}"
#define SCENE(shapes, lights) "{\n" CAMERA MATERIALS "\"shapes\": [" shapes "],\n\"lights\": [" lights "]}"
#define LIGHT(rest) "{\"kind\": \"rectangle\", \"centre\": [0, 3, 0], " rest "}"

static const struct {
    const char *text, *error; /* after "scene 'test.json': " */
} malformed[] = {
    {"", "line 1: '[' or '{' expected near end of file"},
    {"{\n\"camera\": \n", "line 3: unexpected token near end of file"},
    {"[]", "line 1: it takes an object"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [],\n\"fog\": 1}", "line 5: fog: unknown field"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [],\n\"a.b[0]\": 1}", "line 5: a.b[0]: unknown field"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [],\n\"f\\u006fg\": 1}", "line 5: fog: unknown field"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [],\n\"lights\": [\n{\"kind\": \"environment\", \"radiance\": 1, \"image\": "
     "\"a.pfm\"}]}",
     "line 6: lights[0]: it takes one of 'radiance' and 'image'"},
    {"{\n" CAMERA MATERIALS
     "\"shapes\": [], \"lights\": [{\"kind\": \"environment\", \"radiance\": 1, \"scale\": 2}]}",
     "line 4: lights[0]: 'scale' and 'angle_deg' need 'image'"},
    {"{\n" CAMERA MATERIALS
     "\"shapes\": [], \"lights\": [{\"kind\": \"environment\", \"radiance\": 1, \"angle_deg\": 0}]}",
     "line 4: lights[0]: 'scale' and 'angle_deg' need 'image'"},
    {"{\n" MATERIALS "\"shapes\": []}", "line 1: field 'camera' is missing"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [], \"ambient\": NaN}", "line 4: invalid token near 'NaN'"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [], \"ambient\": 1e999}", "line 4: real number overflow near '1e999'"},
    {"{\n" CAMERA MATERIALS "\"shapes\": [], \"ambient\": -1}", "line 4: ambient: -1 is not in 0 to 1000000"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [0, 1, 0], \"fov_deg\": 40}}", "line 1: camera: 'eye' and"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [0, 9, 0], \"fov_deg\": 40}}", "line 1: camera: 'up' is along"},
    {"{\"camera\": {\"eye\": [0, 1], \"target\": [0, 9, 0], \"fov_deg\": 40}}", "line 1: camera.eye: it takes 3"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [9, 1, 0], \"fov_deg\": 40, \"orthographic_height\": 4}}",
     "line 1: camera: it takes one of 'fov_deg' and 'orthographic_height'"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [9, 1, 0], \"orthographic_height\": 0}}",
     "line 1: camera.orthographic_height: 0 is not in"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [9, 1, 0], \"fov_deg\": 40, \"lens_blades\": 5}}",
     "line 1: camera: lens_blades needs a 'lens_radius'"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [9, 1, 0], \"fov_deg\": 40, \"lens_radius\": 1, "
     "\"focus_distance\": 1, \"lens_blades\": 2}}",
     "line 1: camera.lens_blades: 2 is not in 3 to 64"},
    {"{\"camera\": {\"eye\": [0, 1, 0], \"target\": [9, 1, 0], \"fov_deg\": 40, \"lens_angle_deg\": 5}}",
     "line 1: camera: lens_angle_deg turns the corners of the lens, whose number 'lens_blades' gives"},
    {"{" CAMERA "\"materials\": [{\"name\": \"m\", \"kind\": \"gold\"}]}",
     "line 2: materials[0]: no kind 'gold'; known here: lambert"},
    {"{" CAMERA "\"materials\": [{\"name\": \"m\", \"kind\": \"lamber\"}]}",
     "line 2: materials[0]: no kind 'lamber'; did you mean 'lambert'? known here: lambert"},
    {"{" CAMERA "\"materials\": [{\"name\": \"clay\", \"kind\": \"lambert\", \"albedo\": 0.5}], "
     "\"shapes\": [{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1, \"material\": \"cley\"}]}",
     "line 2: shapes[0]: no material 'cley'; did you mean 'clay'?"},
    {"{" CAMERA "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 2}]}",
     "line 2: materials[0].albedo: 2 is not in 0 to 1"},
    {SCENE("{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 0, \"material\": \"m\"}", ""),
     "line 4: shapes[0]: zero radius"},
    {SCENE(SPHERE ",\n{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1, \"material\": \"n\"}", ""),
     "line 5: shapes[1]: no material 'n'"},
    {SCENE("{\"kind\": \"disk\", \"centre\": [0, 0, 0], \"radius\": 1, \"normal\": [0, 0, 0], \"material\": \"m\"}",
           ""),
     "line 4: shapes[0]: 'normal' is a direction of length 0"},
    {SCENE("{\"kind\": \"sphere\", \"centre\": [0, 0, 0], \"radius\": 1, \"half\": 2, \"material\": \"m\"}", ""),
     "line 4: shapes[0].half: unknown field"},
    {SCENE(SPHERE, LIGHT("\"normal\": [0, -1, 0], \"half\": [1, 0], \"radiance\": 1")),
     "line 5: lights[0]: zero area"},
    {SCENE(SPHERE, LIGHT("\"normal\": [0, -1, 0], \"half\": [1, 1]")),
     "line 5: lights[0]: it takes one of 'radiance'"},
    {SCENE(SPHERE, LIGHT("\"normal\": [0, -1, 0], \"half\": [1, 1], \"strength\": 1")),
     "line 5: lights[0]: 'strength' needs 'facing'"},
    {SCENE(SPHERE, LIGHT("\"facing\": [0, 3, 0], \"half\": [1, 1], \"strength\": 1")),
     "line 5: lights[0]: it faces its own centre"},
    {SCENE(SPHERE, "7"), "line 5: lights[0]: it takes an object"},
};

TEST_CASE(errors_name_line_and_reason)
{
    for (size_t i = 0; i < sizeof malformed / sizeof *malformed; i++) {
        char expected[256];
        koksma_scene scene = {0};
        const koksma_status status =
            koksma__scene_parse("test.json", malformed[i].text, strlen(malformed[i].text), &scene);
        snprintf(expected, sizeof expected, "scene 'test.json': %s", malformed[i].error);
        assert_that(status == KOKSMA_MALFORMED && strncmp(koksma_error_text(), expected, strlen(expected)) == 0,
                    "expected: %s...\ngot (%d): %s", expected, (int)status, koksma_error_text());
        koksma__scene_fini(&scene);
    }
}

TEST_CASE(shipped_scenes_open)
{
    koksma_scene *scene;
    size_t n = 0;
    uint64_t hashes = 0;
    for (; koksma_scene_name_at(n); n++) {
        const koksma_status status = koksma_scene_open(koksma_scene_name_at(n), &scene);
        if (status && !strcmp(koksma_scene_name_at(n), "bunny")) { /* its files come with other packages, if at all */
            assert_true(status == KOKSMA_MISSING || status == KOKSMA_MALFORMED || status == KOKSMA_UNSUPPORTED);
            assert_non_null(strstr(koksma_error_text(), "bunny"));
            continue;
        }
        assert_ok(status);
        assert_true(*koksma_scene_title(scene));
        assert_true(koksma_scene_hash(scene) != hashes);
        hashes = koksma_scene_hash(scene);
        koksma_scene_close(scene);
    }
    assert_true(n >= 10);
    assert_ok(koksma_scene_open("ball", &scene));
    assert_int_equal(scene->n_lights, 2);
    assert_int_equal(scene->width, 128);
    /* strength 1.15 at distance 7.25, as the table of the fit has it */
    assert_near(scene->lights[0].power, 1.15 * 7.25 * 7.25, 1e-2);
    koksma_scene_close(scene);
    koksma_scene_close(NULL);
    assert_int_equal(koksma_scene_open("bal", &scene), KOKSMA_UNKNOWN);
    assert_int_equal(koksma_scene_open("./bal.json", &scene), KOKSMA_MISSING);
    assert_int_equal(koksma_scene_open(KOKSMA_TESTS "/", &scene), KOKSMA_MISSING);
}

/* Truncated and changed texts never crash the reader. */
TEST_CASE(reader_survives)
{
    static const char text[] = SCENE(SPHERE, LIGHT("\"facing\": [0, 0, 0], \"half\": [1, 1], \"strength\": 1"));
    for (size_t i = 0; i < sizeof text - 1; i++) {
        char copy[sizeof text];
        for (int change = 0; change < 4; change++) {
            koksma_scene scene = {0};
            memcpy(copy, text, sizeof text);
            copy[i] = "0\"}-"[change];
            (void)koksma__scene_parse("copy", copy, change ? sizeof text - 1 : i, &scene);
            koksma__scene_fini(&scene);
        }
    }
}
