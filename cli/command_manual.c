/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma manual`: prints manual pages, from the tables that parse the command line and print --help. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "cli.h"

/* Prints a text for roff: escapes backslashes, hyphens, and a dot or quote at the beginning of a line. A line may
   break between alternatives. */
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
    printf(".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nprint the text of this page\n");
}

static void put_synopsis(const char *name, const char *synopsis)
{
    for (const char *use = synopsis; use; use = strchr(use, '\n')) {
        char text[512];
        use += *use == '\n';
        snprintf(text, sizeof text, "%.*s", (int)strcspn(use, "\n"), use);
        printf("%s.B koksma %s\n", use == synopsis ? "" : ".br\n", name);
        put(text);
        printf("\n");
    }
}

static void put_details(const char *details)
{
    char paragraph[CLI_PARAGRAPH];
    bool apart;
    printf(".SH DESCRIPTION\n");
    for (const char *at = details; (at = cli_next_paragraph(at, paragraph, &apart));) {
        printf(apart ? ".PP\n" : ".br\n");
        put(paragraph);
        printf("\n");
    }
}

/* Prints command lines unchanged. With less than the usual indent, lines of 78 characters fit a terminal of 80. */
static void put_examples(const char *examples)
{
    printf(".SH EXAMPLES\n.nf\n.in 2n\n");
    put(examples);
    printf(".in\n.fi\n");
}

static void put_exit_status(void)
{
    printf(
        ".SH \"EXIT STATUS\"\n0 done; 1 it ran and the answer is no; 2 the command line is wrong; 3 a named file is "
        "missing,\nmalformed or of a kind that is not read; 4 the system failed; 130 interrupted, finished results "
        "are kept.\n");
}

/* Prints the title line of a page, whose name is in capitals as in other manuals. */
static void put_title(const char *command)
{
    printf(".TH KOKSMA");
    for (const char *at = command; *at; at++) {
        printf(at == command ? "\\-%c" : "%c", toupper((unsigned char)*at));
    }
    printf(" 1 \"\" \"koksma %s\"\n", koksma_version());
}

static void put_page(const cli_command *command)
{
    put_title(command->name);
    printf(".nh\n.ad l\n.SH NAME\nkoksma\\-%s \\- ", command->name);
    put(command->summary);
    printf("\n.SH SYNOPSIS\n");
    put_synopsis(command->name, command->synopsis);
    if (command->details) {
        put_details(command->details);
    }
    put_options(command);
    if (command->examples) {
        put_examples(command->examples);
    }
    put_exit_status();
    printf(".SH \"SEE ALSO\"\n.BR koksma (1)\n");
}

static void put_overview(void)
{
    const cli_command *command;
    put_title("");
    printf(".nh\n.ad l\n.SH NAME\nkoksma \\- sampling patterns for ray tracing, and the error "
           "that they leave\n.SH SYNOPSIS\n.B koksma\n.I COMMAND\n[\\fIOPTION\\fR]... [\\fIOPERAND\\fR]...\n"
           ".SH COMMANDS\n");
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf(".TP\n.BR koksma\\-%s (1)\n", command->name);
        put(command->summary);
        printf("\n");
    }
    put_exit_status();
    printf(".SH ENVIRONMENT\n.TP\n.B KOKSMA_KERNELS\nthe instruction set of the inner loops: ref, baseline, avx2 or "
           "avx512.\nThe default is the fastest one that the processor supports. baseline, avx2 and avx512 give "
           "results with equal bits.\n");
    put_examples(cli_overview_examples);
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
    if (arguments->n_operands == 1) {
        cli_no_command(arguments->command->name, arguments->operands[0]);
        return CLI_USAGE;
    }
    return cli_usage_error(arguments, "it takes the name of one command, or nothing for the page of koksma itself");
}

static const cli_option options[] = {{0}};

const cli_command cli_command_manual = {
    .name = "manual",
    .summary = "print a manual page in the format of man",
    .synopsis = "[COMMAND]",
    .examples = "koksma manual rank | man -l -\n",
    .options = options,
    .run = run,
};
