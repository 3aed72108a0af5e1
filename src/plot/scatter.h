/* SPDX-License-Identifier: Apache-2.0 */
/* Points, projections of points or a power spectrum in a square with its texts, as a part of a figure. */
#ifndef KOKSMA_PLOT_SCATTER_H
#define KOKSMA_PLOT_SCATTER_H

#include "plot/palette.h"

/* Errors: those of koksma_plot_scatter. */
koksma_status koksma__panel_check(const koksma_panel *panel);

/* The side that a panel is given unless asked: more of many projections. */
double koksma__panel_side(const koksma_panel *panel);

/* The height of the texts above, and of all texts, at a width. */
double koksma__panel_title(const koksma_panel *panel, double width);
double koksma__panel_texts(const koksma_panel *panel, double width);

/* title: the height for the texts above, the same in a row; side: of the square with its margins. Errors: MEMORY. */
koksma_status koksma__panel_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_panel *panel,
                                 koksma__box box, double title, double side);

#endif
