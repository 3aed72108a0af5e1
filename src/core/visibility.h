/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_VISIBILITY_H
#define KOKSMA_CORE_VISIBILITY_H

/* Marks what libkoksma-lab takes from libkoksma beside the public functions: seen across the border of the shared
   libraries, under a symbol version of its own (src/exports.map.in), and by nobody else. */
#if defined(__GNUC__)
#define KOKSMA__LAB __attribute__((visibility("default")))
#else
#define KOKSMA__LAB
#endif

#endif
