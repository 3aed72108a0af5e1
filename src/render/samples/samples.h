/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The patterns that the options of a render assign to uses (uses.h), and the samplers, which provide the samples of each
 * pixel. The sample of a use is a pure function of (options,
 * pixel, sample, bounce, use), independent of the order of requests.
 */
#ifndef KOKSMA_RENDER_SAMPLES_SAMPLES_H
#define KOKSMA_RENDER_SAMPLES_SAMPLES_H

#include <koksma/koksma.h>
#include <koksma/render.h>

#include "render/pipelines/batch.h"
#include "render/samples/uses.h"

/* ---- Patterns of uses (use_patterns.c) -------------------------------------------------------------------------- */

/* Returns the end of the part at the beginning of a text of patterns, "PATTERN" or "use+use=PATTERN": its ';', or the end
   of the text. A ';' that no names of uses and no '=' follow belongs to the part. *pattern receives the part's PATTERN. */
const char *koksma__use_part(const char *part, const char **pattern);

/* Checks that every spec names a pattern and that every group is valid. Errors: ARGUMENT, DIM. */
koksma_status koksma__check_use_patterns(const koksma_render_options *options);

/* Checks that a pattern can generate a set of n points, by generating one. Errors: those of the pattern; N in place of
   MISSING where a family of files has only sets of other numbers of points. */
koksma_status koksma__try_set(const koksma_spec *spec, size_t n, int dim, const koksma_run *run);

/* Checks that every pattern in the options can generate a set of n points. Errors: those of koksma__try_set. */
koksma_status koksma__try_use_patterns(const koksma_render_options *options, size_t n, const koksma_run *run);

/* Fails if the pattern exists only in more than 2 dimensions, because a single use has at most 2. Errors: DIM. */
koksma_status koksma__check_single_use(const koksma_spec *spec);

/* ---- Samplers (sampler.c) --------------------------------------------------------------------------------------- */

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
    const koksma_run *run; /* the sampler's `run` or, if that is NULL, a run that is never cancelled */
    size_t sets;           /* number of sets that koksma_generate made; keep_going is called at every 16th */
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
    size_t kept_slots; /* number of pixels whose sets fit in `kept`; a pixel has slot pixel modulo kept_slots */
    size_t (*count)(const struct koksma__sampler *sampler, uint64_t pixel);
    /* Draws the random words of a use for several pixels at once, which saves time, before `draw` is called for each
       of these pixels with the same scratch; NULL: `draw` draws the words itself. */
    void (*prepare)(const struct koksma__sampler *sampler, uint64_t first, size_t count, uint32_t use,
                    koksma__sample_scratch *room);
    /* Draws the coordinates of one use for all samples of a pixel, and adds the offset to them. pairs[2 i] and
       pairs[2 i + 1] are the two coordinates of sample i; in a one-dimensional use the second has no meaning. */
    koksma_status (*draw)(const struct koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs);
    void (*release)(struct koksma__sampler *sampler);
} koksma__sampler;

koksma_status koksma__sample_scratch_init(koksma__sample_scratch *room, const koksma__sampler *sampler);
void koksma__sample_scratch_fini(koksma__sample_scratch *room);

/* Stores the coordinates of a use, which begin at `first` in points of `dim`, as floats below 1; the second is 0 unless
   the use has `two`. Sample i is point permutation[i], or point i if permutation is NULL. */
void koksma__keep_pairs(const double *xs, size_t n, int dim, int first, bool two, const uint32_t *permutation,
                        float *pairs);

/* ---- A new set in every pixel (pixel_samples.c) ----------------------------------------------------------------- */

/* Opens a sampler. It draws one set of each pattern first, so that a pattern that cannot have spp points fails here;
   only this calls run->keep_going. Errors: the pattern's, ARGUMENT, MEMORY, INTERRUPTED. */
koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

/* ---- One set over the whole image (image_samples.c) ------------------------------------------------------------- */

/* Returns the largest number of bytes that koksma__image_samples uses while it draws; afterwards it uses fewer. */
uint64_t koksma__image_samples_size(const koksma_render_options *options, const koksma__use_list *uses);

/* Opens a sampler. Errors: the pattern's, ARGUMENT, MEMORY. */
koksma_status koksma__image_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out);

/* ---- Sets of a pixel in single precision (float_sets.c) --------------------------------------------------------- */

/* The scratch memory of a thread for a set of n points: 2 n + 16 words, n pairs of coordinates, n + 64 indices. */
typedef struct koksma__float_scratch {
    uint32_t *fractions;
    float *pairs;
    uint16_t *order;
} koksma__float_scratch;

typedef struct koksma__float_set koksma__float_set;

/* Generates a set from set->words random words. `order` is the order of its points, or NULL for the pattern's own
   order; `offset` is added to all points. pairs[2 i] and pairs[2 i + 1] are the two coordinates of point i. */
typedef void koksma__float_draw(const koksma__float_set *set, const koksma__batch_table *batch, const uint32_t *words,
                                const uint16_t *order, const float offset[2], const koksma__float_scratch *scratch,
                                float *pairs);

/* The float form of a pattern for sets of n points in the plane or on the line (where y = 0). */
struct koksma__float_set {
    koksma__float_draw *draw; /* NULL if there is no float form */
    size_t n, words;
    int dim;
    bool in_random_order; /* whether `draw` needs an order even where the pairing does not shuffle the points */
    bool has_order;       /* whether the first words are for a random order, which `draw` finds in scratch->order */
    float *corners;       /* n pairs: the two coordinates of a cell's corner, or twice the start of a stratum */
    float scale[2];       /* factor from a 24-bit word to an offset within a cell */
    size_t columns, rows;
    uint32_t partners[2][32];
};

/* Initialises the float form of a pattern. set->draw is NULL if the pattern with these parameters and this n has
   none. Errors: the pattern's, MEMORY. */
koksma_status koksma__float_set_init(const koksma_spec *spec, size_t n, int dim, koksma__float_set *set);
void koksma__float_set_fini(koksma__float_set *set);

/* Returns the pattern name of float form i; NULL past the last one. */
const char *koksma__float_set_name(size_t i);

#endif
