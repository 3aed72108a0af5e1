/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma optimise --scene`: a point set for the error of one scene's image (optimise_scene.c). */
#ifndef KOKSMA_CLI_OPTIMISE_SCENE_H
#define KOKSMA_CLI_OPTIMISE_SCENE_H

#include "cli.h"

/* Runs `koksma optimise --scene SCENE`. Returns the exit code. */
int cli_optimise_scene(const cli_arguments *arguments);

#endif
