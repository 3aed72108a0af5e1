/* SPDX-License-Identifier: Apache-2.0 */
/* Which splits of adaptive sampling are needless, in pixels whose values change at one known place of one space. */
#include <koksma/adaptive.h>

#include "rendering.h"

/* One edge across one space, at `edge` along the axis `axis` of its square: a split is needless where the edge does
   not cross the stratum, and nowhere else. In the other spaces the same splits come in the same order. */
static void check_marks(const koksma_scene *scene, const char *method, const char *where, int axis, double edge)
{
    koksma_render_options options = options_of(scene, "jittered", "distribution", 64, 1);
    koksma_adaptive_options adaptive;
    koksma_adaptive_report report;
    koksma_strata strata = {0};
    koksma_layers layers;
    assert_ok(koksma_adaptive_parse(method, &adaptive));
    adaptive.probes = 128; /* a quarter of a stratum, the least part here, is missed with probability 1e-16 */
    adaptive.strata = &strata;
    assert_ok(koksma_render_adaptive(scene, &options, &adaptive, NULL, &layers, &report));
    size_t needless = 0, needed = 0, k = 0;
    while (k < strata.n_spaces && strcmp(strata.spaces[k].name, where) != 0) {
        k++;
    }
    assert_true(k < strata.n_spaces);
    const koksma_space *space = &strata.spaces[k];
    for (size_t i = 0; i < space->n_splits; i++) {
        const koksma_split *s = &space->splits[i];
        const double from = axis ? s->y : s->x, width = axis ? s->height : s->width;
        if (s->needless == (from < edge && edge < from + width)) {
            fail_msg("%s: %s: split %zu, %g to %g, is %s", method, where, i, from, from + width,
                     s->needless ? "needless" : "needed");
        }
        needless += s->needless;
        needed += !s->needless;
        assert_true(i == 0 || s->level >= s[-1].level);
        for (size_t other = 0; other < strata.n_spaces; other++) {
            assert_int_equal(strata.spaces[other].splits[i].needless, s->needless);
        }
    }
    assert_true(needed >= 8 && (uint64_t)needless == report.needless && needless + needed == report.splits);
    koksma_strata_fini(&strata);
    koksma_layers_fini(&layers);
}

static const char *const splitting[] = {"hierarchical:levels=1", "hierarchical:levels=2",
                                        "hierarchical:levels=2,pairing=shuffled,reuse=fresh", "selective:levels=1"};

/* The rectangle's left side is at 3.25 / 8 of the one pixel, in focus for every place on the lens. */
TEST_CASE(needless_splits_miss_an_edge_in_the_pixel)
{
    koksma_scene *scene = scene_of(
        "{'camera': {'eye': [0, 0, 4], 'target': [0, 0, 0], 'fov_deg': 90, 'lens_radius': 0.1, 'focus_distance': "
        "4},'ambient': 0.8, 'background': 0, 'materials': [{'name': 'm', 'kind': 'lambert', 'albedo': 1}],'shapes': "
        "[{'kind': 'rectangle', 'centre': [4.25, 0, 0], 'normal': [0, 0, 1], 'half': [5, 9],'material': 'm'}]}");
    for (size_t i = 0; i < sizeof splitting / sizeof *splitting; i++) {
        check_marks(scene, splitting[i], "pixel", 0, 3.25 / 8);
    }
    koksma_scene_close(scene);
}

/* The blocker hides the light's left up to 3.25 / 8 of its width from a ground of almost one point; the first
   coordinate on a light that looks down runs to the left. */
TEST_CASE(needless_splits_miss_an_edge_in_the_light)
{
    koksma_scene *scene =
        scene_of("{'camera': {'eye': [0, 1, 4], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': 'm', "
                 "'kind': 'lambert', 'albedo': 0.9}], 'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': "
                 "[0, 1, 0], 'material': 'm'},{'kind': 'rectangle', 'centre': [-5.09375, 5, 0], 'normal': [0, -1, "
                 "0], 'half': [5, 5],'material': 'm'}], 'lights': [{'kind': 'rectangle', 'centre': [0, 10, "
                 "0],'normal': [0, -1, 0], 'half': [1, 1], 'radiance': 40}]}");
    for (size_t i = 0; i < sizeof splitting / sizeof *splitting; i++) {
        check_marks(scene, splitting[i], "light", 0, 1 - 3.25 / 8);
    }
    koksma_scene_close(scene);
}
