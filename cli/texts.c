/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Help texts: their lines, and the names of table members in them. A synopsis, an option's argument or help, or the
 * details of a command may contain a placeholder in braces. cli_expand replaces it by names, so that a new member of a
 * table appears in help, completion and manual pages:
 *
 *     {curve}, {chart}                     power|rings|...: the curves of `koksma curve`, and those of `plot`
 *     {curve:OPTION}, {chart:OPTION}       power, rings, ...: those of them that take OPTION
 *     {curve-meanings}, {chart-meanings}   a paragraph for each of these curves
 *     {property-meanings}                  a paragraph for each property of `verify`
 *     {image-formats}, {images}            .exr, .png, .pfm or .jpg; .exr|.png|.pfm|.jpg
 *     {lists}                              patterns|measures|...: what `list` lists
 *
 * Braces with any other text are kept. The texts are kept until the program ends, in one block of fixed size. The
 * program aborts if a text does not fit, which is a bug.
 */
#include "cli.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <koksma/image.h>
#include <koksma/verify.h>

#include "curves.h"

enum { POOL = 1 << 15, LONGEST = 1 << 13, MOST_COMMANDS = 32 };

static const char *image_formats(const char *comma, const char *last, char *text, size_t size)
{
    const char *name, *left_out;
    *text = '\0';
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)); i++) {
        const bool more = koksma_image_format(i + 1, &left_out);
        CLI_APPEND(text, size, "%s.%s", !i ? "" : more ? comma : last, name);
    }
    return text;
}

/* Writes a paragraph "name: meaning." for each curve of a list. */
static const char *curve_meanings(cli_curve_list list, char text[LONGEST])
{
    const cli_curve *curve;
    for (size_t i = 0; (curve = cli_curve_at(i)); i++) {
        if (cli_curve_find(list, curve->name) == curve) {
            CLI_APPEND(text, LONGEST, "%s: %s.\n", curve->name, curve->meaning);
        }
    }
    return text;
}

static const char *property_meanings(char text[LONGEST])
{
    for (size_t i = 0; koksma_property_at(i); i++) {
        CLI_APPEND(text, LONGEST, "%s: %s.\n", koksma_property_at(i)->name, koksma_property_at(i)->meaning);
    }
    return text;
}

/* Writes what replaces a placeholder, which is given without its braces. Returns NULL if there is no such one. */
static const char *replacement(const char *name, char text[LONGEST])
{
    char option[32];
    const cli_curve_list list = strncmp(name, "chart", 5) == 0 ? CLI_DRAWN : CLI_PRINTED;
    *text = '\0';
    return !strcmp(name, "curve") || !strcmp(name, "chart") ? cli_curve_names(list, NULL, "|", "|", text, LONGEST)
           : sscanf(name, "curve:%31s", option) == 1 || sscanf(name, "chart:%31s", option) == 1
               ? cli_curve_names(list, option, ", ", ", ", text, LONGEST)
           : !strcmp(name, "curve-meanings") || !strcmp(name, "chart-meanings") ? curve_meanings(list, text)
           : !strcmp(name, "property-meanings")                                 ? property_meanings(text)
           : !strcmp(name, "image-formats") ? image_formats(", ", " or ", text, LONGEST)
           : !strcmp(name, "images")        ? image_formats("|", "|", text, LONGEST)
           : !strcmp(name, "lists")         ? cli_list_names("|", text, LONGEST)
                                            : NULL;
}

static const char *expand(const char *text)
{
    static char pool[POOL], by[LONGEST];
    static size_t used;
    if (!text || !strchr(text, '{')) {
        return text;
    }
    char *const start = pool + used;
    for (const char *at = text; *at;) {
        char name[48];
        int length = 0;
        const bool is = sscanf(at, "{%47[a-z:-]}%n", name, &length) == 1 && length > 0 && replacement(name, by);
        used += (size_t)snprintf(pool + used, sizeof pool - used, "%.*s", is ? LONGEST : 1, is ? by : at);
        at += is ? length : 1;
        if (used + 1 >= sizeof pool) {
            abort();
        }
    }
    used++;
    return start;
}

const cli_command *cli_expand(const cli_command *command, size_t i)
{
    static cli_command expanded[MOST_COMMANDS];
    static cli_option options[MOST_COMMANDS][CLI_MAX_OPTIONS + 1];
    if (i >= MOST_COMMANDS) {
        abort();
    }
    if (!expanded[i].name) {
        for (size_t k = 0; command->options[k].name; k++) {
            options[i][k] = command->options[k];
            options[i][k].argument = expand(command->options[k].argument);
            options[i][k].help = expand(command->options[k].help);
        }
        expanded[i] = *command;
        expanded[i].synopsis = expand(command->synopsis);
        expanded[i].details = expand(command->details);
        expanded[i].options = options[i];
    }
    return &expanded[i];
}

/* ---- Lines of at most 80 columns, with as many words as fit. A non-breaking blank is TIED until it is printed. ---- */

enum { WIDTH = 80, TIED = '\x1f' };

static void put(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        putchar(text[i] == TIED ? ' ' : text[i]);
    }
}

/* Returns how many bytes of a word go on the current line, which has `room` columns left: those up to the last '|'
   that fits, or all. */
static size_t beginning(const char *word, size_t length, size_t room)
{
    for (size_t i = room < length ? room : 0; i > 0; i--) {
        if (word[i - 1] == '|') {
            return i;
        }
    }
    return length;
}

/* Prints the words of `text` and ends the line. column: where the cursor is; indent: where further lines begin. */
static void fill(const char *text, size_t column, size_t indent)
{
    bool first = true; /* the next word is the first of its line */
    for (const char *at = text + strspn(text, " "); *at;) {
        const size_t length = strcspn(at, " ");
        if (!first && column + 1 + length > WIDTH) {
            first = true;
            printf("\n%*s", (int)(column = indent), "");
        } else if (!first) {
            putchar(' ');
            column++;
        }
        const size_t part = beginning(at, length, column < WIDTH ? WIDTH - column : 0);
        put(at, part);
        at += part + strspn(at + part, " ");
        column += part;
        first = false;
        if (part < length) {
            first = true;
            printf("\n%*s", (int)(column = indent), "");
        }
    }
    putchar('\n');
}

/* Prints one usage of a synopsis like fill, but keeps text in brackets, and an option with its argument, on one line. */
static void fill_use(const char *use, size_t column, size_t indent)
{
    char tied[CLI_PARAGRAPH];
    int depth = 0;
    bool option = false; /* the current word is an option or its argument */
    size_t i = 0;
    for (; use[i] && use[i] != '\n' && i + 1 < sizeof tied; i++) {
        depth += (use[i] == '[') - (use[i] == ']');
        option = use[i] == '-' && (i == 0 || use[i - 1] == ' ') ? true : option;
        tied[i] = use[i] == ' ' && (depth > 0 || option) ? (char)TIED : use[i];
        option = use[i] == ' ' ? false : option;
    }
    tied[i] = '\0';
    fill(tied, column, indent);
}

/* Whether a line begins with a word that ends in a colon. */
static bool is_heading(const char *line)
{
    const size_t length = strcspn(line, " \n");
    return length > 1 && line[length - 1] == ':';
}

const char *cli_next_paragraph(const char *text, char paragraph[CLI_PARAGRAPH], bool *apart)
{
    *apart = *text == '\n';
    text += strspn(text, "\n");
    if (!*text) {
        return NULL;
    }
    size_t used = 0;
    do {
        const size_t length = strcspn(text, "\n");
        used +=
            (size_t)snprintf(paragraph + used, CLI_PARAGRAPH - used, "%s%.*s", used ? " " : "", (int)length, text);
        text += length + (text[length] == '\n');
    } while (*text && *text != '\n' && !is_heading(text) && used < CLI_PARAGRAPH - 256);
    return text;
}

/* ---- --help ------------------------------------------------------------------------------------------- */

enum { LEFT = 22, HELP_COLUMN = 29 }; /* the width of "--NAME ARGUMENT", and the column where the help begins */

static void print_option(char letter, const char *name, const char *argument, const char *help)
{
    char left[160];
    const int used = snprintf(left, sizeof left, argument ? "--%s %s" : "--%s", name, argument);
    printf(letter ? "  -%c, " : "  %c   ", letter ? letter : ' ');
    if (used > LEFT) {
        fill_use(left, HELP_COLUMN - LEFT - 1, HELP_COLUMN - LEFT + 3);
        printf("%*s", HELP_COLUMN, "");
    } else {
        printf("%-*s ", LEFT, left);
    }
    fill(help, HELP_COLUMN, HELP_COLUMN);
}

void cli_print_help(const cli_command *command)
{
    char paragraph[CLI_PARAGRAPH];
    bool apart;
    fill(command->summary, (size_t)printf("koksma %s: ", command->name), 2);
    printf("\n");
    const char *begin = "usage:";
    for (const char *use = command->synopsis; use; use = strchr(use, '\n')) {
        use += *use == '\n';
        const int column = printf("%-6s koksma %s ", begin, command->name);
        fill_use(use, (size_t)column, (size_t)column);
        begin = "";
    }
    printf("\n");
    for (const cli_option *o = command->options; o->name; o++) {
        print_option(o->letter, o->name, o->argument, o->help);
    }
    print_option('h', "help", NULL, "this text");
    printf(command->details ? "\n" : "");
    for (const char *at = command->details; at && (at = cli_next_paragraph(at, paragraph, &apart));) {
        printf(apart ? "\n" : "");
        fill(paragraph, 0, is_heading(paragraph) ? 2 : 0);
    }
    if (command->examples) {
        printf("\nexamples:\n");
        for (const char *at = command->examples; *at; at += strcspn(at, "\n"), at += *at == '\n') {
            printf("  %.*s\n", (int)strcspn(at, "\n"), at);
        }
    }
}
