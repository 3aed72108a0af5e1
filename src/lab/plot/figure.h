/* SPDX-License-Identifier: Apache-2.0 */
/* The sizes of pictures. */
#ifndef KOKSMA_PLOT_FIGURE_H
#define KOKSMA_PLOT_FIGURE_H

#include <koksma/plot.h>

/* Sets *size to the requested width or height, or to the fallback if the request is 0. Errors: ARGUMENT, also for an
   unknown format. */
koksma_status koksma__figure_size(koksma_plot_format format, double asked, double fallback, double *size);

#endif
