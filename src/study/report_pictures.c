/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures: of every scene of the image blocks the first trial of each pattern, beside the reference, with maps of
 * the error. They are shown as they are for readers and printers, and as floats for the comparer (report.js). The
 * picture is the one whose error stands in the store: it is made again from its key.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/status.h"
#include "study/report.h"
#include "study/report_script.h"
#include "study/tasks.h"

/* What the floats of one file may take before their base64, and how much brighter an error is shown. */
enum { MOST_BYTES = 24 << 20, GAIN = 8, MAX_SHOWN = 24 };

typedef struct budget {
    size_t used;
    bool shown;
} budget;

static koksma_status add_thumbnail(koksma__html *h, const koksma_image *image, const koksma_image *reference,
                                   const char *name, const char *scene)
{
    char alt[512];
    koksma_image map = {0};
    const int scale = image->width <= 96 ? 2 : 1;
    koksma__html_add(h, "<figure>");
    snprintf(alt, sizeof alt, "%.150s, %.250s", scene, name);
    koksma_status status = koksma__html_image(h, image, scale, alt);
    if (!status && reference) {
        status = koksma_image_difference(image, reference, &map);
        for (size_t i = 0; !status && i < (size_t)map.width * (size_t)map.height; i++) {
            map.pixels[i] *= (float)GAIN;
        }
        snprintf(alt, sizeof alt, "absolute error of %.150s, %.250s, %d times as bright", scene, name, GAIN);
        status = status ? status : koksma__html_image(h, &map, scale, alt);
        koksma_image_fini(&map);
    }
    koksma__html_add(h, "<figcaption>");
    koksma__html_text(h, name);
    koksma__html_add(h, "</figcaption></figure>\n");
    return status;
}

static void add_floats(koksma__html *h, const koksma_image *image, const char *name, bool first)
{
    const size_t count = (size_t)image->width * (size_t)image->height * (size_t)image->channels;
    koksma__html_add(h, "%s<template data-name=\"", first ? "" : "\n");
    koksma__html_text(h, name);
    koksma__html_add(h, "\" data-channels=\"%d\">", image->channels);
    koksma__html_base64(h, (const unsigned char *)image->pixels, count * sizeof *image->pixels);
    koksma__html_add(h, "</template>");
}

/* The picture of trial 0 of a task. */
static koksma_status render(const koksma__task *t, const koksma_run *run, koksma_image *out)
{
    const koksma__picture picture = {.pattern = t->pattern,
                                     .variant = t->variant,
                                     .spp = t->n,
                                     .width = t->width,
                                     .height = t->height,
                                     .seed = koksma__task_seed(t, 0)};
    return koksma__study_render(t->scene, &picture, run, out);
}

static koksma_status add_scene(koksma_study *study, koksma__html *h, const koksma__task *first, budget *b,
                               const koksma_run *run)
{
    const koksma__image_block *block = first->image;
    const size_t shown = block->patterns.n < MAX_SHOWN ? block->patterns.n : MAX_SHOWN;
    const size_t pixels = (size_t)first->width * (size_t)first->height;
    koksma__reference_image *reference = &study->references[first->references[first->n_series - 1]];
    if (!koksma__reference_exists(study, reference) || b->used + 4 * pixels * (shown + 1) > MOST_BYTES) {
        return KOKSMA_OK;
    }
    koksma_status status = koksma__reference_read(study, reference);
    koksma__html floats = {0};
    if (!b->shown) {
        koksma__html_add(
            h,
            "<h2 id=\"pictures\">Pictures</h2>\n<p>The first trial of every pattern, its absolute error in "
            "luminance %d times as bright, and the reference.</p>\n",
            GAIN);
        b->shown = true;
    }
    koksma__html_add(h, "<h3>");
    koksma__html_text(h, first->scene->name);
    koksma__html_add(h, ", %lld samples a pixel</h3>\n<div class=\"figures\">\n", first->n);
    if (!status) {
        status = add_thumbnail(h, &reference->image, NULL, "reference", first->scene->name);
        add_floats(&floats, &reference->image, "reference", true);
    }
    for (size_t p = 0; !status && p < shown; p++) {
        koksma__task task = *first;
        koksma_image image;
        task.pattern = block->patterns.at[p];
        status = render(&task, run, &image);
        if (!status) {
            status = add_thumbnail(h, &image, &reference->image, task.pattern, task.scene->name);
            add_floats(&floats, &image, task.pattern, false);
            b->used += 4 * pixels * (size_t)image.channels;
            koksma_image_fini(&image);
        }
    }
    koksma__html_add(h, "</div>\n<div class=\"comparer\" data-width=\"%d\" data-height=\"%d\" data-name=\"",
                     first->width, first->height);
    koksma__html_text(h, first->scene->name);
    koksma__html_add(h, "\">%s</div>\n", floats.text ? floats.text : "");
    h->failed |= floats.failed;
    free(floats.text);
    return status;
}

koksma_status koksma__report_pictures(koksma_study *study, koksma__html *h, const koksma_run *run)
{
    koksma__tasks tasks;
    budget b = {0};
    koksma_status status = koksma__tasks_open(study, true, &tasks);
    for (size_t i = 0; !status && i < tasks.n; i++) {
        const koksma__task *t = &tasks.at[i];
        const koksma__image_block *block = t->image;
        if (t->pattern == block->patterns.at[0] && t->variant == block->variants.at[0] &&
            t->n == block->spp.at[block->spp.n / 2]) {
            status = add_scene(study, h, t, &b, run);
        }
    }
    if (!status && b.shown) {
        koksma__html_add(h, "<script>\n%s</script>\n", koksma__report_js);
    }
    koksma__tasks_close(&tasks);
    return status;
}
