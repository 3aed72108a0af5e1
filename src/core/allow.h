/* SPDX-License-Identifier: Apache-2.0 */
/* Whether patterns may run code that their path names: koksma_allow_exec, and how it reaches other threads. */
#ifndef KOKSMA_CORE_ALLOW_H
#define KOKSMA_CORE_ALLOW_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* The seconds that the calling thread allows, 0 where it allows nothing: for threads that it starts, which call
   koksma_allow_exec with them. */
KOKSMA__LAB double koksma__exec_seconds(void);

#endif
