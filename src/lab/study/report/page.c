/* SPDX-License-Identifier: Apache-2.0 */
/* The report's page as the build embeds it: page/page.html with its script, cut in two where the data are
   inserted. The first half has the placeholders {{title}} and {{numbers}}, in this order, for texts that depend on the
   kind of the page. */
#include "study/report/page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/files.h"
#include "study/report/page_text.h"

static const char *const titles[] = {[KOKSMA__PAGE_STUDY] = "koksma: report of a study",
                                     [KOKSMA__PAGE_IMAGES] = "koksma: errors of images",
                                     [KOKSMA__PAGE_DATASHEET] = "koksma: datasheet of a sampler"};

static const char beside[] = "All of its numbers are in <a href=\"report.json\">report.json</a> beside it.";
static const char inside[] =
    "All of its numbers are in this file, in the element with the id <code>data</code>, as JSON; "
    "<code>koksma datasheet SAMPLER -o sheet.json</code> writes them.";

/* A page is written as these parts. */
enum { PARTS = 7 };
typedef struct part {
    const char *text;
    size_t length;
} part;

static part part_of(const char *text)
{
    return (part){text, strlen(text)};
}

/* Cuts the text at a placeholder: the part before it is returned, and *text becomes the rest behind it. */
static part cut(const char **text, const char *placeholder)
{
    const char *begin = *text, *at = strstr(begin, placeholder);
    *text = at + strlen(placeholder);
    return (part){begin, (size_t)(at - begin)};
}

static void make_parts(koksma__page_kind kind, const char *json, part parts[PARTS])
{
    const char *head = koksma__page_head;
    parts[0] = cut(&head, "{{title}}");
    parts[1] = part_of(titles[kind]);
    parts[2] = cut(&head, "{{numbers}}");
    parts[3] = part_of(kind == KOKSMA__PAGE_DATASHEET ? inside : beside);
    parts[4] = part_of(head);
    parts[5] = part_of(json);
    parts[6] = part_of(koksma__page_foot);
}

char *koksma__page_text(koksma__page_kind kind, const char *json)
{
    part parts[PARTS];
    size_t size = 1, used = 0;
    make_parts(kind, json, parts);
    for (int i = 0; i < PARTS; i++) {
        size += parts[i].length;
    }
    char *text = malloc(size);
    for (int i = 0; text && i < PARTS; i++) {
        memcpy(text + used, parts[i].text, parts[i].length);
        used += parts[i].length;
    }
    if (text) {
        text[used] = '\0';
    }
    return text;
}

static koksma_status write_file(const char *folder, const char *name, const part *parts, int n)
{
    koksma__atomic_file file;
    koksma_status status = koksma__atomic_open(folder, name, &file);
    if (!status) {
        for (int i = 0; i < n; i++) {
            fwrite(parts[i].text, 1, parts[i].length, file.stream);
        }
        status = koksma__atomic_close(&file, true);
    }
    return status;
}

koksma_status koksma__page_write(const char *folder, koksma__page_kind kind, const char *json)
{
    part parts[PARTS];
    make_parts(kind, json, parts);
    const koksma_status status = write_file(folder, "report.json", (const part[]){part_of(json), part_of("\n")}, 2);
    return status ? status : write_file(folder, "report.html", parts, PARTS);
}
