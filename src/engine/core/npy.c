/* SPDX-License-Identifier: Apache-2.0 */
/* A .npy file is the magic bytes, the version, the length of a Python dictionary, the dictionary padded with spaces
   so that the data begin at a multiple of 64 bytes, and the data
   (https://numpy.org/doc/stable/reference/generated/numpy.lib.format.html). */
#include "core/npy.h"

#include <stdbool.h>
#include <string.h>

enum { AT_ONCE = 2048 };

void koksma__npy_put_header(FILE *stream, const char *descr, const char *shape)
{
    char header[KOKSMA__NPY_HEADER];
    const int size =
        snprintf(header, sizeof header, "{'descr': %s, 'fortran_order': False, 'shape': %s, }", descr, shape);
    const int total = (10 + size + 1 + 63) / 64 * 64, length = total - 10;
    fprintf(stream, "%cNUMPY%c%c%c%c", 0x93, 1, 0, length & 255, length >> 8);
    fprintf(stream, "%-*s\n", length - 1, header);
}

/* Returns whether a double's lowest byte comes first in memory, so that doubles can be written without conversion. */
static bool is_little_endian(void)
{
    const double one = 1;
    unsigned char bytes[sizeof one];
    memcpy(bytes, &one, sizeof one);
    return bytes[7] == 0x3f;
}

void koksma__npy_put_doubles(FILE *stream, const double *xs, size_t count)
{
    if (is_little_endian()) {
        fwrite(xs, sizeof *xs, count, stream);
        return;
    }
    for (size_t i = 0; i < count && !ferror(stream); i += AT_ONCE) {
        unsigned char bytes[8 * AT_ONCE];
        const size_t n = count - i < AT_ONCE ? count - i : AT_ONCE;
        for (size_t j = 0; j < n; j++) {
            uint64_t bits;
            memcpy(&bits, &xs[i + j], sizeof bits);
            koksma__npy_set_word(bytes + 8 * j, bits);
        }
        fwrite(bytes, 8, n, stream);
    }
}
