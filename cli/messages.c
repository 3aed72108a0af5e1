/* SPDX-License-Identifier: Apache-2.0 */
/* What the program says on stderr: messages, and the progress line, which a message clears. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "cli.h"

int cli_terminal_width(int stream)
{
    enum { NARROWEST = 40, USUAL = 80 };
    struct winsize size = {0};
    if (!isatty(stream)) {
        return 0;
    }
    const char *wish = getenv("COLUMNS");
    int width = wish ? atoi(wish) : 0;
    width = width > 0 ? width : ioctl(stream, TIOCGWINSZ, &size) || !size.ws_col ? USUAL : size.ws_col;
    return width > NARROWEST ? width : NARROWEST;
}

static bool shown; /* a progress line is shown */

void cli_show_line(const char *text)
{
    const int width = cli_terminal_width(STDERR_FILENO);
    fprintf(stderr, "\r\033[K%.*s", width ? width - 1 : (int)strlen(text), text);
    shown = true;
}

void cli_work_end(void)
{
    fputs(shown ? "\r\033[K" : "", stderr);
    shown = false;
}

const char *cli_one_line(const char *text)
{
    static char lines[4][4096];
    static size_t next;
    char *line = lines[next++ % (sizeof lines / sizeof *lines)];
    snprintf(line, sizeof *lines, "%s", text);
    koksma_text_escape(line, sizeof *lines);
    return line;
}

void cli_say(const char *command, const char *format, ...)
{
    va_list list;
    char text[4096];
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    koksma_text_escape(text, sizeof text);
    cli_work_end();
    fprintf(stderr, *command ? "koksma %s: %s\n" : "koksma%s: %s\n", command, text);
}
