/* SPDX-License-Identifier: Apache-2.0 */
/* The strokes of plots, passed on to the module that draws them; the first canvas loads it. */
#include "plot/canvas.h"

#include "modules/module.h"

static const koksma__module module = {"cairo", "cairo", {koksma__fail, koksma__fail_memory, NULL}};
static _Atomic(const koksma__canvas_functions *) draw; /* loaded before there is a canvas */

static koksma_status load(void)
{
    const void *functions;
    const koksma_status status = koksma__module_load(&module, &functions);
    draw = functions;
    return status;
}

const char *koksma_plot_library(void)
{
    return load() ? NULL : draw->library();
}

koksma_status koksma__canvas_open(koksma_plot_format format, double width, double height, koksma__canvas **out)
{
    const koksma_status status = load();
    *out = NULL;
    return status ? status : draw->open(format, width, height, out);
}

void koksma__canvas_clip(koksma__canvas *canvas, double x, double y, double width, double height)
{
    draw->clip(canvas, x, y, width, height);
}

void koksma__canvas_line(koksma__canvas *canvas, double x0, double y0, double x1, double y1, double thickness,
                         koksma__colour colour)
{
    draw->line(canvas, x0, y0, x1, y1, thickness, colour);
}

void koksma__canvas_box(koksma__canvas *canvas, double x, double y, double width, double height, double thickness,
                        koksma__colour colour)
{
    draw->box(canvas, x, y, width, height, thickness, colour);
}

void koksma__canvas_circle(koksma__canvas *canvas, double x, double y, double radius, double thickness,
                           koksma__colour colour)
{
    draw->circle(canvas, x, y, radius, thickness, colour);
}

void koksma__canvas_dash(koksma__canvas *canvas, koksma__dash dash, double along)
{
    draw->dash(canvas, dash, along);
}

bool koksma__canvas_pixels(koksma__canvas *canvas, double x, double y, double width, double height, int columns,
                           int rows, const unsigned char *rgb)
{
    return draw->pixels(canvas, x, y, width, height, columns, rows, rgb);
}

void koksma__canvas_text(koksma__canvas *canvas, double x, double y, double height, double anchor, const char *text,
                         koksma__colour colour)
{
    draw->text(canvas, x, y, height, anchor, text, colour);
}

koksma_status koksma__canvas_close(koksma__canvas *canvas, unsigned char **bytes, size_t *size)
{
    return draw->close(canvas, bytes, size);
}
