/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Standard output with the reason of its first failure. stdio keeps only a flag of an error, and a buffer may be written
 * by any printf, so that errno is lost by the time the command ends. Therefore stdout becomes a stream whose bytes go
 * through put(), which keeps errno. glibc lets a program assign stdout.
 */
#include "output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/types.h>
#include <unistd.h>

#include "cli.h"

static int reason; /* errno of the first write that failed */

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
