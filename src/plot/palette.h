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

/* How curve `number` is drawn (koksma_curve): colours first, then dashes, and shapes of marks with them. */
koksma__style koksma__series_style(const koksma__theme *theme, size_t number, double thickness);

#endif
