/* SPDX-License-Identifier: Apache-2.0 */
/* Renders a scene that ships with Koksma: ball PATTERN FILE. */
#include <koksma/render.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    koksma_scene *scene = NULL;
    koksma_render_options options;
    koksma_image image = {0};
    int failed = koksma_scene_open("ball", &scene);
    if (!failed) {
        koksma_render_options_init(&options, scene);
        options.width = 64;
        options.height = 64;
        failed = koksma_pattern_spec(argc > 1 ? argv[1] : "n-rooks", &options.pattern) ||
                 koksma_render(scene, &options, NULL, &image) ||
                 koksma_image_write(argc > 2 ? argv[2] : "ball.pfm", &image, NULL);
    }
    if (failed) {
        fprintf(stderr, "ball: %s\n", koksma_error_text());
    }
    koksma_image_fini(&image);
    koksma_scene_close(scene);
    return failed;
}
