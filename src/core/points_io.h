/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_POINTS_IO_H
#define KOKSMA_CORE_POINTS_IO_H

#include <stdio.h>

#include <koksma/koksma.h>

#include "core/read_file.h"
#include "core/visibility.h"

/* An error unless dim is a number of dimensions and n points of so many fit into one set. Errors: ARGUMENT, DIM. */
koksma_status koksma__points_fit(size_t n, int dim);

/* An error unless there are points, they fit, and each coordinate is in [0,1] (NaN is not): what every public
   function that takes points and has no other rule asks first. Errors: ARGUMENT, DIM. */
KOKSMA__LAB koksma_status koksma__points_check(const koksma_points *points);

/* koksma_points_read, and who named the file. */
koksma_status koksma__points_read(const char *path, koksma__named by, koksma_points *points);

/* Readers and writers by format. `name` is what errors call the source. On failure points is left empty. Writers
   accept any numbers. They stop when run's progress function asks for it (INTERRUPTED), or when writing fails, which
   closing the stream reports. koksma__numbers_write is koksma_points_write without the check for points outside
   [0,1]. */
koksma_status koksma__points_read_text(FILE *stream, const char *name, koksma_points *points);
koksma_status koksma__points_read_npy(FILE *stream, const char *name, koksma_points *points);
koksma_status koksma__numbers_write(const char *path, const koksma_points *rows, const char *comment,
                                    const koksma_run *run);
koksma_status koksma__points_write_text(FILE *stream, const koksma_points *points, const char *comment,
                                        const koksma_run *run);
koksma_status koksma__points_write_csv(FILE *stream, const koksma_points *points, const koksma_run *run);
koksma_status koksma__points_write_npy(FILE *stream, const koksma_points *points, const koksma_run *run);

#endif
