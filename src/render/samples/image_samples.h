/* SPDX-License-Identifier: Apache-2.0 */
/* The sampler that draws one set over the whole image. */
#ifndef KOKSMA_RENDER_SAMPLES_IMAGE_SAMPLES_H
#define KOKSMA_RENDER_SAMPLES_IMAGE_SAMPLES_H

#include "render/samples/sampler.h"

/* Returns the largest number of bytes that koksma__image_samples uses while it draws; afterwards it uses fewer. */
uint64_t koksma__image_samples_size(const koksma_render_options *options, const koksma__use_list *uses);

/* Opens a sampler. Errors: the pattern's, ARGUMENT, MEMORY. */
koksma_status koksma__image_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

#endif
