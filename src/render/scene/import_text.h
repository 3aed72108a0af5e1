/* SPDX-License-Identifier: Apache-2.0 */
/* The texts that a scene of another renderer includes. */
#ifndef KOKSMA_SCENE_IMPORT_TEXT_H
#define KOKSMA_SCENE_IMPORT_TEXT_H

#include "scene/import.h"

/* Reads a file that the scene includes. The file must be below the scene's folder, and a scene can include at most
   MOST_INCLUDES files. Small files cannot make a long text: what is read again, and what a packed file holds beyond
   MOST_RATIO times its size, is at most MOST_SURPLUS bytes together. The caller passes *bytes to
   koksma__import_text_close. */
koksma_status koksma__import_text(koksma__import *im, koksma__text_place place, const char *path, char **bytes,
                                  size_t *size);
void koksma__import_text_close(koksma__import *im, char *bytes, size_t size);

/* Counts text that no file holds, because it is read again or made from names. Error: MALFORMED (more than MOST_SURPLUS
   bytes in the scene). */
koksma_status koksma__import_surplus(koksma__import *im, koksma__text_place place, uint64_t bytes);

#endif
