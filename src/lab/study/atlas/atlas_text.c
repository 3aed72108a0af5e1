/* SPDX-License-Identifier: Apache-2.0 */
/*
 * Text of the atlas: HTML with its special characters escaped, the head of a page, and the texts that the library carries,
 * documents and stored rows. A page that names a document links to a copy of it in docs/, made here.
 */
#include "study/atlas/atlas.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/files.h"
#include "study/report/document.h"

#include "study/atlas/texts.h"

enum { TEXT = 512 };

const char *koksma__atlas_text(const char *name, size_t *size)
{
    for (size_t i = 0; i < sizeof embedded_texts / sizeof *embedded_texts; i++) {
        if (!strcmp(embedded_texts[i].name, name)) {
            *size = embedded_texts[i].size;
            return embedded_texts[i].text;
        }
    }
    return NULL;
}

static void put_text(FILE *f, const char *text, size_t length)
{
    for (size_t i = 0; i < length && text[i]; i++) {
        const char c = text[i];
        const char *name = c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : NULL;
        name ? fputs(name, f) : putc(c, f);
    }
}

void koksma__atlas_print(FILE *f, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    for (const char *at = format; *at;) {
        const size_t plain = strcspn(at, "%");
        fwrite(at, 1, plain, f);
        at += plain;
        if (!strncmp(at, "%zu", 3)) {
            fprintf(f, "%zu", va_arg(arguments, size_t));
            at += 3;
        } else if (*at) { /* %s or %.*s */
            const size_t length = at[1] == '.' ? (size_t)va_arg(arguments, int) : SIZE_MAX;
            put_text(f, va_arg(arguments, const char *), length);
            at += at[1] == '.' ? 4 : 2;
        }
    }
    va_end(arguments);
}

koksma_status koksma__atlas_list(const koksma__json_node *node, const char *key, size_t most, koksma__json_node *list,
                                 size_t *n)
{
    *n = 0;
    if (!koksma__json_has(node, key)) {
        return KOKSMA_OK;
    }
    KOKSMA__TRY(koksma__json_member(node, key, list));
    return koksma__json_length(list, most, n);
}

void koksma__atlas_put_head(FILE *f, const char *title)
{
    koksma__atlas_print(
        f,
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>%s</title>\n<meta "
        "name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n",
        title);
    koksma__page_style(f);
    fputs("<style>@media (max-width: 40rem) { .many .pm { white-space: normal; } .many :is(td, th) { padding: .2rem "
          ".1rem; font-size: .73rem; } "
          ".many thead th { font-size: .66rem; } .many tbody th, .many td:nth-child(2), .many code { overflow-wrap: "
          "anywhere; } "
          ".many code { display: block; min-width: 7.4rem; text-align: left; } }</style>\n",
          f);
    fputs("</head>\n<body>\n<main>\n", f);
}

koksma_status koksma__atlas_close(FILE *f, const char *folder, const char *name, char **text, koksma_status status)
{
    const bool failed = fclose(f) || !*text;
    status = status || !failed ? status : koksma__fail_memory(TEXT);
    status = status ? status : koksma__atomic_put(folder, name, *text, strlen(*text));
    free(*text);
    return status;
}

koksma_status koksma__atlas_begin_link(FILE *out, const char *folder, const char *path, bool *is_link)
{
    char name[TEXT], file[TEXT + 16], *text = NULL;
    size_t size, source_size;
    snprintf(name, sizeof name, "%.*s", (int)strcspn(path, "`"), path);
    char *slash = strrchr(name, '/'), *ending = slash ? strstr(slash, ".md") : NULL;
    const char *source = NULL;
    const size_t length = strlen(name);
    *is_link = !slash && !strchr(name, ' ') && length > 5 && !strcmp(name + length - 5, ".html");
    if (*is_link) {
        koksma__atlas_print(out, "<a href=\"%s\">", name);
    }
    if (ending && !ending[3]) {
        *ending = '\0';
        memmove(name, slash + 1, strlen(slash));
        source = koksma__atlas_text(name, &source_size);
    }
    if (!source) {
        return KOKSMA_OK;
    }
    *is_link = true;
    snprintf(file, sizeof file, "docs/%s.html", name);
    koksma__atlas_print(out, "<a href=\"%s\">", file);
    FILE *f = open_memstream(&text, &size);
    KOKSMA__REQUIRE_MEMORY(f, source_size);
    koksma__atlas_put_head(f, name);
    fputs("<p class=\"kicker\"><a href=\"../index.html\">Atlas</a></p>\n<div class=\"commands\"><pre>", f);
    for (size_t i = 0; i < source_size; i++) { /* lines of a paragraph are joined */
        const bool inside =
            source[i] == '\n' && !strchr("\n|", i ? source[i - 1] : '\n') && isalnum((unsigned char)source[i + 1]);
        put_text(f, inside ? " " : source + i, 1);
    }
    fputs("</pre></div>\n</main>\n</body>\n</html>\n", f);
    return koksma__atlas_close(f, folder, file, &text, KOKSMA_OK);
}
