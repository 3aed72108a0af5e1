/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A pattern afresh in every pixel. Distribution ray tracing needs a point in as many dimensions as there are uses.
 * Cook (1986) and Shirley (1991, section 5.5.4) build it from 2D sets, one a use, whose strata are matched by random
 * permutations ("uncorrelated jitter"): each use alone is as well spread as its pattern, and no use knows of another.
 * A native pattern has all the dimensions itself.
 */
#include <stdlib.h>
#include <string.h>

#include "core/random.h"
#include "core/spec.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "render/sampler.h"

enum { LANE_PAIRING = 1 << 20 }; /* above the uses: keys of the permutations' random numbers */

#define MAX_NATIVE ((size_t)1 << 27) /* numbers that a thread keeps of a native pattern */

typedef struct pixel_samples {
    const koksma_render_options *options;
    const koksma__batch_table *batch;
    koksma__use_list uses;
    /* By use. The pairs of a deterministic pattern are made once; else NULL. */
    float *fixed[KOKSMA_N_USES];
    int dims[KOKSMA_N_USES]; /* of the sets that are generated: 1 where use and pattern have one */
    bool shuffles[KOKSMA_N_USES];
} pixel_samples;

static size_t count(const koksma__sampler *sampler, uint64_t pixel)
{
    (void)pixel;
    return sampler->most;
}

static koksma_status generate(const koksma_spec *spec, uint64_t seed, size_t n, int dim, double *xs)
{
    static const koksma_run alone = {.threads = 1};
    koksma_points points = {n, dim, xs};
    return koksma_generate(spec, seed, &alone, &points);
}

/* Numbers to pairs, from the last so that it can be done in place. */
static void widen(double *xs, size_t n)
{
    for (size_t i = n; i-- > 0;) {
        xs[2 * i] = xs[i];
        xs[2 * i + 1] = 0;
    }
}

/* A fresh set of a use, plus offset. */
static koksma_status draw_set(const pixel_samples *samples, uint64_t pixel, uint32_t use, const float offset[2],
                              koksma__sample_room *room, float *pairs)
{
    const koksma_render_options *options = samples->options;
    const int dims = samples->dims[koksma__use_index(use)];
    const size_t n = (size_t)options->spp;
    const koksma_status status =
        generate(koksma__use_spec(options, use), koksma__random_seed(options->seed, pixel, use), n, dims, room->xs);
    if (status) {
        return status;
    }
    if (dims == 1) {
        widen(room->xs, n);
    }
    samples->batch->place(room->xs, n, offset, pairs);
    return KOKSMA_OK;
}

/* The words of the pixel's permutation. Pixels beside each other have theirs one after the other. */
static const uint32_t *pairing_words(const pixel_samples *samples, uint64_t pixel, uint32_t use,
                                     koksma__sample_room *room)
{
    const size_t counters = ((size_t)samples->options->spp + 3) / 4;
    const size_t pixels = counters < KOKSMA__WORD_COUNTERS ? KOKSMA__WORD_COUNTERS / counters : 1;
    const size_t room_for = 4 * (counters < KOKSMA__WORD_COUNTERS ? KOKSMA__WORD_COUNTERS : counters);
    const uint64_t part = pixel / pixels, key = (part << 20 | use) + 1; /* 0: nothing */
    uint32_t *words = room->words + use % KOKSMA__WORD_SLOTS * room_for;
    if (room->word_keys[use % KOKSMA__WORD_SLOTS] != key) {
        room->word_keys[use % KOKSMA__WORD_SLOTS] = key;
        koksma__kernels()->words(samples->options->seed, KOKSMA__PURPOSE_SHUFFLE, part * pixels * counters,
                                 LANE_PAIRING + use, pixels * counters, words);
    }
    return words + 4 * counters * (pixel % pixels);
}

static koksma_status draw(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_room *room, float *pairs)
{
    const pixel_samples *samples = sampler->made;
    const int u = koksma__use_index(use);
    const size_t n = (size_t)samples->options->spp;
    const bool shuffles = use != KOKSMA__USE_PIXEL && samples->shuffles[u];
    const float *from = samples->fixed[u];
    if (!from) {
        const koksma_status status = draw_set(samples, pixel, use, offset, room, shuffles ? room->pairs : pairs);
        if (status || !shuffles) {
            return status;
        }
        from = room->pairs;
    }
    if (!shuffles) {
        for (size_t i = 0; i < n; i++) {
            pairs[2 * i] = from[2 * i] + offset[0];
            pairs[2 * i + 1] = from[2 * i + 1] + offset[1];
        }
        return KOKSMA_OK;
    }
    samples->batch->shuffle(from, pairing_words(samples, pixel, use, room), n, pairs);
    return KOKSMA_OK;
}

static koksma_status draw_native(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                                 koksma__sample_room *room, float *pairs)
{
    const pixel_samples *samples = sampler->made;
    const size_t n = sampler->most, dim = (size_t)sampler->native_dim, slot = pixel % sampler->native_slots;
    double *set = room->native + slot * n * dim;
    if (room->native_pixels[slot] != pixel + 1) {
        const koksma_status status = generate(
            &samples->options->pattern, koksma__random_seed(samples->options->seed, pixel, 0), n, (int)dim, set);
        if (status) {
            return status;
        }
        room->native_pixels[slot] = pixel + 1;
    }
    const size_t first = (size_t)koksma__use_dimension(&samples->uses, use);
    const bool two = koksma_use_at((size_t)koksma__use_index(use))->dim == 2;
    for (size_t i = 0; i < n; i++) {
        room->xs[2 * i] = set[i * dim + first];
        room->xs[2 * i + 1] = two ? set[i * dim + first + 1] : 0;
    }
    samples->batch->place(room->xs, n, offset, pairs);
    return KOKSMA_OK;
}

static void release(koksma__sampler *sampler)
{
    pixel_samples *samples = sampler->made;
    for (int u = 0; samples && u < KOKSMA_N_USES; u++) {
        bool shared = false;
        for (int before = 0; before < u; before++) {
            shared |= samples->fixed[before] == samples->fixed[u];
        }
        if (!shared) {
            free(samples->fixed[u]);
        }
    }
    free(samples);
    *sampler = (koksma__sampler){0};
}

/* Draws one set in dims dimensions; *fixed keeps it when the pattern is deterministic. */
static koksma_status try_set(const koksma_render_options *options, const koksma_spec *spec, int dims, float **fixed)
{
    static const float nowhere[2] = {0, 0};
    const size_t n = (size_t)options->spp;
    double *xs = malloc(2 * n * sizeof *xs);
    *fixed = NULL;
    if (!xs) {
        return koksma__fail_memory(2 * n * sizeof *xs);
    }
    koksma_status status = generate(spec, options->seed, n, dims, xs);
    if (!status && koksma__is_deterministic(spec)) {
        *fixed = malloc(2 * n * sizeof **fixed);
        status = *fixed ? KOKSMA_OK : koksma__fail_memory(2 * n * sizeof **fixed);
        if (dims == 1) {
            widen(xs, n);
        }
        if (*fixed) {
            koksma__batch()->place(xs, n, nowhere, *fixed);
        }
    }
    free(xs);
    return status;
}

/* A use of one dimension takes a set of one dimension where the pattern has any; not from patterns that keep a
   distance, which is meant for the plane: there it takes the first coordinate. */
static koksma_status try_uses(pixel_samples *samples)
{
    const koksma_render_options *options = samples->options;
    bool tried[3] = {false};
    float *common[3] = {NULL};
    koksma_status status = KOKSMA_OK;
    for (int u = 0; !status && u < KOKSMA_N_USES; u++) {
        const bool own = options->patterns[u].pattern != NULL;
        const koksma_spec *spec = own ? &options->patterns[u] : &options->pattern;
        const unsigned claims = spec->pattern->claims;
        const bool one = koksma_use_at((size_t)u)->dim == 1 && spec->pattern->min_dim == 1;
        const int dims = one && !(claims & KOKSMA_CLAIM_MIN_DISTANCE) ? 1 : 2;
        samples->dims[u] = dims;
        samples->shuffles[u] = options->pairing == KOKSMA_PAIRING_SHUFFLED && !(claims & KOKSMA_CLAIM_EXCHANGEABLE);
        if (!koksma__use_is_there(&samples->uses, u)) {
            continue;
        }
        if (own) {
            status = try_set(options, spec, dims, &samples->fixed[u]);
        } else if (!tried[dims]) {
            status = try_set(options, spec, dims, &common[dims]);
            tried[dims] = true;
        }
        samples->fixed[u] = own ? samples->fixed[u] : common[dims];
    }
    return status;
}

static koksma_status try_native(koksma__sampler *sampler, const pixel_samples *samples)
{
    const koksma_render_options *options = samples->options;
    const int dim = koksma__use_dimension(&samples->uses, UINT32_MAX);
    const size_t n = (size_t)options->spp;
    for (int u = 0; u < KOKSMA_N_USES; u++) {
        if (options->patterns[u].pattern) {
            return koksma__fail(KOKSMA_ARGUMENT, "native pairing has one pattern for all uses; '%s' has its own",
                                koksma_use_at((size_t)u)->name);
        }
    }
    if (n * (size_t)dim > MAX_NATIVE) {
        return koksma__fail(KOKSMA_ARGUMENT, "%zu samples in %d dimensions: native pairing keeps at most %zu numbers",
                            n, dim, MAX_NATIVE);
    }
    double *xs = malloc(n * (size_t)dim * sizeof *xs);
    if (!xs) {
        return koksma__fail_memory(n * (size_t)dim * sizeof *xs);
    }
    const koksma_status status = generate(&options->pattern, options->seed, n, dim, xs);
    free(xs);
    sampler->draw = draw_native;
    sampler->native_dim = dim;
    sampler->native_slots = n < KOKSMA__BLOCK ? KOKSMA__BLOCK / n : 1;
    return status;
}

koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    koksma__sampler *out)
{
    pixel_samples *samples = calloc(1, sizeof *samples);
    *out = (koksma__sampler){.most = (size_t)options->spp, .count = count, .draw = draw, .release = release};
    if (!samples) {
        return koksma__fail_memory(sizeof *samples);
    }
    *samples = (pixel_samples){.options = options, .batch = koksma__batch(), .uses = *uses};
    out->made = samples;
    koksma_status status = KOKSMA_OK;
    if (options->pairing == KOKSMA_PAIRING_NATIVE) {
        status = try_native(out, samples);
    } else {
        status = try_uses(samples);
    }
    if (status) {
        release(out);
    }
    return status;
}
