/* SPDX-License-Identifier: Apache-2.0 */
/* Point files in the format NPY of NumPy. */
#ifndef KOKSMA_CORE_POINTS_NPY_H
#define KOKSMA_CORE_POINTS_NPY_H

#include "core/points_text.h"

/* Reads points. Error messages call the stream `name`. On failure points is left empty. */
koksma_status koksma__points_read_npy(FILE *stream, const char *name, koksma_points *points);

/* Writes the points that follow the header. Errors: INTERRUPTED. */
koksma_status koksma__points_put_npy(FILE *stream, const koksma_points *points, koksma__progress progress);

#endif
