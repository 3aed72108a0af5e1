/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CLI_OPTIMISE_SCENE_H
#define KOKSMA_CLI_OPTIMISE_SCENE_H

#include "cli.h"

/* `koksma optimise --scene SCENE`. Returns the exit code. */
int cli_optimise_scene(const cli_arguments *arguments);

#endif
