/* SPDX-License-Identifier: Apache-2.0 */
/* The page that shows a report or a datasheet: its text before and after the JSON. */
#ifndef KOKSMA_STUDY_REPORT_PAGE_H
#define KOKSMA_STUDY_REPORT_PAGE_H

const char *koksma__page_before(void);
const char *koksma__page_after(void);

#endif
