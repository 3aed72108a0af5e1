/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_SPECTRUM_H
#define KOKSMA_MEASURES_SHARED_SPECTRUM_H

#include <koksma/spectrum.h>

#include "core/visibility.h"

/* Fails if the spectrum was not initialised by koksma_spectrum_init. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__spectrum_check(const koksma_spectrum *spectrum);

#endif
