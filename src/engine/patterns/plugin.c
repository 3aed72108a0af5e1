/* SPDX-License-Identifier: Apache-2.0 */
/*
 * plugin: the points of a sampler in a shared library: plugin:LIBRARY.so is the first sampler of the library,
 * plugin:LIBRARY.so:NAME the sampler with this name. The interface is <koksma/plugin.h>. As with exec, every set is
 * generated twice, and both results have to be equal.
 *
 * The library stays loaded: closing it between two sets would run its constructors again for each set. A path without
 * a slash names a file in the current directory; the loader's search path is not used. The process keeps the code that it
 * loaded first, so that a set of a file that has changed since then is refused: a study hashes the file and would keep the
 * old code's values under the new file's hash. A file whose times alone differ has the hash that it had.
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/plugin.h>

#include "core/capacity.h"
#include "core/files.h"
#include "core/spec.h"
#include "core/status.h"
#include "patterns/files/files.h"
#include "patterns/patterns.h"

#ifdef __EMSCRIPTEN__

static koksma_status open_library(const char *name, const char *path, void **symbol)
{
    (void)path, (void)symbol;
    return koksma__fail(KOKSMA_UNSUPPORTED, "%s: a browser loads no libraries", name);
}

#else

#include <dlfcn.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

/* A loaded library, its file as it was before it was loaded, and the hash of that file. */
typedef struct loaded {
    void *library;
    struct stat file;
    bool hashed; /* whether the file was still the same when it was hashed */
    uint64_t hash;
} loaded;

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static loaded *all;
static size_t n_loaded;

static bool same_file(const struct stat *a, const struct stat *b)
{
    return a->st_dev == b->st_dev && a->st_ino == b->st_ino && a->st_size == b->st_size &&
           a->st_mtim.tv_sec == b->st_mtim.tv_sec && a->st_mtim.tv_nsec == b->st_mtim.tv_nsec;
}

/* Sets *known to the record of a library, which is made at the first call. */
static koksma_status find_loaded(const char *path, void *library, const struct stat *before, loaded **known)
{
    struct stat now;
    size_t i = 0;
    while (i < n_loaded && all[i].library != library) {
        i++;
    }
    *known = i < n_loaded ? &all[i] : koksma__add_one(&all, &n_loaded, sizeof **known);
    KOKSMA__TRY(*known ? KOKSMA_OK : KOKSMA_MEMORY);
    if (!(*known)->library) { /* it was added */
        **known = (loaded){.library = library, .file = *before};
        KOKSMA__TRY(koksma__hash_file(path, &(*known)->hash));
        (*known)->hashed = !stat(path, &now) && same_file(before, &now);
    }
    return KOKSMA_OK;
}

/* Fails unless the file is the one that the library was loaded from: dlopen finds a loaded library by the path alone. */
static koksma_status check_unchanged(const char *name, const char *path, void *library, const struct stat *before)
{
    struct stat now;
    loaded *known;
    uint64_t hash = 0;
    koksma_status status = find_loaded(path, library, before, &known);
    KOKSMA__FAIL_IF(!status && stat(path, &now), KOKSMA_MISSING, "%s: there is no file %s to read", name, path);
    if (status || same_file(&known->file, &now)) {
        return status;
    }
    status = known->hashed ? koksma__hash_file(path, &hash) : KOKSMA_OK;
    KOKSMA__FAIL_IF(
        !status && (!known->hashed || hash != known->hash), KOKSMA_MALFORMED,
        "%s: the file has changed since this process loaded it, and a process can't load it again; start a "
        "new process, or give the new library another name",
        name);
    known->file = status ? known->file : now; /* so that the next set needs no hash */
    return status;
}

static koksma_status load(const char *name, const char *path, void **symbol)
{
    struct stat before;
    const bool found = !stat(path, &before);
    void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    KOKSMA__FAIL_IF(!library, KOKSMA_MALFORMED, "%s: it can't be loaded: %s", name, dlerror());
    *symbol = dlsym(library, "koksma_plugin_at");
    if (!*symbol) {
        dlclose(library);
        return koksma__fail(KOKSMA_MALFORMED, "%s: it exports no koksma_plugin_at (koksma/plugin.h)", name);
    }
    KOKSMA__FAIL_IF(!found, KOKSMA_MISSING, "%s: there is no file %s to read", name, path);
    pthread_mutex_lock(&lock);
    const koksma_status status = check_unchanged(name, path, library, &before);
    pthread_mutex_unlock(&lock);
    return status;
}

/* The whole path is loaded: dlopen would take ./a.so of the current directory for that of an earlier one. */
static koksma_status open_library(const char *name, const char *path, void **symbol)
{
    char local[KOKSMA_MAX_SPEC + 2];
    snprintf(local, sizeof local, "%s%s", strchr(path, '/') ? "" : "./", path);
    char *whole = access(local, R_OK) ? NULL : realpath(local, NULL);
    KOKSMA__FAIL_IF(!whole, KOKSMA_MISSING, "%s: there is no file %s to read", name, local);
    const koksma_status status = load(name, whole, symbol);
    free(whole);
    return status;
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
