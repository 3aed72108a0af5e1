/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Interface for samplers in shared libraries, which koksma runs as the pattern plugin:./LIBRARY.so[:NAME]. A plugin
 * needs only this header and none of Koksma's libraries. A complete plugin:
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
 * The plugin's code runs inside the calling process with all its permissions. A crash of the plugin ends the
 * process, and no time limit applies. To isolate a sampler or limit its time, write it as a program for the pattern
 * exec:PROGRAM. A process keeps a library that it has loaded: if the file changes, its sets are refused until a new
 * process starts.
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

/* The version of this interface; koksma rejects a library with another version. */
#define KOKSMA_PLUGIN_VERSION 1

/* The size in bytes of the buffer `reason`. */
#define KOKSMA_PLUGIN_REASON 256

/* A sampler. The library exports

       const koksma_plugin *koksma_plugin_at(size_t i);

   koksma_plugin_at returns sampler i = 0, 1, ..., or NULL past the last one. Samplers and names must stay
   valid while the library is loaded. */
typedef struct koksma_plugin {
    int version; /* KOKSMA_PLUGIN_VERSION */
    const char *name;
    int min_dim, max_dim; /* smallest and largest dimension that the sampler accepts, within 1 to 4096 */
    /* Writes n points of dim coordinates in [0,1): point i to xs[i * dim] .. xs[i * dim + dim - 1]. Returns 0, or
       another number if the sampler has no such set; it may then write a one-line text to `reason`. The points must
       depend only on the arguments: koksma generates every set twice and compares. Several threads may call the
       function at once. */
    int (*generate)(uint64_t seed, size_t n, int dim, double *xs, char *reason);
} koksma_plugin;

#endif
