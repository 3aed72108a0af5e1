/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Every integrator and every pipeline of their tables, in furnaces: under a white sky of radiance 1 a surface that
 * absorbs nothing is as bright as the sky, and none is brighter. What an integrator leaves out is known from its
 * flags: without `areas` the sky has no centre to light from; with `ambient` the scene's ambient light is added; with
 * a scene of its own (ambient occlusion) all surfaces are white, and the sky is 1. Then the two that leave most out.
 */
#include "kinds.h"
#include "render/materials/materials.h"
#include "render/one_image.h"
#include "render/pipelines/pipelines.h"
#include "render/samples/samples.h"

#define CAMERA "'camera': {'eye': [0, 0.3, 3], 'target': [0, 0, 0], 'fov_deg': 12}"
#define SKY "'lights': [{'kind': 'environment', 'radiance': 1, 'visible': true}]"
#define WHITE "'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 1}]"

static double picture(const char *text, const koksma_integrator *in, int depth, int spp, double *error)
{
    return mean_of_text(text, "random", in->name, depth, spp, 16, error);
}

/* A ball of albedo 1/2, with ambient light 1/4 of the sky's. */
TEST_CASE(convex_bodies_reflect_the_sky)
{
    static const char *const text =
        "{" CAMERA ", 'ambient': 0.25, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 0.5}],'shapes': "
        "[{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1, 'material': 'm'}]," SKY "}";
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        const koksma__integrator_flags *flags = koksma_integrator_at(i)->flags;
        double error;
        const double mean = picture(text, koksma_integrator_at(i), -1, 16, &error);
        const double expected =
            flags->replace_scene ? 1 : 0.5 * ((flags->areas ? 1 : 0) + (flags->ambient ? 0.25 : 0));
        assert_that(fabs(mean - expected) <= 5 * error + 1e-5, "%s: %g +- %g, expected %g",
                    koksma_integrator_at(i)->name, mean, error, expected);
    }
}

/* A white corner of three walls: every path ends in the sky. Without light between surfaces it is darker. */
TEST_CASE(closed_furnaces_are_white)
{
    static const char *const text =
        "{'camera': {'eye': [3, 3, 3], 'target': [0.3, 0.3, 0.3], 'fov_deg': 10}, " WHITE
        ", 'shapes': [{'kind': 'rectangle', 'centre': [1, 0, 1], 'normal': [0, 1, 0], 'half': [1, 1], 'material': "
        "'m'},{'kind': 'rectangle', 'centre': [1, 1, 0], 'normal': [0, 0, 1], 'half': [1, 1], 'material': "
        "'m'},{'kind': 'rectangle', 'centre': [0, 1, 1], 'normal': [1, 0, 0], 'half': [1, 1], 'material': 'm'}]," SKY
        "}";
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        const koksma__integrator_flags *flags = koksma_integrator_at(i)->flags;
        double error;
        const double mean = picture(text, koksma_integrator_at(i), 40, 64, &error);
        const bool all = flags->followed & KOKSMA__LOBE_DIFFUSE;
        assert_that(mean <= 1 + 5 * error + 1e-5 && (!all || mean >= 1 - 5 * error - 1e-5),
                    "%s: %g +- %g in a white furnace", koksma_integrator_at(i)->name, mean, error);
    }
}

/* Inside a ball of radius 1 and albedo 0.8, with a point light of intensity 1 in its centre. Every wall gets 1
   directly, and all walls the same from each other, so the radiance is 0.8 / pi (1 + 0.8 + 0.8^2 + ...) = 4 / pi. */
TEST_CASE(closed_balls_add_up_all_bounces)
{
    static const char *const text =
        "{'camera': {'eye': [0.3, 0.2, 0.4], 'target': [0, 1, -0.2], 'fov_deg': 20}, 'materials': [{'name': 'm', "
        "'kind': 'lambert', 'albedo': 0.8}], 'shapes': [{'kind': 'sphere', 'centre': [0, 0, 0], 'radius': 1, "
        "'material': 'm'}], 'lights': [{'kind': 'point', 'centre': [0, 0, 0], 'intensity': 1}]}";
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        const koksma__integrator_flags *flags = koksma_integrator_at(i)->flags;
        double error;
        const double mean = picture(text, koksma_integrator_at(i), 64, 64, &error), direct = 0.8 / M_PI;
        const double expected = flags->replace_scene                     ? 0
                                : flags->followed & KOKSMA__LOBE_DIFFUSE ? 5 * direct
                                                                         : direct;
        assert_that(fabs(mean - expected) <= 5 * error + 1e-5, "%s: %g +- %g inside a ball, expected %g",
                    koksma_integrator_at(i)->name, mean, error, expected);
    }
}

/* Mirrors and glass show the sky to integrators that follow them; others see black. */
TEST_CASE(specular_bodies_show_the_sky)
{
    static const char *const materials[] = {"'kind': 'mirror', 'reflectance': 1", "'kind': 'dielectric', 'ior': 1.5"};
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        const koksma__integrator_flags *flags = koksma_integrator_at(i)->flags;
        for (size_t m = 0; m < 2; m++) {
            char text[1024];
            double error;
            snprintf(text, sizeof text,
                     "{" CAMERA ", 'materials': [{'name': 'm', %s}], 'shapes': [{'kind': 'rectangle', 'centre': [0, "
                     "0, 0], 'normal': [0, 0, 1], 'half': [2, 2], 'material': 'm'}]," SKY "}",
                     materials[m]);
            const double mean = picture(text, koksma_integrator_at(i), 40, 16, &error);
            const double expected = flags->followed & KOKSMA__LOBE_SPECULAR || flags->replace_scene ? 1 : 0;
            if (!(fabs(mean - expected) <= 5 * error + 1e-3)) { /* whitted cuts branches below 1/1000 */
                fail_msg("%s: %g +- %g with %s", koksma_integrator_at(i)->name, mean, error, materials[m]);
            }
        }
    }
}

/* ---- Pipelines ------------------------------------------------------------------------------------------------ */

/* The mean of a row of pixels by a pipeline that takes the picture. */
static double row_by(const koksma__frame *frame, const koksma__pipeline *pipeline)
{
    koksma__task_scratch scratch;
    koksma__group group;
    double sum = 0;
    const size_t capacity =
        koksma__whole_lanes(frame->sampler.most < KOKSMA__BLOCK ? KOKSMA__BLOCK : frame->sampler.most);
    assert_ok(koksma__task_scratch_init(frame, pipeline, capacity, false, &scratch));
    for (size_t pixel = 160; pixel < 176; pixel += group.count) {
        koksma__group_fill(frame, pixel, 176, &group);
        assert_ok(koksma__group_draw(frame, &group, KOKSMA__USE_PIXEL, true, &scratch.draw, scratch.values.film));
        assert_ok(pipeline->trace(frame, scratch.pipeline_scratch, &group, &scratch.values));
        for (size_t i = 0; i < group.start[group.count]; i++) {
            sum += (double)scratch.values.rgb[i * (size_t)frame->channels];
        }
    }
    koksma__task_scratch_fini(&scratch);
    return sum;
}

/* Compares all pipelines that take the picture; how many there were beside the best. */
static size_t compare(const koksma_scene *scene, const koksma_integrator *in, const char *what)
{
    koksma__frame frame;
    const koksma__pipeline *best = NULL;
    size_t compared = 0;
    koksma_render_options options = options_of(scene, "jittered", in->name, 4, 16);
    const koksma__integrator_flags *flags = in->flags;
    if (scene->medium.is_there && !flags->media && !flags->replace_scene) {
        assert_int_equal(koksma__frame_open(scene, &options, NULL, &frame), KOKSMA_ARGUMENT);
        koksma__frame_close(&frame);
        return 0;
    }
    assert_ok(koksma__frame_open(scene, &options, NULL, &frame));
    assert_ok(koksma__pipeline_for(&frame, &best));
    const double mean = row_by(&frame, best);
    for (size_t p = 0; koksma__pipelines[p]; p++) {
        if (koksma__pipelines[p] != best && koksma__pipelines[p]->takes(&frame)) {
            const double other = row_by(&frame, koksma__pipelines[p]);
            assert_that(fabs(mean - other) <= 1e-5 * fabs(mean) + 1e-5, "%s by %s: %g, by %s: %g", what, best->name,
                        mean, koksma__pipelines[p]->name, other);
            compared++;
        }
    }
    koksma__frame_close(&frame);
    return compared;
}

/* The middle of a floor of albedo 0.5, seen from the side, below a disk of radius 0.75 at height 1, whose form factor is
   r^2 / (r^2 + 1) = 0.36; a wall beyond the floor's edge, which the floor would light, adds nothing. */
#define FLOOR                                                                                                        \
    "{'camera': {'eye': [0, 0.5, 4], 'target': [0, 0, 0], 'fov_deg': 0.02}, 'ambient': 3, 'materials': [{'name': "   \
    "'m', 'kind': 'lambert', 'albedo': 0.5}], 'shapes': [{'kind': 'rectangle', 'centre': [0, 0, 0], 'normal': [0, "  \
    "1, 0], 'half': [5, 5], 'material': 'm'}"
#define WALL ", {'kind': 'rectangle', 'centre': [0, 0, -5], 'normal': [0, 0, 1], 'half': [5, 5], 'material': 'm'}"
#define DISK "'kind': 'disk', 'centre': [0, 1, 0], 'radius': 0.75, "
#define LIT "], 'lights': [{" DISK "'normal': [0, -1, 0], 'radiance': 2, 'visible': true}]"

static double floor_by(const char *rest, const char *integrator, int depth, double *error)
{
    char text[2048];
    snprintf(text, sizeof text, "%s%s}", FLOOR, rest);
    return picture(text, koksma_integrator_find(integrator), depth, 1024, error);
}

TEST_CASE(direct_light_is_the_form_factor)
{
    double error;
    for (int depth = -1; depth <= 20; depth += 7) { /* no diffuse bounce, whatever the depth */
        const double alone = floor_by(LIT, "direct", depth, &error);
        assert_mean(alone, error, 0.5 * 2 * 0.36);
        const double beside_wall = floor_by(WALL LIT, "direct", depth, &error);
        assert_mean(beside_wall, error, 0.5 * 2 * 0.36);
    }
}

/* The sky but for the disk, which is a surface or a light; lights, the sky's radiance, ambient light, materials and the
   limit of samples count for nothing. At the edge of a wall without end half the sky is left. */
TEST_CASE(ambient_occlusion_is_the_rest_of_the_sky)
{
    static const char *const disks[] = {
        LIT, ", {" DISK "'normal': [0, -1, 0], 'material': 'm'}]",
        ", {" DISK "'normal': [0, 1, 0], 'material': 'm'}], 'lights': [{'kind': 'environment', 'radiance': 7, "
        "'visible': true}, {'kind': 'point', 'centre': [1, 1, 1], 'intensity': 3}]",
        LIT ", 'clamp': 0.2"};
    double error;
    for (size_t i = 0; i < sizeof disks / sizeof *disks; i++) {
        const double seen = floor_by(disks[i], "ambient-occlusion", -1, &error);
        assert_mean(seen, error, 1 - 0.36);
    }
    const double wall =
        floor_by(", {'kind': 'plane', 'centre': [0, 0, -0.01], 'normal': [0, 0, 1], 'material': 'm'}]",
                 "ambient-occlusion", -1, &error);
    assert_near(wall, 0.5, 4 * error + 0.005);
    assert_true(floor_by("]", "ambient-occlusion", 0, &error) == 0); /* no ray looks at the sky */
}

/* Ambient occlusion needs no light, so that a scene without any is as intended. */
TEST_CASE(warnings_of_light_are_for_integrators_with_light)
{
    koksma_scene *scene = scene_of("{'camera': {'eye': [0, 0, 4], 'target': [0, 0, 0], 'fov_deg': 30}, 'materials': "
                                   "[{'name': 'm', 'kind': 'mirror', 'reflectance': 1}], 'shapes': [{'kind': "
                                   "'sphere', 'centre': [0, 0, 0], 'radius': 1, 'material': 'm'}]}");
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        koksma_render_options options;
        koksma_render_options_init(&options, scene);
        options.integrator = koksma_integrator_at(i);
        char text[256];
        const bool warned = koksma_render_warning(scene, &options, 0, text, sizeof text);
        assert_int_equal(warned, strcmp(options.integrator->name, "ambient-occlusion") != 0);
        assert_true(!warned || strstr(text, "the picture will be black"));
    }
    koksma_scene_close(scene);
}

/* A disk of the material, under a rectangle that no ray sees: grey and still, through a lens, in colour, or moving.
 */
enum { PLAIN, LENS, COLOUR, MOTION, N_VARIANTS };

static koksma_scene *disk_of(const koksma__bsdf *bsdf, int variant)
{
    char fields[1024], text[2048];
    kind_fields(&bsdf->kind, 3, fields, sizeof fields);
    snprintf(text, sizeof text,
             "{" CAMERA ", 'materials': [{'name': 'm', 'kind': '%s'%s%s}], 'shapes': [{'kind': 'disk', 'centre': [0, "
             "0, 0], 'normal': [0, 0, 1], 'radius': 1, 'material': 'm'}], 'lights': [{'kind': "
             "'rectangle', 'centre': [0, 1, 3], 'facing': [0, 0, 0], 'half': [0.5, 0.5], 'strength': 1}]}",
             bsdf->kind.name,
             bsdf->diffuse & KOKSMA__ALBEDO ? ", 'albedo': 0.01"
             : bsdf->diffuse                ? ", 'albedos': [0.3, 0.6], 'period': 0.2"
                                            : "",
             fields);
    koksma_scene *scene = scene_of(text);
    koksma__material *m = &scene->materials[0];
    for (const koksma__parameter *p = bsdf->kind.parameters; p && p->name; p++) {
        double *values = (double *)(void *)((char *)m + p->at);
        if (p->type == KOKSMA__COLOUR) {
            values[0] = values[1] = values[2] = 0.5 * values[0];
        }
    }
    scene->grey = variant != COLOUR;
    scene->camera.lens_radius = variant == LENS ? 0.3 : 0;
    scene->camera.focus_distance = 2;
    scene->camera.motion[0] = variant == MOTION ? 0.5 : 0;
    scene->moves = variant == MOTION;
    return scene;
}

/* All pipelines that take a picture agree but for rounding: of all shipped scenes, and of all materials. */
TEST_CASE(pipelines_agree)
{
    size_t compared = 0;
    for (size_t i = 0; koksma_integrator_at(i); i++) {
        for (size_t s = 0; koksma_scene_name_at(s); s++) {
            koksma_scene *scene;
            if (!koksma_scene_open(koksma_scene_name_at(s), &scene)) { /* the bunny's files aren't ours to ship */
                compared += compare(scene, koksma_integrator_at(i), koksma_scene_name_at(s));
                koksma_scene_close(scene);
            }
        }
        for (size_t b = 0; koksma__bsdfs[b]; b++) {
            for (int variant = 0; variant < N_VARIANTS; variant++) {
                koksma_scene *scene = disk_of(koksma__bsdfs[b], variant);
                compared += compare(scene, koksma_integrator_at(i), koksma__bsdfs[b]->kind.name);
                koksma_scene_close(scene);
            }
        }
    }
    assert_true(compared > 0);
}

static koksma_image picture_of(const koksma_scene *scene, const koksma_integrator *in)
{
    koksma_render_options options = options_of(scene, "jittered", in->name, 1, 6);
    koksma_image image;
    options.depth = 2;
    assert_ok(koksma_render(scene, &options, NULL, &image));
    return image;
}

static bool takes(const koksma_integrator *in, const koksma_scene *scene)
{
    const koksma__integrator_flags *flags = in->flags;
    return !scene->medium.is_there || flags->media || flags->replace_scene;
}

static void compare_pictures(const koksma_scene *scene, size_t i, const koksma_image *alone, const char *before)
{
    koksma_image image = picture_of(scene, koksma_integrator_at(i));
    const size_t size = (size_t)(image.width * image.height * image.channels) * sizeof *image.pixels;
    assert_that(memcmp(image.pixels, alone->pixels, size) == 0, "%s renders another picture after %s",
                koksma_integrator_at(i)->name, before);
    koksma_image_fini(&image);
}

/* What a scene keeps from one image to the next is its own: of all shipped scenes, every integrator renders the same
   picture after any other one as it does in a scene opened for it. */
TEST_CASE(order_does_not_matter)
{
    enum { MOST = 64 };
    size_t scenes = 0;
    for (size_t s = 0; koksma_scene_name_at(s); s++) {
        const char *name = koksma_scene_name_at(s);
        koksma_scene *scene;
        koksma_image alone[MOST] = {{0}};
        if (koksma_scene_open(name, &scene)) { /* the bunny's files aren't ours to ship */
            continue;
        }
        koksma_scene_close(scene);
        for (size_t i = 0; koksma_integrator_at(i); i++) {
            assert_true(i < MOST);
            assert_ok(koksma_scene_open(name, &scene));
            if (takes(koksma_integrator_at(i), scene)) {
                alone[i] = picture_of(scene, koksma_integrator_at(i));
            }
            for (size_t k = 0; alone[i].pixels && k < i; k++) {
                if (alone[k].pixels) {
                    compare_pictures(scene, k, &alone[k], koksma_integrator_at(i)->name);
                    compare_pictures(scene, i, &alone[i], koksma_integrator_at(k)->name);
                }
            }
            koksma_scene_close(scene);
        }
        for (size_t i = 0; i < MOST; i++) {
            koksma_image_fini(&alone[i]);
        }
        scenes++;
    }
    assert_true(scenes > 10);
}
