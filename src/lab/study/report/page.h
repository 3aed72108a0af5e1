/* SPDX-License-Identifier: Apache-2.0 */
/* The page that shows a report or a datasheet. */
#ifndef KOKSMA_STUDY_REPORT_PAGE_H
#define KOKSMA_STUDY_REPORT_PAGE_H

#include <koksma/koksma.h>

/* What a page is about: a browser without JavaScript shows only that and where the numbers are. */
typedef enum koksma__page_kind { KOKSMA__PAGE_STUDY, KOKSMA__PAGE_IMAGES, KOKSMA__PAGE_DATASHEET } koksma__page_kind;

/* Returns the page with the JSON text in it, which the caller frees; NULL: out of memory. */
char *koksma__page_text(koksma__page_kind kind, const char *json);

/* Writes the JSON text as report.json, and the page that shows it as report.html, into a folder. */
koksma_status koksma__page_write(const char *folder, koksma__page_kind kind, const char *json);

#endif
