/* SPDX-License-Identifier: Apache-2.0 */
/* Standard output, whose errors are reported with the system's reason. */
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H

#include <stdbool.h>

#include "cli.h"

/* Called once, before anything is printed. */
void cli_begin_output(void);

/* Flushes stdout, because a full disk causes an error only when the buffer is written. Returns the final exit code:
   `code`, or 4 after a message on stderr if `code` is 0 or 1 but stdout could not be written. */
int cli_end_output(int code);

/* Returns whether the file `path` is a stream: "-" or another name of an open descriptor, a pipe or a device. A second
   write follows the first one there, whereas it replaces a plain file. */
bool cli_is_stream(const char *path);

/* Returns whether `path` is standard output: "-", /dev/stdout, or another name of the stream behind it. */
bool cli_is_stdout(const char *path);

/* Returns whether two paths lead to the same file, which is there. */
bool cli_is_same_file(const char *a, const char *b);

/* Tries, before work that takes long, whether the file `path` can be written: its folder is there and allows new files.
   Makes nothing; NULL and streams are not tried. Returns the exit code, which is not 0 after an error. */
int cli_try_output(const cli_arguments *arguments, const char *path);

/* Returns whether the paths name one file that is written, also by another spelling or a link. Streams are none: what is
   written to them follows what was written before. */
bool cli_is_same_output(const char *a, const char *b);

/* Returns false, after an error, if --json is given and the result is written to standard output, which has no place for
   rows then. */
bool cli_check_output(const cli_arguments *arguments, const char *path);

#endif
