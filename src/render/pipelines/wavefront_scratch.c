/* SPDX-License-Identifier: Apache-2.0 */
/*
 * What a task of the wavefront tracer owns: two queues of paths, sums of light, and the samples that it has drawn.
 * The samples of a use are drawn for a whole group when the first path needs them, and then kept for the group: which
 * uses a picture needs depends on what its rays meet.
 */
#include <stdlib.h>

#include "core/capacity.h"
#include "core/status.h"
#include "render/pipelines/wavefront.h"

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
    KOKSMA__FREE(scratch->drawn, scratch->queues[0].paths, scratch->queues[1].paths, scratch->sums, scratch);
}

koksma_status koksma__wavefront_open(const koksma__frame *frame, size_t capacity, void **out)
{
    koksma__wavefront_scratch *scratch = calloc(1, sizeof *scratch);
    *out = scratch;
    KOKSMA__REQUIRE_MEMORY(scratch, sizeof *scratch);
    scratch->capacity = capacity;
    scratch->sums = malloc(3 * capacity * sizeof *scratch->sums);
    koksma_status status = koksma__sample_scratch_init(&scratch->draw, &frame->sampler);
    if (!status && !scratch->sums) {
        status = koksma__fail_memory(3 * capacity * sizeof *scratch->sums);
    }
    if (status) {
        koksma__wavefront_close(scratch);
        *out = NULL;
    }
    return status;
}

koksma_status koksma__wavefront_push(koksma__queue *queue, const koksma__path *path)
{
    koksma__path *paths =
        koksma__room_for_one(queue->paths, queue->n, &queue->capacity, 4 * KOKSMA__BLOCK, sizeof *paths);
    KOKSMA__TRY(paths ? KOKSMA_OK : KOKSMA_MEMORY);
    queue->paths = paths;
    queue->paths[queue->n++] = *path;
    return KOKSMA_OK;
}

static koksma_status new_use(koksma__wavefront_scratch *scratch, uint32_t use, koksma__drawn **out)
{
    KOKSMA__FAIL_IF(scratch->n_drawn * scratch->capacity > KOKSMA__MAX_DRAWN, KOKSMA_ARGUMENT,
                    "more than %zu samples of this many uses: fewer samples a pixel would do", scratch->capacity);
    koksma__drawn *list = realloc(scratch->drawn, (scratch->n_drawn + 1) * sizeof *list);
    float *pairs = malloc(2 * scratch->capacity * sizeof *pairs);
    scratch->drawn = list ? list : scratch->drawn;
    if (!list || !pairs) {
        free(pairs);
        return koksma__fail_memory(2 * scratch->capacity * sizeof *pairs);
    }
    *out = &list[scratch->n_drawn++];
    **out = (koksma__drawn){.use = use, .pairs = pairs};
    return KOKSMA_OK;
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
        status = koksma__group_draw(trace->frame, trace->group, use, false, &scratch->draw, drawn->pairs);
        drawn->done = true;
    }
    *pairs = status ? NULL : drawn->pairs;
    return status;
}
