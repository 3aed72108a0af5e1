/* SPDX-License-Identifier: Apache-2.0 */
/*
 * plugin: the points of a sampler in a shared library: plugin:LIBRARY.so is the first sampler of the library,
 * plugin:LIBRARY.so:NAME the sampler with this name. The interface is <koksma/plugin.h>. As with exec, every set is
 * generated twice, and both results have to be equal.
 *
 * The library stays loaded: closing it between two sets would run its constructors again for each set. A path without
 * a slash names a file in the current directory; the loader's search path is not used.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/plugin.h>

#include "core/spec.h"
#include "core/status.h"
#include "patterns/patterns.h"
#include "patterns/shared/file_names.h"

#ifdef __EMSCRIPTEN__

static koksma_status open_library(const char *name, const char *path, void **symbol)
{
    (void)path, (void)symbol;
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: a browser loads no libraries", name);
}

#else

#include <dlfcn.h>
#include <unistd.h>

static koksma_status open_library(const char *name, const char *path, void **symbol)
{
    char local[KOKSMA_MAX_SPEC + 2];
    snprintf(local, sizeof local, "%s%s", strchr(path, '/') ? "" : "./", path);
    KOKSMA__FAIL_IF(access(local, R_OK), KOKSMA_MISSING, "%s: there is no file %s to read", name, local);
    void *library = dlopen(local, RTLD_NOW | RTLD_LOCAL);
    KOKSMA__FAIL_IF(!library, KOKSMA_MALFORMED, "%s: it can't be loaded: %s", name, dlerror());
    *symbol = dlsym(library, "koksma_plugin_at");
    if (!*symbol) {
        dlclose(library);
        return koksma__fail(KOKSMA_MALFORMED, "%s: it exports no koksma_plugin_at (koksma/plugin.h)", name);
    }
    return KOKSMA_OK;
}

#endif

/* Finds the sampler named by `text`, "PATH[:NAME]". */
static koksma_status find(const char *name, const char *text, const koksma_plugin **out)
{
    char path[KOKSMA_MAX_SPEC];
    void *symbol = NULL;
    const koksma_plugin *(*at)(size_t);
    const char *end = koksma__library_end(text), *wanted = end ? end + 1 : NULL;
    snprintf(path, sizeof path, "%.*s", (int)(end ? (size_t)(end - text) : strlen(text)), text);
    KOKSMA__TRY(open_library(name, path, &symbol));
    memcpy(&at, &symbol, sizeof at); /* ISO C has no cast from a pointer to an object to a pointer to a function */
    const koksma_plugin *p;
    for (size_t i = 0; (p = at(i)); i++) {
        KOKSMA__FAIL_IF(p->version != KOKSMA_PLUGIN_VERSION, KOKSMA_MALFORMED,
                        "%s: it is written for version %d of koksma/plugin.h, but this is version %d", name,
                        p->version, KOKSMA_PLUGIN_VERSION);
        KOKSMA__FAIL_IF(!p->name || !p->generate, KOKSMA_MALFORMED, "%s: sampler %zu has no name or no function",
                        name, i);
        if (!wanted || !strcmp(wanted, p->name)) {
            *out = p;
            return KOKSMA_OK;
        }
    }
    return koksma__fail(KOKSMA_MALFORMED, "%s: its koksma_plugin_at has no sampler%s%s", name, wanted ? " " : "",
                        wanted ? wanted : "");
}

/* Generates a set. Coordinates are first set to -1, so that missing ones are detected after the call. */
static koksma_status call(const char *name, const koksma_plugin *p, uint64_t seed, size_t n, int dim, double *xs)
{
    char reason[KOKSMA_PLUGIN_REASON] = "";
    for (size_t i = 0; i < n * (size_t)dim; i++) {
        xs[i] = -1;
    }
    const int failed = p->generate(seed, n, dim, xs, reason);
    reason[sizeof reason - 1] = 0;
    reason[strcspn(reason, "\r\n")] = 0;
    KOKSMA__FAIL_IF(failed, KOKSMA_IMPOSSIBLE, "%s: it has no set of n = %zu, dim = %d%s%s", name, n, dim,
                    *reason ? ": " : "", reason);
    for (size_t i = 0; i < n * (size_t)dim; i++) {
        KOKSMA__FAIL_IF(!(xs[i] >= 0 && xs[i] < 1), KOKSMA_MALFORMED,
                        "%s: coordinate %zu of point %zu is %.17g; a pattern's points are in [0,1)", name,
                        i % (size_t)dim, i / (size_t)dim, xs[i]);
        xs[i] = xs[i] == 0 ? 0.0 : xs[i]; /* makes -0 a 0 */
    }
    return KOKSMA_OK;
}

static koksma_status generate(uint64_t seed, const koksma_args *args, koksma_points *out)
{
    char name[KOKSMA_MAX_SPEC + 8];
    const koksma_plugin *p = NULL;
    const size_t bytes = out->n * (size_t)out->dim * sizeof *out->xs;
    snprintf(name, sizeof name, "plugin:%s", args->path);
    KOKSMA__TRY(find(name, args->path, &p));
    KOKSMA__TRY(koksma__dim_check(name, out->dim, p->min_dim, p->max_dim));
    double *again = malloc(bytes);
    KOKSMA__REQUIRE_MEMORY(again, bytes);
    koksma_status status = call(name, p, seed, out->n, out->dim, out->xs);
    status = status ? status : call(name, p, seed, out->n, out->dim, again);
    if (!status && memcmp(out->xs, again, bytes) != 0) {
        status = koksma__fail(KOKSMA_MALFORMED,
                              "%s: when called twice with n = %zu, dim = %d, seed = %" PRIu64
                              ", it gave different points; they may depend only on n, dim and seed",
                              name, out->n, out->dim, seed);
    }
    free(again);
    return status;
}

const koksma_pattern koksma__pattern_plugin = {
    .name = "plugin",
    .title = "points of a sampler in a shared library: plugin:LIBRARY.so[:NAME]; needs --allow-exec",
    .cite = "-",
    .min_dim = 1,
    .max_dim = KOKSMA_MAX_DIM,
    .claims = 0,
    .generate = generate,
    .operand = "LIBRARY.so",
    .runs_code = true,
};
