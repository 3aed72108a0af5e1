/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Standard output with the reason of its first failure. stdio keeps only a flag of an error, and a buffer may be written
 * by any printf, so that errno is lost by the time the command ends. Therefore stdout becomes a stream whose bytes go
 * through put(), which keeps errno. glibc lets a program assign stdout; elsewhere the reason is that of the last write.
 */
#include "cli.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <unistd.h>

static int reason; /* errno of the first write that failed */

#ifndef __GLIBC__

/* Texts have the same bytes everywhere: Windows would write two for each line's end. */
void cli_begin_output(void)
{
#ifdef _WIN32
    _setmode(_fileno(stdin), _O_BINARY);
    _setmode(STDOUT_FILENO, _O_BINARY);
    _setmode(STDERR_FILENO, _O_BINARY);
#endif
}

#else

static ssize_t put(void *cookie, const char *bytes, size_t size)
{
    (void)cookie;
    size_t done = 0;
    while (done < size && !reason) {
        const ssize_t n = write(STDOUT_FILENO, bytes + done, size - done);
        done += n > 0 ? (size_t)n : 0;
        reason = n < 0 && errno != EINTR ? errno : 0;
    }
    return (ssize_t)done;
}

void cli_begin_output(void)
{
    static const cookie_io_functions_t functions = {.write = put};
    FILE *stream = fopencookie(NULL, "w", functions);
    if (stream) { /* without memory for it, stdout serves */
        setvbuf(stream, NULL, isatty(STDOUT_FILENO) ? _IOLBF : _IOFBF, BUFSIZ);
        stdout = stream;
    }
}

#endif

int cli_end_output(int code)
{
    errno = 0;
    if (code <= CLI_NO && (fflush(stdout) || ferror(stdout))) {
        const int known = reason ? reason : errno;
        cli_say("", "standard output could not be written: %s", strerror(known ? known : EIO));
        return koksma_status_exit_code(KOKSMA_IO);
    }
    return code;
}

bool cli_is_stream(const char *path)
{
    static const char *const names[] = {"/dev/stdout", "/dev/stderr", "/dev/fd/", "/proc/self/fd/"};
    struct stat info;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (!strncmp(path, names[i], strlen(names[i]))) {
            return true; /* also if the stream was redirected to a plain file */
        }
    }
    return !strcmp(path, "-") || (!stat(path, &info) && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode));
}

bool cli_is_stdout(const char *path)
{
    struct stat info, out;
    return !strcmp(path, "-") ||
           (cli_is_stream(path) && strcmp(path, "/dev/stderr") != 0 && !stat(path, &info) &&
            !fstat(STDOUT_FILENO, &out) && info.st_dev == out.st_dev && info.st_ino == out.st_ino);
}

bool cli_is_same_file(const char *a, const char *b)
{
    struct stat info, other;
    return !stat(a, &info) && !stat(b, &other) && info.st_dev == other.st_dev && info.st_ino == other.st_ino;
}

enum { MOST_LINKS = 40 }; /* as many as the system follows */

/* Follows links, of which the last may lead to a file that isn't there yet. Returns the place where they end, to be freed,
   or NULL and sets errno. */
static char *follow(const char *path)
{
    char *at = strdup(path), target[PATH_MAX], joined[2 * PATH_MAX];
    struct stat info;
    for (int i = 0; at && !lstat(at, &info) && S_ISLNK(info.st_mode); i++) {
        const ssize_t length = readlink(at, target, sizeof target - 1);
        const char *slash = strrchr(at, '/');
        const int why = length < 0 ? errno : i == MOST_LINKS ? ELOOP : 0;
        target[why ? 0 : length] = '\0';
        snprintf(joined, sizeof joined, "%.*s%s", slash && *target != '/' ? (int)(slash - at) + 1 : 0, at, target);
        free(at);
        at = why ? NULL : strdup(joined);
        errno = why ? why : errno;
    }
    return at;
}

/* Returns why no file can be written at `path`, as errno; 0: it can. */
static int why_not(const char *path)
{
    struct stat info;
    char *at = follow(path);
    if (!at) {
        return errno;
    }
    const char *slash = strrchr(at, '/');
    char *folder = slash ? strndup(at, slash == at ? 1 : (size_t)(slash - at)) : strdup(".");
    const int why = !folder                                                ? ENOMEM
                    : !stat(at, &info) && S_ISDIR(info.st_mode)            ? EISDIR
                    : stat(folder, &info)                                  ? errno
                    : !S_ISDIR(info.st_mode)                               ? ENOTDIR
                    : slash && !slash[1]                                   ? ENOENT
                    : faccessat(AT_FDCWD, folder, W_OK | X_OK, AT_EACCESS) ? errno
                                                                           : 0;
    free(folder);
    free(at);
    return why;
}

int cli_try_output(const cli_args *args, const char *path)
{
    const int why = !path || cli_is_stream(path) ? 0 : why_not(path);
    if (why) {
        cli_error(args, "%s: can't be written: %s", path,
                  why == EISDIR   ? "it is a directory"
                  : why == ENOENT ? "its folder isn't there"
                                  : strerror(why));
        return koksma_status_exit_code(KOKSMA_IO);
    }
    return CLI_YES;
}
