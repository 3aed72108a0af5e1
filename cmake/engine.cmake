# The sources of libkoksma, for src/ and explorer/ alike.
#
# koksma_engine_sources(FOLDER): checks the tables of src/engine, which is FOLDER from here, against their files, and sets
#   ENGINE_SOURCES   all that is compiled once
#   FAST_KERNELS     the kernels that are compiled once for each instruction set, with kernels/table.c
macro(koksma_engine_sources folder)
  koksma_table(unused ${folder}/patterns PATTERN patterns.def "" modify.c registry.c)
  koksma_table(unused ${folder}/measures MEASURE measures.def "" registry.c)
  koksma_table(unused ${folder}/integrands INTEGRAND integrands.def "" closed_forms.c command.c estimates.c integral.c integration.c
               screen.c tolerance.c tolerance_path.c)
  koksma_table(unused ${folder}/verify PROPERTY properties.def verify_ verify.c)
  koksma_table(unused ${folder}/optimise METHOD methods.def method_ descent.c optimise.c radial_power.c sequence.c start.c swaps.c
               value.c)
  set(engine ${CMAKE_CURRENT_SOURCE_DIR}/${folder})
  file(GLOB ENGINE_SOURCES CONFIGURE_DEPENDS ${engine}/core/*.c ${engine}/core/platform/*.c ${engine}/api/*.c ${engine}/patterns/*.c ${engine}/patterns/*/*.c
       ${engine}/measures/*.c ${engine}/measures/*/*.c ${engine}/warps/*.c ${engine}/integrands/*.c ${engine}/verify/*.c
       ${engine}/masks/*.c ${engine}/optimise/*.c ${engine}/identify/*.c ${engine}/kernels/kernels*.c)
  foreach(part mean_square quantiles running_stats) # the rest of stats/ is koksma-lab's
    list(APPEND ENGINE_SOURCES ${engine}/stats/${part}.c)
  endforeach()
  file(GLOB FAST_KERNELS CONFIGURE_DEPENDS ${engine}/kernels/fast_*.c)
endmacro()
