/* SPDX-License-Identifier: Apache-2.0 */
/* The option --warp of measure, generate and plot: finds a map by its name, and maps sets of points. */
#include "warps.h"

#include <stdio.h>
#include <string.h>

const koksma_warp *cli_find_warp(const cli_arguments *arguments, const char *name)
{
    const koksma_warp *warp = koksma_warp_find(name);
    if (!warp) {
        char names[512] = "";
        for (size_t i = 0; koksma_warp_at(i); i++) {
            const size_t used = strlen(names);
            snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "", koksma_warp_at(i)->name);
        }
        char meant[96];
        cli_usage_error(arguments, "--warp %s: %sit takes %s", name, cli_meant_of(name, names, meant), names);
    }
    return warp;
}

koksma_status cli_map_points(const koksma_warp *warp, koksma_points *points)
{
    koksma_points mapped;
    const koksma_status status = koksma_warp_points(warp, points, &mapped);
    if (!status) {
        koksma_points_fini(points);
        *points = mapped;
    }
    return status;
}
