/* SPDX-License-Identifier: Apache-2.0 */
/* Checks a pixel filter. */
#ifndef KOKSMA_RENDER_FILTER_CHECK_H
#define KOKSMA_RENDER_FILTER_CHECK_H

#include <koksma/render.h>

/* Fails unless a filter, which may be the caller's own, has a name, a function and a radius above 0 of at most
   KOKSMA__MAX_RADIUS pixels. Error: ARGUMENT. */
enum { KOKSMA__MAX_RADIUS = 64 };
koksma_status koksma__filter_check(const koksma_filter *filter);

#endif
