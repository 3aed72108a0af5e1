/* SPDX-License-Identifier: Apache-2.0 */
/* The option --warp: finds a map of the unit square by its name, and maps points. */
#ifndef KOKSMA_CLI_WARPS_H
#define KOKSMA_CLI_WARPS_H

#include <koksma/warp.h>

#include "cli.h"

/* Returns the warp of that name, or NULL after an error that lists all names. */
const koksma_warp *cli_find_warp(const cli_arguments *arguments, const char *name);

/* Maps 2-dimensional points by the warp. *points becomes the set of mapped points, of the warp's dimension. */
koksma_status cli_map_points(const koksma_warp *warp, koksma_points *points);

#endif
