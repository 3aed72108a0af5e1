/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Draws one point set over the whole image instead of one per pixel, an idea that Mitchell (1992) leaves as an open
 * question. Each use has a set of n = spp width height points. The set of the use `pixel`, stretched over the film,
 * determines which samples each pixel has, and how many. The samples of a pixel keep the order of the pattern.
 */
#include "render/samples/samples.h"

#include <stdlib.h>

#include "core/random.h"
#include "core/status.h"
#include "patterns/files/files.h"

#define MAX_NUMBERS ((size_t)1 << 28) /* largest number of floats for the samples of an image: 1 GiB */

typedef struct set {
    uint32_t use;
    bool drawn;
    float *pairs; /* one pair of coordinates per sample */
} set;

typedef struct image_samples {
    const koksma_render_options *options;
    size_t n, n_sets;
    uint32_t *first; /* the index in `order` of the first sample of each pixel, and n at the end */
    uint32_t *order; /* indices of the samples, sorted by pixel */
    set sets[];
} image_samples;

static size_t count(const koksma__sampler *sampler, uint64_t pixel)
{
    const image_samples *s = sampler->made;
    return s->first[pixel + 1] - s->first[pixel];
}

static koksma_status draw(const koksma__sampler *sampler, uint64_t pixel, uint32_t use, const float offset[2],
                          koksma__sample_scratch *room, float *pairs)
{
    const image_samples *s = sampler->made;
    const set *from = s->sets, *const end = s->sets + s->n_sets;
    (void)room;
    while (from < end && from->use != use) {
        from++;
    }
    KOKSMA__FAIL_IF(from == end, KOKSMA_ARGUMENT,
                    "the point sets of the image were drawn without a set for use number %u", (unsigned)use);
    const float width = (float)s->options->width, height = (float)s->options->height;
    for (uint32_t i = s->first[pixel]; i < s->first[pixel + 1]; i++) {
        const float *pair = from->pairs + 2 * (size_t)s->order[i];
        if (use == KOKSMA__USE_PIXEL) { /* film positions are stored in [0,1)^2 and returned in pixels */
            *pairs++ = pair[0] * width;
            *pairs++ = pair[1] * height;
        } else {
            *pairs++ = pair[0] + offset[0];
            *pairs++ = pair[1] + offset[1];
        }
    }
    return KOKSMA_OK;
}

static void release(koksma__sampler *sampler)
{
    image_samples *s = sampler->made;
    for (size_t i = 0; s && i < s->n_sets; i++) {
        free(s->sets[i].pairs);
    }
    if (s) {
        free(s->first);
        free(s->order);
    }
    free(s);
    *sampler = (koksma__sampler){0};
}

/* Draws a random order for the set with this key. *out is NULL where the pattern's order is kept: if the pairing is
   not shuffled, and for the film positions, which determine the pixel of each sample. */
static koksma_status draw_order(const image_samples *s, uint32_t set_key, uint32_t **out)
{
    *out = NULL;
    if (set_key == KOKSMA__USE_PIXEL || s->options->pairing != KOKSMA_PAIRING_SHUFFLED) {
        return KOKSMA_OK;
    }
    *out = malloc(s->n * sizeof **out);
    if (*out) {
        koksma__random_permutation(s->options->seed, set_key, (uint32_t)s->n, *out);
    }
    return *out ? KOKSMA_OK : koksma__fail_memory(s->n * sizeof **out);
}

/* Makes the set of a use, and stores the coordinates of all uses that share the set because they are in one group. */
static koksma_status make_set(image_samples *s, const koksma_run *run, set *to)
{
    const koksma_render_options *options = s->options;
    const koksma_spec *spec = koksma__use_spec(options, to->use);
    const int u = koksma__use_index(to->use);
    const koksma__place_of_use place = koksma__place_of_use_at(options, u);
    const uint32_t set_key = koksma__set_key(&place, to->use);
    const int dim = place.group < 0 ? koksma__use_set_dim(spec, u) : place.dim;
    koksma_points points = {0};
    koksma_status status = place.group < 0 ? koksma__check_single_use(spec) : KOKSMA_OK;
    status = status ? status : koksma_points_init(&points, s->n, dim);
    status = status ? status : koksma_generate(spec, koksma__random_seed(options->seed, 0, set_key), run, &points);
    status = koksma__file_gap(spec, s->n, status);
    uint32_t *order = NULL;
    status = status ? status : draw_order(s, set_key, &order);
    for (set *other = to; !status && other < s->sets + s->n_sets; other++) {
        const int v = koksma__use_index(other->use);
        const koksma__place_of_use at = koksma__place_of_use_at(options, v);
        if (other == to ||
            (at.group >= 0 && at.group == place.group && koksma__set_key(&at, other->use) == set_key)) {
            koksma__keep_pairs(points.xs, s->n, dim, at.first, koksma_use_at((size_t)v)->dim == 2, order,
                               other->pairs);
            other->drawn = true;
        }
    }
    free(order);
    koksma_points_fini(&points);
    return status;
}

static koksma_status make_native(image_samples *s, const koksma__use_list *uses, const koksma_run *run)
{
    const koksma_render_options *options = s->options;
    const int dim = koksma__use_dimension(uses, UINT32_MAX);
    koksma_points points;
    koksma_status status = koksma_points_init(&points, s->n, dim);
    status = status ? status : koksma_generate(&options->pattern, options->seed, run, &points);
    status = koksma__file_gap(&options->pattern, s->n, status);
    for (size_t i = 0; !status && i < s->n_sets; i++) {
        const uint32_t use = s->sets[i].use;
        const bool two = koksma_use_at((size_t)koksma__use_index(use))->dim == 2;
        koksma__keep_pairs(points.xs, s->n, dim, koksma__use_dimension(uses, use), two, NULL, s->sets[i].pairs);
    }
    koksma_points_fini(&points);
    return status;
}

static size_t pixel_of(const image_samples *s, size_t sample)
{
    const float *pair = s->sets[0].pairs + 2 * sample;
    const float width = (float)s->options->width, height = (float)s->options->height;
    /* rounding may give x = width or y = height, which are outside the film */
    const float x = pair[0] * width, y = pair[1] * height;
    const size_t column = x < width ? (size_t)x : (size_t)width - 1,
                 row = y < height ? (size_t)y : (size_t)height - 1;
    return row * (size_t)s->options->width + column;
}

/* Sorts the samples by pixel with a stable counting sort, and returns the largest number of samples in a pixel. */
static size_t sort(image_samples *s)
{
    const size_t pixels = (size_t)s->options->width * (size_t)s->options->height;
    size_t most = 1;
    for (size_t i = 0; i < s->n; i++) {
        s->first[pixel_of(s, i) + 1]++;
    }
    for (size_t p = 0; p < pixels; p++) {
        most = s->first[p + 1] > most ? s->first[p + 1] : most;
        s->first[p + 1] += s->first[p];
    }
    /* The loop begins with the last sample, so that each counter moves down to the first sample of its pixel. */
    for (size_t i = s->n; i-- > 0;) {
        s->order[--s->first[pixel_of(s, i) + 1]] = (uint32_t)i;
    }
    for (size_t p = 0; p < pixels; p++) {
        s->first[p] = s->first[p + 1];
    }
    s->first[pixels] = (uint32_t)s->n;
    return most;
}

/* Lists the uses of the image, the pixel first, and returns their number; with list NULL it only counts. */
static size_t list_uses(const koksma__use_list *uses, set *list)
{
    size_t n = 0;
    for (int v = 0; v < uses->vertices; v++) {
        for (int u = 0; u < KOKSMA_N_USES; u++) {
            const uint32_t number = koksma__use_number(u);
            const int times = number == KOKSMA__USE_LIGHT ? uses->lights : v == 0 || number > KOKSMA__USE_TIME;
            for (int l = 0; koksma__use_is_there(uses, u) && l < times; l++, n++) {
                if (list) {
                    list[n].use = (uint32_t)(v * KOKSMA__USES_A_BOUNCE + l) + number;
                }
            }
        }
    }
    return n;
}

uint64_t koksma__image_samples_size(const koksma_render_options *options, const koksma__use_list *uses)
{
    const uint64_t pixels = (uint64_t)options->width * (uint64_t)options->height, n = pixels * (uint64_t)options->spp;
    const uint64_t kept = (pixels + 2 + n) * sizeof(uint32_t) + 2 * n * list_uses(uses, NULL) * sizeof(float);
    if (options->pairing == KOKSMA_PAIRING_NATIVE) {
        return kept + n * (uint64_t)koksma__use_dimension(uses, UINT32_MAX) * sizeof(double);
    }
    return kept + 2 * n * sizeof(double) + (options->pairing == KOKSMA_PAIRING_SHUFFLED ? n * sizeof(uint32_t) : 0);
}

static koksma_status make_room(const koksma_render_options *options, const koksma__use_list *uses,
                               image_samples **out)
{
    const size_t pixels = (size_t)options->width * (size_t)options->height;
    const size_t n_sets = list_uses(uses, NULL);
    KOKSMA__FAIL_IF(pixels * (size_t)options->spp > MAX_NUMBERS / 2 / n_sets, KOKSMA_ARGUMENT,
                    "%dx%d pixels of %d samples with %zu uses: scope image can store at most %zu numbers, two for "
                    "each sample and use; use fewer pixels or samples",
                    options->width, options->height, options->spp, n_sets, MAX_NUMBERS);
    image_samples *s = calloc(1, sizeof *s + n_sets * sizeof *s->sets);
    *out = s;
    KOKSMA__REQUIRE_MEMORY(s, sizeof *s);
    s->options = options;
    s->n = pixels * (size_t)options->spp;
    s->n_sets = n_sets;
    list_uses(uses, s->sets);
    s->first = calloc(pixels + 2, sizeof *s->first);
    s->order = malloc(s->n * sizeof *s->order);
    bool all = s->first && s->order;
    for (size_t i = 0; i < n_sets; i++) {
        s->sets[i].pairs = malloc(2 * s->n * sizeof *s->sets[i].pairs);
        all &= s->sets[i].pairs != NULL;
    }
    return all ? KOKSMA_OK : koksma__fail_memory((2 * n_sets + 1) * s->n * sizeof(float));
}

koksma_status koksma__image_samples(const koksma_render_options *options, const koksma__use_list *uses,
                                    const koksma_run *run, koksma__sampler *out)
{
    image_samples *s = NULL;
    *out = (koksma__sampler){.most = 1, .count = count, .draw = draw, .release = release};
    koksma_status status = make_room(options, uses, &s);
    out->made = s;
    if (!status && options->pairing == KOKSMA_PAIRING_NATIVE) {
        status = make_native(s, uses, run);
    }
    for (size_t i = 0; !status && options->pairing != KOKSMA_PAIRING_NATIVE && i < s->n_sets; i++) {
        status = s->sets[i].drawn ? KOKSMA_OK : make_set(s, run, &s->sets[i]);
    }
    if (status) {
        release(out);
        return status;
    }
    out->most = sort(s);
    return KOKSMA_OK;
}
