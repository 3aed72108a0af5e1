/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Calls on the memory of an array of another language, for the Python package: one call of a function in C with four
 * plain arguments, where the public functions take structs that Python has to build. On a busy machine each struct
 * costs more than 10 us after a call that has used the processor's caches.
 */
#ifndef KOKSMA_API_ARRAY_CALLS_H
#define KOKSMA_API_ARRAY_CALLS_H

#include <koksma/koksma.h>

#include <stdint.h>

#include "core/visibility.h"

/* An array as NumPy describes it to C: the struct PyArrayInterface of its "array interface protocol", version 3. */
typedef struct koksma__array {
    int version; /* always 2 */
    int n_axes;
    char kind; /* 'f': floating point */
    int item_size;
    int flags; /* bits below */
    const intptr_t *shape;
    const intptr_t *strides;
    void *data;
    void *unused;
} koksma__array;

enum {
    KOKSMA__ARRAY_C_ORDER = 0x1,
    KOKSMA__ARRAY_ALIGNED = 0x100,
    KOKSMA__ARRAY_NATIVE = 0x200,
    KOKSMA__ARRAY_WRITABLE = 0x400
};

/* Returned where an array is not of shape (n, dim), of aligned doubles in C's order, and not empty. */
enum { KOKSMA__ARRAY_OTHER = -1 };

/* koksma_evaluate of the points in an array, on `threads` threads. Returns a koksma_status or ARRAY_OTHER. */
KOKSMA__LAB int koksma__evaluate_array(const koksma_spec *measure, const koksma__array *array, int threads,
                                       koksma_value *out);

/* koksma_generate into an array, which has to be writable. Returns a koksma_status or ARRAY_OTHER. */
KOKSMA__LAB int koksma__generate_array(const koksma_spec *pattern, uint64_t seed, const koksma__array *array,
                                       int threads);

#endif
