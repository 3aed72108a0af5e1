/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Arbitrary output variables (AOVs): further images, which are made from the same samples as the picture.
 *
 * The light of a sample is a sum over paths; a path whose light was reflected or refracted r times, mirrors and glass
 * included, belongs to `bounce:r`. `direct` is r = 0 and 1: light that the ray sees directly, and light that was
 * reflected once; `indirect` is the rest. At the vertex that a ray reaches after b reflections the tracer adds
 * emission (r = b), light of sampled lights (r = b + 1), and the light that surfaces reflect onto each other, given
 * by the scene's ambient light or an irradiance cache (r = b + 2, because that light was reflected once before). Each
 * of these parts is the difference of the vertex's light after and before the tracer adds it, so that the parts of a
 * sample add up to its light within the rounding of floats; where the sample is clamped, its parts are reduced by the
 * same factor. The filter weights of the samples apply to their parts as well.
 *
 * `id` is the number of the object (from 1 in the order of `koksma scene check`; 0: none) that most samples of the
 * pixel hit first; of equally frequent numbers the smallest. `half:even` and `half:odd` are the means of the samples
 * 0, 2, ... and 1, 3, ... of each pixel, two pictures whose difference shows the noise; a pixel that has no such
 * sample is 0.
 */
#include "render/render.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"

static const struct {
    const char *name;
    koksma__aov_kind kind;
    int first, last;
} fixed[] = {{"direct", KOKSMA__AOV_LIGHT, 0, 1},
             {"indirect", KOKSMA__AOV_LIGHT, 2, INT_MAX},
             {"id", KOKSMA__AOV_ID, 0, 0},
             {"half:even", KOKSMA__AOV_HALF, 0, 0},
             {"half:odd", KOKSMA__AOV_HALF, 1, 0}};

/* Finds an AOV by its name; returns false if there is none. */
static bool find(const char *name, koksma__aov *out)
{
    for (size_t i = 0; i < sizeof fixed / sizeof *fixed; i++) {
        if (!strcmp(name, fixed[i].name)) {
            *out = (koksma__aov){.kind = fixed[i].kind, .first = fixed[i].first, .last = fixed[i].last};
            return true;
        }
    }
    const size_t bounce = strlen("bounce:");
    if (strncmp(name, "bounce:", bounce) || strspn(name + bounce, "0123456789") == 0 ||
        (name[bounce] == '0' && name[bounce + 1])) {
        return false;
    }
    char *end;
    const long r = strtol(name + bounce, &end, 10);
    *out = (koksma__aov){.kind = KOKSMA__AOV_LIGHT, .first = (int)r, .last = (int)r};
    return !*end && r <= KOKSMA_MAX_DEPTH + 1;
}

static koksma_status add_name(const char *name, koksma_aovs *out)
{
    koksma__aov aov;
    KOKSMA__FAIL_IF(strlen(name) >= sizeof *out->names || !find(name, &aov), KOKSMA_UNKNOWN,
                    "no AOV '%.40s'; there are direct, indirect, bounce:0 to bounce:%d, id, half (half:even and "
                    "half:odd)",
                    name, KOKSMA_MAX_DEPTH + 1);
    for (int i = 0; i < out->n; i++) {
        KOKSMA__FAIL_IF(!strcmp(out->names[i], name), KOKSMA_ARGUMENT, "AOV '%s' is given twice", name);
    }
    strcpy(out->names[out->n++], name);
    return KOKSMA_OK;
}

koksma_status koksma_aovs_parse(const char *text, koksma_aovs *out)
{
    KOKSMA__REQUIRE(text, out);
    koksma_status status = KOKSMA_OK;
    *out = (koksma_aovs){0};
    for (const char *at = text, *end; !status && at; at = *end ? end + 1 : NULL) {
        char name[64];
        end = at + strcspn(at, ",");
        snprintf(name, sizeof name, "%.*s", (int)(end - at < 60 ? end - at : 60), at);
        if (!strcmp(name, "half")) {
            status = add_name("half:even", out);
            status = status ? status : add_name("half:odd", out);
        } else {
            status = add_name(name, out);
        }
    }
    return status;
}

void koksma_aovs_fini(koksma_aovs *aovs)
{
    for (int i = 0; aovs && i < aovs->n && i < KOKSMA_MAX_AOVS; i++) {
        koksma_image_fini(&aovs->images[i]);
    }
}

koksma_status koksma__aovs_init(const koksma__frame *frame, koksma_aovs *images, koksma__aovs *out)
{
    *out = (koksma__aovs){.n = (size_t)images->n};
    KOKSMA__FAIL_IF(frame->options->splat, KOKSMA_ARGUMENT,
                    "AOVs are not splatted: render them without splatting, with samples drawn from the filter");
    KOKSMA__FAIL_IF(images->n < 0 || images->n > KOKSMA_MAX_AOVS, KOKSMA_ARGUMENT, "%d AOVs: 0 to %d are possible",
                    images->n, KOKSMA_MAX_AOVS);
    for (int i = 0; i < images->n; i++) {
        koksma__aov *aov = &out->items[i];
        KOKSMA__FAIL_IF(!memchr(images->names[i], 0, sizeof images->names[i]) || !find(images->names[i], aov),
                        KOKSMA_ARGUMENT, "an AOV has a name that koksma_aovs_parse did not write");
        aov->image = &images->images[i];
        out->has_id |= aov->kind == KOKSMA__AOV_ID;
        out->n_parts += aov->kind == KOKSMA__AOV_LIGHT;
        KOKSMA__TRY(koksma_image_init(aov->image, frame->options->width, frame->options->height,
                                      aov->kind == KOKSMA__AOV_ID ? 1 : frame->channels));
    }
    return KOKSMA_OK;
}

koksma_status koksma__aov_values_init(const koksma__aovs *aovs, size_t capacity, koksma__values *values)
{
    values->parts = malloc((3 * aovs->n_parts * capacity + 1) * sizeof *values->parts);
    values->ids = malloc((capacity + 1) * sizeof *values->ids);
    return values->parts && values->ids ? KOKSMA_OK
                                        : koksma__fail_memory((3 * aovs->n_parts + 1) * capacity * sizeof(float));
}

/* ---- Samples ------------------------------------------------------------------------------------------------- */

void koksma__aov_add(const koksma__frame *frame, const koksma__vertices *v, const koksma__lanes before[3],
                     int reflections, koksma__values *values)
{
    const koksma__aovs *aovs = frame->aovs;
    size_t part = 0;
    for (size_t a = 0; a < aovs->n; a++) {
        if (aovs->items[a].kind != KOKSMA__AOV_LIGHT) {
            continue;
        }
        const bool takes = reflections >= aovs->items[a].first && reflections <= aovs->items[a].last;
        for (int i = 0; takes && i < v->n; i++) {
            float *to = values->parts + 3 * (aovs->n_parts * v->paths->sample[i] + part);
            for (int k = 0; k < 3; k++) {
                to[k] += v->light[k][i] - before[k][i];
            }
        }
        part++;
    }
}

void koksma__aov_note(const koksma__frame *frame, const koksma__vertices *v, koksma__values *values)
{
    for (int i = 0; i < v->n; i++) {
        const int32_t primitive = v->hits.primitive[i];
        values->ids[v->paths->sample[i]] =
            primitive < 0 ? 0 : (float)(1 + frame->geometry.object(&frame->geometry, primitive));
    }
}

void koksma__aov_clamp(const koksma__aovs *aovs, koksma__values *values, size_t i, int k, float factor)
{
    for (size_t part = 0; part < aovs->n_parts; part++) {
        values->parts[3 * (aovs->n_parts * i + part) + (size_t)k] *= factor;
    }
}

/* ---- Pixels -------------------------------------------------------------------------------------------------- */

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* Returns the number that occurs most often, and of equally frequent numbers the smallest; sorts the numbers. */
static float most_common(float *ids, size_t n)
{
    float best = 0;
    size_t most = 0;
    qsort(ids, n, sizeof *ids, compare);
    for (size_t i = 0, end; i < n; i = end) {
        end = i + 1;
        while (end < n && ids[end] == ids[i]) {
            end++;
        }
        if (end - i > most) {
            most = end - i;
            best = ids[i];
        }
    }
    return best;
}

/* The weighted mean of channel k of every step-th sample from `first` on. */
static float mean_of(const float *numbers, size_t stride, size_t k, const float *weights, size_t first, size_t end,
                     size_t step)
{
    double sum = 0;
    size_t n = 0;
    for (size_t i = first; i < end; i += step, n++) {
        sum += (weights ? (double)weights[i] : 1) * (double)numbers[i * stride + k];
    }
    return n ? (float)(sum / (double)n) : 0;
}

void koksma__aov_ids(const koksma__frame *frame, const koksma__values *values, size_t pixel, size_t first, size_t end)
{
    const koksma__aovs *aovs = frame->aovs;
    for (size_t a = 0; first < end && aovs && a < aovs->n; a++) {
        if (aovs->items[a].kind == KOKSMA__AOV_ID) {
            aovs->items[a].image->pixels[pixel] = most_common(values->ids + first, end - first);
        }
    }
}

void koksma__aov_film(const koksma__frame *frame, const koksma__group *group, const koksma__values *values,
                      const float *weights)
{
    const koksma__aovs *aovs = frame->aovs;
    const size_t channels = (size_t)frame->channels;
    for (size_t p = 0; p < group->count; p++) {
        const size_t pixel = group->first + p, first = group->start[p], end = group->start[p + 1];
        size_t part = 0;
        for (size_t a = 0; first < end && a < aovs->n; a++) {
            const koksma__aov *aov = &aovs->items[a];
            for (size_t k = 0; aov->kind != KOKSMA__AOV_ID && k < channels; k++) {
                aov->image->pixels[pixel * channels + k] =
                    aov->kind == KOKSMA__AOV_HALF
                        ? mean_of(values->rgb, channels, k, weights, first + (size_t)aov->first, end, 2)
                        : mean_of(values->parts, 3 * aovs->n_parts, 3 * part + k, weights, first, end, 1);
            }
            part += aov->kind == KOKSMA__AOV_LIGHT;
        }
        koksma__aov_ids(frame, values, pixel, first, end);
    }
}
