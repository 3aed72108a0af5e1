/* SPDX-License-Identifier: Apache-2.0 */
/* Calls koksma_evaluate and koksma_generate on the memory of a NumPy array. An array with another layout than that of
   koksma_points is rejected with KOKSMA__ARRAY_OTHER; the caller then copies it into that layout. */
#include "api/array_calls.h"

#include <limits.h>

static bool points_of(const koksma__array *array, int flags, koksma_points *points)
{
    flags |= KOKSMA__ARRAY_C_ORDER | KOKSMA__ARRAY_ALIGNED | KOKSMA__ARRAY_NATIVE;
    if (array->version != 2 || array->n_axes != 2 || array->kind != 'f' || array->item_size != sizeof(double) ||
        (array->flags & flags) != flags || array->shape[0] < 1 || array->shape[1] < 1 || array->shape[1] > INT_MAX) {
        return false;
    }
    *points = (koksma_points){.n = (size_t)array->shape[0], .dim = (int)array->shape[1], .xs = array->data};
    return true;
}

int koksma__evaluate_array(const koksma_spec *measure, const koksma__array *array, int threads, koksma_value *out)
{
    koksma_points points;
    const koksma_run run = {.threads = threads};
    return points_of(array, 0, &points) ? (int)koksma_evaluate(measure, &points, &run, out) : KOKSMA__ARRAY_OTHER;
}

int koksma__generate_array(const koksma_spec *pattern, uint64_t seed, const koksma__array *array, int threads)
{
    koksma_points points;
    const koksma_run run = {.threads = threads};
    return points_of(array, KOKSMA__ARRAY_WRITABLE, &points) ? (int)koksma_generate(pattern, seed, &run, &points)
                                                             : KOKSMA__ARRAY_OTHER;
}
