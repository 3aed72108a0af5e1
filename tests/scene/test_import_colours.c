/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Numbers that are read of scenes of pbrt, Mitsuba and glTF, by the cases of colours.txt: eta and k of metals, coefficients
 * of media, factors of daylight, textures within textures, how images are mapped, what a camera sees. Each form of one
 * value (numbers, pairs, samples at equal or listed wavelengths, textures, the names of Mitsuba 2) gives the same, and what
 * is beyond floats something finite.
 */
#include "render/materials/materials.h"
#include "scene/import.h"
#include "scene_files.h"
#include "texts.h"

static const shared_text shared[] = {
    {"{P}", "Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 WorldBegin "},
    {"{M}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>"},
    {"{B}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"sphere\">"},
    {"{/B}", "</shape></scene>"},
    {"{F}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"><medium type=\"homogeneous\">"},
    {"{/F}", "</medium></sensor><shape type=\"sphere\"/></scene>"},
    {"{S}", "Film \"rgb\" \"integer xresolution\" 40 \"integer yresolution\" 30 WorldBegin LightSource \"point\" "},
    {"{I}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><include filename="},
    {"{T}", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"rectangle\"><bsdf type=\"diffuse\">"
            "<texture name=\"reflectance\" type="},
    {"{/T}", "</texture></bsdf></shape></scene>"},
    {"{E}",
     "<scene version=\"3.0.0\"><emitter type=\"constant\"/><shape type=\"rectangle\"><transform name=\"to_world\">"
     "<translate z=\"1\"/></transform><emitter type=\"area\"><rgb name=\"radiance\" value=\"7\"/></emitter></shape>"
     "<shape type=\"rectangle\"><transform name=\"to_world\"><translate z=\"-1\"/></transform><emitter "
     "type=\"area\"><rgb name=\"radiance\" value=\"3\"/></emitter></shape><sensor type=\"perspective\"><float "
     "name=\"fov\" value=\"2\"/><transform name=\"to_world\"><lookat origin=\"0 0 5\" target=\"0 0 0\" "
     "up=\"0 1 0\"/></transform>"},
    {"{H}",
     "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"0.01\"/><transform "
     "name=\"to_world\"><lookat origin=\"0 0 5\" target=\"0 0 0\" up=\"0 1 0\"/></transform></sensor><shape "
     "type=\"rectangle\"><transform name=\"to_world\"><translate z=\"-3\"/></transform><emitter type=\"area\"><rgb "
     "name=\"radiance\" value=\"3\"/></emitter></shape>"},
    {"{/H}",
     "<bsdf type=\"null\"/><medium name=\"interior\" type=\"homogeneous\"><float name=\"sigma_t\" value=\"0.5\"/>"
     "<float name=\"albedo\" value=\"0\"/></medium></shape></scene>"},
    {"{2}",
     "LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 1 Film \"rgb\" \"integer xresolution\" 8 "
     "\"integer yresolution\" 8 WorldBegin AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] "},
    {"{/2}",
     " Shape \"trianglemesh\" \"point3 P\" [-1 -1 0  -1 1 0  1 1 0  1 -1 0] \"integer indices\" [0 1 2 0 2 3]"},
    {"{C}", "<rgb name=\"color0\" value=\"1 0 .5\"/><rgb name=\"color1\" value=\".5 1 .5\"/>"},
    {NULL, NULL}};

static void check_rgb(const char *text, const double *rgb, const double *expected, double tolerance)
{
    for (int k = 0; k < 3; k++) {
        assert_that(rgb[k] == expected[k] || fabs(rgb[k] - expected[k]) <= tolerance,
                    "%s: %g %g %g, expected %g %g %g", text, rgb[0], rgb[1], rgb[2], expected[0], expected[1],
                    expected[2]);
    }
}

static void fresnel(const double *eta, const double *k, double *rgb)
{
    for (int i = 0; i < 3; i++) {
        rgb[i] = ((eta[i] - 1) * (eta[i] - 1) + k[i] * k[i]) / ((eta[i] + 1) * (eta[i] + 1) + k[i] * k[i]);
    }
}

/* The reflectance along the normal of the last material, a metal of any kind. */
static void reflectance_of(const koksma_scene *scene, double rgb[3])
{
    koksma__material *m = &scene->materials[scene->n_materials - 1];
    const char *name = m->bsdf->kind.name;
    if (strcmp(name, "conductor") != 0 && strcmp(name, "rough-conductor") != 0) {
        memcpy(rgb, koksma__material_value(m, "reflectance"), 3 * sizeof *rgb);
        return;
    }
    fresnel(koksma__material_value(m, "eta"), koksma__material_value(m, "k"), rgb);
    for (int i = 0; i < 3; i++) {
        rgb[i] *= koksma__material_value(m, "tint")[i];
    }
}

/* The mean of a small picture, and how long its paths are: as the options say, or else as the integrator or the scene. */
static void look(const koksma_scene *scene, bool far, double rgb[3])
{
    koksma_render_options options = options_of(scene, "random", "path", 4, 2);
    if (far) {
        rgb[0] = rgb[1] = rgb[2] = koksma_render_depth(scene, &options);
        options.depth = 3;
        assert_int_equal(koksma_render_depth(scene, &options), 3);
        options.depth = -1;
        options.integrator = koksma_integrator_find("whitted");
        assert_int_equal(koksma_render_depth(scene, &options), options.integrator->depth);
    } else {
        rgb[0] = rgb[1] = rgb[2] = mean_of(scene, &options, NULL);
    }
}

/* Finds a quantity of the scene by its name in colours.txt. */
static void find_quantity(const koksma_scene *scene, const char *name, double rgb[3])
{
    const koksma__material *m = scene->n_materials ? &scene->materials[scene->n_materials - 1] : NULL;
    if (!strcmp(name, "reflectance")) {
        reflectance_of(scene, rgb);
        return;
    }
    if (!strcmp(name, "period") || !strcmp(name, "phase") || !strcmp(name, "fov")) {
        assert_true(strcmp(name, "period") != 0 || m->checker);
        rgb[0] = rgb[1] = rgb[2] = *name == 'f'     ? scene->camera.fov_rad
                                   : name[1] == 'h' ? scene->medium.phase.values[0]
                                                    : m->period;
        return;
    }
    if (!strcmp(name, "seen") || !strcmp(name, "depth")) {
        look(scene, *name == 'd', rgb);
        return;
    }
    if (!strcmp(name, "counts")) {
        const double counts[3] = {scene->width, (double)scene->n_shapes, (double)scene->n_lights};
        memcpy(rgb, counts, sizeof counts);
        return;
    }
    if (!strcmp(name, "map-u") || !strcmp(name, "map-v")) {
        assert_true(m->mapping.moved && (m->image || m->checker));
        for (int k = 0; k < 3; k++) {
            rgb[k] = (double)m->mapping.matrix[k + (name[4] == 'v' ? 3 : 0)];
        }
        return;
    }
    const double *found = !strcmp(name, "albedo")       ? m->albedo[0]
                          : !strcmp(name, "other")      ? m->albedo[1]
                          : !strcmp(name, "radiance")   ? scene->lights[0].radiance
                          : !strcmp(name, "normal")     ? scene->lights[0].normal
                          : !strcmp(name, "absorption") ? scene->medium.absorption
                          : !strcmp(name, "scattering") ? scene->medium.scattering
                          : !strcmp(name, "low")        ? scene->medium.low
                          : !strcmp(name, "high")       ? scene->medium.high
                                                        : NULL;
    assert_non_null(found);
    assert_true(strcmp(name, "other") != 0 || (m->checker && !m->image));
    memcpy(rgb, found, 3 * sizeof *rgb);
}

static koksma_scene *opened_text(const char *text)
{
    return opened(*text == '<' ? "a.xml" : *text == '{' ? "a.gltf" : "a.pbrt", text);
}

static void check_case(const char *expected, const char *text)
{
    char first[4096], warning[256] = "";
    const char *said = strstr(expected, "; "), *second = strstr(text, " == ");
    double rgb[3], value[3], tolerance;
    snprintf(first, sizeof first, "%.*s", second ? (int)(second - text) : (int)strlen(text), text);
    if ((strstr(expected, "seen") && !koksma_mesh_tracer()) || !can_read(*text == '<'   ? "a.xml"
                                                                         : *text == '{' ? "a.gltf"
                                                                                        : "a.pbrt")) {
        return;
    }
    koksma_scene *scene = opened_text(first);
    koksma_scene_unknown(scene, 0, warning, sizeof warning);
    assert_that(said ? strstr(warning, said + 2) != NULL : !*warning, "%s: '%s', expected '%s'", text, warning,
                said ? said + 2 : "");
    if (second) {
        koksma_scene *other = opened_text(second + 4);
        reflectance_of(scene, rgb);
        reflectance_of(other, value);
        check_rgb(text, rgb, value, 1e-12);
        koksma_scene_close(other);
    }
    assert_true(strstr(expected, "seen") || scene->medium.is_there == (strstr(expected, "absorption") != NULL));
    for (const char *at = expected; at && !second && strcmp(at, "none") != 0 && (!said || at < said);
         at = strstr(at, ", ")) {
        char name[16];
        at += at == expected ? 0 : 2;
        assert_int_equal(sscanf(at, "%15s %lf %lf %lf +- %lf", name, &value[0], &value[1], &value[2], &tolerance), 5);
        find_quantity(scene, name, rgb);
        check_rgb(text, rgb, value, tolerance);
    }
    koksma_scene_close(scene);
}

static void write_pixels(const char *name, const float *pixels, int height, int channels)
{
    char path[128];
    koksma_image image;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    assert_ok(koksma_image_init(&image, 2, height, channels));
    memcpy(image.pixels, pixels, (size_t)(2 * height * channels) * sizeof *pixels);
    assert_ok(koksma_image_write(path, &image, NULL));
    koksma_image_fini(&image);
}

TEST_CASE(colours_are_those_of_the_table)
{
    write_pixels("grey.pfm", (const float[]){.2f, .6f}, 1, 1);
    write_pixels("two.pfm", (const float[]){1, .5f, .25f, 0, .25f, 0, 9, .5f, .25f, 0, .25f, 0}, 2, 3);
    write_file("empty.xml", "<scene/>");
    write_file("two.xml", "<scene><shape type=\"sphere\"/><emitter type=\"point\"/></scene>");
    write_file("ball.xml", "<shape version=\"3.0.0\" type=\"sphere\"><float name=\"radius\" value=\"2\"/></shape>");
    write_file("bsdf.xml", "<bsdf version=\"3.0.0\" type=\"diffuse\" id=\"b\"/>");
    assert_true(each_text("scene/colours.txt", shared, check_case) > 130);
}
