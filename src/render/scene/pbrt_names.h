/* SPDX-License-Identifier: Apache-2.0 */
/* The vocabulary of pbrt-v4: which kinds each directive has, and which parameters, of which types and values. */
#ifndef KOKSMA_SCENE_PBRT_NAMES_H
#define KOKSMA_SCENE_PBRT_NAMES_H

#include "scene/pbrt_tokens.h"

/* Whether a directive has this kind; true for directives that have none. */
bool koksma__pbrt_is_kind(const char *directive, const char *kind);

/* Warns about each of the directive's own parameters that pbrt-v4 would refuse: by its name, its type, or a value that is
   not in a closed list. A kind that does not exist, or NULL, stands for all kinds. Errors: those of
   koksma__import_unknown. */
koksma_status koksma__pbrt_name_parameters(koksma__import *im, const char *directive, const char *kind,
                                           const koksma__pbrt_parameters *p);

/* Warns about those that pbrt knows and nothing has looked up, except those that have no effect on the pictures that
   Koksma makes. */
koksma_status koksma__pbrt_name_unused(koksma__import *im, const char *directive, const char *kind,
                                       const koksma__pbrt_parameters *p);

#endif
