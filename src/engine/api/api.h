/* SPDX-License-Identifier: Apache-2.0 */
/* The checks of koksma_evaluate, and calls for the memory of NumPy arrays. */
#ifndef KOKSMA_API_API_H
#define KOKSMA_API_API_H

#include <koksma/koksma.h>

#include <stdint.h>

#include "core/visibility.h"

/* ---- Evaluate -------------------------------------------------------------------------------------------- */

/* Checks the arguments of koksma_evaluate: the spec must name a measure and have valid parameters, and the points
   must be in the unit cube in a dimension that the measure supports. `caller` is the name of the function in error
   texts. Errors: ARGUMENT, DIM. */
koksma_status koksma__evaluate_check(const char *caller, const koksma_spec *spec, const koksma_points *points);

/* ---- Array calls ----------------------------------------------------------------------------------------- */

/*
 * Functions for the Python package that work on the memory of a NumPy array. They take four plain arguments, whereas
 * the public functions take structs that Python has to build. On a busy machine each struct costs more than 10 us if
 * the previous call has filled the processor's caches with its own data.
 */

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

/* Returned for an array that is empty or is not of shape (n, dim) with aligned doubles in C's order. */
enum { KOKSMA__ARRAY_OTHER = -1 };

/* Calls koksma_evaluate for the points in an array, on `threads` threads. Returns its status or KOKSMA__ARRAY_OTHER. */
KOKSMA__LAB int koksma__evaluate_array(const koksma_spec *measure, const koksma__array *array, int threads,
                                       koksma_value *out);

/* Calls koksma_generate, which writes the points into the array. Returns its status, or KOKSMA__ARRAY_OTHER, also if
   the array is not writable. */
KOKSMA__LAB int koksma__generate_array(const koksma_spec *pattern, uint64_t seed, const koksma__array *array,
                                       int threads);

#endif
