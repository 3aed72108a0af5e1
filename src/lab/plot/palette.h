/* SPDX-License-Identifier: Apache-2.0 */
/* Colours and dashes of plots, for light and for dark paper. */
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

/* Returns the colour of the family of the pattern whose spec this is, or KOKSMA__COLOURS if the text names no
   pattern. */
size_t koksma__colour_of(const char *spec);

/* Chooses the style number, colour + KOKSMA__COLOURS * dash, of a curve in one picture, and marks it in `taken`,
   which has KOKSMA__CURVE_STYLES flags. The spec of a pattern gets the colour of its family with the first free dash;
   a text that names no pattern gets the first free number. Returns KOKSMA__CURVE_STYLES if no number is free. */
size_t koksma__take_curve_number(const char *spec, bool *taken);

/* The style of curve `number` (koksma_curve): successive numbers vary the colour first, then the dash. */
koksma__style koksma__curve_style(const koksma__theme *theme, size_t number, double thickness);

#endif
