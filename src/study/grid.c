/* SPDX-License-Identifier: Apache-2.0 */
#include "study/grid.h"
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

static void add_csv(koksma__grid *g, const char *text)
{
    const bool starts = g->csv.size == 0 || g->csv.text[g->csv.size - 1] == '\n';
    koksma__html_add(&g->csv, "%s\"", starts ? "" : ",");
    for (; *text; text++) {
        koksma__html_add(&g->csv, *text == '"' ? "\"\"" : "%c", *text);
    }
    koksma__html_add(&g->csv, "\"");
}

static void add_csv_number(koksma__grid *g, double value)
{
    char text[40] = "";
    if (!isnan(value)) {
        koksma__snprintf(text, sizeof text, "%.17g", value);
    }
    const bool starts = g->csv.size == 0 || g->csv.text[g->csv.size - 1] == '\n';
    koksma__html_add(&g->csv, "%s%s", starts ? "" : ",", text);
}

void koksma__grid_head(koksma__grid *g, const char *text)
{
    koksma__html_add(g->html, "<th scope=\"col\">");
    koksma__html_text(g->html, text);
    koksma__html_add(g->html, "</th>");
    add_csv(g, text);
}

void koksma__grid_head_interval(koksma__grid *g, const char *text)
{
    char more[160];
    koksma__grid_head(g, text);
    snprintf(more, sizeof more, "%.150s low", text);
    add_csv(g, more);
    snprintf(more, sizeof more, "%.150s high", text);
    add_csv(g, more);
}

void koksma__grid_row(koksma__grid *g)
{
    koksma__html_add(g->html, g->in_body ? "</tr>\n<tr>" : "</tr></thead>\n<tbody><tr>");
    koksma__html_add(&g->csv, "\r\n");
    g->in_body = true;
}

void koksma__grid_text(koksma__grid *g, const char *text)
{
    koksma__html_add(g->html, "<td>");
    koksma__html_text(g->html, text);
    koksma__html_add(g->html, "</td>");
    add_csv(g, text);
}

void koksma__grid_number(koksma__grid *g, double value, int digits)
{
    if (isnan(value)) {
        koksma__html_add(g->html, "<td>&#8211;</td>");
    } else {
        koksma__html_add(g->html, "<td>%.*g</td>", digits, value);
    }
    add_csv_number(g, value);
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
    add_csv_number(g, e.value);
    add_csv_number(g, e.low);
    add_csv_number(g, e.high);
}

void koksma__grid_close(koksma__grid *g)
{
    koksma__html_add(g->html, g->in_body ? "</tr></tbody></table></div>\n" : "</tr></thead></table></div>\n");
    koksma__html_add(&g->csv, "\r\n");
    koksma__html_add(g->html, "<p class=\"csv\"><a download=\"%s.csv\" href=\"data:text/csv;base64,", g->name);
    koksma__html_base64(g->html, (const unsigned char *)g->csv.text, g->csv.failed ? 0 : g->csv.size);
    koksma__html_add(g->html, "\">%s.csv</a></p>\n", g->name);
    g->html->failed |= g->csv.failed;
    free(g->csv.text);
}
