/* SPDX-License-Identifier: Apache-2.0 */
#include "study/report/report_table.h"
#include "core/c_locale.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void koksma__grid_open(koksma__grid *g, koksma__html *html, const char *name)
{
    *g = (koksma__grid){.html = html};
    snprintf(g->name, sizeof g->name, "%s", name);
    koksma__html_add(html,
                     "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"table %s\"><table>\n"
                     "<thead><tr>",
                     name);
}

static const char *comma(const koksma__html *csv)
{
    return csv->size == 0 || csv->text[csv->size - 1] == '\n' ? "" : ",";
}

void koksma__csv_text(koksma__html *csv, const char *text)
{
    koksma__html_add(csv, "%s\"", comma(csv));
    for (; *text; text++) {
        koksma__html_add(csv, *text == '"' ? "\"\"" : "%c", *text);
    }
    koksma__html_add(csv, "\"");
}

void koksma__csv_number(koksma__html *csv, double value)
{
    char text[40] = "";
    if (!isnan(value)) {
        koksma__snprintf(text, sizeof text, "%.17g", value);
    }
    koksma__html_add(csv, "%s%s", comma(csv), text);
}

void koksma__csv_row(koksma__html *csv)
{
    koksma__html_add(csv, "\r\n");
}

void koksma__csv_close(koksma__html *csv, koksma__html *html, const char *name)
{
    koksma__csv_row(csv);
    koksma__html_add(html, "<p class=\"csv\"><a download=\"%s.csv\" href=\"data:text/csv;base64,", name);
    koksma__html_base64(html, (const unsigned char *)csv->text, csv->failed ? 0 : csv->size);
    koksma__html_add(html, "\">%s.csv</a></p>\n", name);
    html->failed |= csv->failed;
    free(csv->text);
    *csv = (koksma__html){0};
}

void koksma__grid_head(koksma__grid *g, const char *text)
{
    koksma__html_add(g->html, "<th scope=\"col\">");
    koksma__html_text(g->html, text);
    koksma__html_add(g->html, "</th>");
    koksma__csv_text(&g->csv, text);
}

void koksma__grid_head_interval(koksma__grid *g, const char *text)
{
    char more[160];
    koksma__grid_head(g, text);
    snprintf(more, sizeof more, "%.150s low", text);
    koksma__csv_text(&g->csv, more);
    snprintf(more, sizeof more, "%.150s high", text);
    koksma__csv_text(&g->csv, more);
}

void koksma__grid_row(koksma__grid *g)
{
    koksma__html_add(g->html, g->in_body ? "</tr>\n<tr>" : "</tr></thead>\n<tbody><tr>");
    koksma__csv_row(&g->csv);
    g->in_body = true;
}

void koksma__grid_text(koksma__grid *g, const char *text)
{
    koksma__html_add(g->html, "<td>");
    koksma__html_text(g->html, text);
    koksma__html_add(g->html, "</td>");
    koksma__csv_text(&g->csv, text);
}

void koksma__grid_number(koksma__grid *g, double value, int digits)
{
    if (isnan(value)) {
        koksma__html_add(g->html, "<td>&#8211;</td>");
    } else {
        koksma__html_add(g->html, "<td>%.*g</td>", digits, value);
    }
    koksma__csv_number(&g->csv, value);
}

void koksma__grid_interval(koksma__grid *g, koksma__estimate e, int digits)
{
    if (isnan(e.value)) {
        koksma__html_add(g->html, "<td>&#8211;</td>");
    } else if (isnan(e.low) || isnan(e.high)) {
        koksma__html_add(g->html, "<td>%.*g <span class=\"pm\">&#177; ?</span></td>", digits, e.value);
    } else if (e.low == e.high) {
        koksma__html_add(g->html, "<td>%.*g</td>", digits, e.value);
    } else if (fabs((e.high - e.value) - (e.value - e.low)) < 1e-6 * (e.high - e.low)) {
        koksma__html_add(g->html, "<td>%.*g <span class=\"pm\">&#177; %.2g</span></td>", digits, e.value,
                         e.high - e.value);
    } else {
        koksma__html_add(g->html, "<td>%.*g <span class=\"pm\">%.2g &#8230; %.2g</span></td>", digits, e.value, e.low,
                         e.high);
    }
    koksma__csv_number(&g->csv, e.value);
    koksma__csv_number(&g->csv, e.low);
    koksma__csv_number(&g->csv, e.high);
}

void koksma__grid_close(koksma__grid *g)
{
    koksma__html_add(g->html, g->in_body ? "</tr></tbody></table></div>\n" : "</tr></thead></table></div>\n");
    koksma__csv_close(&g->csv, g->html, g->name);
}
