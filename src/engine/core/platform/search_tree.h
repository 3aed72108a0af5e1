/* SPDX-License-Identifier: Apache-2.0 */
/* <search.h>'s trees with glibc's tdestroy, for systems that lack one or both. */
#ifndef KOKSMA_CORE_PLATFORM_SEARCH_TREE_H
#define KOKSMA_CORE_PLATFORM_SEARCH_TREE_H

#if defined(_WIN32) || defined(__APPLE__)

#include "core/visibility.h"

typedef int koksma__tree_compare(const void *a, const void *b);

KOKSMA__LAB void *koksma__tsearch(const void *key, void **root, koksma__tree_compare *compare);
KOKSMA__LAB void *koksma__tfind(const void *key, void *const *root, koksma__tree_compare *compare);
KOKSMA__LAB void koksma__tdestroy(void *root, void (*release)(void *key));

#define tsearch koksma__tsearch
#define tfind koksma__tfind
#define tdestroy koksma__tdestroy

#endif

#endif
