/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Draws a new point set of the pattern in every pixel. Distribution ray tracing needs, for each sample, a point with
 * the dimensions of all uses. Cook (1986) and Shirley (1991, section 5.5.4) build such points from 2D sets, one per
 * use, whose strata are matched by random permutations ("uncorrelated jitter"): the set of each use alone is as well
 * spread as its pattern, and the uses are independent. A pattern with native pairing has the dimensions of all uses,
 * and the pattern of a group has the dimensions of the group's uses; the coordinates of each such point stay together
 * in one sample.
 *
 * The random words are hashes of (seed, pixel, use). float_sets.c makes the pairs of a use in floats if its pattern
 * has such a form; koksma_generate makes all others.
 */
#include "render/samples/samples.h"

#include <stdlib.h>

#include "core/parallel.h"
#include "core/random.h"
#include "core/spec.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "patterns/files/files.h"
#include "patterns/masks/tile_size.h"

/* base of the keys for the random numbers of permutations, above the keys of all uses */
enum { LANE_PAIRING = 1 << 20 };

/* largest number of coordinates that a thread stores of a native pattern or of groups of uses */
#define MAX_KEPT ((size_t)1 << 27)

typedef struct pixel_samples {
    const koksma_render_options *options;
    const koksma__batch_table *batch;
    koksma__use_list uses;
    /* The arrays below are indexed by use. `fixed` has point sets that are made only once: the one set of a
       deterministic pattern, or all sets of a family of files (file_names.h), of which the seed of a pixel chooses
       one; otherwise it is NULL. */
    float *fixed[KOKSMA_N_USES];
    size_t fixed_sets[KOKSMA_N_USES];
    /* width and height of the tile of a pattern by masks, whose sets `fixed` has, one for each pixel of the tile, which
       repeats over the image; 0: the pattern has none */
    size_t tiles[KOKSMA_N_USES][2];
    int dims[KOKSMA_N_USES]; /* number of dimensions of the generated sets */
    koksma__float_set floats[KOKSMA_N_USES];
    bool shuffles[KOKSMA_N_USES];
    koksma__place_of_use places[KOKSMA_N_USES];
    /* for each group, the index of its first dimension in the scratch, which holds the groups one after the other */
    size_t kept_first[KOKSMA_MAX_USE_GROUPS];
} pixel_samples;

static size_t count(const koksma__sampler *sampler, uint64_t pixel)
{
    (void)pixel;
    return sampler->most;
}

static koksma_status generate(const koksma_spec *spec, uint64_t seed, size_t n, int dim, const koksma_run *run,
                              double *xs)
{
    koksma_points points = {n, dim, xs};
    return koksma_generate(spec, seed, run, &points);
}

/* Makes the set of a pixel. `key` is that of the use or group. A pattern of images has one seed for all pixels, of an
   image that holds this one; z-sampler needs a power of two. One without ranges makes its image in each pixel. */
static koksma_status generate_at(const koksma_render_options *options, const koksma_spec *spec, uint64_t pixel,
                                 uint32_t key, int dim, const koksma_run *run, double *xs)
{
    const uint64_t width = (uint64_t)options->width, n = (uint64_t)options->spp;
    uint64_t side = 1;
    koksma_points points = {(size_t)n, dim, xs};
    koksma_spec image = *spec;
    while (side < width || side < (uint64_t)options->height) {
        side *= 2;
    }
    if (!koksma_has_ranges(spec) || !koksma__fit_image(&image, (int)side)) {
        return generate(spec, koksma__random_seed(options->seed, pixel, key), (size_t)n, dim, run, xs);
    }
    return koksma_generate_range(&image, koksma__random_seed(options->seed, 0, key), side * side * n,
                                 (pixel / width * side + pixel % width) * n, run, &points);
}

enum { SETS_A_LOOK = 16 };

/* Calls generate() for the set of a pixel and, before every SETS_A_LOOK-th set, keep_going: a slow pattern takes ten
   milliseconds per set and does not call keep_going itself, and the sets of all pixels that are drawn together take
   minutes. As often it is asked whether the file of a pattern has changed. */
static koksma_status generate_next(const koksma_render_options *options, const koksma_spec *spec, uint64_t pixel,
                                   uint32_t key, int dim, koksma__sample_scratch *room, double *xs)
{
    if (++room->sets % SETS_A_LOOK == 0 && !koksma__keep_going(room->run, 0)) {
        return koksma__fail_interrupted();
    }
    const bool trusted = koksma__trust_files(room->sets % SETS_A_LOOK != 1);
    const koksma_status status = generate_at(options, spec, pixel, key, dim, room->run, xs);
    koksma__trust_files(trusted);
    return status;
}

/* Expands numbers to pairs (x, 0) in place, beginning with the last number. */
static void widen(double *xs, size_t n)
{
    for (size_t i = n; i-- > 0;) {
        xs[2 * i] = xs[i];
        xs[2 * i + 1] = 0;
    }
}

/* Extracts the coordinates of one use, as pairs, from points with more coordinates. */
static void take_out(const double *points, size_t n, int dim, int first, bool two, double *pairs)
{
    for (size_t i = 0; i < n; i++, points += dim) {
        pairs[2 * i] = points[first];
        pairs[2 * i + 1] = two ? points[first + 1] : 0;
    }
}

static bool has_two(uint32_t use)
{
    return koksma_use_at((size_t)koksma__use_index(use))->dim == 2;
}

/* Draws the set of a group, of which it is number `group` in the scratch and begins there at dimension `first`. The scratch
   keeps the set, because the other uses of the group are drawn later, after this use has been drawn for the neighbouring
   pixels. */
static koksma_status draw_kept(const koksma__sampler *sampler, uint64_t pixel, uint32_t set_key, size_t group,
                               const koksma_spec *spec, int dim, size_t first, koksma__sample_scratch *room,
                               const double **out)
{
    const pixel_samples *samples = sampler->made;
    const size_t n = (size_t)samples->options->spp, slot = pixel % sampler->kept_slots;
    const uint64_t key = (pixel << 20 | set_key) + 1; /* 0 is the key of an empty slot */
    uint64_t *kept = &room->kept_keys[slot * sampler->kept_sets + group];
    double *set = room->kept + n * (slot * (size_t)sampler->kept_dim + first);
    if (*kept != key) {
        *kept = 0;
        KOKSMA__TRY(generate_next(samples->options, spec, pixel, set_key, dim, room, set));
        *kept = key;
    }
    *out = set;
    return KOKSMA_OK;
}

/* Draws a new set for a use and adds the offset. */
static koksma_status draw_set(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                              koksma__sample_scratch *room, float *pairs)
{
    const pixel_samples *samples = sampler->made;
    const koksma_render_options *options = samples->options;
    const int u = koksma__use_index(use), dims = samples->dims[u];
    const size_t n = (size_t)options->spp;
    const koksma__place_of_use *place = &samples->places[u];
    const double *set;
    if (place->group >= 0) {
        KOKSMA__TRY(draw_kept(sampler, pixel, koksma__set_key(place, use), (size_t)place->group,
                              &options->groups[place->group].pattern, place->dim, samples->kept_first[place->group],
                              room, &set));
        take_out(set, n, place->dim, place->first, has_two(use), room->xs);
    } else {
        KOKSMA__TRY(generate_next(options, koksma__use_spec(options, use), pixel, use, dims, room, room->xs));
        if (dims == 1) {
            widen(room->xs, n);
        }
    }
    samples->batch->place(room->xs, n, offset, pairs);
    return KOKSMA_OK;
}

/* The random words that a use needs in each pixel: for its set, if the pattern has a float form, or for the order of
   a set that koksma_generate makes. */
typedef struct demand {
    const koksma__float_set *floats; /* NULL: koksma_generate makes the set */
    /* ordered: whether the first words are for the kernel `order`, which makes a random order */
    bool shuffles, ordered;
    size_t counters; /* number of random counters, each of which gives four words */
    uint32_t key;
} demand;

static demand demand_of(const pixel_samples *samples, uint32_t use)
{
    const int u = koksma__use_index(use);
    const size_t n = (size_t)samples->options->spp;
    const uint32_t set_key = koksma__set_key(&samples->places[u], use);
    const koksma__float_set *set = samples->floats[u].draw ? &samples->floats[u] : NULL;
    demand d = {set, set_key != KOKSMA__USE_PIXEL && samples->shuffles[u], false, 0,
                set ? use : LANE_PAIRING + set_key};
    d.ordered = (d.shuffles && n <= KOKSMA__ORDERED) || (set && set->in_random_order);
    d.counters = (d.ordered ? koksma__order_words(n) : !set && d.shuffles ? n : 0) + (set ? set->words : 0);
    d.counters = (d.counters + 3) / 4;
    return d;
}

/* Returns the part of the scratch that holds the orders which the float forms themselves need, one for each pixel. */
static uint16_t *own_orders(const koksma__sample_scratch *room, size_t n)
{
    return room->order + room->room_for * n + 64;
}

/* Draws the random words of the pixels first .. first + count - 1, and makes their random orders. */
static void draw_words(const pixel_samples *samples, const demand *d, uint64_t first, size_t count,
                       koksma__sample_scratch *room)
{
    const size_t n = (size_t)samples->options->spp;
    if (d->counters) {
        koksma__kernels()->draws(samples->options->seed, KOKSMA__PURPOSE_PIXEL, first * d->counters, d->key,
                                 count * d->counters, room->words);
    }
    /* ascending, because the kernel may write beyond an order, into the place of the next one */
    for (size_t p = 0; d->ordered && p < count; p++) {
        samples->batch->order(room->words + 4 * p * d->counters, n, room->order + p * n);
    }
    const size_t first_own = d->ordered ? koksma__order_words(n) : 0;
    for (size_t p = 0; d->floats && d->floats->has_order && p < count; p++) {
        samples->batch->order(room->words + 4 * p * d->counters + first_own, n, own_orders(room, n) + p * n);
    }
}

static void prepare(const koksma__sampler *sampler, uint64_t first, size_t count, uint32_t use,
                    koksma__sample_scratch *room)
{
    const demand d = demand_of(sampler->made, use);
    room->first = first;
    room->count = count < room->room_for ? count : room->room_for;
    draw_words(sampler->made, &d, first, room->count, room);
}

/* Returns which of the fixed sets a pixel takes. A tile is shifted for each use and bounce, so that these differ. */
static size_t chosen_set(const pixel_samples *samples, int u, uint64_t pixel, uint32_t use)
{
    const koksma_render_options *options = samples->options;
    const size_t *tile = samples->tiles[u], width = (size_t)options->width;
    if (!tile[0]) {
        return (size_t)(koksma__random_seed(options->seed, pixel, use) % samples->fixed_sets[u]);
    }
    const koksma__words shift = koksma__random(options->seed, KOKSMA__PURPOSE_SHIFT, use, 1);
    const size_t x = ((size_t)pixel % width + koksma__below(shift.w[0], (uint32_t)tile[0])) % tile[0];
    const size_t y = ((size_t)pixel / width + koksma__below(shift.w[1], (uint32_t)tile[1])) % tile[1];
    return y * tile[0] + x;
}

static koksma_status draw(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs)
{
    const pixel_samples *samples = sampler->made;
    const int u = koksma__use_index(use);
    const size_t n = (size_t)samples->options->spp;
    const demand d = demand_of(samples, use);
    const bool prepared = pixel >= room->first && pixel - room->first < room->count;
    const size_t at = prepared ? pixel - room->first : 0;
    const uint32_t *words = room->words + 4 * at * d.counters;
    const uint16_t *order = d.ordered ? room->order + at * n : NULL;
    const float *from = samples->fixed[u];
    if (!prepared) {
        draw_words(samples, &d, pixel, 1, room);
    }
    if (d.floats) {
        const koksma__float_scratch scratch = {(uint32_t *)(void *)room->xs, room->pairs,
                                               own_orders(room, n) + at * n};
        d.floats->draw(d.floats, samples->batch, words + (order ? koksma__order_words(n) : 0), order, offset,
                       &scratch, pairs);
        return KOKSMA_OK;
    }
    if (from && samples->fixed_sets[u] > 1) {
        from += 2 * n * chosen_set(samples, u, pixel, use);
    }
    if (!from) {
        const koksma_status status = draw_set(sampler, pixel, use, offset, room, d.shuffles ? room->pairs : pairs);
        if (status || !d.shuffles) {
            return status;
        }
        from = room->pairs;
    }
    if (!d.shuffles) {
        samples->batch->move(from, offset, n, pairs);
    } else if (order) {
        samples->batch->gather(from, order, n, pairs);
    } else {
        samples->batch->shuffle(from, words, n, pairs);
    }
    return KOKSMA_OK;
}

static koksma_status draw_native(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                                 koksma__sample_scratch *room, float *pairs)
{
    const pixel_samples *samples = sampler->made;
    const size_t n = (size_t)samples->options->spp;
    const double *set;
    KOKSMA__TRY(draw_kept(sampler, pixel, 0, 0, &samples->options->pattern, sampler->kept_dim, 0, room, &set));
    take_out(set, n, sampler->kept_dim, koksma__use_dimension(&samples->uses, use), has_two(use), room->xs);
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
        koksma__float_set_fini(&samples->floats[u]);
    }
    free(samples);
    *sampler = (koksma__sampler){0};
}

/* Allocates *fixed and fills it with the pairs of one use, whose coordinates begin at `first`. */
static koksma_status keep_fixed(const double *set, size_t n, int dim, int first, bool two, float **fixed)
{
    *fixed = malloc(2 * n * sizeof **fixed);
    KOKSMA__REQUIRE_MEMORY(*fixed, 2 * n * sizeof **fixed);
    koksma__keep_pairs(set, n, dim, first, two, NULL, *fixed);
    return KOKSMA_OK;
}

/* Makes the set of the first pixel, which checks the pattern. The caller frees *xs even after a failure. */
static koksma_status try_points(const koksma_render_options *options, const koksma_spec *spec, int dim,
                                const koksma_run *run, double **xs)
{
    const size_t bytes = (size_t)options->spp * (size_t)dim * sizeof **xs;
    *xs = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(*xs, bytes);
    return generate_at(options, spec, 0, 0, dim, run, *xs);
}

/* Reads all sets of n points of a family of files in advance, so that no pixel has to open a file. */
static koksma_status read_sets(const koksma_spec *spec, size_t n, int dims, const koksma_run *run, float **fixed,
                               size_t *n_sets)
{
    koksma__file_set *sets = NULL;
    size_t count = 0;
    koksma_status status = koksma__file_sets(spec->path, &sets, &count);
    *n_sets = 0;
    double *xs = malloc((size_t)dims * n * sizeof *xs);
    *fixed = count && n <= MAX_KEPT / count ? malloc(2 * n * count * sizeof **fixed) : NULL;
    if (!status && (!xs || (count && !*fixed))) {
        status = koksma__fail_memory(2 * n * count * sizeof **fixed);
    }
    for (size_t i = 0; !status && i < count; i++) {
        if (sets[i].n && sets[i].n != n) {
            continue;
        }
        status = generate(spec, sets[i].seed, n, dims, run, xs);
        if (!status) {
            koksma__keep_pairs(xs, n, dims, 0, dims == 2, NULL, *fixed + 2 * n * (*n_sets)++);
        }
    }
    if (!status && !*n_sets) {
        status = koksma__file_fail_n(spec->path, n, KOKSMA_MISSING);
    }
    if (status) {
        free(*fixed);
        *fixed = NULL;
    }
    free(sets);
    free(xs);
    return status;
}

/* Draws one set in dims dimensions to check the pattern; stores it in *fixed if the pattern is deterministic. */
static koksma_status try_set(const koksma_render_options *options, const koksma_spec *spec, int dims,
                             const koksma_run *run, float **fixed, size_t *n_sets)
{
    const size_t n = (size_t)options->spp;
    *n_sets = 1;
    if (koksma__reads_points(spec->pattern) && !koksma__modifiers_are_random(spec->modifiers) &&
        koksma__file_has(spec->path, "{seed}")) {
        return read_sets(spec, n, dims, run, fixed, n_sets);
    }
    double *xs = NULL;
    *fixed = NULL;
    koksma_status status = koksma__check_single_use(spec);
    status = status ? status : try_points(options, spec, dims, run, &xs);
    if (!status && koksma_has_one_set(spec)) {
        status = keep_fixed(xs, n, dims, 0, dims == 2, fixed);
    }
    free(xs);
    return status;
}

/* Makes the sets of all pixels of a tile, for one use. */
static koksma_status make_tile(const koksma_render_options *options, const koksma_spec *spec, int u, int dims,
                               const koksma_run *run, const size_t tile[2], float **fixed)
{
    const size_t n = (size_t)options->spp * tile[0] * tile[1];
    KOKSMA__FAIL_IF(n > MAX_KEPT / 2, KOKSMA_ARGUMENT,
                    "%s: a tile of %zu x %zu pixels can have %zu samples a pixel, not %d", spec->pattern->name,
                    tile[0], tile[1], MAX_KEPT / 2 / (tile[0] * tile[1]), options->spp);
    double *xs = malloc((size_t)dims * n * sizeof *xs);
    KOKSMA__REQUIRE_MEMORY(xs, (size_t)dims * n * sizeof *xs);
    const uint64_t seed = koksma__random_seed(options->seed, (uint64_t)u, KOKSMA__PURPOSE_SHIFT);
    koksma_status status = generate(spec, seed, n, dims, run, xs);
    status = status ? status : keep_fixed(xs, n, dims, 0, dims == 2, fixed);
    free(xs);
    return status;
}

static koksma_status try_uses(pixel_samples *samples, const koksma_run *run)
{
    const koksma_render_options *options = samples->options;
    bool tried[3] = {false};
    float *common[3] = {NULL};
    size_t common_sets[3] = {0};
    koksma_status status = KOKSMA_OK;
    for (int u = 0; !status && u < KOKSMA_N_USES; u++) {
        const bool own = options->patterns[u].pattern != NULL;
        const koksma_spec *spec = own ? &options->patterns[u] : &options->pattern;
        const int dims = koksma__use_set_dim(spec, u);
        if (samples->places[u].group >= 0) {
            continue;
        }
        samples->dims[u] = dims;
        samples->shuffles[u] =
            options->pairing == KOKSMA_PAIRING_SHUFFLED && !(spec->pattern->claims & KOKSMA_CLAIM_EXCHANGEABLE);
        if (!koksma__use_is_there(&samples->uses, u)) {
            continue;
        }
        status = koksma__tile_size(spec, samples->tiles[u]);
        if (!status && samples->tiles[u][0]) {
            samples->fixed_sets[u] = samples->tiles[u][0] * samples->tiles[u][1];
            status = make_tile(options, spec, u, dims, run, samples->tiles[u], &samples->fixed[u]);
            continue;
        }
        if (status) {
            continue;
        }
        if (own) {
            status = try_set(options, spec, dims, run, &samples->fixed[u], &samples->fixed_sets[u]);
        } else if (!tried[dims]) {
            status = try_set(options, spec, dims, run, &common[dims], &common_sets[dims]);
            tried[dims] = true;
        }
        samples->fixed[u] = own ? samples->fixed[u] : common[dims];
        samples->fixed_sets[u] = own ? samples->fixed_sets[u] : common_sets[dims];
        status = status ? status : koksma__float_set_init(spec, (size_t)options->spp, dims, &samples->floats[u]);
    }
    return status;
}

static koksma_status check_kept(size_t n, int dim, const char *of)
{
    return n * (size_t)dim > MAX_KEPT
               ? koksma__fail(
                     KOKSMA_ARGUMENT,
                     "%zu samples in %d dimensions: %s can store at most %zu numbers; use fewer samples a pixel", n,
                     dim, of, MAX_KEPT)
               : KOKSMA_OK;
}

/* Draws one set of a group to check its pattern; if the pattern is deterministic, stores the pairs of its uses. */
static koksma_status try_group(pixel_samples *samples, int g, const koksma_run *run)
{
    const koksma_render_options *options = samples->options;
    const koksma_use_group *group = &options->groups[g];
    const size_t n = (size_t)options->spp;
    const int dim = samples->places[group->uses[0]].dim;
    double *xs;
    koksma_status status = try_points(options, &group->pattern, dim, run, &xs);
    for (int i = 0; !status && i < group->n_uses; i++) {
        const int u = group->uses[i];
        samples->shuffles[u] = options->pairing == KOKSMA_PAIRING_SHUFFLED &&
                               !(group->pattern.pattern->claims & KOKSMA_CLAIM_EXCHANGEABLE);
        if (koksma_has_one_set(&group->pattern)) {
            status = keep_fixed(xs, n, dim, samples->places[u].first, koksma_use_at((size_t)u)->dim == 2,
                                &samples->fixed[u]);
        }
    }
    free(xs);
    return status;
}

/* Checks each group that has a use which the image needs. */
static koksma_status try_groups(koksma__sampler *sampler, pixel_samples *samples, const koksma_run *run)
{
    const koksma_use_group *groups = samples->options->groups;
    const size_t n = (size_t)samples->options->spp;
    koksma_status status = KOKSMA_OK;
    for (int g = 0; !status && g < KOKSMA_MAX_USE_GROUPS; g++) {
        bool is_there = false;
        for (int i = 0; i < groups[g].n_uses; i++) {
            is_there |= koksma__use_is_there(&samples->uses, groups[g].uses[i]);
        }
        if (is_there) {
            samples->kept_first[g] = (size_t)sampler->kept_dim;
            sampler->kept_dim += samples->places[groups[g].uses[0]].dim;
            status = check_kept(n, sampler->kept_dim, "a group of uses");
            status = status ? status : try_group(samples, g, run);
        }
    }
    sampler->kept_sets = KOKSMA_MAX_USE_GROUPS;
    sampler->kept_slots = sampler->kept_dim == 0 ? 0 : n < KOKSMA__BLOCK ? KOKSMA__BLOCK / n : 1;
    return status;
}

static koksma_status try_native(koksma__sampler *sampler, const pixel_samples *samples, const koksma_run *run)
{
    const koksma_render_options *options = samples->options;
    const int dim = koksma__use_dimension(&samples->uses, UINT32_MAX);
    const size_t n = (size_t)options->spp;
    double *xs = NULL;
    koksma_status status = check_kept(n, dim, "native pairing");
    status = status ? status : try_points(options, &options->pattern, dim, run, &xs);
    free(xs);
    sampler->draw = draw_native;
    sampler->prepare = NULL;
    sampler->kept_dim = dim;
    sampler->kept_sets = 1;
    sampler->kept_slots = n < KOKSMA__BLOCK ? KOKSMA__BLOCK / n : 1;
    return status;
}

koksma_status koksma__pixel_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out)
{
    koksma__phases phases = {0};
    koksma_run first = koksma__phase_run(&phases, run, 0);
    first.threads = 1;
    pixel_samples *samples = calloc(1, sizeof *samples);
    *out = (koksma__sampler){
        .most = (size_t)options->spp, .count = count, .prepare = prepare, .draw = draw, .release = release};
    KOKSMA__REQUIRE_MEMORY(samples, sizeof *samples);
    *samples = (pixel_samples){.options = options, .batch = koksma__batch(), .uses = *uses};
    out->made = samples;
    for (int u = 0; u < KOKSMA_N_USES; u++) {
        samples->places[u] = koksma__place_of_use_at(options, u);
    }
    koksma_status status = KOKSMA_OK;
    if (options->pairing == KOKSMA_PAIRING_NATIVE) {
        status = try_native(out, samples, &first);
    } else {
        status = try_uses(samples, &first);
        status = status ? status : try_groups(out, samples, &first);
    }
    if (status) {
        release(out);
    }
    return status;
}
