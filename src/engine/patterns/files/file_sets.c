/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Point sets of patterns that read files, kept for the process. A renderer asks for the set of each pixel, and random
 * modifiers, such as shift=1, make each of them another one: without this table the file would be opened and parsed for
 * each pixel.
 *
 * A set is found by its pattern, parameters, path, numbers of points and dimensions, and by what the system says of the
 * file: device, inode, size and times. It is asked each time, so that a file that has changed is read anew; only a
 * renderer, which asks for thousands of sets a second, trusts the file for some sets (koksma__trust_files). A file that
 * was written less than RACY_S before it was read is not kept, because a clock that ticks that slowly could give a later
 * change the same time. The table has at most MOST sets and MOST_BYTES of coordinates; the set whose last use is longest
 * ago makes room. Readers share a lock.
 */
#include "patterns/files/files.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

enum { MOST = 64 };

static const size_t MOST_BYTES = (size_t)64 << 20;
static const double RACY_S = 0.02;

typedef struct set_key {
    const koksma_pattern *pattern;
    double params[KOKSMA_MAX_PARAMS];
    uint64_t n, first, count;
    int dim;
    dev_t device;
    ino_t inode;
    off_t size;
    struct timespec written, changed;
} set_key;

typedef struct set {
    set_key key;
    char *path; /* NULL: this place is free */
    double *xs;
    atomic_ullong used; /* the time of the last use, in uses of the table */
} set;

static set sets[MOST];
static size_t kept_bytes;
static atomic_ullong uses;
static _Thread_local bool trusted;
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;

static bool same_time(struct timespec a, struct timespec b)
{
    return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

/* Returns whether a kept set is the one that is asked for, if its file has not changed. */
static bool alike(const set *s, const set_key *k, const char *path)
{
    return s->path && s->key.pattern == k->pattern && s->key.n == k->n && s->key.first == k->first &&
           s->key.count == k->count && s->key.dim == k->dim && !memcmp(s->key.params, k->params, sizeof k->params) &&
           !strcmp(s->path, path);
}

static bool same_file(const set *s, const set_key *k)
{
    return s->key.device == k->device && s->key.inode == k->inode && s->key.size == k->size &&
           same_time(s->key.written, k->written) && same_time(s->key.changed, k->changed);
}

static size_t bytes_of(const set_key *k)
{
    return (size_t)k->count * (size_t)k->dim * sizeof(double);
}

/* Copies the points of a kept set; returns false if there is none. */
static bool find(const set_key *k, const char *path, double *xs)
{
    bool found = false;
    pthread_rwlock_rdlock(&lock);
    for (size_t i = 0; i < MOST && !found; i++) {
        if (alike(&sets[i], k, path) && (trusted || same_file(&sets[i], k))) {
            memcpy(xs, sets[i].xs, bytes_of(k));
            atomic_store_explicit(&sets[i].used, ++uses, memory_order_relaxed);
            found = true;
        }
    }
    pthread_rwlock_unlock(&lock);
    return found;
}

static void drop(set *s)
{
    kept_bytes -= s->path ? bytes_of(&s->key) : 0;
    free(s->path);
    free(s->xs);
    s->path = NULL;
    s->xs = NULL;
    s->used = 0;
}

/* Drops the set of a file that has changed. */
static void drop_changed(const set_key *k, const char *path)
{
    pthread_rwlock_wrlock(&lock);
    for (size_t i = 0; i < MOST; i++) {
        if (alike(&sets[i], k, path)) {
            drop(&sets[i]);
        }
    }
    pthread_rwlock_unlock(&lock);
}

bool koksma__trust_files(bool trust)
{
    const bool before = trusted;
    trusted = trust;
    return before;
}

/* Returns a free place that leaves `bytes` for its set. */
static set *make_place(size_t bytes)
{
    for (;;) { /* ends, as an empty table has place for each set that is kept */
        set *empty = NULL, *oldest = NULL;
        for (size_t i = 0; i < MOST; i++) {
            if (!sets[i].path) {
                empty = &sets[i];
            } else if (!oldest || sets[i].used < oldest->used) {
                oldest = &sets[i];
            }
        }
        if (empty && (!oldest || kept_bytes + bytes <= MOST_BYTES)) {
            return empty;
        }
        drop(oldest);
    }
}

/* Keeps a copy of the points. Without memory nothing is kept. */
static void keep(const set_key *k, const char *path, const double *xs)
{
    const size_t bytes = bytes_of(k), length = strlen(path) + 1;
    char *name = malloc(length);
    double *copy = malloc(bytes);
    if (!name || !copy) {
        free(name);
        free(copy);
        return;
    }
    memcpy(name, path, length);
    memcpy(copy, xs, bytes);
    pthread_rwlock_wrlock(&lock);
    set *place = make_place(bytes);
    place->key = *k;
    place->path = name;
    place->xs = copy;
    place->used = ++uses;
    kept_bytes += bytes;
    pthread_rwlock_unlock(&lock);
}

static set_key key_of(const koksma_pattern *pattern, const koksma_args *args, const koksma_points *out)
{
    set_key k = {.pattern = pattern, .n = args->n, .first = args->first, .count = out->n, .dim = out->dim};
    for (int i = 0; pattern->params && pattern->params[i].name; i++) {
        k.params[i] = args->params[i];
    }
    return k;
}

/* Adds to a key what the system says of the file; returns false if the path is not that of a plain file. */
static bool look_at(const char *path, set_key *k)
{
    struct stat s;
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode)) {
        return false;
    }
    k->device = s.st_dev;
    k->inode = s.st_ino;
    k->size = s.st_size;
    k->written = s.st_mtim;
    k->changed = s.st_ctim;
    return true;
}

static bool is_racy(const set_key *k)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    const double age_s = (double)(now.tv_sec - k->written.tv_sec) + 1e-9 * (double)(now.tv_nsec - k->written.tv_nsec);
    return age_s < RACY_S;
}

koksma_status koksma__file_points(const koksma_pattern *pattern, uint64_t seed, const koksma_args *args,
                                  koksma_points *out)
{
    char path[KOKSMA_MAX_SPEC];
    const bool family = koksma__reads_points(pattern) && koksma__file_is_family(args->path);
    const char *name = args->path;
    if (family) {
        const koksma_status status = koksma__file_name(args->path, (size_t)args->n, seed, path);
        if (status) {
            return status;
        }
        name = path;
    }
    set_key key = key_of(pattern, args, out);
    const bool fits = out->n <= MOST_BYTES / sizeof(double) / (size_t)out->dim;
    if (fits && trusted && find(&key, name, out->xs)) {
        return KOKSMA_OK;
    }
    const bool keeps = fits && look_at(name, &key);
    if (keeps && find(&key, name, out->xs)) {
        return KOKSMA_OK;
    }
    drop_changed(&key, name);
    const bool racy = keeps && is_racy(&key);
    const koksma_status status = pattern->generate(seed, args, out);
    if (!status && keeps && !racy) {
        keep(&key, name, out->xs);
    }
    return status;
}
