/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Asks Linux for large pages (madvise) for large blocks that are read in random order, which makes TLB misses rarer.
 * The kernel may ignore the request; on other systems the function does nothing.
 */
#ifdef __linux__
#define _DEFAULT_SOURCE /* madvise */
#endif
#include "core/capacity.h"

#include <stdint.h>

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

/* Twice the size of a large page: a block of this size contains at least one complete large page. */
enum { MANY = 1 << 22 };

void koksma__large_pages(void *memory, size_t bytes)
{
#ifdef MADV_HUGEPAGE
    const long page = sysconf(_SC_PAGESIZE);
    if (memory && bytes >= MANY && page > 0) {
        const uintptr_t first = ((uintptr_t)memory + (uintptr_t)page - 1) & ~((uintptr_t)page - 1);
        const uintptr_t end = ((uintptr_t)memory + bytes) & ~((uintptr_t)page - 1);
        madvise((void *)first, end - first, MADV_HUGEPAGE);
    }
#else
    (void)memory;
    (void)bytes;
#endif
}
