/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_PAGES_H
#define KOKSMA_CORE_PAGES_H

#include <stddef.h>

/* Asks the system for large pages in a new block of many megabytes; for smaller blocks it does nothing. This pays
   because the first access to each page of a new block takes longer than filling the page several times. The system
   may ignore the request. */
void koksma__large_pages(void *memory, size_t bytes);

#endif
