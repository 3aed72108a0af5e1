/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The figures of a plan, computed again from their keys for every report: points as a scatter plot (SVG), scenes as
 * images (PNG), the strata of adaptive sampling in a pixel (SVG), and the random lines with which Mitchell 1992
 * (section 5) measures edges. Lines y = m x + b are drawn in the unit square, or as points (m, b); the points of the
 * lines that meet the square fill a bow-tie: 0 < b < 1 - m for m < 0 and -m < b < 1 for m > 0.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/plot.h>
#include <koksma/warp.h>

#include "core/c_locale.h"
#include "core/status.h"
#include "measures/edge/edge.h"
#include "study/plan/variants.h"
#include "study/report/report.h"

enum { POINTS_WIDTH = 280, SCENE_SCALE = 3, NOTE = 160, PROBES = 16 };

/* Adds the scatter plot of a point set. If the pattern runs code that the user has not allowed, there is no plot, and
   `note` receives a text for the caption that says so; otherwise `note` is unchanged. */
static koksma_status add_points(koksma__document *d, const koksma__figure *f, const koksma_run *run, char note[NOTE])
{
    koksma_spec spec;
    koksma_points points;
    unsigned char *svg;
    size_t size;
    koksma_status status = koksma_pattern_spec(f->pattern, &spec);
    status = status ? status : koksma_points_init(&points, (size_t)f->n, 2);
    KOKSMA__TRY(status);
    status = koksma_generate(&spec, koksma__job_seed("figure|%s|%lld", f->pattern, f->n), run, &points);
    koksma_scatter_options options = {.size = POINTS_WIDTH, .warp = f->warp ? koksma_warp_find(f->warp) : NULL};
    if (f->cells) { /* how to show the strata: as n columns and n rows, or as the cells of a sqrt n x sqrt n grid */
        options.columns = options.rows =
            spec.pattern->claims & KOKSMA_CLAIM_LATIN ? (size_t)f->n : (size_t)sqrt((double)f->n);
    }
    status = status ? status : koksma_plot_scatter(&points, &options, KOKSMA_PLOT_SVG, &svg, &size);
    if (!status) {
        koksma__doc_svg(d, svg, size, POINTS_WIDTH, f->title);
        free(svg);
    }
    if (status == KOKSMA_FORBIDDEN) { /* a report runs code of others only if the user allows it */
        snprintf(note, NOTE, " (not drawn: the pattern runs code, which needs --allow-exec)");
        status = KOKSMA_OK;
    }
    koksma_points_fini(&points);
    return status;
}

static koksma_status add_space(koksma__document *d, const koksma__figure *f, const koksma_space *space)
{
    unsigned char *svg;
    size_t size;
    char text[96];
    koksma__snprintf(text, sizeof text, "%zu strata in the space: %s", space->n, space->name);
    const koksma_strata_panel panel = {.strata = space->strata,
                                       .n = space->n,
                                       .splits = space->splits,
                                       .n_splits = space->n_splits,
                                       .caption = text};
    KOKSMA__TRY(koksma_plot_strata(&panel, 1, POINTS_WIDTH, KOKSMA_PLOT_SVG, &svg, &size));
    koksma__doc_svg(d, svg, size, POINTS_WIDTH, f->title);
    free(svg);
    return KOKSMA_OK;
}

static const koksma_space *find_space(const koksma_strata *strata, const char *name)
{
    for (size_t i = 0; i < strata->n_spaces; i++) {
        if (!strcmp(strata->spaces[i].name, name)) {
            return &strata->spaces[i];
        }
    }
    return NULL;
}

/* Adds one picture for each sample space that has strata; the page shows the pictures side by side if they fit. */
static koksma_status add_strata(koksma__document *d, const koksma__figure *f, koksma_strata *strata)
{
    koksma_status status = KOKSMA_OK;
    for (size_t i = 0; !status && i < (f->spaces.n ? f->spaces.n : strata->n_spaces); i++) {
        const koksma_space *space = f->spaces.n ? find_space(strata, f->spaces.at[i]) : &strata->spaces[i];
        status = space ? add_space(d, f, space)
                       : koksma__fail(
                             KOKSMA_ARGUMENT,
                             "figure %s: 'spaces' names '%s', but the samples of scene %s have no space of that name",
                             f->id, f->spaces.at[i], f->scene);
    }
    koksma_strata_fini(strata);
    return status;
}

/* Adds the part of an image that the figure shows, enlarged to the width of the whole image and multiplied by the
   figure's exposure. */
static koksma_status add_part(koksma__document *d, const koksma__figure *f, const koksma_image *image)
{
    koksma_image part;
    const bool whole = !f->detail[2];
    const int x = (int)f->detail[0], y = (int)f->detail[1], width = whole ? image->width : (int)f->detail[2],
              height = whole ? image->height : (int)f->detail[3];
    KOKSMA__FAIL_IF(x + width > image->width || y + height > image->height, KOKSMA_ARGUMENT,
                    "figure %s: its detail lies beyond the image", f->id);
    KOKSMA__TRY(koksma_image_init(&part, width, height, image->channels));
    const size_t channels = (size_t)image->channels, row_size = (size_t)width * channels;
    for (int row = 0; row < height; row++) {
        const float *from = image->pixels + ((size_t)(y + row) * (size_t)image->width + (size_t)x) * channels;
        for (size_t k = 0; k < row_size; k++) {
            part.pixels[(size_t)row * row_size + k] = (float)f->exposure * from[k];
        }
    }
    const koksma_status status = koksma__doc_image(d, &part, SCENE_SCALE * image->width / width, f->title);
    koksma_image_fini(&part);
    return status;
}

/* Writes a note for the caption: how many samples per pixel the adaptive method took over the whole image and, if it
   splits strata, how many splits were needless. */
static void describe_adaptive(const koksma__figure *f, double pixels, const koksma_adaptive_report *report,
                              char note[NOTE])
{
    const int length = koksma__snprintf(note, NOTE, " (image: %lld samples a pixel at first, %.1f more on average",
                                        f->n, (double)(report->samples - report->first) / pixels);
    if (report->splits) {
        koksma__snprintf(note + length, (size_t)(NOTE - length), "; %.0f %% of %llu splits needless)",
                         100 * (double)report->needless / (double)report->splits, (unsigned long long)report->splits);
    } else {
        snprintf(note + length, (size_t)(NOTE - length), ")");
    }
}

static koksma_status add_adaptive(const koksma__study_scene *scene, koksma__document *d, const koksma__figure *f,
                                  uint64_t seed, const koksma_run *run, koksma_adaptive_report *report,
                                  char note[NOTE])
{
    koksma__variant variant;
    koksma_render_options *options = &variant.render;
    koksma_adaptive_options adaptive;
    koksma_layers layers;
    koksma_strata strata = {.x = (int)f->strata[0], .y = (int)f->strata[1]};
    koksma_render_options_init(options, scene->scene);
    options->integrator = koksma_integrator_find("distribution"); /* a variant names another, also path */
    koksma_status status = koksma__image_pattern_set(f->pattern, options);
    status = status ? status : koksma__variant_apply(f->variant, false, &variant);
    status = status ? status : koksma_adaptive_parse(f->adaptive, &adaptive);
    options->spp = (int)f->n;
    options->seed = seed;
    options->width = scene->width;
    options->height = scene->height;
    adaptive.strata = f->strata[0] >= 0 ? &strata : NULL;
    adaptive.probes = adaptive.method->own_samples ? PROBES : 0;
    if (status || (status = koksma_render_adaptive(scene->scene, options, &adaptive, run, &layers, report))) {
        return status;
    }
    status = adaptive.strata ? add_strata(d, f, &strata) : add_part(d, f, &layers.image);
    describe_adaptive(f, (double)scene->width * (double)scene->height, report, note);
    koksma_layers_fini(&layers);
    return status;
}

static koksma_status add_scene(const koksma_study *study, koksma__document *d, const koksma__figure *f,
                               const koksma_run *run, koksma_adaptive_report *report, char note[NOTE])
{
    koksma_image image;
    const koksma__study_scene *scene = koksma__study_scene_of(study, f->scene);
    const koksma__picture picture = {.pattern = f->pattern,
                                     .variant = f->variant,
                                     .spp = f->n,
                                     .width = scene->width,
                                     .height = scene->height,
                                     .seed = koksma__job_seed("figure|%s|%s|%lld", f->scene, f->pattern, f->n)};
    if (f->adaptive) {
        return add_adaptive(scene, d, f, picture.seed, run, report, note);
    }
    KOKSMA__TRY(koksma__study_render(scene, &picture, run, &image));
    const koksma_status status = add_part(d, f, &image);
    koksma_image_fini(&image);
    return status;
}

/* ---- Random lines ------------------------------------------------------------------------------------------ */

static const double MOST_SLOPE = 3; /* largest |m| of the lines that are shown as points (m, b) */

/* Finds the two points where the line a x + b y = c meets the border of the unit square; returns false if there are
   fewer. */
static bool meet_square(double a, double b, double c, double ends[2][2])
{
    int n = 0;
    for (int side = 0; side < 4 && n < 2; side++) {
        const double at = side % 2; /* x = 0, x = 1, y = 0, y = 1 */
        const double along = side < 2 ? (c - a * at) / b : (c - b * at) / a;
        if (along >= 0 && along < 1) {
            ends[n][0] = side < 2 ? at : along;
            ends[n++][1] = side < 2 ? along : at;
        }
    }
    return n == 2;
}

/* Draws the border of the unit square or, if `dual`, of the bow-tie. */
static void add_outline(koksma__document *d, bool dual)
{
    static const double square[][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    static const double bow_tie[][2] = {{-3, 0}, {0, 0}, {3, -3}, {3, 1}, {0, 1}, {-3, 4}};
    const double(*corners)[2] = dual ? bow_tie : square;
    const size_t n = dual ? 6 : 4;
    for (size_t i = 0; i < n; i++) {
        const double *to = corners[(i + 1) % n];
        koksma__doc_line(d, corners[i][0], corners[i][1], to[0], to[1]);
    }
}

static void add_lines(koksma__document *d, const koksma__figure *f)
{
    const double square[4] = {0, 0, 1, 1}, plane[4] = {-MOST_SLOPE, -MOST_SLOPE, MOST_SLOPE, MOST_SLOPE + 1};
    const uint64_t seed = koksma__job_seed("figure|lines|%lld", f->n);
    koksma__doc_drawing(d, POINTS_WIDTH, f->dual ? plane : square, f->title);
    add_outline(d, f->dual);
    for (long long i = 0; i < f->n; i++) {
        double a, b, c, ends[2][2];
        koksma__random_line(KOKSMA__LINES_MITCHELL, seed, (uint64_t)i, &a, &b, &c);
        if (!f->dual && meet_square(a, b, c, ends)) {
            koksma__doc_line(d, ends[0][0], ends[0][1], ends[1][0], ends[1][1]);
        } else if (f->dual && fabs(a / b) <= MOST_SLOPE) {
            koksma__doc_dot(d, -a / b, c / b);
        }
    }
}

/* ---- The section ------------------------------------------------------------------------------------------- */

static void add_figure(koksma__report *r, koksma__document *d, const koksma__figure *f,
                       koksma_adaptive_report *report)
{
    char id[96], note[NOTE] = "";
    snprintf(id, sizeof id, "figure-%.80s", f->id);
    koksma__doc_figure(d, id);
    if (f->lines) {
        add_lines(d, f);
    } else {
        koksma__report_keep(r, f->scene ? add_scene(r->study, d, f, r->run, report, note)
                                        : add_points(d, f, r->run, note));
    }
    koksma__doc_caption(d, "Figure %s: %s%s", f->id, f->title, note);
    if (f->exposure != 1) {
        koksma__doc_say(d, ". Shown %g times as bright as rendered", f->exposure);
    }
    if (f->printed) {
        koksma__doc_say(d, ". In the text: %s", f->printed);
    }
}

static void write_figures(koksma__report *r, koksma__document *d)
{
    const koksma__plan *plan = &r->study->plan;
    const size_t *of = plan->parts[r->part].figures;
    koksma_adaptive_report *reports = koksma__report_memory(r, plan->n_figures, sizeof *reports);
    for (size_t i = of[0]; !r->status && i < of[1]; i++) {
        add_figure(r, d, &plan->figures[i], &reports[i]);
    }
    r->adaptive = reports;
    koksma__conclude(r, d, true);
}

const koksma__section koksma__section_figures = {"Figures", true, write_figures};
