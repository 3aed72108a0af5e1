/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_PAGES_H
#define KOKSMA_CORE_PAGES_H

#include <stddef.h>

/* Asks the system for large pages in a fresh block of memory of many megabytes; smaller blocks are left alone. The
   first access to a fresh block takes as long as filling it several times, most of that time for each page. The
   system may ignore the request. */
void koksma__large_pages(void *memory, size_t bytes);

#endif
