/* SPDX-License-Identifier: Apache-2.0 */
/* The images of a scene: textures and environments. The scene owns them; its materials and lights point to them. */
#ifndef KOKSMA_RENDER_SCENE_IMAGES_H
#define KOKSMA_RENDER_SCENE_IMAGES_H

#include "image/formats.h"
#include "render/description.h"

/* How an image is read: which part of it, and what its levels v become: first v^gamma (0: they stay), then, if `average`,
   the mean of the channels, then tint v + plus, where negative levels become 0 if `plus` is not 0. If upside_down, its
   last row becomes the first. If `border`, a frame of one pixel, which was black, is put around it. */
typedef struct koksma__image_use {
    koksma__image_part part;
    double tint[3];
    bool upside_down, average, border;
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

/* Adds what koksma_image_remark said of an image to the scene's warnings. Error: MEMORY. */
koksma_status koksma__scene_image_remark(koksma_scene *scene, const char *name, const char *text);

/* Frees an image, unless a material or light still uses it. image may be NULL. */
void koksma__scene_image_drop(koksma_scene *scene, const koksma_image *image);

/* The mean colour, with pixels clamped to [0, 1] if `clamped`, else with negative ones as 0. Each is computed once. */
void koksma__scene_image_mean(const koksma_scene *scene, const koksma_image *image, bool clamped, double mean[3]);

/* The images' part of the scene's hash, because a scene with other pixels is another scene. It covers every image that
   the scene owns, and depends on where the images are shown. */
uint64_t koksma__scene_images_hash(const koksma_scene *scene);

void koksma__scene_images_fini(koksma_scene *scene);

#endif
