/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Lower bounds of discrepancies, n^-power (log n)^logs. The power depends on the family of the measure, in any
 * dimension: 1 for boxes (Roth 1954, Schmidt 1972), 1/2 + 1/(2 dim) for edges and disks (Schmidt 1969, Beck and Chen
 * 1987, Alexander 1990). The table has the exponent `logs` and the author of the theorem for the measures and
 * dimensions where this exponent is known.
 */
#include "measures/shared/shared.h"

#include <math.h>
#include <string.h>

#include <koksma/series.h>

#include "core/status.h"

static const struct {
    const char *measure, *source;
    int max_dim; /* the bound holds for dimensions 2 to max_dim */
    double logs;
} bounds[] = {
    {"star", "Schmidt 1972", 2, 1},   {"l2-star", "Roth 1954", 2, 0.5},    {"extreme", "Schmidt 1972", 2, 1},
    {"edge", "Alexander 1990", 3, 0}, {"l2-edge", "Alexander 1990", 3, 0}, {"disk", "Beck 1987", 2, 0},
    {"l2-disk", "Beck 1987", 3, 0},
};

double koksma_best_rate(const koksma_measure *measure, int dim)
{
    KOKSMA__REQUIRE_OR(NAN, measure);
    switch (measure->family) {
    case KOKSMA_FAMILY_BOXES:
        return 1;
    case KOKSMA_FAMILY_EDGES:
    case KOKSMA_FAMILY_DISKS:
        return 0.5 + 0.5 / dim;
    default:
        return NAN;
    }
}

bool koksma__lower_bound(const koksma_measure *measure, int dim, koksma__bound *bound)
{
    for (size_t i = 0; i < sizeof bounds / sizeof *bounds; i++) {
        if (!strcmp(bounds[i].measure, measure->name) && dim >= 2 && dim <= bounds[i].max_dim) {
            *bound = (koksma__bound){koksma_best_rate(measure, dim), bounds[i].logs, bounds[i].source};
            return true;
        }
    }
    return false;
}
