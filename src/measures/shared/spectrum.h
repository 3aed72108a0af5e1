/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_MEASURES_SHARED_SPECTRUM_H
#define KOKSMA_MEASURES_SHARED_SPECTRUM_H

#include <koksma/spectrum.h>

#include "core/visibility.h"

/* Fails unless koksma_spectrum_init has initialised the spectrum. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__spectrum_check(const koksma_spectrum *spectrum);

#endif
