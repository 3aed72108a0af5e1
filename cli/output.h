/* SPDX-License-Identifier: Apache-2.0 */
/* Standard output, whose errors are reported with the system's reason. */
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H

/* Called once, before anything is printed. */
void cli_begin_output(void);

/* Flushes stdout, because a full disk causes an error only when the buffer is written. Returns the final exit code:
   `code`, or 4 after a message on stderr if `code` is 0 or 1 but stdout could not be written. */
int cli_end_output(int code);

#endif
