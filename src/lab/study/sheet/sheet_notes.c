/* SPDX-License-Identifier: Apache-2.0 */
/* Functions that all parts of a datasheet share: progress over all parts, notes on what is left out, and
   words of the commands that reproduce the numbers. */
#include "study/sheet/sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/parallel.h"
#include "core/status.h"

/* ---- Progress ---------------------------------------------------------------------------------------------- */

/* Reports progress. A part may take several passes, each of which reports fractions from 0 to 1; each pass accounts
   for the fraction pass_share of what remained of the part before it. */
static bool keep_going(void *context, double fraction)
{
    koksma__sheet *sheet = context;
    if (fraction < sheet->fraction) {
        sheet->passed += (1 - sheet->passed) * sheet->pass_share;
    }
    sheet->fraction = fraction;
    const double now = sheet->passed + (1 - sheet->passed) * sheet->pass_share * fraction;
    return koksma__keep_going(sheet->run, sheet->done + sheet->share * now);
}

koksma_run koksma__sheet_part(koksma__sheet *sheet, double share, double pass_share)
{
    sheet->done += sheet->share;
    sheet->share = share;
    sheet->pass_share = pass_share;
    sheet->passed = sheet->fraction = 0;
    return (koksma_run){.threads = sheet->run ? sheet->run->threads : 0, .keep_going = keep_going, .context = sheet};
}

static bool keep_going_in_set(void *context, double fraction)
{
    (void)fraction; /* a single set does not count as progress */
    return keep_going(context, ((koksma__sheet *)context)->fraction);
}

koksma_run koksma__sheet_one_set(koksma__sheet *sheet)
{
    return (koksma_run){.threads = 1, .keep_going = keep_going_in_set, .context = sheet};
}

/* ---- Notes and words of commands ------------------------------------------------------------------------------------ */

void koksma__sheet_note_error(koksma__sheet *sheet, const char *what)
{
    if (!sheet->n_notes++) {
        koksma__doc_list(&sheet->notes, "left-out", false);
    }
    const char *text = koksma_error_text();
    const size_t length = strlen(what);
    const bool named = !strncmp(text, what, length) && !strncmp(text + length, ": ", 2);
    koksma__doc_item(&sheet->notes, "`%s`: %s", what, text + (named ? length + 2 : 0));
}

static bool is_plain(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || strchr("@%+=:,./-_", c);
}

void koksma__sheet_word(const char *text, char *out, size_t size)
{
    bool plain = *text;
    size_t used = 0;
    for (const char *at = text; *at; at++) {
        plain &= is_plain(*at);
    }
    if (plain) {
        snprintf(out, size, "%s", text);
        return;
    }
    out[used++] = '\'';
    for (const char *at = text; *at && used + 6 < size; at++) {
        used += (size_t)snprintf(out + used, size - used, *at == '\'' ? "'\\''" : "%c", *at);
    }
    snprintf(out + used, size - used, "'");
}

koksma__sheet_operand koksma__sheet_source(const koksma__sheet_sampler *sampler, size_t n, int dim)
{
    koksma__sheet_operand operand;
    char text[2 * KOKSMA_MAX_SPEC], deep[16] = "";
    if (dim != 2) {
        snprintf(deep, sizeof deep, "@%d", dim);
    }
    snprintf(text, sizeof text, "pattern:%s@%zu%s", sampler->text, n, deep);
    koksma__sheet_word(text, operand.text, sizeof operand.text);
    return operand;
}
