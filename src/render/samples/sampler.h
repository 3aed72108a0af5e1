/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Where the samples of a pixel come from. The sample of a use is a pure function of (options, pixel, sample, bounce,
 * use), whatever was asked for before. Two makers: pixel_samples.c, a pattern afresh in every pixel, and
 * image_samples.c, one over the whole image.
 */
#ifndef KOKSMA_RENDER_SAMPLES_SAMPLER_H
#define KOKSMA_RENDER_SAMPLES_SAMPLER_H

#include <koksma/render.h>

#include "render/pipelines/batch.h"

/* Uses. Their numbers are part of the random numbers' keys, so they never change; lights count up from LIGHT, and
   the uses of bounce b have b KOKSMA__USES_A_BOUNCE added. Their names are in uses.def. */
enum {
#define USE(id, number, name, dim, help) KOKSMA__USE_##id = (number),
#include "render/samples/uses.def"
#undef USE
    KOKSMA__USES_A_BOUNCE = 1 << 12,
    KOKSMA__MAX_BOUNCES = 255
};

/* What a thread needs for drawing: room for the points of one pixel; and the sets that several uses take their
   coordinates from, a native pattern's or those of groups of uses, for as many pixels as are drawn together. */
typedef struct koksma__sample_scratch {
    double *xs;
    float *pairs;
    uint32_t *words; /* random words of a use */
    uint16_t *order; /* two orders of the samples of a use */
    double *kept;
    uint64_t *kept_keys;   /* which set is in a slot; 0: none */
    const koksma_run *run; /* the sampler's, or one that always goes on */
} koksma__sample_scratch;

typedef struct koksma__sampler {
    void *made;
    const koksma_run *run; /* asked while a set is made, which may take seconds, by any thread; NULL: never */
    size_t most;           /* samples that a pixel can have */
    int kept_dim;          /* coordinates of a sample that the scratch keeps: of all groups, or of a native pattern */
    size_t kept_sets;      /* groups; a native pattern is one */
    size_t kept_slots;     /* pixels: a pixel's sets are in slot pixel modulo kept_slots */
    size_t (*count)(const struct koksma__sampler *sampler, uint64_t pixel);
    /* The pairs of a use of a pixel, plus offset; the second number of a one-dimensional use is unused. */
    koksma_status (*draw)(const struct koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    void (*release)(struct koksma__sampler *sampler);
} koksma__sampler;

/* The uses that a scene and an integrator have: what `native` lays out as dimensions and `image` draws beforehand. */
typedef struct koksma__use_list {
    bool lens, time;
    int lights;        /* uses of lights at a bounce */
    bool light_choice; /* one of them is chosen */
    int vertices;      /* of a path; with more than one, each has lobe, lobe choice and roulette too */
} koksma__use_list;

/* The most bytes that koksma__image_samples takes while it draws; afterwards it keeps fewer. */
uint64_t koksma__image_samples_size(const koksma_render_options *options, const koksma__use_list *uses);

/* Whether samples are spent on use u of uses.def. */
bool koksma__use_is_there(const koksma__use_list *uses, int u);

/* Draws one set, so that a pattern that can't serve spp says so here. Errors: the pattern's, ARGUMENT, MEMORY. */
koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    koksma__sampler *out);
koksma_status koksma__image_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

koksma_status koksma__sample_scratch_init(koksma__sample_scratch *room, const koksma__sampler *sampler);
void koksma__sample_scratch_fini(koksma__sample_scratch *room);

/* Where a use of uses.def has its coordinates. */
typedef struct koksma__place_of_use {
    int group;      /* of the options; -1: none */
    int first, dim; /* the use's first coordinate, and how many dimensions the set has that it is taken from */
    uint32_t lead;  /* of a group: the smallest number of its uses */
} koksma__place_of_use;
koksma__place_of_use koksma__place_of_use_at(const koksma_render_options *options, int u);

/* The key of the set that a use takes its coordinates from: that of a use without a group is the use itself. */
uint32_t koksma__set_key(const koksma__place_of_use *place, uint32_t use);

/* The spec of a use: its group's, its own, or that of all. */
const koksma_spec *koksma__use_spec(const koksma_render_options *options, uint32_t use);

/* Returns the number of dimensions of the point sets for use u, which is in no group. A use of one dimension takes sets of
   one dimension if the pattern has them. From patterns with a minimum distance, which is meant for the plane, it takes
   the first coordinate of sets of two. */
int koksma__use_set_dim(const koksma_spec *spec, int u);

/* Whether every spec is one of a pattern, and every group is in order. Errors: ARGUMENT, DIM. */
koksma_status koksma__check_use_patterns(const koksma_render_options *options);

/* Generates a set of n points of every pattern that the options name. Errors: the patterns'. */
koksma_status koksma__try_use_patterns(const koksma_render_options *options, size_t n, const koksma_run *run);

/* A pattern that has only forms of more than 2 dimensions has none for a single use. Errors: DIM. */
koksma_status koksma__check_single_use(const koksma_spec *spec);

/* Which line of uses.def a use is, at whichever bounce. */
int koksma__use_index(uint32_t use);

/* The first dimension of a use in a native pattern; the number of dimensions for use = UINT32_MAX. */
int koksma__use_dimension(const koksma__use_list *uses, uint32_t use);

#endif
