/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma optimise --scene`: searches for a point set that renders one scene with little error (optimise_scene.c). */
#ifndef KOKSMA_CLI_OPTIMISE_SCENE_H
#define KOKSMA_CLI_OPTIMISE_SCENE_H

#include "cli.h"

/* Runs `koksma optimise --scene SCENE`. Returns the exit code. */
int cli_optimise_scene(const cli_arguments *arguments);

#endif
