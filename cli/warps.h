/* SPDX-License-Identifier: Apache-2.0 */
/* --warp: maps of the square onto a domain, by name. */
#ifndef KOKSMA_CLI_WARPS_H
#define KOKSMA_CLI_WARPS_H

#include <koksma/warp.h>

#include "cli.h"

/* The warp of that name; NULL after an error that lists them. */
const koksma_warp *cli_find_warp(const cli_arguments *arguments, const char *name);

/* The points of the plane mapped by the warp, which *points becomes, with the warp's dim. */
koksma_status cli_map_points(const koksma_warp *warp, koksma_points *points);

#endif
