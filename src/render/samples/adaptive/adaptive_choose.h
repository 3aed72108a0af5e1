/* SPDX-License-Identifier: Apache-2.0 */
/* The choice of the pixels of a round. */
#ifndef KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_CHOOSE_H
#define KOKSMA_RENDER_SAMPLES_ADAPTIVE_ADAPTIVE_CHOOSE_H

#include "render/samples/adaptive/adaptive.h"

/* Selects the pixels of the next round and sets *selected to their number. Errors: MEMORY. */
koksma_status koksma__adaptive_choose(koksma__adaptive *run, size_t *selected);

#endif
