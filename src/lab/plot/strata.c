/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Pictures of subdivided squares, as in figures 5.35 and 5.36 of Shirley 1991: boxes filled with the greys of their
 * values, dots at the samples, and over these a symbol for each split of a box: a black mark if the split was
 * needless, a circle if it was needed. Circles are drawn last, so that a needed split inside a needless one remains
 * visible.
 */
#include <math.h>

#include "core/status.h"
#include "plot/plot.h"

static const koksma__colour line = {0.2, 0.35, 0.75, 1}, dot = {0.85, 0.25, 0.1, 1}, ink = {0.1, 0.1, 0.12, 1},
                            black = {0, 0, 0, 1}, ring = {0, 0.5, 0.2, 1}, paper = {1, 1, 1, 1};

enum { MARGIN = 6, CAPTION = 18 };

/* The darkest grey of a sample's value; black marks remain visible on it. */
#define MARKED_GREY 0.45

typedef struct square {
    koksma__canvas *canvas;
    double x, y, side;
} square;

static void add_box(const square *q, double x, double y, double width, double height, double thickness,
                    koksma__colour colour)
{
    const koksma__box box = {q->x + x * q->side, q->y + y * q->side, width * q->side, height * q->side};
    q->canvas->draw->box(q->canvas, box, (koksma__style){.thickness = thickness, .colour = colour});
}

/* Draws boxes in greys from black for value 0 to white for 1. If black marks follow, the greys run from MARKED_GREY
   for the smallest value to white for the largest. */
static void add_values(const square *q, const koksma_strata_panel *panel)
{
    const bool marked = panel->n_splits > 0;
    double low = marked && panel->n ? panel->strata[0].value : 0, high = marked ? low : 1;
    for (size_t i = 0; marked && i < panel->n; i++) {
        low = fmin(low, panel->strata[i].value);
        high = fmax(high, panel->strata[i].value);
    }
    for (size_t i = 0; i < panel->n; i++) {
        const koksma_stratum *s = &panel->strata[i];
        const double share = high > low ? (s->value - low) / (high - low) : 1;
        const double value = share > 1 ? 1 : share > 0 ? share : 0; /* NaN is 0 */
        const double grey = marked ? MARKED_GREY + (1 - MARKED_GREY) * value : value;
        add_box(q, s->x, s->y, s->width, s->height, 0, (koksma__colour){grey, grey, grey, 1});
    }
}

/* Draws the splits that were needless, or those that were not. */
static void add_splits(const square *q, const koksma_strata_panel *panel, bool needless)
{
    for (size_t i = 0; i < panel->n_splits; i++) {
        const koksma_split *s = &panel->splits[i];
        const double width = s->width < s->height ? s->width : s->height, radius = 0.5 * width * q->side;
        if (needless && s->needless) {
            add_box(q, s->x, s->y, s->width, s->height, 0, black);
        } else if (!needless && !s->needless) {
            q->canvas->draw->circle(q->canvas, q->x + (s->x + s->width / 2) * q->side,
                                    q->y + (s->y + s->height / 2) * q->side, radius > 3 ? radius : 3,
                                    (koksma__style){.thickness = s->level ? 1 : 2, .colour = ring});
        }
    }
}

static void add_panel(const square *q, const koksma_strata_panel *panel)
{
    add_values(q, panel);
    add_splits(q, panel, true);
    for (size_t i = 0; i < panel->n; i++) {
        const koksma_stratum *s = &panel->strata[i];
        add_box(q, s->x, s->y, s->width, s->height, 0.6, line);
        q->canvas->draw->circle(q->canvas, q->x + s->at[0] * q->side, q->y + s->at[1] * q->side, s->level ? 1.5 : 2.2,
                                (koksma__style){.colour = dot});
    }
    add_splits(q, panel, false);
    if (panel->caption) {
        koksma__canvas_text(q->canvas, q->x + q->side / 2, q->y + q->side + MARGIN + 8, 11, 0.5, panel->caption, ink);
    }
}

static bool is_in_square(double x, double y, double width, double height)
{
    return x >= 0 && y >= 0 && width >= 0 && height >= 0 && x + width <= 1 && y + height <= 1;
}

static koksma_status check_panel(const koksma_strata_panel *panel)
{
    koksma_status status = koksma__array_check("panels->strata", panel->strata, panel->n, sizeof *panel->strata);
    status = status ? status
                    : koksma__array_check("panels->splits", panel->splits, panel->n_splits, sizeof *panel->splits);
    for (size_t i = 0; i < panel->n && !status; i++) {
        const koksma_stratum *s = &panel->strata[i];
        if (!is_in_square(s->x, s->y, s->width, s->height) || !is_in_square(s->at[0], s->at[1], 0, 0)) {
            status = koksma__fail(KOKSMA_ARGUMENT, "panels->strata[%zu], or its sample, is not in the square", i);
        }
    }
    for (size_t i = 0; i < panel->n_splits && !status; i++) {
        const koksma_split *s = &panel->splits[i];
        if (!is_in_square(s->x, s->y, s->width, s->height)) {
            status = koksma__fail(KOKSMA_ARGUMENT, "panels->splits[%zu] is not in the square", i);
        }
    }
    return status;
}

koksma_status koksma_plot_strata(const koksma_strata_panel *panels, size_t n, double size, koksma_plot_format format,
                                 unsigned char **bytes, size_t *n_bytes)
{
    KOKSMA__REQUIRE(panels, bytes, n_bytes);
    double whole;
    bool captions = false;
    koksma_status status = koksma__figure_size(format, size, 320, &whole);
    if (!status && (n < 1 || whole * (double)n > KOKSMA_PLOT_MAX_SIZE)) {
        status = koksma__fail(KOKSMA_ARGUMENT, "%zu panels of side %g: a picture is 1 to %d wide", n, whole,
                              KOKSMA_PLOT_MAX_SIZE);
    }
    for (size_t p = 0; p < n && !status; p++) {
        captions = captions || panels[p].caption;
        status = check_panel(&panels[p]);
    }
    KOKSMA__TRY(status);
    square q = {.x = MARGIN, .y = MARGIN, .side = whole - 2 * MARGIN};
    status = koksma__canvas_open(format, (double)n * whole, whole + (captions ? CAPTION : 0), panels[0].caption,
                                 paper, &q.canvas);
    for (size_t p = 0; !status && p < n; p++) {
        add_panel(&q, &panels[p]);
        q.x += whole;
    }
    return status ? status : q.canvas->draw->close(q.canvas, bytes, n_bytes);
}
