/* SPDX-License-Identifier: Apache-2.0 */
/* Charts: curves on a pair of axes, as a part of a figure. */
#ifndef KOKSMA_PLOT_CHART_H
#define KOKSMA_PLOT_CHART_H

#include "plot/palette.h"

/* Checks a chart. Errors: ARGUMENT (invalid arrays, or nothing to draw). */
koksma_status koksma__chart_check(const koksma_chart *chart);

/* The total height of the texts above and below the axes, for a given width. */
double koksma__chart_texts(const koksma_chart *chart, double width);

/* Errors: MEMORY. */
koksma_status koksma__chart_draw(koksma__canvas *canvas, const koksma__theme *theme, const koksma_chart *chart,
                                 koksma__box box);

#endif
