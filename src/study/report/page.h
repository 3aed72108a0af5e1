/* SPDX-License-Identifier: Apache-2.0 */
/* The page that shows a report or a datasheet. */
#ifndef KOKSMA_STUDY_REPORT_PAGE_H
#define KOKSMA_STUDY_REPORT_PAGE_H

#include <koksma/koksma.h>

/* Its text before and after the JSON. */
const char *koksma__page_before(void);
const char *koksma__page_after(void);

/* Writes report.json with this text and report.html, the page that shows it, into a folder. */
koksma_status koksma__page_write(const char *folder, const char *json);

#endif
