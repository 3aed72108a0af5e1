/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_PAGES_H
#define KOKSMA_CORE_PAGES_H

#include <stddef.h>

/* Asks the system for large pages in a fresh block of memory, if it is one of many megabytes: touching it the first
   time takes as long as filling it several times does, most of it for each page. The system may ignore it. */
void koksma__large_pages(void *memory, size_t bytes);

#endif
