/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Datasheets of masks: errors by filter, pictures of masks and of their spectra, radial means, autocorrelations,
 * histograms, correlations of pairs, and dithering, in the format and on the page of a sampler's
 * datasheet. `koksma mask check` prints the same numbers.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/datasheet.h>
#include <koksma/maskfile.h>
#include <koksma/render.h>

#include "core/clock.h"
#include "core/parallel.h"
#include "core/status.h"
#include "study/sheet/sheet.h"

/* What koksma_mask_datasheet was given; filters: those that filter_names means. */
typedef struct mask_sheet {
    const koksma_mask *masks;
    const char *const *names;
    size_t n;
    const char *const *filter_names;
    koksma_mask_filter *filters;
    size_t n_filters;
    const koksma_run *run;
} mask_sheet;

/* ---- Dithering ------------------------------------------------------------------------------------------- */

/*
 * Dithering with masks: a ramp and a rendered scene, both linear light in [0,1], become 1 where they exceed the threshold
 * of their pixel, else 0, and are filtered. The error is the root mean square difference from the picture itself, filtered
 * alike. White noise, Bayer's matrix (1973) and a void-and-cluster mask (Ulichney 1993) are beside the masks of the sheet.
 */

enum { WIDTH = 240, RAMP = 48, SCENE = 160, SPP = 64, EXPOSURE = 2, TILE = 64, BAYER = 16, OTHERS = 3, PICTURES = 2 };

static const char SCENE_NAME[] = "product";

/* Thresholds in [0,1) of a tile. */
typedef struct thresholds {
    const char *name;
    const float *values;
    int width, height;
} thresholds;

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
    for (int i = 0; i < from->width * from->height; i++) {
        const int x = i % from->width % t->width, y = i / from->width % t->height;
        to->pixels[i] = from->pixels[i] > t->values[y * t->width + x] ? 1 : 0;
    }
}

typedef struct dithering {
    const mask_sheet *sheet;
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
    koksma__doc_paragraph(d,
                          "A ramp and the scene `%s`, in linear light: white where the picture exceeds the threshold "
                          "of the pixel. The table has the root mean square difference from the picture, both "
                          "filtered; the figures are filtered by `%s`.",
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

/* Writes the section on dithering, if a mask has one uniform number a pixel. Errors: UNSUPPORTED (no PNG) and others. */
static koksma_status put_dithering(const mask_sheet *s, koksma__document *d)
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

enum { RINGS = 32, BINS = 32, FARTHEST = 12, SIDE = 200, WHITE = 2, SCALAR_TESTS = 256, VECTOR_TESTS = 400 };

static size_t pixels_of(const koksma_mask *mask)
{
    return (size_t)mask->width * (size_t)mask->height;
}

/* ---- Errors ---------------------------------------------------------------------------------------------- */

static koksma_status put_errors(const mask_sheet *s, koksma__document *d)
{
    koksma__doc_section(d, "errors", "What filters leave");
    koksma__doc_paragraph(d,
                          "The root of the mean, over %d thresholds t (of vectors: %d half-spaces), of the variance "
                          "of the filtered image of (value < t). White: of the same values in random order. Inside: "
                          "of pixels whose filter lies within the mask; seam: of those whose filter spans opposite "
                          "sides. A tile repeats without a visible seam if the two are equal.",
                          SCALAR_TESTS, VECTOR_TESTS);
    koksma__doc_table_begin(d, "errors");
    koksma__doc_columns(d, "t mask;t space;t filter;n4 error;n4 white;n3 error / white;n4 inside;n4 seam");
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < s->n * s->n_filters && !status; i++) {
        const size_t f = i / s->n;
        const koksma_mask *m = &s->masks[i % s->n];
        koksma_mask_quality q;
        status = koksma_mask_measure(m->width, m->height, m->space, m->values, &s->filters[f],
                                     m->space->dim > 1 ? VECTOR_TESTS : SCALAR_TESTS, s->run, &q);
        if (!status) {
            koksma__doc_row(d);
            koksma__doc_cells(d, "tttnnnnn", s->names[i % s->n], m->space->name, s->filter_names[f], q.error, q.white,
                              q.error / q.white, q.inside, q.seam);
        }
    }
    koksma__doc_table_end(d);
    koksma__doc_end(d);
    return status;
}

/* ---- Pictures -------------------------------------------------------------------------------------------- */

/* Returns by how much a picture is enlarged. */
static int scale_of(const koksma_mask *m)
{
    return m->width >= SIDE ? 1 : (SIDE + m->width - 1) / m->width;
}

/* Draws the numbers of the pixels: one as a grey, more as red, green and blue. */
static koksma_status put_mask(const koksma_mask *m, const char *name, koksma__document *d)
{
    const int dim = m->space->dim, channels = dim == 1 ? 1 : 3;
    koksma_image image;
    KOKSMA__TRY(koksma_image_init(&image, m->width, m->height, channels));
    for (size_t i = 0; i < pixels_of(m); i++) {
        for (int k = 0; k < channels && k < dim; k++) {
            const double v = (double)m->values[i * (size_t)dim + (size_t)k];
            image.pixels[i * (size_t)channels + (size_t)k] =
                (float)((v - m->space->low) / (m->space->high - m->space->low));
        }
    }
    const koksma_status status = koksma__doc_image(d, &image, scale_of(m), name);
    koksma_image_fini(&image);
    return status;
}

/* Draws the power with the frequency (0, 0) in the middle. */
static koksma_status put_power(const koksma_mask *m, koksma__document *d)
{
    const size_t width = (size_t)m->width, height = (size_t)m->height;
    koksma_image image;
    double *power = malloc(pixels_of(m) * sizeof *power);
    KOKSMA__REQUIRE_MEMORY(power, pixels_of(m) * sizeof *power);
    koksma_status status = koksma_mask_power(m, power);
    status = status ? status : koksma_image_init(&image, m->width, m->height, 1);
    if (!status) {
        for (size_t i = 0; i < pixels_of(m); i++) {
            const size_t u = (i % width + width - width / 2) % width, v = (i / width + height - height / 2) % height;
            image.pixels[i] = (float)(power[v * width + u] / WHITE);
        }
        status = koksma__doc_image(d, &image, scale_of(m), "power spectrum");
        koksma_image_fini(&image);
    }
    free(power);
    return status;
}

static koksma_status put_pictures(const mask_sheet *s, koksma__document *d)
{
    koksma__doc_section(d, "pictures", "Masks and their spectra");
    koksma__doc_paragraph(
        d,
        "Left: the numbers of the pixels, from the least (black) to the largest of the space; two or more as red, "
        "green and blue. Right: the power at each frequency, (0, 0) in the middle; white noise has the mean 1, "
        "mid-grey, and %d or more is white. A dark disk in the middle is blue noise.",
        WHITE);
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < s->n && !status; i++) {
        koksma__doc_figure_begin(d, "mask");
        status = put_mask(&s->masks[i], s->names[i], d);
        status = status ? status : put_power(&s->masks[i], d);
        koksma__doc_caption(d);
        koksma__doc_say(d, "%s, %d x %d", s->names[i], s->masks[i].width, s->masks[i].height);
        koksma__doc_figure_end(d);
    }
    koksma__doc_end(d);
    return status;
}

/* ---- Curves ---------------------------------------------------------------------------------------------- */

static koksma_status radial(const koksma_mask *m, double *x, double *y)
{
    double unused[RINGS];
    for (int r = 0; r < RINGS; r++) {
        x[r] = (r + 0.5) / (2 * RINGS);
    }
    return koksma_mask_rings(m, RINGS, y, unused);
}

static koksma_status anisotropy(const koksma_mask *m, double *x, double *y)
{
    double power[RINGS];
    KOKSMA__TRY(radial(m, x, power));
    return koksma_mask_rings(m, RINGS, power, y);
}

/* The mean correlation of pixels whose distance rounds to 1, 2, .. */
static koksma_status autocorrelation(const koksma_mask *m, double *x, double *y)
{
    double *all = malloc(pixels_of(m) * sizeof *all);
    size_t counts[FARTHEST] = {0};
    KOKSMA__REQUIRE_MEMORY(all, pixels_of(m) * sizeof *all);
    const koksma_status status = koksma_mask_correlation(m, m, all);
    for (int r = 0; r < FARTHEST; r++) {
        x[r] = r + 1;
        y[r] = 0;
    }
    for (int dy = -FARTHEST; dy <= FARTHEST && !status; dy++) {
        for (int dx = -FARTHEST; dx <= FARTHEST; dx++) {
            const int r = (int)lrint(sqrt(dx * dx + dy * dy)) - 1;
            if (r >= 0 && r < FARTHEST) {
                counts[r]++;
                y[r] +=
                    all[(dy + FARTHEST * m->height) % m->height * m->width + (dx + FARTHEST * m->width) % m->width];
            }
        }
    }
    for (int r = 0; r < FARTHEST && !status; r++) {
        y[r] /= (double)counts[r];
    }
    free(all);
    return status;
}

/* The histogram of all numbers of the pixels together, divided by its mean. */
static koksma_status histogram(const koksma_mask *m, double *x, double *y)
{
    size_t counts[4 * BINS];
    KOKSMA__TRY(koksma_mask_histogram(m, BINS, counts));
    for (int b = 0; b < BINS; b++) {
        size_t sum = 0;
        for (int k = 0; k < m->space->dim; k++) {
            sum += counts[k * BINS + b];
        }
        x[b] = (b + 0.5) / BINS;
        y[b] = (double)sum * BINS / ((double)pixels_of(m) * m->space->dim);
    }
    return KOKSMA_OK;
}

/* A chart with a line of `count` numbers for each mask, and one for white noise, which is at `level`. */
typedef struct curve {
    const char *title, *x, *y;
    size_t count;
    double level;
    koksma_status (*make)(const koksma_mask *mask, double *x, double *y);
} curve;

static const curve curves[] = {
    {"Radial mean of the power", "cycles a pixel", "power", RINGS, 1, radial},
    {"Anisotropy", "cycles a pixel", "dB", RINGS, 0, anisotropy},
    {"Autocorrelation", "distance, pixels", "correlation", FARTHEST, 0, autocorrelation},
    {"Histogram of all numbers", "share of the range of the space", "pixels, relative to uniform", BINS, 1,
     histogram},
};

static koksma_status put_curve(const mask_sheet *s, const curve *c, koksma__document *d)
{
    double x[RINGS + BINS], y[RINGS + BINS];
    koksma_status status = KOKSMA_OK;
    koksma__doc_chart_begin(d, &(koksma__chart){c->title, c->x, c->y, false, false, 0, NULL});
    for (size_t i = 0; i < s->n && !status; i++) {
        status = c->make(&s->masks[i], x, y);
        koksma__doc_series_begin(d, s->names[i], NULL, KOKSMA__SERIES_LINE);
        for (size_t k = 0; k < c->count && !status; k++) {
            koksma__doc_point(d, x[k], y[k], NAN, NAN);
        }
        koksma__doc_end(d);
    }
    koksma__doc_series_begin(d, "white noise", NULL, KOKSMA__SERIES_THEORY);
    koksma__doc_point(d, x[0], c->level, NAN, NAN);
    koksma__doc_point(d, x[c->count - 1], c->level, NAN, NAN);
    koksma__doc_end(d);
    koksma__doc_end(d);
    return status;
}

static koksma_status put_curves(const mask_sheet *s, koksma__document *d)
{
    koksma__doc_section(d, "spectra", "Spectra, autocorrelation, histogram");
    koksma__doc_paragraph(
        d, "Anisotropy: the variance of the power at frequencies of about equal length, divided by the square of its "
           "mean; that of noise without a preferred direction is 0 dB for one number a pixel, -3 dB for two. "
           "Autocorrelation: the mean over pixels at about equal distance.");
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; i < sizeof curves / sizeof *curves && !status; i++) {
        status = put_curve(s, &curves[i], d);
    }
    koksma__doc_end(d);
    return status;
}

/* ---- Pairs ----------------------------------------------------------------------------------------------- */

static koksma_status put_pair(const mask_sheet *s, size_t a, size_t b, koksma__document *d)
{
    const koksma_mask *m = &s->masks[a];
    double *all = malloc(pixels_of(m) * sizeof *all);
    KOKSMA__REQUIRE_MEMORY(all, pixels_of(m) * sizeof *all);
    const koksma_status status = koksma_mask_correlation(m, &s->masks[b], all);
    size_t largest = 0;
    for (size_t i = 0; i < pixels_of(m) && !status; i++) {
        largest = fabs(all[i]) > fabs(all[largest]) ? i : largest;
    }
    if (!status) {
        koksma__doc_row(d);
        koksma__doc_cells(d, "ttnnzz", s->names[a], s->names[b], all[0], all[largest], largest % (size_t)m->width,
                          largest / (size_t)m->width);
    }
    free(all);
    return status;
}

static koksma_status put_pairs(const mask_sheet *s, koksma__document *d)
{
    if (s->n < 2) {
        return KOKSMA_OK;
    }
    koksma_status status = KOKSMA_OK;
    koksma__doc_section(d, "pairs", "Correlation of two masks");
    koksma__doc_paragraph(
        d, "At the same pixel, and the largest over all shifts of the second mask on the torus. Near 1: one is a "
           "shifted copy of the other. Masks of other sizes or numbers have no correlation.");
    koksma__doc_table_begin(d, "pairs");
    koksma__doc_columns(d, "t mask;t with;n3 same pixel;n3 largest;n9 at x;n9 at y");
    for (size_t a = 0; a < s->n; a++) {
        for (size_t b = a + 1; b < s->n && !status; b++) {
            const koksma_mask *m = &s->masks[a], *o = &s->masks[b];
            if (m->width == o->width && m->height == o->height && m->space->dim == o->space->dim) {
                status = put_pair(s, a, b, d);
            }
        }
    }
    koksma__doc_table_end(d);
    koksma__doc_end(d);
    return status;
}

/* ---- The sheet ------------------------------------------------------------------------------------------- */

static koksma_status put_content(const mask_sheet *s, koksma__document *d)
{
    static koksma_status (*const sections[])(const mask_sheet *, koksma__document *) = {
        put_errors, put_pictures, put_curves, put_pairs, put_dithering};
    koksma__doc_head(d, "koksma-datasheet", s->n > 1 ? "Datasheet of masks" : "Datasheet of a mask", "", NULL);
    koksma__json_begin_array(&d->json, "samplers");
    for (size_t i = 0; i < s->n; i++) {
        koksma__json_write_text(&d->json, NULL, s->names[i]);
    }
    koksma__json_end(&d->json);
    koksma__json_begin_array(&d->json, "content");
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        KOKSMA__TRY(sections[i](s, d));
        KOKSMA__TRY(koksma__ask(s->run));
    }
    koksma__json_end(&d->json);
    return KOKSMA_OK;
}

koksma_status koksma_mask_datasheet(const koksma_mask *masks, const char *const *names, size_t n,
                                    const char *const *filters, size_t n_filters, const koksma_run *run, char **json)
{
    KOKSMA__REQUIRE(masks, names, filters, json);
    KOKSMA__REQUIRE_RUN(run);
    *json = NULL;
    KOKSMA__FAIL_IF(n < 1 || n > KOKSMA_MAX_SHEET_MASKS, KOKSMA_ARGUMENT, "n: %zu masks; a datasheet takes 1 to %d",
                    n, KOKSMA_MAX_SHEET_MASKS);
    KOKSMA__FAIL_IF(n_filters < 1 || n_filters > KOKSMA_MAX_SHEET_MASKS, KOKSMA_ARGUMENT,
                    "n_filters: %zu filters; a datasheet takes 1 to %d", n_filters, KOKSMA_MAX_SHEET_MASKS);
    for (size_t i = 0; i < n; i++) {
        KOKSMA__FAIL_IF(!names[i] || !masks[i].space || !masks[i].values, KOKSMA_ARGUMENT,
                        "mask %zu: its name, space and values must not be NULL", i);
    }
    const double start_s = koksma__now_s();
    mask_sheet s = {masks, names, n, filters, NULL, n_filters, run};
    koksma__document d = {0};
    s.filters = malloc(n_filters * sizeof *s.filters);
    KOKSMA__REQUIRE_MEMORY(s.filters, n_filters * sizeof *s.filters);
    koksma_status status = KOKSMA_OK;
    for (size_t f = 0; f < n_filters && !status; f++) {
        status = koksma_mask_filter_parse(filters[f], &s.filters[f]);
    }
    status = status ? status : put_content(&s, &d);
    status = koksma__sheet_finish(&d, status, start_s, json);
    free(s.filters);
    return status;
}
