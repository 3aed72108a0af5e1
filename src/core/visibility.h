/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_VISIBILITY_H
#define KOKSMA_CORE_VISIBILITY_H

/* Marks the functions of libkoksma, beside the public ones, that libkoksma-lab calls. They are exported by the shared
   library under a symbol version for this purpose (src/exports.map.in); other programs must not use them. */
#if defined(__GNUC__)
#define KOKSMA__LAB __attribute__((visibility("default")))
#else
#define KOKSMA__LAB
#endif

#endif
