/* SPDX-License-Identifier: Apache-2.0 */
#include "points.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    fuzz_points(bytes, size, koksma__points_read_text);
    return 0;
}
