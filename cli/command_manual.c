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

/* Prints the title line of a page, whose name is in capitals as in other manuals, and its NAME. */
static void put_head(const char *command, const char *summary)
{
    printf(".TH KOKSMA%s", *command ? "\\-" : "");
    for (const char *at = command; *at; at++) {
        putchar(toupper((unsigned char)*at));
    }
    printf(" 1 \"\" \"koksma %s\"\n.nh\n.ad l\n.SH NAME\nkoksma%s%s \\- ", koksma_version(), *command ? "\\-" : "",
           command);
    put(summary);
}

/* Prints the examples unchanged, and what follows them. With less than the usual indent, lines of 78 characters fit a
   terminal of 80. */
static void put_tail(const char *examples, const char *more)
{
    if (examples) {
        printf(".SH EXAMPLES\n.nf\n.in 2n\n");
        put(examples);
        printf(".in\n.fi\n");
    }
    printf(
        ".SH \"EXIT STATUS\"\n0 done; 1 it ran and the answer is no; 2 the command line is wrong; 3 a named file is "
        "missing,\nmalformed or of a kind that is not read; 4 the system failed; 130 interrupted, finished results "
        "are kept.\n%s",
        more);
}

static void put_page(const cli_command *command)
{
    char paragraph[CLI_PARAGRAPH];
    bool apart;
    put_head(command->name, command->summary);
    printf("\n.SH SYNOPSIS\n");
    for (const char *use = command->synopsis; use; use = strchr(use, '\n')) {
        use += *use == '\n';
        snprintf(paragraph, sizeof paragraph, "%.*s\n", (int)strcspn(use, "\n"), use);
        printf("%s.B koksma %s\n", use == command->synopsis ? "" : ".br\n", command->name);
        put(paragraph);
    }
    printf(command->details ? ".SH DESCRIPTION\n" : "");
    for (const char *at = command->details; at && (at = cli_next_paragraph(at, paragraph, &apart));) {
        printf(apart ? ".PP\n" : ".br\n");
        put(paragraph);
        printf("\n");
    }
    printf(".SH OPTIONS\n");
    for (const cli_option *o = command->options; o->name; o++) {
        char letter[32];
        snprintf(letter, sizeof letter, "\\fB\\-%c\\fR, ", o->letter);
        printf(".TP\n%s\\fB\\-\\-", o->letter ? letter : "");
        put(o->name);
        printf("\\fR%s", o->argument ? " \\fI" : "");
        put(o->argument ? o->argument : "");
        printf("%s\n", o->argument ? "\\fR" : "");
        put(o->help);
        printf("\n");
    }
    printf(".TP\n\\fB\\-h\\fR, \\fB\\-\\-help\\fR\nprint the text of this page\n");
    put_tail(command->examples, ".SH \"SEE ALSO\"\n.BR koksma (1)\n");
}

static void put_overview(void)
{
    const cli_command *command;
    put_head("", "sampling patterns for ray tracing, and the error that they leave");
    printf("\n.SH SYNOPSIS\n.B koksma\n.I COMMAND\n[\\fIOPTION\\fR]... [\\fIOPERAND\\fR]...\n.SH COMMANDS\n");
    for (size_t i = 0; (command = cli_command_at(i)); i++) {
        printf(".TP\n.BR koksma\\-%s (1)\n", command->name);
        put(command->summary);
        printf("\n");
    }
    put_tail(
        cli_overview_examples,
        ".SH ENVIRONMENT\n.TP\n.B KOKSMA_KERNELS\nthe instruction set of the inner loops: ref, baseline, avx2 or "
        "avx512.\nThe default is the fastest one that the processor supports. baseline, avx2 and avx512 give "
        "results with equal bits.\n");
}

static int run(const cli_args *args)
{
    if (args->n_operands > 1) {
        return cli_error(args, "it takes the name of one command, or nothing for the page of koksma itself");
    }
    const cli_command *command = args->n_operands ? cli_command_find(args->operands[0]) : NULL;
    if (command) {
        put_page(command);
    } else if (args->n_operands) {
        cli_no_command(args->command->name, args->operands[0]);
        return CLI_USAGE;
    } else {
        put_overview();
    }
    return CLI_YES;
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
