/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Panels that show point sets in the unit square, as in figures 5.13 to 5.27 of Shirley 1991; points mapped by a
 * warp, with the borders of the cells, as in figure 5.34; points of more than two dimensions as the lower triangle of
 * a scatter matrix, which has a projection for each pair of axes; and power spectra.
 */
#include "plot/plot.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/c_locale.h"
#include "core/elementary.h"
#include "core/parallel.h"
#include "core/points.h"
#include "core/status.h"
#include "measures/spectra/spectra.h"

enum { MARGIN = 6, TITLE = 12, TEXT = 11, LABEL = 10, SWATCH = 12, FAR = 100, CURVE = 96, LOCAL = 256, NOTE = 128 };

/* A square in the picture. It shows coordinates axes[0] and axes[1] of the points. */
typedef struct plot {
    koksma__canvas *canvas;
    const koksma__theme *theme;
    const koksma_run *run;
    double left, top, side;
    int axes[2];
} plot;

static koksma__style line_of(koksma__colour colour, double thickness)
{
    return (koksma__style){thickness, colour, KOKSMA__DASH_WHOLE};
}

static koksma__box square(const plot *p)
{
    return (koksma__box){p->left, p->top, p->side, p->side};
}

static double at_x(const plot *p, double x)
{
    return p->left + x * p->side;
}

static double at_y(const plot *p, double y)
{
    return p->top + (1 - y) * p->side;
}

/* Projects a point of the sphere to the unit disk with areas in proportion (Lambert's azimuthal projection): the pole
   z = 1 is the centre and z = -1 the rim. */
static void project_sphere(double at[3])
{
    const double across = koksma__hypot(at[0], at[1]), radius = sqrt(fmax(1 - at[2], 0) / 2);
    at[0] = across > 0 ? radius * (at[0] / across) : radius;
    at[1] = across > 0 ? radius * (at[1] / across) : 0;
}

/* Computes the position in the picture of a point of the unit square, which is mapped by the warp, if there is one,
   and scaled; the range of the warp fills the square in the picture. Hemispheres are seen from above, and the sphere is
   projected with areas in proportion. */
static void position(const plot *p, const koksma_warp *warp, const double in[2], double out[2])
{
    double at[3] = {in[0], in[1], 0};
    if (warp) {
        warp->map(in, at);
        if (warp->domain == KOKSMA_DOMAIN_SPHERE) {
            project_sphere(at);
        }
        if (warp->domain != KOKSMA_DOMAIN_TRIANGLE) { /* disk of radius 1 */
            at[0] = 0.5 + 0.5 * at[0];
            at[1] = 0.5 + 0.5 * at[1];
        }
    }
    out[0] = at_x(p, at[0]);
    out[1] = at_y(p, at[1]);
}

/* Draws the line where coordinate `fixed` equals `value`, in short pieces if it goes through a warp. These end just inside
   the square: at the end itself, which `sphere` maps to the pole z = -1, the picture's rim has no direction. */
static void draw_guide(const plot *p, const koksma_warp *warp, int fixed, double value)
{
    const int pieces = warp ? CURVE : 1;
    double xys[2 * (CURVE + 1)], in[2];
    in[fixed] = value;
    for (int i = 0; i <= pieces; i++) {
        in[1 - fixed] = warp && i == pieces ? 1 - 1e-9 : (double)i / pieces;
        position(p, warp, in, xys + 2 * i);
    }
    p->canvas->draw->path(p->canvas, xys, (size_t)pieces + 1, line_of(p->theme->cell, 0.8));
}

/* Draws the borders between cells. With a warp it also draws the border of the square; in a disk this includes the
   line where the disk is cut open. */
static void draw_guides(const plot *p, const koksma_scatter_options *o)
{
    const size_t counts[2] = {o->columns, o->rows};
    for (int k = 0; k < 2; k++) {
        for (size_t i = o->warp ? 0 : 1; i < counts[k]; i++) {
            draw_guide(p, o->warp, k, (double)i / (double)counts[k]);
        }
    }
}

static void draw_frame(const plot *p, const koksma_warp *warp)
{
    const double right = p->left + p->side, bottom = p->top + p->side;
    const koksma__style style = line_of(p->theme->frame, 1);
    if (!warp) {
        p->canvas->draw->box(p->canvas, square(p), style);
    } else if (warp->domain == KOKSMA_DOMAIN_TRIANGLE) {
        p->canvas->draw->path(p->canvas, (double[]){p->left, p->top, p->left, bottom, right, bottom, p->left, p->top},
                              4, style);
    } else {
        p->canvas->draw->circle(p->canvas, p->left + p->side / 2, p->top + p->side / 2, p->side / 2, style);
    }
}

/* Draws a disk with its copies on the torus, as polygons clipped at the square. */
static void draw_disk(const plot *p, const koksma_witness *w)
{
    double xys[2 * (KOKSMA__MAX_CORNERS)];
    for (int copy = 0; copy < 9; copy++) {
        for (int i = 0; i < KOKSMA__MAX_CORNERS; i++) {
            const double angle = 2 * M_PI * i / (KOKSMA__MAX_CORNERS - 1);
            xys[2 * i] = at_x(p, w->lo[0] + copy % 3 - 1 + w->hi[0] * koksma__cos(angle));
            xys[2 * i + 1] = at_y(p, w->lo[1] + copy / 3 - 1 + w->hi[0] * koksma__sin(angle));
        }
        koksma__canvas_path_inside(p->canvas, xys, KOKSMA__MAX_CORNERS, square(p), line_of(p->theme->wash, 0));
        koksma__canvas_path_inside(p->canvas, xys, KOKSMA__MAX_CORNERS, square(p), line_of(p->theme->mark, 1.2));
    }
}

static void draw_half_plane(const plot *p, const koksma_witness *w)
{
    const double norm = koksma__hypot(w->lo[0], w->lo[1]), a = w->lo[0] / norm, b = w->lo[1] / norm, reach = 2;
    const double x = a * w->hi[0] / norm, y = b * w->hi[0] / norm;
    /* the first two corners are on the line; with the others they bound a band of width `reach` inside the
       half-plane */
    const double xys[] = {at_x(p, x - reach * b),       at_y(p, y + reach * a),       at_x(p, x + reach * b),
                          at_y(p, y - reach * a),       at_x(p, x + reach * (b - a)), at_y(p, y - reach * (a + b)),
                          at_x(p, x - reach * (a + b)), at_y(p, y + reach * (a - b))};
    koksma__canvas_path_inside(p->canvas, xys, 4, square(p), line_of(p->theme->wash, 0));
    koksma__canvas_path_inside(p->canvas, xys, 2, square(p), line_of(p->theme->mark, 1.2));
}

static void draw_witness(const plot *p, const koksma_witness *w)
{
    if (w->kind == KOKSMA_WITNESS_BOX && w->dim > p->axes[1]) {
        const int h = p->axes[0], v = p->axes[1];
        const koksma__box box = {at_x(p, w->lo[h]), at_y(p, w->hi[v]), (w->hi[h] - w->lo[h]) * p->side,
                                 (w->hi[v] - w->lo[v]) * p->side};
        p->canvas->draw->box(p->canvas, box, line_of(p->theme->wash, 0));
        p->canvas->draw->box(p->canvas, box, line_of(p->theme->mark, 1.2));
    } else if (w->kind == KOKSMA_WITNESS_DISK) {
        draw_disk(p, w);
    } else if (w->kind == KOKSMA_WITNESS_HALF_PLANE && w->dim == 2) {
        draw_half_plane(p, w);
    }
}

/* The colour of a value from -1 to 1: blue for -1, white for 0, orange for 1, and mixtures in between. */
static void paint(double share, unsigned char rgb[3])
{
    static const double full[2][3] = {{0.13, 0.4, 0.72}, {0.9, 0.38, 0.05}};
    for (int c = 0; c < 3; c++) {
        rgb[c] = (unsigned char)(255 * (1 + fabs(share) * (full[share > 0][c] - 1)) + 0.5);
    }
}

/* Colours the square by the local discrepancy; *scale is the largest absolute value, which has full colour. */
static koksma_status draw_local(const plot *p, const koksma_points *points, double *scale)
{
    const size_t n = (size_t)LOCAL * LOCAL;
    double *values = malloc(n * sizeof *values);
    unsigned char *rgb = malloc(3 * n);
    koksma_status status = values && rgb ? koksma_local_discrepancy_grid(points, LOCAL, values)
                                         : koksma__fail_memory(n * (3 + sizeof *values));
    *scale = 0;
    for (size_t i = 0; !status && i < n; i++) {
        *scale = fmax(*scale, fabs(values[i]));
    }
    for (size_t row = 0; !status && row < LOCAL; row++) {
        for (size_t column = 0; column < LOCAL; column++) {
            paint(*scale > 0 ? values[(LOCAL - 1 - row) * LOCAL + column] / *scale : 0,
                  rgb + 3 * (row * LOCAL + column));
        }
    }
    status = status ? status : p->canvas->draw->pixels(p->canvas, square(p), LOCAL, LOCAL, rgb);
    free(values);
    free(rgb);
    return status;
}

static koksma_status draw_points(const plot *p, const koksma_points *points, const koksma_scatter_options *options)
{
    draw_guides(p, options);
    if (options->witness) {
        draw_witness(p, options->witness);
    }
    draw_frame(p, options->warp);
    const double radius = fmax(0.6, fmin(4, 0.14 * p->side / sqrt((double)points->n)));
    for (size_t i = 0; i < points->n; i++) {
        const double *x = points->xs + i * (size_t)points->dim, in[2] = {x[p->axes[0]], x[p->axes[1]]};
        double at[2];
        position(p, options->warp, in, at);
        p->canvas->draw->circle(p->canvas, at[0], at[1], radius, line_of(p->theme->ink, 0));
        KOKSMA__TRY(koksma__look(p->run, i, 0));
    }
    return KOKSMA_OK;
}

static int dimensions(const koksma_panel *panel)
{
    const int dim = panel->points ? panel->points->dim : 2;
    return dim < KOKSMA_PLOT_MAX_DIM ? dim : KOKSMA_PLOT_MAX_DIM;
}

/* Draws the lower triangle of the scatter matrix: in row i and column j < i, coordinate i against coordinate j; the
   coordinates are named at the left and below. */
static koksma_status draw_matrix(const plot *p, const koksma_panel *panel)
{
    const int n = dimensions(panel) - 1, gap = 4;
    const double pitch = (p->side - 2 * LABEL) / n;
    for (int i = 1; i <= n; i++) {
        char name[16];
        plot q = *p;
        q.side = fmax(pitch - gap, 1);
        q.top = p->top + (i - 1) * pitch;
        koksma__snprintf(name, sizeof name, "x%d", i + 1);
        koksma__canvas_text(p->canvas, p->left + 2 * LABEL - 4, q.top + pitch / 2 + 2, LABEL, 1, name, p->theme->ink);
        for (int j = 0; j < i; j++) {
            q.axes[0] = j;
            q.axes[1] = i;
            q.left = p->left + 2 * LABEL + j * pitch;
            KOKSMA__TRY(draw_points(&q, panel->points, &panel->scatter));
        }
        koksma__snprintf(name, sizeof name, "x%d", i);
        koksma__canvas_text(p->canvas, p->left + 2 * LABEL + (i - 0.5) * pitch, p->top + p->side - 6, LABEL, 0.5,
                            name, p->theme->ink);
    }
    return KOKSMA_OK;
}

static koksma_status draw_spectrum(const plot *p, const koksma_spectrum *s, double white)
{
    const int half = s->half, side = 2 * half + 1;
    unsigned char *rgb = malloc(3 * (size_t)side * (size_t)side);
    KOKSMA__REQUIRE_MEMORY(rgb, 3 * (size_t)side * (size_t)side);
    for (int ky = -half; ky <= half; ky++) {
        for (int kx = -half; kx <= half; kx++) {
            /* at frequency 0 the power is n for every point set */
            const double power = kx || ky ? koksma_spectrum_power(s, kx, ky) : 0;
            memset(rgb + 3 * ((size_t)(half - ky) * (size_t)side + (size_t)(kx + half)),
                   (unsigned char)(255 * fmin(power / white, 1) + 0.5), 3);
        }
    }
    const koksma_status status = p->canvas->draw->pixels(p->canvas, square(p), side, side, rgb);
    free(rgb);
    p->canvas->draw->box(p->canvas, square(p), line_of(p->theme->frame, 1));
    return status;
}

/* Writes a note that explains the colours, or says which dimensions are shown; the note is empty if neither is
   needed. */
static void put_note(const koksma_panel *panel, double largest, char text[NOTE])
{
    *text = '\0';
    if (!panel->points) {
        koksma__snprintf(text, NOTE, "power: 0 is black, %g white; frequencies up to %d",
                         panel->white > 0 ? panel->white : 2, panel->spectrum->half);
    } else if (panel->scatter.local_discrepancy) {
        koksma__snprintf(text, NOTE, "local discrepancy -%.4f (blue) to %.4f (orange)", largest, largest);
    } else if (panel->points->dim > 2) {
        koksma__snprintf(text, NOTE, "%s", panel->scatter.witness ? "projections of the region" : "");
    }
    if (panel->points && panel->points->dim > KOKSMA_PLOT_MAX_DIM) {
        const size_t used = strlen(text);
        koksma__snprintf(text + used, NOTE - used, "%sthe first %d of %d dimensions", used ? "; " : "",
                         KOKSMA_PLOT_MAX_DIM, panel->points->dim);
    }
}

double koksma__panel_side(const koksma_panel *panel)
{
    return fmax(320, 110 * (dimensions(panel) - 1.0)); /* the panel may be invalid: it is checked later */
}

double koksma__panel_title(const koksma_panel *panel, double width)
{
    return koksma__lines_height(panel->title, width - 2 * (MARGIN + (panel->swatch ? SWATCH : 0)), TITLE);
}

double koksma__panel_texts(const koksma_panel *panel, double width)
{
    char note[NOTE];
    const double inner = width - 2 * MARGIN;
    put_note(panel, 0.5, note);
    const double below = koksma__lines_height(panel->caption, inner, TEXT) + koksma__lines_height(note, inner, TEXT);
    return koksma__panel_title(panel, width) + below + (below > 0 ? 2 : 0);
}

koksma_status koksma__panel_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_panel *panel,
                                 koksma__box box, double title, double side, const koksma_run *run)
{
    const double inner = box.width - 2 * MARGIN, middle = box.x + box.width / 2;
    const plot p = {canvas, theme, run, middle - side / 2 + MARGIN, box.y + title + MARGIN, side - 2 * MARGIN,
                    {0, 1}};
    koksma_status status = KOKSMA_OK;
    double largest = 0, y = box.y + title - koksma__panel_title(panel, box.width) + TITLE;
    if (panel->title) {
        const double swatch = panel->swatch ? SWATCH : 0;
        koksma__canvas_lines(canvas, middle + swatch / 2, y, inner - 2 * swatch, TITLE, 0.5, panel->title,
                             theme->ink);
        if (panel->swatch) {
            const double half = fmin(koksma__text_width(panel->title, TITLE), inner - 2 * swatch) / 2;
            canvas->draw->box(canvas, (koksma__box){middle - half - swatch / 2, y - 8, 8, 8},
                              koksma__curve_style(theme, panel->swatch - 1, 0));
        }
    }
    if (!panel->points) {
        status = draw_spectrum(&p, panel->spectrum, panel->white > 0 ? panel->white : 2);
    } else if (dimensions(panel) > 2) {
        status = draw_matrix(&p, panel);
    } else {
        status = panel->scatter.local_discrepancy ? draw_local(&p, panel->points, &largest) : KOKSMA_OK;
        status = status ? status : draw_points(&p, panel->points, &panel->scatter);
    }
    char note[NOTE];
    y = box.y + title + side + TEXT;
    koksma__canvas_lines(canvas, middle, y, inner, TEXT, 0.5, panel->caption, theme->ink);
    put_note(panel, largest, note);
    koksma__canvas_lines(canvas, middle, y + koksma__lines_height(panel->caption, inner, TEXT), inner, TEXT, 0.5,
                         note, theme->ink);
    return status;
}

koksma_status koksma__panel_check(const koksma_panel *panel)
{
    const koksma_scatter_options *o = &panel->scatter;
    if (!panel->points) {
        return panel->spectrum ? koksma__spectrum_check(panel->spectrum)
                               : koksma__fail(KOKSMA_ARGUMENT, "a panel has neither points nor a spectrum");
    }
    KOKSMA__FAIL_IF(panel->points->dim < 2, KOKSMA_DIM, "a scatter plot needs points of 2 or more dimensions");
    if (o->columns > KOKSMA_PLOT_MAX_CELLS || o->rows > KOKSMA_PLOT_MAX_CELLS) {
        return koksma__fail(KOKSMA_ARGUMENT, "a grid of %zu columns and %zu rows: each is up to %d", o->columns,
                            o->rows, KOKSMA_PLOT_MAX_CELLS);
    }
    KOKSMA__FAIL_IF(o->local_discrepancy && panel->points->dim != 2, KOKSMA_ARGUMENT,
                    "the local discrepancy can be drawn only for points of 2 dimensions");
    KOKSMA__FAIL_IF(o->local_discrepancy && o->warp, KOKSMA_ARGUMENT,
                    "the local discrepancy can be drawn only without a map");
    KOKSMA__FAIL_IF(o->warp && (!o->warp->name || !o->warp->map), KOKSMA_ARGUMENT,
                    "the warp has no %s: koksma_warp_find has warps", o->warp->name ? "map" : "name");
    KOKSMA__FAIL_IF(o->warp && panel->points->dim != 2, KOKSMA_DIM, "a map needs points of 2 dimensions, not %d",
                    panel->points->dim);
    KOKSMA__FAIL_IF(o->warp && o->witness, KOKSMA_ARGUMENT, "a witness can be drawn only without a map");
    KOKSMA__FAIL_IF(o->witness && (unsigned)o->witness->kind > KOKSMA_WITNESS_DISK, KOKSMA_ARGUMENT,
                    "%d is not a kind of witness", (int)o->witness->kind);
    for (int k = 0; o->witness && k < 2; k++) {
        KOKSMA__FAIL_IF(!(fabs(o->witness->lo[k]) <= FAR && fabs(o->witness->hi[k]) <= FAR), KOKSMA_ARGUMENT,
                        "the bounds of a witness must lie within %d of 0", FAR);
    }
    return koksma__points_check(panel->points);
}
