/* SPDX-License-Identifier: Apache-2.0 */
/* The clock that time limits are measured by. */
#ifndef KOKSMA_CORE_CLOCK_H
#define KOKSMA_CORE_CLOCK_H

#include "core/visibility.h"

/* Seconds on a clock that never goes back. Any thread may ask. */
KOKSMA__LAB double koksma__now_s(void);

/* For tests, which must not depend on the speed of the machine: time is what `clock` says, called from any thread;
   NULL: the system's again. */
void koksma__set_clock(double (*clock)(void));

#endif
