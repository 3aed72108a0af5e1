/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KOKSMA_CORE_VISIBILITY_H
#define KOKSMA_CORE_VISIBILITY_H

/* Marks the private functions of libkoksma that libkoksma-lab calls. The shared library exports them under a symbol
   version of their own (src/exports.map.in); other programs must not use them. */
#if defined(_WIN32)
#define KOKSMA__LAB __declspec(dllexport)
#elif defined(__GNUC__)
#define KOKSMA__LAB __attribute__((visibility("default")))
#else
#define KOKSMA__LAB
#endif

#endif
