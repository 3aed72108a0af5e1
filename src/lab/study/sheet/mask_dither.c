/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Dithering with masks: a ramp and a rendered scene, both linear light in [0,1], become 1 where they exceed the threshold
 * of their pixel, else 0, and are filtered. The error is the root mean square difference from the picture itself, filtered
 * alike. White noise, Bayer's matrix (1973) and a void-and-cluster mask (Ulichney 1993) are beside the masks of the sheet.
 */
#include "study/sheet/mask_dither.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/render.h>

#include "core/parallel.h"
#include "core/status.h"

enum { WIDTH = 240, RAMP = 48, SCENE = 160, SPP = 64, EXPOSURE = 2, TILE = 64, BAYER = 16, OTHERS = 3, PICTURES = 2 };

static const char SCENE_NAME[] = "product";

/* Thresholds in [0,1) of a tile. */
typedef struct thresholds {
    const char *name;
    const float *values;
    int width, height;
} thresholds;

/* ---- Thresholds ------------------------------------------------------------------------------------------ */

/* Bayer's matrix: that of 2 n is four times that of n, plus 0, 2, 3, 1 in the four quarters. */
static void make_bayer(float *values)
{
    static const int quarters[2][2] = {{0, 2}, {3, 1}};
    for (int y = 0; y < BAYER; y++) {
        for (int x = 0; x < BAYER; x++) {
            int rank = 0;
            for (int bit = 1; bit < BAYER; bit *= 2) {
                rank = 4 * rank + quarters[(y & bit) > 0][(x & bit) > 0];
            }
            values[y * BAYER + x] = ((float)rank + 0.5f) / (BAYER * BAYER);
        }
    }
}

/* Makes the thresholds of others: values has room for two tiles and a matrix. */
static koksma_status make_others(const koksma_run *run, float *values, thresholds *out)
{
    koksma_mask_options white = {.width = TILE, .height = TILE, .filter = {2, 1, {1, 1}}};
    uint32_t *ranks = malloc((size_t)TILE * TILE * sizeof *ranks);
    KOKSMA__REQUIRE_MEMORY(ranks, (size_t)TILE * TILE * sizeof *ranks);
    koksma_status status = koksma_mask_optimise(&white, run, values, NULL); /* no swaps: a random order */
    status = status ? status : koksma_mask_void_and_cluster(TILE, 0, run, ranks);
    for (size_t i = 0; i < (size_t)TILE * TILE && !status; i++) {
        values[TILE * TILE + i] = ((float)ranks[i] + 0.5f) / (TILE * TILE);
    }
    free(ranks);
    make_bayer(values + 2 * TILE * TILE);
    out[0] = (thresholds){"white noise", values, TILE, TILE};
    out[1] = (thresholds){"Bayer", values + 2 * TILE * TILE, BAYER, BAYER};
    out[2] = (thresholds){"void-and-cluster", values + TILE * TILE, TILE, TILE};
    return status;
}

/* ---- Pictures -------------------------------------------------------------------------------------------- */

static koksma_status make_ramp(koksma_image *out)
{
    KOKSMA__TRY(koksma_image_init(out, WIDTH, RAMP, 1));
    for (int i = 0; i < WIDTH * RAMP; i++) {
        out->pixels[i] = ((float)(i % WIDTH) + 0.5f) / WIDTH;
    }
    return KOKSMA_OK;
}

/* Renders the scene and takes its luminance, EXPOSURE times as bright. */
static koksma_status make_scene(const koksma_run *run, koksma_image *out)
{
    koksma_scene *scene;
    koksma_render_options options;
    koksma_image image = {0};
    KOKSMA__TRY(koksma_scene_open(SCENE_NAME, &scene));
    koksma_render_options_init(&options, scene);
    options.width = WIDTH;
    options.height = SCENE;
    options.spp = SPP;
    koksma_status status = koksma_pattern_spec("sobol:scramble=owen", &options.pattern);
    status = status ? status : koksma_render(scene, &options, run, &image);
    status = status ? status : koksma_image_init(out, WIDTH, SCENE, 1);
    for (size_t i = 0; i < (size_t)WIDTH * SCENE && !status; i++) {
        const float *p = image.pixels + i * (size_t)image.channels;
        const float grey = image.channels == 1 ? p[0] : 0.2126f * p[0] + 0.7152f * p[1] + 0.0722f * p[2];
        out->pixels[i] = fminf(fmaxf(EXPOSURE * grey, 0), 1);
    }
    koksma_image_fini(&image);
    koksma_scene_close(scene);
    return status;
}

static int clamp(int i, int size)
{
    return i < 0 ? 0 : i < size ? i : size - 1;
}

/* Filters an image, whose edge is continued. */
static void apply(const koksma_mask_filter *f, const koksma_image *from, koksma_image *to)
{
    for (int y = 0; y < from->height; y++) {
        for (int x = 0; x < from->width; x++) {
            double sum = 0;
            for (int i = 0; i < f->width * f->height; i++) {
                const int a = clamp(x + i % f->width - f->width / 2, from->width);
                const int b = clamp(y + i / f->width - f->height / 2, from->height);
                sum += f->weights[i] * (double)from->pixels[b * from->width + a];
            }
            to->pixels[y * from->width + x] = (float)sum;
        }
    }
}

static void dither(const koksma_image *from, const thresholds *t, koksma_image *to)
{
    for (int y = 0; y < from->height; y++) {
        for (int x = 0; x < from->width; x++) {
            const float threshold = t->values[y % t->height * t->width + x % t->width];
            to->pixels[y * from->width + x] = from->pixels[y * from->width + x] > threshold ? 1 : 0;
        }
    }
}

/* ---- The section ----------------------------------------------------------------------------------------- */

typedef struct dithering {
    const koksma__mask_sheet *sheet;
    thresholds all[OTHERS + KOKSMA_MAX_SHEET_MASKS];
    size_t n;
    koksma_image pictures[PICTURES], dithered, filtered, truth;
} dithering;

static double error_of(const koksma_image *a, const koksma_image *b)
{
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    double sum = 0;
    for (size_t i = 0; i < pixels; i++) {
        const double e = (double)a->pixels[i] - (double)b->pixels[i];
        sum += e * e;
    }
    return sqrt(sum / (double)pixels);
}

/* Makes room for the results of a picture. */
static koksma_status begin_picture(dithering *e, size_t picture)
{
    koksma_image *const results[] = {&e->dithered, &e->filtered, &e->truth};
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < sizeof results / sizeof *results; i++) {
        koksma_image_fini(results[i]);
        status = status ? status
                        : koksma_image_init(results[i], e->pictures[picture].width, e->pictures[picture].height, 1);
    }
    return status;
}

/* Writes a row of the table: the errors of one set of thresholds with all filters. */
static koksma_status put_row(dithering *e, size_t picture, const thresholds *t, koksma__document *d)
{
    const koksma_image *from = &e->pictures[picture];
    koksma__doc_row(d);
    koksma__doc_cells(d, "tt", picture ? SCENE_NAME : "ramp", t->name);
    dither(from, t, &e->dithered);
    for (size_t f = 0; f < e->sheet->n_filters; f++) {
        apply(&e->sheet->filters[f], from, &e->truth);
        apply(&e->sheet->filters[f], &e->dithered, &e->filtered);
        koksma__doc_cells(d, "n", error_of(&e->filtered, &e->truth));
    }
    return koksma__ask(e->sheet->run);
}

static koksma_status put_table(dithering *e, koksma__document *d)
{
    koksma__doc_table_begin(d, "dithering");
    koksma__doc_columns(d, "t picture;t thresholds");
    for (size_t f = 0; f < e->sheet->n_filters; f++) {
        koksma__doc_columns(d, "n3 %s", e->sheet->filter_names[f]);
    }
    koksma_status status = KOKSMA_OK;
    for (size_t picture = 0; picture < PICTURES && !status; picture++) {
        status = begin_picture(e, picture);
        for (size_t t = 0; t < e->n && !status; t++) {
            status = put_row(e, picture, &e->all[t], d);
        }
    }
    koksma__doc_table_end(d);
    return status;
}

/* Draws a picture dithered by one set of thresholds, and filtered by the first filter. */
static koksma_status put_figure(dithering *e, size_t picture, const thresholds *t, koksma__document *d)
{
    dither(&e->pictures[picture], t, &e->dithered);
    apply(&e->sheet->filters[0], &e->dithered, &e->filtered);
    apply(&e->sheet->filters[0], &e->pictures[picture], &e->truth);
    koksma__doc_figure_begin(d, "dithered");
    koksma_status status = koksma__doc_image(d, &e->dithered, 1, t->name);
    status = status ? status : koksma__doc_image(d, &e->filtered, 1, "filtered");
    koksma__doc_caption(d);
    koksma__doc_say(d, "%s, dithered and filtered: error %.3g", t->name, error_of(&e->filtered, &e->truth));
    koksma__doc_figure_end(d);
    return status;
}

static koksma_status put_section(dithering *e, koksma__document *d)
{
    koksma__doc_section(d, "dithering", "Dithering");
    koksma__doc_paragraph(
        d,
        "A ramp and the scene `%s`, in linear light: white where the picture exceeds the threshold of the "
        "pixel. The table has the root mean square difference from the picture, both filtered; the "
        "figures are filtered by `%s`.",
        SCENE_NAME, e->sheet->filter_names[0]);
    koksma_status status = put_table(e, d);
    for (size_t picture = 0; picture < PICTURES && !status; picture++) {
        status = begin_picture(e, picture);
        koksma__doc_figure_begin(d, "picture");
        status = status ? status : koksma__doc_image(d, &e->pictures[picture], 1, "picture");
        koksma__doc_caption(d);
        koksma__doc_say(d, picture ? "%s, as it is" : "a ramp, as it is", SCENE_NAME);
        koksma__doc_figure_end(d);
        for (size_t t = 0; t < e->n && !status; t++) {
            status = put_figure(e, picture, &e->all[t], d);
        }
    }
    koksma__doc_end(d);
    return status;
}

koksma_status koksma__mask_sheet_dither(const koksma__mask_sheet *s, koksma__document *d)
{
    dithering e = {.sheet = s, .n = OTHERS};
    for (size_t i = 0; i < s->n; i++) {
        const koksma_mask *m = &s->masks[i];
        if (m->space == koksma_mask_space_at(0)) {
            e.all[e.n++] = (thresholds){s->names[i], m->values, m->width, m->height};
        }
    }
    if (e.n == OTHERS) {
        return KOKSMA_OK;
    }
    const size_t bytes = (size_t)(2 * TILE * TILE + BAYER * BAYER) * sizeof(float);
    float *values = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(values, bytes);
    koksma_status status = make_others(s->run, values, e.all);
    status = status ? status : make_ramp(&e.pictures[0]);
    status = status ? status : make_scene(s->run, &e.pictures[1]);
    status = status ? status : put_section(&e, d);
    koksma_image *const images[] = {&e.pictures[0], &e.pictures[1], &e.dithered, &e.filtered, &e.truth};
    for (size_t i = 0; i < sizeof images / sizeof *images; i++) {
        koksma_image_fini(images[i]);
    }
    free(values);
    return status;
}
