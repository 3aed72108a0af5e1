/* SPDX-License-Identifier: Apache-2.0 */
/* Numbers in image files of 8 bits, which hold only colours from 0 to 1. */
#ifndef KOKSMA_CLI_ID_COLOURS_H
#define KOKSMA_CLI_ID_COLOURS_H

#include <koksma/image.h>

/* Returns whether files of this name hold 8 bits per channel (PNG, JPEG): numbers above 1 are white in them. */
bool cli_has_eight_bits(const char *path);

/* Writes the image of the AOV "id" as koksma_image_write does; into a file of 8 bits as one colour for each number, with
   0 in black. The colour of a number is the same in every image. */
koksma_status cli_write_ids(const char *path, const koksma_image *ids, const char *metadata);

#endif
