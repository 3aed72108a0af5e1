/* SPDX-License-Identifier: Apache-2.0 */
/* The table of pipelines, and the choice of the pipeline for an image: the pipeline with the highest preference of
   those that accept the frame. */
#include "render/pipelines/pipelines.h"
#include "core/status.h"

const koksma__pipeline *const koksma__pipelines[] = {&koksma__pipeline_lambert_lanes, &koksma__pipeline_wavefront,
                                                     NULL};

koksma_status koksma__pipeline_for(koksma__frame *frame, const koksma__pipeline **out)
{
    const koksma__pipeline *best = NULL;
    for (size_t i = 0; koksma__pipelines[i]; i++) {
        const koksma__pipeline *p = koksma__pipelines[i];
        if (p->takes(frame) && (!best || p->preference > best->preference)) {
            best = p;
        }
    }
    *out = best;
    frame->together = best->together;
    return best->culls && frame->geometry.shapes && !frame->frustum_cull
               ? koksma__frustum_cull_open(&frame->camera, frame->geometry.shapes, frame->options->width,
                                           frame->options->height, &frame->frustum_cull)
               : KOKSMA_OK;
}

bool koksma_pipeline_at(size_t i, koksma_entry *out)
{
    KOKSMA__REQUIRE_OR(false, out);
    const koksma__pipeline *p = koksma__pipelines[0];
    for (size_t k = 0; p && k < i; k++) {
        p = koksma__pipelines[k + 1];
    }
    *out = p ? (koksma_entry){.name = p->name, .title = p->title} : (koksma_entry){0};
    return p;
}
