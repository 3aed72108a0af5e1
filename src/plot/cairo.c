/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The canvas of plots and charts, by cairo: an SVG, a PDF or a PNG in memory. The twin at the end is for builds
 * without cairo, whose functions return UNSUPPORTED.
 */
#ifdef KOKSMA_CAIRO
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include "core/status.h"
#include "plot/canvas.h"

struct koksma__canvas {
    koksma_plot_format format;
    cairo_surface_t *surface;
    cairo_t *cairo;
    unsigned char *bytes;
    size_t size, room;
    bool failed;
};

static cairo_status_t append(void *context, const unsigned char *data, unsigned int length)
{
    koksma__canvas *canvas = context;
    if (canvas->size + length > canvas->room) {
        const size_t room = 2 * (canvas->size + length);
        unsigned char *bytes = realloc(canvas->bytes, room);
        if (!bytes) {
            canvas->failed = true;
            return CAIRO_STATUS_NO_MEMORY;
        }
        canvas->bytes = bytes;
        canvas->room = room;
    }
    memcpy(canvas->bytes + canvas->size, data, length);
    canvas->size += length;
    return CAIRO_STATUS_SUCCESS;
}

koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, koksma__canvas **out)
{
    koksma__canvas *canvas = *out = calloc(1, sizeof *canvas);
    if (!canvas) {
        return koksma__fail_memory(sizeof *canvas);
    }
    canvas->format = format;
    if (format == KOKSMA_PLOT_SVG) {
        canvas->surface = cairo_svg_surface_create_for_stream(append, canvas, width, height);
    } else if (format == KOKSMA_PLOT_PDF) {
        canvas->surface = cairo_pdf_surface_create_for_stream(append, canvas, width, height);
        /* The same bytes on every run. */
        cairo_pdf_surface_set_metadata(canvas->surface, CAIRO_PDF_METADATA_CREATE_DATE, "1991-01-01T00:00:00Z");
    } else {
        canvas->surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, (int)width, (int)height);
    }
    canvas->cairo = cairo_create(canvas->surface);
    cairo_set_source_rgb(canvas->cairo, 1, 1, 1);
    cairo_paint(canvas->cairo);
    return KOKSMA_OK;
}

static void stroke_or_fill(koksma__canvas *canvas, double thickness, koksma__colour colour)
{
    cairo_set_source_rgba(canvas->cairo, colour.r, colour.g, colour.b, colour.a);
    if (thickness > 0) {
        cairo_set_line_width(canvas->cairo, thickness);
        cairo_stroke(canvas->cairo);
    } else {
        cairo_fill(canvas->cairo);
    }
}

void koksma__canvas_clip(koksma__canvas *canvas, double x, double y, double width, double height)
{
    cairo_reset_clip(canvas->cairo);
    cairo_rectangle(canvas->cairo, x, y, width, height);
    cairo_clip(canvas->cairo);
}

void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, double thickness,
                         koksma__colour colour)
{
    cairo_move_to(canvas->cairo, x0, y0);
    cairo_line_to(canvas->cairo, x1, y1);
    stroke_or_fill(canvas, thickness, colour);
}

void koksma__canvas_box(koksma__canvas *canvas, double x, double y, double width, double height, double thickness,
                        koksma__colour colour)
{
    cairo_rectangle(canvas->cairo, x, y, width, height);
    stroke_or_fill(canvas, thickness, colour);
}

void koksma__canvas_circle(koksma__canvas *canvas, double x, double y, double radius, double thickness,
                           koksma__colour colour)
{
    cairo_new_sub_path(canvas->cairo);
    cairo_arc(canvas->cairo, x, y, radius, 0, 2 * M_PI);
    stroke_or_fill(canvas, thickness, colour);
}

void koksma__canvas_dash(koksma__canvas *canvas, koksma__dash dash, double along)
{
    static const double dashes[][2] = {{0, 0}, {9, 3}, {2, 2}, {4, 3}};
    cairo_set_dash(canvas->cairo, dashes[dash], dash == KOKSMA__DASH_WHOLE ? 0 : 2, along);
}

bool koksma__canvas_pixels(koksma__canvas *canvas, double x, double y, double width, double height, int columns,
                           int rows, const unsigned char *rgb)
{
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
    cairo_save(canvas->cairo);
    cairo_translate(canvas->cairo, x, y);
    cairo_scale(canvas->cairo, width / columns, height / rows);
    cairo_set_source_surface(canvas->cairo, image, 0, 0);
    /* Enlarged squares keep sharp edges; where there are more squares than pixels, they are averaged. */
    const bool enlarged = canvas->format != KOKSMA_PLOT_PNG || width >= columns;
    cairo_pattern_set_filter(cairo_get_source(canvas->cairo), enlarged ? CAIRO_FILTER_NEAREST : CAIRO_FILTER_GOOD);
    cairo_rectangle(canvas->cairo, 0, 0, columns, rows);
    cairo_fill(canvas->cairo);
    cairo_restore(canvas->cairo);
    cairo_surface_destroy(image);
    return data != NULL;
}

/* Of the character that begins here, in bytes; 0: no UTF-8. */
static size_t utf8_length(const unsigned char *s)
{
    const size_t length = s[0] < 0x80 ? 1 : s[0] < 0xc2 ? 0 : s[0] < 0xe0 ? 2 : s[0] < 0xf0 ? 3 : s[0] < 0xf5 ? 4 : 0;
    for (size_t i = 1; i < length; i++) {
        if ((s[i] & 0xc0) != 0x80) {
            return 0;
        }
    }
    const bool wrong = (s[0] == 0xe0 && s[1] < 0xa0) || (s[0] == 0xed && s[1] > 0x9f) || /* long, or half a pair */
                       (s[0] == 0xf0 && s[1] < 0x90) || (s[0] == 0xf4 && s[1] > 0x8f);
    return wrong ? 0 : length;
}

/* A text that Cairo takes: bytes that are no UTF-8, as a file's name may have, are '?'. */
static char *as_utf8(const char *text)
{
    char *out = strdup(text);
    for (size_t i = 0; out && out[i];) {
        const size_t length = utf8_length((const unsigned char *)out + i);
        out[i] = length ? out[i] : '?';
        i += length ? length : 1;
    }
    return out;
}

void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour)
{
    cairo_text_extents_t extents;
    char *shown = as_utf8(text);
    if (!shown) {
        canvas->failed = true;
        return;
    }
    cairo_select_font_face(canvas->cairo, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
    cairo_set_font_size(canvas->cairo, height);
    cairo_text_extents(canvas->cairo, shown, &extents);
    cairo_set_source_rgba(canvas->cairo, colour.r, colour.g, colour.b, colour.a);
    cairo_move_to(canvas->cairo, x - anchor * extents.x_advance, y);
    cairo_show_text(canvas->cairo, shown);
    cairo_new_path(canvas->cairo);
    free(shown);
}

koksma_status koksma__canvas_close(koksma__canvas *canvas, unsigned char **bytes, size_t *size)
{
    if (canvas->format == KOKSMA_PLOT_PNG) {
        cairo_surface_write_to_png_stream(canvas->surface, append, canvas);
    }
    cairo_surface_finish(canvas->surface);
    const bool failed = canvas->failed || cairo_status(canvas->cairo) != CAIRO_STATUS_SUCCESS ||
                        cairo_surface_status(canvas->surface) != CAIRO_STATUS_SUCCESS || canvas->size == 0;
    cairo_destroy(canvas->cairo);
    cairo_surface_destroy(canvas->surface);
    *bytes = failed ? NULL : canvas->bytes;
    *size = failed ? 0 : canvas->size;
    if (failed) {
        free(canvas->bytes);
    }
    free(canvas);
    return failed ? koksma__fail(KOKSMA_SYSTEM, "the picture could not be drawn") : KOKSMA_OK;
}

const char *koksma_plot_library(void)
{
    static _Thread_local char text[32];
    snprintf(text, sizeof text, "cairo %s", cairo_version_string());
    return text;
}

#else

#include "core/status.h"
#include "plot/canvas.h"

const char *koksma_plot_library(void)
{
    return NULL;
}

koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, koksma__canvas **out)
{
    (void)format, (void)width, (void)height;
    *out = NULL;
    return koksma__fail(KOKSMA_UNSUPPORTED, "this build has no cairo: it can't plot");
}

/* Without a canvas none of these is reached. */
void koksma__canvas_clip(koksma__canvas *canvas, double x, double y, double width, double height)
{
    (void)canvas, (void)x, (void)y, (void)width, (void)height;
}

void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, double thickness,
                         koksma__colour colour)
{
    (void)canvas, (void)x0, (void)y0, (void)x1, (void)y1, (void)thickness, (void)colour;
}

void koksma__canvas_box(koksma__canvas *canvas, double x, double y, double width, double height, double thickness,
                        koksma__colour colour)
{
    (void)canvas, (void)x, (void)y, (void)width, (void)height, (void)thickness, (void)colour;
}

void koksma__canvas_circle(koksma__canvas *canvas, double x, double y, double radius, double thickness,
                           koksma__colour colour)
{
    (void)canvas, (void)x, (void)y, (void)radius, (void)thickness, (void)colour;
}

void koksma__canvas_dash(koksma__canvas *canvas, koksma__dash dash, double along)
{
    (void)canvas, (void)dash, (void)along;
}

bool koksma__canvas_pixels(koksma__canvas *canvas, double x, double y, double width, double height, int columns,
                           int rows, const unsigned char *rgb)
{
    (void)canvas, (void)x, (void)y, (void)width, (void)height, (void)columns, (void)rows, (void)rgb;
    return false;
}

void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour)
{
    (void)canvas, (void)x, (void)y, (void)height, (void)anchor, (void)text, (void)colour;
}

koksma_status koksma__canvas_close(koksma__canvas *canvas, unsigned char **bytes, size_t *size)
{
    (void)canvas, (void)bytes, (void)size;
    return koksma__fail(KOKSMA_UNSUPPORTED, "this build has no cairo: it can't plot");
}

#endif
