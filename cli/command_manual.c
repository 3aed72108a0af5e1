/* SPDX-License-Identifier: Apache-2.0 */
/* Manual pages, from the tables that parse the command line and print --help. */
#include <stdio.h>
#include <string.h>

#include "cli.h"

/* Text for roff: backslashes, hyphens of options, and lines that begin with a dot or quote stay what they are; a line
   may break between alternatives. */
static void put(const char *text)
{
    for (bool at_start = true; *text; text++) {
        if (at_start && (*text == '.' || *text == '\'')) {
            fputs("\\&", stdout);
        }
        *text == '\\' ? fputs("\\e", stdout) : *text == '-' ? fputs("\\-", stdout) : putchar(*text);
        if (*text == '|') {
            fputs("\\:", stdout);
        }
        at_start = *text == '\n';
    }
}

static void put_options(const cli_command *command)
{
    printf(".SH OPTIONS\n");
    for (const cli_option *o = command->options; o->name; o++) {
        printf(".TP\n");
        if (o->letter) {
            printf("\\fB\\-%c\\fR, ", o->letter);
        }
        printf("\\fB\\-\\-");
        put(o->name);
        printf("\\fR");
        if (o->argument) {
            printf(" \\fI");
            put(o->argument);
            printf("\\fR");
        }
        printf("\n");
        put(o->help);
        printf("\n");
    }
    printf(".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nthe same as this page\n");
}

static void put_synopsis(const char *name, const char *synopsis)
{
    const char *line = synopsis;
    printf(".B koksma %s\n", name);
    for (;;) {
        const char *end = strchr(line, '\n');
        char text[512];
        snprintf(text, sizeof text, "%.*s", end ? (int)(end - line) : (int)strlen(line), line);
        put(text + strspn(text, " "));
        printf("\n");
        if (!end) {
            return;
        }
        printf(".br\n");
        line = end + 1;
    }
}

static void put_page(const cli_command *command)
{
    printf(".TH KOKSMA\\-%s 1 \"\" \"koksma %s\"\n.nh\n.ad l\n.SH NAME\nkoksma\\-%s \\- ", command->name,
           koksma_version(), command->name);
    put(command->summary);
    printf("\n.SH SYNOPSIS\n");
    put_synopsis(command->name, command->synopsis);
    if (command->details) {
        printf(".SH DESCRIPTION\n.nf\n");
        put(command->details);
        printf("\n.fi\n");
    }
    put_options(command);
    printf(".SH \"SEE ALSO\"\n.BR koksma (1)\n");
}

static void put_overview(void)
{
    const cli_command *command;
    printf(".TH KOKSMA 1 \"\" \"koksma %s\"\n.SH NAME\nkoksma \\- sampling patterns for ray tracing, and the error "
           "that they leave\n.SH SYNOPSIS\n.B koksma\n.I COMMAND\n[\\fIOPTION\\fR]... [\\fIOPERAND\\fR]...\n"
           ".SH COMMANDS\n",
           koksma_version());
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf(".TP\n.BR koksma\\-%s (1)\n", command->name);
        put(command->summary);
        printf("\n");
    }
    printf(
        ".SH \"EXIT STATUS\"\n0 done; 1 it ran and the answer is no; 2 the command line is wrong; 3 a named file is "
        "missing or\nmalformed; 4 the system failed; 130 interrupted, finished results are kept.\n"
        ".SH ENVIRONMENT\n.TP\n.B KOKSMA_KERNELS\nthe instruction set of the inner loops: ref, baseline, avx2 or "
        "avx512.\nBy default it is the fastest that the processor has. Results of the last three have equal "
        "bits.\n");
}

static int run(const cli_arguments *arguments)
{
    if (arguments->n_operands == 0) {
        put_overview();
        return CLI_YES;
    }
    const cli_command *command = cli_command_find(arguments->operands[0]);
    if (command && arguments->n_operands == 1) {
        put_page(command);
        return CLI_YES;
    }
    return cli_usage_error(arguments, "it takes the name of one command, or nothing for the page of koksma itself");
}

static const cli_option options[] = {{0}};

const cli_command cli_command_manual = {
    .name = "manual",
    .summary = "print a manual page, as man reads it",
    .synopsis = "[COMMAND]",
    .details = "koksma manual generate | man -l -",
    .options = options,
    .run = run,
};
