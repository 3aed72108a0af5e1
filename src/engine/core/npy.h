/* SPDX-License-Identifier: Apache-2.0 */
/* The only writer of NumPy's .npy format: the header, and numbers as little-endian bytes on any machine. */
#ifndef KOKSMA_CORE_NPY_H
#define KOKSMA_CORE_NPY_H

#include <stdint.h>
#include <stdio.h>

#include "core/visibility.h"

enum { KOKSMA__NPY_HEADER = 1024 }; /* longest dictionary */

/* Writes the header (version 1.0) of an array in C order: descr and shape are Python literals, such as "'<f8'" and
   "(10, 2)". Together these two texts may have at most KOKSMA__NPY_HEADER - 64 characters. */
KOKSMA__LAB void koksma__npy_put_header(FILE *stream, const char *descr, const char *shape);

/* Stores a 64-bit word in 8 bytes, lowest byte first. */
static inline void koksma__npy_set_word(unsigned char bytes[8], uint64_t word)
{
    for (int i = 0; i < 8; i++) {
        bytes[i] = (unsigned char)(word >> (8 * i));
    }
}

/* Writes count doubles. */
void koksma__npy_put_doubles(FILE *stream, const double *xs, size_t count);

#endif
