/* SPDX-License-Identifier: Apache-2.0 */
/* What samples are spent on, and which dimensions of one pattern the uses would take. */
#include <stdlib.h>

#include "core/status.h"
#include "render/sampler.h"

/* The position of a number in the list of uses; of all from LIGHT on the last. */
#define POSITION(number) ((number) < KOKSMA__USE_LIGHT ? (number) : KOKSMA_N_USES - 1)

static const koksma_use uses_table[] = {
#define USE(id, number, name, dim, help) [POSITION(number)] = {name, help, dim},
#include "render/uses.def"
#undef USE
};

static const uint32_t numbers[] = {
#define USE(id, number, name, dim, help) [POSITION(number)] = (number),
#include "render/uses.def"
#undef USE
};

enum {
    LINES = 0
#define USE(id, number, name, dim, help) +1
#include "render/uses.def"
#undef USE
};

_Static_assert((int)LINES == (int)KOKSMA_N_USES && sizeof uses_table / sizeof *uses_table == KOKSMA_N_USES,
               "koksma/render.h counts the uses, and their numbers count up from 0");

const koksma_use *koksma_use_at(size_t i)
{
    return i < KOKSMA_N_USES ? &uses_table[i] : NULL;
}

int koksma__use_index(uint32_t use)
{
    return (int)POSITION(use % KOKSMA__USES_A_BOUNCE);
}

const koksma_spec *koksma__use_spec(const koksma_render_options *options, uint32_t use)
{
    const koksma_spec *own = &options->patterns[koksma__use_index(use)];
    return own->pattern ? own : &options->pattern;
}

bool koksma__use_is_there(const koksma__use_list *uses, int u)
{
    switch (numbers[u]) {
    case KOKSMA__USE_PIXEL:
        return true;
    case KOKSMA__USE_LENS:
        return uses->lens;
    case KOKSMA__USE_TIME:
        return uses->time;
    case KOKSMA__USE_LIGHT:
        return uses->lights > 0;
    case KOKSMA__USE_LIGHT_CHOICE:
        return uses->light_choice;
    default:
        return uses->vertices > 1;
    }
}

/* A vertex has: the luminaires, which of them, lobe, lobe choice, roulette. */
int koksma__use_dimension(const koksma__use_list *uses, uint32_t use)
{
    const int vertex = (int)(use / KOKSMA__USES_A_BOUNCE), number = (int)(use % KOKSMA__USES_A_BOUNCE);
    const int lens = 2, time = lens + 2 * uses->lens, first = time + uses->time;
    const int choice = 2 * uses->lights, lobe = choice + uses->light_choice;
    const int each = lobe + (uses->vertices > 1 ? 4 : 0), start = first + vertex * each;
    if (use == UINT32_MAX) {
        return first + each * uses->vertices;
    }
    switch (number) {
    case KOKSMA__USE_PIXEL:
        return 0;
    case KOKSMA__USE_LENS:
        return lens;
    case KOKSMA__USE_TIME:
        return time;
    case KOKSMA__USE_LIGHT_CHOICE:
        return start + choice;
    case KOKSMA__USE_LOBE:
        return start + lobe;
    case KOKSMA__USE_LOBE_CHOICE:
        return start + lobe + 2;
    case KOKSMA__USE_ROULETTE:
        return start + lobe + 3;
    default:
        return start + 2 * (number - KOKSMA__USE_LIGHT);
    }
}

koksma_status koksma__sample_room_init(koksma__sample_room *room, const koksma__sampler *sampler)
{
    const size_t n = sampler->most, counters = (n + 3) / 4;
    const size_t words = 4 * (counters < KOKSMA__WORD_COUNTERS ? KOKSMA__WORD_COUNTERS : counters);
    const size_t native = n * (size_t)sampler->native_dim * sampler->native_slots;
    *room = (koksma__sample_room){
        .xs = malloc(2 * n * sizeof *room->xs),
        .pairs = malloc(2 * n * sizeof *room->pairs),
        .words = malloc(KOKSMA__WORD_SLOTS * words * sizeof *room->words),
        .native = malloc((native + 1) * sizeof *room->native),
        .native_pixels = calloc(sampler->native_slots + 1, sizeof *room->native_pixels),
    };
    if (!room->xs || !room->pairs || !room->words || !room->native || !room->native_pixels) {
        koksma__sample_room_fini(room);
        return koksma__fail_memory(24 * n + 4 * KOKSMA__WORD_SLOTS * words + 8 * native);
    }
    return KOKSMA_OK;
}

void koksma__sample_room_fini(koksma__sample_room *room)
{
    free(room->xs);
    free(room->pairs);
    free(room->words);
    free(room->native);
    free(room->native_pixels);
    *room = (koksma__sample_room){0};
}
