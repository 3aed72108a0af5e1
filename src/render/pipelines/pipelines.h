/* SPDX-License-Identifier: Apache-2.0 */
/* The table of pipelines, which trace the samples of an image, and the choice among them (pipelines.c). */
#ifndef KOKSMA_RENDER_PIPELINES_PIPELINES_H
#define KOKSMA_RENDER_PIPELINES_PIPELINES_H

#include "render/frame.h"

/* All pipelines, terminated by NULL. */
extern const koksma__pipeline *const koksma__pipelines[];

/* Chooses the pipeline for the image (wavefront accepts every image) and prepares the frame for it. Errors:
   MEMORY. */
koksma_status koksma__pipeline_for(koksma__frame *frame, const koksma__pipeline **out);

#define PIPELINE(name) extern const koksma__pipeline koksma__pipeline_##name;
#include "render/pipelines/pipelines.def"
#undef PIPELINE

#endif
