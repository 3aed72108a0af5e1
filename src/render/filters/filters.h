/* SPDX-License-Identifier: Apache-2.0 */
/* The table of pixel filters. */
#ifndef KOKSMA_RENDER_FILTERS_FILTERS_H
#define KOKSMA_RENDER_FILTERS_FILTERS_H

#include <koksma/render.h>

#define FILTER(name) extern const koksma_filter koksma__filter_##name;
#include "render/filters/filters.def"
#undef FILTER

/* Fails unless a filter, which may be the caller's own, has a name, a function and a radius above 0 of at most
   KOKSMA__MAX_RADIUS pixels. Error: ARGUMENT. */
enum { KOKSMA__MAX_RADIUS = 64 };
koksma_status koksma__filter_check(const koksma_filter *filter);

#endif
