/* SPDX-License-Identifier: Apache-2.0 */
/* The parameter `scramble`, first in the list, of patterns that can be scrambled by Owen's method or not at all. */
#ifndef KOKSMA_PATTERNS_SHARED_SCRAMBLE_H
#define KOKSMA_PATTERNS_SHARED_SCRAMBLE_H

#include <koksma/koksma.h>

enum { KOKSMA__SCRAMBLE_NONE, KOKSMA__SCRAMBLE_OWEN };

static const char *const koksma__scrambles[] = {"none", "owen", NULL};

/* where: the bases, as in "in base 2" */
#define KOKSMA__PARAM_SCRAMBLE(where)                                                                                \
    {                                                                                                                \
        "scramble", "scrambling: none, or owen (exact nested scrambling" where ")", 0, 0, 1, koksma__scrambles, true \
    }

/* The member `ranges`: scrambled points are made all at once. */
static inline bool koksma__ranges_unscrambled(const double *params)
{
    return params[0] != KOKSMA__SCRAMBLE_OWEN;
}

#endif
