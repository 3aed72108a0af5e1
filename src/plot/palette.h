/* SPDX-License-Identifier: Apache-2.0 */
/* Colours and dashes of plots, on light and on dark paper. */
#ifndef KOKSMA_PLOT_PALETTE_H
#define KOKSMA_PLOT_PALETTE_H

#include "plot/canvas.h"

typedef struct koksma__theme {
    koksma__colour paper, ink, frame, grid, guide, cell, mark, wash;
    bool dark;
} koksma__theme;

const koksma__theme *koksma__theme_of(bool dark);

enum {
    KOKSMA__COLOURS = 0
#define COLOUR(light, dark, patterns) +1
#include "plot/palette.def"
#undef COLOUR
    ,
    KOKSMA__CURVE_STYLES = KOKSMA__COLOURS * KOKSMA__DASH_GUIDE
};

/* The number of the curve of a pattern's spec or of another text in one picture, and takes it: colour + KOKSMA__COLOURS
   dash. taken: KOKSMA__CURVE_STYLES flags. What is no pattern gets the first free number. KOKSMA__CURVE_STYLES: none is. */
size_t koksma__take_curve_number(const char *spec, bool *taken);

/* How curve `number` is drawn (koksma_curve): colours first, then dashes, and shapes of marks with them. */
koksma__style koksma__curve_style(const koksma__theme *theme, size_t number, double thickness);

#endif
