/* SPDX-License-Identifier: Apache-2.0 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <koksma/plot.h>

#include "study/report.h"

enum { POINTS_WIDTH = 280, SCENE_SCALE = 3 };

static koksma_status add_points(koksma__html *h, const koksma__figure *f)
{
    koksma_spec spec;
    koksma_points points;
    unsigned char *svg;
    size_t size;
    koksma_status status = koksma_pattern_spec(f->pattern, &spec);
    if (!status) {
        status = koksma_points_init(&points, (size_t)f->n, 2);
    }
    if (status) {
        return status;
    }
    status = koksma_generate(&spec, koksma__job_seed("figure|%s|%lld", f->pattern, f->n), NULL, &points);
    koksma_scatter_options options = {.size = POINTS_WIDTH};
    if (f->cells) { /* the strata: n x n rows and columns, or the cells of a grid */
        options.columns = options.rows =
            spec.pattern->claims & KOKSMA_CLAIM_LATIN ? (size_t)f->n : (size_t)sqrt((double)f->n);
    }
    if (!status) {
        status = koksma_plot_scatter(&points, &options, KOKSMA_PLOT_SVG, &svg, &size);
    }
    if (!status) {
        koksma__html_svg(h, svg, size, POINTS_WIDTH, f->title);
        free(svg);
    }
    koksma_points_fini(&points);
    return status;
}

static koksma_status add_scene(const koksma_study *study, koksma__html *h, const koksma__figure *f,
                               const koksma_run *run)
{
    koksma_image image;
    const koksma__study_scene *scene = koksma__study_scene_of(study, f->scene);
    const koksma__picture picture = {.pattern = f->pattern,
                                     .variant = "",
                                     .spp = f->n,
                                     .width = scene->width,
                                     .height = scene->height,
                                     .seed = koksma__job_seed("figure|%s|%s|%lld", f->scene, f->pattern, f->n)};
    koksma_status status = koksma__study_render(scene, &picture, run, &image);
    if (!status) {
        status = koksma__html_image(h, &image, SCENE_SCALE, f->title);
        koksma_image_fini(&image);
    }
    return status;
}

koksma_status koksma__report_figures(koksma_study *study, koksma__html *html, const koksma_run *run)
{
    koksma_status status = KOKSMA_OK;
    if (study->plan.n_figures == 0) {
        return status;
    }
    koksma__html_add(html, "<h2>Figures</h2>\n<div class=\"figures\">\n");
    for (size_t i = 0; !status && i < study->plan.n_figures; i++) {
        const koksma__figure *f = &study->plan.figures[i];
        koksma__html_add(html, "<figure id=\"figure-%s\">", f->id);
        status = f->scene ? add_scene(study, html, f, run) : add_points(html, f);
        koksma__html_add(html, "<figcaption>Figure %s: ", f->id);
        koksma__html_text(html, f->title);
        koksma__html_add(html, "</figcaption></figure>\n");
    }
    koksma__html_add(html, "</div>\n");
    return status;
}
