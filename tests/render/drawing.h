/* SPDX-License-Identifier: Apache-2.0 */
/* For tests of samples: the numbers of a pixel and use, in a scene that needs all uses. */
#ifndef KOKSMA_TEST_DRAWING_H
#define KOKSMA_TEST_DRAWING_H

#include "render/samples/samples.h"
#include "rendering.h"

static const koksma__use_list all_uses = {
    .lens = true, .time = true, .lights = 2, .light_choice = true, .vertices = 3};

typedef struct drawing {
    koksma_render_options options;
    koksma__sampler sampler;
    koksma__sample_scratch scratch;
} drawing;

static inline void open_drawing(const koksma_render_options *options, drawing *d)
{
    d->options = *options;
    assert_ok(koksma__pixel_samples(&d->options, &all_uses, NULL, &d->sampler));
    assert_ok(koksma__sample_scratch_init(&d->scratch, &d->sampler));
}

/* Two numbers a sample. */
static inline void draw(drawing *d, uint64_t pixel, uint32_t use, float *pairs)
{
    static const float nowhere[2] = {0, 0};
    assert_ok(d->sampler.draw(&d->sampler, pixel, use, nowhere, &d->scratch, pairs));
}

static inline void close_drawing(drawing *d)
{
    koksma__sample_scratch_fini(&d->scratch);
    d->sampler.release(&d->sampler);
}

#endif
