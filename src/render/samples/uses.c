/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Implements uses, the purposes for which sample dimensions are drawn: the table of uses, the group of each use, and
 * the dimensions of a pattern that a use takes.
 */
#include "render/samples/uses.h"

#include "core/status.h"

/* Converts the number of a use to its index in the table; all lights share the last index. */
#define POSITION(number) ((number) < KOKSMA__USE_LIGHT ? (number) : KOKSMA_N_USES - 1)

static const koksma_use uses_table[] = {
#define USE(id, number, name, dim, help) [POSITION(number)] = {name, help, dim},
#include "render/samples/uses.def"
#undef USE
};

static const uint32_t numbers[] = {
#define USE(id, number, name, dim, help) [POSITION(number)] = (number),
#include "render/samples/uses.def"
#undef USE
};

_Static_assert(sizeof uses_table / sizeof *uses_table == KOKSMA_N_USES,
               "koksma/render.h must have the right number of uses, and their numbers must count up from 0");

const koksma_use *koksma_use_at(size_t i)
{
    return i < KOKSMA_N_USES ? &uses_table[i] : NULL;
}

uint32_t koksma__use_number(int u)
{
    return numbers[u];
}

int koksma__use_index(uint32_t use)
{
    return (int)POSITION(use % KOKSMA__USES_A_BOUNCE);
}

const koksma_spec *koksma__use_spec(const koksma_render_options *options, uint32_t use)
{
    const int u = koksma__use_index(use), group = koksma__place_of_use_at(options, u).group;
    const koksma_spec *own = group < 0 ? &options->patterns[u] : &options->groups[group].pattern;
    return own->pattern ? own : &options->pattern;
}

int koksma__use_set_dim(const koksma_spec *spec, int u)
{
    const bool one = uses_table[u].dim == 1 && spec->pattern->min_dim == 1;
    return one && !(spec->pattern->claims & KOKSMA_CLAIM_MIN_DISTANCE) ? 1 : 2;
}

koksma__place_of_use koksma__place_of_use_at(const koksma_render_options *options, int u)
{
    for (int g = 0; g < KOKSMA_MAX_USE_GROUPS; g++) {
        const koksma_use_group *group = &options->groups[g];
        koksma__place_of_use place = {.group = -1, .lead = UINT32_MAX};
        for (int i = 0; i < group->n_uses && i < KOKSMA_N_USES; i++) {
            const int other = group->uses[i];
            if (other < 0 || other >= KOKSMA_N_USES) {
                continue; /* koksma__check_use_patterns may not have checked the options yet */
            }
            if (other == u) {
                place.group = g;
                place.first = place.dim;
            }
            place.dim += uses_table[other].dim;
            place.lead = numbers[other] < place.lead ? numbers[other] : place.lead;
        }
        if (place.group >= 0) {
            return place;
        }
    }
    return (koksma__place_of_use){.group = -1, .dim = uses_table[u].dim};
}

/* Only the use `light` can occur several times at a vertex, and only the first light shares the set of a group. */
uint32_t koksma__set_key(const koksma__place_of_use *place, uint32_t use)
{
    return place->group < 0 || use % KOKSMA__USES_A_BOUNCE > KOKSMA__USE_LIGHT
               ? use
               : use / KOKSMA__USES_A_BOUNCE * KOKSMA__USES_A_BOUNCE + place->lead;
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
    case KOKSMA__USE_DISTANCE:
        return uses->distance;
    default:
        return uses->vertices > 1;
    }
}

/* In a native pattern each vertex has, in this order, the dimensions of its lights, light choice, lobe, lobe
   choice, roulette and distance. */
int koksma__use_dimension(const koksma__use_list *uses, uint32_t use)
{
    const int vertex = (int)(use / KOKSMA__USES_A_BOUNCE), number = (int)(use % KOKSMA__USES_A_BOUNCE);
    const int lens = 2, time = lens + 2 * uses->lens, first = time + uses->time;
    const int choice = 2 * uses->lights, lobe = choice + uses->light_choice;
    const int distance = lobe + (uses->vertices > 1 ? 4 : 0), each = distance + uses->distance,
              start = first + vertex * each;
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
    case KOKSMA__USE_DISTANCE:
        return start + distance;
    default:
        return start + 2 * (number - KOKSMA__USE_LIGHT);
    }
}
