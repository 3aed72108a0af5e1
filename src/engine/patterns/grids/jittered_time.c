/* SPDX-License-Identifier: Apache-2.0 */
/* Jittered points in the plane, each with an independent uniform time, for the patterns poisson-time and
   scan-time. */
#include "patterns/grids/grids.h"

#include "core/random.h"

koksma_status koksma__fill_jittered_time(const char *name, uint64_t seed, const koksma_args *args, koksma_points *out)
{
    const koksma_points plane = {out->n, 2, out->xs};
    size_t columns, rows;
    koksma_status status = koksma__cells(name, &plane, args->params[0], &columns, &rows);
    status = status ? status : koksma__fill_uniform(seed, KOKSMA__PURPOSE_POINT, args->run, 3 * out->n, out->xs);
    for (size_t i = 0; i < out->n && !status; i++) {
        double *x = out->xs + 3 * i;
        x[0] = koksma__in_cell((double)(i / rows), x[0], (double)columns);
        x[1] = koksma__in_cell((double)(i % rows), x[1], (double)rows);
    }
    return status;
}
