/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The method `blocks` decides for whole blocks of the image whether their pixels get more samples (Dammertz, Hanika,
 * Keller & Lensch 2010). The samples of a pixel come in point sets; let I be the mean of all its sets, and A the mean
 * of every second set. The error of a block of N pixels in an image of M pixels is
 *
 *     e = sqrt(N / M) / N  sum over its pixels of  |I - A| / sqrt(I)     (|I - A| and I are sums over the channels)
 *
 * A block stops when e is below the threshold. When its error is below 256 times the threshold, a block is cut across
 * its longer side, at the position where the errors of the two parts are most nearly equal, unless a part would have
 * fewer than `side` pixels. Without a threshold every block is cut after each round in which it was selected, and the
 * budget goes to the blocks with the largest error per pixel.
 */
#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/samples/adaptive/adaptive.h"

enum { SIDE = KOKSMA__SETS_THRESHOLD + 1 };

static const koksma_param params[] = {
    KOKSMA__SETS_PARAMS(2, 2),
    {"threshold", "a block stops below this error; 0: no threshold, only a budget", 0, 0, 1e6, NULL, false},
    {"side", "smallest side of a block in pixels", 8, 1, 65536, NULL, true},
    {0},
};

typedef struct block {
    int x, y, width, height;
    uint32_t sets; /* number of sets that its first pixel had when the block was cut */
    bool stopped;
} block;

typedef struct blocks {
    size_t n;
    block list[];
} blocks;

static koksma_status open(koksma__adaptive *run)
{
    KOKSMA__TRY(koksma__sets_open(run));
    const koksma_render_options *options = run->frame->options;
    blocks *b = malloc(sizeof *b + run->pixels * sizeof *b->list);
    run->extra = b;
    KOKSMA__REQUIRE_MEMORY(b, sizeof *b + run->pixels * sizeof *b->list);
    b->n = 1;
    b->list[0] = (block){.width = options->width, .height = options->height};
    return KOKSMA_OK;
}

static size_t pixel_at(const koksma__adaptive *run, int x, int y)
{
    return (size_t)y * (size_t)run->frame->options->width + (size_t)x;
}

static double pixel_error(const koksma__adaptive *run, int x, int y)
{
    const koksma__pixel_sets *p = koksma__sets_of(run, pixel_at(run, x, y));
    const double n = (double)koksma__set_size(run), all = n * p->sets, half = n * ((p->sets + 1) / 2);
    double sum = 0, off = 0;
    for (int k = 0; k < run->frame->channels; k++) {
        sum += p->all[k] / all;
        off += p->lo[k] < p->hi[k] ? fabs(p->all[k] / all - p->half[k] / half) : 0;
    }
    return off > 0 ? off / sqrt(fmax(sum, 1e-6)) : 0;
}

/* Returns the sum of the errors of the pixels in a rectangle. */
static double sum_errors(const koksma__adaptive *run, int x, int y, int width, int height)
{
    double sum = 0;
    for (int j = y; j < y + height; j++) {
        for (int i = x; i < x + width; i++) {
            sum += pixel_error(run, i, j);
        }
    }
    return sum;
}

/* Cuts block b in two, if it can be cut; the second part becomes the last block. */
static void cut(koksma__adaptive *run, size_t b, double total)
{
    blocks *all = run->extra;
    block *first = &all->list[b], *second = &all->list[all->n];
    const int side = (int)run->options->params[SIDE];
    const bool wide = first->width >= first->height;
    const int length = wide ? first->width : first->height;
    double before = 0;
    int at = 0;
    if (length < 2 * side) {
        return;
    }
    while (at < length - side && (at < side || 2 * before < total)) {
        before += wide ? sum_errors(run, first->x + at, first->y, 1, first->height)
                       : sum_errors(run, first->x, first->y + at, first->width, 1);
        at++;
    }
    *second = *first;
    if (wide) {
        first->width = at;
        second->x += at;
        second->width -= at;
    } else {
        first->height = at;
        second->y += at;
        second->height -= at;
    }
    first->sets = koksma__sets_of(run, pixel_at(run, first->x, first->y))->sets;
    second->sets = koksma__sets_of(run, pixel_at(run, second->x, second->y))->sets;
    all->n++;
}

static void ask_for(koksma__adaptive *run, const block *b, double score)
{
    for (int y = b->y; y < b->y + b->height; y++) {
        for (int x = b->x; x < b->x + b->width; x++) {
            const size_t pixel = pixel_at(run, x, y);
            run->demands[pixel] = (koksma__sample_demand){0};
            if (!b->stopped && score > 0) {
                koksma__sets_demand(run, pixel, 1, score, &run->demands[pixel]);
            }
        }
    }
}

static void plan(koksma__adaptive *run)
{
    blocks *all = run->extra;
    const double threshold = run->options->params[KOKSMA__SETS_THRESHOLD];
    const size_t n = all->n;
    for (size_t i = 0; i < n; i++) {
        block *b = &all->list[i];
        const double pixels = (double)b->width * b->height;
        const double total = b->stopped ? 0 : sum_errors(run, b->x, b->y, b->width, b->height);
        const double error = sqrt(pixels / (double)run->pixels) * total / pixels;
        const bool selected = koksma__sets_of(run, pixel_at(run, b->x, b->y))->sets > b->sets;
        b->stopped |= !(error > threshold);
        if (!b->stopped && selected && (threshold == 0 || error < 256 * threshold)) {
            cut(run, i, total);
        }
    }
    for (size_t i = 0; i < all->n; i++) {
        const block *b = &all->list[i];
        const double pixels = (double)b->width * b->height;
        ask_for(run, b, b->stopped ? 0 : sum_errors(run, b->x, b->y, b->width, b->height) / pixels);
    }
}

static const koksma__adaptive_method method = {.family = &koksma__sets_family, .open = open, .plan = plan};

const koksma_adaptive koksma__adaptive_blocks = {
    .name = "blocks",
    .title = "blocks of the image stop when two halves of their samples agree",
    .cite = "dammertz2010",
    .params = params,
    .functions = &method,
};
