/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_POINTS_IO_H
#define KOKSMA_CORE_POINTS_IO_H

#include <stdio.h>

#include <koksma/koksma.h>

/* An error unless dim is a number of dimensions and n points of so many fit into one set. Errors: ARGUMENT, DIM. */
koksma_status koksma__points_fit(size_t n, int dim);

/* Readers and writers by format. `name` is what errors call the source. On failure points is left empty. */
koksma_status koksma__points_read_text(FILE *stream, const char *name, koksma_points *points);
koksma_status koksma__points_read_npy(FILE *stream, const char *name, koksma_points *points);
void koksma__points_write_text(FILE *stream, const koksma_points *points, const char *comment);
void koksma__points_write_csv(FILE *stream, const koksma_points *points);
void koksma__points_write_npy(FILE *stream, const koksma_points *points);

#endif
