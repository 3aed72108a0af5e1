/* SPDX-License-Identifier: Apache-2.0 */
/*
 * A pixel is the mean of its samples; each sample weighs what the filter says (filters.h), and 1 with the box.
 * Splatted samples reach the pixels around: their sums are kept by task and added in the order of tasks, so that
 * threads change nothing. A pixel of an image-wide pattern, or of splatted samples, that got none takes the mean of
 * the pixels around that have some; its count says 0.
 */
#include "render/film.h"

#include <math.h>
#include <stdlib.h>

#include "core/status.h"
#include "render/vector3.h"

koksma_status koksma__film_init(const koksma__frame *frame, bool all_layers, size_t n_tasks, koksma_layers *layers,
                                koksma__film *out)
{
    const int width = frame->options->width, height = frame->options->height;
    *out = (koksma__film){.layers = layers, .all_layers = all_layers, .n_splats = n_tasks};
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
        out->splats = calloc(n_tasks + 1, sizeof *out->splats);
        status = out->splats ? KOKSMA_OK : koksma__fail_memory(n_tasks * sizeof *out->splats);
    }
    return status;
}

void koksma__film_fini(koksma__film *film)
{
    for (size_t i = 0; film->splats && i < film->n_splats; i++) {
        free(film->splats[i].sums);
    }
    free(film->splats);
    *film = (koksma__film){0};
}

koksma_status koksma__film_open_task(const koksma__frame *frame, koksma__film *film, size_t task, int first_row,
                                     int rows)
{
    if (!film->splats) {
        return KOKSMA_OK;
    }
    koksma__splat *splat = &film->splats[task];
    const size_t n = (size_t)(rows + 2 * film->reach) * (size_t)frame->options->width * (size_t)(frame->channels + 1);
    *splat = (koksma__splat){first_row - film->reach, rows + 2 * film->reach, calloc(n, sizeof(double))};
    return splat->sums ? KOKSMA_OK : koksma__fail_memory(n * sizeof(double));
}

void koksma__film_place(const koksma__frame *frame, const koksma__group *group, koksma__values *values)
{
    if (!frame->filter || frame->options->splat) {
        return;
    }
    const size_t width = (size_t)frame->options->width;
    for (size_t p = 0; p < group->count; p++) {
        const float x = (float)((group->first + p) % width), y = (float)((group->first + p) / width);
        for (size_t i = group->start[p]; i < group->start[p + 1]; i++) {
            float *place = values->film + 2 * i, wx, wy;
            const float ux = place[0] - x, uy = place[1] - y;
            place[0] = x + 0.5f + koksma__filter_sample(frame->filter, ux < 1 ? ux : 1 - 0x1p-24f, &wx);
            place[1] = y + 0.5f + koksma__filter_sample(frame->filter, uy < 1 ? uy : 1 - 0x1p-24f, &wy);
            values->weights[i] = wx * wy;
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

static void splat_sample(const koksma__frame *frame, const koksma__film *film, const koksma__splat *splat,
                         const float place[2], const float *rgb)
{
    const int width = frame->options->width, channels = frame->channels;
    const int x0 = (int)floorf(place[0]) - film->reach, y0 = (int)floorf(place[1]) - film->reach;
    for (int y = y0; y <= y0 + 2 * film->reach; y++) {
        const float wy = koksma__filter_value(frame->filter, place[1] - ((float)y + 0.5f));
        if (wy == 0 || y < splat->first_row || y >= splat->first_row + splat->rows) {
            continue;
        }
        for (int x = x0 < 0 ? 0 : x0; x <= x0 + 2 * film->reach && x < width; x++) {
            const float weight = wy * koksma__filter_value(frame->filter, place[0] - ((float)x + 0.5f));
            double *sum =
                splat->sums + ((size_t)(y - splat->first_row) * (size_t)width + (size_t)x) * (size_t)(channels + 1);
            for (int k = 0; k < channels; k++) {
                sum[k] += (double)weight * (double)rgb[k];
            }
            sum[channels] += (double)weight;
        }
    }
}

static double luminance_of(const float *rgb, size_t channels)
{
    return channels == 1 ? (double)rgb[0] : (double)koksma__luminance3(rgb);
}

/* weights: NULL, or of the filter; the variance is that of the pixel's value, which is the mean of weight x sample.
 */
static void add_layers(koksma_layers *layers, const koksma__values *v, const float *weights, size_t channels,
                       size_t pixel, size_t first, size_t end)
{
    double sum = 0, squares = 0, depth = 0;
    size_t hits = 0;
    for (size_t k = 0; k < 3; k++) {
        layers->albedo.pixels[3 * pixel + k] = (float)mean_of(v->albedo, NULL, first, end, 3, k);
        layers->normal.pixels[3 * pixel + k] = (float)mean_of(v->normal, NULL, first, end, 3, k);
    }
    for (size_t i = first; i < end; i++) {
        sum += weight_of(weights, i) * luminance_of(v->rgb + channels * i, channels);
        depth += (double)v->depth[i];
        hits += v->depth[i] > 0;
    }
    const double n = (double)(end - first), mean = sum / n;
    for (size_t i = first; i < end; i++) {
        const double off = weight_of(weights, i) * luminance_of(v->rgb + channels * i, channels) - mean;
        squares += off * off;
    }
    layers->depth.pixels[pixel] = hits ? (float)(depth / (double)hits) : 0;
    layers->variance.pixels[pixel] = end - first > 1 ? (float)(squares / (n - 1) / n) : 0;
}

void koksma__film_add(const koksma__frame *frame, koksma__film *film, size_t task, const koksma__group *group,
                      const koksma__values *values)
{
    const size_t channels = (size_t)frame->channels;
    const float *weights = frame->filter && !film->reach ? values->weights : NULL;
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
        if (film->all_layers) {
            add_layers(film->layers, values, weights, channels, pixel, first, end);
        }
    }
}

/* ---- The end ---------------------------------------------------------------------------------------------- */

static void merge_splats(const koksma__frame *frame, koksma__film *film, double *sums)
{
    const size_t width = (size_t)frame->options->width, numbers = (size_t)frame->channels + 1;
    for (size_t s = 0; s < film->n_splats; s++) {
        const koksma__splat *splat = &film->splats[s];
        for (int r = 0; splat->sums && r < splat->rows; r++) {
            const int y = splat->first_row + r;
            for (size_t k = 0; y >= 0 && y < frame->options->height && k < width * numbers; k++) {
                sums[(size_t)y * width * numbers + k] += splat->sums[(size_t)r * width * numbers + k];
            }
        }
    }
}

/* The pixels' values, and the weights that they come from. */
static koksma_status finish_splats(const koksma__frame *frame, koksma__film *film, float *weights)
{
    const size_t pixels = (size_t)frame->options->width * (size_t)frame->options->height;
    const size_t channels = (size_t)frame->channels;
    double *sums = calloc(pixels * (channels + 1), sizeof *sums);
    if (!sums) {
        return koksma__fail_memory(pixels * (channels + 1) * sizeof *sums);
    }
    merge_splats(frame, film, sums);
    for (size_t i = 0; i < pixels; i++) {
        const double *sum = sums + i * (channels + 1), weight = sum[channels];
        weights[i] = (float)weight;
        for (size_t k = 0; k < channels; k++) {
            film->layers->image.pixels[i * channels + k] = weight > 0 ? (float)(sum[k] / weight) : 0;
        }
    }
    free(sums);
    return KOKSMA_OK;
}

/* has: the number of samples, or the sum of weights; empty pixels take the mean of the nearest square ring with any.
 */
static void fill_pixel(koksma_image *image, const float *has, int x, int y)
{
    const int most = image->width > image->height ? image->width : image->height;
    for (int ring = 1; ring < most; ring++) {
        double sum[3] = {0, 0, 0};
        int n = 0;
        for (int yy = y - ring; yy <= y + ring; yy++) {
            for (int xx = x - ring; xx <= x + ring; xx++) {
                const bool on_ring = abs(xx - x) == ring || abs(yy - y) == ring;
                if (!on_ring || xx < 0 || yy < 0 || xx >= image->width || yy >= image->height) {
                    continue;
                }
                const size_t i = (size_t)yy * (size_t)image->width + (size_t)xx;
                for (int k = 0; has[i] > 0 && k < image->channels; k++) {
                    sum[k] += (double)image->pixels[i * (size_t)image->channels + (size_t)k];
                }
                n += has[i] > 0;
            }
        }
        for (int k = 0; n && k < image->channels; k++) {
            image->pixels[((size_t)y * (size_t)image->width + (size_t)x) * (size_t)image->channels + (size_t)k] =
                (float)(sum[k] / n);
        }
        if (n) {
            return;
        }
    }
}

koksma_status koksma__film_finish(const koksma__frame *frame, koksma__film *film)
{
    koksma_image *image = &film->layers->image;
    const size_t pixels = (size_t)image->width * (size_t)image->height;
    float *weights = film->layers->samples.pixels, *summed = NULL;
    if (film->splats) {
        summed = calloc(pixels, sizeof *summed);
        if (!summed) {
            return koksma__fail_memory(pixels * sizeof *summed);
        }
        weights = summed;
        const koksma_status status = finish_splats(frame, film, weights);
        if (status) {
            free(summed);
            return status;
        }
    }
    const bool gaps = film->splats || frame->options->scope == KOKSMA_SCOPE_IMAGE;
    for (size_t i = 0; gaps && i < pixels; i++) {
        if (!(weights[i] > 0)) {
            fill_pixel(image, weights, (int)(i % (size_t)image->width), (int)(i / (size_t)image->width));
        }
    }
    free(summed);
    return KOKSMA_OK;
}
