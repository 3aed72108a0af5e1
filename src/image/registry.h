/* SPDX-License-Identifier: Apache-2.0 */
/* Image files for the library itself. */
#ifndef KOKSMA_IMAGE_REGISTRY_H
#define KOKSMA_IMAGE_REGISTRY_H

#include <koksma/image.h>

#include "core/read_file.h"

/* koksma_image_read of a kind of file, and who named it. */
koksma_status koksma__image_read(const char *path, koksma__file_kind kind, koksma__named by, koksma_image *out);

/* koksma_image_write of a file that the program names, below a folder (koksma__atomic_open). */
koksma_status koksma__image_write_in(const char *folder, const char *name, const koksma_image *image,
                                     const char *metadata);

#endif
