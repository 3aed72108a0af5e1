/* SPDX-License-Identifier: Apache-2.0 */
/* Values for pixels without samples, by a breadth-first walk from those that have some: it looks at every pixel once,
   however wide the gaps are. */
#include <stdlib.h>

#include "core/status.h"
#include "render/film.h"

/* Pixels by their distance from those that have something, in steps to any of the eight around; those are 0. */
typedef struct gaps {
    int *steps; /* -1: not reached yet */
    size_t *queue, n;
} gaps;

typedef struct around {
    int x0, x1, y0, y1; /* a pixel and its neighbours, the last ones too */
} around;

static around around_of(const koksma_image *image, size_t pixel)
{
    const int x = (int)(pixel % (size_t)image->width), y = (int)(pixel / (size_t)image->width);
    return (around){x ? x - 1 : x, x + 1 < image->width ? x + 1 : x, y ? y - 1 : y,
                    y + 1 < image->height ? y + 1 : y};
}

/* The mean of the neighbours that are one step nearer; and those that are reached from here queue up. */
static void fill_pixel(koksma_image *image, gaps *g, size_t pixel)
{
    const around a = around_of(image, pixel);
    const size_t channels = (size_t)image->channels;
    double sum[3] = {0, 0, 0};
    int n = 0;
    for (int y = a.y0; y <= a.y1; y++) {
        for (int x = a.x0; x <= a.x1; x++) {
            const size_t i = (size_t)y * (size_t)image->width + (size_t)x;
            if (g->steps[i] < 0) {
                g->steps[i] = g->steps[pixel] + 1;
                g->queue[g->n++] = i;
            } else if (g->steps[i] < g->steps[pixel]) {
                for (size_t k = 0; k < channels; k++) {
                    sum[k] += (double)image->pixels[i * channels + k];
                }
                n++;
            }
        }
    }
    for (size_t k = 0; n && k < channels; k++) {
        image->pixels[pixel * channels + k] = (float)(sum[k] / n);
    }
}

koksma_status koksma__film_fill_gaps(koksma_image *image, const float *has)
{
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    gaps g = {malloc(pixels * sizeof *g.steps), malloc(pixels * sizeof *g.queue), 0};
    const koksma_status status =
        g.steps && g.queue ? KOKSMA_OK : koksma__fail_memory(pixels * (sizeof *g.steps + sizeof *g.queue));
    for (size_t i = 0; !status && i < pixels; i++) {
        g.steps[i] = has[i] > 0 ? 0 : -1;
        if (has[i] > 0) {
            g.queue[g.n++] = i;
        }
    }
    for (size_t at = 0; !status && at < g.n; at++) {
        fill_pixel(image, &g, g.queue[at]);
    }
    free(g.steps);
    free(g.queue);
    return status;
}
