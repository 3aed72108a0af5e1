/* SPDX-License-Identifier: Apache-2.0 */
/* Texts made of tables. */
#ifndef KOKSMA_CLI_TEXTS_H
#define KOKSMA_CLI_TEXTS_H

#include "cli.h"

/* Command i of the table with the placeholders of its texts replaced; texts.c lists them. The same pointer each time.
 */
const cli_command *cli_expand(const cli_command *command, size_t i);

/* The endings of image files with `comma` between and `last` before the last one, as ".exr, .png, .pfm or .jpg". Returns text. */
const char *cli_image_formats(const char *comma, const char *last, char *text, size_t size);

/* What `koksma list` lists (command_list.c), with `comma` between. Returns text. */
const char *cli_list_names(const char *comma, char *text, size_t size);

#endif
