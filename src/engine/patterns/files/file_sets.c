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

#include "core/status.h"

enum { MOST = 64 };

static const size_t MOST_BYTES = (size_t)64 << 20;
static const double RACY_S = 0.02;

/* What a set is found by, and what the system says of its file. Both are compared byte by byte: there are no bytes between
   their members. */
typedef struct set_key {
    const koksma_pattern *pattern;
    double params[KOKSMA_MAX_PARAMS];
    uint64_t n, first, count, dim;
    char path[KOKSMA_MAX_SPEC];
} set_key;

typedef struct file_state {
    uint64_t device, inode, size;
    int64_t written_s, written_ns, changed_s, changed_ns;
} file_state;

typedef struct set {
    set_key key;
    file_state file;
    double *xs;         /* NULL: this place is free */
    atomic_ullong used; /* the time of the last use, in uses of the table */
} set;

static set sets[MOST];
static size_t kept_bytes;
static atomic_ullong uses;
static _Thread_local bool trusted;
static pthread_rwlock_t lock = PTHREAD_RWLOCK_INITIALIZER;

static size_t bytes_of(const set_key *k)
{
    return (size_t)k->count * (size_t)k->dim * sizeof(double);
}

static bool alike(const set *s, const set_key *k)
{
    return s->xs && !memcmp(&s->key, k, sizeof *k);
}

/* Copies the points of a kept set; returns false if there is none of a file in this state, or in any if that is NULL. */
static bool find(const set_key *k, const file_state *file, double *xs)
{
    bool found = false;
    pthread_rwlock_rdlock(&lock);
    for (size_t i = 0; i < MOST && !found; i++) {
        if (alike(&sets[i], k) && (!file || !memcmp(&sets[i].file, file, sizeof *file))) {
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
    kept_bytes -= s->xs ? bytes_of(&s->key) : 0;
    free(s->xs);
    s->xs = NULL;
}

/* Drops the set of a file that has changed. */
static void drop_changed(const set_key *k)
{
    pthread_rwlock_wrlock(&lock);
    for (size_t i = 0; i < MOST; i++) {
        if (alike(&sets[i], k)) {
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
            if (!sets[i].xs) {
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
static void keep(const set_key *k, const file_state *file, const double *xs)
{
    const size_t bytes = bytes_of(k);
    double *copy = malloc(bytes);
    if (copy) {
        memcpy(copy, xs, bytes);
        pthread_rwlock_wrlock(&lock);
        set *place = make_place(bytes);
        memcpy(&place->key, k, sizeof *k);
        memcpy(&place->file, file, sizeof *file);
        place->xs = copy;
        place->used = ++uses;
        kept_bytes += bytes;
        pthread_rwlock_unlock(&lock);
    }
}

/* Reads what the system says of a file; returns false if the path is not that of a plain file. */
static bool look_at(const char *path, file_state *file)
{
    struct stat s;
    if (stat(path, &s) != 0 || !S_ISREG(s.st_mode)) {
        return false;
    }
    *file = (file_state){.device = (uint64_t)s.st_dev,
                         .inode = (uint64_t)s.st_ino,
                         .size = (uint64_t)s.st_size,
                         .written_s = s.st_mtim.tv_sec,
                         .written_ns = s.st_mtim.tv_nsec,
                         .changed_s = s.st_ctim.tv_sec,
                         .changed_ns = s.st_ctim.tv_nsec};
    return true;
}

static bool is_racy(const file_state *file)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    return (double)(now.tv_sec - file->written_s) + 1e-9 * (double)(now.tv_nsec - file->written_ns) < RACY_S;
}

koksma_status koksma__file_points(const koksma_pattern *pattern, uint64_t seed, const koksma_args *args,
                                  koksma_points *out)
{
    set_key key = {
        .pattern = pattern, .n = args->n, .first = args->first, .count = out->n, .dim = (uint64_t)out->dim};
    file_state file;
    for (int i = 0; pattern->params && pattern->params[i].name; i++) {
        key.params[i] = args->params[i];
    }
    if (koksma__reads_points(pattern) && koksma__file_is_family(args->path)) {
        KOKSMA__TRY(koksma__file_name(args->path, (size_t)args->n, seed, key.path));
    } else {
        memcpy(key.path, args->path, strlen(args->path));
    }
    const bool fits = out->n <= MOST_BYTES / sizeof(double) / (size_t)out->dim;
    if (fits && trusted && find(&key, NULL, out->xs)) {
        return KOKSMA_OK;
    }
    const bool keeps = fits && look_at(key.path, &file);
    if (keeps && find(&key, &file, out->xs)) {
        return KOKSMA_OK;
    }
    drop_changed(&key);
    const bool racy = keeps && is_racy(&file);
    const koksma_status status = pattern->generate(seed, args, out);
    if (!status && keeps && !racy) {
        keep(&key, &file, out->xs);
    }
    return status;
}
