/* SPDX-License-Identifier: Apache-2.0 */
/* Specs as text, and the checks of their parameters. `member` is the name of the pattern or measure in error
   messages. */
#ifndef KOKSMA_CORE_SPEC_H
#define KOKSMA_CORE_SPEC_H

#include <koksma/koksma.h>

#include "core/visibility.h"

/* Parses "key=value,key=value" with a table of parameters (NULL: there are no parameters); all values start with
   their defaults. */
KOKSMA__LAB koksma_status koksma__params_parse(const char *member, const koksma_param *params, const char *text,
                                               double *values);

/* Fails unless all values are in their ranges. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__params_check(const char *member, const koksma_param *params, const double *values);
koksma_status koksma__modifiers_check(const char *pattern, const double *values);

/* Fails unless a pattern or measure supports a number of dimensions. Errors: DIM. */
koksma_status koksma__dim_check(const char *member, int dim, int min_dim, int max_dim);

/* Appends ":key=value,…" with the parameters that differ from their defaults. */
KOKSMA__LAB void koksma__params_text(const koksma_param *params, const double *values, char *text, size_t size);

/* Splits a spec into the name before the colon, which has up to 63 letters, and the parameters. Errors: ARGUMENT. */
KOKSMA__LAB koksma_status koksma__spec_split(const char *text, char *name, const char **rest);

/* Converts the spec of a pattern or measure to the arguments of its functions. */
koksma_args koksma__spec_arguments(const koksma_spec *spec, const koksma_run *run);

/* ---- The modifiers of patterns (koksma_modifier), which are read, printed and applied in the order of their table ---- */

/* The modifiers, in the order of their table. */
enum {
    KOKSMA__MODIFIER_OWEN,
    KOKSMA__MODIFIER_DIGITAL_SHIFT,
    KOKSMA__MODIFIER_AXES,
    KOKSMA__MODIFIER_MIRROR,
    KOKSMA__MODIFIER_PHASE,
    KOKSMA__MODIFIER_SHIFT,
    KOKSMA__MODIFIER_OWEN_BASE,
    KOKSMA__MODIFIER_TENT,
    KOKSMA__MODIFIERS
};

enum { KOKSMA__MOST_BASE = 64 }; /* of owen-base */

/* The parameters of a pattern (NULL: none), followed by the modifiers; an entry whose name is NULL ends the list. */
typedef struct koksma__all_params {
    koksma_param params[KOKSMA_MAX_PARAMS + KOKSMA_MAX_MODIFIERS + 1];
    size_t own; /* number of the pattern's own parameters, which precede the modifiers */
} koksma__all_params;

void koksma__all_params_init(koksma__all_params *all, const koksma_param *own);

/* Returns where the modifiers at the end of "PATH,shift=1,phase=3" begin: at a comma, or at the end of the text. A
   part with a dot or a slash still belongs to the path: x,shift=1.txt is a file's name. */
KOKSMA__LAB const char *koksma__modifiers_of_path(const char *text);

/* Modifier i as a parameter. The default of a modifier, 0, may be below its range. */
koksma_param koksma__modifier_param(size_t i);

/* Returns whether any applied modifier depends on the seed. */
KOKSMA__LAB bool koksma__modifiers_are_random(const double *values);

/* Returns whether any applied modifier changes the binary digits of coordinates. Such points are no longer stratified
   in other bases, so that koksma_rate() must not use all claims of the pattern. */
bool koksma__modifiers_of_digits(const double *values);

/* Returns the claims of a pattern that are still true for n points after its modifiers. */
KOKSMA__LAB unsigned koksma__claims_left(const koksma_spec *spec, size_t n);

#endif
