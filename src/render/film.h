/* SPDX-License-Identifier: Apache-2.0 */
/* From samples to pixels: filters, layers, and the order of sums. */
#ifndef KOKSMA_RENDER_FILM_H
#define KOKSMA_RENDER_FILM_H

#include <pthread.h>

#include "render/frame.h"

/* Rows of a task with those around them that its samples reach, when samples are splatted. For each pixel it has the
   weighted sums of the channels, the sum of the weights, and with all layers the sums from which the variance
   follows; in doubles, since a pixel may get millions of samples. */
typedef struct koksma__splat {
    int first_row, rows;
    bool done;
    double *sums; /* NULL: none yet, or added to the film's */
} koksma__splat;

typedef struct koksma__film {
    koksma_layers *layers;
    bool all_layers; /* else only the image */
    int reach;       /* pixels beside its own that a splatted sample touches; 0: no splatting */
    size_t numbers;  /* sums of a pixel, when samples are splatted */
    size_t n_splats;
    koksma__splat *splats; /* one a task; NULL: no splatting */
    double *sums;          /* of the image, as those of tasks; of the first n_merged tasks */
    size_t n_merged;
    pthread_mutex_t lock; /* guards sums, n_merged and what is done */
} koksma__film;

/* Sums of a pixel, when samples are splatted. */
size_t koksma__film_numbers(int channels, bool all_layers);

/* Bytes that koksma__film_init allocates for the pixels, and koksma__film_finish for their weights. */
uint64_t koksma__film_size(uint64_t pixels, int channels, bool all_layers, bool splat);

/* Allocates the images. Errors: MEMORY. */
koksma_status koksma__film_init(const koksma__frame *frame, bool all_layers, size_t n_tasks, koksma_layers *layers,
                                koksma__film *out);
void koksma__film_fini(koksma__film *film);

/* Moves samples from the pixel to positions that the filter chooses, and weighs them: film positions of a group that
   was drawn on the unit square of each pixel. all: the group has all samples of its pixels, and weights become those
   in the pixels' means (film.c); else they are those of the draws (filters.h). */
void koksma__film_place(const koksma__frame *frame, const koksma__group *group, bool all, koksma__values *values);

/* The room for splats of a task. */
koksma_status koksma__film_open_task(const koksma__frame *frame, koksma__film *film, size_t task, int first_row,
                                     int rows);

/* Its samples are all there. */
void koksma__film_close_task(const koksma__frame *frame, koksma__film *film, size_t task);

/* The samples of a group into their pixels. */
void koksma__film_add(const koksma__frame *frame, koksma__film *film, size_t task, const koksma__group *group,
                      const koksma__values *values);

/* When no task is at work any more: splats in the order of tasks, and, if the picture is whole, values for pixels
   without samples from those around them; else they are 0. Errors: MEMORY. */
koksma_status koksma__film_finish(const koksma__frame *frame, koksma__film *film, bool whole);

/* has: the number of samples, or the sum of weights. Pixels that have none are filled from the nearest outwards, each
   by the mean of its neighbours that are one step nearer: once round the image, however wide the gaps are. */
koksma_status koksma__film_fill_gaps(koksma_image *image, const float *has);

#endif
