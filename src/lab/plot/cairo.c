/* SPDX-License-Identifier: Apache-2.0 */
/* The module koksma-cairo.so: the backend that draws PDF and PNG into memory, by cairo. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cairo-pdf.h>
#include <cairo.h>

#include "modules/module_side.h"
#include "plot/plot.h"

typedef struct picture {
    koksma__canvas base;
    koksma_plot_format format;
    cairo_surface_t *surface;
    cairo_t *cairo;
    unsigned char *bytes;
    size_t size, room;
    bool failed;
} picture;

static cairo_status_t append(void *context, const unsigned char *data, unsigned int length)
{
    picture *p = context;
    if (p->size + length > p->room) {
        const size_t room = 2 * (p->size + length);
        unsigned char *bytes = realloc(p->bytes, room);
        if (!bytes) {
            p->failed = true;
            return CAIRO_STATUS_NO_MEMORY;
        }
        p->bytes = bytes;
        p->room = room;
    }
    memcpy(p->bytes + p->size, data, length);
    p->size += length;
    return CAIRO_STATUS_SUCCESS;
}

static koksma_status open_canvas(koksma_plot_format format, double width, double height, const char *title,
                                 koksma__canvas **out)
{
    picture *p = calloc(1, sizeof *p);
    if (!p) {
        return koksma__fail_memory(sizeof *p);
    }
    *out = &p->base;
    p->format = format;
    if (format == KOKSMA_PLOT_PDF) {
        p->surface = cairo_pdf_surface_create_for_stream(append, p, width, height);
        /* a fixed date, so that every run writes the same bytes */
        cairo_pdf_surface_set_metadata(p->surface, CAIRO_PDF_METADATA_CREATE_DATE, "1991-01-01T00:00:00Z");
        cairo_pdf_surface_set_metadata(p->surface, CAIRO_PDF_METADATA_TITLE, title);
    } else {
        p->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    }
    p->cairo = cairo_create(p->surface);
    cairo_select_font_face(p->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    return KOKSMA_OK;
}

static void stroke_or_fill(const picture *p, koksma__style style)
{
    const double *dashes = p->base.dashes[style.dash];
    int n = 0;
    while (dashes[n] > 0) {
        n++;
    }
    cairo_set_source_rgba(p->cairo, style.colour.r, style.colour.g, style.colour.b, style.colour.a);
    cairo_set_dash(p->cairo, dashes, n, 0);
    cairo_set_line_width(p->cairo, style.thickness);
    style.thickness > 0 ? cairo_stroke(p->cairo) : cairo_fill(p->cairo);
}

static void path(koksma__canvas *canvas, const double *xys, size_t n, koksma__style style)
{
    const picture *p = (picture *)canvas;
    for (size_t i = 0; i < n; i++) {
        cairo_line_to(p->cairo, xys[2 * i], xys[2 * i + 1]);
    }
    stroke_or_fill(p, style);
}

static void box(koksma__canvas *canvas, koksma__box b, koksma__style style)
{
    const picture *p = (picture *)canvas;
    cairo_rectangle(p->cairo, b.x, b.y, b.width, b.height);
    stroke_or_fill(p, style);
}

static void circle(koksma__canvas *canvas, double x, double y, double radius, koksma__style style)
{
    const picture *p = (picture *)canvas;
    cairo_new_sub_path(p->cairo);
    cairo_arc(p->cairo, x, y, radius, 0, 2 * M_PI);
    stroke_or_fill(p, style);
}

static koksma_status pixels(koksma__canvas *canvas, koksma__box b, int columns, int rows, const unsigned char *rgb)
{
    const picture *p = (picture *)canvas;
    cairo_surface_t *image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, columns, rows);
    unsigned char *data = cairo_image_surface_get_data(image);
    const size_t stride = (size_t)cairo_image_surface_get_stride(image);
    for (size_t row = 0; data && row < (size_t)rows; row++) {
        for (size_t column = 0; column < (size_t)columns; column++) {
            const unsigned char *from = rgb + 3 * (row * (size_t)columns + column);
            const uint32_t pixel = (uint32_t)from[0] << 16 | (uint32_t)from[1] << 8 | from[2];
            memcpy(data + row * stride + 4 * column, &pixel, sizeof pixel);
        }
    }
    cairo_surface_mark_dirty(image);
    cairo_save(p->cairo);
    cairo_translate(p->cairo, b.x, b.y);
    cairo_scale(p->cairo, b.width / columns, b.height / rows);
    cairo_set_source_surface(p->cairo, image, 0, 0);
    /* squares larger than a pixel keep sharp edges; smaller ones are averaged */
    const bool enlarged = p->format != KOKSMA_PLOT_PNG || b.width >= columns;
    cairo_pattern_set_filter(cairo_get_source(p->cairo), enlarged ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
    cairo_rectangle(p->cairo, 0, 0, columns, rows);
    cairo_fill(p->cairo);
    cairo_restore(p->cairo);
    cairo_surface_destroy(image);
    return data ? KOKSMA_OK : koksma__fail_memory(4 * (size_t)columns * (size_t)rows);
}

static void put_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                     koksma__colour colour)
{
    const picture *p = (picture *)canvas;
    cairo_text_extents_t extents;
    cairo_set_font_size(p->cairo, height);
    cairo_text_extents(p->cairo, text, &extents);
    cairo_set_source_rgba(p->cairo, colour.r, colour.g, colour.b, colour.a);
    cairo_move_to(p->cairo, x - anchor * extents.x_advance, y);
    cairo_show_text(p->cairo, text);
    cairo_new_path(p->cairo);
}

static koksma_status close_canvas(koksma__canvas *canvas, unsigned char **bytes, size_t *size)
{
    picture *p = (picture *)canvas;
    if (!bytes) { /* forgets what PDF has recorded: to write it would take longer than to draw it */
        cairo_set_operator(p->cairo, CAIRO_OPERATOR_CLEAR);
        cairo_paint(p->cairo);
    } else if (p->format == KOKSMA_PLOT_PNG) {
        cairo_surface_write_to_png_stream(p->surface, append, p);
    }
    cairo_surface_finish(p->surface);
    const bool failed = p->failed || cairo_status(p->cairo) != CAIRO_STATUS_SUCCESS ||
                        cairo_surface_status(p->surface) != CAIRO_STATUS_SUCCESS || p->size == 0;
    cairo_destroy(p->cairo);
    cairo_surface_destroy(p->surface);
    if (bytes) {
        *bytes = failed ? NULL : p->bytes;
        *size = failed ? 0 : p->size;
    }
    if (failed || !bytes) {
        free(p->bytes);
    }
    free(p);
    return failed && bytes ? koksma__fail(KOKSMA_SYSTEM, "the picture could not be drawn") : KOKSMA_OK;
}

static const char *library(void)
{
    static _Thread_local char text[32];
    snprintf(text, sizeof text, "cairo %s", cairo_version_string());
    return text;
}

static const koksma__canvas_functions functions = {open_canvas, path,     box,          circle,
                                                   pixels,      put_text, close_canvas, library};
KOKSMA__MODULE(functions)
