/* SPDX-License-Identifier: Apache-2.0 */
/* The verb `koksma study audit`. */
#ifndef CLI_STUDY_AUDIT_H
#define CLI_STUDY_AUDIT_H

#include "cli.h"

/* Audits a study's folder and prints the result. Returns the exit code: CLI_NO if anything differs. */
int cli_study_audit(const cli_arguments *arguments);

#endif
