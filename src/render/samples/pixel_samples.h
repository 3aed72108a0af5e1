/* SPDX-License-Identifier: Apache-2.0 */
/* The sampler that draws a new set in every pixel. */
#ifndef KOKSMA_RENDER_SAMPLES_PIXEL_SAMPLES_H
#define KOKSMA_RENDER_SAMPLES_PIXEL_SAMPLES_H

#include "render/samples/sampler.h"

/* Opens a sampler. It draws one set of each pattern first, so that a pattern that cannot have spp points fails here;
   only this calls run->keep_going. Errors: the pattern's, ARGUMENT, MEMORY, INTERRUPTED. */
koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

#endif
