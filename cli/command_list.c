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

/* The functions below return texts that are valid until their next call. */

static const char *dims(int min_dim, int max_dim)
{
    static char text[32];
    snprintf(text, sizeof text, min_dim == max_dim ? "%d" : "%d-%d", min_dim, max_dim);
    return text;
}

/* The default of a parameter. */
static const char *fallback(const koksma_param *p, char number[CLI_NUMBER])
{
    return p->choices ? p->choices[(int)p->fallback] : cli_number(p->fallback, number);
}

static const char *params_of(const koksma_param *params)
{
    static char text[512];
    char number[CLI_NUMBER];
    *text = '\0';
    for (; params && params->name; params++) {
        CLI_APPEND(text, sizeof text, "%s%s=%s", *text ? "," : "", params->name, fallback(params, number));
    }
    return *text ? text : "-";
}

static const char *claims_of(unsigned of)
{
    static char text[256];
    *text = '\0';
    for (size_t c = 0; c < N_CLAIMS; c++) {
        if (of & claim_lines[c].claim) {
            CLI_APPEND(text, sizeof text, "%s%s", *text ? "," : "", claim_lines[c].name);
        }
    }
    return *text ? text : "-";
}

/* Whether the pattern can generate a range of its points, and the choices of its parameters with which it can't. */
static const char *ranges(const koksma_pattern *p)
{
    static char text[256];
    double params[KOKSMA_MAX_PARAMS] = {0};
    for (int k = 0; p->params && p->params[k].name; k++) {
        params[k] = p->params[k].fallback;
    }
    strcpy(text, p->ranges && p->ranges(params) ? "yes" : "-");
    for (int k = 0; p->ranges && p->params && p->params[k].name; k++) {
        const koksma_param *param = &p->params[k];
        for (int c = 0; param->choices && param->choices[c]; c++) {
            params[k] = c;
            if (!p->ranges(params)) {
                CLI_APPEND(text, sizeof text, ", not %s=%s", param->name, param->choices[c]);
            }
        }
        params[k] = param->fallback;
    }
    return text;
}

/* The title of a scene, or the error if it needs files of a package that is not installed. */
static const char *scene_title(const char *name)
{
    static char title[512];
    koksma_scene *scene = NULL;
    const koksma_status status = koksma_scene_open(name, &scene);
    snprintf(title, sizeof title, "%s", status ? koksma_error_text() : koksma_scene_title(scene));
    koksma_scene_close(scene);
    return title;
}

/* What a pattern takes from the text after the colon of its spec, or from the file that this text names. */
static const char *reads(const koksma_pattern *p)
{
    return !p->operand                  ? "-"
           : p->whole                   ? "points"
           : p->runs_code               ? "code"
           : strcmp(p->operand, "PATH") ? "numbers"
                                        : "parameters";
}

/* Defines the function list_TABLE, which prints a row for each item x of the table. The expression `next` sets x to item i
   and is false past the end; the rest are the fields of a row as cli_row() takes them. */
#define LIST(table, type, next, ...)                                                                                 \
    static void list_##table(void)                                                                                   \
    {                                                                                                                \
        type x;                                                                                                      \
        for (size_t i = 0; next; i++) {                                                                              \
            cli_row(__VA_ARGS__);                                                                                    \
        }                                                                                                            \
    }

LIST(patterns, const koksma_pattern *, (x = koksma_pattern_at(i)),
     "pattern %s what %s dim %s parameters %s claims %s ranges %s reads %s source %s\n", x->name, x->title,
     dims(x->min_dim, x->max_dim), params_of(x->params), claims_of(x->claims), ranges(x), reads(x), x->cite)
LIST(modifiers, const koksma_modifier *, (x = koksma_modifier_at(i)),
     "modifier %s what %s keeps %s claims %s measures %s source %s\n", x->name, x->title, x->keeps,
     claims_of(x->claims), strcmp(x->measures, "*") ? x->measures : "all", x->cite)
LIST(measures, const koksma_measure *, (x = koksma_measure_at(i)),
     "measure %s what %s dim %s parameters %s cost %s source %s\n", x->name, x->title, dims(x->min_dim, x->max_dim),
     params_of(x->params), x->cost, x->cite)
LIST(integrands, const koksma_integrand *, (x = koksma_integrand_at(i)),
     "integrand %s what %s dim %s parameters %s integral %s source %s\n", x->name, x->title,
     dims(x->min_dim, x->max_dim), params_of(x->params), x->known, x->cite)
LIST(estimators, const koksma_estimator *, (x = koksma_estimator_at(i)),
     "estimator %s what %s interval %s source %s\n", x->name, x->title, x->interval, x->cite)
LIST(intervals, const koksma_interval *, (x = koksma_interval_at(i)),
     "interval %s what %s proved? %d assumes %s source %s\n", x->name, x->title, x->proved, x->assumes, x->cite)
LIST(claims, const claim_line *, i < N_CLAIMS && (x = &claim_lines[i]), "claim %s what %s\n", x->name, x->meaning)
LIST(properties, const koksma_property *, (x = koksma_property_at(i)), "property %s what %s\n", x->name, x->meaning)
LIST(warps, const koksma_warp *, (x = koksma_warp_at(i)), "warp %s what %s domain %s source %s\n", x->name, x->title,
     domains[x->domain], x->cite)
LIST(curves, const cli_curve *, (x = cli_curve_at(i)), "curve %s what %s by %s source %s\n", x->name, x->meaning,
     !x->print.options ? "plot"
     : x->plot.options ? "curve,plot"
                       : "curve",
     x->cite)
LIST(scenes, const char *, (x = koksma_scene_name_at(i)), "scene %s what %s\n", x, scene_title(x))
LIST(integrators, const koksma_integrator *, (x = koksma_integrator_at(i)),
     "integrator %s what %s depth %d source %s\n", x->name, x->title, x->depth, x->cite)
LIST(filters, const koksma_filter *, (x = koksma_filter_at(i)), "filter %s what %s radius %g source %s\n", x->name,
     x->title, x->radius, x->cite)
LIST(metrics, const koksma_metric *, (x = koksma_metric_at(i)), "metric %s what %s parameters %s source %s\n",
     x->name, x->title, params_of(x->params), x->cite)
LIST(uses, const koksma_use *, (x = koksma_use_at(i)), "use %s what %s dim %d\n", x->name, x->help, x->dim)
LIST(adaptive, const koksma_adaptive *, (x = koksma_adaptive_at(i)),
     "method %s what %s parameters %s samples %s source %s\n", x->name, x->title, params_of(x->params),
     x->own_samples ? "own strata" : "sets of the pattern", x->cite)
LIST(methods, const koksma_method *, (x = koksma_method_at(i)), "method %s what %s source %s\n", x->name, x->title,
     x->cite)
#define KIND " %s what %s fields %s source %s\n", x.name, x.title, x.fields, x.cite
LIST(materials, koksma_entry, koksma_scene_kind_at("materials", i, &x), "material" KIND)
LIST(lights, koksma_entry, koksma_scene_kind_at("lights", i, &x), "light" KIND)
LIST(shapes, koksma_entry, koksma_scene_kind_at("shapes", i, &x), "shape" KIND)
LIST(pipelines, koksma_entry, koksma_pipeline_at(i, &x), "pipeline %s what %s\n", x.name, x.title)
LIST(questions, koksma_entry, koksma_question_at(i, &x), "question %s what %s\n", x.name, x.title)
LIST(sections, koksma_entry, koksma_report_section_at(i, &x), "section %s what %s\n", x.name, x.title)
LIST(plans, const char *, (x = koksma_plan_name_at(i)), "plan %s\n", x)
LIST(records, const koksma_record *, (x = koksma_record_at(i)),
     "measure %s dim %d n %zu value %g published %g source %s seed %g steps %g\n", x->measure, x->dim, x->n, x->value,
     x->published > 0 ? x->published : (double)NAN, x->source, x->steps ? (double)x->seed : (double)NAN,
     x->steps ? (double)x->steps : (double)NAN)

static void list_formats(void)
{
    const char *name, *left_out;
    for (size_t i = 0; (name = koksma_image_format(i, &left_out)); i++) {
        cli_row("format %s needs %s\n", name, left_out ? left_out : "-");
    }
}

/* The choices or the limits of a parameter. Limits have all their digits, because values beyond them are refused. */
static const char *range(const koksma_param *p)
{
    static char text[256];
    const int all = p->whole ? 17 : 15; /* the digits of 2^53; those that a fraction in a table is written with */
    snprintf(text, sizeof text, "%s%.*g to %.*g", p->fallback < p->min ? "0, " : "", all, p->min, all, p->max);
    for (size_t i = 0; p->choices && p->choices[i]; i++) {
        *text = i ? *text : '\0';
        CLI_APPEND(text, sizeof text, "%s%s", i ? " " : "", p->choices[i]);
    }
    return text;
}

static void list_parameters_of(const char *member, const koksma_param *params)
{
    for (const koksma_param *p = params; p && p->name; p++) {
        cli_row("of %s parameter %s what %s", member, p->name, p->help);
        if (p->choices) {
            cli_row("default %s", p->choices[(int)p->fallback]);
        } else {
            cli_row("default %g", p->fallback);
        }
        cli_row("range %s\n", range(p));
    }
}

/* Lists the parameters of all members that the function `at` returns. */
#define PARAMETERS_OF(at)                                                                                            \
    for (size_t i = 0; at(i); i++) {                                                                                 \
        list_parameters_of(at(i)->name, at(i)->params);                                                              \
    }

static void list_parameters(void)
{
    const koksma_pattern *p;
    const koksma_modifier *x;
    for (size_t i = 0; (p = koksma_pattern_at(i)); i++) {
        if (p->operand) {
            cli_row("of %s parameter %s what %s default %s range %s\n", p->name, p->operand,
                    p->runs_code                 ? "program or library to run (after the colon; needs --allow-exec)"
                    : strcmp(p->operand, "PATH") ? "numbers, after the colon"
                                                 : "the file that it reads, after the colon",
                    "-", reads(p));
        }
        list_parameters_of(p->name, p->params);
    }
    for (size_t i = 0; (x = koksma_modifier_at(i)); i++) {
        const koksma_param one[] = {{x->name, x->title, 0, x->min > 1 ? x->min : 0, x->max, NULL, true}, {0}};
        list_parameters_of("any pattern", one);
    }
    PARAMETERS_OF(koksma_measure_at)
    PARAMETERS_OF(koksma_integrand_at)
    PARAMETERS_OF(koksma_adaptive_at)
    PARAMETERS_OF(koksma_metric_at)
}

static const struct {
    const char *name;
    void (*list)(void);
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

static const char *list_name(const void *table, size_t i)
{
    (void)table;
    return i < sizeof lists / sizeof *lists ? lists[i].name : NULL;
}

const char *cli_list_names(const char *comma, char *text, size_t size)
{
    return cli_join(list_name, NULL, comma, comma, text, size);
}

static int run(const cli_args *args)
{
    char names[512], meant[96] = "", known[CLI_KNOWN];
    const char *which = args->n_operands ? args->operands[0] : NULL;
    size_t list = 0;
    while (which && list_name(NULL, list) && strcmp(which, list_name(NULL, list)) != 0) {
        list++;
    }
    const bool found = list_name(NULL, list);
    if (found && args->n_operands > 1) {
        return cli_error(args, "it prints all %s, and '%s' is one operand more", which, args->operands[1]);
    }
    if (!found && args->n_operands == 1 && *cli_known_as(args, which, known)) {
        return cli_error(args, "no list '%s'%s", which, known);
    }
    if (!found) {
        cli_list_names(", ", names, sizeof names);
        return cli_error(args, "%sit takes one of %s", cli_meant_of(which, names, meant), names);
    }
    if (which) {
        lists[list].list();
    }
    for (size_t i = 0; !which && list_name(NULL, i); i++) {
        cli_row("list %s\n", lists[i].name);
    }
    return cli_rows_close(CLI_YES);
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
