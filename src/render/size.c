/* SPDX-License-Identifier: Apache-2.0 */
/*
 * How many bytes a picture takes, before it is made: what the film and an image-wide pattern hold for all pixels.
 */
#include "core/status.h"
#include "render/film.h"

koksma_render_size koksma_render_size_of(const koksma_scene *scene, const koksma_render_options *options,
                                         bool all_layers)
{
    KOKSMA__REQUIRE_OR((koksma_render_size){0}, scene, options);
    KOKSMA__REQUIRE_OR((koksma_render_size){0}, options->integrator, options->pattern.pattern);
    const uint64_t pixels = (uint64_t)options->width * (uint64_t)options->height;
    const koksma__use_list uses = koksma__frame_uses(scene, options);
    const int channels = scene->grey ? 1 : 3;
    const bool image = options->scope == KOKSMA_SCOPE_IMAGE;
    return (koksma_render_size){
        .film = koksma__film_size(pixels, channels, all_layers, options->splat),
        .samples = image ? koksma__image_samples_size(options, &uses) : 0,
        .file =
            all_layers ? koksma__film_size(pixels, channels, true, false) : pixels * (size_t)channels * sizeof(float),
    };
}
