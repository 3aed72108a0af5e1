/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The images of a scene: textures and environments. The scene owns them; its materials and lights point to them.
 *
 * The colour of an image at texture coordinates is interpolated bilinearly between the four nearest pixels, whose
 * centres are at half-integers, or taken from the nearest pixel. Beyond its edge an image is repeated, mirrored, or
 * clamped to the edge. The functions are inline because wavefront.c, the mesh lights and the module that traces meshes,
 * which needs the alpha of triangles, all use them.
 */
#ifndef KOKSMA_RENDER_SCENE_IMAGES_H
#define KOKSMA_RENDER_SCENE_IMAGES_H

#include "image/formats.h"
#include "render/description.h"
#include <math.h>
#include <stddef.h>

/* What becomes of the channels of an image. */
typedef enum koksma__image_average { KOKSMA__NO_AVERAGE, KOKSMA__MEAN, KOKSMA__LUMINANCE } koksma__image_average;

/* How an image is read: which part of it, and what its levels v become: first v^gamma (0: they stay), then one channel,
   if `average` is not 0, then tint v + plus, where negative levels become 0 if `plus` is not 0. If upside_down, its
   last row becomes the first. If `border`, a frame of one pixel, which was black, is put around it. */
typedef struct koksma__image_use {
    koksma__image_part part;
    double tint[3];
    bool upside_down, border;
    koksma__image_average average;
    double plus[3], gamma;
} koksma__image_use;

#define KOKSMA__PLAIN_IMAGE ((koksma__image_use){.part = KOKSMA__IMAGE_COLOURS, .tint = {1, 1, 1}})

/* Reads the image in a file that the scene names, or finds it if it was read for the same use before. An image of
   which the file has no such part has no pixels. Errors: those of koksma__image_read; MALFORMED (a number in it is not
   usable; the scene's images take too much memory, koksma__is_refused). */
koksma_status koksma__scene_image(koksma_scene *scene, const char *path, const koksma__image_use *use,
                                  koksma_image **out);

/* The same for an image within a model's file, which has the name for messages. The bytes stay where they are as long
   as images are read. */
koksma_status koksma__scene_image_within(koksma_scene *scene, const char *name, const unsigned char *bytes,
                                         size_t size, const koksma__image_use *use, koksma_image **out);

/* Moves an image into the scene. On failure *from is unchanged. Errors: MALFORMED (too much memory), MEMORY. */
koksma_status koksma__scene_image_keep(koksma_scene *scene, koksma_image *from, koksma_image **out);

/* Frees an image, unless a material or light still uses it. image may be NULL. */
void koksma__scene_image_drop(koksma_scene *scene, const koksma_image *image);

/* The mean colour, with pixels clamped to [0, 1] if `clamped`, else with negative ones as 0. Each is computed once. */
void koksma__scene_image_mean(const koksma_scene *scene, const koksma_image *image, bool clamped, double mean[3]);

/* The images' part of the scene's hash, because a scene with other pixels is another scene. It covers every image that
   the scene owns, and depends on where the images are shown. */
uint64_t koksma__scene_images_hash(const koksma_scene *scene);

void koksma__scene_images_fini(koksma_scene *scene);

/* ---- Textures --------------------------------------------------------------------------------------------------- */

/* Finds the two pixels around the coordinate x in an image n pixels wide: `pair` gets their indices, wrapped, and the
   weight of the second pixel is returned. */
static inline float koksma__texture_split(float x, int n, koksma__wrap wrap, size_t pair[2])
{
    /* mirrored coordinates go from 0 to 1 and back */
    const float half = 0.5f * x, turn = 2 * (half - floorf(half));
    const float turns = wrap == KOKSMA__WRAP_REPEAT   ? x - floorf(x)
                        : wrap == KOKSMA__WRAP_MIRROR ? (turn > 1 ? 2 - turn : turn)
                        : x > 0                       ? fminf(x, 1)
                                                      : 0;
    /* a coordinate that is not finite, as those of a mesh may be, has no place: it counts as 0 */
    const float place = (turns >= 0 ? turns : 0) * (float)n - 0.5f, down = floorf(place);
    const int first = (int)down;
    const bool repeated = wrap == KOKSMA__WRAP_REPEAT;
    pair[0] = (size_t)(repeated ? (first + n) % n : first < 0 ? 0 : first < n ? first : n - 1);
    pair[1] = (size_t)(repeated ? (first + 1 + n) % n : first + 1 < n ? first + 1 : n - 1);
    return place - down;
}

/* An image over the plane: (0, 0) is the lower left corner of its lower left pixel, (1, 1) the upper right corner of
   the upper right pixel. rgb gets the colour, clamped to `most`; pixels that are NaN count as 0. */
static inline void koksma__texture(const koksma_image *image, const koksma__mapping *m, float u, float v, float most,
                                   float rgb[3])
{
    size_t xs[2], ys[2];
    const size_t channels = (size_t)image->channels, width = (size_t)image->width;
    if (m->moved) {
        const float s = m->matrix[0] * u + m->matrix[1] * v + m->matrix[2];
        v = m->matrix[3] * u + m->matrix[4] * v + m->matrix[5];
        u = s;
    }
    float x = koksma__texture_split(u, image->width, m->wrap[0], xs);
    float y = koksma__texture_split(1 - v, image->height, m->wrap[1], ys);
    if (m->nearest) {
        x = x < 0.5f ? 0 : 1;
        y = y < 0.5f ? 0 : 1;
    }
    const float weights[4] = {(1 - x) * (1 - y), x * (1 - y), (1 - x) * y, x * y};
    for (size_t k = 0; k < 3; k++) {
        rgb[k] = 0;
        for (size_t i = 0; i < 4; i++) {
            const float value = image->pixels[(ys[i / 2] * width + xs[i % 2]) * channels + k % channels];
            rgb[k] += value > 0 ? weights[i] * (value < most ? value : most) : 0;
        }
    }
}

#endif
