/* SPDX-License-Identifier: Apache-2.0 */
/* The table of pixel filters. */
#ifndef KOKSMA_RENDER_FILTERS_FILTERS_H
#define KOKSMA_RENDER_FILTERS_FILTERS_H

#include <koksma/render.h>

#define FILTER(name) extern const koksma_filter koksma__filter_##name;
#include "render/filters/filters.def"
#undef FILTER

#endif
