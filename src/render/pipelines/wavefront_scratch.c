/* SPDX-License-Identifier: Apache-2.0 */
/* What a task of the tracer keeps: queues of paths, and the samples that it has drawn. */
#include <stdlib.h>

#include "core/capacity.h"
#include "core/status.h"
#include "render/pipelines/wavefront.h"

void koksma__tracer_close(void *opened)
{
    koksma__tracer_room *room = opened;
    if (!room) {
        return;
    }
    for (size_t i = 0; i < room->n_drawn; i++) {
        free(room->drawn[i].pairs);
    }
    koksma__sample_room_fini(&room->draw);
    free(room->drawn);
    free(room->queues[0].paths);
    free(room->queues[1].paths);
    free(room->sums);
    free(room);
}

koksma_status koksma__tracer_open(const koksma__frame *frame, size_t capacity, void **out)
{
    koksma__tracer_room *room = calloc(1, sizeof *room);
    *out = room;
    if (!room) {
        return koksma__fail_memory(sizeof *room);
    }
    room->capacity = capacity;
    room->sums = malloc(3 * capacity * sizeof *room->sums);
    koksma_status status = koksma__sample_room_init(&room->draw, &frame->sampler);
    if (!status && !room->sums) {
        status = koksma__fail_memory(3 * capacity * sizeof *room->sums);
    }
    if (status) {
        koksma__tracer_close(room);
        *out = NULL;
    }
    return status;
}

koksma_status koksma__tracer_push(koksma__queue *queue, const koksma__path *path)
{
    koksma__path *paths =
        koksma__room_for_one(queue->paths, queue->n, &queue->room, 4 * KOKSMA__BLOCK, sizeof *paths);
    if (!paths) {
        return KOKSMA_MEMORY;
    }
    queue->paths = paths;
    queue->paths[queue->n++] = *path;
    return KOKSMA_OK;
}

static koksma_status new_use(koksma__tracer_room *room, uint32_t use, koksma__drawn **out)
{
    if (room->n_drawn * room->capacity > KOKSMA__MAX_DRAWN) {
        return koksma__fail(KOKSMA_ARGUMENT,
                            "more than %zu samples of this many uses: fewer samples a pixel would do",
                            room->capacity);
    }
    koksma__drawn *list = realloc(room->drawn, (room->n_drawn + 1) * sizeof *list);
    float *pairs = malloc(2 * room->capacity * sizeof *pairs);
    room->drawn = list ? list : room->drawn;
    if (!list || !pairs) {
        free(pairs);
        return koksma__fail_memory(2 * room->capacity * sizeof *pairs);
    }
    *out = &list[room->n_drawn++];
    **out = (koksma__drawn){.use = use, .pairs = pairs};
    return KOKSMA_OK;
}

koksma_status koksma__tracer_draw(const koksma__trace *trace, uint32_t use, const float **pairs)
{
    koksma__tracer_room *room = trace->room;
    koksma__drawn *drawn = NULL;
    for (size_t i = 0; i < room->n_drawn && !drawn; i++) {
        drawn = room->drawn[i].use == use ? &room->drawn[i] : NULL;
    }
    koksma_status status = drawn ? KOKSMA_OK : new_use(room, use, &drawn);
    if (!status && !drawn->done) {
        status = koksma__group_draw(trace->frame, trace->group, use, false, &room->draw, drawn->pairs);
        drawn->done = true;
    }
    *pairs = status ? NULL : drawn->pairs;
    return status;
}
