/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Scenes of pbrt-v4 and Mitsuba 3. One scene in the three formats, written by each format's own documentation, shows one
 * picture: depths and normals of every pixel agree, and the mean light within its errors. Every kind of material, shape
 * and light of tables here loads, and what is likened says so with its line. Malformed and hostile texts are refused by
 * one line with the place.
 * Long because both formats share the scenes. texts.txt has most texts of a line.
 */
#include <sys/stat.h>

#include "core/c_locale.h"
#include "scene/import.h"
#include "scene_files.h"
#include "texts.h"

/* ---- One scene three times ------------------------------------------------------------------------------------- */

#define SIZE "\"integer xresolution\" 40 \"integer yresolution\" 30"

/* A grey ball on a floor under a square light that faces down, beside a sky; seen a little from above. */
static const char *const as_json =
    "{\"image\": {\"width\": 40, \"height\": 30}, \"camera\": {\"eye\": [1, 2, 6], \"target\": [0, 1, 0], "
    "\"fov_deg\": 40},"
    "\"materials\": [{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": 0.5}, {\"name\": \"b\", \"kind\": \"ggx\","
    " \"reflectance\": 0.8, \"roughness\": 0.5}],"
    "\"shapes\": [{\"kind\": \"sphere\", \"centre\": [0.5, 1, 0], \"radius\": 1, \"material\": \"b\"}, {\"kind\": "
    "\"rectangle\", \"centre\": [0, 0, 0], \"normal\": [0, 1, 0], \"half\": [3, 3], \"material\": \"m\"}],"
    "\"lights\": [{\"kind\": \"rectangle\", \"centre\": [-2, 3, 0], \"normal\": [0, -1, 0], \"half\": [0.5, 1], "
    "\"radiance\": [4, 3, 2], \"visible\": true}, {\"kind\": \"environment\", \"radiance\": 0.3}]}";

/* pbrt's space has the other hand: the same picture needs x turned round, as its exporters do. The angle is that of the
   shorter side; a reflectance of 0.8 along the normal has k = 4 where eta = 1. */
static const char *const as_pbrt =
    "Scale -1 1 1 LookAt 1 2 6  0 1 0  0 1 0\n"
    "Camera \"perspective\" \"float fov\" 40\nFilm \"rgb\" " SIZE "\n"
    "WorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [0.3 0.3 0.3]\n"
    "AttributeBegin\nMaterial \"conductor\" \"rgb eta\" [1 1 1] \"rgb k\" [4 4 4] \"float roughness\" 0.0625\n"
    "Translate 0.5 1 0 Shape \"sphere\" \"float radius\" 1\nAttributeEnd\n"
    "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5]\n"
    "Shape \"bilinearmesh\" \"point3 P\" [-3 0 3  3 0 3  -3 0 -3  3 0 -3]\n"
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [2 1.5 1] \"float scale\" 2\n"
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-2.5 3 1  -2.5 3 -1  -1.5 3 -1  -1.5 3 "
    "1]\n"
    "AttributeEnd\n";

static const char *const as_mitsuba =
    "<scene version=\"3.0.0\"><default name=\"side\" value=\"3\"/>"
    "<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/><string name=\"fov_axis\" value=\"y\"/>"
    "<transform name=\"to_world\"><lookat origin=\"1, 2, 6\" target=\"0, 1, 0\" up=\"0, 1, 0\"/></transform>"
    "<film type=\"hdrfilm\"><integer name=\"width\" value=\"40\"/><integer name=\"height\" "
    "value=\"30\"/></film></sensor>"
    "<bsdf type=\"diffuse\" id=\"m\"><rgb name=\"reflectance\" value=\"0.5\"/></bsdf>"
    "<shape type=\"sphere\"><point name=\"center\" x=\"0.5\" y=\"1\" z=\"0\"/><bsdf type=\"roughconductor\"><string "
    "name=\"distribution\" value=\"ggx\"/><float name=\"alpha\" value=\"0.25\"/><rgb name=\"eta\" value=\"1, 1, "
    "1\"/><rgb name=\"k\" value=\"4, 4, "
    "4\"/></bsdf></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"$side\"/><rotate x=\"1\" angle=\"-90\"/>"
    "</transform><ref id=\"m\"/></shape>"
    "<shape type=\"rectangle\"><transform name=\"to_world\"><rotate x=\"1\" angle=\"90\"/><scale x=\"0.5\" z=\"1\"/>"
    "<translate x=\"-2\" y=\"3\"/></transform><emitter type=\"area\"><rgb name=\"radiance\" value=\"4, 3, "
    "2\"/></emitter>"
    "</shape><emitter type=\"constant\"><rgb name=\"radiance\" value=\"0.3\"/></emitter></scene>";

static koksma_layers first_hits(const koksma_scene *scene)
{
    koksma_layers layers;
    koksma_render_options options = options_of(scene, "regular", "utah", 1, 32);
    options.width = scene->width;
    options.height = scene->height;
    assert_ok(koksma_render_layers(scene, &options, NULL, &layers));
    return layers;
}

TEST_CASE(one_scene_is_one_picture)
{
    static const char *const names[] = {"one.json", "one.pbrt", "one.xml"};
    const char *const texts[] = {as_json, as_pbrt, as_mitsuba};
    koksma_layers expected = {0};
    double mean = 0, error = 0;
    for (size_t i = 0; i < 3; i++) {
        if (i == 2 ? !can_read("probe.xml") : i && !koksma_mesh_tracer()) {
            continue;
        }
        koksma_scene *scene = opened(names[i], texts[i]);
        assert_int_equal(scene->n_unknown, 0);
        assert_int_equal(scene->width, 40);
        assert_int_equal(scene->height, 30);
        koksma_layers layers = first_hits(scene);
        koksma_render_options options = options_of(scene, "random", "path", 256, 40);
        options.height = 30;
        options.depth = 4;
        double own_error;
        const double own = mean_of(scene, &options, NULL);
        options.width = 40;
        for (size_t k = 0; i && k < 40 * 30; k++) {
            assert_near((double)layers.depth.pixels[k], (double)expected.depth.pixels[k], 2e-4);
            for (size_t c = 0; c < 3; c++) {
                assert_near((double)layers.normal.pixels[3 * k + c], (double)expected.normal.pixels[3 * k + c], 2e-4);
            }
        }
        /* pixels differ more from each other than samples do: the error is that of a second picture's difference */
        options.seed = 1;
        own_error = fabs(mean_of(scene, &options, NULL) - own) + 1e-3;
        if (i) {
            assert_near(own, mean, 4 * (error + own_error));
            koksma_layers_fini(&layers);
        } else {
            expected = layers;
            mean = own;
            error = own_error;
        }
        koksma_scene_close(scene);
    }
    koksma_layers_fini(&expected);
}

/* A square of side 1 at (1.5, 0), 5 before a camera that shows 4 x 3: it covers pixels 30 to 39 of 40 and 10 to 19
   of 30, rows downwards, at any distance. Both formats scale the camera by its matrix. */
TEST_CASE(orthographic_cameras_show_their_height)
{
    static const struct {
        const char *name, *text;
    } scenes[] = {
        {"o.json",
         "{\"image\": {\"width\": 40, \"height\": 30}, \"camera\": {\"eye\": [0, 0, 5], \"target\": [0, 0, 0], "
         "\"orthographic_height\": 3}, \"materials\": [], \"shapes\": [], \"lights\": [{\"kind\": \"rectangle\", "
         "\"centre\": [1.5, 0, 0], \"normal\": [0, 0, 1], \"half\": [0.5, 0.5], \"radiance\": 2, \"visible\": "
         "true}]}"},
        {"o.pbrt",
         "Scale -1 1 1 Scale 0.5 0.5 0.5 LookAt 0 0 5  0 0 0  0 1 0\n"
         "Camera \"orthographic\" \"float screenwindow\" [-1 1 -0.75 0.75] Film \"rgb\" " SIZE "\nWorldBegin\n"
         "AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
         "\"point3 P\" [1 -0.5 0  2 -0.5 0  2 0.5 0  1 0.5 0]\n"},
        {"o.pbrt",
         "Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0\n" /* the window is off the middle, the square is moved with it */
         "Camera \"orthographic\" \"float screenwindow\" [-1 3 -1.5 1.5] Film \"rgb\" " SIZE "\nWorldBegin\n"
         "AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] "
         "\"point3 P\" [2 -0.5 0  3 -0.5 0  3 0.5 0  2 0.5 0]\n"},
        {"o.xml",
         "<scene version=\"3.0.0\"><sensor type=\"orthographic\"><transform name=\"to_world\"><scale value=\"2\"/>"
         "<lookat origin=\"0, 0, 5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/></transform><film type=\"hdrfilm\">"
         "<integer name=\"width\" value=\"40\"/><integer name=\"height\" value=\"30\"/></film></sensor>"
         "<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"0.5\"/><translate x=\"1.5\"/>"
         "</transform><emitter type=\"area\"><rgb name=\"radiance\" value=\"2\"/></emitter></shape></scene>"}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        if (strstr(scenes[i].name, ".xml") ? !can_read("probe.xml") : i && !koksma_mesh_tracer()) {
            continue;
        }
        koksma_scene *scene = opened(scenes[i].name, scenes[i].text);
        koksma_render_options options = options_of(scene, "regular", "direct", 1, 40);
        koksma_image image;
        options.height = 30;
        assert_int_equal(scene->n_unknown, 0);
        assert_ok(koksma_render(scene, &options, NULL, &image));
        for (size_t k = 0; k < 40 * 30; k++) {
            const bool lit = k % 40 >= 30 && k / 40 >= 10 && k / 40 < 20;
            assert_near((double)image.pixels[k * (size_t)image.channels], lit ? 2 : 0, 1e-6);
        }
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
}

/* ---- A closed form: a spot above a floor ---------------------------------------------------------------------- */

/* How the intensity of a spot of 20 degrees, full within 8, falls off with the cosine: by pbrt-v4's SmoothStep in the
   cosine, or linearly in the angle as Mitsuba's documentation says. */
static double smooth_in_cosine(double cosine)
{
    const double outer = cos(M_PI / 9), inner = cos(8 * M_PI / 180);
    const double a = fmin(fmax((cosine - outer) / (inner - outer), 0), 1);
    return a * a * (3 - 2 * a);
}

static double linear_in_angle(double cosine)
{
    return fmin(fmax((20 - acos(cosine) * 180 / M_PI) / 12, 0), 1);
}

/* A floor of albedo 1/2 under such a spot of intensity 6 at (0.5, 0, 2), which shines down: the radiance is albedo / pi *
   intensity * falloff * cos / d^2. */
TEST_CASE(spots_light_a_circle)
{
    static const struct {
        const char *name;
        double (*falloff)(double);
        const char *text;
    } scenes[] = {
        {"s.pbrt", smooth_in_cosine,
         "Scale -1 1 1 Scale 0.5 0.5 0.5 LookAt 0 0 5  0 0 0  0 1 0\n"
         "Camera \"orthographic\" \"float screenwindow\" [-1 1 -0.75 0.75] Film \"rgb\" " SIZE "\nWorldBegin\n"
         "LightSource \"spot\" \"rgb I\" [6 6 6] \"point3 from\" [0.5 0 2] \"point3 to\" [0.5 0 1] "
         "\"float coneangle\" 20 \"float conedeltaangle\" 12\n"
         "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5] Shape \"trianglemesh\" \"integer indices\" "
         "[0 1 2 0 2 3] \"point3 P\" [-4 -4 0  4 -4 0  4 4 0  -4 4 0]\n"},
        {"s.xml", linear_in_angle,
         "<scene version=\"3.0.0\"><sensor type=\"orthographic\"><transform name=\"to_world\"><scale value=\"2\"/>"
         "<lookat origin=\"0, 0, 5\" target=\"0, 0, 0\" up=\"0, 1, 0\"/></transform><film type=\"hdrfilm\">"
         "<integer name=\"width\" value=\"40\"/><integer name=\"height\" value=\"30\"/></film></sensor>"
         "<emitter type=\"spot\"><transform name=\"to_world\"><lookat origin=\"0.5, 0, 2\" target=\"0.5, 0, 0\" "
         "up=\"0, 1, 0\"/></transform><rgb name=\"intensity\" value=\"6\"/><float name=\"cutoff_angle\" "
         "value=\"20\"/><float name=\"beam_width\" value=\"8\"/></emitter><shape type=\"rectangle\"><transform "
         "name=\"to_world\"><scale value=\"4\"/></transform><bsdf type=\"diffuse\"/></shape></scene>"}};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        if (strstr(scenes[i].name, ".xml") ? !can_read("probe.xml") : !koksma_mesh_tracer()) {
            continue;
        }
        koksma_scene *scene = opened(scenes[i].name, scenes[i].text);
        koksma_render_options options = options_of(scene, "regular", "direct", 1, 40);
        koksma_image image;
        options.height = 30;
        assert_int_equal(scene->n_unknown, 0);
        assert_ok(koksma_render(scene, &options, NULL, &image));
        for (size_t k = 0; k < 40 * 30; k++) {
            const double x = ((double)(k % 40) + 0.5) / 10 - 2 - 0.5, y = ((double)(k / 40) + 0.5) / 10 - 1.5;
            const double square = x * x + y * y + 4, cosine = 2 / sqrt(square), albedo = 0.5;
            const double lit = albedo / M_PI * 6 * scenes[i].falloff(cosine) * cosine / square;
            assert_near((double)image.pixels[k * (size_t)image.channels], lit, 2e-6);
        }
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
}

/* ---- A closed form: lights that reflect, and the depth -------------------------------------------------------- */

/* A closed room whose every wall emits 1 and reflects one half is everywhere as bright as 1 + 1/2 + 1/4 + ...; cut after
   `--depth d` bounces, and the light that the last vertex gets from the lights, d + 2 terms are left. */
TEST_CASE(a_luminous_room_is_a_geometric_series)
{
    static const char *const names[] = {"one.pbrt", "one.xml"};
    static const char *const texts[] = {
        "LookAt 0 0 0  0.2 0.1 1  0 1 0 Camera \"perspective\" \"float fov\" 80 Film \"rgb\" " SIZE " WorldBegin\n"
        "Material \"diffuse\" AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Shape \"trianglemesh\"\n"
        "\"point3 P\" [-1 -1 -1  1 -1 -1  -1 1 -1  1 1 -1  -1 -1 1  1 -1 1  -1 1 1  1 1 1] \"integer indices\" [\n"
        "0 1 3 0 3 2  4 7 5 4 6 7  0 4 5 0 5 1  2 3 7 2 7 6  0 2 6 0 6 4  1 5 7 1 7 3]\n",
        "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"80\"/><film "
        "type=\"hdrfilm\"><integer name=\"width\" value=\"40\"/><integer name=\"height\" value=\"30\"/></film>"
        "</sensor><shape type=\"cube\"><boolean name=\"flip_normals\" value=\"true\"/><bsdf type=\"diffuse\"><rgb "
        "name=\"reflectance\" value=\"0.5\"/></bsdf><emitter type=\"area\"><rgb name=\"radiance\" value=\"1\"/>"
        "</emitter></shape></scene>"};
    for (size_t i = 0; koksma_mesh_tracer() && i < 2; i++) {
        if (i == 1 && !can_read("probe.xml")) {
            continue;
        }
        koksma_scene *scene = opened(names[i], texts[i]);
        assert_int_equal(scene->n_unknown, 0);
        for (int depth = 0; depth <= 6; depth += 1 + depth / 2) {
            koksma_render_options options = options_of(scene, "random", "path", 64, 24);
            double error;
            options.depth = depth;
            const double mean = mean_of(scene, &options, &error);
            assert_mean(mean, error, 2 - pow(0.5, depth + 1));
        }
        koksma_scene_close(scene);
    }
}

/* ---- Cameras' windows, invisible lights, spectra ------------------------------------------------------------------ */

/* A light whose shape has alpha 0 shines, and no ray meets it; a shape with alpha 0 is not there. Below the centre of a
   disk of radius r and radiance L at distance d the irradiance is pi L r^2 / (r^2 + d^2). */
TEST_CASE(alpha_zero_hides_a_shape_but_not_its_light)
{
    static const char *const text =
        "LookAt 0 0 1  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 2 Film \"rgb\" " SIZE " WorldBegin\n"
        "Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5] Shape \"disk\" \"float radius\" 5\n"
        "AttributeBegin Translate 0 0 0.5 Shape \"disk\" \"float alpha\" 0\n"
        "Rotate 180 1 0 0 AreaLightSource \"diffuse\" \"rgb L\" [3 3 3]\n"
        "Shape \"disk\" \"float alpha\" [0] \"float radius\" 0.5 AttributeEnd\n";
    koksma_scene *scene = opened("a.pbrt", text);
    double error;
    assert_int_equal(scene->n_unknown, 0);
    koksma_render_options options = options_of(scene, "random", "direct", 256, 40);
    const double mean = mean_of(scene, &options, &error);
    assert_mean(mean, error + 1e-3, 0.5 * 3 * 0.25 / 0.5);
    koksma_scene_close(scene);
}

/* Mitsuba's texture coordinates, as its ray_intersect gives them: of a sphere the angle about z and that from +z, of a
   disk the radius and the angle, as fractions. */
TEST_CASE(round_shapes_have_mitsubas_coordinates)
{
    static const char *const shapes[] = {"sphere", "disk"};
    for (int i = 0; i < 2 && can_read("probe.xml") && koksma_mesh_tracer(); i++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><emitter type=\"constant\"/><shape type=\"%s\">"
            "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\"/></bsdf></shape></scene>",
            shapes[i]);
        koksma_scene *scene = opened("uv.xml", text);
        assert_int_equal(scene->n_meshes, 1);
        const koksma__mesh *m = &scene->meshes[0];
        for (size_t v = 0; v < m->n_vertices; v++) {
            const double x = (double)m->vertices[3 * v], y = (double)m->vertices[3 * v + 1];
            const double z = (double)m->vertices[3 * v + 2], u0 = (double)m->uvs[2 * v],
                         v0 = (double)m->uvs[2 * v + 1];
            const double radius = hypot(x, y), angle = i ? v0 : u0;
            assert_near(x, radius * cos(2 * M_PI * angle), 1e-6);
            assert_near(y, radius * sin(2 * M_PI * angle), 1e-6);
            assert_near(i ? u0 : cos(M_PI * v0), i ? radius : z, 1e-6);
        }
        koksma_scene_close(scene);
    }
}

/* ---- Motion of pbrt ------------------------------------------------------------------------------------------------ */

/* At time t pbrt-v4 places a shape by T R S: the translation and the symmetric part of the polar decomposition lie evenly
   between those of the two matrices, the rotation on the arc between (Pharr, Jakob and Humphreys 2023, section 3.11). Each
   motion, with the shutter open at one time only, shows the scene that stands as it is at that time. */
static const struct {
    const char *moving, *still;
    double time;
} motions[] = {
    {"ActiveTransform EndTime Translate 1 0.4 0 ActiveTransform All %s", "Translate 0.5 0.2 0 %s", 0.5},
    {"ActiveTransform StartTime Translate -1 0 0 ActiveTransform EndTime Translate 1 0 0 ActiveTransform All %s",
     "Translate -0.5 0 0 %s", 0.25},
    {"ActiveTransform EndTime Rotate 60 0.2 0.1 1 ActiveTransform All %s", "Rotate 30 0.2 0.1 1 %s", 0.5},
    {"ActiveTransform EndTime Translate 0.4 0 0 Rotate 60 0 0.3 1 Scale 1.6 1.6 1.6 ActiveTransform All Rotate 20 1 "
     "0 0 %s",
     "Translate 0.2 0 0 Rotate 30 0 0.3 1 Scale 1.3 1.3 1.3 Rotate 20 1 0 0 %s", 0.5},
    {"ActiveTransform EndTime Rotate 60 0 0 1 Scale 1.8 1 1 ActiveTransform All %s",
     "Rotate 15 0 0 1 Scale 1.2 1 1 %s", 0.25},
    {"ActiveTransform EndTime ConcatTransform [1.4 0.6 0 0  0.6 1.4 0 0  0 0 1 0  0 0 0 1] ActiveTransform All %s",
     "ConcatTransform [1.2 0.3 0 0  0.3 1.2 0 0  0 0 1 0  0 0 0 1] %s", 0.5},
    {"Scale -1 1 1 ActiveTransform EndTime Rotate 60 0 0 1 ActiveTransform All %s", "Scale -1 1 1 Rotate 30 0 0 1 %s",
     0.5},
    {"ObjectBegin \"o\" Translate 0.6 0 0 %s ObjectEnd ActiveTransform EndTime Rotate 90 0 0 1 ActiveTransform All "
     "ObjectInstance \"o\"",
     "Rotate 45 0 0 1 Translate 0.6 0 0 %s", 0.5},
    {"ObjectBegin \"o\" ActiveTransform EndTime Translate 0.3 0 0 Rotate 60 0 0 1 ActiveTransform All %s ObjectEnd "
     "Scale 1 1.5 1 ObjectInstance \"o\"",
     "Scale 1 1.5 1 Translate 0.15 0 0 Rotate 30 0 0 1 %s", 0.5},
    {"ObjectBegin \"o\" ActiveTransform EndTime Translate 0.3 0 0 Rotate 60 0 0 1 ActiveTransform All %s ObjectEnd "
     "Rotate 50 0 1 0 Scale -1.2 1.2 1.2 ObjectInstance \"o\"",
     "Rotate 50 0 1 0 Scale -1.2 1.2 1.2 Translate 0.15 0 0 Rotate 30 0 0 1 %s", 0.5},
    {"AttributeBegin ActiveTransform EndTime Translate 5 0 0 AttributeEnd %s", "%s", 0.5},
    {"TransformBegin ActiveTransform EndTime Translate 5 0 0 TransformEnd %s", "%s", 0.5},
    {"ActiveTransform EndTime Translate 5 0 0 Identity ActiveTransform All Identity %s", "%s", 0.5},
};

static const char *const moved_shapes[] = {
    "Shape \"trianglemesh\" \"point3 P\" [-0.3 -0.7 0.1  0.9 -0.2 0  0.1 0.8 -0.2] \"integer indices\" [0 1 2]",
    "Shape \"sphere\" \"float radius\" 0.7", "Shape \"disk\" \"float radius\" 0.8 \"float height\" 0.4"};

static void check_motion(const char *moving, const char *still)
{
    koksma_scene *scenes[2] = {opened("moving.pbrt", moving), opened("still.pbrt", still)};
    koksma_layers layers[2];
    size_t off = 0, hit = 0;
    for (int i = 0; i < 2; i++) {
        layers[i] = first_hits(scenes[i]);
    }
    assert_true(scenes[0]->moves == (strstr(moving, "AttributeEnd") == NULL &&
                                     strstr(moving, "TransformEnd") == NULL && strstr(moving, "Identity") == NULL));
    for (size_t k = 0; k < 40 * 30; k++) {
        bool same = fabs((double)(layers[0].depth.pixels[k] - layers[1].depth.pixels[k])) < 2e-4;
        for (size_t c = 0; c < 3; c++) {
            same &= fabs((double)(layers[0].normal.pixels[3 * k + c] - layers[1].normal.pixels[3 * k + c])) < 1e-3;
        }
        off += !same;
        hit += layers[1].depth.pixels[k] > 0 && isfinite(layers[1].depth.pixels[k]);
    }
    if (off > 1 || hit < 20) { /* the edge of a shape may pass by the middle of a pixel */
        fail_msg("%zu of %zu pixels differ: %s", off, hit, moving);
    }
    for (int i = 0; i < 2; i++) {
        koksma_layers_fini(&layers[i]);
        koksma_scene_close(scenes[i]);
    }
}

TEST_CASE(shapes_move_as_in_pbrt)
{
    for (size_t i = 0; koksma_mesh_tracer() && i < sizeof motions / sizeof *motions; i++) {
        for (size_t k = 0; k < sizeof moved_shapes / sizeof *moved_shapes; k++) {
            char texts[2][2][1024];
            for (int m = 0; m < 2; m++) {
                char inner[800];
                snprintf(inner, sizeof inner, m ? motions[i].still : motions[i].moving, moved_shapes[k]);
                for (int late = 0; late < 2; late++) { /* the same motion from time 1 to 3 */
                    const double at = late ? 1 + 2 * motions[i].time : motions[i].time;
                    koksma__snprintf(
                        texts[m][late], sizeof texts[m][late],
                        "%s Scale -1 1 1 LookAt 0.3 0.2 5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 30 "
                        "\"float shutteropen\" %g \"float shutterclose\" %g Film \"rgb\" " SIZE " WorldBegin %s",
                        late ? "TransformTimes 1 3" : "", at, at, inner);
                }
            }
            check_motion(texts[0][0], texts[1][0]);
            check_motion(texts[0][1], texts[1][1]);
        }
    }
}

/* A camera that only moves; and a shutter that is open before the motion begins, when all stands as at its start. */
TEST_CASE(cameras_move_as_in_pbrt)
{
    static const char *const form = "%s LookAt 0.3 0.2 5  0 0 0  0 1 0 %s Camera \"perspective\" \"float fov\" 30 "
                                    "\"float shutteropen\" %g \"float "
                                    "shutterclose\" %g Film \"rgb\" " SIZE " WorldBegin Shape \"sphere\"";
    char texts[2][1024];
    static const char *const move = "ActiveTransform EndTime Translate 0.8 0.4 1 ActiveTransform All";
    koksma__snprintf(texts[0], sizeof texts[0], form, "", move, 0.25, 0.25);
    koksma__snprintf(texts[1], sizeof texts[1], form, "", "Translate 0.2 0.1 0.25", 0.0, 1.0);
    check_motion(texts[0], texts[1]);
    koksma__snprintf(texts[0], sizeof texts[0], form, "TransformTimes 2 3", move, 0.0, 1.0);
    koksma__snprintf(texts[1], sizeof texts[1], form, "", "", 0.0, 1.0);
    check_motion(texts[0], texts[1]);
    koksma__snprintf(texts[0], sizeof texts[0], form, "TransformTimes 0.25 0.75", move, 0.8, 0.9);
    koksma__snprintf(texts[1], sizeof texts[1], form, "", "Translate 0.8 0.4 1", 0.0, 1.0);
    check_motion(texts[0], texts[1]);
}

/* A motion that fills the middle half of the shutter's time: a light square of side 1 stands for a quarter of it at each
   end of a way of 2, and its picture, 4 wide, has on the left and right what a quarter and, between, what the way gives. */
TEST_CASE(shutters_outlast_motions)
{
    if (!koksma_mesh_tracer()) {
        return;
    }
    koksma_scene *scene = opened(
        "long.pbrt",
        "TransformTimes 0.25 0.75 Scale -1 1 1 Scale 0.5 0.5 0.5 LookAt 0 0 5  0 0 0  0 1 0 Camera \"orthographic\" "
        "\"float screenwindow\" [-1 1 -0.75 0.75] Film \"rgb\" " SIZE " WorldBegin Material \"diffuse\" \"rgb "
        "reflectance\" [1 1 1] LightSource \"distant\" \"rgb L\" [1 1 1] \"point3 from\" [0 0 1] \"point3 to\" [0 0 "
        "0] Translate -1 0 0 ActiveTransform EndTime Translate 2 0 0 Shape \"trianglemesh\" \"integer indices\" [0 1 "
        "2 0 "
        "2 3] \"point3 P\" [-0.5 -9 0  0.5 -9 0  0.5 9 0  -0.5 9 0]");
    koksma_render_options options = options_of(scene, "random", "direct", 400, 40);
    koksma_image image;
    options.height = 30;
    assert_int_equal(scene->n_unknown, 0);
    assert_ok(koksma_render(scene, &options, NULL, &image));
    for (int x = 0; x < 40; x++) {
        double sum = 0;
        const double at = (x + 0.5) / 10 - 2, lit = 1 / M_PI;
        for (int y = 0; y < 30; y++) {
            sum += (double)image.pixels[(size_t)(40 * y + x) * (size_t)image.channels] / 30;
        }
        /* the share of the way, of length 2 in half the time, at which the square covers x */
        const double from = fmax(at - 0.5, -1), to = fmin(at + 0.5, 1), moving = fmax(to - from, 0) / 2 * 0.5;
        const double standing = 0.25 * (fabs(fabs(at) - 1) < 0.5);
        assert_near(sum, lit * (moving + standing), 0.006 * lit * 4);
    }
    koksma_image_fini(&image);
    koksma_scene_close(scene);
}

/* ---- Media of Mitsuba ---------------------------------------------------------------------------------------------- */

/* A sensor within a medium, whose inside and the rest of the scene are given. */
#define FOGGY_HEAD "<scene version=\"3.0.0\"><medium type=\"homogeneous\" id=\"f\">"
#define FOGGY_TAIL "</medium><sensor type=\"perspective\"><ref id=\"f\"/></sensor>\n"

/* ---- Textures of pbrt ---------------------------------------------------------------------------------------------- */

/* pbrt-v4's UVMapping looks an image up at (su u + du, sv v + dv), beyond its edges by the wrap mode (Pharr, Jakob and
   Humphreys 2023, sections 10.2 and 10.4.2): an image of four columns on a square under parallel light. */
TEST_CASE(images_are_mapped_as_in_pbrt)
{
    static const struct {
        const char *parameters;
        double scale, delta;
        bool clamps;
    } cases[] = {{"", 1, 0, false},
                 {"\"float uscale\" 2 \"float udelta\" 0.3", 2, 0.3, false},
                 {"\"float uscale\" 2 \"float udelta\" -0.4 \"string wrap\" \"clamp\"", 2, -0.4, true},
                 {"\"float udelta\" 0.3 \"string wrap\" \"repeat\"", 1, 0.3, false}};
    char path[128];
    koksma_image columns, image;
    assert_ok(koksma_image_init(&columns, 4, 2, 1));
    for (int i = 0; i < 8; i++) {
        columns.pixels[i] = 0.125f + 0.25f * (float)(i % 4);
    }
    snprintf(path, sizeof path, "%s/columns.pfm", folder);
    assert_ok(koksma_image_write(path, &columns, NULL));
    koksma_image_fini(&columns);
    for (size_t i = 0; koksma_mesh_tracer() && i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(
            text, sizeof text,
            "Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0 Camera \"orthographic\" \"float screenwindow\" [-1 1 -0.75 "
            "0.75] Film "
            "\"rgb\" " SIZE
            " WorldBegin LightSource \"distant\" \"rgb L\" [1 1 1] \"point3 from\" [0 0 1] \"point3 to\" "
            "[0 0 0] Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"columns.pfm\" \"string filter\" "
            "\"point\" %s Material \"diffuse\" \"texture reflectance\" \"t\" Shape \"trianglemesh\" \"integer "
            "indices\" "
            "[0 1 2 0 2 3] \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"point2 uv\" [0 0 1 0 1 1 0 1]",
            cases[i].parameters);
        koksma_scene *scene = opened("columns.pbrt", text);
        koksma_render_options options = options_of(scene, "regular", "direct", 1, 40);
        options.height = 30;
        assert_int_equal(scene->n_unknown, 0);
        assert_ok(koksma_render(scene, &options, NULL, &image));
        for (int x = 0; x < 40; x++) {
            const double s = cases[i].scale * (x + 0.5) / 40 + cases[i].delta;
            const double at = cases[i].clamps ? fmin(fmax(s, 0), 0.999) : s - floor(s);
            assert_near((double)image.pixels[(size_t)(40 * 15 + x) * (size_t)image.channels],
                        (0.125 + 0.25 * floor(4 * at)) / M_PI, 1e-6);
        }
        koksma_image_fini(&image);
        koksma_scene_close(scene);
    }
    unlink(path);
}

/* The environments of pbrt-v4 are square, of any size; it ends with another. Mitsuba's may be of any shape, but narrow
   rows would become an image that is much larger. A matrix may make the directions to its pixels overflow. */
TEST_CASE(environments_have_a_shape)
{
    static const struct {
        const char *name, *text, *reason; /* NULL: it is accepted */
        int width, height;
    } cases[] = {
#define PBRT_SKY "Camera \"perspective\" WorldBegin\nLightSource \"infinite\" \"string filename\" \"sky.pfm\""
#define TURNED_SKY(matrix)                                                                                           \
    "Camera \"perspective\" WorldBegin ConcatTransform [" matrix " 0 0 0 1]\nLightSource \"infinite\" \"string "     \
    "filename\" \"sky.pfm\""
#define MITSUBA_SKY_IN(transform)                                                                                    \
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"/>\n<emitter type=\"envmap\"><string name=\"filename\" "   \
    "value=\"sky.pfm\"/>" transform "</emitter></scene>"
#define MITSUBA_SKY MITSUBA_SKY_IN("")
#define MATRIX_SKY(matrix)                                                                                           \
    MITSUBA_SKY_IN("<transform name=\"to_world\"><matrix value=\"" matrix " 0 0 0 1\"/></transform>")
        {"a.pbrt", PBRT_SKY, NULL, 1, 1},
        {"a.pbrt", PBRT_SKY, NULL, 37, 37},
        {"a.pbrt", PBRT_SKY, NULL, 800, 800},
        {"a.pbrt", PBRT_SKY, "a.pbrt:2: an environment of 600 x 1200 pixels is not square", 600, 1200},
        {"a.pbrt", PBRT_SKY, "a.pbrt:2: an environment of 64 x 32 pixels is not square", 64, 32},
        {"a.xml", MITSUBA_SKY, NULL, 600, 1200},
        {"a.xml", MITSUBA_SKY, NULL, 64, 1},
        {"a.xml", MITSUBA_SKY, "a.xml:2: an environment of 4097 x 1 pixels is more than four times as wide", 4097, 1},
        {"a.pbrt", TURNED_SKY("1e8 0 0 0 0 1e8 0 0 0 0 1e8 0"), NULL, 1, 1},
        {"a.pbrt", TURNED_SKY("1e-37 1e-37 0 0 -1e37 1e37 0 0 0 0 1 0"),
         "/a.pbrt:2: the matrix of an environment, or its inverse, has an entry beyond 1e9", 1, 1},
        {"a.pbrt", TURNED_SKY("1e-20 0 0 0 0 1e-20 0 0 0 0 1e-20 0"),
         "/a.pbrt:2: the matrix of an environment, or its", 1, 1},
        {"a.xml", MATRIX_SKY("0 0 1 5e100 0 1 0 0 -1 0 0 0"), NULL, 64, 32},
        {"a.xml", MATRIX_SKY("3.3e-309 -7e153 0 0 3.3e-309 7e153 0 0 0 0 1e154 0"),
         "/a.xml:2: the matrix of an environment, or its inverse, has an entry beyond 1e9", 64, 32}};
    char path[128];
    const bool xml = can_read("probe.xml");
    snprintf(path, sizeof path, "%s/sky.pfm", folder);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        koksma_image sky;
        koksma_scene *scene = NULL;
        if (!xml && strstr(cases[i].name, ".xml")) {
            continue;
        }
        assert_ok(koksma_image_init(&sky, cases[i].width, cases[i].height, 1));
        assert_ok(koksma_image_write(path, &sky, NULL));
        koksma_image_fini(&sky);
        const koksma_status status = open_as(cases[i].name, cases[i].text, &scene);
        assert_that(status == (cases[i].reason ? KOKSMA_MALFORMED : KOKSMA_OK) &&
                        (!status || strstr(koksma_error_text(), cases[i].reason)),
                    "%d x %d: status %d, '%s'", cases[i].width, cases[i].height, (int)status,
                    status ? koksma_error_text() : "");
        assert_true(status || (scene->n_lights == 1 && scene->lights[0].image));
        koksma_scene_close(scene);
    }
    unlink(path);
}

/* ---- Lights with two sides ------------------------------------------------------------------------------------------ */

/* What the back of a light lights: a floor at distance 1 behind a square of side 2, by samples of the light alone, by rays
   alone, and by both. The configuration factor of a quarter from below its corner, with X = Y = 1, is
       1 / (2 pi) (X / sqrt(1 + X^2) atan(Y / sqrt(1 + X^2)) + the same with X and Y swapped). */
TEST_CASE(both_sides_light_alike)
{
    static const char *const ways[] = {"path", "path-light", "path-bsdf", "path-balance", "direct"};
    for (int i = 0; koksma_mesh_tracer() && i < 10; i++) {
        char text[1024];
        /* the camera is between the light at z = 0 and the floor at z = -1 */
        snprintf(
            text, sizeof text,
            "LookAt 0 0 -0.5  0 0 -1  0 1 0 Camera \"perspective\" \"float fov\" 0.1 Film \"rgb\" " SIZE
            " WorldBegin "
            "AttributeBegin Material %s AreaLightSource \"diffuse\" \"rgb L\" [2 2 2] \"bool twosided\" true Shape "
            "\"trianglemesh\" \"point3 P\" [-1 -1 0  1 -1 0  1 1 0  -1 1 0] \"integer indices\" [0 1 2 0 2 3] "
            "AttributeEnd Material \"diffuse\" \"rgb reflectance\" [0.5 0.5 0.5] Translate 0 0 -1 Shape \"disk\" "
            "\"float "
            "radius\" 9",
            i & 1 ? "\"diffuse\" \"rgb reflectance\" [0 0 0.01]" : "\"interface\"");
        koksma_scene *scene = opened("sides.pbrt", text);
        koksma_render_options options = options_of(scene, "random", ways[i / 2], 256, 24);
        double error;
        options.depth = 1;
        const double mean = mean_of(scene, &options, &error);
        const double factor = 4 / (2 * M_PI) * 2 / sqrt(2) * atan(1 / sqrt(2));
        assert_mean(mean, error + 1e-4, 0.5 * 2 * factor);
        koksma_scene_close(scene);
    }
}

/* ---- What is known, and what is said of the rest ----------------------------------------------------------------- */

#define PBRT "LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\" Film \"rgb\" " SIZE " WorldBegin\n"
#define MITSUBA_HEAD                                                                                                 \
    "<scene version=\"3.0.0\"><sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>\n"
#define MITSUBA(rest) MITSUBA_HEAD rest "</scene>"

#define FOG                                                                                                          \
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.1 0.2 0.3] \"rgb sigma_s\" [0 0.1 "  \
    "0.2] "                                                                                                          \
    "\"float g\" 0.4 \"float scale\" 2 MediumInterface \"\" \"fog\" LookAt 0 0 5  0 0 0  0 1 0 Camera "              \
    "\"perspective\" Film "                                                                                          \
    "\"rgb\" " SIZE " WorldBegin\n"

#define BALL_HEAD "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"sphere\">"
#define BALL_TAIL "</shape></scene>"

static const shared_text shared[] = {{"{S}", SIZE},         {"{P}", PBRT},       {"{G}", FOG},
                                     {"{M}", MITSUBA_HEAD}, {"{F}", FOGGY_HEAD}, {"{/F}", FOGGY_TAIL},
                                     {"{B}", BALL_HEAD},    {"{/B}", BALL_TAIL}, {NULL, NULL}};

static void write_white(void)
{
    char path[128];
    koksma_image white;
    snprintf(path, sizeof path, "%s/white.pfm", folder);
    assert_ok(koksma_image_init(&white, 2, 2, 1));
    assert_ok(koksma_image_write(path, &white, NULL));
    koksma_image_fini(&white);
}

/* Of a case that is read: `how` is "reads", or "says" with the beginning of the only warning. */
static void look_at_kind(const char *how, const char *whole)
{
    char text[256] = "", warning[256];
    const char *expected = strncmp(how, "says ", 5) ? NULL : how + 5, *name = *whole == '<' ? "a.xml" : "a.pbrt";
    if (!strncmp(how, "refuses", 7) || !can_read(name)) {
        return;
    }
    koksma_scene *scene = opened(name, whole);
    const bool said = koksma_scene_unknown(scene, 0, text, sizeof text);
    assert_that(said == (expected != NULL) && (!said || strncmp(text, expected, strlen(expected)) == 0),
                "%s: '%s', expected '%s'", whole, text, expected ? expected : "");
    assert_that(!koksma_scene_unknown(scene, 1, text, sizeof text), "%s: also '%s'", whole, text);
    if (said) { /* it is a warning, too */
        bool found = false;
        for (size_t k = 0; !found && koksma_scene_warning(scene, k, warning, sizeof warning); k++) {
            found = !strncmp(warning, expected, strlen(expected));
        }
        assert_true(found);
    }
    koksma_scene_close(scene);
}

TEST_CASE(unknown_things_are_named)
{
    write_white();
    assert_true(each_text("scene/texts.txt", shared, look_at_kind) > 200);
}

/* Writes two.pfm, of 2 x 2 pixels. Its path is put into `path`. */
static void write_two(const float pixels[12], char path[128])
{
    koksma_image two;
    snprintf(path, 128, "%s/two.pfm", folder);
    assert_ok(koksma_image_init(&two, 2, 2, 3));
    memcpy(two.pixels, pixels, 12 * sizeof *pixels);
    assert_ok(koksma_image_write(path, &two, NULL));
    koksma_image_fini(&two);
}

/* A light that is no surface has one colour: the mean of its image, of all its levels, times the scale of a spectrum around
   it; a surface shows the image itself, times that scale. */
TEST_CASE(images_of_lights_are_their_means)
{
#define TWO "<texture name=\"%s\" type=\"bitmap\"><string name=\"filename\" value=\"two.pfm\"/></texture>"
    static const struct {
        const char *colour;
        double mean[3], scale; /* scale: of the image on a surface; 0: it has one colour, too */
    } cases[] = {{TWO, {10, 0.5, 0.25}, 1},
                 {"<spectrum name=\"%s\" type=\"d65\"><float name=\"scale\" value=\"10\"/>" TWO "</spectrum>",
                  {100, 5, 2.5},
                  10},
                 {"<texture name=\"%s\" type=\"checkerboard\"><rgb name=\"color0\" value=\"0 1 2\"/>"
                  "<texture name=\"color1\" type=\"bitmap\"><string name=\"filename\" value=\"two.pfm\"/></texture>"
                  "</texture>",
                  {5, 0.75, 1.125},
                  0}};
#undef TWO
    static const float pixels[] = {5, 0.5F, 0.25F, 15, 0.5F, 0.25F, 5, 0.5F, 0.25F, 15, 0.5F, 0.25F};
    char path[128];
    write_two(pixels, path);
    for (size_t i = 0; can_read("probe.xml") && i < sizeof cases / sizeof *cases; i++) {
        char text[2048], of[3][512];
        static const char *const names[] = {"intensity", "radiance", "radiance"};
        for (int k = 0; k < 3; k++) {
            snprintf(of[k], sizeof of[k], cases[i].colour, names[k], "x");
        }
        snprintf(text, sizeof text,
                 MITSUBA("<emitter type=\"point\">%s</emitter><emitter type=\"constant\">%s</emitter><shape "
                         "type=\"rectangle\"><emitter type=\"area\">%s</emitter></shape>"),
                 of[0], of[1], of[2]);
        koksma_scene *scene = opened("a.xml", text);
        assert_int_equal(scene->n_lights, 3);
        for (size_t light = 0; light < 3; light++) {
            for (int k = 0; k < 3; k++) {
                const double expected = light == 2 && cases[i].scale > 0 ? cases[i].scale : cases[i].mean[k];
                assert_near(scene->lights[light].radiance[k], expected, 1e-5 * expected);
            }
        }
        const koksma__placement *p = scene->n_placements ? &scene->placements[0] : NULL;
        assert_true(p ? scene->materials[p->material].maps[KOKSMA__MAP_EMISSION].image != NULL : cases[i].scale == 0);
        assert_true(scene->n_unknown > 0);
        for (size_t warning = 0; koksma_scene_unknown(scene, warning, text, sizeof text); warning++) {
            assert_non_null(strstr(text, " is replaced by its mean colour"));
        }
        koksma_scene_close(scene);
    }
    unlink(path);
}

/* A sky of radiance 1 is all the light. What covers the whole picture is black and meets half of it: .5 remains, of an
   image with the levels 0 and 1 as of a constant; a blend of Lambert surfaces has the blended albedo, by each level of
   an image. */
TEST_CASE(masks_and_blends_are_exact)
{
#define BEFORE(bsdf)                                                                                                 \
    MITSUBA("<shape type=\"rectangle\"><transform name=\"to_world\"><scale value=\"40\"/><translate "                \
            "z=\"9\"/></transform>" bsdf "</shape>"                                                                  \
            "<emitter type=\"constant\"><float name=\"radiance\" value=\"1\"/></emitter>")
#define GREY(albedo) "<bsdf type=\"diffuse\"><float name=\"reflectance\" value=\"" #albedo "\"/></bsdf>"
    static const char *const masks[] = {
        BEFORE("<bsdf type=\"mask\"><float name=\"opacity\" value=\"0.5\"/>" GREY(0) "</bsdf>"),
        BEFORE("<bsdf type=\"mask\"><texture name=\"opacity\" type=\"bitmap\"><string name=\"filename\" "
               "value=\"two.pfm\"/></texture>" GREY(0) "</bsdf>")};
    static const float pixels[] = {0, 0, 0, 1, 1, 1, 0, 0, 0, 1, 1, 1};
    char path[128];
    double error;
    write_two(pixels, path);
    for (size_t i = 0; can_read("probe.xml") && koksma_mesh_tracer() && i < 2; i++) {
        koksma_scene *scene = opened("a.xml", masks[i]);
        koksma_render_options options = options_of(scene, "random", "path", 256, 16);
        assert_int_equal(scene->n_unknown, 0);
        const double mean = mean_of(scene, &options, &error);
        assert_near(mean, 0.5,
                    i ? 0.1 : 4 * error + 1e-3); /* the frame shows a little more of one half of the image */
        koksma_scene_close(scene);
    }
    if (can_read("probe.xml")) {
        koksma_scene *scene =
            opened("a.xml", BEFORE("<bsdf type=\"blendbsdf\"><float name=\"weight\" value=\"0.25\"/>" GREY(0.8)
                                       GREY(0.4) "</bsdf>"));
        assert_near(scene->materials[scene->shapes[0].material].albedo[0][0], 0.7, 1e-12);
        koksma_scene_close(scene);
        scene =
            opened("a.xml", BEFORE("<bsdf type=\"blendbsdf\"><texture name=\"weight\" type=\"bitmap\"><string "
                                   "name=\"filename\" value=\"two.pfm\"/></texture>" GREY(0.8) GREY(0.4) "</bsdf>"));
        const koksma_image *image = scene->materials[scene->placements[0].material].image;
        assert_int_equal(scene->n_unknown, 0);
        for (int i = 0; i < 4; i++) {
            assert_near((double)image->pixels[i * image->channels], i % 2 ? 0.4 : 0.8, 1e-6);
        }
        koksma_scene_close(scene);
    }
    unlink(path);
}

/* The texture coordinates that a triangle has without any: of pbrt (0, 0), (1, 0), (1, 1), of Mitsuba the barycentric
   ones. */
TEST_CASE(files_without_uv_have_their_peers)
{
    static const char *const names[] = {"a.pbrt", "a.xml"};
    static const char *const texts[] = {
        PBRT "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" \"t\" "
             "Shape \"plymesh\" \"string filename\" \"one.ply\"",
        MITSUBA("<shape type=\"ply\"><string name=\"filename\" value=\"one.ply\"/><bsdf type=\"twosided\"><bsdf "
                "type=\"diffuse\"><texture name=\"reflectance\" type=\"checkerboard\"/></bsdf></bsdf></shape>")};
    static const float expected[2][6] = {{0, 0, 1, 0, 1, 1}, {0, 0, 1, 0, 0, 1}};
    write_file("one.ply",
               "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
               "z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 "
               "0\n3 0 1 2\n");
    for (int i = 0; i < 2 - !can_read("probe.xml"); i++) {
        koksma_scene *scene = opened(names[i], texts[i]);
        const koksma__mesh *mesh = &scene->meshes[scene->placements[0].mesh];
        assert_int_equal(scene->n_unknown, 0);
        for (size_t k = 0; k < 6; k++) {
            assert_near((double)mesh->uvs[2 * mesh->indices[k / 2] + k % 2], (double)expected[i][k], 0);
        }
        koksma_scene_close(scene);
    }
}

/* ---- What is refused ---------------------------------------------------------------------------------------------- */

static char outside[80]; /* a file beside the folder */

static void look_at_refused(const char *how, const char *whole)
{
    koksma_scene *scene = NULL;
    char text[2048];
    const char *name = *whole == '<' ? "b.xml" : "b.pbrt", *from = strstr(whole, "outside.pbrt"); /* by its name */
    if (strncmp(how, "refuses ", 8) != 0 || !can_read(name)) {
        return;
    }
    snprintf(text, sizeof text, "%.*s%s%s", from ? (int)(from - whole) : (int)strlen(whole), whole,
             from ? strrchr(outside, '/') + 1 : "", from ? from + strlen("outside.pbrt") : "");
    const koksma_status status = open_as(name, text, &scene);
    assert_that(status && strstr(koksma_error_text(), how + 8) && !strchr(koksma_error_text(), '\n') &&
                    koksma_status_exit_code(status) == 3,
                "%s: status %d, '%s', expected '%s'", text, (int)status, status ? koksma_error_text() : "", how + 8);
    assert_null(scene);
}

TEST_CASE(malformed_and_hostile_texts_are_refused)
{
    char path[128];
    snprintf(outside, sizeof outside, "%s.pbrt", folder);
    snprintf(path, sizeof path, "%s/link.pbrt", folder);
    FILE *file = fopen(outside, "w");
    assert_non_null(file);
    fclose(file);
    assert_int_equal(symlink(outside, path), 0);
    write_file("o.xml", "<foo><shape type=\"sphere\"/></foo>");
    each_text("scene/texts.txt", shared, look_at_refused);
    unlink(path);
    unlink(outside);
}

/* Every beginning of a whole text is a scene or an error, and nothing else. */
TEST_CASE(cut_texts_are_survived)
{
    static const char *const names[] = {"c.pbrt", "c.xml"};
    const char *const texts[] = {as_pbrt, as_mitsuba};
    for (size_t i = 0; i < 2; i++) {
        char text[4096];
        for (size_t n = 0; n < strlen(texts[i]); n += 7) {
            koksma_scene *scene = NULL;
            snprintf(text, sizeof text, "%.*s", (int)n, texts[i]);
            const koksma_status status = open_as(names[i], text, &scene);
            assert_true(status ? *koksma_error_text() != 0 : scene != NULL);
            koksma_scene_close(scene);
        }
    }
}
