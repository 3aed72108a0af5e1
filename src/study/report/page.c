/* SPDX-License-Identifier: Apache-2.0 */
/* The report's page as the build embeds it: page/page.html with its script, cut in two where the data are
   inserted. */
#include "study/report/page.h"

#include <stdio.h>

#include "core/atomic_file.h"
#include "study/report/page_text.h"

const char *koksma__page_before(void)
{
    return koksma__page_head;
}

const char *koksma__page_after(void)
{
    return koksma__page_foot;
}

/* Writes the texts of a NULL-terminated array to a file in the folder. */
static koksma_status write_file(const char *folder, const char *name, const char *const *parts)
{
    koksma__atomic_file file;
    koksma_status status = koksma__atomic_open(folder, name, &file);
    if (!status) {
        for (; *parts; parts++) {
            fputs(*parts, file.stream);
        }
        status = koksma__atomic_close(&file, true);
    }
    return status;
}

koksma_status koksma__page_write(const char *folder, const char *json)
{
    const koksma_status status = write_file(folder, "report.json", (const char *const[]){json, "\n", NULL});
    return status ? status
                  : write_file(folder, "report.html",
                               (const char *const[]){koksma__page_head, json, koksma__page_foot, NULL});
}
