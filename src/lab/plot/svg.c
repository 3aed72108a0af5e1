/* SPDX-License-Identifier: Apache-2.0 */
/*
 * The SVG backend: shapes become elements such as <rect> and <circle>, texts become <text>, which can be searched and
 * edited, and images become PNG. Successive shapes of one style share a <g>. Elements have no ids, so that several
 * pictures can be put into one page. Nothing is kept between canvases, so that equal drawings give equal bytes.
 */
#include "plot/plot.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>

#include "core/c_locale.h"
#include "core/capacity.h"
#include "core/elementary.h"
#include "core/status.h"

enum { STYLE = 160 };

typedef struct svg {
    koksma__canvas base;
    char *text;
    size_t size, capacity;
    char style[STYLE]; /* style of the open <g>; "": none is open */
    bool failed;
} svg;

static void put_bytes(svg *s, const char *bytes, size_t size)
{
    s->failed = s->failed || koksma__reserve(&s->text, &s->capacity, s->size + size, 1);
    if (s->failed) {
        return;
    }
    memcpy(s->text + s->size, bytes, size);
    s->size += size;
}

static void put(svg *s, const char *text)
{
    put_bytes(s, text, strlen(text));
}

/* Writes a value rounded to a hundredth, without zeros at the end. */
static void put_number(svg *s, double value)
{
    char text[48];
    koksma__snprintf(text, sizeof text, "%.2f", value);
    char *end = text + strlen(text);
    while (end[-1] == '0') {
        *--end = '\0';
    }
    end[-1] = end[-1] == '.' ? '\0' : end[-1];
    put(s, strcmp(text, "-0") ? text : "0");
}

/* Writes a text with the next of the values, which are doubles, in place of each '#'. */
static void put_values(svg *s, const char *text, ...)
{
    va_list values;
    va_start(values, text);
    for (const char *at = text; *at; at += *at == '#') {
        const size_t plain = strcspn(at, "#");
        put_bytes(s, at, plain);
        at += plain;
        if (*at) {
            put_number(s, va_arg(values, double));
        }
    }
    va_end(values);
}

static void put_escaped(svg *s, const char *text)
{
    for (; *text; text++) {
        *text == '&' ? put(s, "&amp;") : *text == '<' ? put(s, "&lt;") : put_bytes(s, text, 1);
    }
}

/* Begins the <g> of a style, unless it is open already. */
static void begin_group(svg *s, const char *style)
{
    if (strcmp(s->style, style) != 0) {
        put(s, *s->style ? "</g>\n" : "");
        snprintf(s->style, sizeof s->style, "%s", style);
        put(s, *style ? "<g" : "");
        put(s, style);
        put(s, *style ? ">\n" : "");
    }
}

/* Writes fill="#rrggbb" (or another name), and the opacity if it is below 1. */
static int colour_text(char *text, size_t size, const char *what, koksma__colour c)
{
    const int n = snprintf(text, size, " %s=\"#%02x%02x%02x\"", what, (int)(255 * c.r + 0.5), (int)(255 * c.g + 0.5),
                           (int)(255 * c.b + 0.5));
    return n + (c.a < 1 ? koksma__snprintf(text + n, size - (size_t)n, " %s-opacity=\"%.3g\"", what, c.a) : 0);
}

static void begin_shapes(svg *s, koksma__style style)
{
    char text[STYLE];
    const bool filled = !(style.thickness > 0);
    int n = colour_text(text, sizeof text, filled ? "fill" : "stroke", style.colour);
    if (!filled) {
        n += koksma__snprintf(text + n, sizeof text - (size_t)n, " fill=\"none\" stroke-width=\"%.3g\"",
                              style.thickness);
    }
    const double *dashes = s->base.dashes[style.dash];
    for (int i = 0; !filled && dashes[i] > 0; i++) {
        n += koksma__snprintf(text + n, sizeof text - (size_t)n, "%s%g%s", i ? " " : " stroke-dasharray=\"",
                              dashes[i], dashes[i + 1] > 0 ? "" : "\"");
    }
    begin_group(s, text);
}

static koksma_status open_svg(koksma_plot_format format, double width, double height, const char *title,
                              koksma__canvas **out)
{
    (void)format;
    svg *s = calloc(1, sizeof *s);
    KOKSMA__REQUIRE_MEMORY(s, sizeof *s);
    put_values(s,
               "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"#\" "
               "height=\"#\" viewBox=\"0 0 # #\" role=\"img\" font-family=\"Helvetica, Arial, sans-serif\">\n<title>",
               width, height, width, height);
    put_escaped(s, title);
    put(s, "</title>\n");
    *out = &s->base;
    return KOKSMA_OK;
}

static void path(koksma__canvas *canvas, const double *xys, size_t n, koksma__style style)
{
    svg *s = (svg *)canvas;
    begin_shapes(s, style);
    put(s, style.thickness > 0 ? "<polyline points=\"" : "<polygon points=\"");
    for (size_t i = 0; i < n; i++) {
        put_values(s, i ? " #,#" : "#,#", xys[2 * i], xys[2 * i + 1]);
    }
    put(s, "\"/>\n");
}

static void box(koksma__canvas *canvas, koksma__box b, koksma__style style)
{
    svg *s = (svg *)canvas;
    begin_shapes(s, style);
    put_values(s, "<rect x=\"#\" y=\"#\" width=\"#\" height=\"#\"/>\n", b.x, b.y, b.width, b.height);
}

static void circle(koksma__canvas *canvas, double x, double y, double radius, koksma__style style)
{
    svg *s = (svg *)canvas;
    begin_shapes(s, style);
    put_values(s, "<circle cx=\"#\" cy=\"#\" r=\"#\"/>\n", x, y, radius);
}

static void put_base64(svg *s, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        const size_t left = size - i;
        const unsigned bits =
            (unsigned)bytes[i] << 16 | (left > 1 ? (unsigned)bytes[i + 1] << 8 : 0) | (left > 2 ? bytes[i + 2] : 0);
        const char four[4] = {digits[bits >> 18], digits[bits >> 12 & 63], left > 1 ? digits[bits >> 6 & 63] : '=',
                              left > 2 ? digits[bits & 63] : '='};
        put_bytes(s, four, 4);
    }
}

/* Writes an image given as sRGB levels: converts them to linear values, which the PNG writer converts back to the
   same levels. */
static koksma_status pixels(koksma__canvas *canvas, koksma__box b, int columns, int rows, const unsigned char *rgb)
{
    svg *s = (svg *)canvas;
    const size_t n = (size_t)columns * (size_t)rows;
    unsigned char *png = NULL;
    size_t size = 0;
    koksma_image image;
    bool grey = true;
    for (size_t i = 0; i < n && grey; i++) {
        grey = rgb[3 * i] == rgb[3 * i + 1] && rgb[3 * i] == rgb[3 * i + 2];
    }
    koksma_status status = koksma_image_init(&image, columns, rows, grey ? 1 : 3);
    for (size_t i = 0; i < (grey ? n : 3 * n) && !status; i++) {
        const double level = rgb[grey ? 3 * i : i] / 255.0;
        image.pixels[i] = (float)(level <= 0.04045 ? level / 12.92 : koksma__pow((level + 0.055) / 1.055, 2.4));
    }
    status = status ? status : koksma_image_png_bytes(&image, &png, &size);
    koksma_image_fini(&image);
    if (!status) {
        begin_group(s, "");
        put_values(s,
                   "<image x=\"#\" y=\"#\" width=\"#\" height=\"#\" preserveAspectRatio=\"none\" "
                   "style=\"image-rendering:pixelated\" href=\"data:image/png;base64,",
                   b.x, b.y, b.width, b.height);
        put_base64(s, png, size);
        put(s, "\"/>\n");
    }
    free(png);
    return status;
}

static void put_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                     koksma__colour colour)
{
    static const char *const anchors[] = {"", " text-anchor=\"middle\"", " text-anchor=\"end\""};
    char style[STYLE];
    svg *s = (svg *)canvas;
    const int n = colour_text(style, sizeof style, "fill", colour);
    koksma__snprintf(style + n, sizeof style - (size_t)n, " font-size=\"%g\"%s", height,
                     anchors[(int)(2 * anchor + 0.5)]);
    begin_group(s, style);
    put_values(s, "<text x=\"#\" y=\"#\">", x, y);
    put_escaped(s, text);
    put(s, "</text>\n");
}

static koksma_status close_svg(koksma__canvas *canvas, unsigned char **bytes, size_t *size)
{
    svg *s = (svg *)canvas;
    begin_group(s, "");
    put(s, "</svg>\n");
    const bool failed = s->failed;
    if (bytes) {
        *bytes = failed ? NULL : (unsigned char *)s->text;
        *size = failed ? 0 : s->size;
    }
    if (failed || !bytes) {
        free(s->text);
    }
    free(s);
    return failed && bytes ? koksma__fail_memory(2 * *size) : KOKSMA_OK;
}

const koksma__canvas_functions koksma__svg_functions = {open_svg, path,     box,       circle,
                                                        pixels,   put_text, close_svg, NULL};
