/* SPDX-License-Identifier: Apache-2.0 */
/* From samples to pixels: filters, layers, and the order of sums. */
#ifndef KOKSMA_RENDER_FILM_H
#define KOKSMA_RENDER_FILM_H

#include <pthread.h>

#include "render/frame.h"

/* For splatting: the sums of the rows of a task and of the rows around them that the task's samples reach. Each pixel
   has the weighted sums of the channels, the sum of the weights, and, if all layers are wanted, the sums for the
   variance; all in doubles, because a pixel may get millions of samples. */
typedef struct koksma__splat {
    int first_row, rows;
    bool done;
    double *sums; /* NULL: not allocated yet, or already added to the film's sums */
} koksma__splat;

typedef struct koksma__film {
    koksma_layers *layers;
    bool all_layers; /* whether all layers are made; otherwise only the image */
    int reach;       /* distance in pixels that a splatted sample reaches beyond its own pixel; 0: no splatting */
    size_t numbers;  /* number of sums for each pixel, with splatting */
    size_t n_splats;
    koksma__splat *splats; /* one for each task; NULL: no splatting */
    double *sums;          /* the sums of the image, over the first n_merged tasks */
    size_t n_merged;
    pthread_mutex_t lock; /* guards sums, n_merged and `done` of the splats */
} koksma__film;

/* The number of sums for each pixel, with splatting. */
size_t koksma__film_numbers(int channels, bool all_layers);

/* The number of bytes that koksma__film_init allocates for the pixels, and koksma__film_finish for their weights. */
uint64_t koksma__film_size(uint64_t pixels, int channels, bool all_layers, bool splat);

/* Allocates the images. Errors: MEMORY. */
koksma_status koksma__film_init(const koksma__frame *frame, bool all_layers, size_t n_tasks, koksma_layers *layers,
                                koksma__film *out);
void koksma__film_fini(koksma__film *film);

/* Moves the samples of a group, drawn on the unit square of each pixel, to film positions that the filter selects,
   and sets their weights. Without `all`, the weight of a sample is what the filter gives for its position. With `all`,
   the group must have all samples of its pixels, and the weights of each pixel are balanced so that a constant image
   stays constant (film.c). */
void koksma__film_place(const koksma__frame *frame, const koksma__group *group, bool all, koksma__values *values);

/* Prepares the splats of a task. */
koksma_status koksma__film_open_task(const koksma__frame *frame, koksma__film *film, size_t task, int first_row,
                                     int rows);

/* Marks a task's samples as complete. */
void koksma__film_close_task(const koksma__frame *frame, koksma__film *film, size_t task);

/* Adds the samples of a group to their pixels. */
void koksma__film_add(const koksma__frame *frame, koksma__film *film, size_t task, const koksma__group *group,
                      const koksma__values *values);

/* Does what koksma__film_add does, if all samples of the group have the colour rgb and the film has neither splatting
   nor layers beside the image. */
void koksma__film_fill(const koksma__film *film, const koksma__group *group, const float *rgb, size_t channels);

/* Called after all tasks have ended: adds the splats in the order of tasks. Pixels without samples are filled from
   their neighbours if the image is whole, and are 0 otherwise. Errors: MEMORY. */
koksma_status koksma__film_finish(const koksma__frame *frame, koksma__film *film, bool whole);

/* Fills pixels without samples in the order of their distance from the nearest pixel with samples; each gets the mean
   of its neighbours that are one step nearer. has: each pixel's number of samples, or sum of weights. Every pixel is
   visited once, however wide the gaps are. */
koksma_status koksma__film_fill_gaps(koksma_image *image, const float *has);

#endif
