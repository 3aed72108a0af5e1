# SPDX-License-Identifier: Apache-2.0
# Points of Koksma in R, and their star discrepancy. Build the library first:
#
#     PKG_CPPFLAGS=$(pkg-config --cflags koksma) PKG_LIBS=$(pkg-config --libs koksma) R CMD SHLIB koksma_r.c
#     Rscript koksma.R
dyn.load("koksma_r.so")
generate <- function(pattern, n, seed = 1, dim = 2)
  t(matrix(.C("koksma_r_generate", pattern, seed, as.integer(dim), as.integer(n), xs = double(n * dim))$xs, dim))
measure <- function(points, name)
  .C("koksma_r_measure", name, ncol(points), nrow(points), t(points), value = 0)$value
cat(sprintf("%.15g\n", measure(generate("sobol:scramble=owen", 64, seed = 7), "star")))
