/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Forms groups of pixels that fill the pipeline's lanes, draws their samples, and allocates the scratch of a task. A
 * group is as many whole pixels as fit, at least one. The samples of the last pixel are repeated until the lanes are
 * full, so that loops over lanes have no remainder.
 */
#include "render/one_image.h"

#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/status.h"

void koksma__group_fill(const koksma__frame *f, size_t first, size_t end, koksma__group *group)
{
    group->first = first;
    group->count = 0;
    group->start[0] = 0;
    /* at most as many pixels as the scratch has slots: the uses are drawn one after the other for all pixels of the
       group, and the sets that uses share must remain in their slots until the last use is drawn */
    const size_t kept = f->sampler.kept_dim ? f->sampler.kept_slots : KOKSMA__GROUP_PIXELS;
    const size_t most = kept < KOKSMA__GROUP_PIXELS ? kept : KOKSMA__GROUP_PIXELS;
    while (first + group->count < end && group->count < most) {
        const size_t n = group->start[group->count] + f->sampler.count(&f->sampler, first + group->count);
        if (group->count && n > f->together) {
            return;
        }
        group->start[++group->count] = n;
    }
}

koksma_status koksma__group_draw(const koksma__frame *frame, const koksma__group *group, uint32_t use, bool on_film,
                                 koksma__sample_scratch *scratch, float *pairs)
{
    const size_t width = (size_t)frame->options->width, n = group->start[group->count];
    koksma_status status = KOKSMA_OK;
    if (frame->sampler.prepare) {
        frame->sampler.prepare(&frame->sampler, group->first, group->count, use, scratch);
    }
    for (size_t p = 0; !status && p < group->count; p++) {
        const size_t pixel = group->first + p;
        const float offset[2] = {on_film ? (float)(pixel % width) : 0, on_film ? (float)(pixel / width) : 0};
        status = frame->sampler.draw(&frame->sampler, pixel, use, offset, scratch, pairs + 2 * group->start[p]);
    }
    scratch->count = 0;
    for (size_t i = n; n && i < koksma__whole_lanes(n); i++) {
        memcpy(pairs + 2 * i, pairs + 2 * (n - 1), 2 * sizeof *pairs);
    }
    return status;
}

/* ---- Room -------------------------------------------------------------------------------------------------- */

static koksma_status values_init(koksma__values *v, size_t capacity, const koksma__frame *frame, bool all_layers)
{
    const size_t n = capacity, channels = (size_t)frame->channels;
    *v = (koksma__values){.film = malloc(2 * n * sizeof(float)),
                          .weights = malloc(n * sizeof(float)),
                          .rgb = malloc(n * channels * sizeof(float))};
    bool all = v->film && v->weights && v->rgb;
    if (all_layers) {
        v->albedo = malloc(3 * n * sizeof(float));
        v->normal = malloc(3 * n * sizeof(float));
        v->depth = malloc(n * sizeof(float));
        all &= v->albedo && v->normal && v->depth;
    }
    return all ? KOKSMA_OK : koksma__fail_memory(13 * n * sizeof(float));
}

static void values_fini(koksma__values *v)
{
    KOKSMA__FREE(v->film, v->weights, v->rgb, v->albedo, v->normal, v->depth);
}

koksma_status koksma__task_scratch_init(const koksma__frame *frame, const koksma__pipeline *pipeline, size_t capacity,
                                        bool all_layers, koksma__task_scratch *scratch)
{
    *scratch = (koksma__task_scratch){.pipeline = pipeline};
    koksma_status status = values_init(&scratch->values, capacity, frame, all_layers);
    status = status ? status : koksma__sample_scratch_init(&scratch->draw, &frame->sampler);
    return status ? status : pipeline->open(frame, capacity, &scratch->pipeline_scratch);
}

void koksma__task_scratch_fini(koksma__task_scratch *scratch)
{
    koksma__sample_scratch_fini(&scratch->draw);
    if (scratch->pipeline_scratch) {
        scratch->pipeline->close(scratch->pipeline_scratch);
    }
    values_fini(&scratch->values);
}
