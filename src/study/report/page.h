/* SPDX-License-Identifier: Apache-2.0 */
/* The page that shows a report or a datasheet. */
#ifndef KOKSMA_STUDY_REPORT_PAGE_H
#define KOKSMA_STUDY_REPORT_PAGE_H

#include <koksma/koksma.h>

/* The page's text before and after the JSON. */
const char *koksma__page_before(void);
const char *koksma__page_after(void);

/* Writes the JSON text as report.json, and the page that shows it as report.html, into a folder. */
koksma_status koksma__page_write(const char *folder, const char *json);

#endif
