/* SPDX-License-Identifier: Apache-2.0 */
/* The clock that measures time limits. */
#ifndef KOKSMA_CORE_CLOCK_H
#define KOKSMA_CORE_CLOCK_H

#include "core/visibility.h"

/* Seconds on a clock that never goes back. Any thread may call it. */
KOKSMA__LAB double koksma__now_s(void);

/* Replaces the clock, for tests that must not depend on the speed of the machine: koksma__now_s then returns the
   result of `clock`, which any thread may call. NULL restores the system's clock. */
void koksma__set_clock(double (*clock)(void));

#endif
