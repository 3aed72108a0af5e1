/* SPDX-License-Identifier: Apache-2.0 */
/* Disks on the unit torus: what the measures over them share. */
#ifndef KOKSMA_MEASURES_PARTS_TORUS_DISKS_H
#define KOKSMA_MEASURES_PARTS_TORUS_DISKS_H

#include <koksma/koksma.h>

/* How the radius of a random disk is distributed: fixed, or uniform radius or area up to a largest radius. */
typedef enum koksma__disk_law { KOKSMA__DISK_FIXED, KOKSMA__DISK_RADIUS, KOKSMA__DISK_AREA } koksma__disk_law;

extern const char *const koksma__disk_laws[];

/* The parameters `law` and `r` of a table of parameters. */
#define KOKSMA__DISK_PARAMS                                                                                          \
    {"law", "fixed radius r, or radius or area uniform up to that of r", 0, 0, 2, koksma__disk_laws, false},         \
    {                                                                                                                \
        "r", "the radius; 0: 0.25 for a fixed one, else 0.5", 0, 0, 0.5, NULL, false                                 \
    }

/* The radius that `r` stands for. */
double koksma__disk_radius(koksma__disk_law law, double r);

/* The points by coordinate, in cells: the points of cell c are start[c] .. start[c+1]-1, cells row by row. */
typedef struct koksma__torus_cells {
    size_t n, columns; /* columns x columns cells */
    double *xs, *ys;   /* in the order of the cells; within a cell in the order of the points; 1 is written 0 */
    size_t *start;
} koksma__torus_cells;

/* Cells no smaller than side; about one point a cell at the least. Errors: MEMORY. */
koksma_status koksma__torus_cells_init(koksma__torus_cells *cells, const koksma_points *points, double side);
void koksma__torus_cells_fini(koksma__torus_cells *cells);

#endif
