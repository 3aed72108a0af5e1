/* SPDX-License-Identifier: Apache-2.0 */
/* gaussian-blue-noise on a domain. */
#ifndef KOKSMA_DOMAINS_GAUSSIAN_H
#define KOKSMA_DOMAINS_GAUSSIAN_H

#include "domains/domain.h"

koksma_status koksma__choose_gaussian(const koksma__choice *choice);

#endif
