/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where the samples of a pixel come from. The sample of a use is a pure function of (options, pixel, sample, bounce,
 * use), whatever was asked for before. Two makers: pixel_samples.c, a pattern afresh in every pixel, and
 * image_samples.c, one over the whole image.
 */
#ifndef KOKSMA_RENDER_SAMPLER_H
#define KOKSMA_RENDER_SAMPLER_H

#include <koksma/render.h>

#include "render/batch.h"

/* Uses. Their numbers are part of the random numbers' keys, so they never change; luminaires count up from LIGHT, and
   the uses of bounce b have b KOKSMA__USES_A_BOUNCE added. Their names are in uses.def. */
enum {
#define USE(id, number, name, dim, help) KOKSMA__USE_##id = (number),
#include "render/uses.def"
#undef USE
    KOKSMA__USES_A_BOUNCE = 1 << 12,
    KOKSMA__MAX_BOUNCES = 255
};

/* Random words for the permutations of a use come for several pixels at once, WORD_COUNTERS draws of four or a
 * pixel's. */
enum { KOKSMA__WORD_SLOTS = 8, KOKSMA__WORD_COUNTERS = 48 };

/* What a thread needs for drawing: room for the points of one pixel; with a native pattern, for those of the pixels
   of a group, pixel modulo `slots`. */
typedef struct koksma__sample_room {
    double *xs;
    float *pairs;
    uint32_t *words;                        /* KOKSMA__WORD_SLOTS parts, of the uses by turns */
    uint64_t word_keys[KOKSMA__WORD_SLOTS]; /* which pixels' and use's words are there */
    double *native;
    uint64_t *native_pixels; /* which pixel is in a slot, plus 1 */
} koksma__sample_room;

typedef struct koksma__sampler {
    void *made;
    size_t most;         /* samples that a pixel can have */
    int native_dim;      /* dimensions of a native pattern; else 0 */
    size_t native_slots; /* pixels whose points a room keeps */
    size_t (*count)(const struct koksma__sampler *sampler, uint64_t pixel);
    /* The pairs of a use of a pixel, plus offset; the second number of a one-dimensional use is idle. */
    koksma_status (*draw)(const struct koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_room *room, float *pairs);
    void (*release)(struct koksma__sampler *sampler);
} koksma__sampler;

/* The uses that a scene and an integrator have: what `native` lays out as dimensions and `image` draws beforehand. */
typedef struct koksma__use_list {
    bool lens, time;
    int lights;        /* uses of luminaires at a bounce */
    bool light_choice; /* one of them is chosen */
    int vertices;      /* of a path; with more than one, each has lobe, lobe choice and roulette too */
} koksma__use_list;

/* Bytes that koksma__image_samples takes while it draws them: less is left. */
uint64_t koksma__image_samples_size(const koksma_render_options *options, const koksma__use_list *uses);

/* Whether samples are spent on use u of uses.def. */
bool koksma__use_is_there(const koksma__use_list *uses, int u);

/* Draws one set, so that a pattern that can't serve spp says so here. Errors: the pattern's, ARGUMENT, MEMORY. */
koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    koksma__sampler *out);
koksma_status koksma__image_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

koksma_status koksma__sample_room_init(koksma__sample_room *room, const koksma__sampler *sampler);
void koksma__sample_room_fini(koksma__sample_room *room);

/* The spec of a use: its own, or that of all. */
const koksma_spec *koksma__use_spec(const koksma_render_options *options, uint32_t use);

/* Which line of uses.def a use is, at whichever bounce. */
int koksma__use_index(uint32_t use);

/* The first dimension of a use in a native pattern; the number of dimensions for use = UINT32_MAX. */
int koksma__use_dimension(const koksma__use_list *uses, uint32_t use);

#endif
