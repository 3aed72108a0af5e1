/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Puts the names of table members into help texts. A synopsis, an option's argument or help, or the details of a
 * command may contain a placeholder in braces. cli_expand replaces it by names, so that a new member of a table
 * appears in help, completion and manual pages:
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

enum { POOL = 1 << 15, MOST_COMMANDS = 32 };

static char pool[POOL];
static size_t used;

/* Appends to the text at the end of the pool. */
static void put(const char *text, size_t length)
{
    if (used + length + 1 > sizeof pool) {
        abort();
    }
    memcpy(pool + used, text, length);
    used += length;
}

/* Appends a paragraph "name: meaning.". */
static void put_meaning(const char *name, const char *meaning)
{
    put(name, strlen(name));
    put(": ", 2);
    put(meaning, strlen(meaning));
    put(".\n", 2);
}

static void put_curve_meanings(cli_curve_list list)
{
    const cli_curve *curve;
    for (size_t i = 0; (curve = cli_curve_at(i)); i++) {
        if (cli_curve_find(list, curve->name) == curve) {
            put_meaning(curve->name, curve->meaning);
        }
    }
}

const char *cli_image_formats(const char *comma, const char *last, char *text, size_t size)
{
    const char *name, *left_out;
    size_t n = 0;
    *text = '\0';
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)); i++) {
        const char *next = koksma_image_format(i + 1, &left_out);
        n += (size_t)snprintf(text + n, size - n, ".%s%s", name,
                              !next                                   ? ""
                              : koksma_image_format(i + 2, &left_out) ? comma
                                                                      : last);
    }
    return text;
}

/* Appends the text that replaces a placeholder, which is given without its braces. Returns false if there is no such
   placeholder. */
static bool put_placeholder(const char *name)
{
    char text[512] = "", option[32] = "";
    const koksma_property *property;
    const cli_curve_list list = strncmp(name, "chart", 5) == 0 ? CLI_DRAWN : CLI_PRINTED;
    if (!strcmp(name, "curve") || !strcmp(name, "chart")) {
        cli_curve_names(list, NULL, "|", "|", text, sizeof text);
    } else if (sscanf(name, "curve:%31s", option) == 1 || sscanf(name, "chart:%31s", option) == 1) {
        cli_curve_names(list, option, ", ", ", ", text, sizeof text);
    } else if (!strcmp(name, "curve-meanings") || !strcmp(name, "chart-meanings")) {
        put_curve_meanings(list);
    } else if (!strcmp(name, "property-meanings")) {
        for (size_t i = 0; (property = koksma_property_at(i)); i++) {
            put_meaning(property->name, property->meaning);
        }
    } else if (!strcmp(name, "image-formats")) {
        cli_image_formats(", ", " or ", text, sizeof text);
    } else if (!strcmp(name, "images")) {
        cli_image_formats("|", "|", text, sizeof text);
    } else if (!strcmp(name, "lists")) {
        cli_list_names("|", text, sizeof text);
    } else {
        return false;
    }
    put(text, strlen(text));
    return true;
}

static const char *expand(const char *text)
{
    if (!text || !strchr(text, '{')) {
        return text;
    }
    const size_t start = used;
    for (const char *at = text; *at;) {
        char name[48];
        int length = 0;
        if (sscanf(at, "{%47[a-z:-]}%n", name, &length) == 1 && length > 0 && put_placeholder(name)) {
            at += length;
        } else {
            put(at++, 1);
        }
    }
    put("", 1);
    return pool + start;
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
