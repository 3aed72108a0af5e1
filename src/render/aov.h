/* SPDX-License-Identifier: Apache-2.0 */
/* Further images of a render (koksma_render_aovs): parts of its light, object numbers, halves of its samples. */
#ifndef KOKSMA_RENDER_AOV_H
#define KOKSMA_RENDER_AOV_H

#include "render/frame.h"

typedef enum koksma__aov_kind {
    KOKSMA__AOV_LIGHT, /* light that was reflected `first` to `last` times */
    KOKSMA__AOV_ID,
    KOKSMA__AOV_HALF /* the samples first, first + 2, ... of each pixel */
} koksma__aov_kind;

typedef struct koksma__aov {
    koksma__aov_kind kind;
    int first, last;
    koksma_image *image;
} koksma__aov;

struct koksma__aovs {
    size_t n;
    bool has_id;
    size_t n_parts; /* number of AOVs of the kind KOKSMA__AOV_LIGHT */
    koksma__aov items[KOKSMA_MAX_AOVS];
};

/* Finds the meaning of the names and allocates the images. Errors: MEMORY. */
koksma_status koksma__aovs_init(const koksma__frame *frame, koksma_aovs *images, koksma__aovs *out);

/* Allocates the AOVs' values of a group's samples. Errors: MEMORY. */
koksma_status koksma__aov_values_init(const koksma__aovs *aovs, size_t capacity, koksma__values *values);

/* Adds the light that the vertices gained since `before` to the AOVs of light that was reflected `reflections`
   times. */
void koksma__aov_add(const koksma__frame *frame, const koksma__vertices *v, const koksma__lanes before[3],
                     int reflections, koksma__values *values);

/* Stores the numbers of the objects that the rays hit first. */
void koksma__aov_note(const koksma__frame *frame, const koksma__vertices *v, koksma__values *values);

/* Multiplies channel k of sample i in all AOVs of the kind KOKSMA__AOV_LIGHT by the factor by which the sample was
   clamped. */
void koksma__aov_clamp(const koksma__aovs *aovs, koksma__values *values, size_t i, int k, float factor);

/* In each AOV of object numbers, sets the pixel to the number of the object that most of the samples first .. end - 1
   hit; sorts the samples' numbers. */
void koksma__aov_ids(const koksma__frame *frame, const koksma__values *values, size_t pixel, size_t first,
                     size_t end);

/* Adds the samples of a group to the images. weights: those of the filter; NULL: all are 1. */
void koksma__aov_film(const koksma__frame *frame, const koksma__group *group, const koksma__values *values,
                      const float *weights);

#endif
