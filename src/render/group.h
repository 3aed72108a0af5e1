/* SPDX-License-Identifier: Apache-2.0 */
/* Groups of pixels, and the scratch of the task that renders them. */
#ifndef KOKSMA_RENDER_GROUP_H
#define KOKSMA_RENDER_GROUP_H

#include "render/frame.h"

/* Makes a group of the pixels from `first` on and below `end`: at least one pixel, and as many as have at most
   frame->together samples in all. */
void koksma__group_fill(const koksma__frame *frame, size_t first, size_t end, koksma__group *group);

/* Draws the sample pairs of one use for all samples of a group, one pixel after the other; with on_film each pixel's
   position is added. The pairs are padded with copies up to a multiple of KOKSMA__LANE_STEP. */
koksma_status koksma__group_draw(const koksma__frame *frame, const koksma__group *group, uint32_t use, bool on_film,
                                 koksma__sample_scratch *scratch, float *pairs);

/* Scratch in which a task draws its samples and computes their values. */
typedef struct koksma__task_scratch {
    const koksma__pipeline *pipeline;
    void *pipeline_scratch;
    koksma__sample_scratch draw;
    koksma__values values;
} koksma__task_scratch;

/* Allocates memory for groups of `capacity` samples; if all_layers, also for albedo, normal and depth. The caller
   must call fini even after a failure. Errors: MEMORY. */
koksma_status koksma__task_scratch_init(const koksma__frame *frame, const koksma__pipeline *pipeline, size_t capacity,
                                        bool all_layers, koksma__task_scratch *scratch);
void koksma__task_scratch_fini(koksma__task_scratch *scratch);

#endif
