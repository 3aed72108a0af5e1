/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Koksma: a sampler of your own as a shared library, the pattern plugin:./LIBRARY.so[:NAME]. The library needs this
 * header, and nothing of Koksma's libraries. A whole one:
 *
 *     #include <koksma/plugin.h>
 *
 *     static int diagonal(uint64_t seed, size_t n, int dim, double *xs, char *reason)
 *     {
 *         for (size_t i = 0; i < n * (size_t)dim; i++) {
 *             xs[i] = (double)(i / (size_t)dim) / (double)n;
 *         }
 *         return 0;
 *     }
 *
 *     static const koksma_plugin plugin = {KOKSMA_PLUGIN_VERSION, "diagonal", 1, 16, diagonal};
 *
 *     KOKSMA_PLUGIN_EXPORT const koksma_plugin *koksma_plugin_at(size_t i)
 *     {
 *         return i == 0 ? &plugin : NULL;
 *     }
 *
 *     cc -shared -fPIC -O2 -o diagonal.so diagonal.c
 *     koksma measure plugin:./diagonal.so@64 -m star --allow-exec
 *
 * The code runs in the process that uses it, with all that this process may do; a crash ends it, and no limit of time
 * applies. A sampler that needs these is a program, exec:PROGRAM.
 */
#ifndef KOKSMA_PLUGIN_H
#define KOKSMA_PLUGIN_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#define KOKSMA_PLUGIN_EXPORT extern "C" __attribute__((visibility("default")))
#else
#define KOKSMA_PLUGIN_EXPORT __attribute__((visibility("default")))
#endif

/* The version of this interface; a library with another one is refused. */
#define KOKSMA_PLUGIN_VERSION 1

/* The bytes that there are at `reason`. */
#define KOKSMA_PLUGIN_REASON 256

/* A sampler. The library exports

       const koksma_plugin *koksma_plugin_at(size_t i);

   which returns sampler i = 0, 1, ..., NULL past the last. Samplers and names stay valid. */
typedef struct koksma_plugin {
    int version; /* KOKSMA_PLUGIN_VERSION */
    const char *name;
    int min_dim, max_dim; /* the dimensions that it serves, 1 to 4096 */
    /* Writes n points of dim coordinates in [0,1): point i to xs[i * dim] .. xs[i * dim + dim - 1]. Returns 0, or not 0
       where it has no such set; reason may then be given a text of one line. The points depend on nothing but the
       arguments: every set is made twice and compared. Called from any thread, and from several at once. */
    int (*generate)(uint64_t seed, size_t n, int dim, double *xs, char *reason);
} koksma_plugin;

#endif
