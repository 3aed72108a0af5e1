/* SPDX-License-Identifier: Apache-2.0 */
/* Panels: points, projections of points or a power spectrum in a square with texts, as a part of a figure. */
#ifndef KOKSMA_PLOT_SCATTER_H
#define KOKSMA_PLOT_SCATTER_H

#include "plot/palette.h"

/* Checks a panel. Errors: those of koksma_plot_scatter. */
koksma_status koksma__panel_check(const koksma_panel *panel);

/* The default side of a panel; it grows with the number of projections. */
double koksma__panel_side(const koksma_panel *panel);

/* Return the height of the texts above the square, and of all texts, for a given width of the panel. */
double koksma__panel_title(const koksma_panel *panel, double width);
double koksma__panel_texts(const koksma_panel *panel, double width);

/* Draws a panel. title: the height reserved for the texts above the square, which is equal for all panels of a row;
   side: the width of the square and its margins. Errors: MEMORY, INTERRUPTED. */
koksma_status koksma__panel_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_panel *panel,
                                 koksma__box box, double title, double side, const koksma_run *run);

#endif
