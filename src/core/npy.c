/* SPDX-License-Identifier: Apache-2.0 */
/* A .npy file is the magic bytes, the version, the length of a Python dictionary, the dictionary padded with spaces
   so that the data begin at a multiple of 64 bytes, and the data
   (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html). */
#include "core/npy.h"

void koksma__npy_put_header(FILE *stream, const char *descr, const char *shape)
{
    char header[KOKSMA__NPY_HEADER];
    const int size =
        snprintf(header, sizeof header, "{'descr': %s, 'fortran_order': False, 'shape': %s, }", descr, shape);
    const int total = (10 + size + 1 + 63) / 64 * 64, length = total - 10;
    fprintf(stream, "%cNUMPY%c%c%c%c", 0x93, 1, 0, length & 255, length >> 8);
    fprintf(stream, "%-*s\n", length - 1, header);
}
