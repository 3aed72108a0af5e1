/* SPDX-License-Identifier: Apache-2.0 */
/* Strata for figures. */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_SHOW_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_SHOW_H

#include "render/samples/adaptive/adaptive_place.h"
#include "render/samples/uses.h"

/* Lists the uses whose strata are shown, and returns their number: the pixel, the lens, the time, and the first
   lights and the lobe of the first two vertices, as far as the scene needs these uses. */
int koksma__list_spaces(const koksma__use_list *there, uint32_t list[KOKSMA_MAX_SPACES]);

/* Describes the strata of a pixel. Errors: MEMORY. */
koksma_status koksma__strata_show(const koksma__adaptive *run, size_t pixel, koksma_strata *out);

#endif
