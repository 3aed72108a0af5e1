/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Arranges the values of a mask by simulated annealing (Kirkpatrick et al. 1983). A proposal swaps two pixels whose
 * values are d places apart in the sorted list, d uniform up to a range that shrinks geometrically with the temperature:
 * distant values are soon always refused, and a quarter to half of the proposals among close ones are accepted to the
 * end. Of the same number of proposals between random pixels a few in a hundred are accepted, and the error stays 4 %
 * larger (docs/findings/masks.md).
 *
 * A swap changes only the terms of the windows about its two pixels, which the kernel mask_growth sums in floats. A pixel
 * beyond the border of an open mask has no error: the terms with it are h(v), the mean distance, in place of a distance.
 *
 * Proposal i depends on the seed and i alone, so a search can be continued from the arrangement that it left: which of
 * the sorted values each pixel has, since equal ones differ by their place in the list.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/clock.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/random.h"
#include "core/status.h"
#include "kernels/kernels.h"
#include "masks/masks.h"

/* The temperature at the beginning and at the end, in units of A(0) times three times the mean distance of two values (for
   uniform scalars that mean is 1/3), and the largest distance in the sorted list as a share of its length. */
static const double HOT = 0.03, COLD = 0.0004, FAR_OF_NUMBERS = 0.3, FAR_OF_VECTORS = 1, NEAR = 0.015;

/* Weights of the window below this share of A(0) are left out of the search. */
static const double LEAST = 1e-4;

enum { LANES = 8, BLOCK = 1024, MOST_SWAPS = 1000000 };

typedef struct search {
    const koksma_mask_options *options;
    koksma__mask_values *values;
    koksma__mask_window window;
    const koksma__kernel_table *kernels;
    size_t span, stride,
        plane;          /* padded row of the window; row of pixels with its border; all pixels of a coordinate */
    float *weights;     /* the window in rows of `span`, divided by A(0), with 0 for the pixel itself */
    float *near_border; /* the same with 0 beyond the border of an open mask, made anew for each pixel */
    float *pixels;      /* coordinate k of each pixel with the border, at k * plane */
    uint32_t *pixel;    /* the pixel of each value */
    double *h;          /* mean distance of each value from all */
    double *outside;    /* of an open mask: the weight that lies beyond its border, for each pixel */
    double mean;        /* mean of h */
    double error_square,
        scale; /* the error's square now; by how much it changes with the growth of the energy by 1 */
} search;

static size_t width_of(const search *s)
{
    return (size_t)s->options->width;
}

static const float *value_of(const search *s, uint32_t pixel)
{
    return s->values->search + (size_t)s->values->value[pixel] * (size_t)s->values->dim;
}

/* Returns the position of the upper left pixel of a pixel's window, which is the pixel's own in an array without a
   border. */
static size_t corner_of(const search *s, uint32_t pixel)
{
    return pixel / width_of(s) * s->stride + pixel % width_of(s);
}

/* Sets the value of a pixel, and of its copies in the border of a torus. */
static void place(search *s, uint32_t pixel, uint32_t value)
{
    const koksma__mask_window *w = &s->window;
    const int width = s->options->width, height = s->options->height, x = (int)pixel % width, y = (int)pixel / width;
    const int down = s->options->open ? 2 * height + w->before[1] + w->after[1] : height;
    const int right = s->options->open ? 2 * width + w->before[0] + w->after[0] : width;
    const int first_y = s->options->open ? y + w->before[1] : (y + w->before[1]) % height;
    const int first_x = s->options->open ? x + w->before[0] : (x + w->before[0]) % width;
    s->values->value[pixel] = value;
    s->pixel[value] = pixel;
    for (int k = 0; k < s->values->dim; k++) {
        const float number = s->values->search[(size_t)value * (size_t)s->values->dim + (size_t)k];
        float *plane = s->pixels + (size_t)k * s->plane;
        for (int b = first_y; b < height + w->before[1] + w->after[1]; b += down) {
            for (int a = first_x; a < width + w->before[0] + w->after[0]; a += right) {
                plane[(size_t)b * s->stride + (size_t)a] = number;
            }
        }
    }
}

/* Returns the weights of a pixel's window, 0 beyond the border of an open mask. */
static const float *weights_at(search *s, uint32_t pixel)
{
    const koksma__mask_window *w = &s->window;
    const int x = (int)(pixel % width_of(s)), y = (int)(pixel / width_of(s));
    if (!s->options->open || s->outside[pixel] == 0) {
        return s->weights;
    }
    for (int dy = -w->before[1]; dy <= w->after[1]; dy++) {
        for (int dx = -w->before[0]; dx <= w->after[0]; dx++) {
            const bool inside =
                y + dy >= 0 && y + dy < s->options->height && x + dx >= 0 && x + dx < s->options->width;
            const size_t at = (size_t)(dy + w->before[1]) * s->span + (size_t)(dx + w->before[0]);
            s->near_border[at] = inside ? s->weights[at] : 0;
        }
    }
    return s->near_border;
}

/* Returns the weight between two pixels. */
static double weight_between(const search *s, uint32_t p, uint32_t q)
{
    const koksma__mask_window *w = &s->window;
    const int sizes[2] = {s->options->width, s->options->height};
    int d[2] = {(int)(q % width_of(s)) - (int)(p % width_of(s)), (int)(q / width_of(s)) - (int)(p / width_of(s))};
    for (int axis = 0; axis < 2; axis++) {
        if (!s->options->open) {
            d[axis] += d[axis] < -w->before[axis] ? sizes[axis] : d[axis] > w->after[axis] ? -sizes[axis] : 0;
        }
        if (d[axis] < -w->before[axis] || d[axis] > w->after[axis]) {
            return 0;
        }
    }
    return (double)s->weights[(size_t)(d[1] + w->before[1]) * s->span + (size_t)(d[0] + w->before[0])];
}

/* Returns by how much the energy grows, -1/2 times the sum of A(p - q) |v_p - v_q|, when two pixels swap their values.
   Each window counts the pair as if the other pixel kept its value, whereas the pair's own term does not change. */
static double growth_of_swap(search *s, uint32_t p, uint32_t q)
{
    const int dim = s->values->dim;
    const float *a = value_of(s, p), *b = value_of(s, q);
    double growth = 0;
    growth += (double)s->kernels->mask_growth(s->window.rows, s->span, s->stride, s->plane, dim, weights_at(s, p),
                                              s->pixels + corner_of(s, p), a, b);
    growth += (double)s->kernels->mask_growth(s->window.rows, s->span, s->stride, s->plane, dim, weights_at(s, q),
                                              s->pixels + corner_of(s, q), b, a);
    const double weight = weight_between(s, p, q);
    if (weight != 0) {
        double square = 0;
        for (int k = 0; k < dim; k++) {
            square += ((double)a[k] - (double)b[k]) * ((double)a[k] - (double)b[k]);
        }
        growth -= 2 * weight * sqrt(square);
    }
    if (s->outside) {
        growth += (s->h[s->values->value[p]] - s->h[s->values->value[q]]) * (s->outside[p] - s->outside[q]);
    }
    return growth;
}

/* Makes proposals first .. first + count - 1 of all. */
static void propose(search *s, uint64_t first, size_t count, uint64_t all)
{
    uint32_t words[4 * BLOCK + 32];
    const double far = s->values->dim == 1 ? FAR_OF_NUMBERS : FAR_OF_VECTORS;
    const double done = (double)first / (double)all, cool = koksma__log(COLD / HOT), narrow = koksma__log(NEAR / far);
    const double temperature = 3 * s->mean * HOT * koksma__exp(done * cool);
    const uint32_t n = (uint32_t)s->values->n;
    const uint32_t range = 1 + (uint32_t)((n - 1) * far * koksma__exp(done * narrow));
    s->kernels->draws(s->options->seed, KOKSMA__PURPOSE_SEARCH, first, 0, count, words);
    for (size_t i = 0; i < count; i++) {
        const uint32_t *w = words + 4 * i, a = koksma__below(w[0], n), b = a + 1 + koksma__below(w[1], range);
        if (b >= n) {
            continue;
        }
        const uint32_t p = s->pixel[a], q = s->pixel[b];
        const double growth = growth_of_swap(s, p, q);
        if (growth <= 0 || koksma__exp(-growth / temperature) > koksma__unit(w[2], w[3])) {
            place(s, p, b);
            place(s, q, a);
            s->error_square += growth * s->scale;
        }
    }
}

/* Runs the proposals that are left. */
static koksma_status anneal(search *s, const koksma_run *run, koksma_mask_result *result)
{
    const koksma_mask_options *o = s->options;
    const uint64_t all = (uint64_t)(o->swaps * (double)s->values->n);
    const double end_s = run && run->time_limit_s > 0 ? koksma__now_s() + run->time_limit_s : (double)INFINITY;
    const double target = o->target > 0 ? o->target * o->target : -1;
    uint64_t i = o->done;
    result->finished = true;
    while (i < all && s->error_square > target) {
        const size_t count = all - i < BLOCK ? (size_t)(all - i) : BLOCK;
        propose(s, i, count, all);
        i += count;
        if (!koksma__keep_going(run, (double)i / (double)all)) {
            return koksma__fail_interrupted();
        }
        if (koksma__now_s() >= end_s) {
            result->finished = i >= all;
            break;
        }
    }
    result->done = i;
    return KOKSMA_OK;
}

/* Sets s->outside of an open mask: the weight beyond the border. */
static void weigh_outside(search *s)
{
    const koksma__mask_window *w = &s->window;
    for (int p = 0; p < s->options->width * s->options->height; p++) {
        const int x = p % s->options->width, y = p / s->options->width;
        for (int dy = -w->before[1]; dy <= w->after[1]; dy++) {
            for (int dx = -w->before[0]; dx <= w->after[0]; dx++) {
                const bool inside =
                    y + dy >= 0 && y + dy < s->options->height && x + dx >= 0 && x + dx < s->options->width;
                const size_t at = (size_t)(dy + w->before[1]) * s->span + (size_t)(dx + w->before[0]);
                s->outside[p] += inside ? 0 : (double)s->weights[at];
            }
        }
    }
}

/* Allocates the arrays but those of the window. Kernels read up to LANES - 1 numbers after a window's row. */
static koksma_status make_room(search *s)
{
    const size_t n = s->values->n, dim = (size_t)s->values->dim;
    const koksma__mask_window *w = &s->window;
    s->span = (w->columns + LANES - 1) / LANES * LANES;
    s->stride = width_of(s) + (size_t)(w->before[0] + w->after[0]);
    s->plane = s->stride * ((size_t)s->options->height + (size_t)(w->before[1] + w->after[1])) + LANES;
    s->weights = calloc(2 * w->rows * s->span, sizeof *s->weights);
    s->pixels = calloc(dim * s->plane, sizeof *s->pixels);
    s->pixel = calloc(n, sizeof *s->pixel);
    s->h = calloc(n, sizeof *s->h);
    s->outside = s->options->open ? calloc(n, sizeof *s->outside) : NULL;
    if (!s->weights || !s->pixels || !s->pixel || !s->h || (s->options->open && !s->outside)) {
        return koksma__fail_memory(n * (dim * sizeof *s->pixels + sizeof *s->h));
    }
    s->near_border = s->weights + w->rows * s->span;
    return KOKSMA_OK;
}

/* Fills the arrays but those of the arrangement. */
static koksma_status begin(search *s, const koksma_run *run)
{
    const koksma__mask_window *w = &s->window;
    const size_t centre = (size_t)w->before[1] * w->columns + (size_t)w->before[0];
    for (size_t i = 0; i < w->rows * w->columns; i++) {
        s->weights[i / w->columns * s->span + i % w->columns] =
            i == centre ? 0 : (float)(w->weights[i] / w->weights[centre]);
    }
    s->scale = w->weights[centre] / (double)s->values->n;
    if (s->outside) {
        weigh_outside(s);
    }
    KOKSMA__TRY(koksma__mask_distances(s->values, run, s->h));
    for (size_t i = 0; i < s->values->n; i++) {
        s->mean += s->h[i] / (double)s->values->n;
    }
    return KOKSMA_OK;
}

/* Lets the search stand at the arrangement of the values, and computes its error. */
static koksma_status stand(search *s, const koksma_run *run, double *error)
{
    for (uint32_t p = 0; p < s->values->n; p++) {
        place(s, p, s->values->value[p]);
    }
    KOKSMA__TRY(koksma__mask_energy(s->options, s->values, s->h, run, error));
    s->error_square = *error * *error;
    return KOKSMA_OK;
}

/* Lets the search stand where the call before left it. */
static koksma_status stand_again(search *s, const koksma_run *run)
{
    const uint32_t none = UINT32_MAX, *state = s->options->state;
    double error;
    for (size_t i = 0; i < s->values->n; i++) {
        s->pixel[i] = none;
    }
    for (uint32_t p = 0; p < s->values->n; p++) {
        KOKSMA__FAIL_IF(state[p] >= s->values->n || s->pixel[state[p]] != none, KOKSMA_ARGUMENT,
                        "mask: the state of the search has the number %u at pixel %u; it has each from 0 to %zu once",
                        (unsigned)state[p], (unsigned)p, s->values->n - 1);
        s->pixel[state[p]] = p;
    }
    memcpy(s->values->value, state, s->values->n * sizeof *state);
    return stand(s, run, &error);
}

/* Searches. kept: a copy of the first arrangement, which is the result if the state of the search is a worse one. */
static koksma_status find_from(search *s, const uint32_t *kept, const koksma_run *run, koksma_mask_result *result)
{
    const koksma_mask_options *o = s->options;
    const size_t bytes = s->values->n * sizeof *kept;
    double error;
    KOKSMA__TRY(stand(s, run, &error));
    result->first = o->done && o->first > 0 ? o->first : error;
    KOKSMA__TRY(o->done && o->state ? stand_again(s, run) : KOKSMA_OK);
    KOKSMA__TRY(anneal(s, run, result));
    KOKSMA__TRY(koksma__mask_energy(o, s->values, s->h, run, &result->error));
    if (o->state) {
        memcpy(o->state, s->values->value, bytes);
    }
    if (result->error > result->first) {
        memcpy(s->values->value, kept, bytes);
        result->error = error;
        if (!result->finished && !o->state) { /* what was searched is lost */
            result->done = o->done;
        }
    }
    return KOKSMA_OK;
}

static koksma_status find(search *s, const koksma_run *run, koksma_mask_result *result)
{
    KOKSMA__TRY(koksma__mask_window_init(s->options, LEAST, &s->window));
    KOKSMA__TRY(make_room(s));
    KOKSMA__TRY(begin(s, run));
    const size_t bytes = s->values->n * sizeof *s->values->value;
    uint32_t *kept = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(kept, bytes);
    memcpy(kept, s->values->value, bytes);
    const koksma_status status = find_from(s, kept, run, result);
    free(kept);
    return status;
}

static koksma_status check(const koksma_mask_options *o)
{
    const int pixels = o->width * o->height;
    KOKSMA__FAIL_IF(!(o->swaps >= 0 && o->swaps <= MOST_SWAPS), KOKSMA_ARGUMENT,
                    "mask: %g swaps a pixel; it takes 0 to %d", o->swaps, MOST_SWAPS);
    KOKSMA__FAIL_IF(o->levels && (o->space->dim > 1 || o->space->low < 0), KOKSMA_ARGUMENT,
                    "mask: levels are of the space scalar, not of %s", o->space->name);
    KOKSMA__FAIL_IF(o->levels < 0 || o->levels == 1 || o->levels > pixels, KOKSMA_ARGUMENT,
                    "mask: %d levels for %d pixels; it takes 2 to as many as pixels, or 0", o->levels, pixels);
    KOKSMA__FAIL_IF(o->levels && o->from && !o->done, KOKSMA_ARGUMENT,
                    "mask: levels have no effect on the values of a mask that is given");
    KOKSMA__FAIL_IF(o->done && !o->from, KOKSMA_ARGUMENT,
                    "mask: done is above 0 without `from`, the mask that the search made");
    KOKSMA__FAIL_IF((double)o->done > o->swaps * pixels, KOKSMA_ARGUMENT,
                    "mask: done = %llu proposals, and the search has %.0f in all", (unsigned long long)o->done,
                    o->swaps * pixels);
    KOKSMA__FAIL_IF(!(o->first >= 0 && o->first <= 1e100), KOKSMA_ARGUMENT, "mask: first = %g; errors are 0 or more",
                    o->first);
    KOKSMA__FAIL_IF(!(o->target >= 0 && o->target <= 1e100), KOKSMA_ARGUMENT,
                    "mask: a target of %g; errors are 0 or more", o->target);
    return KOKSMA_OK;
}

koksma_status koksma_mask_optimise(const koksma_mask_options *options, const koksma_run *run, float *values,
                                   koksma_mask_result *result)
{
    KOKSMA__REQUIRE(options, values);
    KOKSMA__REQUIRE_RUN(run);
    koksma_mask_options o = *options;
    KOKSMA__TRY(koksma__mask_check(o.width, o.height, &o.space, o.from));
    KOKSMA__TRY(check(&o));
    KOKSMA__TRY(koksma_mask_filter_check(&o.filter));
    koksma_mask_result unused;
    koksma__mask_values v;
    search s = {.options = &o, .values = &v, .kernels = koksma__kernels()};
    result = result ? result : &unused;
    *result = (koksma_mask_result){0};
    koksma_status status = koksma__mask_values_init(&o, run, &v);
    status = status ? status : find(&s, run, result);
    const size_t dim = (size_t)o.space->dim;
    for (size_t p = 0; p < v.n && !status; p++) {
        memcpy(values + p * dim, v.numbers + v.value[p] * dim, dim * sizeof *values);
    }
    koksma__mask_values_fini(&v);
    free(s.window.weights);
    free(s.weights);
    free(s.pixels);
    free(s.pixel);
    free(s.h);
    free(s.outside);
    return status;
}
