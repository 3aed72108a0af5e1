/* SPDX-License-Identifier: Apache-2.0 */
/* Fuzzes the reader of points in text files: any bytes give points or an error. */
#include "core/point_files.h"
#include "points.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    fuzz_points(bytes, size, koksma__points_read_text);
    return 0;
}
