/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_FUZZ_POINTS_H
#define KOKSMA_FUZZ_POINTS_H

#include <stdio.h>

#include "target.h"

/* One of the readers of points, over bytes: what it takes lies in [0, 1]. */
static inline void fuzz_points(const uint8_t *bytes, size_t size,
                               koksma_status (*read)(FILE *, const char *, bool, koksma_points *))
{
    koksma_points points = {0};
    FILE *stream = size ? fmemopen((void *)(uintptr_t)bytes, size, "rb") : NULL;
    if (!stream) {
        return;
    }
    const koksma_status status = read(stream, "fuzz", false, &points);
    fuzz_check_status(status);
    for (size_t i = 0; !status && i < points.n * (size_t)points.dim; i++) {
        if (!(points.xs[i] >= 0 && points.xs[i] <= 1)) {
            abort();
        }
    }
    koksma_points_fini(&points);
    fclose(stream);
}

#endif
