/* SPDX-License-Identifier: Apache-2.0 */
/* Checks a filter before it is used. A caller may give a filter that is not of the table; tables of samples and the
   width of the film's border are computed from its radius, which must be a moderate number. */
#include "render/filter_check.h"

#include "core/status.h"

koksma_status koksma__filter_check(const koksma_filter *filter)
{
    KOKSMA__FAIL_IF(!filter->name || !filter->value, KOKSMA_ARGUMENT,
                    "the filter has no %s: koksma_filter_find has filters", filter->name ? "value" : "name");
    KOKSMA__FAIL_IF(!(filter->radius > 0 && filter->radius <= KOKSMA__MAX_RADIUS), KOKSMA_ARGUMENT,
                    "filter %s: radius = %g: it takes a radius above 0 and up to %d pixels", filter->name,
                    filter->radius, KOKSMA__MAX_RADIUS);
    return KOKSMA_OK;
}
