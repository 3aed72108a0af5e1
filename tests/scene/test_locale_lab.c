/* SPDX-License-Identifier: Apache-2.0 */
/* libkoksma-lab in a program whose locale has a decimal comma: images, scenes, models, plots and studies. */
#include <koksma/adaptive.h>
#include <koksma/study.h>

#include "comma.h"

static void path_of(const char *name, char path[192])
{
    snprintf(path, 192, "%.60s/%.100s", test_folder, name);
}

static void write_text(const char *name, const char *text)
{
    char path[192];
    path_of(name, path);
    test_write(path, text);
}

/* ---- Scenes and images --------------------------------------------------------------------------------- */

/* A picture of a scene through a PFM file, or why there is none. */
static void take_picture(FILE *out, const char *name)
{
    char path[192];
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image;
    path_of(name, path);
    if (koksma_scene_open(path, &scene)) {
        fprintf(out, "%s\n", koksma_error_text());
        return;
    }
    koksma_render_options_init(&options, scene);
    options.width = options.height = 16;
    options.spp = 4;
    assert_ok(koksma_render(scene, &options, NULL, &image));
    path_of("picture.pfm", path);
    assert_ok(koksma_image_write(path, &image, NULL));
    koksma_image_fini(&image);
    assert_ok(koksma_image_read(path, &image));
    fwrite(image.pixels, sizeof *image.pixels, 256 * (size_t)image.channels, out);
    fprintf(out, "\nhash %llu\n", (unsigned long long)koksma_scene_hash(scene));
    koksma_image_fini(&image);
    koksma_scene_close(scene);
}

#define SCENE(albedo)                                                                                                \
    "{\"camera\": {\"eye\": [0.25, 0.5, 6.75], \"target\": [0, 0, 0], \"fov_deg\": 40.5}, \"materials\": "           \
    "[{\"name\": \"m\", \"kind\": \"lambert\", \"albedo\": " albedo "}], \"lights\": [{\"kind\": \"environment\", "  \
    "\"radiance\": 0.75}], \"shapes\": [{\"kind\": \"sphere\", \"centre\": [0.5, 0.25, -0.125], \"radius\": 1.25, "  \
    "\"material\": \"m\"}]}"

static void make_scenes(FILE *out)
{
    koksma_adaptive_options adaptive;
    char text[KOKSMA_MAX_SPEC];
    write_text("scene.json", SCENE("0.625"));
    take_picture(out, "scene.json");
    write_text("scene.json", SCENE("1.5")); /* the error names the range */
    take_picture(out, "scene.json");
    for (size_t i = 0; koksma_adaptive_at(i); i++) {
        const koksma_adaptive *method = koksma_adaptive_at(i);
        adaptive = (koksma_adaptive_options){.method = method};
        for (int k = 0; method->params && method->params[k].name; k++) {
            adaptive.params[k] = 0.7 * method->params[k].min + 0.3 * method->params[k].max;
        }
        koksma_adaptive_text(&adaptive, text);
        fprintf(out, "%s\n", text);
    }
}

/* Files of each format with numbers below 1: seeds of fuzz/corpus/model, whose first line is the ending of their names. */
static void make_models(FILE *out)
{
    static const char *const names[] = {"indented.obj",    "p_wedge_ascii.ply", "triangle.gltf",
                                        "parameters.pbrt", "parameters.xml",    "spectra.xml"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        char path[512], text[1 << 14];
        snprintf(path, sizeof path, "%s/../fuzz/corpus/model/%s", KOKSMA_TESTS, names[i]);
        FILE *seed = fopen(path, "r");
        assert_non_null(seed);
        assert_non_null(fgets(text, sizeof text, seed));
        text[fread(text, 1, sizeof text - 1, seed)] = 0;
        fclose(seed);
        write_text(names[i], text);
        take_picture(out, names[i]);
    }
    write_text("model.obj", "v -0,5 -0,5 0\nv 0,5 -0,25 0,25\nv 0,125 0,75 0\nf 1 2 3\n");
    take_picture(out, "model.obj"); /* an error */
}

TEST_CASE(scenes_and_images_are_read)
{
    test_same_with_comma(*state, make_scenes);
}

TEST_CASE(models_are_read)
{
    if (!koksma_mesh_tracer()) {
        print_message("[  REASON  ] no Embree in this build\n");
        skip();
    }
    test_same_with_comma(*state, make_models);
}

/* ---- Plots --------------------------------------------------------------------------------------------- */

static void take_svg(FILE *out, unsigned char *bytes, size_t size)
{
    fwrite(bytes, 1, size, out);
    free(bytes);
}

static void make_plots(FILE *out)
{
    static const double xs[] = {0.5, 1.25, 2}, ys[] = {0.125, 0.375, 0.75};
    koksma_points points = test_points("random", 9, 2, 7);
    const koksma_value value = test_measure("star", &points);
    const koksma_scatter_options options = {.columns = 3, .rows = 3, .witness = &value.witness, .caption = "points"};
    const koksma_curve curve = {.label = "curve", .n = 3, .xs = xs, .ys = ys, .marks = true};
    const koksma_chart chart = {.x_label = "x", .y_label = "y", .curves = &curve, .n_curves = 1};
    koksma_spectrum spectrum;
    unsigned char *bytes;
    size_t size;
    assert_ok(koksma_spectrum_init(&spectrum, 4));
    assert_ok(koksma_spectrum_add(&spectrum, &points, KOKSMA_SPECTRUM_EXACT, NULL));
    const koksma_panel panels[] = {{.points = &points}, {.spectrum = &spectrum, .white = 2.5}};
    assert_ok(koksma_plot_scatter(&points, &options, KOKSMA_PLOT_SVG, &bytes, &size));
    take_svg(out, bytes, size);
    const koksma_cell cells[] = {{.panel = &panels[0]}, {.panel = &panels[1]}, {.chart = &chart}};
    const koksma_figure figure = {.cells = cells, .n_cells = 3};
    assert_ok(koksma_plot_figure(&figure, KOKSMA_PLOT_SVG, NULL, &bytes, &size));
    take_svg(out, bytes, size);
    koksma_spectrum_fini(&spectrum);
    koksma_points_fini(&points);
}

TEST_CASE(plots_are_drawn)
{
    test_same_with_comma(*state, make_plots);
}

/* ---- Studies ------------------------------------------------------------------------------------------- */

static const char plan[] =
    "{\"name\": \"comma\", \"title\": \"A plan\", \"about\": \"About.\", \"discrepancies\": [{\"id\": \"d\", "
    "\"patterns\": "
    "[\"random\", \"jittered\", \"poisson-disk:d=0.2\"], \"n\": [4, 16], \"measures\": [\"star\", \"l2-star\"], "
    "\"trials\": 3}],"
    "\"images\": [{\"id\": \"i\", \"scenes\": [\"ball\"], \"size\": [8, 6], \"patterns\": [\"random\", \"jittered\", "
    "\"poisson-disk:d=0.2\"], \"spp\": [1, 4], \"trials\": 3, \"references\": [{\"name\": \"reference\", "
    "\"pattern\": "
    "\"jittered\", \"spp\": 16, \"replicates\": 2}]}], \"tables\": [{\"id\": \"t\", \"title\": \"Stars\", \"n\": 16, "
    "\"measure\": \"star\", \"rows\": [{\"pattern\": \"random\", \"label\": \"Random\", \"published\": [0.28]}]}], "
    "\"questions\": [{\"id\": \"q\", \"title\": \"Correlation\", \"kind\": \"correlation\", \"discrepancies\": "
    "\"d\", \"images\": \"i\"}]}";

/* Opens a study in a folder, runs it (a second time there is nothing to do) and writes its report. */
static void run_study(const char *folder)
{
    char path[192];
    path_of("plan.json", path);
    const char *plans[] = {path};
    const koksma_study_options options = {.plans = plans, .n_plans = 1, .folder = folder};
    koksma_study *study;
    assert_ok(koksma_study_open(&options, &study));
    assert_ok(koksma_study_run(study, NULL, NULL));
    assert_ok(koksma_study_report(study, NULL));
    assert_ok(koksma_study_close(study));
}

/* A study in a folder of its own: rows under the same keys, with the same values. */
static void make_study(FILE *out)
{
    static const struct {
        koksma_export_format format;
        const char *name;
    } exports[] = {{KOKSMA_EXPORT_CSV, "export.csv"}, {KOKSMA_EXPORT_JSON, "export.json"}};
    static int number;
    char folder[192], path[192];
    snprintf(path, sizeof path, "study%d", number++);
    path_of(path, folder);
    write_text("plan.json", plan);
    run_study(folder);
    for (size_t i = 0; i < sizeof exports / sizeof *exports; i++) {
        path_of(exports[i].name, path);
        assert_ok(koksma_study_export(folder, exports[i].format, path));
        test_take_file(out, path);
    }
}

/* The report of one folder, made again. */
static void make_report(FILE *out)
{
    char folder[192], path[192];
    path_of("study", folder);
    write_text("plan.json", plan);
    run_study(folder);
    snprintf(path, sizeof path, "%.170s/report.html", folder);
    test_take_file(out, path);
}

TEST_CASE(studies_have_the_same_rows)
{
    test_same_with_comma(*state, make_study);
}

TEST_CASE(reports_are_written)
{
    test_same_with_comma(*state, make_report);
}

TEST_GROUP(test_comma_begin, test_comma_end)
