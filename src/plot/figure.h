/* SPDX-License-Identifier: Apache-2.0 */
/* Sizes of pictures. */
#ifndef KOKSMA_PLOT_FIGURE_H
#define KOKSMA_PLOT_FIGURE_H

#include <koksma/plot.h>

/* The size that is asked for, or the fallback for 0. Errors: ARGUMENT, also for a format that is none. */
koksma_status koksma__figure_size(koksma_plot_format format, double asked, double fallback, double *size);

#endif
