/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The sampler provides the samples of each pixel. The sample of a use is a pure function of (options, pixel, sample,
 * bounce, use), independent of the order of requests. There are two implementations: pixel_samples.c draws a new set
 * in every pixel, and image_samples.c draws one set over the whole image.
 */
#ifndef KOKSMA_RENDER_SAMPLES_SAMPLER_H
#define KOKSMA_RENDER_SAMPLES_SAMPLER_H

#include <koksma/render.h>

#include "render/pipelines/batch.h"

/* The numbers of the uses in uses.def. The numbers are part of the keys of random numbers, so they never change.
   Lights count up from LIGHT, and at bounce b the number b KOKSMA__USES_A_BOUNCE is added. */
enum {
#define USE(id, number, name, dim, help) KOKSMA__USE_##id = (number),
#include "render/samples/uses.def"
#undef USE
    KOKSMA__USES_A_BOUNCE = 1 << 12,
    KOKSMA__MAX_BOUNCES = 255
};

/* The scratch memory of a thread: buffers for the points of one pixel, and a store (`kept`) for the sets that several
   uses share (those of a native pattern or of groups of uses), for all pixels that are drawn together. */
typedef struct koksma__sample_scratch {
    double *xs;
    float *pairs;
    uint32_t *words;               /* buffer for the random words of a use in `room_for` pixels */
    uint16_t *order;               /* buffers for two orders of the samples of each of these pixels */
    size_t room_for, first, count; /* `prepare` filled the buffers for the pixels first .. first + count - 1 */
    double *kept;
    uint64_t *kept_keys;   /* the key of the set in each slot; 0: none */
    const koksma_run *run; /* the run of the sampler, or one that is never cancelled */
    size_t sets;           /* how many sets were made one by one */
} koksma__sample_scratch;

typedef struct koksma__sampler {
    void *made;
    /* Any thread checks this run for cancellation while it makes a set, which may take seconds; NULL: never
       cancelled. */
    const koksma_run *run;
    size_t most; /* largest number of samples in a pixel */
    /* coordinates per sample in `kept` of the scratch: those of all groups, or of a native pattern */
    int kept_dim;
    size_t kept_sets;  /* number of groups; a native pattern counts as one group */
    size_t kept_slots; /* pixels in `kept`; the sets of a pixel are in slot pixel modulo kept_slots */
    size_t (*count)(const struct koksma__sampler *sampler, uint64_t pixel);
    /* Draws the random words of a use for several pixels at once, which saves time, before `draw` is called for each
       of these pixels with the same scratch; NULL: draws alone. */
    void (*prepare)(const struct koksma__sampler *sampler, uint64_t first, size_t count, uint32_t use,
                    koksma__sample_scratch *room);
    /* Draws the pairs of a use in a pixel and adds the offset; the second number of a one-dimensional use has no
       meaning. */
    koksma_status (*draw)(const struct koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    void (*release)(struct koksma__sampler *sampler);
} koksma__sampler;

/* The uses that a scene and an integrator need. Native pairing assigns these uses to dimensions, and scope `image`
   draws their samples before the image is rendered. */
typedef struct koksma__use_list {
    bool lens, time;
    int lights;        /* number of light uses per bounce */
    bool light_choice; /* whether one of several lights is chosen at random */
    bool distance;     /* whether each ray may be scattered by a medium */
    /* number of vertices of a path; if it is above 1, each vertex has the uses lobe, lobe-choice and roulette, too */
    int vertices;
} koksma__use_list;

/* Returns the largest number of bytes that koksma__image_samples uses while it draws; afterwards it uses fewer. */
uint64_t koksma__image_samples_size(const koksma_render_options *options, const koksma__use_list *uses);

/* Returns whether the image needs use u of uses.def. */
bool koksma__use_is_there(const koksma__use_list *uses, int u);

/* Opens a sampler. koksma__pixel_samples draws one set of each pattern first, so that a pattern that cannot have
   spp points fails here. Errors: the pattern's, ARGUMENT, MEMORY. */
koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    koksma__sampler *out);
koksma_status koksma__image_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

koksma_status koksma__sample_scratch_init(koksma__sample_scratch *room, const koksma__sampler *sampler);
void koksma__sample_scratch_fini(koksma__sample_scratch *room);

/* Which coordinates a use takes from the points of its set. */
typedef struct koksma__place_of_use {
    int group;      /* index in the options of the group of uses that this use belongs to; -1: it is in no group */
    int first, dim; /* the first coordinate of the use, and the number of dimensions of the set */
    uint32_t lead;  /* the smallest number of the uses in the group */
} koksma__place_of_use;
koksma__place_of_use koksma__place_of_use_at(const koksma_render_options *options, int u);

/* Returns the key of the set from which a use takes its coordinates. The key of a use without a group is the use
   itself. */
uint32_t koksma__set_key(const koksma__place_of_use *place, uint32_t use);

/* Returns the pattern spec of a use: that of its group, that of the use alone, or the one common to all uses. */
const koksma_spec *koksma__use_spec(const koksma_render_options *options, uint32_t use);

/* Returns the number of dimensions of the point sets for use u, which must not be in a group. A one-dimensional
   use takes one-dimensional sets if the pattern has them. From a pattern with a minimum distance, which is defined
   in the plane, it takes the first coordinate of two-dimensional sets. */
int koksma__use_set_dim(const koksma_spec *spec, int u);

/* Checks that every spec names a pattern and that every group is valid. Errors: ARGUMENT, DIM. */
koksma_status koksma__check_use_patterns(const koksma_render_options *options);

/* Checks that every pattern in the options can generate a set of n points, by generating one. Errors: those of the
   patterns. */
koksma_status koksma__try_use_patterns(const koksma_render_options *options, size_t n, const koksma_run *run);

/* Fails if the pattern exists only in more than 2 dimensions, because a single use has at most 2. Errors: DIM. */
koksma_status koksma__check_single_use(const koksma_spec *spec);

/* Returns the index in uses.def of a use at any bounce. */
int koksma__use_index(uint32_t use);

/* Returns the first dimension of a use in a native pattern, or the number of dimensions if use is UINT32_MAX. */
int koksma__use_dimension(const koksma__use_list *uses, uint32_t use);

#endif
