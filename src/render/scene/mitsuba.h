/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_SCENE_MITSUBA_H
#define KOKSMA_SCENE_MITSUBA_H

#include "scene/import.h"

/* Reads a scene of Mitsuba 3 into an empty scene. Errors: MISSING, MALFORMED, MEMORY; UNSUPPORTED (this build
   lacks expat). */
koksma_status koksma__mitsuba_read(koksma__import *im, const char *text, size_t size);

#endif
