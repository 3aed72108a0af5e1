/* SPDX-License-Identifier: Apache-2.0 */
/* Puts the names of table members into help texts. */
#ifndef KOKSMA_CLI_TEXTS_H
#define KOKSMA_CLI_TEXTS_H

#include "cli.h"

/* Returns `command`, which is command i of the table, with the placeholders in its texts replaced; texts.c lists the
   placeholders. Later calls for the same i return the same pointer. */
const cli_command *cli_expand(const cli_command *command, size_t i);

/* Writes the endings of image files to `text` and returns it, such as ".exr, .png, .pfm or .jpg". `comma` is put
   between the endings, and `last` before the last one. */
const char *cli_image_formats(const char *comma, const char *last, char *text, size_t size);

/* Writes the names of the tables that `koksma list` prints (command_list.c) to `text`, with `comma` between them, and
   returns `text`. */
const char *cli_list_names(const char *comma, char *text, size_t size);

#endif
