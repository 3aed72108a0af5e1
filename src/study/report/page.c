/* SPDX-License-Identifier: Apache-2.0 */
/* The page as the build embeds it: page/page.html with its script, cut where the data go. */
#include "study/report/page.h"

#include "study/report/page_text.h"

const char *koksma__page_before(void)
{
    return koksma__page_head;
}

const char *koksma__page_after(void)
{
    return koksma__page_foot;
}
