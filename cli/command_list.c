/* SPDX-License-Identifier: Apache-2.0 */
/* `koksma list`: prints the members of the library's tables; each table has one function here. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <koksma/adaptive.h>
#include <koksma/estimate.h>
#include <koksma/integrate.h>
#include <koksma/optimise.h>
#include <koksma/study.h>
#include <koksma/verify.h>
#include <koksma/warp.h>

#include "cli.h"
#include "curves.h"

typedef struct claim_line {
    unsigned claim;
    const char *name, *meaning;
} claim_line;

static const claim_line claim_lines[] = {
#define KOKSMA_CLAIM(id, bit, name, meaning) {KOKSMA_CLAIM_##id, name, meaning},
#include <koksma/claims.def>
#undef KOKSMA_CLAIM
};

enum { N_CLAIMS = sizeof claim_lines / sizeof *claim_lines };

static const char *const domains[] = {[KOKSMA_DOMAIN_DISK] = "disk",
                                      [KOKSMA_DOMAIN_TRIANGLE] = "triangle",
                                      [KOKSMA_DOMAIN_HEMISPHERE] = "hemisphere",
                                      [KOKSMA_DOMAIN_HEMISPHERE_COSINE] = "hemisphere, density z/pi",
                                      [KOKSMA_DOMAIN_SPHERE] = "sphere",
                                      [KOKSMA_DOMAIN_GGX_VISIBLE] = "hemisphere, GGX density"};

static void put_dims(cli_rows *rows, int min_dim, int max_dim)
{
    char text[32];
    snprintf(text, sizeof text, min_dim == max_dim ? "%d" : "%d-%d", min_dim, max_dim);
    cli_row_text(rows, "dim", text);
}

static void put_params(cli_rows *rows, const koksma_param *params)
{
    char text[512] = "";
    for (; params && params->name; params++) {
        const size_t used = strlen(text);
        const char *separator = used ? "," : "";
        if (params->choices) {
            snprintf(text + used, sizeof text - used, "%s%s=%s", separator, params->name,
                     params->choices[(int)params->fallback]);
        } else {
            char number[CLI_NUMBER];
            snprintf(text + used, sizeof text - used, "%s%s=%s", separator, params->name,
                     cli_number(params->fallback, number));
        }
    }
    cli_row_text(rows, "parameters", *text ? text : "-");
}

static void put_claims(cli_rows *rows, unsigned of)
{
    char text[256] = "";
    for (size_t c = 0; c < N_CLAIMS; c++) {
        const size_t used = strlen(text);
        if (of & claim_lines[c].claim) {
            snprintf(text + used, sizeof text - used, "%s%s", used ? "," : "", claim_lines[c].name);
        }
    }
    cli_row_text(rows, "claims", *text ? text : "-");
}

/* Adds the column `ranges`: whether the pattern can generate a range of its points, and the choices of its parameters
   with which it can't. */
static void put_ranges(cli_rows *rows, const koksma_pattern *p)
{
    char text[256] = "-";
    double params[KOKSMA_MAX_PARAMS] = {0};
    for (int k = 0; p->params && p->params[k].name; k++) {
        params[k] = p->params[k].fallback;
    }
    if (p->ranges && p->ranges(params)) {
        snprintf(text, sizeof text, "yes");
    }
    for (int k = 0; p->ranges && p->params && p->params[k].name; k++) {
        const koksma_param *param = &p->params[k];
        for (int c = 0; param->choices && param->choices[c]; c++) {
            const size_t used = strlen(text);
            params[k] = c;
            if (!p->ranges(params)) {
                snprintf(text + used, sizeof text - used, ", not %s=%s", param->name, param->choices[c]);
            }
        }
        params[k] = param->fallback;
    }
    cli_row_text(rows, "ranges", text);
}

/* Returns the title of a scene, or the error if the scene needs files of a package that is not installed. The text is
   valid until the next call. */
static const char *scene_title(const char *name)
{
    static char title[512];
    koksma_scene *scene = NULL;
    const koksma_status status = koksma_scene_open(name, &scene);
    snprintf(title, sizeof title, "%s", status ? koksma_error_text() : koksma_scene_title(scene));
    koksma_scene_close(scene);
    return title;
}

/* Returns what a pattern takes from the text after the colon of its spec, or from the file that this text names. */
static const char *reads(const koksma_pattern *p)
{
    return !p->operand                  ? "-"
           : p->whole                   ? "points"
           : p->runs_code               ? "code"
           : strcmp(p->operand, "PATH") ? "numbers"
                                        : "parameters";
}

/* Defines the function list_TABLE. It prints one row for each item x of the table, with x->name, its meaning, and
   `columns`. The expression `next` sets x to item i and is false past the end. */
#define LIST(table, noun, type, next, name, meaning, columns)                                                        \
    static void list_##table(cli_rows *rows)                                                                         \
    {                                                                                                                \
        type x;                                                                                                      \
        for (size_t i = 0; next; i++) {                                                                              \
            cli_row_text(rows, noun, name);                                                                          \
            cli_row_text(rows, "what", meaning);                                                                     \
            columns;                                                                                                 \
            cli_row_end(rows);                                                                                       \
        }                                                                                                            \
    }
#define SOURCE cli_row_text(rows, "source", x->cite)

LIST(patterns, "pattern", const koksma_pattern *, (x = koksma_pattern_at(i)), x->name, x->title,
     (put_dims(rows, x->min_dim, x->max_dim), put_params(rows, x->params), put_claims(rows, x->claims),
      put_ranges(rows, x), cli_row_text(rows, "reads", reads(x)), SOURCE))
LIST(modifiers, "modifier", const koksma_modifier *, (x = koksma_modifier_at(i)), x->name, x->title,
     (cli_row_text(rows, "keeps", x->keeps), put_claims(rows, x->claims),
      cli_row_text(rows, "measures", strcmp(x->measures, "*") ? x->measures : "all"), SOURCE))
LIST(measures, "measure", const koksma_measure *, (x = koksma_measure_at(i)), x->name, x->title,
     (put_dims(rows, x->min_dim, x->max_dim), put_params(rows, x->params), cli_row_text(rows, "cost", x->cost),
      SOURCE))
LIST(integrands, "integrand", const koksma_integrand *, (x = koksma_integrand_at(i)), x->name, x->title,
     (put_dims(rows, x->min_dim, x->max_dim), put_params(rows, x->params), cli_row_text(rows, "integral", x->known),
      SOURCE))
LIST(estimators, "estimator", const koksma_estimator *, (x = koksma_estimator_at(i)), x->name, x->title,
     (cli_row_text(rows, "interval", x->interval), SOURCE))
LIST(intervals, "interval", const koksma_interval *, (x = koksma_interval_at(i)), x->name, x->title,
     (cli_row_flag(rows, "proved", x->proved), cli_row_text(rows, "assumes", x->assumes), SOURCE))
LIST(claims, "claim", const claim_line *, i < N_CLAIMS && (x = &claim_lines[i]), x->name, x->meaning, (void)x)
LIST(properties, "property", const koksma_property *, (x = koksma_property_at(i)), x->name, x->meaning, (void)x)
LIST(warps, "warp", const koksma_warp *, (x = koksma_warp_at(i)), x->name, x->title,
     (cli_row_text(rows, "domain", domains[x->domain]), SOURCE))
LIST(curves, "curve", const cli_curve *, (x = cli_curve_at(i)), x->name, x->meaning,
     (cli_row_text(rows, "by",
                   !x->print.options ? "plot"
                   : x->plot.options ? "curve,plot"
                                     : "curve"),
      SOURCE))
LIST(scenes, "scene", const char *, (x = koksma_scene_name_at(i)), x, scene_title(x), (void)x)
LIST(integrators, "integrator", const koksma_integrator *, (x = koksma_integrator_at(i)), x->name, x->title,
     (cli_row_whole(rows, "depth", (uint64_t)x->depth), SOURCE))
LIST(filters, "filter", const koksma_filter *, (x = koksma_filter_at(i)), x->name, x->title,
     (cli_row_number(rows, "radius", x->radius), SOURCE))
LIST(metrics, "metric", const koksma_metric *, (x = koksma_metric_at(i)), x->name, x->title,
     (put_params(rows, x->params), SOURCE))
LIST(uses, "use", const koksma_use *, (x = koksma_use_at(i)), x->name, x->help,
     cli_row_whole(rows, "dim", (uint64_t)x->dim))
LIST(adaptive, "method", const koksma_adaptive *, (x = koksma_adaptive_at(i)), x->name, x->title,
     (put_params(rows, x->params),
      cli_row_text(rows, "samples", x->own_samples ? "own strata" : "sets of the pattern"), SOURCE))
LIST(methods, "method", const koksma_method *, (x = koksma_method_at(i)), x->name, x->title, SOURCE)
#define KIND (cli_row_text(rows, "fields", x.fields), cli_row_text(rows, "source", x.cite))
LIST(materials, "material", koksma_entry, koksma_scene_kind_at("materials", i, &x), x.name, x.title, KIND)
LIST(lights, "light", koksma_entry, koksma_scene_kind_at("lights", i, &x), x.name, x.title, KIND)
LIST(shapes, "shape", koksma_entry, koksma_scene_kind_at("shapes", i, &x), x.name, x.title, KIND)
LIST(pipelines, "pipeline", koksma_entry, koksma_pipeline_at(i, &x), x.name, x.title, (void)x)
LIST(questions, "question", koksma_entry, koksma_question_at(i, &x), x.name, x.title, (void)x)
LIST(sections, "section", koksma_entry, koksma_report_section_at(i, &x), x.name, x.title, (void)x)

/* The macro LIST does not fit the tables of the functions below: plans, for example, have no descriptions. */
static void list_plans(cli_rows *rows)
{
    for (size_t i = 0; koksma_plan_name_at(i); i++) {
        cli_row_text(rows, "plan", koksma_plan_name_at(i));
        cli_row_end(rows);
    }
}

static void list_formats(cli_rows *rows)
{
    const char *name, *left_out;
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)); i++) {
        cli_row_text(rows, "format", name);
        cli_row_text(rows, "needs", left_out ? left_out : "-");
        cli_row_end(rows);
    }
}

static void list_records(cli_rows *rows)
{
    const koksma_record *r;
    for (size_t i = 0; (r = koksma_record_at(i)); i++) {
        cli_row_text(rows, "measure", r->measure);
        cli_row_whole(rows, "dim", (uint64_t)r->dim);
        cli_row_whole(rows, "n", r->n);
        cli_row_number(rows, "value", r->value);
        cli_row_number(rows, "published", r->published > 0 ? r->published : (double)NAN);
        cli_row_text(rows, "source", r->source);
        cli_row_number(rows, "seed", r->steps ? (double)r->seed : (double)NAN);
        cli_row_number(rows, "steps", r->steps ? (double)r->steps : (double)NAN);
        cli_row_end(rows);
    }
}

/* Adds the choices or the limits of a parameter. Limits have all their digits, because values beyond them are refused. */
static void put_range(cli_rows *rows, const koksma_param *p)
{
    char text[256] = "";
    if (p->choices) {
        for (size_t i = 0; p->choices[i]; i++) {
            const size_t used = strlen(text);
            snprintf(text + used, sizeof text - used, "%s%s", used ? " " : "", p->choices[i]);
        }
    } else {
        const int all = p->whole ? 17 : 15; /* the digits of 2^53; those that a fraction in a table is written with */
        snprintf(text, sizeof text, "%s%.*g to %.*g", p->fallback < p->min ? "0, " : "", all, p->min, all, p->max);
    }
    cli_row_text(rows, "range", text);
}

static void list_parameters_of(cli_rows *rows, const char *member, const koksma_param *params)
{
    for (const koksma_param *p = params; p && p->name; p++) {
        cli_row_text(rows, "of", member);
        cli_row_text(rows, "parameter", p->name);
        cli_row_text(rows, "what", p->help);
        if (p->choices) {
            cli_row_text(rows, "default", p->choices[(int)p->fallback]);
        } else {
            cli_row_number(rows, "default", p->fallback);
        }
        put_range(rows, p);
        cli_row_end(rows);
    }
}

/* Lists the parameters of all members that the function `at` returns. */
#define PARAMETERS_OF(at)                                                                                            \
    for (size_t i = 0; at(i); i++) {                                                                                 \
        list_parameters_of(rows, at(i)->name, at(i)->params);                                                        \
    }

static void list_parameters(cli_rows *rows)
{
    const koksma_pattern *p;
    const koksma_modifier *x;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        if (p->operand) {
            cli_row_text(rows, "of", p->name);
            cli_row_text(rows, "parameter", p->operand);
            cli_row_text(rows, "what",
                         p->runs_code ? "program or library to run (after the colon; needs --allow-exec)"
                         : strcmp(p->operand, "PATH") ? "numbers, after the colon"
                                                      : "the file that it reads, after the colon");
            cli_row_text(rows, "default", "-");
            cli_row_text(rows, "range", reads(p));
            cli_row_end(rows);
        }
        list_parameters_of(rows, p->name, p->params);
    }
    for (size_t i = 0; (x = koksma_modifier_at(i)); i++) {
        const koksma_param one[] = {{x->name, x->title, 0, x->min > 1 ? x->min : 0, x->max, NULL, true}, {0}};
        list_parameters_of(rows, "any pattern", one);
    }
    PARAMETERS_OF(koksma_measure_at)
    PARAMETERS_OF(koksma_integrand_at)
    PARAMETERS_OF(koksma_adaptive_at)
    PARAMETERS_OF(koksma_metric_at)
}

static const struct {
    const char *name;
    void (*list)(cli_rows *rows);
} lists[] = {
    {"patterns", list_patterns},
    {"modifiers", list_modifiers},
    {"measures", list_measures},
    {"integrands", list_integrands},
    {"estimators", list_estimators},
    {"intervals", list_intervals},
    {"claims", list_claims},
    {"properties", list_properties},
    {"warps", list_warps},
    {"curves", list_curves},
    {"scenes", list_scenes},
    {"materials", list_materials},
    {"lights", list_lights},
    {"shapes", list_shapes},
    {"formats", list_formats},
    {"integrators", list_integrators},
    {"pipelines", list_pipelines},
    {"filters", list_filters},
    {"uses", list_uses},
    {"metrics", list_metrics},
    {"adaptive", list_adaptive},
    {"methods", list_methods},
    {"records", list_records},
    {"plans", list_plans},
    {"questions", list_questions},
    {"sections", list_sections},
    {"parameters", list_parameters},
};

const char *cli_list_names(const char *comma, char *text, size_t size)
{
    size_t used = 0;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        used += (size_t)snprintf(text + used, size - used, "%s%s", i ? comma : "", lists[i].name);
    }
    return text;
}

static int run(const cli_arguments *arguments)
{
    char names[512];
    const char *which = arguments->n_operands ? arguments->operands[0] : NULL;
    bool found = !which;
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        found = found || !strcmp(which, lists[i].name);
    }
    if (!found || arguments->n_operands > 1) {
        char meant[96] = "", known[CLI_KNOWN];
        if (!found && arguments->n_operands == 1 && *cli_known_as(arguments, which, known)) {
            return cli_usage_error(arguments, "no list '%s'%s", which, known);
        }
        cli_list_names(", ", names, sizeof names);
        return found ? cli_usage_error(arguments, "it prints all %s, and '%s' is one operand more", which,
                                       arguments->operands[1])
                     : cli_usage_error(arguments, "%sit takes one of %s", cli_meant_of(which, names, meant), names);
    }
    cli_rows *rows = cli_rows_open(cli_flag(arguments, "json"));
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        if (!which) {
            cli_row_text(rows, "list", lists[i].name);
            cli_row_end(rows);
        } else if (!strcmp(which, lists[i].name)) {
            lists[i].list(rows);
        }
    }
    return cli_rows_close(rows, CLI_YES);
}

static const cli_option options[] = {CLI_ROW_OPTIONS, {0}};

const cli_command cli_command_list = {
    .name = "list",
    .summary = "list the members of a table, or the tables",
    .synopsis = "[{lists}] [--json]",
    .details = "Without a name: the names of the tables.\n"
               "uses: a use is a purpose for which a sample needs one or two dimensions, such as the position on the "
               "lens. 'koksma render -p USE=PATTERN' gives one use its own pattern; '-p USE+USE=PATTERN' gives "
               "several uses one pattern with the dimensions of all of them.",
    .examples = "koksma list patterns\n"
                "koksma list scenes --json\n",
    .options = options,
    .run = run,
};
