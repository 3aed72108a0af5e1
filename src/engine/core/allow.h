/* SPDX-License-Identifier: Apache-2.0 */
/* koksma_allow_exec decides whether a pattern may run the program or library that its path names. A thread passes
   this permission to the threads that it starts. */
#ifndef KOKSMA_CORE_ALLOW_H
#define KOKSMA_CORE_ALLOW_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Returns the number of seconds for which the calling thread lets a pattern's program run; 0: the thread allows no
   programs. A function that starts threads reads this number before, and each new thread passes it to
   koksma_allow_exec. */
KOKSMA__LAB double koksma__exec_seconds(void);

#endif
