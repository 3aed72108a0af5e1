/* SPDX-License-Identifier: Apache-2.0 */
/* What lights of every kind are thought to give, when one of them is chosen, against what they do give. */
#include "render/lights/lights.h"
#include "render/pipelines/batch.h"
#include "rendering.h"

/* A small disk overhead and another light, which reflect the same: pi 10^-4 L / pi is intensity / pi, irradiance
   / pi, or the radiance of the sky. By power the disk's is pi A L, a point's 4 pi I and a sphere's 4 pi times that of
   the disk that it shows, which are four times as much; one that is far away has the power of what it reflects. */
static void choices_are_in_proportion(void **state)
{
    (void)state;
    static const struct {
        const char *light;
        double by_power;
    } cases[] = {
        {"'kind': 'disk', 'centre': [0, 1, 0], 'normal': [0, -1, 0], 'radius': 0.02, 'radiance': 250", 0.5},
        {"'kind': 'rectangle', 'centre': [0, 1, 0], 'normal': [0, -1, 0], 'half': [0.01, 0.01], 'radiance': "
         "785.398163",
         0.5},
        {"'kind': 'point', 'centre': [0, 1, 0], 'intensity': 0.314159265", 0.2},
        {"'kind': 'sphere', 'centre': [0, 1, 0], 'radius': 0.01, 'radiance': 1000", 0.2},
        {"'kind': 'directional', 'direction': [0, -1, 0], 'irradiance': 0.314159265", 0.5},
        {"'kind': 'environment', 'radiance': 0.1", 0.5},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1024];
        snprintf(text, sizeof text,
                 "{'camera': {'eye': [0.3, 0.5, 0.3], 'target': [0, 0, 0], 'fov_deg': 0.01},'materials': [{'name': "
                 "'m', 'kind': 'lambert', 'albedo': 1}],'shapes': [{'kind': 'plane', 'centre': [0, 0, 0], 'normal': "
                 "[0, 1, 0], 'material': 'm'}],'lights': [{'kind': 'disk', 'centre': [0, 1, 0], 'normal': [0, -1, "
                 "0], 'radius': 0.01, 'radiance': 1000}, {%s}]}",
                 cases[i].light);
        koksma_scene *scene = scene_of(text);
        koksma__lights lights;
        assert_ok(koksma__lights_init(scene, &lights));
        const float p[3] = {0, 0, 0}, n[3] = {0, 1, 0};
        float estimates[KOKSMA__MAX_BATCH_LIGHTS];
        koksma__batch()->estimate(lights.estimates, p, n, estimates);
        assert_near((double)estimates[0], 0.1, 1e-5); /* the reflected luminance itself */
        assert_near((double)estimates[1], 0.1, 1e-5);
        assert_near((double)lights.cdf[1], cases[i].by_power, 1e-5);
        koksma__lights_fini(&lights);
        /* and it is what the pictures show */
        koksma_render_options options = options_of(scene, "random", "distribution", 64, 8);
        double error;
        const double mean = mean_of(scene, &options, &error);
        assert_near(mean, 0.2, 4 * error + 1e-3);
        koksma_scene_close(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(choices_are_in_proportion),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
