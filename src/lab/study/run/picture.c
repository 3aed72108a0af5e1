/* SPDX-License-Identifier: Apache-2.0 */
/* The renders of a study. A picture's pattern and variant become options of the renderer; variants.c calls the
   renderer or the adaptive method. A picture's seed is the hash of a text that names everything the picture depends
   on, so that a job has the same random numbers in every run, on any thread, and in any plan. */
#include "study/run/picture.h"

#include <stdarg.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/hash.h"
#include "core/status.h"
#include "study/plan/image_patterns.h"

enum { LONGEST_KEY = 8192 }; /* capacity for a key: a path, a pattern, options */

uint64_t koksma__job_seed(const char *format, ...)
{
    char key[LONGEST_KEY];
    va_list arguments;
    va_start(arguments, format);
    koksma__vsnprintf(key, sizeof key, format, arguments);
    va_end(arguments);
    return koksma__hash(key, strlen(key));
}

void koksma__block_size(const koksma__image_block *block, const koksma__study_scene *scene, int *width, int *height)
{
    *width = block->width ? block->width : scene->width;
    *height = block->height ? block->height : scene->height;
}

koksma_status koksma__picture_set(const koksma__study_scene *scene, const koksma__picture *picture,
                                  koksma__variant *variant)
{
    koksma_render_options *options = &variant->render;
    koksma_render_options_init(options, scene->scene);
    koksma_status status = koksma__image_pattern_set(picture->pattern, options);
    status = status ? status : koksma__variant_apply(picture->variant, picture->of_reference, variant);
    options->spp = (int)picture->spp;
    options->seed = picture->seed;
    options->width = picture->width;
    options->height = picture->height;
    return status;
}

static koksma_status render_elsewhere(const koksma__study_scene *scene, const koksma__picture *picture,
                                      const koksma_run *run, koksma_image *out)
{
    const koksma_rank_picture asked = {scene->name,    picture->pattern, (int)picture->spp,
                                       picture->width, picture->height,  picture->seed >> 33};
    *out = (koksma_image){0};
    const char kept = koksma__call_begin();
    koksma_status status =
        koksma__call_end(kept, scene->render(scene->render_context, &asked, run, out), "koksma_rank_options.render");
    if (!status && picture->width && (out->width != picture->width || out->height != picture->height)) {
        status =
            koksma__fail(KOKSMA_IMPOSSIBLE, "%s: the renderer made a picture of %d x %d pixels instead of %d x %d",
                         picture->pattern, out->width, out->height, picture->width, picture->height);
    }
    if (status) {
        koksma_image_fini(out);
    }
    return status;
}

koksma_status koksma__study_render(const koksma__study_scene *scene, const koksma__picture *picture,
                                   const koksma_run *run, koksma_image *out)
{
    if (scene->render) {
        return render_elsewhere(scene, picture, run, out);
    }
    koksma__variant variant;
    const koksma_status status = koksma__picture_set(scene, picture, &variant);
    return status ? status : koksma__variant_render(scene->scene, &variant, run, out);
}
