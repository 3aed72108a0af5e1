/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The memory of a task of the wavefront tracer: two queues of paths in blocks of lanes, sums of light, and the
 * samples drawn so far. Which uses (koksma/render.h) an image needs depends on what its rays hit. The samples of a use
 * are therefore drawn only when a path first needs them in a bounce, for all pixels of the group that still have a
 * path; they are kept until the end of the bounce.
 */
#include <stdlib.h>
#include <string.h>

#include "core/capacity.h"
#include "core/platform/system.h"
#include "core/status.h"
#include "render/one_image.h"
#include "render/pipelines/pipelines.h"

void koksma__wavefront_close(void *opened)
{
    koksma__wavefront_scratch *scratch = opened;
    if (!scratch) {
        return;
    }
    for (size_t i = 0; i < scratch->n_drawn; i++) {
        free(scratch->drawn[i].pairs);
    }
    koksma__sample_scratch_fini(&scratch->draw);
    koksma__aligned_free(scratch->queues[0].blocks);
    koksma__aligned_free(scratch->queues[1].blocks);
    koksma__aligned_free(scratch->vertices);
    koksma__aligned_free(scratch->estimates);
    KOKSMA__FREE(scratch->drawn, scratch->sums, scratch->pixel_of, scratch);
}

koksma_status koksma__wavefront_open(const koksma__frame *frame, size_t capacity, void **out)
{
    koksma__wavefront_scratch *scratch = calloc(1, sizeof *scratch);
    *out = scratch;
    KOKSMA__REQUIRE_MEMORY(scratch, sizeof *scratch);
    scratch->capacity = capacity;
    scratch->sums = malloc(3 * capacity * sizeof *scratch->sums);
    scratch->pixel_of = calloc(capacity, sizeof *scratch->pixel_of);
    scratch->vertices = koksma__aligned(sizeof *scratch->vertices);
    scratch->estimates = koksma__aligned((frame->lights.n + 1) * sizeof *scratch->estimates);
    koksma_status status = koksma__sample_scratch_init(&scratch->draw, &frame->sampler);
    if (!status && (!scratch->sums || !scratch->pixel_of || !scratch->vertices || !scratch->estimates)) {
        status = koksma__fail_memory(3 * capacity * sizeof *scratch->sums);
    }
    if (status) {
        koksma__wavefront_close(scratch);
        *out = NULL;
    } else {
        memset(scratch->vertices, 0, sizeof *scratch->vertices);
        memset(scratch->is_alive, true, sizeof scratch->is_alive);
    }
    return status;
}

koksma_status koksma__wavefront_reserve(koksma__queue *queue)
{
    if (queue->n + KOKSMA__BLOCK > queue->capacity) { /* realloc is not used, because it may lose the alignment */
        const size_t blocks = 2 * queue->capacity / KOKSMA__BLOCK + 4, filled = queue->capacity / KOKSMA__BLOCK;
        koksma__paths *larger = koksma__aligned(blocks * sizeof *larger);
        KOKSMA__REQUIRE_MEMORY(larger, blocks * sizeof *larger);
        if (filled) {
            memcpy(larger, queue->blocks, filled * sizeof *larger);
        }
        koksma__aligned_free(queue->blocks);
        queue->blocks = larger;
        queue->capacity = blocks * KOKSMA__BLOCK;
    }
    return KOKSMA_OK;
}

/* ---- Samples -------------------------------------------------------------------------------------------------- */

static koksma_status new_use(koksma__wavefront_scratch *scratch, uint32_t use, koksma__drawn **out)
{
    KOKSMA__FAIL_IF(scratch->n_drawn * scratch->capacity > KOKSMA__MAX_DRAWN, KOKSMA_ARGUMENT,
                    "the scene needs too many sample dimensions for %zu samples at once; use fewer samples a pixel",
                    scratch->capacity);
    /* copies that pad the samples to a multiple of KOKSMA__LANE_STEP may follow the last sample */
    const size_t n = 2 * (scratch->capacity + KOKSMA__LANE_STEP);
    koksma__drawn *list = realloc(scratch->drawn, (scratch->n_drawn + 1) * sizeof *list);
    float *pairs = malloc(n * sizeof *pairs);
    scratch->drawn = list ? list : scratch->drawn;
    if (!list || !pairs) {
        free(pairs);
        return koksma__fail_memory(n * sizeof *pairs);
    }
    *out = &list[scratch->n_drawn++];
    **out = (koksma__drawn){.use = use, .pairs = pairs};
    return KOKSMA_OK;
}

/* Draws the samples of each run of consecutive pixels that have paths, in ascending order: the copies that fill the
   last lanes of one run are overwritten by the next run, or lie behind the last sample. */
static koksma_status draw_alive(const koksma__trace *trace, uint32_t use, float *pairs)
{
    koksma__wavefront_scratch *scratch = trace->scratch;
    const koksma__group *group = trace->group;
    koksma_status status = KOKSMA_OK;
    for (size_t p = 0, end = 0; !status && p < group->count; p = end + 1) {
        koksma__group run = {.first = group->first + p};
        for (end = p; end < group->count && scratch->is_alive[end]; end++) {
            run.start[++run.count] = group->start[end + 1] - group->start[p];
        }
        if (run.count) {
            status = koksma__group_draw(trace->frame, &run, use, false, &scratch->draw, pairs + 2 * group->start[p]);
        }
    }
    return status;
}

koksma_status koksma__wavefront_draw(const koksma__trace *trace, uint32_t use, const float **pairs)
{
    koksma__wavefront_scratch *scratch = trace->scratch;
    koksma__drawn *drawn = NULL;
    for (size_t i = 0; i < scratch->n_drawn && !drawn; i++) {
        drawn = scratch->drawn[i].use == use ? &scratch->drawn[i] : NULL;
    }
    koksma_status status = drawn ? KOKSMA_OK : new_use(scratch, use, &drawn);
    if (!status && !drawn->done) {
        status = draw_alive(trace, use, drawn->pairs);
        drawn->done = !status;
    }
    *pairs = status ? NULL : drawn->pairs;
    return status;
}

koksma_status koksma__wavefront_pairs(const koksma__trace *trace, uint32_t use, const koksma__vertices *v, float *x,
                                      float *y)
{
    const float *pairs;
    KOKSMA__TRY(koksma__wavefront_draw(trace, (uint32_t)trace->bounce * KOKSMA__USES_A_BOUNCE + use, &pairs));
    trace->frame->batch->pairs(pairs, v->paths->sample, v->whole, x, y);
    return KOKSMA_OK;
}
