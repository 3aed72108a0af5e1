/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_PLOT_SVG_H
#define KOKSMA_PLOT_SVG_H

#include "plot/backend.h"

/* The backend for SVG; it needs no outside library. */
extern const koksma__canvas_functions koksma__svg_functions;

#endif
