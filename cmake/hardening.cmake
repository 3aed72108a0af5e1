# What makes a mistake in memory harder to use, in everything this build compiles and links: canaries before return
# addresses, checked calls of the C library, large stack frames touched page by page, indirect branches to marked places
# only, tables of addresses that are read-only once the program has started, no executable stack, programs at random
# addresses. Of flags the compiler or linker lacks none is used. tests/lint/elf.py reads the files that come of it.
include(CheckCCompilerFlag)
include(CheckCSourceCompiles)
include(CheckLinkerFlag)
include(CheckPIESupported)

# These checks of mingw need a library of its own, which programs elsewhere lack.
if(WIN32)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  return()
endif()
foreach(flag -fstack-protector-strong -fstack-clash-protection -fcf-protection=full -mbranch-protection=standard)
  string(MAKE_C_IDENTIFIER "KOKSMA_HAS${flag}" has)
  check_c_compiler_flag("-Werror ${flag}" ${has})
  if(${has})
    add_compile_options(${flag})
  endif()
endforeach()
foreach(flag -Wl,-z,relro -Wl,-z,now -Wl,-z,noexecstack)
  string(MAKE_C_IDENTIFIER "KOKSMA_HAS${flag}" has)
  check_linker_flag(C ${flag} ${has})
  if(${has})
    add_link_options(${flag})
  endif()
endforeach()

# The sanitizers check the same calls themselves, and see less where the C library's checked forms stand in between.
if(NOT KOKSMA_SANITIZE AND NOT KOKSMA_THREAD_SANITIZER)
  set(CMAKE_REQUIRED_FLAGS "-O2 -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3")
  check_c_source_compiles("#include <string.h>\n#if __USE_FORTIFY_LEVEL < 3\n#error\n#endif\nint main(void) { return 0; }"
                          KOKSMA_HAS_FORTIFY_3)
  unset(CMAKE_REQUIRED_FLAGS)
  add_compile_options(-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=$<IF:$<BOOL:${KOKSMA_HAS_FORTIFY_3}>,3,2>)
endif()

set(CMAKE_POSITION_INDEPENDENT_CODE ON)
if(KOKSMA_SANITIZE AND NOT KOKSMA_FUZZ)
  # UBSan describes each check by addresses, 380,000 of them in the program: to relocate these took 21 of the 53 ms
  # of a start, and tests start the program thousands of times.
  unset(CMAKE_C_LINK_PIE_SUPPORTED CACHE)
  add_link_options($<$<STREQUAL:$<TARGET_PROPERTY:TYPE>,EXECUTABLE>:-no-pie>)
else()
  check_pie_supported(OUTPUT_VARIABLE pie_output LANGUAGES C)
  if(NOT CMAKE_C_LINK_PIE_SUPPORTED)
    message(STATUS "programs are at fixed addresses: ${pie_output}")
  endif()
endif()
