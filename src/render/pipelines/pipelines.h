/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_RENDER_PIPELINES_PIPELINES_H
#define KOKSMA_RENDER_PIPELINES_PIPELINES_H

#include "render/frame.h"

/* All pipelines, then NULL. */
extern const koksma__pipeline *const koksma__pipelines[];

/* The pipeline that renders this picture (wavefront takes all), with what it wants of the frame. Errors: MEMORY. */
koksma_status koksma__pipeline_for(koksma__frame *frame, const koksma__pipeline **out);

#define PIPELINE(name) extern const koksma__pipeline koksma__pipeline_##name;
#include "render/pipelines/pipelines.def"
#undef PIPELINE

#endif
