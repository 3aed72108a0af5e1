# What every compiler of the library is told, gcc, clang and emcc. One result whatever the instruction set: no fused
# multiply-add, no fast-math. The two -fno switches change no value; they let the compiler vectorise loops with comparisons
# and square roots.
set(CMAKE_C_STANDARD 11)
set(CMAKE_C_EXTENSIONS OFF)
set(CMAKE_C_FLAGS_RELEASE "-O3")
set(CMAKE_C_FLAGS_DEBUG "-O1 -g")
add_compile_definitions(_XOPEN_SOURCE=700) # POSIX 2008 and M_PI
# What these systems lack of POSIX, by the names of its headers, and what their headers hide without asking.
if(WIN32 OR APPLE)
  set(engine ${CMAKE_CURRENT_LIST_DIR}/../src/engine)
  include_directories(BEFORE ${engine}/core/platform/posix)
  include_directories(AFTER ${engine})
  add_compile_definitions($<IF:$<BOOL:${WIN32}>,__USE_MINGW_ANSI_STDIO=1,_DARWIN_C_SOURCE>)
endif()
if(APPLE)
  set(CMAKE_SHARED_LIBRARY_RUNTIME_C_FLAG "-Wl,-rpath,") # for which CMake asks the system that it runs on
endif()
if(WIN32)
  add_compile_definitions(KOKSMA_BUILD _WIN32_WINNT=0x0602 _FILE_OFFSET_BITS=64 _CRT_RAND_S) # KOKSMA_BUILD: what is exported
  add_compile_options("SHELL:-include ${engine}/core/platform/windows.h")
  # gcc aligns the stack to 16 bytes there, and spills vectors of 32 with moves that want 32 (its bug 54412).
  add_compile_options($<$<C_COMPILER_ID:GNU>:-Wa,-muse-unaligned-vector-move>)
  add_link_options(-static) # the threads of mingw, and gcc's own library
endif()
add_compile_options(-Wall -Wextra -Wshadow -Wstrict-prototypes -Wmissing-prototypes -Wpointer-arith -Wwrite-strings
                    $<$<C_COMPILER_ID:GNU>:-Wdouble-promotion> -Wvla -ffp-contract=off -fno-math-errno -fno-trapping-math)
