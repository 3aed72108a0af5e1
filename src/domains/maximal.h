/* SPDX-License-Identifier: Apache-2.0 */
/* poisson-disk-maximal on a domain. */
#ifndef KOKSMA_DOMAINS_MAXIMAL_H
#define KOKSMA_DOMAINS_MAXIMAL_H

#include "domains/domain.h"

koksma_status koksma__choose_maximal(const koksma__choice *choice);

#endif
