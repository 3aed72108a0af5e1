/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The value of a pixel is the weighted mean of its samples; the filter gives the weights (filters/filters.h),
 * which are 1 for the box.
 *
 * Samples that are drawn from a filter f with negative lobes have the density |f| / c, c = integral of |f|, and the
 * weights w = c sign(f), whose mean is 1. The mean of w y would turn a constant picture into noise, because the w of
 * a few samples have a mean other than 1, and the ratio sum w y / sum w can have a denominator of 0. But E[w y] =
 * E[y] + Cov(w, y), and so
 *
 *     m = mean of y  +  sum (w_i - mean w) (y_i - mean y) / (n - 1)  =  mean of v_i y_i,
 *     v_i = 1 + (w_i - mean w) n / (n - 1),      whose mean is 1
 *
 * gives a constant picture exactly, whatever signs are drawn, and divides by no random number. For independent
 * samples m has no bias; for stratified ones the mean of w varies less than the factor n - 1 assumes, and the bias is
 * at most Cov(w, y) / (n - 1). A single sample gives no estimate of the covariance, and is therefore drawn from the
 * positive part of f. A deterministic pattern of few samples may have no sample in a negative lobe, which then has no
 * effect. If every w is 1, so is every v.
 *
 * A splatted sample adds to several pixels. Each task has its own sums, which are added in the order of the tasks, so
 * that the image does not depend on the number of threads; a finished task waits only for the tasks before it. With
 * an image-wide pattern or splatting a pixel may get no sample: it takes its value from the pixels around it (below),
 * and its sample count is 0.
 *
 * The layer `variance` estimates the variance of a pixel's luminance m from its samples y_i of weight w_i as if they
 * were independent. With samples drawn from a filter of one sign, m is a mean of n samples, and the estimate is their
 * variance divided by n. With splatting, m = sum w y / W with W = sum w is a ratio, whose variance is, to first order
 * (Cochran 1977, chapter 6),
 *
 *     sum w^2 (y - m)^2 / W^2   times   S2 / (S2 - 2 S3 / W + S2^2 / W^2),   Sk = sum w^k
 *
 * where the factor corrects for m being computed from these samples; for any weights the correction is exact if all y
 * have the same variance. For equal weights it is n / (n - 1); for a single sample it is 0 / 0, and the layer is 0.
 * The same formula with w = v and W = n is the estimate for samples drawn from a filter with negative lobes.
 */
#include "render/one_image.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/vector3.h"

/* The sums of a pixel, beside W and the sum of w y, that the variance of splatted samples needs, in this order. */
enum { SUM_W2, SUM_W3, SUM_W2_Y, SUM_W2_Y2, N_MOMENTS };

/* The number of floats per pixel in the layers beside the image. */
enum { SAMPLES = 1, OTHER_LAYERS = 3 + 3 + 1 + 1 };

size_t koksma__film_numbers(int channels, bool all_layers)
{
    return (size_t)channels + 1 + (all_layers ? N_MOMENTS : 0);
}

uint64_t koksma__film_size(uint64_t pixels, int channels, bool all_layers, bool splat)
{
    const size_t floats = (size_t)channels + SAMPLES + (all_layers ? OTHER_LAYERS : 0) + splat; /* weights */
    return pixels *
           (floats * sizeof(float) + (splat ? koksma__film_numbers(channels, all_layers) : 0) * sizeof(double));
}

koksma_status koksma__film_init(const koksma__frame *frame, bool all_layers, size_t n_tasks, koksma_layers *layers,
                                koksma__film *out)
{
    const int width = frame->options->width, height = frame->options->height;
    *out = (koksma__film){.layers = layers, .all_layers = all_layers, .n_splats = n_tasks};
    pthread_mutex_init(&out->lock, NULL);
    koksma_status status = koksma_image_init(&layers->image, width, height, frame->channels);
    status = status ? status : koksma_image_init(&layers->samples, width, height, 1);
    if (all_layers) {
        status = status ? status : koksma_image_init(&layers->albedo, width, height, 3);
        status = status ? status : koksma_image_init(&layers->normal, width, height, 3);
        status = status ? status : koksma_image_init(&layers->depth, width, height, 1);
        status = status ? status : koksma_image_init(&layers->variance, width, height, 1);
    }
    if (!status && frame->options->splat) {
        out->reach = (int)ceil(frame->options->filter->radius - 0.5) + 1;
        out->numbers = koksma__film_numbers(frame->channels, all_layers);
        const size_t numbers = (size_t)width * (size_t)height * out->numbers;
        out->splats = calloc(n_tasks + 1, sizeof *out->splats);
        out->sums = calloc(numbers, sizeof *out->sums);
        status = out->splats && out->sums ? KOKSMA_OK : koksma__fail_memory(numbers * sizeof *out->sums);
    }
    return status;
}

void koksma__film_fini(koksma__film *film)
{
    for (size_t i = 0; film->splats && i < film->n_splats; i++) {
        free(film->splats[i].sums);
    }
    free(film->splats);
    free(film->sums);
    pthread_mutex_destroy(&film->lock);
    *film = (koksma__film){0};
}

void koksma_layers_fini(koksma_layers *layers)
{
    if (layers) {
        koksma_image_fini(&layers->image);
        koksma_image_fini(&layers->albedo);
        koksma_image_fini(&layers->normal);
        koksma_image_fini(&layers->depth);
        koksma_image_fini(&layers->samples);
        koksma_image_fini(&layers->variance);
    }
}

koksma_status koksma__film_open_task(const koksma__frame *frame, koksma__film *film, size_t task, int first_row,
                                     int rows)
{
    if (!film->splats) {
        return KOKSMA_OK;
    }
    koksma__splat *splat = &film->splats[task];
    const size_t n = (size_t)(rows + 2 * film->reach) * (size_t)frame->options->width * film->numbers;
    splat->first_row = first_row - film->reach; /* splat->done is not written, as other tasks read it */
    splat->rows = rows + 2 * film->reach;
    splat->sums = calloc(n, sizeof(double));
    return splat->sums ? KOKSMA_OK : koksma__fail_memory(n * sizeof(double));
}

void koksma__film_place(const koksma__frame *frame, const koksma__group *group, bool all, koksma__values *values)
{
    if (!frame->filter || frame->options->splat) {
        return;
    }
    const size_t width = (size_t)frame->options->width;
    for (size_t p = 0; p < group->count; p++) {
        const float x = (float)((group->first + p) % width), y = (float)((group->first + p) / width);
        const size_t n = group->start[p + 1] - group->start[p];
        const bool single = all && n == 1;
        for (size_t i = group->start[p]; i < group->start[p + 1]; i++) {
            float *place = values->film + 2 * i, wx, wy;
            const float u = place[0] - x, v = place[1] - y, last = 1 - 0x1p-24f;
            const float ux = u < 1 ? u : last, uy = v < 1 ? v : last;
            if (single) {
                place[0] = x + 0.5f + koksma__filter_sample_positive(frame->filter, ux);
                place[1] = y + 0.5f + koksma__filter_sample_positive(frame->filter, uy);
                values->weights[i] = 1;
                continue;
            }
            place[0] = x + 0.5f + koksma__filter_sample(frame->filter, ux, &wx);
            place[1] = y + 0.5f + koksma__filter_sample(frame->filter, uy, &wy);
            values->weights[i] = wx * wy;
        }
        if (all) {
            koksma__filter_balance(values->weights + group->start[p], n);
        }
    }
}

/* ---- Sums ------------------------------------------------------------------------------------------------- */

static double weight_of(const float *weights, size_t i)
{
    return weights ? (double)weights[i] : 1;
}

static double mean_of(const float *values, const float *weights, size_t first, size_t end, size_t stride, size_t k)
{
    double sum = 0;
    for (size_t i = first; i < end; i++) {
        sum += weight_of(weights, i) * (double)values[i * stride + k];
    }
    return sum / (double)(end - first);
}

static void add_moments(double *moments, double weight, double y)
{
    const double square = weight * weight;
    moments[SUM_W2] += square;
    moments[SUM_W3] += square * weight;
    moments[SUM_W2_Y] += square * y;
    moments[SUM_W2_Y2] += square * y * y;
}

static void splat_sample(const koksma__frame *frame, const koksma__film *film, const koksma__splat *splat,
                         const float place[2], const float *rgb)
{
    const int width = frame->options->width, channels = frame->channels;
    const int x0 = (int)floorf(place[0]) - film->reach, y0 = (int)floorf(place[1]) - film->reach;
    const double luminance = film->all_layers ? (double)koksma__sample_luminance(rgb, (size_t)channels) : 0;
    for (int y = y0; y <= y0 + 2 * film->reach; y++) {
        const float wy = koksma__filter_value(frame->filter, place[1] - ((float)y + 0.5f));
        if (wy == 0 || y < splat->first_row || y >= splat->first_row + splat->rows) {
            continue;
        }
        for (int x = x0 < 0 ? 0 : x0; x <= x0 + 2 * film->reach && x < width; x++) {
            const float weight = wy * koksma__filter_value(frame->filter, place[0] - ((float)x + 0.5f));
            double *sum = splat->sums + ((size_t)(y - splat->first_row) * (size_t)width + (size_t)x) * film->numbers;
            for (int k = 0; k < channels; k++) {
                sum[k] += (double)weight * (double)rgb[k];
            }
            sum[channels] += (double)weight;
            if (film->all_layers) {
                add_moments(sum + channels + 1, (double)weight, luminance);
            }
        }
    }
}

/* The variance of a pixel of value `mean`, from the sum of the weights and the moments. */
static double splat_variance(const double *moments, double weight, double mean)
{
    const double w2 = moments[SUM_W2], ratio = w2 / weight;
    const double off = moments[SUM_W2_Y2] - mean * (2 * moments[SUM_W2_Y] - mean * w2);
    const double left = w2 - 2 * moments[SUM_W3] / weight + ratio * ratio;
    /* if there is one sample, if all others have negligible weight, or if all values are equal, the result would only
       be rounding error: return 0 */
    return off > 1e-14 * moments[SUM_W2_Y2] && left > 1e-12 * w2 ? off / (weight * weight) * (w2 / left) : 0;
}

/* The variance of the mean luminance of samples first .. end - 1 that were drawn from a filter with negative
   lobes. */
static double signed_variance(const float *rgb, const float *weights, size_t channels, size_t first, size_t end)
{
    double moments[N_MOMENTS] = {0}, mean = 0;
    const double n = (double)(end - first),
                 origin = (double)koksma__sample_luminance(rgb + channels * first, channels);
    /* the first sample's value is subtracted, so that equal values have a variance of exactly 0 */
    for (size_t i = first; i < end; i++) {
        const double y = (double)koksma__sample_luminance(rgb + channels * i, channels) - origin;
        mean += (double)weights[i] * y / n;
        add_moments(moments, (double)weights[i], y);
    }
    return splat_variance(moments, n, mean);
}

void koksma__film_add_surface(const koksma_layers *layers, const koksma__values *v, size_t pixel, size_t first,
                              size_t end)
{
    double depth = 0;
    size_t hits = 0;
    for (size_t k = 0; k < 3; k++) {
        layers->albedo.pixels[3 * pixel + k] = (float)mean_of(v->albedo, NULL, first, end, 3, k);
        layers->normal.pixels[3 * pixel + k] = (float)mean_of(v->normal, NULL, first, end, 3, k);
    }
    for (size_t i = first; i < end; i++) {
        depth += (double)v->depth[i];
        hits += v->depth[i] > 0;
    }
    layers->depth.pixels[pixel] = hits ? (float)(depth / (double)hits) : 0;
}

/* The variance of the mean luminance of samples first .. end - 1. */
static double plain_variance(const float *rgb, size_t channels, size_t first, size_t end)
{
    const double n = (double)(end - first);
    double sum = 0, squares = 0;
    for (size_t i = first; i < end; i++) {
        sum += (double)koksma__sample_luminance(rgb + channels * i, channels);
    }
    for (size_t i = first; i < end; i++) {
        const double off = (double)koksma__sample_luminance(rgb + channels * i, channels) - sum / n;
        squares += off * off;
    }
    return squares / (n - 1) / n;
}

void koksma__film_add(const koksma__frame *frame, koksma__film *film, size_t task, const koksma__group *group,
                      const koksma__values *values)
{
    const size_t channels = (size_t)frame->channels;
    const float *weights = frame->filter && !film->reach ? values->weights : NULL;
    const bool has_lobes = weights && koksma__filter_is_signed(frame->filter);
    for (size_t p = 0; p < group->count; p++) {
        const size_t pixel = group->first + p, first = group->start[p], end = group->start[p + 1];
        film->layers->samples.pixels[pixel] = (float)(end - first);
        if (first == end) {
            continue;
        }
        for (size_t i = first; film->reach && i < end; i++) {
            splat_sample(frame, film, &film->splats[task], values->film + 2 * i, values->rgb + channels * i);
        }
        float *out = film->layers->image.pixels + pixel * channels;
        if (!film->reach && !weights && channels == 1) {
            out[0] = (float)frame->batch->mean(values->rgb + first, end - first);
        } else if (!film->reach) {
            for (size_t k = 0; k < channels; k++) {
                out[k] = (float)mean_of(values->rgb, weights, first, end, channels, k);
            }
        }
        if (film->all_layers) { /* the variance of splatted pixels is computed at the end */
            const double variance = has_lobes ? signed_variance(values->rgb, weights, channels, first, end)
                                              : plain_variance(values->rgb, channels, first, end);
            koksma__film_add_surface(film->layers, values, pixel, first, end);
            film->layers->variance.pixels[pixel] = end - first > 1 ? (float)variance : 0;
        }
    }
}

void koksma__film_fill(const koksma__film *film, const koksma__group *group, const float *rgb, size_t channels)
{
    for (size_t p = 0; p < group->count; p++) {
        const size_t pixel = group->first + p, n = group->start[p + 1] - group->start[p];
        film->layers->samples.pixels[pixel] = (float)n;
        for (size_t k = 0; n && k < channels; k++) {
            film->layers->image.pixels[pixel * channels + k] = rgb[k];
        }
    }
}

/* ---- The end ---------------------------------------------------------------------------------------------- */

/* Adds the sums of a finished task to the film, and releases them. */
static void merge_splat(const koksma__frame *frame, koksma__film *film, koksma__splat *splat)
{
    const size_t row = (size_t)frame->options->width * film->numbers;
    for (int r = 0; r < splat->rows; r++) {
        const int y = splat->first_row + r;
        for (size_t k = 0; y >= 0 && y < frame->options->height && k < row; k++) {
            film->sums[(size_t)y * row + k] += splat->sums[(size_t)r * row + k];
        }
    }
    free(splat->sums);
    splat->sums = NULL;
}

void koksma__film_close_task(const koksma__frame *frame, koksma__film *film, size_t task)
{
    if (!film->splats) {
        return;
    }
    pthread_mutex_lock(&film->lock);
    film->splats[task].done = true;
    for (; film->n_merged < film->n_splats && film->splats[film->n_merged].done; film->n_merged++) {
        merge_splat(frame, film, &film->splats[film->n_merged]);
    }
    pthread_mutex_unlock(&film->lock);
}

/* Divides each pixel's weighted sums by the sum of its weights. After an interruption some tasks are missing: a pixel
   that was not rendered then has only small contributions from the tails of its neighbours' filters, and is set to
   0. */
static void finish_splats(const koksma__frame *frame, koksma__film *film, bool whole, float *weights)
{
    const size_t pixels = (size_t)frame->options->width * (size_t)frame->options->height;
    const size_t channels = (size_t)frame->channels;
    for (size_t s = film->n_merged; s < film->n_splats; s++) {
        if (film->splats[s].done) {
            merge_splat(frame, film, &film->splats[s]);
        }
    }
    for (size_t i = 0; i < pixels; i++) {
        const double *sum = film->sums + i * film->numbers, weight = sum[channels];
        const bool shown = weight > 0 && (whole || film->layers->samples.pixels[i] > 0);
        weights[i] = (float)weight;
        for (size_t k = 0; k < channels; k++) {
            film->layers->image.pixels[i * channels + k] = shown ? (float)(sum[k] / weight) : 0;
        }
        if (film->all_layers) {
            const double mean = (double)koksma__sample_luminance(film->layers->image.pixels + i * channels, channels);
            film->layers->variance.pixels[i] = shown ? (float)splat_variance(sum + channels + 1, weight, mean) : 0;
        }
    }
}

koksma_status koksma__film_finish(const koksma__frame *frame, koksma__film *film, bool whole)
{
    koksma_image *image = &film->layers->image;
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    float *has = film->layers->samples.pixels, *weights = NULL;
    if (film->splats) {
        has = weights = malloc(pixels * sizeof *weights);
        KOKSMA__REQUIRE_MEMORY(weights, pixels * sizeof *weights);
        finish_splats(frame, film, whole, weights);
    }
    bool any = false;
    for (size_t i = 0; i < pixels && !any; i++) {
        any = !(has[i] > 0);
    }
    const bool fills = whole && any && (film->splats || frame->options->scope == KOKSMA_SCOPE_IMAGE);
    koksma_status status = fills ? koksma__film_fill_gaps(image, has) : KOKSMA_OK;
    free(weights);
    return status;
}

/* ---- Pixels without samples ---------------------------------------------------------------------------- */

/* Fills pixels without samples by a breadth-first search from those that have samples, which visits every pixel once,
   however wide the gaps are. */

/* Each pixel's distance, in steps to any of its eight neighbours, from the nearest pixel with samples, whose distance
   is 0. */
typedef struct gaps {
    int *steps; /* -1: not visited yet */
    size_t *queue, n;
} gaps;

typedef struct around {
    int x0, x1, y0, y1; /* inclusive bounds of a pixel and its neighbours */
} around;

static around around_of(const koksma_image *image, size_t pixel)
{
    const int x = (int)(pixel % (size_t)image->width), y = (int)(pixel / (size_t)image->width);
    return (around){x ? x - 1 : x, x + 1 < image->width ? x + 1 : x, y ? y - 1 : y,
                    y + 1 < image->height ? y + 1 : y};
}

/* Sets a pixel to the mean of its neighbours that are one step nearer, and queues its neighbours not visited yet. */
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
