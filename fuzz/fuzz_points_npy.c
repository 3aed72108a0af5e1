/* SPDX-License-Identifier: Apache-2.0 */
#include <stdio.h>

#include "core/points_io.h"
#include "target.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    koksma_points points = {0};
    FILE *stream = size ? fmemopen((void *)(uintptr_t)bytes, size, "rb") : NULL;
    if (!stream) {
        return 0;
    }
    const koksma_status status = koksma__points_read_npy(stream, "fuzz", &points);
    fuzz_check_status(status);
    for (size_t i = 0; !status && i < points.n * (size_t)points.dim; i++) {
        if (!(points.xs[i] >= 0 && points.xs[i] <= 1)) {
            abort();
        }
    }
    koksma_points_fini(&points);
    fclose(stream);
    return 0;
}
