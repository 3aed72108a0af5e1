/* SPDX-License-Identifier: Apache-2.0 */
/* The target (field.h) of gaussian-blue-noise with a density. */
#ifndef KOKSMA_DOMAINS_DENSITY_FIELD_H
#define KOKSMA_DOMAINS_DENSITY_FIELD_H

#include "domains/field.h"

koksma_status koksma__density_field_open(const koksma__point_domain *domain, size_t n, double sigma,
                                         const koksma_run *run, koksma__field *field);

#endif
