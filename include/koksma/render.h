/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A distribution ray tracer that samples with any pattern.
 *
 *     koksma_scene *scene;
 *     koksma_render_options options;
 *     koksma_image image;
 *     if (!koksma_scene_open("ball", &scene)) {
 *         koksma_render_options_init(&options, scene);
 *         koksma_pattern_spec("n-rooks", &options.pattern);
 *         koksma_render(scene, &options, NULL, &image);
 *     }
 *
 * Each pixel spends its samples on named uses: `pixel` (the place in the pixel), and `light` of each luminaire.
 * Each use gets a 2D set of points of its own, drawn afresh for every pixel.
 */
#ifndef KOKSMA_RENDER_H
#define KOKSMA_RENDER_H

#include <koksma/image.h>
#include <koksma/koksma.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct koksma_scene koksma_scene;

/* The name of shipped scene i; NULL past the end. */
KOKSMA_API const char *koksma_scene_name_at(size_t i);

/* Opens a shipped scene by its name, or a JSON file when the text has a '/' or ends in ".json".
   Errors: UNKNOWN (no such name), MISSING, MALFORMED (with file, line, field and reason), MEMORY. */
KOKSMA_API koksma_status koksma_scene_open(const char *name_or_path, koksma_scene **out);
KOKSMA_API void koksma_scene_close(koksma_scene *scene);

/* What it shows, in its own words; may be empty. */
KOKSMA_API const char *koksma_scene_title(const koksma_scene *scene);

/* 64 bits of the scene's text: it changes when the file changes. */
KOKSMA_API uint64_t koksma_scene_hash(const koksma_scene *scene);

/* How the 2D patterns of a pixel's uses are put together, sample by sample. */
typedef enum koksma_pairing {
    KOKSMA_PAIRING_SHUFFLED, /* by independent random permutations: uncorrelated jitter (Cook 1986; Shirley 1991) */
    KOKSMA_PAIRING_ALIGNED   /* in the order in which the pattern gives them */
} koksma_pairing;

/* "shuffled", "aligned"; NULL past the end. */
KOKSMA_API const char *koksma_pairing_name(koksma_pairing pairing);

typedef struct koksma_render_options {
    koksma_spec pattern; /* of every use */
    int spp;             /* samples a pixel: the n of the pattern */
    int width, height;
    uint64_t seed;
    koksma_pairing pairing;
} koksma_render_options;

enum { KOKSMA_MAX_SPP = 1 << 20 };

/* n-rooks, 16 samples a pixel, the scene's own size, seed 0, shuffled. */
KOKSMA_API void koksma_render_options_init(koksma_render_options *options, const koksma_scene *scene);

/* Rays that one sample casts: one from the camera, and one to each luminaire. */
KOKSMA_API int koksma_scene_rays_per_sample(const koksma_scene *scene);

/* Renders; allocates out. Equal arguments give equal bits on any number of threads. run may be NULL.
   Errors: ARGUMENT, what the pattern says about spp (N, IMPOSSIBLE, …), MEMORY, INTERRUPTED. */
KOKSMA_API koksma_status koksma_render(const koksma_scene *scene, const koksma_render_options *options,
                                       const koksma_run *run, koksma_image *out);

#ifdef __cplusplus
}
#endif

#endif
