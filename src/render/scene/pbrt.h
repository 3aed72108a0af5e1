/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_SCENE_PBRT_H
#define KOKSMA_SCENE_PBRT_H

#include "scene/import.h"

/* Reads a scene of pbrt-v4 into an empty scene. Errors: MISSING, MALFORMED, MEMORY. */
koksma_status koksma__pbrt_read(koksma__import *im, const char *text, size_t size);

#endif
